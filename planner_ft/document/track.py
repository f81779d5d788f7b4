"""The track of a plan: where its skills take the vehicle, leg by leg, in local metres (x east, y
north).

It is read from the skill sequences by what the vocabulary's motion file says that skills do. A task
without skills moves as its parameters say where they say it (a transit to a place); every other one
is open. The vehicle starts at home with its bow to the north, and goes straight. Wind, current and
obstacles are not known here.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import asdict, dataclass
from typing import Any, Literal

from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.motion import Motion

Point = tuple[float, float]
LegKind = Literal["go", "arc", "hold", "drift", "turn"]
ARC_STEP = 10.0
"""Degrees between the points of an arc."""
MOST_TURNS = 10
"""Turns of one arc that are drawn; more lie on them."""


@dataclass(frozen=True)
class Leg:
    """One movement or hold of a step (from 0) of a task. `seconds` is None for a hold until a stop
    condition, and where no speed is known.
    """

    task: str
    step: int
    skill: str
    kind: LegKind
    points: tuple[Point, ...]
    metres: float
    seconds: float | None


@dataclass(frozen=True)
class Circle:
    """The stand-off that a task keeps; `arc` in degrees, None where it does not say one."""

    task: str
    center: Point
    radius: float
    arc: float | None


@dataclass(frozen=True)
class Boundary:
    """The polygon that a step may not leave."""

    task: str
    step: int
    polygon: tuple[Point, ...]


@dataclass(frozen=True)
class Target:
    """A named place, None while it is not known, and the first task that needs it."""

    name: str
    position: Point | None
    task: str


@dataclass(frozen=True)
class Track:
    """Legs in the order of the plan. `open` are the tasks whose movement is not known, wholly or in
    part.
    """

    legs: tuple[Leg, ...]
    circles: tuple[Circle, ...]
    boundaries: tuple[Boundary, ...]
    targets: tuple[Target, ...]
    open: tuple[str, ...]

    def as_json(self) -> dict[str, Any]:
        """Everything as a JSON object."""
        return asdict(self)


def track(document: Mapping[str, Any], vocabulary: Vocabulary) -> Track:
    """The track of a plan document."""
    pen = _Pen(vocabulary, document.get("vehicle") or {})
    for task in document["tasks"]:
        pen.draw(task)
    return Track(
        tuple(pen.legs),
        tuple(_circles(document["tasks"], vocabulary)),
        tuple(_boundaries(document["tasks"], vocabulary)),
        tuple(_targets(document, vocabulary)),
        tuple(pen.open),
    )


def place_of(task: Mapping[str, Any], vocabulary: Vocabulary) -> Point | None:
    """Where a task takes place; None where it has no place, or one that is not known."""
    known = vocabulary.task.get(str(task["title"]))
    value = (
        task["parameters"].get(known.position_parameter)
        if known and known.position_parameter
        else None
    )
    return None if value is None or tuple(value) == vocabulary.unresolved else _point(value)


def is_open(task: Mapping[str, Any], vocabulary: Vocabulary) -> bool:
    """Whether a task waits for a place that is not known."""
    known = vocabulary.task.get(str(task["title"]))
    name = known.position_parameter if known else None
    return name is not None and task["parameters"].get(name) == list(vocabulary.unresolved)


class _Pen:
    """Draws task after task from where the vehicle is: `here` is None while that is not known,
    `heading` in degrees from north.
    """

    def __init__(self, vocabulary: Vocabulary, vehicle: Mapping[str, Any]) -> None:
        self.vocabulary = vocabulary
        self.cruise_speed, self.turn_rate, self.orbit_angle = (
            vehicle.get(name) for name in ("cruise_speed", "turn_rate", "orbit_angle")
        )
        self.here: Point | None = vocabulary.home
        self.heading = 0.0
        self.legs: list[Leg] = []
        self.open: list[str] = []
        self._speed: float | None = None
        self._center: Point | None = None

    def draw(self, task: Mapping[str, Any]) -> None:
        """Add the legs of a task, or note that it is open."""
        standoff = self.vocabulary.motion.standoff(task["title"])
        self._speed = _stated_speed(task, self.vocabulary) or self.cruise_speed
        self._center = place_of(task, self.vocabulary) if standoff else None
        if is_open(task, self.vocabulary):
            self._leave_open(task)
            self.here = None
        elif task.get("skill_sequence") is None:
            self._draw_parameters(task)
        else:
            for number, step in enumerate(task["skill_sequence"]):
                self._draw_step(task, number, step["navigation_skill"])

    def _draw_parameters(self, task: Mapping[str, Any]) -> None:
        """The movement of a task that has no skills yet, as far as its parameters say it."""
        known, place = self.vocabulary.task.get(task["title"]), place_of(task, self.vocabulary)
        if known and known.pattern == "goto" and place is not None:
            self._go(task, 0, "", place)
            return
        self._leave_open(task)
        self.here = None if known is None or known.leaves else place or self.here

    def _draw_step(self, task: Mapping[str, Any], number: int, skill: Mapping[str, Any]) -> None:
        motion = self.vocabulary.motion.of(skill["name"])
        given = skill["parameters"]
        if motion is None:
            self._leave_open(task)
        elif motion.kind == "go":
            self._go(
                task,
                number,
                skill["name"],
                _point((motion.value("x", given), motion.value("y", given))),
            )
            self.heading = _number(motion.value("heading", given), self.heading)
        elif motion.kind == "arc":
            self._arc(task, number, skill["name"], motion, given)
        elif motion.kind in ("turn-to", "turn-by"):
            self._turn(task, number, skill["name"], motion, given)
        else:
            time = motion.value("time", given)
            self._stay(
                task,
                number,
                skill["name"],
                "drift" if motion.kind == "drift" else "hold",
                None if time is None else float(time),
            )

    def _go(self, task: Mapping[str, Any], step: int, skill: str, goal: Point) -> None:
        length = math.inf if self.here is None else math.dist(self.here, goal)
        if self.here is None or not math.isfinite(length):
            # Where the vehicle comes from is not known, or beyond all numbers, and so is the way.
            self._leave_open(task)
        else:
            if length:
                self.heading = bearing(self.here, goal)
            self._add(task, step, skill, "go", (self.here, goal), length)
        self.here = goal

    def _arc(
        self,
        task: Mapping[str, Any],
        step: int,
        skill: str,
        motion: Motion,
        given: Mapping[str, Any],
    ) -> None:
        """A circle around the task's centre, to which the vehicle first goes straight; without a
        centre, a curve from where it heads.

        How far round a centre is the vehicle's own affair where the skill does not say.
        """
        radius, angle = motion.value("radius", given), motion.value("angle", given)
        if angle is None and self._center is not None:
            angle = self.orbit_angle
        if self.here is None or radius is None or angle is None:
            self._leave_open(task)
            return
        side = 90.0 if angle >= 0 else -90.0
        if self._center is None:
            center, start = _offset(self.here, self.heading + side, radius), self.heading - side
        else:
            center = self._center
            start = bearing(center, self.here) if math.dist(center, self.here) > 0 else self.heading
        drawn = math.copysign(min(abs(angle), 360.0 * MOST_TURNS), angle)
        count = max(1, math.ceil(abs(drawn) / ARC_STEP))
        curve = [
            _offset(center, start + drawn * index / count, radius) for index in range(count + 1)
        ]
        approach = math.dist(self.here, curve[0])
        points = (self.here, *curve) if approach > 0.01 else tuple(curve)
        self._add(task, step, skill, "arc", points, approach + math.radians(abs(angle)) * radius)
        self.here, self.heading = curve[-1], (start + angle + side) % 360

    def _turn(
        self,
        task: Mapping[str, Any],
        step: int,
        skill: str,
        motion: Motion,
        given: Mapping[str, Any],
    ) -> None:
        if motion.kind == "turn-to":
            heading = _number(motion.value("heading", given), self.heading)
            angle = abs((heading - self.heading + 180) % 360 - 180)
        else:
            by = _number(motion.value("angle", given), 0.0)
            heading, angle = self.heading + by, abs(by)
        self.heading = heading % 360
        self._stay(task, step, skill, "turn", angle / self.turn_rate if self.turn_rate else None)

    def _stay(
        self, task: Mapping[str, Any], step: int, skill: str, kind: LegKind, seconds: float | None
    ) -> None:
        points = () if self.here is None else (self.here,)
        self.legs.append(Leg(task["id"], step, skill, kind, points, 0.0, seconds))

    def _add(
        self,
        task: Mapping[str, Any],
        step: int,
        skill: str,
        kind: LegKind,
        points: tuple[Point, ...],
        metres: float,
    ) -> None:
        self.legs.append(
            Leg(
                task["id"],
                step,
                skill,
                kind,
                points,
                metres,
                metres / self._speed if self._speed else None,
            )
        )

    def _leave_open(self, task: Mapping[str, Any]) -> None:
        if task["id"] not in self.open[-1:]:
            self.open.append(task["id"])


def bearing(start: Point, goal: Point) -> float:
    """The direction from one point to another, in degrees clockwise from north."""
    return math.degrees(math.atan2(goal[0] - start[0], goal[1] - start[1])) % 360


def _offset(base: Point, direction: float, length: float) -> Point:
    angle = math.radians(direction)
    return round(base[0] + length * math.sin(angle), 3), round(
        base[1] + length * math.cos(angle), 3
    )


def _point(value: Any) -> Point:
    return float(value[0]), float(value[1])


def _number(value: Any, otherwise: float) -> float:
    return otherwise if value is None else float(value)


def _stated_speed(task: Mapping[str, Any], vocabulary: Vocabulary) -> float | None:
    """The speed that a task's parameters say, by their unit."""
    known = vocabulary.task.get(task["title"])
    speeds = (
        [task["parameters"].get(item.name) for item in known.parameters if item.unit == "m/s"]
        if known
        else []
    )
    return next((speed for speed in speeds if speed), None)


