"""The values of a plan, which facts of the command are compared with."""

from __future__ import annotations

import itertools
import math
import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from planner_ft.facts import Input, Number, Position, is_number, is_place, near
from planner_ft.facts.numbers import read_numbers, rows_of_sizes
from planner_ft.facts.places import read_positions
from planner_ft.vocabulary.plans import step_skills

FULL = 360.0
STEM = 5
LONGER = re.compile(r"[a-z]{4,}")
"""Words that say something, and the letters by which one is found again."""
CORNERS = 3


class PlanValues:
    """The values of a plan: of tasks with their skills, of limits, and places in texts."""

    def __init__(self, document: Mapping[str, Any], command: Input) -> None:
        tasks, limits = document["tasks"], document.get("limits", ())
        steps = [step for task in tasks for step in task.get("skill_sequence") or ()]
        skills = [skill for step in steps for _role, skill in step_skills(step)]
        given = [owner["parameters"] for owner in (*tasks, *skills)]
        own = [value for values in given for value in values.values()]
        gone = [(values["x"], values["y"]) for values in given if {"x", "y"} <= values.keys()]
        self.limits = [value for limit in limits for value in limit["values"].values()]
        # Coordinates are places, not numbers: 40 east of one and 40 north of another say no place.
        self.numbers = [
            float(value)
            for values in given
            for name, value in values.items()
            if is_number(value) and not (name in ("x", "y") and {"x", "y"} <= values.keys())
        ]
        self.owners = [list(filter(is_number, task["parameters"].values())) for task in tasks]
        self.limited = [float(value) for value in self.limits if is_number(value)]
        self.polygons = [value for value in (*own, *self.limits) if _is_polygon(value)]
        places = [tuple(value) for value in own if is_place(value)]
        self.often = [
            *(gone or places),
            *((task["title"], str(task["parameters"])) for task in tasks),
        ]
        texts = [*document.get("constraints", ()), *document.get("assumptions", ())]
        texts += [task["task_prompt"] for task in tasks]
        read = [(place.x, place.y) for line in texts for place in read_positions(line)]
        corners = [tuple(corner) for polygon in self.polygons for corner in polygon]
        self.places = [*places, *gone, *read, *corners, *filter(is_place, self.limits)]
        spoken = [number for line in texts for number in read_numbers(line)]
        self.sizes = [[one.value for one in row] for line in texts for row in rows_of_sizes(line)]
        self.anywhere = {*_flat(own), *(part for one in spoken for part in (one.value, one.said))}
        self.anywhere |= set(_ways([*places, *read], command))
        self.texts = " ".join(texts).casefold()
        self.timed = any(limit["kind"] in ("return", "duration") for limit in limits)

    def says(self, value: float) -> bool:
        """Whether a number is anywhere in the plan, or a way that it goes, up to its sign."""
        return any(near(abs(value), abs(number)) for number in self.anywhere)

    def missing_sizes(self, row: Sequence[Number]) -> list[Number]:
        """The sizes of a row that the task with most of them lacks; none where no task has any, or
        a text has them together.
        """
        wanted = [one.value for one in row]
        alike = [sorted(sizes) for sizes in self.sizes if len(sizes) == len(wanted)]
        together = (all(map(near, sorted(wanted), sizes)) for sizes in alike)
        rests = []
        for owner in () if any(together) else self.owners:
            left, rest = list(owner), list[Number]()
            for one in row:
                held = next((value for value in left if near(value, one.value)), None)
                if held is None:
                    rest.append(one)
                else:
                    left.remove(held)
            rests.append(rest)
        fewest = min(rests, key=len, default=[])
        return fewest if len(fewest) < len(row) else []

    def speaks_of(self, words: str) -> bool:
        """Whether a text of the plan has one of the longer words, or there are none."""
        longer = LONGER.findall(words.casefold())
        return not longer or any(word[:STEM] in self.texts for word in longer)

    def has(self, place: Position) -> bool:
        """Whether a position is anywhere in the plan, or its numbers are values of it."""
        if any(same_place(place, other) for other in self.places):
            return True
        return all(any(near(part, one) for one in self.numbers) for part in (place.x, place.y))

    def encloses(self, row: Sequence[Position]) -> bool:
        """Whether the positions of a row are the corners of one polygon."""
        return any(
            all(any(same_place(place, corner) for corner in polygon) for place in row)
            for polygon in self.polygons
        )

    def repeats(self, count: float, places: Sequence[Position]) -> bool:
        """Whether something is done so often: an arc, each place, else any place or task."""
        if any(near(abs(value), FULL * count) for value in self.numbers):
            return True
        if places:
            points = [item for item in self.often if is_number(item[0])]
            return all(sum(same_place(at, one) for one in points) >= count for at in places)
        return any(self.often.count(item) >= count for item in set(self.often))


def _flat(value: Any) -> Iterator[float]:
    if is_number(value):
        yield float(value)
    elif isinstance(value, list):
        for item in value:
            yield from _flat(item)


def _ways(places: Sequence[Sequence[float]], command: Input) -> Iterator[float]:
    """The lengths by which places of a plan lie a stated way off stated ones."""
    ground = command.ground
    for (x, y), base in itertools.product(set(map(tuple, places)), ground.places if ground else ()):
        away = x - base[0], y - base[1]
        if ground and any(away) and (ground.is_way_off((x, y), base) or away in ground.places):
            yield from (*away, math.hypot(*away))


def same_place(place: Position, other: Sequence[float]) -> bool:
    """Whether a position of the command is one of the plan."""
    return near(place.x, other[0]) and near(place.y, other[1])


def _is_polygon(value: Any) -> bool:
    return isinstance(value, list) and len(value) >= CORNERS and all(map(is_place, value))
