"""Values that nobody said."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from typing import Any

from planner_ft.document.warnings.command import UNKNOWN
from planner_ft.document.warnings.warning import Warning, named, quoted, warning
from planner_ft.facts import (
    SCORING,
    WAYPOINT,
    Evidence,
    Facts,
    Input,
    is_number,
    is_place,
    read,
    read_input,
    unknown_words,
)
from planner_ft.planning.frame import frame_of
from planner_ft.planning.passes import pass_ends
from planner_ft.planning.shapes import shape_points
from planner_ft.vocabulary import Parameter, Vocabulary
from planner_ft.vocabulary.plans import step_skills

BARE = re.compile(r"[-−–]?\d+(?:\.\d+)?")
"""A number without a unit."""


def value_warnings(document: Mapping[str, Any], vocabulary: Vocabulary) -> Iterator[Warning]:
    """Values of tasks and skills that are the model's own."""
    command = frame_of(document).spoken
    source = read_input({"prompt": command}, vocabulary)
    said = source.facts
    if said.unread and unknown_words(said.text)[1] < UNKNOWN:
        unread = "has words or numbers that could not be read with certainty"
        unchecked = "values of the plan are not all checked against it"
        yield warning("unread-command", f"The command {unread}; {unchecked}.")
    for task in document["tasks"]:
        yield from _unsaid(task, source)
        yield from _unsaid_skills(task, _proposed(document, task), said, vocabulary)


def _unsaid(task: Mapping[str, Any], command: Input) -> Iterator[Warning]:
    known = command.vocabulary.task[task["title"]].by_name
    prompt = read(task["task_prompt"])
    for name, source in task.get("sources", {}).items():
        if source["kind"] not in ("model", "command") or name not in known:
            continue
        value, parameter = task["parameters"][name], known[name]
        text, evidence = _shown(value, parameter), command.facts.evidence(value, parameter)
        if source["kind"] == "command" and is_number(value) and _is_coordinate(evidence, command):
            text = f"{name} is {text}, which the command says as a coordinate alone."
            yield warning("value-not-said", f"{named(task)}: {text}", task, name)
        elif source["kind"] == "command" and _contradicts(prompt, value, parameter):
            text = f'{name} is {text}, and its prompt is "{quoted(task["task_prompt"])}".'
            yield warning("contradiction", f"{named(task)}: {text}", task, name)
        elif source["kind"] == "model" and evidence.given is False:
            text = f"{name} is {text}, which the command does not say."
            yield warning("value-not-said", f"{named(task)}: {text}", task, name)


def _contradicts(prompt: Facts, value: Any, parameter: Parameter) -> bool:
    """Whether a task prompt has another measure or place where the value of its task should be."""
    if is_number(value):
        unit = parameter.unit
        other = any(number.unit == unit is not None for number in prompt.numbers(unit))
    else:
        other = is_place(value) and any(place.certain for place in prompt.positions)
    return other and prompt.evidence(value, parameter, SCORING).given is False


def _is_coordinate(evidence: Evidence, command: Input) -> bool:
    """Whether a number stands in the command as a part of positions and nowhere else."""
    text, places = command.facts.text, [one for one in command.facts.positions if one.certain]
    return bool(evidence.mentions) and all(
        BARE.fullmatch(text, start, end)
        and any(place.start <= start and end <= place.end for place in places)
        for spans in evidence.mentions
        for start, end in spans
    )


def worked_out_warnings(document: Mapping[str, Any], vocabulary: Vocabulary) -> Iterator[Warning]:
    """Places that are only worked out: in a plan that has lost a value they are hardly meant."""
    for number, task in enumerate(document["tasks"], start=1):
        for name, source in task.get("sources", {}).items():
            value = task["parameters"].get(name)
            known = not is_place(value) or "spans" in source or value == list(vocabulary.unresolved)
            if source["kind"] == "derived" and not known:
                text = f"task {number}, {task['title']}: {name} is {value}, which is worked out and"
                yield warning("value-not-said", f"{text} not said.", task, name)


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
    own = task["parameters"]
    record = {"prompt": task["task_prompt"], "task": task["title"], "parameters": own}
    source, before = read_input(record, vocabulary), list[tuple[float, float]]()
    known = [value for value in own.values() if isinstance(value, list)]
    shape = [*(pass_ends(task, vocabulary) or ()), *shape_points(task, vocabulary)]
    known += [list(point) for point in shape]
    warned: set[str] = set()
    added = {(mark["step"], mark["name"]) for mark in task.get("added", ())}
    for number, step in enumerate(steps):
        values = list(_values(step, vocabulary))
        values = [entry for entry in values if (number, entry[0]) not in added]
        if number < len(proposed) and step != proposed[number]:
            models = list(_values(proposed[number], vocabulary))
            values = [entry for entry in values if entry in models]
        for skill, parameter, value in values:
            key = f"{skill}.{parameter.name}"
            if key in warned or value in known:
                continue
            found = source.evidence(value, parameter, SCORING, before)
            if parameter is WAYPOINT:
                before.append((value[0], value[1]))
            if found.given is False and not said.evidence(value, parameter).given:
                warned.add(key)
                text = f"{named(task)}: {skill} has {parameter.name} {_shown(value, parameter)},"
                text += " which neither command nor task says or leads to."
                made = warning("skill-value-not-said", text, task, about=key)
                yield {**made, "parameter": parameter.name}


def _values(step: Mapping[str, Any], known: Vocabulary) -> Iterator[tuple[str, Parameter, Any]]:
    """Values of a step's skills with parameters; a destination's coordinates as one."""
    for _role, skill in step_skills(step):
        name, given, motion = skill["name"], skill["parameters"], known.motion.of(skill["name"])
        goes = motion if motion and motion.kind == "go" else None
        pair = [goes.parameters["x"], goes.parameters["y"]] if goes else []
        if pair and all(is_number(given.get(key)) for key in pair):
            yield name, WAYPOINT, [given[key] for key in pair]
        parameters = known.skill[name].by_name
        for key, value in given.items():
            if key not in pair and key in parameters:
                yield name, parameters[key], value


def _shown(value: Any, parameter: Parameter) -> str:
    if not is_number(value):
        return str(value)[:60]
    return f"{value:g} {parameter.unit}" if parameter.unit not in (None, "count") else f"{value:g}"
