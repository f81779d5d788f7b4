"""Structures are not driven into: the way to one ends at its stand-off, and legs go round it.

A structure is a place that command or operator name as a thing: what a search looks for, what a
task goes round, what a task prompt names beside a position, a point of a chart, what a limit keeps
the vehicle away from. A place of the water ("waypoint", bare coordinates), a berth and the middle
of an area or a line that is gone over are none.
"""

from __future__ import annotations

import heapq
import itertools
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from planner_ft.document.limits import limits_of
from planner_ft.document.ontology import is_thing, named_places
from planner_ft.document.track import Leg, Pen, Point, TaskEntry, place_of
from planner_ft.document.vehicle import STAND_OFF
from planner_ft.facts.geometry import offset
from planner_ft.facts.places import read_bearings
from planner_ft.planning.frame import frame_of
from planner_ft.planning.passes import Face, face_of
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import canonical_value

ROUND, OVER = ("orbit", "square"), ("lawnmower", "line")
"""Patterns of tasks that go round their place, and of those that go over it."""
FACING = ("sweep", "pass")
"""Patterns of tasks that look at the structure that the vehicle has gone to."""
FOLLOWING = "follow"
"""The pattern of a task that goes up to its place and no closer than its filters let it."""
SAME = 0.6
"""Metres within which a waypoint is a structure itself."""
MARGIN = 0.5
"""Metres that an added waypoint lies farther off than it must, and that a leg may come closer."""
CORNERS = 8
"""Waypoints of a full way round a structure."""
MOST_WALLS = 60
"""Circles by which a face is kept clear of."""
MOST_ROUNDS = 30
MOVING = ("go", "arc")


@dataclass(frozen=True)
class Structure:
    """A thing in the water, and the distance in metres that is kept from it."""

    name: str
    position: Point
    standoff: float

    @property
    def slack(self) -> float:
        """Metres that a leg may come closer: arcs are drawn as chords."""
        return max(MARGIN, 0.005 * self.standoff)

    def blocks(self, start: Point, goal: Point) -> bool:
        """Whether a straight leg comes too close."""
        return way_off(self.position, start, goal) < self.standoff - self.slack

    def corners(self) -> list[Point]:
        """Waypoints of a way round at the stand-off."""
        radius = (self.standoff + MARGIN) / math.cos(math.pi / CORNERS)
        angles = [2 * math.pi * number / CORNERS for number in range(CORNERS)]
        x, y = self.position
        return [(x + radius * math.sin(one), y + radius * math.cos(one)) for one in angles]


def structures(document: Mapping[str, Any], vocabulary: Vocabulary) -> list[Structure]:
    """The known structures of a plan, each with the stand-off that is stated or the vehicle's."""
    tasks = document["tasks"]
    own = (document.get("vehicle") or {}).get("stand_off", STAND_OFF)
    least, named, last = 0.0, dict[Point, str](), vocabulary.home
    kept: dict[Point, float] = {}
    for limit in limits_of(document, vocabulary):
        if limit["kind"] == "clearance":
            least = max(least, limit["values"]["distance"])
        elif limit["kind"] == "keep_out" and "position" in limit["values"]:
            at = _point(limit["values"]["position"])
            kept[at] = max(kept.get(at, 0.0), limit["values"]["distance"])
            named[at] = limit["values"].get("object", "")
    excluded = {vocabulary.home}
    stated: dict[Point, list[float]] = {}
    for task in tasks:
        known, place = vocabulary.task.get(task["title"]), place_of(task, vocabulary)
        if known is not None and known.pattern in FACING and last != vocabulary.home:
            named.setdefault(last, "")
        last = place or last
        if known is None or place is None:
            continue
        if known.docks or known.pattern in OVER:
            excluded.add(place)
        if known.pattern in ROUND:
            named.setdefault(place, "")
        for words, beside in named_places(task["task_prompt"], vocabulary):
            if math.dist((beside.x, beside.y), place) < SAME:
                named[place] = named.get(place) or words
        circle = vocabulary.motion.standoff(task["title"])
        radius = task["parameters"].get(circle.radius) if circle else None
        if radius:
            stated.setdefault(place, []).append(float(radius))
        elif known.pattern == FOLLOWING and (margin := _margin(task, vocabulary)) > own:
            stated.setdefault(place, []).append(margin)
    for words, beside in named_places(frame_of(document).spoken, vocabulary):
        named.setdefault((beside.x, beside.y), words)
    for charted in ("structures", "located"):
        for name, position in document.get(charted, {}).items():
            if is_thing(name, vocabulary):
                named[_point(position)] = named.get(_point(position)) or name
    found = []
    for place, name in named.items():
        if place in kept or place not in excluded:
            standoff = kept.get(place) or min(stated.get(place, [own]))
            found.append(Structure(name or shown(place), place, max(standoff, least)))
    return found


