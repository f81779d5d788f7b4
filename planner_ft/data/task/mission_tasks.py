"""Task inputs as the Mission Agent writes them: the tasks of synthetic missions, each with the
skills that it stands for.

The sampler's prompts say what to do skill by skill; a task prompt that comes from a mission plan
says what is wanted ("Circle the met mast at [120, -35] at a stand-off of 25 m."), and `skills` in
NAME.missions.toml says what that comes to. Unresolved places and the vehicle's defaults
are filled in first, as they are before the Task Agent runs. A task whose geometry its parameters
leave open (a grid without a size) is left out: no number is made up.
"""

from __future__ import annotations

import functools
from collections.abc import Iterator, Sequence
from random import Random
from typing import Any

from planner_ft.data.clauses import Beside
from planner_ft.data.missions import missions_with_skills
from planner_ft.data.task.binding import Bound, bind
from planner_ft.data.task.phrasebook import phrasebook
from planner_ft.data.task.steps import Plan, entry_of
from planner_ft.data.templates.grammar import TemplateError, parse_plan
from planner_ft.data.templates.records import Template
from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.definition import MISSIONS
from planner_ft.vocabulary.essentials import essentials_of
from planner_ft.vocabulary.plans import canonical_parameters, plan_problems

TRANSITS = 0.3
"""Share of the bare Transits that are kept: every third task is one, and all are alike."""
AT = "at"
"""A label and a slot: the place of the task before."""
LONGEST = 24
"""Steps; longer answers are left out."""


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
            if not bare or rng.random() <= TRANSITS:
                record = task_record(entry, subject, place, vocabulary, beside[number], at)
                named = {"id": f"mission-task-{mission['id']}-{number}"}
                yield from (
                    [{**named, "family": f"mission-task/{title}", **record}] if record else ()
                )
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
    plan = Plan(
        bound,
        phrasebook(vocabulary, unseen=False),
        known.keys(),
        lambda argument: known.get(str(argument.value)),
        (filters, perceptions),
    )
    try:
        steps = plan.steps()
    except ValueError:
        return None
    expected = {"skill_sequence": steps}
    if len(steps) > LONGEST or plan_problems("task", expected, vocabulary, strict=True):
        return None
    return {
        "task": task.title,
        "parameters": canonical_parameters(values, task),
        "prompt": entry["task_prompt"],
        "expected": expected,
    }


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
