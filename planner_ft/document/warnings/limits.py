"""Limits that the track breaks, and structures that it comes too close to."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Mapping
from typing import Any

from planner_ft.document.clearance import MOVING, close_legs, shown, way_off
from planner_ft.document.limits import limits_of
from planner_ft.document.track import Leg, Track
from planner_ft.document.warnings.warning import Warning, named, warning
from planner_ft.planning.limits import time_left, without_limits
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.limits import load_limits
from planner_ft.vocabulary.plans import step_skills

TOLERANCE = 0.5
"""Metres by which a leg may miss a limit."""


def limit_warnings(
    document: Mapping[str, Any], path: Track, vocabulary: Vocabulary
) -> Iterator[Warning]:
    """One per limit that is broken, and per structure that a task comes too close to."""
    tasks = {task["id"]: task for task in document["tasks"]}
    told = set()
    for limit in limits_of(document, vocabulary):
        told |= {limit["values"].get("object"), shown(limit["values"].get("position", (0, 0)))}
        found = _broken(limit, document, path, vocabulary)
        if found:
            name, how = found
            where = f"{named(tasks[name])}: " if name else ""
            text = f'{where}{how}, against the limit "{limit["text"].rstrip(".")}".'
            about = f"{limit['kind']}:{limit['text'].casefold()}"
            yield warning("limit-broken", text, tasks.get(name), about=about)
    for name, structure, metres in close_legs(document, path.legs, vocabulary):
        if structure.name not in told and shown(structure.position) not in told:
            text = f"{named(tasks[name])} passes {metres:.1f} m from {structure.name}"
            at = f" at {shown(structure.position)}" * (structure.name != shown(structure.position))
            text += f"{at}; the stand-off from it is {structure.standoff:g} m."
            yield warning("structure-close", text, tasks[name], about=shown(structure.position))


def _broken(
    limit: Mapping[str, Any], document: Mapping[str, Any], path: Track, vocabulary: Vocabulary
) -> tuple[str, str] | None:
    """(task, how) of the first thing that breaks a limit; no task: the whole plan does."""
    kind, values = limit["kind"], limit["values"]
    held = [document["tasks"][place - 1] for place in limit["tasks"]]
    names = {task["id"] for task in held}
    legs = [leg for leg in path.legs if leg.points and leg.task in names]
    if kind in ("fence", "keep_out_area"):
        return _area(kind, values["polygon"], legs)
    if kind == "keep_out" and "position" in values:
        return _too_close(values, legs)
    if kind == "distance":
        away = [
            (math.dist(point, vocabulary.home), leg.task) for leg in legs for point in leg.points
        ]
        farthest, task = max(away, default=(0.0, ""))
        too_far = farthest > values["distance"] + TOLERANCE
        return (task, f"goes {farthest:.0f} m away from home") if too_far else None
    if kind == "speed":
        return _too_fast(values["speed"], held, vocabulary)
    most = time_left(values) if kind == "return" else values.get("duration")
    if most is not None and len(held) == len(document["tasks"]):
        seconds = (document.get("estimate") or {}).get("seconds", 0)
        return ("", f"The plan takes about {seconds} s") if seconds > most else None
    if kind == "no_recording":
        return _recording(limit, held, vocabulary)
    return None


def _area(kind: str, corners: Any, legs: list[Leg]) -> tuple[str, str] | None:
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


def _too_close(values: Mapping[str, Any], legs: list[Leg]) -> tuple[str, str] | None:
    place = values["position"][0], values["position"][1]
    found = []
    for leg in legs:
        pairs = itertools.pairwise(leg.points) if leg.kind in MOVING else [(leg.points[0],) * 2]
        found.append((min(way_off(place, *pair) for pair in pairs), leg.task))
    nearest, task = min(found, default=(math.inf, ""))
    slack = max(TOLERANCE, 0.005 * values["distance"])
    return (task, f"comes within {nearest:.0f} m") if nearest < values["distance"] - slack else None


def _too_fast(
    limit: float, tasks: list[dict[str, Any]], vocabulary: Vocabulary
) -> tuple[str, str] | None:
    for task in tasks:
        for item in vocabulary.task[task["title"]].parameters:
            speed = task["parameters"].get(item.name) if item.unit == "m/s" else None
            if speed is not None and speed > limit:
                return task["id"], f"goes at {speed:g} m/s"
    return None


def _recording(
    limit: Mapping[str, Any], tasks: list[dict[str, Any]], vocabulary: Vocabulary
) -> tuple[str, str] | None:
    """A step that records: anywhere, or where the task prompt names the place."""
    forbidden = load_limits(vocabulary)["no_recording"].forbids
    thing = limit["values"].get("object", "")
    for task in tasks:
        prompt = without_limits(task["task_prompt"], vocabulary)
        if thing and thing.casefold() not in prompt.casefold():
            continue
        for step in task.get("skill_sequence") or ():
            for _role, skill in step_skills(step):
                if skill["name"] in forbidden:
                    return task["id"], f"records ({skill['name']})"
    return None