def _margin(task: TaskEntry, vocabulary: Vocabulary) -> float:
    """The largest distance that a filter of a task keeps from obstacles, 0 for none."""
    filters = [own for step in task.get("skill_sequence") or () for own in step["filter_skills"]]
    motions = [(vocabulary.motion.of(own["name"]), own["parameters"]) for own in filters]
    kept = [motion.value("distance", own) for motion, own in motions if motion is not None]
    return max((float(metres) for metres in kept if metres), default=0.0)


def close_legs(
    document: Mapping[str, Any], legs: Sequence[Leg], vocabulary: Vocabulary
) -> Iterator[tuple[str, Structure, float]]:
    """(task, structure, metres) of every leg that comes too close; docking may."""
    known = structures(document, vocabulary)
    steering = {task["id"] for task in document["tasks"] if task.get("skill_sequence")}
    docking = {task["id"] for task in document["tasks"] if _is_close(task, vocabulary)}
    before = [None, *legs]
    for last, leg in zip(before, legs, strict=False) if known else ():
        if leg.kind not in MOVING or leg.task in docking or leg.task not in steering:
            continue
        for structure in known:
            pairs = itertools.pairwise(leg.points)
            nearest = min(way_off(structure.position, *pair) for pair in pairs)
            ends = [point for point in (leg.points[0], leg.points[-1]) if point == vocabulary.home]
            if last and last.task in docking and structure.blocks(*(leg.points[0],) * 2):
                continue
            allowed = min([structure.standoff, *(math.dist(structure.position, at) for at in ends)])
            if nearest < allowed - structure.slack:
                yield leg.task, structure, nearest


# ---------------------------------------------------------------- steps


def cleared(document: Mapping[str, Any], vocabulary: Vocabulary) -> list[dict[str, Any]]:
    """The tasks of a plan with steps that keep clear of its structures, where there is a way."""
    tasks: list[dict[str, Any]] = list(document["tasks"])
    known = structures(document, vocabulary)
    if not known:
        return tasks
    pen = Pen(vocabulary, document.get("vehicle") or {})
    allowed = fence(document, vocabulary)
    done = []
    for before, task, following in zip([None, *tasks], tasks, [*tasks[1:], None], strict=False):
        steps = task.get("skill_sequence")
        if steps is None or task.get("stale") or _is_close(task, vocabulary):
            pen.draw(task)
            done.append(task)
            continue
        reached = _circle_of(following, vocabulary) if following else None
        faces = [face_of(one, vocabulary) if one else None for one in (before, following)]
        walls = [wall for face in faces if face for wall in _walls(face)]
        circle = reached or _circle_of(task, vocabulary)
        made = _Steps(task, [*known, *walls], circle, pen, faces[1])
        done.append(made.cleared(allowed))
    return done


def _walls(face: Face) -> list[Structure]:
    """A face that the plan runs along: the way to its pass and from it leads round its ends."""
    (a, b), (c, d) = face.ends
    count = math.ceil(math.dist(*face.ends) / max(face.distance, MARGIN))
    parts = [number / count for number in range(count + 1)] if 0 < count <= MOST_WALLS else []
    return [
        Structure("", (a + part * (c - a), b + part * (d - b)), face.distance) for part in parts
    ]


Allowed = Callable[[Point, Point], bool]


