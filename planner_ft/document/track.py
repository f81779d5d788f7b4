"""The track of a plan: movements of its skills, leg by leg, in local metres (x east, y north).

The vocabulary's motion file gives the movements; a task without skills moves only as its parameters
say. The vehicle starts at home, bow north, and goes straight; wind and obstacles are not known.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any, Literal

from planner_ft.facts.units import converted
from planner_ft.vocabulary import Entry, Vocabulary
from planner_ft.vocabulary.definition import Motion
from planner_ft.vocabulary.plans import is_number

Point = tuple[float, float]
LegKind = Literal["go", "arc", "hold", "drift", "turn"]
ARC_STEP = 10.0  # degrees between the points of an arc
UNITS = {"speed": "m/s", "time": "s"}
MOST_TURNS = 10  # turns of one arc that are drawn; more lie on them


@dataclass(frozen=True)
class Leg:
    """One movement or hold of a step (from 0); `seconds` is None when it is not known."""

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
    """Legs in the order of the plan; `open` are tasks whose movement is not known in full, `end` is
    where the vehicle is at the end, None where that is not known.
    """

    legs: tuple[Leg, ...]
    circles: tuple[Circle, ...]
    boundaries: tuple[Boundary, ...]
    targets: tuple[Target, ...]
    open: tuple[str, ...]
    end: Point | None = None

    def of(self, task: str, step: int | None = None) -> list[Leg]:
        """The legs of a task, or of one of its steps."""
        return [leg for leg in self.legs if leg.task == task and step in (None, leg.step)]

    def last(self, home: Point) -> Point:
        """The last known point."""
        return next((leg.points[-1] for leg in reversed(self.legs) if leg.points), home)


def track(document: Entry, vocabulary: Vocabulary) -> Track:
    """The track of a plan document."""
    tasks: Sequence[Entry] = document["tasks"]
    pen = Pen(vocabulary, document.get("vehicle") or {})
    for number, task in enumerate(tasks, start=1):
        pen.draw(task, fastest(document, number))
    circles, boundaries = _circles(tasks, vocabulary), _boundaries(tasks, vocabulary)
    shapes = tuple(circles), tuple(boundaries), tuple(_targets(document, vocabulary))
    return Track(tuple(pen.legs), *shapes, tuple(pen.open), pen.here)


def estimate(document: Entry, path: Track, home: Point = (0.0, 0.0)) -> dict[str, Any]:
    """Sums of what is known: {"length" in metres, "seconds", "open": tasks that lack a part}.

    `away` is how far from home the plan ends, where that is known and not home.
    """
    away = round(math.dist(path.last(home), home), 1)
    untimed = {leg.task for leg in path.legs if leg.seconds is None} | set(path.open)
    return {
        **({"away": away} if away and not path.open else {}),
        "length": round(sum(leg.metres for leg in path.legs), 1),
        "seconds": round(sum(leg.seconds or 0.0 for leg in path.legs)),
        "open": [task["id"] for task in document["tasks"] if task["id"] in untimed],
    }


def place_of(task: Entry, vocabulary: Vocabulary) -> Point | None:
    """Where a task takes place; None where it has no place, or one that is not known."""
    known = vocabulary.task.get(str(task["title"]))
    value = task["parameters"].get(known.position_parameter) if known else None
    return None if value is None or tuple(value) == vocabulary.unresolved else point_of(value)


def circle_of(task: Entry, vocabulary: Vocabulary) -> tuple[Point, float] | None:
    """The circle that a task keeps: its centre and its radius."""
    circle, center = vocabulary.motion.standoff(task["title"]), place_of(task, vocabulary)
    radius = task["parameters"].get(circle.radius) if circle else None
    return (center, float(radius)) if center and radius else None


def stated(task: Entry, role: str, vocabulary: Vocabulary) -> tuple[str, float] | None:
    """The parameter of a task that says its "speed" (in m/s) or "time" (in s), and its value."""
    known, name = (
        vocabulary.task.get(task["title"]),
        vocabulary.motion.parameter(task["title"], role),
    )
    item, value = known.by_name.get(name) if known else None, task["parameters"].get(name)
    if item is None or not is_number(value):
        return None
    unit = UNITS[role]
    found = converted(value, item.unit or unit, unit)
    return None if found is None else (name, found)


def fastest(document: Entry, number: int) -> float:
    """The speed in m/s that limits of the plan allow its task of this number; infinite without."""
    limits = (one for one in document.get("limits", ()) if one["kind"] == "speed")
    return min(
        (one["values"]["speed"] for one in limits if number in one["tasks"]), default=math.inf
    )


def speed_of(task: Entry, vehicle: Entry, most: float, vocabulary: Vocabulary) -> float | None:
    """Metres per second that a task goes at: what it says, else the vehicle's; at most `most`."""
    said = stated(task, "speed", vocabulary)
    speed = (said and said[1]) or vehicle.get("cruise_speed")
    return min(speed, most) if speed else None


