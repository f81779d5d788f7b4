"""The accounting of an export: everything that a plan says is either in the file or a loss.

A format enters into a `Ledger` what it carries, what it carries in another form, and what it leaves
out and why. Items that it never mentions are losses, too: nothing is dropped silently.
"""

import tomllib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path as FilePath
from typing import Any

from planner_ft.support.files import compact_json, read_text

Path = tuple[str | int, ...]
"""A place in the document: ("tasks", 1, "skill_sequence", 0, "navigation_skill", "name")."""

ITEMS: dict[str, Any] = tomllib.loads(read_text(FilePath(__file__).with_name("items.toml")))
"""The words of everything that a plan says, by its place; "*" is any key."""
NO_PLACE = "the format has no place for it"
MOVEMENT = ("navigation_skill", "name")  # the end of the path of a step's movement
LISTS = ("stop_conditions", "failure_modes", "expected_outputs")


@dataclass(frozen=True)
class Item:
    """One thing that a plan says, of which task's id (None: the whole plan) and step (from 1)."""

    path: Path
    task: str | None
    what: str
    step: int | None = None


@dataclass(frozen=True)
class Loss:
    """Something of a task (None: the whole plan) that a file holds otherwise or not, and why;
    `stops` says whether the mission stops there or goes another way.
    """

    task: str | None
    what: str
    why: str
    stops: bool = False


@dataclass(frozen=True)
class Account:
    """A closed ledger: paths in the file, entries in another form, and entries not in the file.
    `stops` are the paths where the mission stops, until somebody sends the vehicle on or for good.
    """

    carried: frozenset[Path]
    changed: tuple[Loss, ...]
    lost: tuple[Loss, ...]
    changed_paths: frozenset[Path]
    lost_paths: frozenset[Path]
    stops: frozenset[Path] = frozenset()


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
        self._stops: set[Path] = set()

    def __contains__(self, path: Path) -> bool:
        """Whether the plan says anything at or below `path`."""
        return path in self._below

    def carry(self, *path: str | int, form: str = "") -> None:
        """The file holds this, in another `form` if one is given. Raises KeyError for no item."""
        for item in self._below[path]:
            self._carried[item] = form
            self._lost.pop(item, None)

    def lose(self, *path: str | int, why: str) -> None:
        """The file does not hold this unless it is carried already. Raises KeyError for no item."""
        for item in self._below[path]:
            if item not in self._carried:
                self._lost[item] = why

    def stop(self, *path: str | int) -> None:
        """The mission stops here. Raises KeyError for no item."""
        self._stops.update(self._below[path])

    def close(self, why: str = NO_PLACE) -> Account:
        """The account; `why` is the reason for losing items that were never mentioned."""
        lost = {path: self._lost.get(path, why) for path in self.items if path not in self._carried}
        changed = {path: self._carried[path] for path in self.items if self._carried.get(path)}
        losses = self._losses(changed), self._losses(lost)
        paths = frozenset(changed), frozenset(lost), frozenset(self._stops)
        return Account(frozenset(self._carried), *losses, *paths)

    def _losses(self, entries: Mapping[Path, str]) -> tuple[Loss, ...]:
        """One loss per task and reason, in the plan's order; equal words of several steps once."""
        grouped: dict[tuple[str | None, str, bool], dict[str, list[int | None]]] = {}
        for path, why in entries.items():
            item, gone = self.items[path], path not in self._carried
            stops = path in self._stops or (gone and path[4:] == MOVEMENT)
            of_task = grouped.setdefault((item.task, why, stops), {})
            of_task.setdefault(item.what, []).append(item.step)
        found = []
        for (task, why, stops), steps in grouped.items():
            what = "; ".join(text + _step_words(numbers) for text, numbers in steps.items())
            found.append(Loss(task, what, why, stops))
        return tuple(found)


def ranges(numbers: list[int]) -> str:
    """ "1-3, 7" of sorted numbers."""
    starts = [number for number in numbers if number - 1 not in numbers]
    ends = [number for number in numbers if number + 1 not in numbers]
    pairs = zip(starts, ends, strict=True)
    return ", ".join(f"{start}" if start == end else f"{start}-{end}" for start, end in pairs)


def _step_words(steps: list[int | None]) -> str:
    """ " (step 2)", " (steps 1-3, 7)", or nothing for what is no part of a step."""
    numbers = sorted({step for step in steps if step is not None})
    return f" (step{'s' if len(numbers) > 1 else ''} {ranges(numbers)})" if numbers else ""


def plan_items(document: dict[str, Any]) -> Iterator[Item]:
    """Everything that a plan says to a vehicle or to its operator, in the document's order.

    How the plan came about (sources, edits, the proposal, usage, manifest) and what follows from
    the rest (ontology, estimate) is no item: items.toml says what is one, and in which words.
    """
    for path, what in _found(document, ITEMS, (), ""):
        task, step = None, None
        if path[0] == "tasks":
            task = document["tasks"][path[1]]["id"]
            step = int(path[3]) + 1 if path[2] == "skill_sequence" else None
        elif path[0] == "warnings":
            task = document["warnings"][path[1]].get("task")
        yield Item(path, task, what, step)


def _found(value: Any, items: Any, path: Path, owner: str) -> Iterator[tuple[Path, str]]:
    """The places of a table of items in a value, with their words; `owner` is the nearest name."""
    if isinstance(value, dict) and "name" in (items if isinstance(items, dict) else value):
        owner = value["name"]
    if isinstance(items, str):
        key, plain = str(path[-1]), isinstance(value, str | dict)
        words = {"value": value if plain else compact_json(value), "owner": owner}
        yield path, items.format(key=key, name=key.replace("_", " "), **words)
        return
    for key, below in items.items():
        entries = value.items() if isinstance(value, dict) else enumerate(value)
        for name, one in entries if key == "*" else [(key, value.get(key))]:
            if one is not None and one is not False:
                yield from _found(one, below, (*path, name), owner)
