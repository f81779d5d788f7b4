"""The task-level data set, sampled from a vocabulary.

    for record in sample_tasks(load_vocabulary(), seed=0, count=500, split="test"): ...

About half of the samples are drawn as a script (movements, filters, perception skills), said in a
prompt, and the label is derived from the script: exactly what the prompt says. The others come from
whole-prompt templates (prompts/). A prompt's skeleton, the prompt without its values, decides which
of train, validation and test may hold it, so that the splits share no sample even when numbers and
names are masked; a template belongs to one of them as a whole besides.
"""

from __future__ import annotations

import functools
import itertools
import random
import zlib
from collections.abc import Iterator
from typing import Any, Literal, get_args

from planner_ft.data.task import phrasing, sequences
from planner_ft.data.task.context import Context
from planner_ft.data.task.noise import noisy
from planner_ft.data.task.outline import outline
from planner_ft.data.task.phrasebook import Phrasebook
from planner_ft.data.task.phrasing import Script, Speaker, pick_weighted
from planner_ft.data.task.prompts.draw import draw_template, pick
from planner_ft.data.task.prompts.library import bound_lines, normal, parsed
from planner_ft.data.task.prompts.wordings import mask_key, wordings
from planner_ft.data.task.script import draw_script
from planner_ft.data.task.steps import expected_plan
from planner_ft.data.task.template import close_gaps, plain, skeleton
from planner_ft.data.task.terse import TERSE, unmoved
from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary.definition import Vocabulary
from planner_ft.vocabulary.plans import canonical_parameters, plan_problems

SINGLE = (*phrasing.SINGLE, *TERSE)

Split = Literal["train", "validation", "test", "test_unseen"]
SPLITS: tuple[Split, ...] = get_args(Split)

LONGEST = 24  # steps; longer answers are drawn anew
TRIES = 300  # draws from templates before the sample is drawn as a script instead
TEMPLATES = 0.5  # share of the samples that come from a whole-prompt template
HELD_OUT = 6  # percent of the skeletons that belong to validation, and as many to test


def sample_tasks(
    vocabulary: Vocabulary, seed: int, count: int | None, split: Split
) -> Iterator[dict[str, Any]]:
    """Yield `count` different records, or an endless stream when `count` is None; same seed, same
    records.

    Record: {"id", "family", "task", "parameters", "prompt", "expected"}, canonical and strictly
    valid. Raises PlannerError for an unknown split, or when the vocabulary has not enough different
    samples.
    """
    if split not in SPLITS:
        raise PlannerError(f"split {split}: must be {', '.join(SPLITS)}")
    rng = random.Random(f"{vocabulary.name}:{seed}:{split}")
    book = Phrasebook(vocabulary, unseen=split == "test_unseen")
    draws = Draws(book, rng, split)
    seen: set[int] = set()
    misses = 0
    numbers = itertools.count() if count is None else range(count)
    for number in numbers:
        from_template = bool(draws.templates) and rng.random() < TEMPLATES
        tries = 0
        while True:
            drawn = (
                draws.from_template() if from_template and tries < TRIES else draws.from_script()
            )
            key = hash_of(drawn["task"], drawn["parameters"], drawn["prompt"]) if drawn else 0
            if drawn and key not in seen:
                break
            tries, misses = tries + 1, misses + 1
            if misses > 2000 + 200 * (number + 1):
                raise PlannerError(
                    f"vocabulary {vocabulary.name}: split {split} has fewer than {count} different"
                    " samples; ask for fewer or add phrases"
                )
        seen.add(key)
        yield {"id": f"task-{split}-{number:06d}", **drawn}


def hash_of(*parts: Any) -> int:
    """A stable 64-bit digest of what makes a sample a duplicate."""
    data = repr(parts).encode()
    return zlib.crc32(data) << 32 | zlib.crc32(data[::-1])


def split_of(text: str) -> Split:
    """The split to which a skeleton of a training family belongs."""
    bucket = zlib.crc32(text.lower().encode()) % 100
    return "test" if bucket < HELD_OUT else "validation" if bucket < 2 * HELD_OUT else "train"


