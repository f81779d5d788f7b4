"""What the track breaks: limits, stand-offs, boundaries, the vehicle's area, its reach."""

from __future__ import annotations

import functools
import itertools
import math
import re
from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from planner_ft.document.structures import MOVING, close_legs, way_off
from planner_ft.document.track import Leg, Point, place_of, shown, stated
from planner_ft.document.warnings.case import Case, skills_of
from planner_ft.document.warnings.kinds import Warning, warning
from planner_ft.facts.places import read_positions
from planner_ft.planning.limits import time_left, without_limits
from planner_ft.vocabulary.limits import load_limits

TOLERANCE = 0.5
"""Metres by which a leg may miss a limit, and beyond a boundary that are its line still."""
INSIDE = re.compile(r"(?i)\b(?:inside|within|boundary|fence|geofence|box|polygon|leave)\b")
Found = tuple[str, str] | None
"""(task, how) of the first thing that breaks a limit."""


# ---------------------------------------------------------------- limits and stand-offs


def broken_limits(case: Case) -> Iterator[Warning]:
    """One per limit that is broken."""
    for limit in case.limits:
        named = {"limit": limit["text"].rstrip(".")}
        about = f"{limit['kind']}:{limit['text'].casefold()}"
        held = [case.tasks[place - 1] for place in limit["tasks"]]
        most, seconds = _longest(limit), (case.document.get("estimate") or {}).get("seconds", 0)
        if most is not None and len(held) == len(case.tasks):
            if seconds > most:
                yield warning("limit-broken", "plan", about=about, seconds=seconds, **named)
        elif found := _broken(limit, held, case):
            task, how = case.by_id[found[0]], found[1]
            yield warning("limit-broken", "task", task, about=about, how=how, **named)


def _longest(limit: Mapping[str, Any]) -> float | None:
    """Seconds that a limit gives to what it holds for."""
    values: dict[str, Any] = limit["values"]
    return time_left(values) if limit["kind"] == "return" else values.get("duration")


def _broken(limit: Mapping[str, Any], held: list[dict[str, Any]], case: Case) -> Found:
    kind, values, names = limit["kind"], limit["values"], {task["id"] for task in held}
    legs = [leg for leg in case.path.legs if leg.points and leg.task in names]
    if kind in ("fence", "keep_out_area"):
        return _area(kind, values["polygon"], legs)
    if kind == "keep_out" and "position" in values:
        return _too_close(values, legs)
    if kind == "distance":
        home = case.vocabulary.home
        away = [(math.dist(point, home), leg.task) for leg in legs for point in leg.points]
        farthest, task = max(away, default=(0.0, ""))
        too_far = farthest > values["distance"] + TOLERANCE
        return (task, f"goes {farthest:.0f} m away from home") if too_far else None
    if kind == "speed":
        return _too_fast(values["speed"], held, case)
    return _recording(limit, held, case) if kind == "no_recording" else None


def _area(kind: str, corners: Any, legs: list[Leg]) -> Found:
    from shapely import LineString, Point, Polygon, make_valid

    area, inside = make_valid(Polygon(corners)), kind == "fence"
    bounds = area.buffer(TOLERANCE if inside else -TOLERANCE)
    for leg in legs:
        line = LineString(leg.points) if len(leg.points) > 1 else Point(leg.points[0])
        if inside and not bounds.covers(line):
            ends = (point for point in leg.points if not bounds.covers(Point(point)))
            at = next(ends, None)
            where = f"goes to {shown(at)}, outside of it" if at else "leaves it on the way"
            return leg.task, where
        if not inside and bounds.intersects(line):
            return leg.task, f"enters it on the way to {shown(leg.points[-1])}"
    return None


def _too_close(values: Mapping[str, Any], legs: list[Leg]) -> Found:
    place, found = (values["position"][0], values["position"][1]), []
    for leg in legs:
        pairs = itertools.pairwise(leg.points) if leg.kind in MOVING else [(leg.points[0],) * 2]
        found.append((min(way_off(place, *pair) for pair in pairs), leg.task))
    nearest, task = min(found, default=(math.inf, ""))
    slack = max(TOLERANCE, 0.005 * values["distance"])
    return (task, f"comes within {nearest:.0f} m") if nearest < values["distance"] - slack else None


def _too_fast(limit: float, tasks: list[dict[str, Any]], case: Case) -> Found:
    for task in tasks:
        for speed in stated(task, "m/s", case.vocabulary).values():
            if speed is not None and speed > limit:
                return task["id"], f"goes at {speed:g} m/s"
    return None


