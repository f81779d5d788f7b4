"""The task-level data set, sampled from a vocabulary.

    for record in sample_tasks(load_vocabulary(), seed=0, count=500, split="test"): ...

About half of the samples are put together (compose.py): movements, filters and perception skills of
a task, each in a clause of the phrase file, and the label is exactly what the clauses say. The
others come from whole-prompt templates (prompts/), which belong to one of the splits each. The
skeleton of a prompt, its text without the values, decides which of train, validation and test may
hold it.
"""

from __future__ import annotations

import itertools
import random
import zlib
from collections.abc import Callable, Iterator, Sequence
from typing import Any, Literal, get_args

from planner_ft.data.noise import noisy
from planner_ft.data.numbers import pick
from planner_ft.data.task.binding import binding, titles
from planner_ft.data.task.compose import WORDS, composed
from planner_ft.data.task.draw import Context, draw_template
from planner_ft.data.task.phrasebook import phrasebook
from planner_ft.data.templates.records import templates
from planner_ft.data.templates.render import plain, skeleton
from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary.definition import Vocabulary
from planner_ft.vocabulary.plans import canonical_parameters, plan_problems, step_skills

Split = Literal["train", "validation", "test", "test_unseen"]
SPLITS: tuple[Split, ...] = get_args(Split)

LONGEST = 24
"""Steps; longer answers are drawn anew."""
TEMPLATES = 0.5
"""Share of the samples that come from a whole-prompt template."""
HELD_OUT = 12
"""Percent of the skeletons that belong to validation, and as many to test."""
Draw = Callable[[], dict[str, Any] | None]


def sample_tasks(
    vocabulary: Vocabulary, seed: int, count: int | None, split: Split, subjects: Sequence[str] = ()
) -> Iterator[dict[str, Any]]:
    """Yield `count` different records, or an endless stream when `count` is None; same seed, same
    records. With `subjects` they come from the whole-prompt templates of these subjects alone.

    Record: {"id", "family", "task", "parameters", "prompt", "expected"}, canonical and strictly
    valid. Raises PlannerError for an unknown split, for subjects without a template, or when the
    vocabulary has not enough different samples.
    """
    if split not in SPLITS:
        raise PlannerError(f"split {split}: must be {', '.join(SPLITS)}")
    rng = random.Random(f"{vocabulary.name}:{seed}:{split}")
    draws = _Draws(vocabulary, rng, split, subjects)
    seen: set[int] = set()
    misses = 0
    for number in itertools.count() if count is None else range(count):
        draw = draws.any()
        while True:
            drawn = draw()
            if drawn:
                key = hash((drawn["task"], repr(drawn["parameters"]), drawn["prompt"]))
                if key not in seen:
                    break
            misses += 1
            if misses > 5000 + 500 * (number + 1):
                raise PlannerError(
                    f"vocabulary {vocabulary.name}: split {split} has fewer than {count} different"
                    " samples; ask for fewer or add phrases"
                )
        seen.add(key)
        yield {"id": f"task-{split}-{number:06d}", **drawn}


def split_of(text: str) -> Split:
    """The split to which a skeleton, or a template, of a training family belongs."""
    bucket = zlib.crc32(text.lower().encode()) % 100
    return "test" if bucket < HELD_OUT else "validation" if bucket < 2 * HELD_OUT else "train"