@functools.cache
def held_out_wordings() -> dict[str, Split]:
    """The masked wordings of the whole-prompt templates of validation and test, and whose they
    are.
    """
    splits = ((line, split_of(normal(line.source))) for line in parsed())
    return {key: split for line, split in splits if split != "train" for key in wordings(line)}


class Draws:
    """Single draws for one split, from scripts and from whole-prompt templates; None when one came
    to nothing or belongs to another split.
    """

    def __init__(self, book: Phrasebook, rng: random.Random, split: Split) -> None:
        self.book, self.rng, self.split = book, rng, split
        self.unseen = split == "test_unseen"
        self.templates = (
            []
            if self.unseen
            else [
                bounds for source, bounds in bound_lines(book) if split_of(normal(source)) == split
            ]
        )

    def from_template(self) -> dict[str, Any] | None:
        """One record without id from a whole-prompt template."""
        bound = pick(self.templates, self.rng)
        context = Context(self.book, bound.task, self.rng)
        drawn = draw_template(bound, context)
        if drawn is None or len(drawn[1]["skill_sequence"]) > LONGEST:
            return None
        text, expected, skills = drawn
        said = close_gaps(aside(Speaker(self.rng, self.book), text, skills, context))
        # A template of a held-out split is that split's in all its wordings; its masked wordings
        # are kept out of the others.
        whose = split_of(f"{bound.task.title} {skeleton(said)}")
        if whose not in ("train", self.split) or not self._may_hold(text):
            return None
        prompt = plain(noisy(said, self.rng, capitals=not has_texts(expected)))
        return record(f"template/{len(expected['skill_sequence'])}", context, prompt, expected)

    def from_script(self) -> dict[str, Any] | None:
        """One record without id from a script."""
        book, rng = self.book, self.rng
        tasks = book.vocabulary.tasks
        context = Context(book, tasks[int(rng.random() * len(tasks))], rng)
        script = draw_script(context)
        if script is None or sum(len(movement.steps) for movement in script.movements) > LONGEST:
            return None
        say = Speaker(rng, book)
        frame, text = say_it(say, script, context)
        said = close_gaps(aside(say, text, said_skills(script), context))
        if not self.unseen and (
            split_of(f"{context.task.title} {skeleton(said)}") != self.split
            or not self._may_hold(text)
        ):
            return None
        expected = expected_plan(script, book.vocabulary)
        prompt = plain(said if self.unseen else noisy(said, rng, capitals=not has_texts(expected)))
        family = f"{'unseen-' if self.unseen else ''}{frame}/{script.movements[0].kind}{len(script.movements)}"
        return record(family, context, prompt, expected)

    def _may_hold(self, text: str) -> bool:
        """Whether no held-out template of another split has this wording."""
        return held_out_wordings().get(mask_key(skeleton(text)), self.split) == self.split


def has_texts(expected: dict[str, Any]) -> bool:
    """Whether a plan has text values: words of the prompt that it holds with their capitals."""
    steps = expected["skill_sequence"]
    calls = [
        call
        for step in steps
        for call in (step["navigation_skill"], *step["filter_skills"], *step["perception_skills"])
    ]
    return any(
        isinstance(item, str)
        for call in calls
        for value in call["parameters"].values()
        for item in (value if isinstance(value, list) else [value])
    )


def said_skills(script: Script) -> set[str]:
    """The filters and perception skills of the script."""
    groups = [script.filters, script.perceptions, [scoped.call for scoped in script.scoped]]
    groups += [
        calls for movement in script.movements for calls in (movement.filters, movement.perceptions)
    ]
    return {call.skill for calls in groups for call in calls if call.skill}


def record(family: str, context: Context, prompt: str, expected: dict[str, Any]) -> dict[str, Any]:
    """The sample without its id. Raises PlannerError when the plan is not strictly valid."""
    vocabulary = context.book.vocabulary
    problems = plan_problems("task", expected, vocabulary, strict=True)
    if problems:
        raise PlannerError(
            f"vocabulary {vocabulary.name}: a sample of {context.task.title} is not valid"
            f" ({problems[0]}); correct the phrase file's ranges"
        )
    parameters = canonical_parameters(context.parameters(), context.task)
    return {
        "family": family,
        "task": context.task.title,
        "parameters": parameters,
        "prompt": prompt,
        "expected": expected,
    }


