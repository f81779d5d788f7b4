"""The sums behind the waypoints of a skill sequence, written out before it.

A grid's lanes and a square's corners are not in the task's input, they are worked out from it: a
model that must write `"x":45` at once has to find 33 and 12 in the input, and add them, within one
token. So training answers have the sums in front, `x33+12=45;y-18+12=-6`, in the order in which the
waypoints need them, and the sequence copies their results. `vocabulary.plans.without_working` takes
them off an answer.

The sums are found from the input and the waypoints alone, so every task set has them, whoever wrote
it: a coordinate that the input does not state is the one before it, or one that is stated, and a
length of the input, or half or a part of one, away. Those that no such sum gives (a waypoint on a
slanted line) have none.
"""

import itertools
import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from planner_ft.data.numbers import digits
from planner_ft.facts.geometry import tidy
from planner_ft.facts.numbers import read_numbers
from planner_ft.facts.places import read_positions
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import is_number, is_position

NEAR = 0.0051
"""Coordinates are rounded to two decimals."""
PARTS = range(3, 13)
"""Lanes divide an area into this many parts."""
SUM = re.compile(r"([xy]?)(-?\d+(?:\.\d+)?)([-+/])(\d+(?:\.\d+)?)=(-?\d+(?:\.\d+)?)")
"""A sum: axis, base or length, sign, length or number of parts, result."""

SITES = ("position", "polygon")
_Away = tuple[float, float | None]
"""A distance, and the length of the input that it is a part of."""
_Point = tuple[float, float]


def working_of(record: Mapping[str, Any], vocabulary: Vocabulary) -> str:
    """The sums behind the waypoints of a task record ({"task", "parameters", "prompt",
    "expected"}); empty where none is needed or found.
    """
    route = list(_route(record["expected"], vocabulary))
    if not route:
        return ""
    prompt, task = str(record.get("prompt", "")), vocabulary.task.get(str(record.get("task")))
    own = record.get("parameters", {}).items() if task else ()
    known = [(task.by_name[name], value) for name, value in own if task and name in task.by_name]
    said = read_positions(prompt)
    shapes = (
        [value] if one.type == "position" else value for one, value in known if one.type in SITES
    )
    sites = (site for shape in shapes if isinstance(shape, list) for site in shape)
    places: list[_Point] = [(site[0], site[1]) for site in sites if is_position(site)]
    places += [*((place.x, place.y) for place in said), vocabulary.home]
    if all(any(_near(x, a) and _near(y, b) for a, b in places) for x, y in route):
        return ""
    # Numbers of the prompt that may be lengths; those that are coordinates come last.
    spoken = [quantity for quantity in read_numbers(prompt) if quantity.unit in (None, "m")]
    spoken.sort(key=lambda one: any(place.start <= one.start < place.end for place in said))
    lengths = [value for parameter, value in known if parameter.unit == "m" and is_number(value)]
    lengths += [quantity.value for quantity in spoken]
    distinct = [*dict.fromkeys(tidy(abs(length)) for length in lengths)]
    axes = [
        _Axis(name, [*dict.fromkeys(place[at] for place in places)], distinct)
        for at, name in enumerate("xy")
    ]
    parts: set[float] = set()
    written: list[str] = []
    for point, lanes in zip(route, _on_lanes(route), strict=True):
        for axis, value in zip(axes, point, strict=True):
            written += axis.go(value, lanes, parts)
    return ";".join(written)


class _Axis:
    """One axis of a route as it is walked: `last` is the coordinate reached, `known` are those that
    need no sum any more, `pace` is the length that was last gone along it.
    """

    def __init__(self, name: str, stated: list[float], lengths: list[float]) -> None:
        self.name, self.stated, self.lengths, self.lanes = name, stated, lengths, False
        self.known: set[float] = set()
        self.last: float | None = None
        self.pace: float | None = None

    def go(self, value: float, lanes: bool, parts: set[float]) -> Iterator[str]:
        """Walk to a coordinate: the sums that it needs; `parts` are lengths divided already."""
        if lanes and not self.lanes:
            self.pace = None
        self.lanes = lanes
        if value not in self.known and (found := self._found(value)):
            base, away, whole = found
            if whole is not None and away not in parts:
                yield f"{digits(whole)}/{digits(round(whole / away))}={digits(away)}"
                parts.add(away)
            sign = "+" if value > base else "-"
            yield f"{self.name}{digits(base)}{sign}{digits(away)}={digits(value)}"
            self.pace = away
        self.known.add(value)
        self.last = value

    def _found(self, value: float) -> tuple[float, float, float | None] | None:
        """The likeliest sum for a coordinate: what it can be reached from, how far away that is,
        and the length of the input that this is a part of.
        """
        # Lanes go on at their pace, over what is stated too.
        paced = self.lanes and self.last is not None and self.pace is not None
        on = paced and _near(abs(value - (self.last or 0)), self.pace or 0)
        if any(_near(value, other) for other in self.stated) and not on:
            return None
        sums = ((base, *one) for base, distances in self._sums() for one in distances)
        return next((one for one in sums if one[1] and _near(abs(value - one[0]), one[1])), None)

    def _sums(self) -> Iterator[tuple[float, list[_Away]]]:
        wholes: list[_Away] = [(length, None) for length in self.lengths]
        halves: list[_Away] = [(tidy(length / 2), length) for length in self.lengths]
        # The first lane begins half an area away from its middle.
        away = [*halves, *wholes] if self.lanes and self.pace is None else [*wholes, *halves]
        if self.last is not None:
            yield self.last, [(self.pace, None), *wholes] if self.pace else wholes
        yield self.stated[0], away
        if self.last is not None:
            # Where the number of the lanes is said, they lie a part of the area apart.
            every = itertools.product(PARTS, self.lengths if self.lanes else ())
            yield self.last, [*((tidy(whole / count), whole) for count, whole in every), *halves]
        yield from ((other, away) for other in self.stated[1:])


def _route(plan: Mapping[str, Any], vocabulary: Vocabulary) -> Iterator[_Point]:
    """The waypoints of a plan."""
    for movement in (step["navigation_skill"] for step in plan["skill_sequence"]):
        skill = vocabulary.skill.get(movement["name"])
        if skill is not None and skill.motion == "goto":
            x, y = (movement["parameters"].get(parameter.name) for parameter in skill.coordinates)
            if is_number(x) and is_number(y):
                yield x, y


def _on_lanes(route: Sequence[_Point]) -> list[bool]:
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
