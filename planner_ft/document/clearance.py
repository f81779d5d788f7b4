"""Steps that keep clear: the way to a structure ends at its stand-off, and legs go round it."""

import heapq
import itertools
import math
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from planner_ft.document.structures import (
    MARGIN,
    MOST_PARTS,
    ROUND,
    SAME,
    Allowed,
    Structure,
    along,
    berth,
    fence,
    lies_at,
    posts,
    runs_along,
    structures,
)
from planner_ft.document.track import Pen, Point, circle_of, place_of, point_of
from planner_ft.facts.geometry import offset
from planner_ft.facts.places import read_bearings
from planner_ft.planning.passes import Face, face_of
from planner_ft.planning.shapes import goal_of, with_goal
from planner_ft.vocabulary import Entry, Vocabulary

MOST_ROUNDS = 30
ARC_STARTS = 24  # directions from the centre in which a part of a circle may begin
FINE = 3.0  # metres of stand-off under which waypoints are written to the centimetre
KEEPS_CLEAR = "keeps clear of a structure"
Step = dict[str, Any]
Marks = list[dict[str, Any]]


def cleared(document: Entry, vocabulary: Vocabulary) -> list[dict[str, Any]]:
    """The tasks of a plan with steps that keep clear of its structures, where there is a way."""
    tasks: list[dict[str, Any]] = list(document["tasks"])
    known, beside = structures(document, vocabulary), posts(document, vocabulary)
    if not (known or beside) or not vocabulary.motion.skills:
        return tasks
    pen = Pen(vocabulary, document.get("vehicle") or {})
    allowed, done = fence(document, vocabulary), []
    berths = {place for task in tasks if (place := berth(task, vocabulary))}
    ahead = itertools.zip_longest(tasks, tasks[1:], tasks[2:])
    for before, (task, following, last) in zip([None, *tasks], ahead, strict=False):
        steps = task.get("skill_sequence")
        if steps is None or task.get("stale"):
            pen.draw(task)
            done.append(task)
            continue
        reached = circle_of(following, vocabulary) if following else None
        faces = [face_of(one, vocabulary) if one else None for one in (before, following)]
        along = runs_along(task, vocabulary)
        near = [*faces, face_of(task, vocabulary)] if along else faces
        walls = [wall for face in near if face for wall in _walls(face)]
        circle = reached or circle_of(task, vocabulary)
        clearing = _Steps(task, [*known, *walls], circle, pen, faces[1], berths, beside, allowed)
        clearing.arc = _arc(following, last, vocabulary) if reached else None
        onward = _onward(following, vocabulary)
        done.append(clearing.begun() if along else clearing.cleared(onward))
    return done


def _onward(task: dict[str, Any] | None, vocabulary: Vocabulary) -> list[Point]:
    """Where the steps of the next task can be begun; empty for a mere way to somewhere."""
    steps = task and task["title"] != vocabulary.transit and task.get("skill_sequence")
    if not task or not steps:
        return []
    around = vocabulary.task[task["title"]].pattern in ROUND
    goals = [goal_of(step, vocabulary) for step in (steps if around else steps[:1])]
    return [point_of(goal) for goal in goals if goal]


def _arc(
    task: dict[str, Any] | None, following: dict[str, Any] | None, vocabulary: Vocabulary
) -> tuple[float, Point] | None:
    """The angle in degrees of a task that goes a part of a circle from wherever it begins, and
    where the next one goes.
    """
    steps = following and following.get("skill_sequence")
    goal = goal_of(steps[0], vocabulary) if steps else None
    for step in (task or {}).get("skill_sequence") or () if goal else ():
        skill = step["navigation_skill"]
        motion = vocabulary.motion.of(skill["name"])
        angle = motion.value("angle", skill["parameters"]) if motion else None
        if motion and motion.kind == "arc" and angle and angle % 360:
            named = task and read_bearings(task["task_prompt"])
            return (angle, point_of(goal)) if goal and not named else None
    return None


def _walls(face: Face) -> list[Structure]:
    """A face that the plan runs along: the way to its pass and from it leads round its ends."""
    length = math.dist(*face.ends)
    short = 0 < length <= MOST_PARTS * max(face.distance, MARGIN)
    points = along(*face.ends, face.distance) if short else []
    return [Structure("", point, face.distance) for point in points]


