"""Waypoints of the movements that task plans are made of.

Frame: metres, x east, y north; headings in degrees clockwise from north. All functions are pure and
round to two decimals, whole numbers as ints.
"""

from __future__ import annotations

import math
from typing import Literal

Point = tuple[float, float]
Corner = Literal["south-west", "south-east", "north-east", "north-west"]
Axis = Literal["x", "y"]

CORNERS: tuple[Corner, ...] = ("south-west", "south-east", "north-east", "north-west")

# Counter-clockwise round the square from the middle of its east side, in units of half a side.
SQUARE: tuple[tuple[str, int, int], ...] = (
    ("east", 1, 0),
    ("north-east", 1, 1),
    ("north", 0, 1),
    ("north-west", -1, 1),
    ("west", -1, 0),
    ("south-west", -1, -1),
    ("south", 0, -1),
    ("south-east", 1, -1),
)
SQUARE_STARTS = tuple(name for name, _x, _y in SQUARE)


def tidy(value: float) -> float:
    """Two decimals at most, whole numbers as ints, no negative zero."""
    rounded = round(value, 2)
    return int(rounded) if rounded == int(rounded) else rounded


def point(x: float, y: float) -> Point:
    """The point with tidy coordinates."""
    return tidy(x), tidy(y)


def offset(start: Point, heading: float, distance: float) -> Point:
    """The point `distance` metres from `start` on `heading`."""
    angle = math.radians(heading)
    return point(start[0] + distance * math.sin(angle), start[1] + distance * math.cos(angle))


def straight_line(start: Point, heading: float, length: float) -> list[Point]:
    """Start and end of a pass or a cable track."""
    return [point(*start), offset(start, heading, length)]


def survey_square(
    center: Point, half_side: float, start: str = "east", *, clockwise: bool = False
) -> list[Point]:
    """Mid-sides and corners of the square from the named one on ("east": a mid-side)."""
    first = SQUARE_STARTS.index(start)
    step = -1 if clockwise else 1
    ring = (SQUARE[(first + step * index) % len(SQUARE)] for index in range(len(SQUARE)))
    return [point(center[0] + x * half_side, center[1] + y * half_side) for _name, x, y in ring]


def lane_count(extent: float, spacing: float) -> int | None:
    """Lanes over `extent` where `spacing` divides it: only then all count the same; else None."""
    lanes = extent / spacing
    return round(lanes) + 1 if abs(lanes - round(lanes)) < 1e-9 else None


def lawnmower(
    center: Point,
    width: float,
    length: float,
    spacing: float,
    corner: Corner = "south-west",
    lanes_along: Axis = "y",
) -> list[Point]:
    """Ends of the lanes in the order in which they are run, two per lane, each lane against the one
    before.

    `width` lies along x and `length` along y. The first lane starts at `corner`; lanes step away
    from it. Raises ValueError when `spacing` does not divide the extent across the lanes.
    """
    axis, size = (0 if lanes_along == "y" else 1), (width, length)
    sides = (1 if "east" in corner else -1), (1 if "north" in corner else -1)
    lanes = lane_count(size[axis], spacing)
    if lanes is None:
        raise ValueError(f"lanes {spacing} m apart do not fill {size[axis]} m")
    reach = sides[1 - axis] * size[1 - axis] / 2
    points = []
    for lane in range(lanes):
        step = center[axis] + sides[axis] * (size[axis] / 2 - lane * spacing)
        for end in (reach, -reach) if lane % 2 == 0 else (-reach, reach):
            run = center[1 - axis] + end
            points.append(point(step, run) if axis == 0 else point(run, step))
    return points


def circle(
    center: Point, radius: float, count: int, start_bearing: float, *, clockwise: bool
) -> list[Point]:
    """`count` points evenly round the circle; the first at `start_bearing` from the centre."""
    step = 360 / count if clockwise else -360 / count
    return [offset(center, start_bearing + step * index, radius) for index in range(count)]


def sector_headings(count: int, start: float = 0, *, clockwise: bool = True) -> list[float]:
    """`count` headings evenly round the compass from `start` on, each in 0 up to 360."""
    step = 360 / count if clockwise else -360 / count
    return [tidy((start + step * index) % 360) for index in range(count)]
