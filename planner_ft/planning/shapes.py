"""Waypoints of a grid, a square or a line that follow from the task's values, where the Task
Agent's do not make it.
"""

from __future__ import annotations

import copy
import itertools
import math
from collections.abc import Mapping, Sequence
from typing import Any

from planner_ft.facts import near
from planner_ft.facts.geometry import Point, lane_count, lawnmower, straight_line, survey_square
from planner_ft.facts.numbers import read_numbers
from planner_ft.facts.places import read_bearings, read_positions
from planner_ft.planning.essentials import VEHICLE, Added, Step
from planner_ft.planning.limits import without_limits
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import canonical_value, is_number

SIZE, SPACING, RADIUS = ("width", "length"), "spacing", "radius"
"""The parameters of a grid: extent along x and y, and between lanes; that of a square."""
COURSE = ("heading", "max_dist")
"""Those of a line: its course and its length."""
SLACK, SHARE = 0.5, 0.02
"""Metres, and the share of a length, by which waypoints may differ from it."""
MOST_WAYPOINTS = 128


def with_shape(
    task: Mapping[str, Any], steps: Sequence[Step], vocabulary: Vocabulary
) -> tuple[list[Step], Added]:
    """The steps with the waypoints of the task's shape, and what was set; as they are where
    they make it, do something beside, or where the prompt says more of it than the parameters.
    """
    names = [
        [item.name for item in vocabulary.skill[step["navigation_skill"]["name"]].coordinates[:2]]
        for step in steps
    ]
    points = shape_points(task, vocabulary) if all(names) else []
    if not points or not _is_plain(task, vocabulary):
        return list(steps), Added()
    given = [step["navigation_skill"]["parameters"] for step in steps]
    made = [(own[x], own[y]) for own, (x, y) in zip(given, names, strict=True)]
    if not made or not shape_problem(task, made, vocabulary):
        return list(steps), Added()
    done, marks = list[Step](), Added()
    for at, point in enumerate(points):
        last = min(at, len(steps) - 1)
        done.append(copy.deepcopy(steps[last]))
        skill = done[at]["navigation_skill"]
        for name, value in zip(names[last], canonical_value(list(point)), strict=True):
            mark = {"step": at, "role": "navigation", "name": skill["name"], "kind": VEHICLE}
            marks.append({**mark, "parameter": name})
            skill["parameters"][name] = value
    return done, marks


def shape_points(task: Mapping[str, Any], vocabulary: Vocabulary) -> list[Point]:
    """The waypoints of a task's shape; none where its values are not all known or fit badly."""
    known, given = vocabulary.task[task["title"]], task["parameters"]
    place = given.get(known.position_parameter or "")
    if not place or tuple(place) == vocabulary.unresolved:
        return []
    at, points = (place[0], place[1]), list[Point]()
    if known.pattern == "line" and all(is_number(given.get(name)) for name in COURSE):
        points = straight_line(at, given[COURSE[0]], given[COURSE[1]])
    elif known.pattern == "square" and is_number(given.get(RADIUS)) and given[RADIUS] > 0:
        points = survey_square(at, given[RADIUS])
    elif known.pattern == "lawnmower" and all(is_number(given.get(n)) for n in (*SIZE, SPACING)):
        width, length, spacing = given[SIZE[0]], given[SIZE[1]], given[SPACING]
        if min(width, length, spacing) > 0 and lane_count(width, spacing):
            points = lawnmower(at, width, length, spacing)
    return points if len(points) <= MOST_WAYPOINTS else []


def shape_problem(
    task: Mapping[str, Any], points: Sequence[Point], vocabulary: Vocabulary
) -> str | None:
    """Why waypoints do not make the grid, the line or the square of a task, for an operator."""
    known, given = vocabulary.task[task["title"]], task["parameters"]
    if known.pattern == "lawnmower" and all(is_number(given.get(name)) for name in SIZE):
        size, spacing = [given[name] for name in SIZE], given.get(SPACING, 0)
        problem = _grid_problem(size, spacing, points)
        return problem or (_lane_problem(spacing, points) if _is_plain(task, vocabulary) else None)
    place = given.get(known.position_parameter or "")
    if known.pattern == "line" and place and all(is_number(given.get(name)) for name in COURSE):
        return _line_problem((place[0], place[1]), given[COURSE[0]], given[COURSE[1]], points)
    if known.pattern == "square" and place and is_number(given.get(RADIUS)):
        return _square_problem((place[0], place[1]), given[RADIUS], points)
    return None


def _is_plain(task: Mapping[str, Any], vocabulary: Vocabulary) -> bool:
    """Whether a prompt has no direction and no number beside places and the task's parameters, and
    the run of a line in full.
    """
    prompt, given = without_limits(task["task_prompt"], vocabulary), task["parameters"]
    own = [value for value in given.values() if is_number(value)]
    places = [(one.start, one.end) for one in read_positions(prompt) if one.certain]
    said = [
        number.value
        for number in read_numbers(prompt)
        if not any(start <= number.start < end for start, end in places)
    ]
    course, run = (given.get(name) for name in COURSE)
    named = [number.value for number in read_bearings(prompt)]
    return (
        all(any(near(number, value) for value in own) for number in said)
        and all(is_number(course) and near(bearing, course) for bearing in named)
        and (not is_number(run) or any(near(run, number) for number in said))
    )


def _line_problem(start: Point, heading: float, run: float, points: Sequence[Point]) -> str | None:
    """The line ends at the length of its course from its start."""
    end = straight_line(start, heading, run)[-1]
    if not points or min(math.dist(end, one) for one in points) <= max(SLACK, SHARE * run):
        return None
    return f"no waypoint is at [{end[0]:g}, {end[1]:g}], {run:g} m on {heading:g} from its start"


def _square_problem(center: Point, radius: float, points: Sequence[Point]) -> str | None:
    """Every waypoint lies on the square or the circle round the target."""
    for point in points:
        along_x, along_y = (abs(one - at) for one, at in zip(point, center, strict=True))
        away = max(along_x, along_y), math.hypot(along_x, along_y)
        if all(abs(one - radius) > max(SLACK, SHARE * radius) for one in away):
            return f"its waypoint [{point[0]:g}, {point[1]:g}] is not {radius:g} m off its target"
    return None


def _grid_problem(size: list[float], spacing: float, points: Sequence[Point]) -> str | None:
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


def _lane_problem(spacing: float, points: Sequence[Point]) -> str | None:
    """Neighbouring lanes are no more than a spacing apart."""
    apart = min(
        max((two - one for one, two in itertools.pairwise(sorted(axis))), default=0.0)
        for axis in zip(*points, strict=True)
    )
    if not spacing or apart <= spacing * (1 + SHARE) + SLACK:
        return None
    return f"its lanes are {apart:g} m apart, and not {spacing:g} m"
