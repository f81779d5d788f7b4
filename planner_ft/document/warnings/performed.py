"""Whether the steps of a task perform it: a grid covers its area, a pass has its length, a line
ends where its course leads, a square keeps its stand-off, a panorama looks in all its directions.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Mapping
from typing import Any

from planner_ft.document.warnings.warning import Warning, named, warning
from planner_ft.facts.geometry import offset
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import is_number

Point = tuple[float, float]
SIZE, SPACING = ("width", "length"), "spacing"
"""The parameters of a grid: extent along x and y, and between lanes."""
COURSE = ("heading", "max_dist")
"""Those of a line: its course and its length."""
MEASURES = ("m", "s", "m/s", "count")
"""Units of what cannot be nothing; an angle and a share can."""
TURNS = ("turn-to", "turn-by")
SLACK, SHARE = 0.5, 0.02
"""Metres, and the share of a length, by which waypoints may differ from it."""


def performed_warnings(document: Mapping[str, Any], vocabulary: Vocabulary) -> Iterator[Warning]:
    """One per task without a step that fits it, or whose waypoints are not those of its values.

    Waypoints that were added for clearance count with neither.
    """
    for task in document["tasks"]:
        yield from _nothing(task, vocabulary)
        steps = task["skill_sequence"] or []
        # A search may go anywhere.
        if not steps or task.get("stale") or task["title"] == vocabulary.locate:
            continue
        fitting = vocabulary.task[task["title"]].skills.get("navigation", ())
        if not any(step["navigation_skill"]["name"] in fitting for step in steps):
            text = f"{named(task)}: no step performs it; its steps do something else."
            yield warning("not-performed", text, task)
        elif problem := _geometry_problem(task, _waypoints(task, vocabulary), vocabulary):
            yield warning("not-performed", f"{named(task)}: {problem}.", task)


def _nothing(task: Mapping[str, Any], vocabulary: Vocabulary) -> Iterator[Warning]:
    """A size, distance, time or count of a task that is nothing."""
    for item in vocabulary.task[task["title"]].parameters:
        if item.unit in MEASURES and task["parameters"].get(item.name) == 0:
            text = f"{named(task)}: {item.name} is 0, with which nothing can be done."
            yield warning("not-performed", text, task, item.name)


def _waypoints(task: Mapping[str, Any], vocabulary: Vocabulary) -> list[Point]:
    clearance = {mark["step"] for mark in task.get("added", ()) if mark["kind"] == "clearance"}
    found = []
    for index, step in enumerate(task["skill_sequence"]):
        skill = step["navigation_skill"]
        names = [parameter.name for parameter in vocabulary.skill[skill["name"]].coordinates]
        if names and index not in clearance:
            found.append((skill["parameters"][names[0]], skill["parameters"][names[1]]))
    return found


def _geometry_problem(
    task: Mapping[str, Any], points: list[Point], vocabulary: Vocabulary
) -> str | None:
    known, given = vocabulary.task[task["title"]], task["parameters"]
    if known.pattern == "lawnmower" and all(is_number(given.get(name)) for name in SIZE):
        return _grid_problem([given[name] for name in SIZE], given.get(SPACING, 0), points)
    place = given.get(known.position_parameter or "")
    if known.pattern == "line" and place and all(is_number(given.get(name)) for name in COURSE):
        return _line_problem((place[0], place[1]), given[COURSE[0]], given[COURSE[1]], points)
    if known.pattern == "square" and place and is_number(given.get("radius")):
        return _square_problem((place[0], place[1]), given["radius"], points)
    if known.pattern == "sectors" and is_number(count := given.get("sectors")):
        names = [step["navigation_skill"]["name"] for step in task["skill_sequence"]]
        motions = [vocabulary.motion.of(name) for name in names]
        turns = sum(motion is not None and motion.kind in TURNS for motion in motions)
        return f"it turns {turns} times for {count:g} sectors" if turns < count - 1 else None
    length = given.get(SIZE[1])
    if known.pattern == "pass" and is_number(length) and points:
        pairs = itertools.combinations(points, 2)
        run = max((math.dist(*pair) for pair in pairs), default=0.0)
        if run < length * (1 - SHARE) - SLACK:
            return f"its waypoints are {run:.3g} m apart, and its length is {length:g} m"
    return None


def _line_problem(start: Point, heading: float, run: float, points: list[Point]) -> str | None:
    """The line ends at the length of its course from its start."""
    end = offset(start, heading, run)
    if not points or min(math.dist(end, one) for one in points) <= max(SLACK, SHARE * run):
        return None
    return f"no waypoint is at [{end[0]:g}, {end[1]:g}], {run:g} m on {heading:g} from its start"


def _square_problem(center: Point, radius: float, points: list[Point]) -> str | None:
    """Every waypoint lies on the square or the circle round the target."""
    for point in points:
        along_x, along_y = (abs(one - at) for one, at in zip(point, center, strict=True))
        away = max(along_x, along_y), math.hypot(along_x, along_y)
        if all(abs(one - radius) > max(SLACK, SHARE * radius) for one in away):
            return f"its waypoint [{point[0]:g}, {point[1]:g}] is not {radius:g} m off its target"
    return None


def _grid_problem(size: list[float], spacing: float, points: list[Point]) -> str | None:
    """Lanes reach over the whole of one side; along the other less than a spacing may be left."""
    spans = [max(axis) - min(axis) for axis in zip(*points, strict=True)] if points else [0.0, 0.0]
    rest = [extent - span for extent, span in zip(size, spans, strict=True)]
    fits = [
        abs(left) <= max(SLACK, SHARE * extent) for left, extent in zip(rest, size, strict=True)
    ]
    steps = [fit or 0 < left < spacing for fit, left in zip(fits, rest, strict=True)]
    if any(fits) and all(steps):
        return None
    (width, length), (along_x, along_y) = size, spans
    covered = f"its waypoints span {along_x:g} m by {along_y:g} m"
    return f"{covered}, and the area is {width:g} m by {length:g} m"
