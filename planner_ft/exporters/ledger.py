"""The accounting of a hand-over: everything that a plan says is either in the file or among the
losses.

A format goes through the plan and enters into a `Ledger` what it carries, what it carries in
another form, and what it leaves out and why. What it never mentions is a loss, too: nothing is
dropped silently.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from planner_ft.support.files import compact_json

Path = tuple[str | int, ...]
"""Where something stands in the document: ("tasks", 1, "skill_sequence", 0, "navigation_skill",
"parameters", "x").
"""

NO_PLACE = "the format has no place for it"
LISTS = ("stop_conditions", "failure_modes", "expected_outputs")


@dataclass(frozen=True)
class Item:
    """One thing that a plan says: where it stands, the task's id (None: of the whole plan), what it
    is in words, and the step (from 1).
    """

    path: Path
    task: str | None
    what: str
    step: int | None = None


@dataclass(frozen=True)
class Loss:
    """Something that a file does not hold as the plan says it: of which task (None: of the whole
    plan), what, and why or how.
    """

    task: str | None
    what: str
    why: str


@dataclass(frozen=True)
class Account:
    """A closed ledger. `carried` are the paths that the file holds, `changed` is carried in another
    form, `lost` is not in the file.
    """

    carried: frozenset[Path]
    changed: tuple[Loss, ...]
    lost: tuple[Loss, ...]
    changed_paths: frozenset[Path]
    lost_paths: frozenset[Path]


class Ledger:
    """What becomes of every item of one document. A path stands for all items at and below it."""

    def __init__(self, document: dict[str, Any]) -> None:
        self.items = {item.path: item for item in plan_items(document)}
        self._below: dict[Path, list[Path]] = {}
        for path in self.items:
            for length in range(1, len(path) + 1):
                self._below.setdefault(path[:length], []).append(path)
        self._carried: dict[Path, str] = {}
        self._lost: dict[Path, str] = {}

    def __contains__(self, path: Path) -> bool:
        """Whether the plan says anything at or below `path`."""
        return path in self._below

    def carry(self, *path: str | int, form: str = "") -> None:
        """The file holds this; `form` says how, where it is not as the plan says it. Raises
        KeyError where the plan says nothing.
        """
        for item in self._below[path]:
            self._carried[item] = form
            self._lost.pop(item, None)

    def lose(self, *path: str | int, why: str) -> None:
        """The file does not hold this. What is carried already stays so. Raises KeyError where the
        plan says nothing.
        """
        for item in self._below[path]:
            if item not in self._carried:
                self._lost[item] = why

    def close(self, why: str = NO_PLACE) -> Account:
        """The account; what was never mentioned is lost, and this is `why`."""
        lost = {path: self._lost.get(path, why) for path in self.items if path not in self._carried}
        changed = {path: self._carried[path] for path in self.items if self._carried.get(path)}
        return Account(
            frozenset(self._carried),
            self._told(changed),
            self._told(lost),
            frozenset(changed),
            frozenset(lost),
        )

    def _told(self, entries: dict[Path, str]) -> tuple[Loss, ...]:
        """One loss per task and reason, in the plan's order; what several steps say alike is told
        once.
        """
        grouped: dict[tuple[str | None, str], dict[str, list[int | None]]] = {}
        for path, why in entries.items():
            item = self.items[path]
            grouped.setdefault((item.task, why), {}).setdefault(item.what, []).append(item.step)
        return tuple(
            Loss(task, "; ".join(what + _steps_told(steps) for what, steps in told.items()), why)
            for (task, why), told in grouped.items()
        )


def ranges(numbers: list[int]) -> str:
    """ "1-3, 7" of sorted numbers."""
    starts = [number for number in numbers if number - 1 not in numbers]
    ends = [number for number in numbers if number + 1 not in numbers]
    return ", ".join(
        f"{start}" if start == end else f"{start}-{end}"
        for start, end in zip(starts, ends, strict=True)
    )


def _steps_told(steps: list[int | None]) -> str:
    """ " (step 2)", " (steps 1-3, 7)", or nothing for what is no part of a step."""
    numbers = sorted({step for step in steps if step is not None})
    return f" (step{'s' if len(numbers) > 1 else ''} {ranges(numbers)})" if numbers else ""


def plan_items(document: dict[str, Any]) -> Iterator[Item]:
    """Everything that a plan says to a vehicle or to its operator, in the document's order.

    How the plan came about (sources, edits, the proposal, usage, manifest) and what follows from
    the rest (ontology, estimate) is no item.
    """
    yield Item(("command",), None, "the command")
    for key, value in document["vehicle"].items():
        if value is not None:
            yield Item(
                ("vehicle", key), None, f"the vehicle's {key.replace('_', ' ')}: {_said(value)}"
            )
    for index, task in enumerate(document["tasks"]):
        yield from _task_items(("tasks", index), task)
    for key, one in (("assumptions", "assumption"), ("constraints", "constraint")):
        yield from (
            Item((key, index), None, f"{one}: {text}") for index, text in enumerate(document[key])
        )
    for index, place in enumerate(document["open_places"]):
        yield Item(("open_places", index), None, f"open place: {place['name']}")
    for name, position in document["located"].items():
        yield Item(("located", name), None, f"located: {name} at {_said(position)}")
    yield from (
        Item(("problems", index), None, f"problem: {text}")
        for index, text in enumerate(document.get("problems", ()))
    )
    for index, warning in enumerate(document["warnings"]):
        yield Item(("warnings", index), warning.get("task"), f"warning: {warning['text']}")


def _task_items(at: Path, task: dict[str, Any]) -> Iterator[Item]:
    name = task["id"]
    yield Item((*at, "title"), name, f"title {task['title']}")
    yield Item((*at, "task_prompt"), name, f"task prompt: {task['task_prompt']}")
    for key, value in task["parameters"].items():
        yield Item((*at, "parameters", key), name, f"{key} = {_said(value)}")
    for key in ("waits_for", "stale"):
        if task.get(key):
            yield Item((*at, key), name, f"{key.replace('_', ' ')}: {_said(task[key])}")
    yield from (
        Item((*at, "located", key), name, f"{key} is the place of {place}")
        for key, place in task.get("located", {}).items()
    )
    for key in ("assumptions", "problems"):
        yield from (
            Item((*at, key, index), name, f"{key[:-1]}: {text}")
            for index, text in enumerate(task.get(key, ()))
        )
    for number, step in enumerate(task["skill_sequence"] or (), start=1):
        yield from (
            Item((*at, "skill_sequence", number - 1, *path), name, what, number)
            for path, what in _step_items(step)
        )


def _step_items(step: dict[str, Any]) -> Iterator[tuple[Path, str]]:
    yield from _skill_items(("navigation_skill",), step["navigation_skill"])
    for key in ("filter_skills", "perception_skills"):
        for index, skill in enumerate(step[key]):
            yield from _skill_items((key, index), skill)
    for key in LISTS:
        yield from (
            ((key, index), f"{key[:-1].replace('_', ' ')}: {text}")
            for index, text in enumerate(step[key])
        )


def _skill_items(at: Path, skill: dict[str, Any]) -> Iterator[tuple[Path, str]]:
    yield (*at, "name"), str(skill["name"])
    for key, value in skill["parameters"].items():
        yield (*at, "parameters", key), f"{skill['name']} {key} = {_said(value)}"


def _said(value: Any) -> str:
    return value if isinstance(value, str) else compact_json(value)
