"""The task-level data set, sampled from a vocabulary, and tasks as the Mission Agent hands them on.

    for record in sample_tasks(load_vocabulary(), seed=0, count=500, split="test"): ...

About half of the samples are put together (compose.py): movements, filters and perception skills of
a task, each in a clause of the phrase file, and the label is exactly what the clauses say. The
others come from whole-prompt templates (prompts/), which belong to one of the splits each. The
skeleton of a prompt, its text without the values, and its task decide which of train, validation and
test may hold it. That does not keep all texts apart: two tasks may have a short one in common, and
noise is drawn later. So what would repeat the training split is drawn again.

The sampler's prompts say what to do skill by skill; a task prompt of a synthetic mission says what
is wanted ("Circle the met mast at [120, -35] at a stand-off of 25 m."), and `skills` in
NAME.missions.toml says what that comes to. Unresolved places and the vehicle's defaults are filled
in first, as they are before the Task Agent runs. A task whose geometry its parameters leave open (a
grid without a size) is left out: no number is made up.
"""

import functools
import itertools
import zlib
from collections.abc import Iterator, Sequence, Set
from random import Random
from typing import Any, Literal, get_args

from planner_ft.data.leakage import forms
from planner_ft.data.mission_plan import Beside
from planner_ft.data.missions import missions_with_skills
from planner_ft.data.numbers import pick
from planner_ft.data.task.binding import Bound, bind, binding, titles
from planner_ft.data.task.compose import WORDS, composed
from planner_ft.data.task.draw import Context, draw_template
from planner_ft.data.task.phrasebook import Phrasebook, phrasebook
from planner_ft.data.task.steps import Plan, entry_of
from planner_ft.data.templates.grammar import TemplateError, parse_plan
from planner_ft.data.templates.records import Template, templates
from planner_ft.data.templates.render import noisy, plain, skeleton
from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary.definition import MISSIONS, Vocabulary
from planner_ft.vocabulary.essentials import essentials_of
from planner_ft.vocabulary.plans import canonical_parameters, named_entries, plan_problems

Split = Literal["train", "validation", "test", "test_unseen"]
SPLITS: tuple[Split, ...] = get_args(Split)

LONGEST = 24
"""Steps; longer answers are left out."""
TRANSITS = 0.3
"""Share of the bare Transits that are kept: every third task is one, and all are alike."""
AT = "at"
"""A label and a slot: the place of the task before."""
TEMPLATES = 0.5
"""Share of the samples that come from a whole-prompt template."""
HELD_OUT = 12
"""Percent of the skeletons that belong to validation, and as many to test."""


def sample_tasks(
    vocabulary: Vocabulary,
    seed: int,
    count: int | None,
    split: Split,
    subjects: Sequence[str] = (),
    apart: Set[str] = frozenset(),
) -> Iterator[dict[str, Any]]:
    """Yield `count` different records, or an endless stream when `count` is None; same seed, same
    records. With `subjects` they come from the whole-prompt templates of these subjects alone. No
    prompt has one of the `forms` that are `apart`.

    Record: {"id", "family", "task", "parameters", "prompt", "expected"}, canonical and strictly
    valid. Raises PlannerError for an unknown split, for subjects without a template, or when the
    vocabulary has not enough different samples.
    """
    if split not in SPLITS:
        raise PlannerError(f"split {split}: must be {', '.join(SPLITS)}")
    rng = Random(f"{vocabulary.name}:{seed}:{split}")
    book = phrasebook(vocabulary, unseen=split == "test_unseen")
    groups = [] if book.unseen else templates(vocabulary, "prompts", split, subjects)
    if subjects and not groups:
        raise PlannerError(
            f"vocabulary {vocabulary.name}: split {split} has no prompt templates of"
            f" {', '.join(subjects)}; a subject is the name of a file of templates"
        )
    share, seen, misses = 1.0 if subjects else TEMPLATES, set[int](), 0
    for number in itertools.count() if count is None else range(count):
        whole = bool(groups) and rng.random() < share
        while True:
            if drawn := _record(book, split, groups if whole else [], rng):
                key = hash((drawn["task"], repr(drawn["parameters"]), drawn["prompt"]))
                if key not in seen and not (apart and apart & {*forms(drawn["prompt"])}):
                    break
            misses += 1
            if misses > 5000 + 500 * (number + 1):
                raise PlannerError(
                    f"vocabulary {vocabulary.name}: split {split} has fewer than {count} different"
                    f" samples{' that are not in train' if apart else ''}; ask for fewer or add"
                    " phrases"
                )
        seen.add(key)
        yield {"id": f"task-{split}-{number:06d}", **drawn}