def hold_time(task: Entry, vocabulary: Vocabulary) -> tuple[str, float] | None:
    """(parameter, seconds) of a task whose one stay is a hold by a skill that takes no time."""
    steps, motions = task.get("skill_sequence") or (), vocabulary.motion
    moves = [motions.of(step["navigation_skill"]["name"]) for step in steps]
    stays = [move for move in moves if move and move.kind in ("hold", "wait", "drift")]
    timeless = [move for move in stays if move.kind == "hold" and "time" not in move.parameters]
    return stated(task, "time", vocabulary) if len(stays) == len(timeless) == 1 else None


class Pen:
    """Draws tasks from `here` (None: not known), with `heading` in degrees from north."""

    def __init__(self, vocabulary: Vocabulary, vehicle: Entry) -> None:
        self.vocabulary, self.vehicle = vocabulary, vehicle
        self.here: Point | None = vocabulary.home
        self.heading = 0.0
        self.legs: list[Leg] = []
        self.open: list[str] = []
        self._at = ("", 0, "")
        self._speed: float | None = None
        self._most = math.inf
        self._time: tuple[str, float] | None = None
        self._center: Point | None = None

    def draw(self, task: Entry, most: float = math.inf) -> None:
        """Add the legs of a task that goes at `most` m/s at most, or note that it is open."""
        self.begin(task, most)
        known, place = self.vocabulary.task.get(task["title"]), place_of(task, self.vocabulary)
        if "waits_for" in task:
            self._leave_open()
            self.here = None
        elif task.get("skill_sequence") is not None:
            for number, step in enumerate(task["skill_sequence"]):
                self.step(number, step["navigation_skill"])
        elif known and known.pattern == "goto" and place is not None:
            self._go(place)
        else:
            self._leave_open()
            self.here = None if known is None or known.leaves else place or self.here

    def begin(self, task: Entry, most: float = math.inf) -> None:
        """Take over the speed, the time and the centre of a task."""
        self._speed, self._most = speed_of(task, self.vehicle, most, self.vocabulary), most
        self._time = hold_time(task, self.vocabulary)
        circle = self.vocabulary.motion.standoff(task["title"])
        self._center = place_of(task, self.vocabulary) if circle else None
        self._at = (task["id"], 0, "")

    def step(self, number: int, skill: Entry) -> None:
        """Add the leg of a navigation skill, in the step of this number (from 0)."""
        self._at = (self._at[0], number, skill["name"])
        motion, given = self.vocabulary.motion.of(skill["name"]), skill["parameters"]
        usual = self._speed
        if motion and (own := motion.value("speed", given)):
            self._speed = min(float(own), self._most)
        if motion is None:
            self._leave_open()
        elif motion.kind == "go":
            self._go(point_of((motion.value("x", given), motion.value("y", given))))
            self.heading = _number(motion.value("heading", given), self.heading)
        elif motion.kind == "arc":
            self._arc(motion.value("radius", given), motion.value("angle", given))
        elif motion.kind in ("turn-to", "turn-by"):
            self._turn(motion, given)
        else:
            time = motion.value("time", given)
            if time is None and motion.kind == "hold" and self._time:
                time = self._time[1]
            kind: LegKind = "drift" if motion.kind == "drift" else "hold"
            self._stay(kind, None if time is None else float(time))
        self._speed = usual

    def _go(self, goal: Point) -> None:
        length = math.inf if self.here is None else math.dist(self.here, goal)
        if self.here is None or not math.isfinite(length):
            self._leave_open()  # where the vehicle comes from is not known, or beyond all numbers
        else:
            if length:
                self.heading = bearing(self.here, goal)
            self._move("go", (self.here, goal), length)
        self.here = goal

    def _arc(self, radius: float | None, angle: float | None) -> None:
        """A circle around the task's centre, reached straight; else a curve from the heading."""
        if angle is None and self._center is not None:
            angle = self.vehicle.get("orbit_angle")
        if self.here is None or radius is None or angle is None:
            self._leave_open()
            return
        side = 90.0 if angle >= 0 else -90.0
        if self._center is None:
            center, start = _offset(self.here, self.heading + side, radius), self.heading - side
        else:
            center = self._center
            start = bearing(center, self.here) if math.dist(center, self.here) > 0 else self.heading
        drawn = math.copysign(min(abs(angle), 360.0 * MOST_TURNS), angle)
        count = max(1, math.ceil(abs(drawn) / ARC_STEP))
        angles = [start + drawn * index / count for index in range(count + 1)]
        curve = tuple(_offset(center, direction, radius) for direction in angles)
        approach = math.dist(self.here, curve[0])
        points = (self.here, *curve) if approach > 0.01 else curve
        self._move("arc", points, approach + math.radians(abs(angle)) * radius)
        self.here, self.heading = curve[-1], (start + angle + side) % 360

    def _turn(self, motion: Motion, given: Entry) -> None:
        heading = self.heading + (by := _number(motion.value("angle", given), 0.0))
        if motion.kind == "turn-to":
            heading = _number(motion.value("heading", given), self.heading)
            by = math.remainder(heading - self.heading, 360)
        self.heading = heading % 360
        rate = self.vehicle.get("turn_rate")
        self._stay("turn", abs(by) / rate if rate else None)

    def _stay(self, kind: LegKind, seconds: float | None) -> None:
        points = () if self.here is None else (self.here,)
        self.legs.append(Leg(*self._at, kind, points, 0.0, seconds))

    def _move(self, kind: LegKind, points: tuple[Point, ...], metres: float) -> None:
        seconds = metres / self._speed if self._speed else None
        self.legs.append(Leg(*self._at, kind, points, metres, seconds))

    def _leave_open(self) -> None:
        if self._at[0] not in self.open[-1:]:
            self.open.append(self._at[0])


