"""The paths of grids, squares and rings that the facts of a task can mean: from a centre, a size
and a spacing follow the lanes of a grid.

Geometry as in agents' answers (planner_ft.data.task.geometry): metres, x east, y north, bearings
clockwise from north.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from planner_ft.data.task import geometry as g

Point = g.Point
Path = tuple[Point, ...]

MOST_PATHS = 4000
MOST_WAYPOINTS = 64
GRID = re.compile(
    r"\b(?:grid|lawn-?mow\w*|lanes?|lines?|tracks?|legs|runs|swaths?|transects?|strips?|passes|rows?|depths?|box|rectangle|cover|sweep|sound)\b",
    re.I,
)
ROUND = re.compile(
    r"\b(?:square|round|around|about|circle|ring|circuit|perimeter|survey\w*|inspect\w*|points?|waypoints?|stops?|stand-?off|corners?)\b",
    re.I,
)
FOUR = re.compile(
    r"\b(?:(?:four|4)\W(?:corner|point|waypoint|mid|side)\w*|corners? (?:only|alone)|only (?:the"
    r" )?(?:four )?corners)\b",
    re.I,
)
HALF = re.compile(
    r"\bhalf (?:of )?(?:the |its |this )?(?:\w+ )?(?:square|round|ring|way"
    r" round|side|circuit)\b|\bhalf only\b",
    re.I,
)
CLOSED = re.compile(
    r"\b(?:clos(?:e|es|ed|ing)|(?:back|return\w*) (?:at|to|on) (?:the |its |your"
    r" )?(?:start|first|same))\b",
    re.I,
)


@dataclass(frozen=True)
class PathFacts:
    """What paths are made of; `said` are the lengths of the prompt, `lengths` those and the task's
    own.
    """

    text: str
    parameters: dict[str, Any]
    centres: tuple[Point, ...]
    lengths: tuple[float, ...]
    said: tuple[float, ...]
    counts: tuple[int, ...]
    bearings: tuple[float, ...]


def derived_paths(facts: PathFacts, pattern: str) -> tuple[Path, ...]:
    """Every path that the facts can mean in a task of this pattern."""
    grids = _grids(facts) if pattern == "lawnmower" or GRID.search(facts.text) else ()
    rings = _rings(facts) if pattern == "square" or ROUND.search(facts.text) else ()
    return tuple(dict.fromkeys(itertools.islice(itertools.chain(grids, rings), MOST_PATHS)))


# ---------------------------------------------------------------- grids


def _grids(facts: PathFacts) -> Iterator[Path]:
    for centre, (width, length, spacing) in itertools.product(
        facts.centres, dict.fromkeys(_sizes(facts))
    ):
        for middle in (centre, *_middles(centre, width, length, facts.text)):
            yield from _lanes(middle, width, length, spacing)
    yield from _between_corners(facts)


def _sizes(facts: PathFacts) -> Iterator[tuple[float, float, float]]:
    """Width, length and lane spacing: the task's own; else any three stated lengths, or two and a
    number of lanes.
    """
    given = tuple(facts.parameters.get(name) for name in ("width", "length", "spacing"))
    if all(isinstance(value, int | float) for value in given):
        yield given  # type: ignore[misc]
        if not set(facts.said) - set(given):
            return
    for width, length in itertools.product(facts.lengths, repeat=2):
        for spacing in facts.lengths:
            if spacing <= max(width, length):
                yield width, length, spacing
        for lanes in facts.counts:
            yield width, length, width / (lanes - 1)
            yield width, length, length / (lanes - 1)


def _middles(corner: Point, width: float, length: float, prompt: str) -> list[Point]:
    """The centres of areas that have a corner at a stated place."""
    if "corner" not in prompt.lower():
        return []
    return [
        g.point(corner[0] + x * width / 2, corner[1] + y * length / 2)
        for x, y in itertools.product((1, -1), repeat=2)
    ]


def _between_corners(facts: PathFacts) -> Iterator[Path]:
    """The lanes of areas that two stated places are opposite corners of."""
    for one, other in itertools.combinations(facts.centres, 2):
        width, length = abs(one[0] - other[0]), abs(one[1] - other[1])
        for lanes in (lanes for lanes in facts.counts if width and length):
            yield from _lanes(_middle(one, other), width, length, width / (lanes - 1))
            yield from _lanes(_middle(one, other), width, length, length / (lanes - 1))
        for spacing in facts.lengths if width and length else ():
            yield from _lanes(_middle(one, other), width, length, spacing)


def _middle(one: Point, other: Point) -> Point:
    return g.point((one[0] + other[0]) / 2, (one[1] + other[1]) / 2)


def _lanes(centre: Point, width: float, length: float, spacing: float) -> Iterator[Path]:
    axes: tuple[g.Axis, ...] = ("y", "x")
    for axis in axes:
        across = width if axis == "y" else length
        lanes = g.lane_count(across, spacing) if spacing > 0 else None
        if lanes is None or not 2 <= lanes <= MOST_WAYPOINTS // 2:
            continue
        for corner in g.CORNERS:
            yield tuple(g.lawnmower(centre, width, length, spacing, corner, axis))


# ---------------------------------------------------------------- squares and rings


def _rings(facts: PathFacts) -> Iterator[Path]:
    for centre, radius in itertools.product(facts.centres, facts.lengths):
        for start, clockwise in itertools.product(g.SQUARE_STARTS, (False, True)):
            yield from _square(
                tuple(g.survey_square(centre, radius, start, clockwise=clockwise)), facts.text
            )
        for count, bearing, clockwise in itertools.product(
            facts.counts, dict.fromkeys((*facts.bearings, 0, 90)), (False, True)
        ):
            if count >= 3:
                yield from _closed(
                    tuple(g.circle(centre, radius, count, bearing, clockwise=clockwise)), facts.text
                )


def _square(square: Path, text: str) -> Iterator[Path]:
    """A survey square, or its corners or mid-sides alone."""
    yield from _closed(square, text)
    if FOUR.search(text):
        yield from _closed(square[::2], text)
    if HALF.search(text):
        yield square[: len(square) // 2 + 1]


def _closed(ring: Path, text: str) -> Iterator[Path]:
    """The ring, and also with its first waypoint at the end where the text speaks of closing it."""
    yield ring
    if CLOSED.search(text):
        yield (*ring, ring[0])
