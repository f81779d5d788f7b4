"""What the vehicle adds to the agents' answers: values, skills, and what must be asked.

A document keeps both apart from the model's: `defaults` of a task are the values by parameter,
`added` has an entry per skill, {"step" (from 0), "role", "name", "kind": "vehicle"}, with
"parameter" where the skill is the model's and this value of it the vehicle's.
"""

import copy
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from planner_ft.planning.limits import forbidden_skills, kept_off
from planner_ft.vocabulary import Parameter, Skill, Vocabulary
from planner_ft.vocabulary.essentials import essentials_of
from planner_ft.vocabulary.plans import canonical_parameters, step_skills

TaskEntry = Mapping[str, Any]
Step = dict[str, Any]
Added = list[dict[str, Any]]
"""Entries of `added`, in the order of the steps."""
Completed = tuple[list[Step], Added]
"""Steps, and what was added to them."""
VEHICLE = "vehicle"
"""The kind of what stands in a plan because the vehicle's essentials say so."""


def missing_defaults(task: TaskEntry, vocabulary: Vocabulary) -> dict[str, Any]:
    """The vehicle's values for parameters that a task leaves out; a stand-off is as large as limits
    in its prompt want it.
    """
    defaults = essentials_of(task["title"], vocabulary).defaults
    missing = {name: value for name, value in defaults.items() if name not in task["parameters"]}
    circle = vocabulary.motion.standoff(task["title"])
    if circle and circle.radius in missing:
        missing[circle.radius] = max(missing[circle.radius], kept_off(task, vocabulary))
    return missing


def with_defaults(task: TaskEntry, vocabulary: Vocabulary) -> dict[str, Any]:
    """The task with the vehicle's values where it states none."""
    given = {**task["parameters"], **copy.deepcopy(missing_defaults(task, vocabulary))}
    known = vocabulary.task.get(task["title"])
    return {**task, "parameters": canonical_parameters(given, known)}


def asked(task: TaskEntry, vocabulary: Vocabulary) -> list[str]:
    """The parameters that a task needs from the operator; an unresolved position is no such one."""
    needed = essentials_of(task["title"], vocabulary).asks
    return [name for name in needed if name not in task["parameters"]]


def question(number: int, task: TaskEntry, vocabulary: Vocabulary) -> str | None:
    """The question for what a task needs from the operator; None where it needs nothing."""
    names = asked(task, vocabulary)
    if not names:
        return None
    known = vocabulary.task[task["title"]].by_name
    wanted = [f"{name} ({_described(known[name])})" for name in names]
    listed = " and ".join(filter(None, (", ".join(wanted[:-1]), wanted[-1])))
    return f"Task {number}, {task['title']}: which {listed}?"


def _described(parameter: Parameter) -> str:
    unit = f"in {parameter.unit}" if parameter.unit not in (None, "count") else ""
    parts = (parameter.description or parameter.type, unit, parameter.bounds)
    return ", ".join(filter(None, parts))


# ---------------------------------------------------------------- skills


def with_essentials(task: TaskEntry, steps: Sequence[Step], vocabulary: Vocabulary) -> Completed:
    """The steps of a task with the skills that are essential to it, and what was added.

    A skill that stands in one step alone takes values that it lacks from the task. What a limit in
    the task prompt forbids is not added.
    """
    needed = essentials_of(task["title"], vocabulary)
    forbidden = forbidden_skills(task.get("task_prompt", ""), vocabulary)
    completed, added = copy.deepcopy(list(steps)), Added()
    for index in performing(task["title"], completed, vocabulary) or range(len(completed)):
        for name, parameters in needed.skills.items():
            step, skill = completed[index], vocabulary.skill[name]
            standing = [own for _role, own in step_skills(step) if own["name"] == name]
            if standing:
                added += _completed(standing[0], parameters, _mark(index, skill))
            elif skill.role != "navigation" and name not in forbidden:
                _add(step, skill, parameters)
                added.append(_mark(index, skill))
    given = task["parameters"]
    for name, takes in needed.takes.items():
        skills = ((at, own) for at, step in enumerate(completed) for _, own in step_skills(step))
        places = [(at, own) for at, own in skills if own["name"] == name]
        if len(places) == 1:
            (index, own), values = places[0], {key: given.get(of) for key, of in takes.items()}
            mark = _mark(index, vocabulary.skill[name])
            # A skill that was added is the vehicle's with its values.
            taken = list(_completed(own, values, mark))
            added += [] if mark in added else taken
    return completed, added


def _mark(step: int, skill: Skill) -> dict[str, Any]:
    return {"step": step, "role": skill.role, "name": skill.name, "kind": VEHICLE}


def _completed(
    skill: dict[str, Any], values: Mapping[str, Any], mark: Mapping[str, Any]
) -> Iterator[dict[str, Any]]:
    """Give a skill the values that it lacks; yields the mark of each."""
    for key, value in values.items():
        if value is not None and key not in skill["parameters"]:
            skill["parameters"][key] = copy.deepcopy(value)
            yield {**mark, "parameter": key}


def performing(title: str, steps: Sequence[Step], vocabulary: Vocabulary) -> list[int]:
    """The steps (from 0) that perform a task: those of its motions; an approach is none."""
    during = essentials_of(title, vocabulary).during
    motions = [vocabulary.skill[step["navigation_skill"]["name"]].motion for step in steps]
    performs = (motion in during if during else motion != "goto" for motion in motions)
    return [index for index, one in enumerate(performs) if one]


def _add(step: Step, skill: Skill, parameters: Mapping[str, Any]) -> None:
    entry = {"name": skill.name, "parameters": copy.deepcopy(dict(parameters))}
    step[f"{skill.role}_skills"].append(entry)
    for key, text in (("failure_modes", skill.failure), ("expected_outputs", skill.output)):
        if text and text not in step[key]:
            step[key].append(text)


# ---------------------------------------------------------------- what is still the vehicle's


def kept_defaults(task: TaskEntry) -> dict[str, Any]:
    """`defaults` of a document's task without what was changed or removed since."""
    given, defaults = task["parameters"], task.get("defaults", {})
    return {key: value for key, value in defaults.items() if given.get(key) == value}


def kept_additions(task: TaskEntry) -> Added:
    """`added` of a document's task without what was removed since."""
    steps = task["skill_sequence"] or []
    marks = (mark for mark in task.get("added", ()) if mark["step"] < len(steps))
    return [mark for mark in marks if _stands(mark, steps)]


def _stands(mark: Mapping[str, Any], steps: Sequence[Step]) -> bool:
    skills = [own for _role, own in step_skills(steps[mark["step"]]) if own["name"] == mark["name"]]
    return any("parameter" not in mark or mark["parameter"] in own["parameters"] for own in skills)


def added_text(task: TaskEntry) -> str:
    """What the vehicle added to a document's task, in words; empty where it added nothing."""
    parts = [f"{name} {value}" for name, value in task.get("defaults", {}).items()]
    steps: dict[str, list[int]] = {}
    for mark in task.get("added", ()):
        if mark["kind"] == VEHICLE:
            name = f"{mark['name']}.{mark['parameter']}" if "parameter" in mark else mark["name"]
            steps.setdefault(name, []).append(mark["step"] + 1)
    count = len(task["skill_sequence"] or ())
    names: dict[str, list[str]] = {}
    for name, numbers in steps.items():
        listed = f"step{'s' * (len(numbers) > 1)} {', '.join(map(str, numbers))}"
        names.setdefault("every step" if len(numbers) == count > 1 else listed, []).append(name)
    parts += [f"{', '.join(some)} in {where}" for where, some in names.items()]
    return "; ".join(parts)