def bearing(start: Point, goal: Point) -> float:
    """The direction from one point to another, in degrees clockwise from north."""
    return math.degrees(math.atan2(goal[0] - start[0], goal[1] - start[1])) % 360


def shown(point: Sequence[float]) -> str:
    """A position in words: [250, -80]."""
    return f"[{point[0]:.10g}, {point[1]:.10g}]"


def _offset(base: Point, direction: float, length: float) -> Point:
    x, y = math.sin(math.radians(direction)), math.cos(math.radians(direction))
    return round(base[0] + length * x, 3), round(base[1] + length * y, 3)


def point_of(value: Any) -> Point:
    """A position of a plan as a point."""
    return float(value[0]), float(value[1])


def _number(value: Any, otherwise: float) -> float:
    return otherwise if value is None else float(value)


def _circles(tasks: Sequence[Entry], vocabulary: Vocabulary) -> Iterator[Circle]:
    for task in tasks:
        standoff, given = vocabulary.motion.standoff(task["title"]), task["parameters"]
        center = place_of(task, vocabulary)
        if standoff and center and standoff.radius in given:
            yield Circle(task["id"], center, given[standoff.radius], given.get(standoff.arc or ""))


def _boundaries(tasks: Sequence[Entry], vocabulary: Vocabulary) -> Iterator[Boundary]:
    for task in tasks:
        for number, step in enumerate(task.get("skill_sequence") or ()):
            for skill in step["filter_skills"]:
                motion, given = vocabulary.motion.of(skill["name"]), skill["parameters"]
                bounds = motion if motion and motion.kind == "boundary" else None
                if bounds and (corners := bounds.value("polygon", given)):
                    yield Boundary(task["id"], number, tuple(map(point_of, corners)))


def _targets(document: Entry, vocabulary: Vocabulary) -> Iterator[Target]:
    tasks = document["tasks"]
    for place in document.get("open_places", ()):
        yield Target(place["name"], None, tasks[place["tasks"][0] - 1]["id"])
    places = {place_of(task, vocabulary): task["id"] for task in reversed(tasks)}
    for name, position in document.get("located", {}).items():
        if point_of(position) in places:
            yield Target(name, point_of(position), places[point_of(position)])
