"""Waypoints outside a boundary that is stated for them, outside the vehicle's area, or too far away
to come back from.
"""

from __future__ import annotations

import functools
import math
import re
from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from planner_ft.data.quantities import positions
from planner_ft.document.track import Leg, Point, Track, place_of
from planner_ft.document.warnings.warning import Warning, named, warning
from planner_ft.vocabulary import Vocabulary

TOLERANCE = 0.5
"""Metres beyond a boundary that are its line still."""
INSIDE = re.compile(
    r"\b(?:inside|within|boundary|fence|geofence|box|polygon|leave)\b", re.IGNORECASE
)


def space_warnings(
    document: Mapping[str, Any], path: Track, vocabulary: Vocabulary
) -> Iterator[Warning]:
    """What the plan's own boundaries, the vehicle's area and its range do not allow."""
    tasks = {task["id"]: task for task in document["tasks"]}
    points = {name: list(_reached(legs)) for name, legs in _by_task(path.legs).items()}
    for name, where, polygon in _boundaries(document, path, vocabulary):
        outside = _first_outside(
            _reached(leg for leg in path.legs if leg.task == name and where in (None, leg.step)),
            polygon,
        )
        if outside:
            yield warning(
                "outside-boundary",
                f"{named(tasks[name])} goes to {_shown(outside)}, which is outside its boundary.",
                tasks[name],
            )
    vehicle = document.get("vehicle") or {}
    area = vehicle.get("area")
    for name, task in tasks.items():
        place = place_of(task, vocabulary)
        reached = [*([place] if place else ()), *points.get(name, ())]
        outside = _first_outside(reached, _polygon(area)) if area else None
        if outside:
            yield warning(
                "outside-area",
                f"{named(task)} goes to {_shown(outside)}, which is outside the vehicle's area.",
                task,
            )
        yield from _too_far(task, reached, vehicle, vocabulary)


def _too_far(
    task: Mapping[str, Any],
    reached: Iterable[Point],
    vehicle: Mapping[str, Any],
    vocabulary: Vocabulary,
) -> Iterator[Warning]:
    if not vehicle.get("endurance"):
        return
    reach = vehicle["cruise_speed"] * vehicle["endurance"] / 2
    farthest = max(reached, key=lambda point: math.dist(point, vocabulary.home), default=None)
    if farthest is not None and math.dist(farthest, vocabulary.home) > reach:
        text = (
            f"{named(task)} goes to {_shown(farthest)}, {math.dist(farthest, vocabulary.home):.0f}"
            f" m from home; the vehicle comes {reach:.0f} m far and back."
        )
        yield warning("out-of-reach", text, task)


def _boundaries(
    document: Mapping[str, Any], path: Track, vocabulary: Vocabulary
) -> Iterator[tuple[str, int | None, Any]]:
    """(task, step or None for all of them, polygon): of filter skills, of task parameters, and of
    the plan's constraints for every task.
    """
    for boundary in path.boundaries:
        yield boundary.task, boundary.step, _polygon(boundary.polygon)
    plan = [corners for text in document.get("constraints", ()) for corners in _corners(text)]
    for task in document["tasks"]:
        own = [
            task["parameters"].get(item.name)
            for item in vocabulary.task[task["title"]].parameters
            if item.type == "polygon"
        ]
        yield from ((task["id"], None, _polygon(corners)) for corners in (*own, *plan) if corners)


def _corners(text: str) -> Iterator[list[Point]]:
    """The corners that a constraint names: "Stay inside [0, 0], [80, 0], [80, 50], [0, 50]."."""
    corners = list(
        dict.fromkeys(
            (x, y)
            for x, y, start, _end in positions(text)
            if text[start - 1 : start] in ("[", "(") or text[start - 2 : start] in ("[-", "(-")
        )
    )
    if len(corners) >= 3 and INSIDE.search(text):
        yield corners


def _by_task(legs: Iterable[Leg]) -> dict[str, list[Leg]]:
    found: dict[str, list[Leg]] = {}
    for leg in legs:
        found.setdefault(leg.task, []).append(leg)
    return found


def _reached(legs: Iterable[Leg]) -> Iterator[Point]:
    """The points that legs lead to; where a leg begins was reached before."""
    for leg in legs:
        yield from leg.points[1:] if leg.kind in ("go", "arc") else leg.points


def _polygon(corners: Iterable[Any]) -> Any:
    return _prepared(tuple((float(x), float(y)) for x, y in corners))


@functools.lru_cache(maxsize=512)
def _prepared(corners: tuple[Point, ...]) -> Any:
    """The area inside, with what is its line still; corners in an order with crossing sides enclose
    what any reading of them does.
    """
    from shapely import Polygon, make_valid, prepare

    shape = Polygon(corners)
    area = (shape if shape.is_valid else make_valid(shape).union(shape.convex_hull)).buffer(
        TOLERANCE
    )
    prepare(area)
    return area


def _first_outside(points: Iterable[Point], area: Any) -> Point | None:
    from shapely import intersects_xy

    return next((point for point in points if not intersects_xy(area, *point)), None)


def _shown(point: Point) -> str:
    return f"[{point[0]:.6g}, {point[1]:.6g}]"