def fence(document: Mapping[str, Any], vocabulary: Vocabulary) -> Allowed:
    """Whether a leg stays inside the plan's fences and outside of its closed areas."""
    limits = limits_of(document, vocabulary)
    inside = [limit["values"]["polygon"] for limit in limits if limit["kind"] == "fence"]
    inside += [area] if (area := (document.get("vehicle") or {}).get("area")) else []
    outside = [limit["values"]["polygon"] for limit in limits if limit["kind"] == "keep_out_area"]
    if not inside and not outside:
        return lambda _start, _goal: True
    from shapely import LineString, Polygon

    areas = [Polygon(corners).buffer(MARGIN) for corners in inside]
    closed = [Polygon(corners).buffer(-MARGIN) for corners in outside]

    def stays(start: Point, goal: Point) -> bool:
        leg = LineString([start, goal])
        return all(area.covers(leg) for area in areas) and not any(
            area.intersects(leg) for area in closed
        )

    return stays


class _Steps:
    """The steps of one task, drawn one after the other."""

    def __init__(
        self,
        task: dict[str, Any],
        known: Sequence[Structure],
        circle: tuple[Point, float] | None,
        pen: Pen,
        face: Face | None,
    ) -> None:
        self.task, self.known, self.circle, self.pen, self.face = task, known, circle, pen, face
        self.steps: list[dict[str, Any]] = []
        self.marks: list[dict[str, Any]] = []

    def cleared(self, allowed: Allowed) -> dict[str, Any]:
        """The task with what was changed marked in `added`."""
        self.pen.begin(self.task)
        steps, before = self._entered(self.task["skill_sequence"], self.task.get("added", []))
        for number, step in enumerate(steps):
            own = [mark for mark in before if mark["step"] == number]
            moved = self._to_standoff(step)
            for point in self._round(moved, allowed):
                self._mark("keeps clear of a structure")
                self._add(self._with_goal(step, point), own)
            if moved is not step:
                self._mark("ends at the stand-off")
            self._add(moved, own)
        entry = {**self.task, "skill_sequence": self.steps}
        return {**entry, "added": self.marks} if self.marks else entry

    def _entered(
        self, steps: list[dict[str, Any]], marks: list[dict[str, Any]]
    ) -> tuple[list[dict[str, Any]], list[dict[str, Any]]]:
        """Steps round a structure from the one that can be gone to first, and their marks.

        Where the task prompt names a direction, its order stands.
        """
        goals, here, count = [self._goal(step) for step in steps], self.pen.here, len(steps)
        pattern = self.pen.vocabulary.task[self.task["title"]].pattern
        if pattern not in ROUND or here is None or None in goals or not goals:
            return steps, marks
        blocked = any(one.blocks(here, _point(goals[0])) for one in self.known)
        if not blocked or read_bearings(self.task["task_prompt"]):
            return steps, marks
        order = sorted(range(count), key=lambda index: math.dist(here, _point(goals[index])))
        for first in order:
            if not any(one.blocks(here, _point(goals[first])) for one in self.known):
                self._mark("begins on the near side")
                moved = [{**mark, "step": (mark["step"] - first) % count} for mark in marks]
                return [*steps[first:], *steps[:first]], moved
        return steps, marks

    def _to_standoff(self, step: dict[str, Any]) -> dict[str, Any]:
        """The step; one that goes to a structure itself ends on its stand-off, on the way in or
        before the face that is run along next.
        """
        goal, here = self._goal(step), self.pen.here
        for structure in self.known if goal else ():
            center = structure.position
            if goal is None or math.dist(goal, center) > SAME:
                continue
            radius = structure.standoff
            if self.circle and math.dist(self.circle[0], center) <= SAME:
                radius = self.circle[1]
            if self.face and math.dist(self.face.middle, center) <= SAME:
                return self._with_goal(step, offset(center, self.face.side, radius))
            away = math.dist(here, center) if here else 0.0
            x, y = (
                ((here[0] - center[0]) / away, (here[1] - center[1]) / away)
                if here and away
                else (-1.0, 0.0)
            )
            return self._with_goal(step, (center[0] + radius * x, center[1] + radius * y))
        return step

    def _round(self, step: dict[str, Any], allowed: Allowed) -> list[Point]:
        """Waypoints before a step whose leg comes too close to a structure."""
        goal, here = self._goal(step), self.pen.here
        return way_round(here, goal, self.known, allowed) if here and goal else []

    def _mark(self, note: str) -> None:
        at, name = len(self.steps), ""
        self.marks.append(
            {"step": at, "role": "navigation", "name": name, "kind": "clearance", "note": note}
        )

    def _add(self, step: dict[str, Any], marks: Sequence[dict[str, Any]]) -> None:
        skill = step["navigation_skill"]
        self.marks += [{**mark, "step": len(self.steps)} for mark in marks]
        for mark in self.marks:
            mark["name"] = mark["name"] or skill["name"]
        self.pen.step(len(self.steps), skill)
        self.steps.append(step)

    def _goal(self, step: Mapping[str, Any]) -> Point | None:
        """Where a step goes; None for one that goes nowhere."""
        skill = step["navigation_skill"]
        motion = self.pen.vocabulary.motion.of(skill["name"])
        if motion is None or motion.kind != "go":
            return None
        return _point([motion.value(axis, skill["parameters"]) for axis in ("x", "y")])

    def _with_goal(self, step: dict[str, Any], goal: Point) -> dict[str, Any]:
        skill = step["navigation_skill"]
        motion = self.pen.vocabulary.motion.of(skill["name"])
        assert motion is not None
        names = motion.parameters["x"], motion.parameters["y"]
        at = dict(zip(names, (canonical_value(round(part, 1)) for part in goal), strict=True))
        return {**step, "navigation_skill": {**skill, "parameters": {**skill["parameters"], **at}}}


