"""Grids and squares in one part of a task input, and what all its parts share: places, facts,
lengths.

Lanes of a grid run along y from the south-west corner and a square starts in the middle of its east
side and goes counter-clockwise, unless the input says otherwise (labelling rules of the task
level). What is not certain raises Uncertain.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from planner_ft.data.quantities import quantities
from planner_ft.data.task import geometry as g
from planner_ft.decoding.constraints.reading import wordings as w

Point = g.Point


class Uncertain(Exception):
    """Something in the text could send the vehicle somewhere, and it is not clear where."""


@dataclass(frozen=True)
class Place:
    """A place that a text mentions, from `start` to `end`."""

    point: Point
    start: int
    end: int


@dataclass(frozen=True)
class Facts:
    """What the whole input gives to each of its parts: the task's parameters, its own place, home,
    and the one bearing that it turns to.
    """

    parameters: dict[str, Any]
    own: Point | None
    home: Point
    only_part: bool
    turned: float | None


def stated_lengths(text: str, places: list[Place]) -> list[tuple[float, int, int]]:
    """Lengths in metres that the text states outside its places, with where they stand."""
    return [
        (g.tidy(quantity.value), quantity.start, quantity.end)
        for quantity in quantities(text)
        if quantity.unit == "m"
        and quantity.value > 0
        and not any(place.start <= quantity.start < place.end for place in places)
    ]


def stated_sizes(text: str, places: list[Place]) -> list[tuple[float, int, int]]:
    """The lengths that are no margins, accuracies and distances kept."""
    return [
        found for found in stated_lengths(text, places) if not _is_margin(text, found[1], found[2])
    ]


def _is_margin(text: str, start: int, end: int) -> bool:
    before, behind = w.CLAUSE.split(text[:start])[-1], w.CLAUSE.split(text[end:])[0]
    return w.MARGIN.search(before[-30:]) is not None or w.MARGIN.search(behind[:30]) is not None


def stated_ways(text: str, places: list[Place]) -> Iterator[tuple[float, float, int, int, bool]]:
    """Lengths with a compass direction behind them: length, bearing, start, end, and whether it is
    "north of" something.
    """
    for value, start, end in stated_lengths(text, places):
        match = w.WAY_BEHIND.match(text[end:])
        if match:
            yield value, w.bearing_of(match[1]), start, end + match.end(), match[2] is not None


def _centre(text: str, places: list[Place], facts: Facts) -> Point:
    """The centre of the one shape in a part that leads nowhere else."""
    if (
        len(places) > 1
        or w.LEADS.search(w.NO_LEAD.sub(" ", text))
        or any(stated_ways(text, places))
    ):
        raise Uncertain
    if places:
        if w.AT_CORNER.search(text[: places[0].start]):
            raise Uncertain
        return places[0].point
    if facts.own is None:
        raise Uncertain
    return facts.own


def grid_path(text: str, places: list[Place], facts: Facts) -> list[Point]:
    """The waypoints of the one grid in a part."""
    centre = _centre(text, places, facts)
    width, length, spacing = _sizes(text, places, facts)
    along, corner = _along(text), _grid_corner(text)
    # What is put together from all words must be the same (lanes imports from here).
    from planner_ft.decoding.constraints.reading.paths.lanes import read_lanes

    if read_lanes(text, width, length) != (corner, along):
        raise Uncertain
    lanes = g.lane_count(width if along == "y" else length, spacing) if spacing > 0 else None
    if lanes is None or not 2 <= lanes <= w.MOST_LANES:
        raise Uncertain
    return g.lawnmower(centre, width, length, spacing, corner, along)


def _sizes(text: str, places: list[Place], facts: Facts) -> tuple[float, float, float]:
    """Width, length and spacing: those of the text, else the task's own; each length of the text
    must be one of them.
    """
    said: dict[str, float] = {}
    rest = stated_sizes(text, places)
    for name, value, used in named_sizes(text, rest):
        if said.setdefault(name, value) != value:
            raise Uncertain
        rest = [found for found in rest if found[1] not in used]
    sizes = [said.get(name, facts.parameters.get(name)) for name in ("width", "length", "spacing")]
    if not all(isinstance(size, int | float) for size in sizes) or any(
        value not in sizes for value, _start, _end in rest
    ):
        raise Uncertain
    return sizes[0], sizes[1], sizes[2]  # type: ignore[return-value]


def named_sizes(
    text: str, lengths: list[tuple[float, int, int]]
) -> Iterator[tuple[str, float, set[int]]]:
    """(name, value, places in the text) of the sizes that a text names."""
    for value, start, end in lengths:
        before, behind = text[:start], text[end:]
        if w.IS_SPACING_BEHIND.match(behind) or w.IS_SPACING_BEFORE.search(before):
            yield "spacing", value, {start}
        elif w.IS_WIDTH.match(behind):
            yield "width", value, {start}
        elif w.IS_LENGTH.match(behind):
            yield "length", value, {start}
    for quantity in quantities(text):
        bare = (
            w.BARE_SIZE.match(text[quantity.end :])
            if quantity.unit is None and quantity.value > 0
            else None
        )
        if bare:
            yield (
                "width" if bare["width"] else "length",
                g.tidy(quantity.value * _unit_before(text, quantity.start)),
                {quantity.start},
            )
    spans = sorted((quantity.start, quantity.end, quantity.said) for quantity in quantities(text))
    for (start, end, first), (following, _end, second) in itertools.pairwise(spans):
        if w.BY.fullmatch(text[end:following]) or w.BY.fullmatch(
            re.sub(r"^\s?k?m\b|^\s?met(?:re|er)s?\b", "", text[end:following])
        ):
            values = [value for value, at, _end in lengths if at in (start, following)]
            if len(values) == 2:
                yield "width", values[0], {start}
                yield "length", values[1], {following}
            elif len(values) == 1 and g.tidy(second) == values[0]:
                yield "width", g.tidy(first), {start}
                yield "length", values[0], {following}


def _unit_before(text: str, at: int) -> float:
    """Metres of the unit in which the length before is said: "three hundred feet wide, six hundred
    long".
    """
    before = [
        quantity
        for quantity in quantities(text)
        if quantity.unit == "m" and quantity.start < at and quantity.said
    ]
    return before[-1].value / before[-1].said if before else 1


def _along(text: str) -> g.Axis:
    text = w.EXTENT.sub(r"\1", text)
    x, y = w.LANES_X.search(text), w.LANES_Y.search(text)
    if x and y:
        raise Uncertain
    return "x" if x else "y"


def _grid_corner(text: str) -> g.Corner:
    """The corner that a grid starts at."""
    plain = w.LANES_Y.sub(" ", w.LANES_X.sub(" ", w.EXTENT.sub(r"\1", text)))
    named = {named_corner(match) for match in w.CORNER.finditer(plain)}
    rest = w.STEP.sub(" ", w.CORNER.sub(" ", plain))
    steps = [match[1].lower() for match in w.STEP.finditer(plain)]
    if len(named) > 1 or w.COMPASS.search(rest) or (not named and (steps or w.BEGINS.search(rest))):
        raise Uncertain
    corner = named.pop() if named else "south-west"
    if any(step in corner for step in steps):
        raise Uncertain
    return corner


def named_corner(match: re.Match[str]) -> g.Corner:
    """The corner that a match of CORNER names."""
    south, west = (match[3][0], match[3][1]) if match[3] else (match[1], match[2])
    return next(
        corner
        for corner in g.CORNERS
        if corner.startswith(south[0].lower()) and corner.split("-")[1].startswith(west[0].lower())
    )


def square_path(text: str, places: list[Place], facts: Facts) -> list[Point]:
    """The waypoints of the one survey square in a part."""
    centre = _centre(text, places, facts)
    turns = {match[1] is None for match in w.CLOCKWISE.finditer(text)}
    if (w.NO_SQUARE.search(text) and not w.EIGHT.search(text)) or len(turns) > 1:
        raise Uncertain
    return g.survey_square(
        centre, _radius(text, places, facts), _square_start(text), clockwise=True in turns
    )


def _radius(text: str, places: list[Place], facts: Facts) -> float:
    said = {value for value, _start, _end in stated_sizes(text, places)}
    own = facts.parameters.get("radius")
    if isinstance(own, int | float) and (
        said == {own}
        or (
            not said
            and (facts.only_part or w.OWN_SIZE.search(text))
            and not stated_lengths(text, places)
        )
    ):
        return own
    if len(said) != 1 or len(stated_lengths(text, places)) > 1:
        raise Uncertain
    return said.pop()


def _square_start(text: str) -> str:
    corners = {str(named_corner(match)) for match in w.CORNER.finditer(text)}
    plain = w.CORNER.sub(" ", text)
    sides = {re.sub(r"ern$", "", match[1] or match[2]).lower() for match in w.SIDE.finditer(plain)}
    named = corners | sides
    if (
        len(named) > 1
        or w.COMPASS.search(w.SIDE.sub(" ", plain))
        or (not named and w.BEGINS.search(plain))
    ):
        raise Uncertain
    return named.pop() if named else "east"
