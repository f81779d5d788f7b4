"""A plan as items of a MAVLink mission that ArduPilot Rover executes in auto mode.

Which commands Rover knows, and what it makes of their parameters, is read from its documentation
(https://ardupilot.org/planner/docs/common-mavlink-mission-command-messages-mav_cmd.html) and its
source (Rover/mode_auto.cpp):

- a time is a whole number of seconds, and one beyond 32767 is taken as none: a longer hold becomes
  several items;
- a turn by an angle may never end where it passes north, so that every turn is written as the
  absolute heading that the plan expects;
- a change of speed fails while a boat holds its position, which it does at the end of most
  commands; of two in a row the second is executed when the next command has begun;
- an altitude of 0 above home means the altitude at hand.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from planner_ft.document.track import Leg, Point, bearing
from planner_ft.exporters.formats import Handover
from planner_ft.exporters.geodesy import Origin
from planner_ft.exporters.ledger import Ledger, Path
from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary.motion import Motion

NAV_WAYPOINT, NAV_LOITER_UNLIM, NAV_LOITER_TIME, DO_CHANGE_SPEED, NAV_SET_YAW_SPEED = (
    16,
    17,
    19,
    178,
    213,
)
"""MAV_CMD values (https://mavlink.io/en/messages/common.html#mav_commands)."""
FRAME_GLOBAL, FRAME_MISSION, FRAME_RELATIVE_ALTITUDE = 0, 2, 3
"""MAV_FRAME values."""
SURFACE_BOAT, QUADROTOR = 11, 2
"""MAV_TYPE values."""
LONGEST_HOLD = 32767
WIDEST_TURN = 120.0
"""Degrees that one item turns at most: the vehicle takes the shorter way."""

WORDS = "a mission holds no words"
REASONS = {
    "perception_skills": (
        "a mission runs no perception or data skills: run them beside the autopilot"
    ),
    "stop_conditions": "the autopilot ends a command by its own criteria",
    "failure_modes": "the autopilot has failsafes of its own, and none per command",
    "expected_outputs": WORDS,
    "navigation_skill": "the autopilot's command has no place for it",
    "filter_skills": "the autopilot has no such command",
    "parameters": "a mission is written from the skills, not from the task's own values",
    "vehicle": "it is a setting of the autopilot",
}
BY_MOTION = {
    "clearance": (
        "the distance from obstacles is a setting of the autopilot (AVOID_MARGIN), not of a mission"
    ),
    "heading": "the autopilot keeps the bow on its way",
    "drift": (
        "the autopilot has no command that lets the vehicle drift: it goes on with the next step"
    ),
    "wait": "the autopilot cannot tell when the vehicle is steady, and no time is stated",
    "turn-to": "its heading is not stated",
    "turn-by": (
        "its angle or the heading before it is not known, and the autopilot turns to headings"
    ),
    "arc": (
        "its radius or its angle is not stated, so that nobody knows where it ends: state both and"
        " plan again"
    ),
}


@dataclass(frozen=True)
class MissionItem:
    """One item: a MAV_CMD, its first four parameters, and degrees and metres where it has a
    place.
    """

    command: int
    parameters: tuple[float, float, float, float] = (0, 0, 0, 0)
    latitude: float = 0.0
    longitude: float = 0.0
    altitude: float = 0.0
    frame: int = FRAME_MISSION


@dataclass(frozen=True)
class Mission:
    """The items of a plan, the polygons that fence it in as (latitude, longitude), and the account,
    still open.

    `vehicle_type` is a MAV_TYPE: a surface boat, or a quadrotor for a vocabulary whose vehicle has
    altitudes.
    """

    items: tuple[MissionItem, ...]
    fences: tuple[tuple[tuple[float, float], ...], ...]
    vehicle_type: int
    ledger: Ledger


def build_mission(handover: Handover, *, fences: bool) -> Mission:
    """The mission of a plan, up to the first task that waits. Raises PlannerError where no item is
    left.
    """
    writer = _Writer(handover)
    for index in range(handover.ready):
        writer.write_task(index)
    if not writer.items:
        why = (
            handover.blocked[1]
            if handover.blocked
            else "it has no movement that a mission can hold"
        )
        raise PlannerError(f"nothing of the plan can be written as a mission: {why}")
    polygons = writer.write_fences() if fences else ()
    if handover.blocked:
        for index in range(handover.ready, len(handover.document["tasks"])):
            writer.ledger.lose("tasks", index, why=handover.blocked[1])
    return Mission(
        tuple(writer.items), polygons, QUADROTOR if writer.flies else SURFACE_BOAT, writer.ledger
    )


def coordinate(degrees: float) -> float:
    """Degrees to nine places: a tenth of a millimetre."""
    return round(degrees, 9)


class _Writer:
    """Writes item after item and keeps account; `heading` is where the bow points, None while that
    is not known.
    """

    def __init__(self, handover: Handover) -> None:
        assert handover.origin is not None
        self.document, self.motion, self.vocabulary = (
            handover.document,
            handover.vocabulary.motion,
            handover.vocabulary,
        )
        self.origin: Origin = handover.origin
        self.ready = handover.ready
        self.flies = any(
            motion.kind == "go" and "altitude" in motion.parameters
            for motion in self.motion.skills.values()
        )
        self.legs = {(leg.task, leg.step): leg for leg in handover.track.legs}
        self.items: list[MissionItem] = []
        self.way: list[Point] = [handover.vocabulary.home]
        self.heading: float | None = None
        self.speed = self.document["vehicle"]["cruise_speed"]
        self.ledger = handover.ledger()
        for path in self.ledger.items:
            self.ledger.lose(
                *path, why=next((REASONS[key] for key in path if key in REASONS), WORDS)
            )

    def write_task(self, index: int) -> None:
        """Write the steps of a task; a task without skills goes where its parameters say."""
        task, at = self.document["tasks"][index], ("tasks", index)
        first = len(self.way)
        self._change_speed(task, at)
        for number, step in enumerate(task["skill_sequence"] or ()):
            self._write_step(
                (*at, "skill_sequence", number), step, self.legs.get((task["id"], number))
            )
        if task["skill_sequence"] is None:
            self._go(self.legs[task["id"], 0])
        known = self.vocabulary.task.get(task["title"])
        place = known.position_parameter if known else None
        if place and any(
            math.dist(task["parameters"].get(place, (math.inf, 0)), point) < 0.01
            for point in self.way[first:]
        ):
            self.ledger.carry(*at, "parameters", place)

    def write_fences(self) -> tuple[tuple[tuple[float, float], ...], ...]:
        """The boundaries and the vehicle's area that hold the whole mission; others cannot be
        fences.
        """
        import shapely

        way = shapely.LineString([*self.way, self.way[-1]])
        fences: dict[tuple[Point, ...], None] = {}
        for path, corners in self._boundaries():
            polygon = shapely.Polygon(corners)
            if not polygon.is_valid:
                self.ledger.lose(*path, why="its sides cross, and a fence's may not")
            elif not polygon.covers(way):
                self.ledger.lose(
                    *path,
                    why="a fence holds for the whole mission, and the mission leaves this one",
                )
            else:
                self.ledger.carry(*path, form="as an inclusion fence of the whole mission")
                fences[
                    tuple(shapely.orient_polygons(polygon, exterior_cw=True).exterior.coords)[:-1]
                ] = None
        return tuple(tuple(self._place(*corner) for corner in corners) for corners in fences)

    def _boundaries(self) -> list[tuple[Path, Sequence[Point]]]:
        area = self.document["vehicle"]["area"]
        found: list[tuple[Path, Sequence[Point]]] = [(("vehicle", "area"), area)] if area else []
        for index, task in enumerate(self.document["tasks"][: self.ready]):
            for number, step in enumerate(task["skill_sequence"] or ()):
                for place, skill in enumerate(step["filter_skills"]):
                    motion = self.motion.of(skill["name"])
                    corners = motion.value("polygon", skill["parameters"]) if motion else None
                    if corners:
                        found.append(
                            (
                                ("tasks", index, "skill_sequence", number, "filter_skills", place),
                                corners,
                            )
                        )
        return found

    def _change_speed(self, task: dict[str, Any], at: Path) -> None:
        """Write the speed that a task states; a task that states none goes at the vehicle's own."""
        known = self.vocabulary.task.get(task["title"])
        name = (
            next(
                (
                    item.name
                    for item in known.parameters
                    if item.unit == "m/s" and task["parameters"].get(item.name)
                ),
                None,
            )
            if known
            else None
        )
        speed = task["parameters"][name] if name else self.document["vehicle"]["cruise_speed"]
        if speed != self.speed:
            self.items += [MissionItem(DO_CHANGE_SPEED, (1, speed, -1, 0))] * 2
            self.speed = speed
        if name:
            self.ledger.carry(*at, "parameters", name)

    def _write_step(self, at: Path, step: dict[str, Any], leg: Leg | None) -> None:
        for place, skill in enumerate(step["filter_skills"]):
            motion = self.motion.of(skill["name"])
            if motion and motion.kind in BY_MOTION:
                self.ledger.lose(*at, "filter_skills", place, why=BY_MOTION[motion.kind])
        skill, at = step["navigation_skill"], (*at, "navigation_skill")
        motion = self.motion.of(skill["name"])
        if motion is None:
            return
        given = skill["parameters"]
        write = {
            "go": self._step_go,
            "arc": self._step_arc,
            "hold": self._step_hold,
            "wait": self._step_hold,
        }.get(motion.kind, self._step_turn)
        if motion.kind in BY_MOTION:
            self.ledger.lose(*at, why=BY_MOTION[motion.kind])
        if leg is not None and motion.kind != "drift":
            write(at, motion, given, leg)

    def _step_go(self, at: Path, motion: Motion, given: dict[str, Any], leg: Leg) -> None:
        self._go(leg, float(motion.value("altitude", given) or 0))
        self._carry(at, motion, given, ("x", "y", "altitude"))
        heading = motion.value("heading", given)
        if heading is not None and not self.flies:
            self._turn_to(heading)
            self._carry(at, motion, given, ("heading",))

    def _step_arc(self, at: Path, motion: Motion, given: dict[str, Any], leg: Leg) -> None:
        for point in leg.points[1:]:
            self._waypoint(point)
        self.heading = bearing(*leg.points[-2:])
        own = (
            ""
            if motion.value("angle", given) is not None
            else (
                f"; the plan says no angle, {self.document['vehicle']['orbit_angle']:g} degrees are"
                " the vehicle's own"
            )
        )
        self._carry(
            at,
            motion,
            given,
            ("radius", "angle"),
            f"as {len(leg.points) - 1} waypoints along the arc{own}",
        )

    def _step_hold(self, at: Path, motion: Motion, given: dict[str, Any], leg: Leg) -> None:
        """Hold where the step begins (degrees of 0: where the vehicle is)."""
        seconds, place = (
            motion.value("time", given),
            (self._place(*leg.points[0]) if leg.points else (0.0, 0.0)),
        )
        if seconds is not None:
            whole = math.ceil(seconds)
            for start in range(0, max(whole, 1), LONGEST_HOLD):
                self._at(NAV_LOITER_TIME, place, min(whole - start, LONGEST_HOLD))
            self._carry(
                at,
                motion,
                given,
                ("time",),
                f"as {whole} whole seconds" if whole != seconds else "",
            )
        elif motion.kind == "hold":
            self._at(NAV_LOITER_UNLIM, place)
            self._carry(at, motion, given, (), "without an end: the operator sends the vehicle on")

    def _step_turn(self, at: Path, motion: Motion, given: dict[str, Any], _leg: Leg) -> None:
        if self.flies:
            self.ledger.lose(*at, why="an ArduPilot multicopter turns only beside a movement")
        elif motion.kind == "turn-to" and motion.value("heading", given) is not None:
            self._turn_to(motion.value("heading", given))
            self._carry(at, motion, given, ("heading",))
        elif (
            motion.kind == "turn-by"
            and motion.value("angle", given) is not None
            and self.heading is not None
        ):
            angle, start = float(motion.value("angle", given)), self.heading
            count = max(1, math.ceil(abs(angle) / WIDEST_TURN))
            for part in range(1, count + 1):
                self._turn_to(start + angle * part / count)
            self._carry(at, motion, given, ("angle",), "as the headings that the plan expects")

    def _turn_to(self, heading: float) -> None:
        self.heading = heading % 360
        self.items.append(MissionItem(NAV_SET_YAW_SPEED, (self.heading, 0, 0, 0)))

    def _go(self, leg: Leg, altitude: float = 0.0) -> None:
        if leg.metres:
            self.heading = bearing(*leg.points)
        self._waypoint(leg.points[-1], altitude)

    def _waypoint(self, point: Point, altitude: float = 0.0) -> None:
        self.way.append(point)
        self._at(NAV_WAYPOINT, self._place(*point), altitude=altitude)

    def _at(
        self, command: int, place: tuple[float, float], first: float = 0, altitude: float = 0.0
    ) -> None:
        self.items.append(
            MissionItem(command, (first, 0, 0, 0), *place, altitude, FRAME_RELATIVE_ALTITUDE)
        )

    def _carry(
        self,
        at: Path,
        motion: Motion,
        given: dict[str, Any],
        roles: tuple[str, ...],
        form: str = "",
    ) -> None:
        self.ledger.carry(*at, "name", form=form)
        for name in (motion.parameters.get(role) for role in roles):
            if name in given:
                self.ledger.carry(*at, "parameters", name, form=form)

    def _place(self, x: float, y: float) -> tuple[float, float]:
        latitude, longitude = self.origin.to_geographic(x, y)
        return coordinate(latitude), coordinate(longitude)