def _circles(tasks: list[dict[str, Any]], vocabulary: Vocabulary) -> Iterator[Circle]:
    for task in tasks:
        standoff = vocabulary.motion.standoff(task["title"])
        center = place_of(task, vocabulary)
        if standoff and center and standoff.radius in task["parameters"]:
            yield Circle(
                task["id"],
                center,
                task["parameters"][standoff.radius],
                task["parameters"].get(standoff.arc) if standoff.arc else None,
            )


def _boundaries(tasks: list[dict[str, Any]], vocabulary: Vocabulary) -> Iterator[Boundary]:
    for task in tasks:
        for number, step in enumerate(task.get("skill_sequence") or ()):
            for skill in step["filter_skills"]:
                motion = vocabulary.motion.of(skill["name"])
                polygon = (
                    motion.value("polygon", skill["parameters"])
                    if motion and motion.kind == "boundary"
                    else None
                )
                if polygon:
                    yield Boundary(task["id"], number, tuple(_point(corner) for corner in polygon))


def _targets(document: Mapping[str, Any], vocabulary: Vocabulary) -> Iterator[Target]:
    tasks = document["tasks"]
    for place in document.get("open_places", ()):
        yield Target(place["name"], None, tasks[place["tasks"][0] - 1]["id"])
    first: dict[Point, str] = {}
    for task in tasks:
        where = place_of(task, vocabulary)
        if where is not None:
            first.setdefault(where, task["id"])
    for name, position in document.get("located", {}).items():
        if _point(position) in first:
            yield Target(name, _point(position), first[_point(position)])
