"""The paths of a task that is one grid or one survey square, where its input leaves some choice
about it.

Sizes are those that the text names, else the task's own; a length that the text does not name may
be the spacing of lanes or the half side. Where the text speaks of another way as well, or of
several places, this is not read.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterator
from typing import Any

from planner_ft.data.quantities import positions, quantities
from planner_ft.data.stated import radio_digits
from planner_ft.data.task import geometry as g
from planner_ft.decoding.constraints.reading import wordings as w
from planner_ft.decoding.constraints.reading.paths.cues import ANY, read_cues
from planner_ft.decoding.constraints.reading.paths.itinerary import without_fences
from planner_ft.decoding.constraints.reading.paths.lanes import read_lanes
from planner_ft.decoding.constraints.reading.paths.shapes import (
    Place,
    named_sizes,
    stated_sizes,
    stated_ways,
)
from planner_ft.vocabulary import Task

Point = g.Point
Path = tuple[Point, ...]
SHAPE = {
    "lawnmower": re.compile(
        r"\b(?:grid|lawn-?mow\w*|mow\w*|lanes?|lines|legs|swaths?|strips?|rows|back and"
        r" forth|block|area|patch|transects|cover(?: it)?)\b",
        re.IGNORECASE,
    ),
    "square": re.compile(
        r"\b(?:squares?|corners?|(?:middle|centre|center) of (?:the|its)"
        r" (?:north|south|east|west)(?:ern)? side|mid-?sides?)\b",
        re.IGNORECASE,
    ),
}
"""Words that speak of a task's own shape."""
AREA = re.compile(
    r"\bcorners? (?:of (?:the|its) (?:box|area|block) )?(?:is|are|at)\b|\brectangle"
    r" between\b|\b(?:from|between) [\[(]?[-−]?\d",
    re.IGNORECASE,
)
"""Words for an area that two stated places are the corners of."""
OTHER_WAY = re.compile(
    r"\b(?:transect|(?:on|along) (?:an? |the )?(?:course|heading|bearing)|track|cable|then"
    r" (?:go|run|head|drive|move)|can wait|no grid|home|base|"
    r"instead of the grid|zig-?zag|spiral|triang\w+|circle of|points? (?:a?round|evenly)|evenly"
    r" spaced|two (?:grids|squares)|"
    r"(?:half|part|rest) of the (?:area|block|grid))\b",
    re.IGNORECASE,
)
"""Words for a way that is none of the two shapes, or for more than one of them."""
CORNERS_ONLY = re.compile(
    r"\b(?:corners? (?:only|alone)|only (?:the )?(?:four )?corners)\b", re.IGNORECASE
)
FOUR_CORNERS = re.compile(r"\b(?:four|4) corners\b", re.IGNORECASE)
CLOSED = re.compile(
    r"\bclos(?:e|es|ed|ing) (?:it|the|its|with)\b|\b(?:finish|end|back)\w* (?:at|on) (?:the |its"
    r" )?(?:very )?(?:start|first|same|point)",
    re.IGNORECASE,
)
HALF = re.compile(
    r"\bhalf (?:of )?(?:the |its |this )?(?:\w+ )?(?:square|round|ring|circuit)\b|\bhalf only\b",
    re.IGNORECASE,
)
MID_SIDES_ONLY = re.compile(
    r"\b(?:only (?:the |its |at the )?(?:four |4 )?(?:mid-?sides?|mid-?side"
    r" (?:points|waypoints)|middles of the (?:four )?sides)|mid-?sides? (?:points |"
    r"waypoints )?(?:only|alone)(?=\W*(?:$|[.,;:)]))|"
    r"(?:four|4) mid-?sides? (?:points |waypoints )?(?:and |, )?(?:no|not the|without the|leaving"
    r" out the) corners)\b",
    re.IGNORECASE,
)
AT_CORNERS = re.compile(r"\bat (?:the |all |its |each of the )?(?:four )?corners\b", re.IGNORECASE)
"""Something is done at the corners: they are run."""
FULL = re.compile(r"\b(?:eight|standard)\b", re.IGNORECASE)
MID_SIDES = re.compile(r"\b(?:mid-?sides?|middles?|between)\b", re.IGNORECASE)
"""Words for the waypoints that are no corners."""
CIRCLE = re.compile(r"\W{0,2}(?:circle|radius|ring|watch)\b", re.IGNORECASE)
WITHIN_LANES = re.compile(
    r"(?:east|west|north|south)\W+to\W+(?:east|west|north|south)", re.IGNORECASE
)