def say_it(say: Speaker, script: Script, context: Context) -> tuple[str, str]:
    """The name of the frame, and the prompt with its values marked."""
    unseen = context.book.unseen
    if script.movements[0].saying is None and len(script.movements) == 1:
        terse = not unseen and all(call.skill for call in script.perceptions) and say.chance(0.5)
        text = (unmoved if terse else phrasing.no_movement)(say, script.filters, script.perceptions)
        if unseen:
            text = (
                f"Here is what is wanted: {text[0].lower()}{text[1:]}"
                if text[0].isalpha()
                else text
            )
        return "no_movement", opened(say, text, context)
    if len(script.movements) == 1:
        single = pick_weighted(phrasing.UNSEEN_SINGLE if unseen else SINGLE, say.rng)
        text = single(say, script.movements[0], script.filters, script.perceptions)
        return single.__name__, opened(say, text, context)
    if script.scoped:
        return "outline", opened(say, outline(say, script), context)
    sequence = pick_weighted(sequences.UNSEEN_SEQUENCES if unseen else sequences.SEQUENCES, say.rng)
    return sequence.__name__, opened(say, sequences.say_script(say, script, sequence), context)


def opened(say: Speaker, text: str, context: Context) -> str:
    """The prompt, now and then with polite or official words before it, or with the task's own
    opener.
    """
    first_word = text.split(" ", 1)[0].lower()
    if context.book.unseen or first_word not in context.book.verbs or say.chance(0.85):
        return text
    openers = [
        "please ",
        "you are to ",
        "now ",
        "your task: ",
        "task: ",
        "I want you to ",
        "could you please ",
    ]
    if context.entry.openers and say.chance(0.7):
        openers = [f"{opener} " for opener in context.entry.openers]
    opener = say.pick(*openers)
    return phrasing.sentence(opener + text[0].lower() + text[1:])


def aside(say: Speaker, text: str, said: set[str], context: Context) -> str:
    """The prompt, now and then with a sentence that changes nothing: background, a reason, what is
    not wanted.
    """
    roll = say.rng.random()
    sentences = context.book.sentences
    if roll < 0.03 and sentences.get("background"):
        remark = context.book.say(say.pick(*sentences["background"]), say.rng)
        return f"{text} {remark}" if say.chance(0.5) else f"{remark} {phrasing.sentence(text)}"
    if roll < 0.05 and sentences.get("reason"):
        return f"{text[:-1]} {context.book.say(say.pick(*sentences['reason']), say.rng)}."
    if roll < 0.075 and sentences.get("nothing") and not context.book.unseen:
        return f"{text} {say.pick(*sentences['nothing'])}"
    if roll < 0.115 and not context.book.unseen:
        return _refusal(say, text, said, context)
    if roll < 0.14 and sentences.get("negation"):
        others = [
            name
            for name in context.task.skills.get("perception", ())
            if name not in said and context.book.skills[name].bare
        ]
        if others:
            templates = context.book.skills[say.pick(*others)].fitting(frozenset())
            refused = templates[int(say.rng.random() * len(templates))].render(
                context.slots(), say.rng
            )
            return f"{text} {say.pick(*sentences['negation']).format(refused)}"
    return text


def _refusal(say: Speaker, text: str, said: set[str], context: Context) -> str:
    """The prompt with a remark that a skill which it does not ask for is not wanted: "No
    recording.".
    """
    refused = [
        phrase
        for name, entry in context.book.skills.items()
        if name not in said
        for phrase in entry.none
    ]
    if not refused:
        return text
    phrase = say.pick(*refused)
    if text[-1] != "." or say.chance(0.5):
        return f"{text} {phrasing.sentence(phrase)}"
    return f"{text[:-1]}{say.pick(', ', '; ', ' - ')}{phrase}."