def _record(
    book: Phrasebook, split: Split, groups: Sequence[Sequence[Template]], rng: Random
) -> dict[str, Any] | None:
    """A record without id from a whole-prompt template or, without any, put together; None for a
    draw that comes to nothing or belongs to another split. Raises PlannerError when the plan is not
    strictly valid.
    """
    vocabulary, splits = book.vocabulary, {split, *(("train",) if groups else ())}
    if groups:
        template = pick(pick(groups, rng), rng)
        title = pick(titles(template, vocabulary), rng)
        if (bound := binding(template, title, book)) is None:
            return None
        context = Context(book, vocabulary.task[title], rng)
        drawn = draw_template(bound, context)
    else:
        context = Context(book, pick(vocabulary.tasks, rng), rng)
        drawn = composed(context)
    if drawn is None or len(drawn.steps) > LONGEST:
        return None
    said, title, expected = drawn.text, context.task.title, {"skill_sequence": drawn.steps}
    said = aside(said if groups else opened(said, context), drawn.skills, context)
    bucket = zlib.crc32(f"{title} {skeleton(said)}".lower().encode()) % 100
    held_out = "test" if bucket < HELD_OUT else "validation"
    if not book.unseen and (held_out if bucket < 2 * HELD_OUT else "train") not in splits:
        return None
    if problems := plan_problems("task", expected, vocabulary, strict=True):
        raise PlannerError(
            f"vocabulary {vocabulary.name}: a sample of {title} is not valid"
            f" ({problems[0]}); correct the phrase file's ranges"
        )
    if not book.unseen:
        values = (one for _name, of in named_entries("task", expected) for one in of.values())
        # The plan has words of the prompt with their capitals.
        texts = any(isinstance(one[0] if isinstance(one, list) else one, str) for one in values)
        said = noisy(said, rng, shout=not texts)
    return {
        "family": f"unseen-{drawn.family}" if book.unseen else drawn.family,
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
    own = c.entry.config.get("openers", []) if c.rng.random() < 0.7 else []
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
            more = pick(phrases, rng)
            return pick((f"{text} {more[0].upper()}{more[1:]}.", f"{text[:-1]}, {more}."), rng)
    elif roll < 0.14 and "negation" in known:
        idle = [name for name in c.task.skills.get("perception", ()) if name not in skills]
        if bare := [found for name in idle if (found := book.skills[name].bare)]:
            form = pick(known["negation"], rng)
            return f"{text} {form.format(c.say(pick(pick(bare, rng), rng)))}"
    return text


# ---------------------------------------------------------------- tasks of missions


def mission_tasks(vocabulary: Vocabulary, seed: int) -> Iterator[dict[str, Any]]:
    """Endless task records from synthetic missions; the same seed gives the same records.

    Raises PlannerError for a vocabulary of which no task says what it comes to.
    """
    if not any(_meanings(vocabulary, title) for title in vocabulary.task):
        raise PlannerError(
            f"vocabulary {vocabulary.name}: no task in {vocabulary.name}{MISSIONS} says with"
            " skills = [...] what it comes to"
        )
    locate, transit = vocabulary.task[vocabulary.locate], vocabulary.transit
    described = next(item.name for item in locate.parameters if item.type == "text")
    for mission, beside in missions_with_skills(seed, None, vocabulary):
        rng = Random(f"{seed}:{mission['id']}")
        place: list[float] = [rng.randrange(-200, 201, 5), rng.randrange(-200, 201, 5)]
        subject, at = None, None
        for number, entry in enumerate(mission["expected"]["tasks"]):
            title, parameters = entry["title"], entry["parameters"]
            bare = title == transit and not beside[number]
            if (not bare or rng.random() <= TRANSITS) and (
                record := task_record(entry, subject, place, vocabulary, beside[number], at)
            ):
                name = f"mission-task-{mission['id']}-{number}"
                yield {"id": name, "family": f"mission-task/{title}", **record}
            at = parameters.get(vocabulary.task[title].position_parameter, at)
            subject = parameters[described] if title == locate.title else subject


def task_record(
    entry: dict[str, Any],
    subject: str | None,
    place: list[float],
    vocabulary: Vocabulary,
    added: Sequence[Beside] = (),
    at: Sequence[float] | None = None,
) -> dict[str, Any] | None:
    """The record of one task of a plan, its open place filled in; None where the geometry is left
    open.

    `subject` is the target that was searched last, which a task at a place that has been found is
    about; `added` are the skills that clauses of the command put beside the task; `at` is where the
    task before was, the place of a structure pass whose prompt names it.
    """
    task = vocabulary.task[entry["title"]]
    values = {
        name: list(place) if value == list(vocabulary.unresolved) else value
        for name, value in entry["parameters"].items()
    }
    values = {**essentials_of(task.title, vocabulary).defaults, **values}
    known = {item.name: subject for item in task.parameters if item.type == "id" and subject}
    known |= values | ({AT: at} if at and str(list(at)) in entry["task_prompt"] else {})
    filters, perceptions = (
        [entry_of(name, given, vocabulary) for kind, name, given in added if kind == role]
        for role in ("filter", "perception")
    )
    meanings = _meanings(vocabulary, task.title)
    bound = next((bound for bound, labels in meanings if labels <= known.keys()), None)
    if bound is None:
        return None
    book = phrasebook(vocabulary, unseen=False)
    plan = Plan(bound, book, known.keys(), lambda one: known.get(str(one.value)))
    try:
        expected = {"skill_sequence": plan.steps((filters, perceptions))}
    except ValueError:
        return None
    long = len(expected["skill_sequence"]) > LONGEST
    if long or plan_problems("task", expected, vocabulary, strict=True):
        return None
    given = {"task": task.title, "parameters": canonical_parameters(values, task)}
    return {**given, "prompt": entry["task_prompt"], "expected": expected}


@functools.cache
def _meanings(vocabulary: Vocabulary, title: str) -> list[tuple[Bound, set[str]]]:
    """What a task comes to, with the parameters that this needs: the first that fits counts."""
    found = []
    for plan in vocabulary.beside(MISSIONS).get("task", {}).get(title, {}).get("skills", ()):
        where = f"{vocabulary.name}{MISSIONS}: [task.{title}] skills"
        calls = (call for step in parse_plan(plan) for call in step.calls())
        labels = {call.label for call in calls if call.label}
        text = "".join(f"{{?{label}}}" for label in labels) + (f"{{{AT}}}" if AT in labels else "")
        template = Template("", "train", text, plan, where)
        try:
            bound = bind(template, vocabulary.task[title], phrasebook(vocabulary, unseen=False))
        except TemplateError as error:
            raise template.error(error) from None
        found.append((bound, labels))
    return found
