"""Values that nobody said, and values that the command says and no task has."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from planner_ft.document.unused import unused_facts
from planner_ft.document.warnings.warning import Warning, named, warning
from planner_ft.facts import SCORING, WAYPOINT, Facts, Input, is_number, read_input
from planner_ft.vocabulary import Parameter, Vocabulary
from planner_ft.vocabulary.plans import step_skills


def value_warnings(document: Mapping[str, Any], vocabulary: Vocabulary) -> Iterator[Warning]:
    """Values of tasks and skills that are the model's own, and stated ones that reached no task."""
    source = read_input({"prompt": document["command"]}, vocabulary)
    said = source.facts
    if said.unread:
        text = (
            "The command has words or numbers that could not be read with certainty; values of the"
            " plan are not all checked against it."
        )
        yield warning("unread-command", text)
    for task in document["tasks"]:
        yield from _unsaid(task, source)
        yield from _unsaid_skills(task, _proposed(document, task), said, vocabulary)
    if document["tasks"] and not said.unread:
        texts = [
            *(task["task_prompt"] for task in document["tasks"]),
            *document.get("assumptions", ()),
            *document.get("constraints", ()),
        ]
        for words in unused_facts(document["command"], document["tasks"], texts, vocabulary):
            yield warning(
                "value-lost",
                f'The command says "{words}", and no task has it.',
                about=words.casefold(),
            )


def _unsaid(task: Mapping[str, Any], command: Input) -> Iterator[Warning]:
    known = command.vocabulary.task[task["title"]].by_name
    for name, source in task.get("sources", {}).items():
        value = task["parameters"][name]
        if (
            source["kind"] == "model"
            and name in known
            and command.facts.evidence(value, known[name]).given is False
        ):
            yield warning(
                "value-not-said",
                f"{named(task)}: {name} is {_shown(value, known[name])}, which the command does not"
                " say.",
                task,
                name,
            )


# ---------------------------------------------------------------- skills


def _proposed(document: Mapping[str, Any], task: Mapping[str, Any]) -> list[dict[str, Any]]:
    """The steps that the model proposed for a task."""
    tasks = document.get("proposed", {"tasks": ()})["tasks"]
    return next((other["skill_sequence"] or [] for other in tasks if other["id"] == task["id"]), [])


def _unsaid_skills(
    task: Mapping[str, Any], proposed: list[dict[str, Any]], said: Facts, vocabulary: Vocabulary
) -> Iterator[Warning]:
    """One per skill and parameter of a task, unless an operator has changed the value."""
    steps = task.get("skill_sequence") or []
    if not steps or task.get("stale"):
        return
    record = {
        "prompt": task["task_prompt"],
        "task": task["title"],
        "parameters": task["parameters"],
    }
    source, before = read_input(record, vocabulary), list[tuple[float, float]]()
    own = [value for value in task["parameters"].values() if isinstance(value, list)]
    told: set[str] = set()
    for number, step in enumerate(steps):
        edited = number < len(proposed) and step != proposed[number]
        for skill_name, parameter, value in _values(step, vocabulary):
            key = f"{skill_name}.{parameter.name}"
            if (
                key in told
                or (
                    edited
                    and not _stands(skill_name, parameter, value, proposed[number], vocabulary)
                )
                or value in own
            ):
                continue
            found = source.evidence(value, parameter, SCORING, before)
            if parameter is WAYPOINT:
                before.append((value[0], value[1]))
            if found.given is False and not said.evidence(value, parameter).given:
                told.add(key)
                text = (
                    f"{named(task)}: {skill_name} has {parameter.name} {_shown(value, parameter)},"
                    " which neither command nor task says or leads to."
                )
                yield {
                    **warning("skill-value-not-said", text, task, about=key),
                    "parameter": parameter.name,
                }


def _values(
    step: Mapping[str, Any], vocabulary: Vocabulary
) -> Iterator[tuple[str, Parameter, Any]]:
    """Values of a step's skills with parameters; a destination's coordinates as one."""
    for _role, skill in step_skills(step):
        known = vocabulary.skill[skill["name"]].by_name
        motion = vocabulary.motion.of(skill["name"])
        pair = (
            [motion.parameters["x"], motion.parameters["y"]]
            if motion and motion.kind == "go"
            else []
        )
        if pair and all(is_number(skill["parameters"].get(name)) for name in pair):
            yield skill["name"], WAYPOINT, [skill["parameters"][name] for name in pair]
        for name, value in skill["parameters"].items():
            if name not in pair and name in known:
                yield skill["name"], known[name], value


def _stands(
    skill_name: str,
    parameter: Parameter,
    value: Any,
    step: Mapping[str, Any],
    vocabulary: Vocabulary,
) -> bool:
    return any(
        (skill_name, parameter.name, value) == (name, other.name, proposed)
        for name, other, proposed in _values(step, vocabulary)
    )


def _shown(value: Any, parameter: Parameter) -> str:
    text = f"{value:g}" if is_number(value) else str(value)
    return f"{text[:60]}{f' {parameter.unit}' if is_number(value) and parameter.unit not in (None, 'count') else ''}"