def one_shape(
    text: str, parameters: dict[str, Any], task: Task, own: Point | None
) -> tuple[tuple[Path, ...], tuple[Point, ...]] | None:
    """The paths that the task can be, and other places that the text names; None where it may be
    something else.
    """
    if task.pattern not in SHAPE or not SHAPE[task.pattern].search(text):
        return None
    plain = without_fences(radio_digits(text))
    places = [
        Place(g.point(x, y), start, end)
        for x, y, start, end in positions(plain)
        if not w.SIZE.search(plain[start:end])
    ]
    lanes = WITHIN_LANES.sub(" ", w.LANES_Y.sub(" ", w.LANES_X.sub(" ", plain)))
    if OTHER_WAY.search(plain) or w.TO_OWN.search(plain) or any(stated_ways(lanes, [])):
        return None
    if any(w.AT_CORNER.search(plain[: place.start]) for place in places[:1]):
        return None
    apart = [place.point for place in places if place.point != own]
    if len(apart) == 2 and AREA.search(plain) and task.pattern == "lawnmower":
        area: tuple[Point, Point] | None = (apart[0], apart[1])
        apart = []
    else:
        area = None
    if len(apart) > 1 or (own is None and len(apart) != 1 and area is None):
        return None
    if own is None and area is None:
        own, apart = apart[0], []
    found = tuple(
        dict.fromkeys(
            path
            for centre in (own, *apart)
            for path in _paths(plain, places, parameters, task, centre, area)
        )
    )
    return (found, tuple(apart)) if found else None


def _paths(
    text: str,
    places: list[Place],
    parameters: dict[str, Any],
    task: Task,
    centre: Point | None,
    area: tuple[Point, Point] | None,
) -> Iterator[Path]:
    """The grids, or squares, round a centre."""
    return (
        _grids(text, places, parameters, centre, area)
        if task.pattern == "lawnmower"
        else _squares(text, places, parameters, centre)
    )


def _grids(
    text: str,
    places: list[Place],
    parameters: dict[str, Any],
    own: Point | None,
    area: tuple[Point, Point] | None,
) -> Iterator[Path]:
    lengths = stated_sizes(text, places)
    named: dict[str, float] = {}
    for name, value, used in named_sizes(text, lengths):
        named.setdefault(name, value)
        lengths = [length for length in lengths if length[1] not in used]
    if area:
        own = g.point((area[0][0] + area[1][0]) / 2, (area[0][1] + area[1][1]) / 2)
        named |= {"width": abs(area[0][0] - area[1][0]), "length": abs(area[0][1] - area[1][1])}
    width, length, spacing = (
        named.get(name, parameters.get(name)) for name in ("width", "length", "spacing")
    )
    if own is None or not isinstance(width, int | float) or not isinstance(length, int | float):
        return
    counts = [
        int(quantity.said)
        for quantity in quantities(text)
        if quantity.unit is None and quantity.said in range(2, 25)
    ]
    others = (
        [
            value
            for value, _start, end in lengths
            if value not in (width, length) and not CIRCLE.match(text[end:])
        ]
        if "spacing" not in named
        else []
    )
    lanes_told = read_lanes(text, width, length)
    axes, corners = (
        ((lanes_told[1],), (lanes_told[0],)) if lanes_told else (read_cues(text).axes, ANY.corners)
    )
    for axis in axes:
        across = width if axis == "y" else length
        spacings = (
            [*others, spacing]
            if isinstance(spacing, int | float)
            else others or [across / (count - 1) for count in counts]
        )
        for distance, corner in itertools.product(dict.fromkeys(spacings), corners):
            lanes = g.lane_count(across, distance) if distance > 0 else None
            if lanes is not None and 2 <= lanes <= w.MOST_LANES:
                yield tuple(g.lawnmower(own, width, length, distance, corner, axis))


def _squares(
    text: str, places: list[Place], parameters: dict[str, Any], own: Point | None
) -> Iterator[Path]:
    if own is None:
        return
    cues, lengths = read_cues(text), [value for value, _start, _end in stated_sizes(text, places)]
    radius = parameters.get("radius")
    radii = lengths or ([radius] if isinstance(radius, int | float) else [])
    for half_side, start, clockwise in itertools.product(
        dict.fromkeys(radii), cues.starts, cues.turns
    ):
        square = tuple(g.survey_square(own, half_side, start, clockwise=clockwise))
        mid_sides = MID_SIDES_ONLY.search(text) and not AT_CORNERS.search(text)
        if _only_corners(text) or (mid_sides and "-" not in start):
            yield square[::2]
        elif mid_sides:
            yield square[1::2]
        elif HALF.search(text):
            yield square[: len(square) // 2 + 1]
        else:
            yield (*square, square[0]) if CLOSED.search(text) else square


def _only_corners(text: str) -> bool:
    """Whether a square is run from corner to corner. "At the four corners and not at the mid-sides"
    says where something is done on the whole of it.
    """
    said = CORNERS_ONLY.search(text) or (FOUR_CORNERS.search(text) and not MID_SIDES.search(text))
    return bool(said) and not FULL.search(text) and not MID_SIDES_ONLY.search(text)