class _Steps:
    """The steps of one task, drawn one after the other; what was changed is marked in `added`."""

    def __init__(
        self,
        task: dict[str, Any],
        known: Sequence[Structure],
        circle: tuple[Point, float] | None,
        pen: Pen,
        face: Face | None,
        berths: set[Point],
        beside: Sequence[Point],
        allowed: Allowed,
    ) -> None:
        self.task, self.known, self.circle, self.pen, self.face = task, known, circle, pen, face
        self.berths, self.beside, self.allowed = berths, beside, allowed
        self.arc: tuple[float, Point] | None = None
        self.steps: list[Step] = []
        self.marks: Marks = []

    def cleared(self, onward: Sequence[Point]) -> dict[str, Any]:
        self.pen.begin(self.task)
        own = self.task.get("added", [])
        steps, marks = self._entered(self.task["skill_sequence"], own, onward)
        for number, step in enumerate(steps):
            own = [mark for mark in marks if mark["step"] == number]
            moved = self._to_standoff(step)
            goal, here = self._goal(moved), self.pen.here
            if here and goal:
                # What a berth lies at does not bar the way to it.
                docked = self.berths & {here, goal}
                known = [one for one in self.known if not lies_at(one, docked)]
                for point in way_round(here, goal, known, self.allowed, self.beside):
                    self._add(self._with_goal(step, point), own, KEEPS_CLEAR)
            self._add(moved, own, "ends at the stand-off" if moved is not step else "")
        entry = {**self.task, "skill_sequence": self.steps}
        return {**entry, "added": self.marks} if self.marks else entry

    def begun(self) -> dict[str, Any]:
        """A task along a face: the way to its first waypoint keeps clear, the rest is the task."""
        self.pen.begin(self.task)
        gone = False
        for number, step in enumerate(self.task["skill_sequence"]):
            own = [mark for mark in self.task.get("added", []) if mark["step"] == number]
            goal, here = self._goal(step), self.pen.here
            if here and goal and not gone:
                for point in way_round(here, goal, self.known, self.allowed, self.beside):
                    self._add(self._with_goal(step, point), own, KEEPS_CLEAR)
            gone = gone or goal is not None
            self._add(step, own, "")
        entry = {**self.task, "skill_sequence": self.steps}
        return {**entry, "added": self.marks} if self.marks else entry

    def _entered(
        self, steps: list[Step], marks: Marks, onward: Sequence[Point]
    ) -> tuple[list[Step], Marks]:
        """Steps round a structure from one that can be gone to straight, if possible so that they
        end where the next task (`onward`) can be, and their marks.

        Where the task prompt names a direction, its order stands.
        """
        goals, here, count = [self._goal(step) for step in steps], self.pen.here, len(steps)
        points = [goal for goal in goals if goal]
        pattern = self.pen.vocabulary.task[self.task["title"]].pattern
        if pattern not in ROUND or here is None or len(points) < max(count, 1):
            return steps, marks
        free = [self._is_free(here, goal) for goal in points]
        if not any(free):  # behind others, the near side is the one that faces the vehicle
            center = place_of(self.task, self.pen.vocabulary)
            own = [one for one in self.known if center and math.dist(one.position, center) <= SAME]
            free = [not any(one.blocks(here, goal) for one in own) for goal in points]
        # Behind the steps from `index` on, the vehicle is at the one before.
        ends = [any(self._is_free(points[at - 1], goal) for goal in onward) for at in range(count)]
        if not any(end for at, end in enumerate(ends) if free[at]):
            ends = [True] * count
        prompt = self.task["task_prompt"]
        for one in self.known:  # "the north lighthouse" is a name
            prompt = prompt.replace(one.name, "") if one.name else prompt
        reached = [index for index in range(count) if free[index] and ends[index]]
        if not reached or reached[0] == 0 or read_bearings(prompt):
            return steps, marks
        first = min(reached, key=lambda index: math.dist(here, points[index]))
        self._mark(steps[first], "begins on the near side")
        moved = [{**mark, "step": (mark["step"] - first) % count} for mark in marks]
        return [*steps[first:], *steps[:first]], moved

    def _is_free(self, start: Point, goal: Point) -> bool:
        return not any(one.blocks(start, goal) for one in self.known)

    def _to_standoff(self, step: Step) -> Step:
        """The step; one that goes to a structure itself ends on its stand-off, on the way in or
        before the face that is run along next.
        """
        goal, here = self._goal(step), self.pen.here
        reached = [one for one in self.known if goal and math.dist(goal, one.position) <= SAME]
        if not reached:
            return step
        center, radius = reached[0].position, reached[0].standoff
        if self.circle and math.dist(self.circle[0], center) <= SAME:
            radius = self.circle[1]
        if goal and math.dist(goal, center) >= radius:
            return step  # small things have a small stand-off
        if self.face and math.dist(self.face.middle, center) <= SAME:
            away = max(radius, self.face.distance)
            return self._with_goal(step, offset(center, self.face.side, away))
        if self.arc and here and (start := self._arc_start(here, center, radius)):
            return self._with_goal(step, start)
        away, (x, y) = math.dist(here, center) if here else 0.0, (-1.0, 0.0)
        if here and away:
            x, y = (here[0] - center[0]) / away, (here[1] - center[1]) / away
        return self._with_goal(step, (center[0] + radius * x, center[1] + radius * y))

    def _arc_start(self, here: Point, center: Point, radius: float) -> Point | None:
        """Where a part of a circle is begun so that the ways to it and on from its end are short;
        None where one of them is barred.
        """
        angle, goal = self.arc or (0.0, here)
        starts = [360.0 * number / ARC_STARTS for number in range(ARC_STARTS)]
        ends = [(offset(center, at, radius), offset(center, at + angle, radius)) for at in starts]
        ways = ((self._length(here, one) + self._length(end, goal), one) for one, end in ends)
        length, start = min(ways)
        return start if math.isfinite(length) else None

    def _length(self, start: Point, goal: Point) -> float:
        """Metres of the way that keeps clear; infinite where there is none."""
        points = way_round(start, goal, self.known, self.allowed, self.beside)
        if not points and not self._is_free(start, goal):
            return math.inf
        return sum(map(math.dist, [start, *points], [*points, goal]))

    def _add(self, step: Step, marks: Marks, note: str) -> None:
        if note:
            self._mark(step, note)
        self.marks += [{**mark, "step": len(self.steps)} for mark in marks]
        self.pen.step(len(self.steps), step["navigation_skill"])
        self.steps.append(step)

    def _mark(self, step: Step, note: str) -> None:
        mark = {"step": len(self.steps), "role": "navigation"}
        name = step["navigation_skill"]["name"]
        self.marks.append({**mark, "name": name, "kind": "clearance", "note": note})

    def _goal(self, step: Step) -> Point | None:
        """Where a step goes; None for one that goes nowhere."""
        goal = goal_of(step, self.pen.vocabulary)
        return goal and point_of(goal)

    def _with_goal(self, step: Step, goal: Sequence[float]) -> Step:
        fine = any(one.standoff < FINE for one in self.known)
        return with_goal(
            step, [round(part, 2 if fine else 1) for part in goal], self.pen.vocabulary
        )


