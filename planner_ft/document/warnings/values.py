"""Values that nobody said, and values that the command says and no task has."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from planner_ft.document.unused import unused_facts
from planner_ft.document.warnings.command import UNKNOWN
from planner_ft.document.warnings.warning import Warning, named, warning
from planner_ft.facts import SCORING, WAYPOINT, Facts, Input, is_number, read_input, unknown_words
from planner_ft.planning.frame import frame_of
from planner_ft.vocabulary import Parameter, Vocabulary
from planner_ft.vocabulary.plans import step_skills


def value_warnings(document: Mapping[str, Any], vocabulary: Vocabulary) -> Iterator[Warning]:
    """Values of tasks and skills that are the model's own, and stated ones that reached no task."""
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
    if document["tasks"] and not said.unread:
        texts = [task["task_prompt"] for task in document["tasks"]]
        texts += [*document.get("assumptions", ()), *document.get("constraints", ())]
        for words in unused_facts(command, document["tasks"], texts, vocabulary):
            text = f'The command says "{words}", and no task has it.'
            yield warning("value-lost", text, about=words.casefold())


def _unsaid(task: Mapping[str, Any], command: Input) -> Iterator[Warning]:
    known = command.vocabulary.task[task["title"]].by_name
    for name, source in task.get("sources", {}).items():
        if source["kind"] != "model" or name not in known:
            continue
        value, parameter = task["parameters"][name], known[name]
        if command.facts.evidence(value, parameter).given is False:
            text = f"{name} is {_shown(value, parameter)}, which the command does not say."
            yield warning("value-not-said", f"{named(task)}: {text}", task, name)


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
