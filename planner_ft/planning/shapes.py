"""Waypoints that follow from the task's values, where the Task Agent's do not make its shape: the
points of a grid, a square or a line.
"""

import copy
import itertools
import math
import re
from collections.abc import Iterable, Sequence

from planner_ft.facts import geometry as g
from planner_ft.facts import near
from planner_ft.facts.numbers import read_numbers
from planner_ft.facts.places import read_bearings, read_positions
from planner_ft.planning.essentials import VEHICLE, Added, Completed, Step, TaskEntry
from planner_ft.planning.limits import without_limits
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import canonical_value, is_number

Point = g.Point
SIZE, SPACING, RADIUS = ("width", "length"), "spacing", "radius"
"""The parameters of a grid: extent along x and y, and between lanes; that of a square."""
COURSE = ("heading", "max_dist")
"""Those of a line: its course and its length."""
SIDE, PASS = "side_id", ("length", "distance")
"""Those of a pass: the side of the structure, the length, and the distance from the face."""
IN_NAME = re.compile(r" at \[")
AGAIN = re.compile(r"\b(?:again|twice|times|back|both|repeat\w*)\b", re.IGNORECASE)
"""Words of a task prompt with which a grid goes over its lanes once more."""
SLACK, SHARE = 0.5, 0.02
"""Metres, and the share of a length, by which waypoints may differ from it."""
MOST_WAYPOINTS = 128


def with_shape(task: TaskEntry, steps: Sequence[Step], vocabulary: Vocabulary) -> Completed:
    """The steps with the waypoints of the task's shape, and what was set; as they are where they
    make it once, do something beside, or where the prompt says more of it than the parameters.
    """
    points, made = shape_points(task, vocabulary), [goal_of(step, vocabulary) for step in steps]
    goals = [goal for goal in made if goal]
    if not points or not goals or len(goals) < len(made) or not _is_plain(task, vocabulary):
        return list(steps), Added()
    grid = vocabulary.task[task["title"]].pattern == "lawnmower"
    again = AGAIN.search(without_limits(task["task_prompt"], vocabulary))
    twice = grid and len({*goals}) < len(goals) and not again
    if not twice and not shape_problem(task, goals, vocabulary):
        return list(steps), Added()
    whole = [steps[min(at, len(steps) - 1)] for at in range(len(points))]
    return placed(whole, enumerate(points), vocabulary)


def goal_of(step: Step, vocabulary: Vocabulary) -> Point | None:
    """Where a step goes; None for one that goes nowhere."""
    skill = step["navigation_skill"]
    names = _axes(skill["name"], vocabulary)
    return (skill["parameters"][names[0]], skill["parameters"][names[1]]) if names else None


def with_goal(step: Step, point: Sequence[float], vocabulary: Vocabulary) -> Step:
    """The step with another goal."""
    skill = step["navigation_skill"]
    at = dict(zip(_axes(skill["name"], vocabulary), canonical_value(list(point)), strict=True))
    return {**step, "navigation_skill": {**skill, "parameters": {**skill["parameters"], **at}}}


def placed(
    steps: Sequence[Step], points: Iterable[tuple[int, Point]], vocabulary: Vocabulary
) -> Completed:
    """The steps with other waypoints, by index, and a mark for each coordinate."""
    done, marks = [copy.deepcopy(step) for step in steps], Added()
    for at, point in points:
        done[at] = with_goal(done[at], point, vocabulary)
        name = done[at]["navigation_skill"]["name"]
        mark = {"step": at, "role": "navigation", "name": name, "kind": VEHICLE}
        marks += [{**mark, "parameter": axis} for axis in _axes(name, vocabulary)]
    return done, marks


def _axes(skill: str, vocabulary: Vocabulary) -> list[str]:
    """The parameters for x and y of a skill that goes somewhere, as its motion or its definition
    has them; none of another.
    """
    motion = vocabulary.motion.of(skill)
    if motion is not None and motion.kind == "go":
        return [motion.parameters["x"], motion.parameters["y"]]
    return [item.name for item in vocabulary.skill[skill].coordinates]


# ---------------------------------------------------------------- grids, squares and lines


