"""Edits as an operator types them: "2.radius=15", "move 3 1", "locate green buoy=120,-35"."""

import json
import re
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from planner_ft.document import PlanDocument
from planner_ft.document.confidence import LETTERS
from planner_ft.document.entered import known, titled
from planner_ft.planning.locations import parse_location
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_text
from planner_ft.vocabulary import Parameter, Vocabulary
from planner_ft.vocabulary.plans import step_skills

Edit = dict[str, Any]

HELP: dict[str, str] = tomllib.loads(read_text(Path(__file__).with_name("commands.toml")))
"""Examples of edits, with their effect."""
CHOICE = re.compile(rf"(\d)([{LETTERS}])")
WORDS = ("remove", "move", "locate", "prompt", "insert", "origin", "constraint", "skills", "undo")
VALUE = re.compile(r"(\d+(?:\.[\w#]+)+)\s*=\s*(.*)", re.DOTALL)


def parse_edit(text: str, document: PlanDocument, vocabulary: Vocabulary) -> Edit:
    """The edit for planner_ft.document, or {"kind": "undo"}, {"kind": "ask", "tasks": ids}.

    Raises PlannerError that says what was expected.
    """
    text, typed = text.strip(), _Typed(document, vocabulary)
    if assigned := VALUE.fullmatch(text):
        return typed.assignment(assigned[1].split("."), assigned[2].strip())
    if chosen := CHOICE.fullmatch(text):
        return typed.choice(int(chosen[1]), chosen[2])
    word, rest = [*text.split(maxsplit=1), "", ""][:2]
    if word.lower() not in WORDS:
        raise PlannerError(f"{text!r}: is no edit; there is {', '.join(HELP)}")
    edit: Edit = getattr(typed, word.lower())(rest)
    return edit


