"""Edits as an operator types them: "2.radius=15", "move 3 1", "locate green buoy=120,-35"."""

from __future__ import annotations

import json
import re
import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from planner_ft.document import PlanDocument
from planner_ft.document.confidence import LETTERS
from planner_ft.planning.locations import parse_location
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_text
from planner_ft.vocabulary import Parameter, Vocabulary
from planner_ft.vocabulary.plans import step_skills

Edit = dict[str, Any]

HELP: dict[str, str] = tomllib.loads(read_text(Path(__file__).with_name("commands.toml")))
"""Examples of edits, with their effect."""
CHOICE = re.compile(rf"(\d)([{LETTERS}])")
VALUE = re.compile(r"(\d+(?:\.[\w#]+)+)\s*=\s*(.*)", re.DOTALL)


def parse_edit(text: str, document: PlanDocument, vocabulary: Vocabulary) -> Edit:
    """The edit for planner_ft.document, or {"kind": "undo"}, {"kind": "ask", "tasks": ids}.

    Raises PlannerError that says what was expected.
    """
    text = text.strip()
    assigned = VALUE.fullmatch(text)
    if assigned:
        return _assignment(assigned[1].split("."), assigned[2].strip(), document, vocabulary)
    if chosen := CHOICE.fullmatch(text):
        return _choice(int(chosen[1]), chosen[2], document)
    word, rest = [*text.split(maxsplit=1), "", ""][:2]
    match word.lower():
        case "remove":
            return _remove(rest, document)
        case "move":
            return _move(rest, document)
        case "locate":
            return _locate(rest, document)
        case "prompt":
            return _prompt(rest, document)
        case "insert":
            return _insert(rest, vocabulary)
        case "origin":
            return {"kind": "origin", "place": rest}
        case "constraint":
            return _constraint(rest)
        case "skills":
            return {"kind": "ask", "tasks": _asked(rest, document)}
        case "undo" if not rest:
            return {"kind": "undo"}
        case "undo":
            raise PlannerError(f"{text}: takes the last edit back and needs nothing after it")
    raise PlannerError(f"{text!r}: is no edit; there is {', '.join(HELP)}")


def _choice(number: int, letter: str, document: PlanDocument) -> Edit:
    """The alternative of a question."""
    asked = document.get("choices", [])
    if not 1 <= number <= len(asked):
        there = f"there are {len(asked)}" if asked else "there are none"
        raise PlannerError(f"{number}{letter}: is no question of the plan; {there}")
    choice, at = asked[number - 1], LETTERS.index(letter)
    if at >= len(choice["others"]):
        last = f"{number}{LETTERS[len(choice['others']) - 1]}"
        raise PlannerError(f"{number}{letter}: the question has no such answer; the last is {last}")
    value, task = choice["others"][at], choice["task"]
    if choice["parameter"] is None:
        return {"kind": "title", "task": task, "title": value}
    return {"kind": "parameter", "task": task, "name": choice["parameter"], "value": value}


# ---------------------------------------------------------------- NUMBER.NAME=VALUE


def _assignment(
    path: list[str], value: str, document: PlanDocument, vocabulary: Vocabulary
) -> Edit:
    task, name = _task(path[0], document), path[-1]
    if len(path) == 2:
        title = task["title"]
        parameter = _parameter(name, title, vocabulary.task[title].by_name)
        edit = {"kind": "parameter", "task": task["id"]}
    else:
        step = _number(path[1])
        if step is None or len(path) > 4:
            forms = "TASK.PARAMETER, TASK.STEP.PARAMETER or TASK.STEP.SKILL.PARAMETER"
            raise PlannerError(f"{'.'.join(path)}: expected {forms}, such as 2.1.GoToXY.x")
        role, index, skill = _skill(task, step, path[2] if len(path) == 4 else None)
        parameter = _parameter(name, skill, vocabulary.skill[skill].by_name)
        edit = {"kind": "skill", "task": task["id"], "step": step - 1, "role": role, "index": index}
    return {**edit, "name": name, "value": _value(value, parameter)}


def _skill(task: dict[str, Any], step: int, name: str | None) -> tuple[str, int, str]:
    """Role, index in the role and name of a skill of a step: by name, else the navigation skill."""
    steps = task["skill_sequence"] or []
    if not 1 <= step <= len(steps):
        raise PlannerError(f"{task['title']}: has no step {step}; it has {len(steps)}")
    counts: dict[str, int] = {}
    named: dict[str, int] = {}
    for role, skill in step_skills(steps[step - 1]):
        index, number = counts.get(role, 0), named.get(skill["name"], 0) + 1
        if name is None or name in (f"{skill['name']}#{number}", skill["name"]):
            return role, index, skill["name"]
        counts[role], named[skill["name"]] = index + 1, number
    problem = f"step {step} has no skill {name}; it has {', '.join(named)}"
    raise PlannerError(f"{task['title']}: {problem}")


def _parameter(name: str, owner: str, known: Mapping[str, Parameter]) -> Parameter:
    if name not in known:
        there = ", ".join(known) or "none"
        raise PlannerError(f"{name}: is no parameter of {owner}; there is {there}")
    return known[name]