def run_of(points: Sequence[Point]) -> float:
    """The largest distance between two of some waypoints."""
    return max((math.dist(*pair) for pair in itertools.combinations(points, 2)), default=0.0)


def shape_points(task: TaskEntry, vocabulary: Vocabulary) -> list[Point]:
    """The waypoints of a task's shape; none where its values are not all known or fit badly."""
    known, given = vocabulary.task[task["title"]], task["parameters"]
    place = given.get(known.position_parameter or "")
    if not place or tuple(place) == vocabulary.unresolved:
        return []
    at, points = (place[0], place[1]), list[Point]()
    if known.pattern == "line" and all(is_number(given.get(name)) for name in COURSE):
        points = g.straight_line(at, given[COURSE[0]], given[COURSE[1]])
    elif known.pattern == "square" and is_number(given.get(RADIUS)) and given[RADIUS] > 0:
        points = g.survey_square(at, given[RADIUS])
    elif known.pattern == "lawnmower" and all(is_number(given.get(n)) for n in (*SIZE, SPACING)):
        width, length, spacing = given[SIZE[0]], given[SIZE[1]], given[SPACING]
        lanes = width / spacing if min(width, length, spacing) > 0 else 0.0
        if 0 < lanes <= MOST_WAYPOINTS:
            points = g.lawnmower(at, width, length, spacing, uneven=True)
    return points if len(points) <= MOST_WAYPOINTS else []


def shape_problem(task: TaskEntry, points: Sequence[Point], vocabulary: Vocabulary) -> str | None:
    """Why waypoints do not make the pass, grid, line or square of a task, for an operator."""
    known, given = vocabulary.task[task["title"]], task["parameters"]
    if known.pattern == "pass" and is_number(length := given.get(PASS[0])) and points:
        if run_of(points) < length * (1 - SHARE) - SLACK:
            return f"its waypoints are {run_of(points):.3g} m apart, and its length is {length:g} m"
        side = str(given.get(SIDE, ""))
        guess = f'"{side}" is no compass direction, so on which side its waypoints lie is a guess'
        return None if read_bearings(side) else guess
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


def _is_plain(task: TaskEntry, vocabulary: Vocabulary) -> bool:
    """Whether a prompt has no direction and no number beside places, names ("pen 4 at [0, 40]") and
    the task's parameters, and the run of a line in full.
    """
    prompt, given = without_limits(task["task_prompt"], vocabulary), task["parameters"]
    own = [value for value in given.values() if is_number(value)]
    placed = [range(one.start, one.end) for one in read_positions(prompt) if one.certain]
    outside = (one for one in read_numbers(prompt) if not any(one.start in at for at in placed))
    said = [number.value for number in outside if not IN_NAME.match(prompt, number.end)]
    course, run = (given.get(name) for name in COURSE)
    named = [number.value for number in read_bearings(prompt)]
    return (
        all(any(near(number, value) for value in own) for number in said)
        and all(is_number(course) and near(bearing, course) for bearing in named)
        and (not is_number(run) or any(near(run, number) for number in said))
    )


def _line_problem(start: Point, heading: float, run: float, points: Sequence[Point]) -> str | None:
    """The line ends at the length of its course from its start."""
    end = g.straight_line(start, heading, run)[-1]
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
    slack = (max(SLACK, SHARE * extent) for extent in size)
    fits = [abs(left) <= most for left, most in zip(rest, slack, strict=True)]
    steps = [fit or 0 < left < spacing for fit, left in zip(fits, rest, strict=True)]
    if any(fits) and all(steps):
        return None
    (width, length), (along_x, along_y) = size, spans
    covered = f"its waypoints span {along_x:g} m by {along_y:g} m"
    return f"{covered}, and the area is {width:g} m by {length:g} m"


def _lane_problem(spacing: float, points: Sequence[Point]) -> str | None:
    """Neighbouring lanes are no more than a spacing apart."""
    axes = (itertools.pairwise(sorted(axis)) for axis in zip(*points, strict=True))
    apart = min(max((two - one for one, two in pairs), default=0.0) for pairs in axes)
    if not spacing or apart <= spacing * (1 + SHARE) + SLACK:
        return None
    return f"its lanes are {apart:g} m apart, and not {spacing:g} m"