@dataclass(frozen=True)
class _Typed:
    """Reads what is typed about a plan; one method per word, for what stands behind it."""

    document: PlanDocument
    vocabulary: Vocabulary

    def assignment(self, path: list[str], value: str) -> Edit:
        """NUMBER.NAME=VALUE, or a value of a skill."""
        task, name = self._task(path[0]), path[-1]
        if len(path) == 2:
            parameter = known(self.vocabulary.task[task["title"]], task["title"], name)
            return _edit("parameter", task, name=name, value=_value(value, parameter))
        step = _number(path[1])
        if step is None or len(path) > 4:
            forms = "TASK.PARAMETER, TASK.STEP.PARAMETER or TASK.STEP.SKILL.PARAMETER"
            raise _expected(".".join(path), forms, "2.1.GoToXY.x")
        role, index, skill = _skill(task, step, path[2] if len(path) == 4 else None)
        parameter = known(self.vocabulary.skill[skill], skill, name)
        where = {"step": step - 1, "role": role, "index": index}
        return _edit("skill", task, **where, name=name, value=_value(value, parameter))

    def choice(self, number: int, letter: str) -> Edit:
        """The alternative of a question."""
        asked, at = self.document.get("choices", []), LETTERS.index(letter)
        if not 1 <= number <= len(asked):
            there = f"there are {len(asked)}" if asked else "there are none"
            raise PlannerError(f"{number}{letter}: is no question of the plan; {there}")
        others, name = asked[number - 1]["others"], asked[number - 1]["parameter"]
        if at >= len(others):
            last = f"the last is {number}{LETTERS[len(others) - 1]}"
            raise PlannerError(f"{number}{letter}: the question has no such answer; {last}")
        task = {"id": asked[number - 1]["task"]}
        if name is None:
            return _edit("title", task, title=others[at])
        return _edit("parameter", task, name=name, value=others[at])

    def remove(self, rest: str) -> Edit:
        """A task by its number, or a skill by TASK.SKILL or TASK.STEP.SKILL."""
        number, *path = rest.split(".")
        task = self._task(number)
        if len(path) < 2:
            return _edit("drop", task, name=path[0]) if path else _edit("remove", task)
        step = _number(path[0])
        if not step or len(path) > 2:
            forms = "TASK, TASK.SKILL or TASK.STEP.SKILL"
            raise _expected(f"remove {rest}", forms, "remove 2.1.GetSeabedDepth")
        return _edit("drop", task, name=path[1], step=step - 1)

    def move(self, rest: str) -> Edit:
        number, _blank, place = rest.partition(" ")
        to = _number(place.strip())
        if to is None:
            forms = "the number of a task and the place that it is to have"
            raise _expected(f"move {rest}", forms, "move 3 1")
        return _edit("move", self._task(number), to=to - 1)

    def locate(self, rest: str) -> Edit:
        name, position = parse_location(rest)
        places = [place["name"] for place in self.document["open_places"]]
        places += self.document["located"]
        same = [other for other in places if other.casefold() == name.casefold()]
        return {"kind": "locate", "name": [*same, name][0], "position": list(position)}

    def prompt(self, rest: str) -> Edit:
        number, equals, text = rest.partition("=")
        if not equals:
            example = "prompt 2 = Circle the buoy at 12 m."
            raise _expected(f"prompt {rest}", "the number of a task and its new prompt", example)
        return _edit("prompt", self._task(number.strip()), text=text.strip())

    def insert(self, rest: str) -> Edit:
        place, title, given = [*rest.split(maxsplit=2), "", "", ""][:3]
        at = _number(place)
        if at is None or not title:
            forms, example = "a place, a task and its parameters", "target_position=[0,0]"
            raise _expected(f"insert {rest}", forms, f"insert 2 Transit {example}")
        own = titled(title, self.vocabulary).by_name
        names = (*own, "prompt")
        before, *found = re.split(rf"(?:^|\s)({'|'.join(map(re.escape, names))})\s*=", given)
        if unknown := before.strip():
            problem = f"{unknown!r} is no parameter of {title}; there is {', '.join(names)}"
            raise PlannerError(f"insert {rest}: {problem}")
        values = dict(zip(found[::2], map(str.strip, found[1::2]), strict=True))
        prompt = values.pop("prompt", "")
        parameters = {name: _value(value, own[name]) for name, value in values.items()}
        inserted = {"title": title, "parameters": parameters, "task_prompt": prompt}
        return {"kind": "insert", "at": at - 1, **inserted}

    def origin(self, rest: str) -> Edit:
        return {"kind": "origin", "place": rest}

    def constraint(self, rest: str) -> Edit:
        number, _blank, text = rest.partition(" ")
        at, said = _number(number), {"text": text.strip()} if text.strip() else {}
        if not at:
            problem = "expected its number, and its new text or nothing"
            raise PlannerError(f"constraint {rest}: {problem}")
        return {"kind": "constraint", "at": at - 1, **said}

    def skills(self, rest: str) -> Edit:
        """The task of a number; without one every task that waits for skills."""
        tasks = [self._task(rest)] if rest else self.document["tasks"]
        asked = [
            task["id"]
            for task in tasks
            if rest
            or (
                not {"waits_for", "asks"} & task.keys()
                and (task["skill_sequence"] is None or task.get("stale"))
            )
        ]
        return {"kind": "ask", "tasks": asked}

    def undo(self, rest: str) -> Edit:
        if rest:
            problem = "takes the last edit back and needs nothing after it"
            raise PlannerError(f"undo {rest}: {problem}")
        return {"kind": "undo"}

    def _task(self, number: str) -> dict[str, Any]:
        tasks: list[dict[str, Any]] = self.document["tasks"]
        place = _number(number)
        if place is None or not 1 <= place <= len(tasks):
            there = f"tasks 1 to {len(tasks)}" if tasks else "no tasks"
            raise PlannerError(f"task {number or '?'}: the plan has {there}")
        return tasks[place - 1]


def _edit(kind: str, task: Mapping[str, Any], **more: Any) -> Edit:
    return {"kind": kind, "task": task["id"], **more}


def _expected(typed: str, forms: str, example: str) -> PlannerError:
    return PlannerError(f"{typed}: expected {forms}, such as {example}")


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


def _number(text: str) -> int | None:
    """The whole number that a text is. Longer ones are none: no plan has that many tasks."""
    return int(text) if text.isdecimal() and len(text) < 10 else None