def way_round(
    start: Point, goal: Point, known: Sequence[Structure], allowed: Allowed
) -> list[Point]:
    """Waypoints of the shortest way that no structure blocks; none where there is no other way.

    A structure whose stand-off start or goal lie within is left to the warnings.
    """
    zones = [one for one in known if not one.blocks(start, start) and not one.blocks(goal, goal)]
    used = [one for one in zones if one.blocks(start, goal)]
    for _round in range(MOST_ROUNDS if used else 0):
        path = _shortest(start, goal, used, allowed)
        met = [
            one
            for one in zones
            if one not in used and any(one.blocks(*pair) for pair in itertools.pairwise(path))
        ]
        if not met:
            return path[1:-1]
        used += met
    return []


def _shortest(
    start: Point, goal: Point, zones: Sequence[Structure], allowed: Allowed
) -> list[Point]:
    """The shortest way over the corners of zones; empty where there is none."""
    points = [goal, *(corner for zone in zones for corner in zone.corners())]
    queue: list[tuple[float, list[Point]]] = [(0.0, [start])]
    reached = set[Point]()
    while queue:
        length, path = heapq.heappop(queue)
        here = path[-1]
        if here == goal:
            return path
        if here in reached:
            continue
        reached.add(here)
        for point in points:
            free = point not in reached and not any(zone.blocks(here, point) for zone in zones)
            if free and allowed(here, point):
                heapq.heappush(queue, (length + math.dist(here, point), [*path, point]))
    return []


# ---------------------------------------------------------------- geometry


def way_off(point: Point, start: Point, goal: Point) -> float:
    """The distance of a point from a straight leg."""
    (x, y), (a, b) = start, (goal[0] - start[0], goal[1] - start[1])
    square = a * a + b * b
    along = ((point[0] - x) * a + (point[1] - y) * b) / square if square else 0.0
    along = min(1.0, max(0.0, along))
    return math.dist(point, (x + along * a, y + along * b))


def shown(point: Point) -> str:
    """A position in words: [250, -80]."""
    return f"[{point[0]:.6g}, {point[1]:.6g}]"


def _circle_of(task: TaskEntry, vocabulary: Vocabulary) -> tuple[Point, float] | None:
    """The circle that a task keeps: its centre and its radius."""
    circle, center = vocabulary.motion.standoff(task["title"]), place_of(task, vocabulary)
    radius = task["parameters"].get(circle.radius) if circle else None
    return (center, float(radius)) if center and radius else None


def _is_close(task: TaskEntry, vocabulary: Vocabulary) -> bool:
    """Whether a task comes close on purpose: it docks, or passes along a face."""
    known = vocabulary.task.get(task["title"])
    return known is not None and (known.docks or known.pattern == "pass")


def _point(value: Any) -> Point:
    return float(value[0]), float(value[1])