def _value(text: str, parameter: Parameter) -> Any:
    """A typed value as JSON of the parameter's type, its range unchecked; None for nothing."""
    if not text:
        return None
    if parameter.type == "texts" and not text.startswith("["):
        return [item.strip() for item in text.split(",")]
    if parameter.type == "position" and not text.startswith("["):
        text = f"[{text.strip('()')}]"
    try:
        value = json.loads(text, parse_constant=str)
    except (ValueError, RecursionError):
        return text
    return text if parameter.type == "text" and not isinstance(value, str) else value


# ---------------------------------------------------------------- WORD ...


def _remove(rest: str, document: PlanDocument) -> Edit:
    """A task by its number, or a skill by TASK.SKILL or TASK.STEP.SKILL."""
    number, *path = rest.split(".")
    task = _task(number, document)["id"]
    if not path:
        return {"kind": "remove", "task": task}
    edit = {"kind": "drop", "task": task, "name": path[-1]}
    if len(path) == 1:
        return edit
    step = _number(path[0])
    if not step or len(path) > 2:
        expected = "expected TASK, TASK.SKILL or TASK.STEP.SKILL"
        raise PlannerError(f"remove {rest}: {expected}, such as remove 2.1.GetSeabedDepth")
    return {**edit, "step": step - 1}


def _constraint(rest: str) -> Edit:
    number, _blank, text = rest.partition(" ")
    at = _number(number)
    if not at:
        raise PlannerError(f"constraint {rest}: expected its number, and its new text or nothing")
    return {"kind": "constraint", "at": at - 1, **({"text": text.strip()} if text.strip() else {})}


def _move(rest: str, document: PlanDocument) -> Edit:
    number, _blank, place = rest.partition(" ")
    to = _number(place.strip())
    if to is None:
        expected = "expected the number of a task and the place that it is to have"
        raise PlannerError(f"move {rest}: {expected}, such as move 3 1")
    return {"kind": "move", "task": _task(number, document)["id"], "to": to - 1}


def _locate(rest: str, document: PlanDocument) -> Edit:
    name, position = parse_location(rest)
    known = [*(place["name"] for place in document["open_places"]), *document["located"]]
    same = [other for other in known if other.casefold() == name.casefold()]
    return {"kind": "locate", "name": same[0] if same else name, "position": list(position)}


def _prompt(rest: str, document: PlanDocument) -> Edit:
    number, equals, text = rest.partition("=")
    if not equals:
        expected = "expected the number of a task and its new prompt"
        example = "prompt 2 = Circle the buoy at 12 m."
        raise PlannerError(f"prompt {rest}: {expected}, such as {example}")
    return {"kind": "prompt", "task": _task(number.strip(), document)["id"], "text": text.strip()}


def _insert(rest: str, vocabulary: Vocabulary) -> Edit:
    place, title, given = [*rest.split(maxsplit=2), "", "", ""][:3]
    at = _number(place)
    if at is None or not title:
        example = "insert 2 Transit target_position=[0,0]"
        expected = "expected a place, a task and its parameters"
        raise PlannerError(f"insert {rest}: {expected}, such as {example}")
    if title not in vocabulary.task:
        there = ", ".join(vocabulary.task)
        raise PlannerError(f"{title}: is no task of this vehicle; there is {there}")
    known = vocabulary.task[title].by_name
    names = (*known, "prompt")
    before, *found = re.split(rf"(?:^|\s)({'|'.join(map(re.escape, names))})\s*=", given)
    if unknown := before.strip():
        problem = f"{unknown!r} is no parameter of {title}; there is {', '.join(names)}"
        raise PlannerError(f"insert {rest}: {problem}")
    values = dict(zip(found[::2], map(str.strip, found[1::2]), strict=True))
    prompt = values.pop("prompt", "")
    parameters = {name: _value(value, known[name]) for name, value in values.items()}
    inserted = {"title": title, "parameters": parameters, "task_prompt": prompt}
    return {"kind": "insert", "at": at - 1, **inserted}


def _asked(rest: str, document: PlanDocument) -> list[str]:
    """The task of a number; without one every task that waits for skills."""
    if rest:
        return [_task(rest, document)["id"]]
    return [
        task["id"]
        for task in document["tasks"]
        if not {"waits_for", "asks"} & task.keys()
        and (task["skill_sequence"] is None or task.get("stale"))
    ]


def _task(number: str, document: PlanDocument) -> dict[str, Any]:
    tasks: list[dict[str, Any]] = document["tasks"]
    place = _number(number)
    if place is None or not 1 <= place <= len(tasks):
        there = f"tasks 1 to {len(tasks)}" if tasks else "no tasks"
        raise PlannerError(f"task {number or '?'}: the plan has {there}")
    return tasks[place - 1]


def _number(text: str) -> int | None:
    """The whole number that a text is. Longer ones are none: no plan has that many tasks."""
    return int(text) if text.isdecimal() and len(text) < 10 else None