class _Draws:
    """Single draws for one split; None when one came to nothing or belongs to another split."""

    def __init__(
        self, vocabulary: Vocabulary, rng: random.Random, split: Split, subjects: Sequence[str]
    ) -> None:
        self.unseen = split == "test_unseen"
        self.book, self.rng, self.split = phrasebook(vocabulary, unseen=self.unseen), rng, split
        self.templates = [
            group
            for group in ([] if self.unseen else templates(vocabulary, "prompts", split))
            if not subjects or group[0].subject in subjects
        ]
        if subjects and not self.templates:
            raise PlannerError(
                f"vocabulary {vocabulary.name}: split {split} has no prompt templates of"
                f" {', '.join(subjects)}; a subject is the name of a file of templates"
            )
        self.share = 1.0 if subjects else TEMPLATES

    def any(self) -> Draw:
        """Where the next sample comes from."""
        whole = self.templates and self.rng.random() < self.share
        return self.from_template if whole else self.composed

    def from_template(self) -> dict[str, Any] | None:
        """One record without id from a whole-prompt template."""
        template = pick(pick(self.templates, self.rng), self.rng)
        title = pick(titles(template, self.book.vocabulary), self.rng)
        if (bound := binding(template, title, self.book)) is None:
            return None
        context = Context(self.book, self.book.vocabulary.task[title], self.rng)
        if (drawn := draw_template(bound, context)) is None:
            return None
        family = f"template/{len(drawn[1]['skill_sequence'])}"
        return self._record(family, context, *drawn, ("train", self.split))

    def composed(self) -> dict[str, Any] | None:
        """One record without id that was put together."""
        context = Context(self.book, pick(self.book.vocabulary.tasks, self.rng), self.rng)
        if (found := composed(context)) is None or not (drawn := draw_template(found[1], context)):
            return None
        family = f"unseen-{found[0]}" if self.unseen else found[0]
        text, plan, skills = drawn
        return self._record(family, context, opened(text, context), plan, skills, (self.split,))

    def _record(
        self,
        family: str,
        context: Context,
        said: str,
        expected: dict[str, Any],
        skills: set[str],
        splits: Sequence[str],
    ) -> dict[str, Any] | None:
        """The sample without its id. Raises PlannerError when the plan is not strictly valid."""
        vocabulary, title = self.book.vocabulary, context.task.title
        if len(expected["skill_sequence"]) > LONGEST:
            return None
        said = aside(said, skills, context)
        if not self.unseen and split_of(f"{title} {skeleton(said)}") not in splits:
            return None
        problems = plan_problems("task", expected, vocabulary, strict=True)
        if problems:
            raise PlannerError(
                f"vocabulary {vocabulary.name}: a sample of {title} is not valid"
                f" ({problems[0]}); correct the phrase file's ranges"
            )
        if not self.unseen:
            calls = (
                call for step in expected["skill_sequence"] for _role, call in step_skills(step)
            )
            values = (value for call in calls for value in call["parameters"].values())
            # The plan has words of the prompt with their capitals.
            texts = any(isinstance(one[0] if isinstance(one, list) else one, str) for one in values)
            said = noisy(said, self.rng, shout=not texts)
        return {
            "family": family,
            "task": title,
            "parameters": canonical_parameters(context.parameters(), context.task),
            "prompt": plain(said),
            "expected": expected,
        }


# ---------------------------------------------------------------- words around a prompt


def opened(text: str, c: Context) -> str:
    """The prompt with a full stop, now and then behind polite words or the task's opener."""
    text = text if text[-1:] in ".!?" else f"{text}."
    command = text.partition(" ")[0].lower() in c.book.verbs
    if c.book.unseen or not command or c.rng.random() < 0.85:
        return text
    own = c.entry.openers if c.rng.random() < 0.7 else []
    opener = pick(own or WORDS["openers"], c.rng)
    return f"{opener[0].upper()}{opener[1:]} {text[0].lower()}{text[1:]}"


def aside(text: str, skills: set[str], c: Context) -> str:
    """The prompt, now and then with words that change nothing: background, a reason, a refusal."""
    book, rng, known, roll = c.book, c.rng, c.book.sentences, c.rng.random()
    if roll < 0.03 and "background" in known:
        remark = c.say(pick(known["background"], rng))
        return pick((f"{text} {remark}", f"{remark} {text}"), rng)
    if roll < 0.05 and "reason" in known:
        return f"{text[:-1]} {c.say(pick(known['reason'], rng))}."
    if roll < 0.075 and "nothing" in known and not book.unseen:
        return f"{text} {pick(known['nothing'], rng)}"
    if roll < 0.115 and not book.unseen:
        refused = [entry.none for name, entry in book.skills.items() if name not in skills]
        if phrases := [phrase for of_skill in refused for phrase in of_skill]:
            phrase = pick(phrases, rng)
            return pick(
                (f"{text} {phrase[0].upper()}{phrase[1:]}.", f"{text[:-1]}, {phrase}."), rng
            )
    elif roll < 0.14 and "negation" in known:
        idle = [name for name in c.task.skills.get("perception", ()) if name not in skills]
        if bare := [found for name in idle if (found := book.skills[name].bare)]:
            return (
                f"{text} {pick(known['negation'], rng).format(c.say(pick(pick(bare, rng), rng)))}"
            )
    return text
