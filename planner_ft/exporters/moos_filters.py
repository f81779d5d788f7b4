"""The behaviours that keep a vehicle inside a boundary and away from obstacles while a plan's
movements run.

Sources: as in moos_moves; BHV_OpRegionV24 takes convex polygons alone, BHV_AvoidObstacleV24 is
spawned by alerts of pObstacleMgr.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import groupby
from typing import Any

from planner_ft.exporters.moos_text import Point, number, points

INSIDE = ""
NOT_CONVEX = "as a SKILL_ variable alone: the helm's boundary must be convex, and this one is not"
NO_POLYGON = "as a SKILL_ variable alone: it says no boundary"
CLEARANCE = "by BHV_AvoidObstacleV24, which needs pObstacleMgr to tell it of obstacles"


@dataclass(frozen=True)
class Guard:
    """A behaviour that runs beside the movements `first` to `last`."""

    first: int
    last: int
    behaviour: str
    name: str
    settings: tuple[tuple[str, str], ...]


def guards(filters: Iterable[tuple[int, str, Any]]) -> Iterator[Guard]:
    """One behaviour per run of movements that keep the same boundary or clearance, of (movement's
    number, kind, polygon or distance).
    """
    by_value: dict[tuple[str, str], tuple[Any, list[int]]] = {}
    for movement, kind, value in filters:
        by_value.setdefault((kind, repr(value)), (value, []))[1].append(movement)
    spans = [
        (run[0], run[-1], kind, value)
        for (kind, _text), (value, numbers) in by_value.items()
        for run in _runs(numbers)
    ]
    for count, (first, last, kind, value) in enumerate(
        sorted(spans, key=lambda span: span[:3]), start=1
    ):
        settings = _region(value) if kind == "boundary" else _avoidance(value, count)
        behaviour = "BHV_OpRegionV24" if kind == "boundary" else "BHV_AvoidObstacleV24"
        yield Guard(first, last, behaviour, f"{kind}_{count}_", settings)


def _runs(numbers: list[int]) -> Iterator[list[int]]:
    """Consecutive numbers together."""
    distinct = sorted(set(numbers))
    for _offset, run in groupby(enumerate(distinct), key=lambda pair: pair[1] - pair[0]):
        yield [number for _index, number in run]


def is_region(polygon: Sequence[Sequence[float]]) -> bool:
    """Whether the helm takes a polygon as a region: it has an area, and turns one way alone, once
    around. A file with another is refused.
    """
    corners = _corners(polygon)
    turns = [_turn(corners, index) for index in range(len(corners))]
    return len(corners) > 2 and (min(turns) > 0 or max(turns) < 0) and _goes_once_around(corners)


def _corners(polygon: Sequence[Sequence[float]]) -> list[Point]:
    """The corners as they are written, without those that repeat another one or lie on a side: the
    helm refuses some.
    """
    rounded = [(round(float(x), 3), round(float(y), 3)) for x, y in polygon]
    distinct = [
        corner for index, corner in enumerate(rounded) if corner != rounded[index - 1]
    ] or rounded
    return [corner for index, corner in enumerate(distinct) if _turn(distinct, index)]


def _turn(corners: list[Point], index: int) -> float:
    """To which side the way round turns at a corner: above 0 to the left, 0 within a square
    millimetre of straight on.
    """
    (ax, ay), (bx, by), (cx, cy) = (
        corners[(index + offset) % len(corners)] for offset in (-1, 0, 1)
    )
    turn = (bx - ax) * (cy - by) - (by - ay) * (cx - bx)
    return turn if abs(turn) > 1e-6 else 0.0


def _goes_once_around(corners: list[Point]) -> bool:
    """Whether the sides change their direction along x twice: a star with five points does so more
    often.
    """
    ahead = [
        (corners[index][0], corners[index][1]) > (corners[index - 1][0], corners[index - 1][1])
        for index in range(len(corners))
    ]
    return (
        sum(first != second for first, second in zip(ahead, [*ahead[1:], ahead[0]], strict=True))
        == 2
    )


def _region(polygon: Any) -> tuple[tuple[str, str], ...]:
    return (("save_poly", points(_corners(polygon))),)


def _avoidance(distance: float | None, count: int) -> tuple[tuple[str, str], ...]:
    """The clearance is the closest approach that the behaviour accepts; it takes interest at four
    times the distance.
    """
    spawned = (("templating", "spawn"), ("updates", f"OBSTACLE_ALERT_{count}"))
    if not distance:
        return spawned
    named = {
        "min_util_cpa_dist": 1,
        "max_util_cpa_dist": 2,
        "pwt_inner_dist": 2,
        "pwt_outer_dist": 4,
        "completed_dist": 5,
    }
    return (*spawned, *((key, number(distance * factor)) for key, factor in named.items()))


def _bounded(polygon: Any) -> tuple[bool, str]:
    if not polygon:
        return False, NO_POLYGON
    return (True, INSIDE) if is_region(polygon) else (False, NOT_CONVEX)


def _cleared(_distance: float | None) -> tuple[bool, str]:
    return True, CLEARANCE


GUARDED: dict[str, Callable[[Any], tuple[bool, str]]] = {
    "boundary": _bounded,
    "clearance": _cleared,
}
"""Per kind of filter whether a behaviour stands for its polygon or distance, and how it does or why
not.
"""