def _recording(limit: Mapping[str, Any], tasks: list[dict[str, Any]], case: Case) -> Found:
    """A step that records: anywhere, or where the task prompt names the place."""
    forbidden = load_limits(case.vocabulary)["no_recording"].forbids
    thing = limit["values"].get("object", "")
    for task in tasks:
        prompt = without_limits(task["task_prompt"], case.vocabulary)
        if not thing or thing.casefold() in prompt.casefold():
            for _role, skill in skills_of(task):
                if skill["name"] in forbidden:
                    return task["id"], f"records ({skill['name']})"
    return None


def close_structures(case: Case) -> Iterator[Warning]:
    """One per structure that a task comes too close to and that no limit names."""
    limited = [limit["values"] for limit in case.limits]
    told = {one.get("object") for one in limited}
    told |= {shown(one.get("position", (0, 0))) for one in limited}
    for name, structure, metres in close_legs(case.document, case.path.legs, case.vocabulary):
        at, task = shown(structure.position), case.by_id[name]
        if structure.name not in told and at not in told:
            where = structure.name if structure.name == at else f"{structure.name} at {at}"
            values: dict[str, Any] = {
                "metres": metres,
                "name": where,
                "standoff": structure.standoff,
            }
            yield warning("structure-close", task=task, about=at, **values)


# ---------------------------------------------------------------- boundaries, area, reach


def boundaries(case: Case) -> Iterator[Warning]:
    """Waypoints outside their boundary: of their step, their task or the plan's constraints."""
    for name, step, polygon in _boundaries(case):
        yield from _outside("boundary", case.by_id[name], _reached(case, name, step), polygon)


def area_and_reach(case: Case) -> Iterator[Warning]:
    """Waypoints outside the vehicle's area, or too far away to return."""
    vehicle, home = case.vehicle, case.vocabulary.home
    for task in case.tasks:
        place = place_of(task, case.vocabulary)
        reached = [*([place] if place else ()), *_reached(case, task["id"])]
        if vehicle.get("area"):
            yield from _outside("area", task, reached, _polygon(vehicle["area"]))
        if not vehicle.get("endurance"):
            continue
        reach = vehicle["cruise_speed"] * vehicle["endurance"] / 2
        farthest = max(reached, key=lambda point: math.dist(point, home), default=home)
        if (away := math.dist(farthest, home)) > reach:
            where = {"place": shown(farthest), "away": away, "reach": reach}
            yield warning("out-of-reach", task=task, **where)


def _outside(
    kind: str, task: Mapping[str, Any], points: list[Point], area: Any
) -> Iterator[Warning]:
    from shapely import intersects_xy

    outside = next((point for point in points if not intersects_xy(area, *point)), None)
    if outside:
        yield warning(f"outside-{kind}", task=task, place=shown(outside))


def _boundaries(case: Case) -> Iterator[tuple[str, int | None, Any]]:
    """(task, step or None for all, polygon) of filter skills, task parameters and constraints."""
    fences = [
        [tuple(map(float, corner)) for corner in limit["values"]["polygon"]]
        for limit in case.limits
        if "polygon" in limit["values"]
    ]
    for boundary in case.path.boundaries:
        if list(boundary.polygon) not in fences:
            yield boundary.task, boundary.step, _polygon(boundary.polygon)
    limits = {limit["text"] for limit in case.limits}
    texts = [text for text in case.document.get("constraints", ()) if text not in limits]
    plan = [corners for text in texts for corners in _corners(text)]
    for task in case.tasks:
        parameters = case.vocabulary.task[task["title"]].parameters
        own = [task["parameters"].get(item.name) for item in parameters if item.type == "polygon"]
        yield from ((task["id"], None, _polygon(corners)) for corners in (*own, *plan) if corners)


def _corners(text: str) -> Iterator[list[Point]]:
    """The corners that a constraint names: "Stay inside [0, 0], [80, 0], [80, 50], [0, 50]."."""
    places = read_positions(text)
    found = [place for place in places if text[place.start - 1 : place.start] in ("[", "(")]
    corners = list(dict.fromkeys((place.x, place.y) for place in found))
    if len(corners) >= 3 and INSIDE.search(text):
        yield corners


def _reached(case: Case, task: str, step: int | None = None) -> list[Point]:
    """The points that legs of a task lead to; where a leg begins was reached before."""
    own = case.path.of(task, step)
    return [point for leg in own for point in leg.points[leg.kind in MOVING :]]


def _polygon(corners: Iterable[Any]) -> Any:
    return _prepared(tuple((float(x), float(y)) for x, y in corners))


@functools.lru_cache(maxsize=512)
def _prepared(corners: tuple[Point, ...]) -> Any:
    """The area with its line; corners with crossing sides enclose every reading of them."""
    from shapely import Polygon, make_valid, prepare

    shape = Polygon(corners)
    whole = shape if shape.is_valid else make_valid(shape).union(shape.convex_hull)
    area = whole.buffer(TOLERANCE)
    prepare(area)
    return area