def way_round(
    start: Point,
    goal: Point,
    known: Sequence[Structure],
    allowed: Allowed,
    beside: Sequence[Point] = (),
) -> list[Point]:
    """Waypoints of the shortest way that no structure blocks and all legs of which are `allowed`,
    also over points `beside` closed areas; none where there is no other way.

    Where start or goal lie within a stand-off, the way comes no nearer to that structure than they
    do; the warnings say that they are too close.
    """
    zones = [_as_far_as(one, start, goal) for one in known]
    used = [one for one in zones if one.blocks(start, goal)]
    barred = used or (beside and not allowed(start, goal))
    for _round in range(MOST_ROUNDS if barred else 0):
        path = _shortest(start, goal, used, allowed, beside)
        legs = list(itertools.pairwise(path))
        rest = [one for one in zones if one not in used]
        met = [one for one in rest if any(one.blocks(*leg) for leg in legs)]
        if not met:
            return path[1:-1]
        used += met
    return []


def _as_far_as(structure: Structure, *ends: Point) -> Structure:
    """The structure with a stand-off that both ends of a way keep."""
    kept = min(math.dist(structure.position, end) for end in ends) + MARGIN
    return structure if kept >= structure.standoff else replace(structure, standoff=kept)


def _shortest(
    start: Point, goal: Point, zones: Sequence[Structure], allowed: Allowed, beside: Sequence[Point]
) -> list[Point]:
    """The shortest way over the corners of zones and points; empty where there is none."""
    points = [goal, *beside, *(corner for zone in zones for corner in zone.corners())]
    free = _free(points, zones)
    queue = [(math.dist(start, goal), 0.0, [start])]
    reached = set[Point]()
    while queue:
        _least, length, path = heapq.heappop(queue)
        here = path[-1]
        if here == goal:
            return path
        if here in reached:
            continue
        reached.add(here)
        for point in itertools.compress(points, free(here)):
            if point not in reached and allowed(here, point):
                way = length + math.dist(here, point)
                heapq.heappush(queue, (way + math.dist(point, goal), way, [*path, point]))
    return []


def _free(points: Sequence[Point], zones: Sequence[Structure]) -> Callable[[Point], Sequence[bool]]:
    """From a place, whether no zone blocks the straight leg to each of the points: what
    `Structure.blocks` says, of all of them at once.
    """
    ends, centres = np.array(points), np.array([zone.position for zone in zones]).reshape(-1, 1, 2)
    kept = np.array([zone.standoff - zone.slack for zone in zones])[:, None]

    def free(here: Point) -> Sequence[bool]:
        legs, off = ends - here, centres - here
        squares = (legs**2).sum(-1)
        along = (off * legs).sum(-1) / np.where(squares, squares, 1.0)
        gaps = off - along.clip(0.0, 1.0)[..., None] * legs
        clear: Sequence[bool] = (np.hypot(gaps[..., 0], gaps[..., 1]) >= kept).all(0).tolist()
        return clear

    return free
