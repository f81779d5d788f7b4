"""The sums behind the waypoints of a skill sequence, written out before it.

A grid's lanes and a square's corners are not in the task's input, they are worked out from it: a
model that must write `"x":45` at once has to find 33 and 12 in the input, and add them, within one
token. So what is trained has the sums in front, `x33+12=45;y-18+12=-6`, in the order in which the
waypoints need them, and the sequence copies their results. Whoever reads an answer drops them
(`planner_ft.vocabulary.outputs`).

The sums are found from the input and the waypoints alone, so every task set has them, whoever wrote
it: a coordinate that the input does not state is the one before it, or one that is stated, and a
length of the input, or half or a part of one, away. Those that no such sum gives (a waypoint on a
slanted line) have none.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from planner_ft.data.quantities import positions, quantities
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.definition import Parameter
from planner_ft.vocabulary.plans import canonical_value

NEAR = 0.0051
"""Coordinates are rounded to two decimals."""
PARTS = range(3, 13)
"""Lanes divide an area into this many parts."""
SUM = re.compile(r"([xy]?)(-?\d+(?:\.\d+)?)([-+/])(\d+(?:\.\d+)?)=(-?\d+(?:\.\d+)?)")
"""A sum: axis, base or length, sign, length or number of parts, result."""

_Length = tuple[float, float | None]
"""A length, and the one that it is a part of."""


@dataclass
class _Sums:
    """The sums of a route as it is walked: `last` is the coordinate reached on each axis, `known`
    are those that need no sum any more, `lanes` tells that the next waypoint is on one, `pace` is
    the length that was last gone along an axis, and `parts` those that were worked out.
    """

    stated: tuple[Sequence[float], Sequence[float]]
    lengths: Sequence[float]
    lanes: bool = False
    written: list[str] = field(default_factory=list)
    known: tuple[set[float], set[float]] = field(default_factory=lambda: (set(), set()))
    last: list[float | None] = field(default_factory=lambda: [None, None])
    pace: list[float | None] = field(default_factory=lambda: [None, None])
    parts: set[float] = field(default_factory=set)

    def go(self, point: Sequence[float], *, lanes: bool) -> None:
        """Walk to a waypoint."""
        if lanes and not self.lanes:
            self.pace = [None, None]
        self.lanes = lanes
        for axis, value in enumerate(point):
            if value not in self.known[axis]:
                self._reach(axis, value)
            self.known[axis].add(value)
            self.last[axis] = value

    def _reach(self, axis: int, value: float) -> None:
        last, pace = self.last[axis], self.pace[axis]
        # Lanes go on at their pace, over what is stated too.
        on = self.lanes and last is not None and pace is not None and _near(abs(value - last), pace)
        if any(_near(value, other) for other in self.stated[axis]) and not on:
            return
        found = next(
            (
                (base, away, of)
                for base, away, of in self._sums(axis)
                if away and _near(abs(value - base), away)
            ),
            None,
        )
        if found is None:
            return
        base, away, of = found
        if of is not None and away not in self.parts:
            self.written.append(f"{_text(of)}/{_text(round(of / away))}={_text(away)}")
            self.parts.add(away)
        self.written.append(
            f"{'xy'[axis]}{_text(base)}{'+' if value > base else '-'}{_text(away)}={_text(value)}"
        )
        self.pace[axis] = away

    def _sums(self, axis: int) -> Iterator[tuple[float, *_Length]]:
        """What a coordinate can be reached from, how far away, and the length that this is a part
        of; the likeliest first.
        """
        last, pace = self.last[axis], self.pace[axis]
        whole: list[_Length] = [(length, None) for length in self.lengths]
        halves: list[_Length] = [(_tidy(length / 2), length) for length in self.lengths]
        # The first lane begins half an area away from its middle; where their number is said, they
        # lie a part of it apart.
        away = [*halves, *whole] if self.lanes and pace is None else [*whole, *halves]
        apart: list[_Length] = [
            (_tidy(length / count), length)
            for count in PARTS
            for length in self.lengths
            if self.lanes
        ]
        first, *others = self.stated[axis]
        begun = [] if last is None else [last]
        again: list[_Length] = [(pace, None), *whole] if pace else whole
        for bases, offered in (
            (begun, again),
            ([first], away),
            (begun, [*apart, *halves]),
            *(([other], away) for other in others),
        ):
            for base in bases:
                for length, of in offered:
                    yield base, length, of


def working_of(record: Mapping[str, Any], vocabulary: Vocabulary) -> str:
    """The sums behind the waypoints of a task record ({"task", "parameters", "prompt",
    "expected"}); empty where none is needed or found.
    """
    route = list(_route(record["expected"], vocabulary))
    if not route:
        return ""
    parameters, prompt = record.get("parameters", {}), str(record.get("prompt", ""))
    task = vocabulary.task.get(str(record.get("task")))
    own = [(task.by_name.get(name) if task else None, value) for name, value in parameters.items()]
    places = [*_places(own), *((x, y) for x, y, _start, _end in positions(prompt)), vocabulary.home]
    if all(any(_near(x, a) and _near(y, b) for a, b in places) for x, y in route):
        return ""
    lengths = [*(value for parameter, value in own if _is_length(parameter, value)), *_said(prompt)]
    stated = [*dict.fromkeys(x for x, _y in places)], [*dict.fromkeys(y for _x, y in places)]
    sums = _Sums(stated, [*dict.fromkeys(_tidy(abs(length)) for length in lengths)])
    for point, lanes in zip(route, _on_lanes(route), strict=True):
        sums.go(point, lanes=lanes)
    return ";".join(sums.written)


def _route(plan: Mapping[str, Any], vocabulary: Vocabulary) -> Iterator[tuple[float, float]]:
    """The waypoints of a plan."""
    for step in plan["skill_sequence"]:
        movement = step["navigation_skill"]
        skill = vocabulary.skill.get(movement["name"])
        if skill is not None and skill.motion == "goto":
            x, y = (movement["parameters"].get(parameter.name) for parameter in skill.coordinates)
            if _is_number(x) and _is_number(y):
                yield x, y


def _places(own: Sequence[tuple[Parameter | None, Any]]) -> Iterator[tuple[float, float]]:
    for parameter, value in own:
        if (
            parameter is not None
            and parameter.type in ("position", "polygon")
            and isinstance(value, list | tuple)
        ):
            listed = [value] if parameter.type == "position" else value
            yield from (
                (place[0], place[1])
                for place in listed
                if isinstance(place, list | tuple)
                and len(place) == 2
                and all(map(_is_number, place))
            )


def _is_length(parameter: Parameter | None, value: Any) -> bool:
    return parameter is not None and parameter.unit == "m" and _is_number(value)


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)


def _said(prompt: str) -> Iterator[float]:
    """The lengths that the prompt may mean, those that are coordinates at the end."""
    lengths = [quantity for quantity in quantities(prompt) if quantity.unit in (None, "m")]
    spans = [(start, end) for _x, _y, start, end in positions(prompt)]
    yield from (
        length.value
        for length in sorted(
            lengths, key=lambda length: any(start <= length.start < end for start, end in spans)
        )
    )


def _on_lanes(route: Sequence[tuple[float, float]]) -> list[bool]:
    """Which waypoints are on lanes: three legs along the axes, each across the one before."""
    moves = [(bx != ax, by != ay) for (ax, ay), (bx, by) in itertools.pairwise(route)]
    found = [False] * len(route)
    for start in range(len(moves) - 2):
        one, two, three = moves[start : start + 3]
        if one == three and one != two and sum(one) == sum(two) == 1:
            found[start : start + 4] = [True] * 4
    return found


def _near(one: float, other: float) -> bool:
    return abs(one - other) <= NEAR


def _tidy(value: float) -> float:
    return round(value, 2)


def _text(value: float) -> str:
    return str(canonical_value(_tidy(float(value))))
