"""Missions as ground stations read them: items that ArduPilot Rover executes in auto mode.

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

`qgc` is a plan file of QGroundControl with the keys of
https://docs.qgroundcontrol.com/master/en/qgc-dev-guide/file_formats/plan.html; it passes over the
key `planner_ft`, which is ours. `waypoints` is the plain text mission "QGC WPL 110"
(https://mavlink.io/en/file_formats/), whose item 0 is home, as ArduPilot has it. A draft says so in
a first comment, which pymavlink (MAVProxy) and MAVSDK pass over and QGroundControl refuses.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from planner_ft.document.track import Leg, Point, bearing, fastest, speed_of, stated
from planner_ft.exporters.formats import TABLES, Action, Format, PlanExport, Written
from planner_ft.exporters.ledger import Path
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import indented_json

NAV_WAYPOINT, NAV_LOITER_UNLIM, NAV_LOITER_TIME = 16, 17, 19
DO_CHANGE_SPEED, NAV_SET_YAW_SPEED = 178, 213
"""MAV_CMD values (https://mavlink.io/en/messages/common.html#mav_commands)."""
FRAME_GLOBAL, FRAME_MISSION, FRAME_RELATIVE_ALTITUDE = 0, 2, 3  # MAV_FRAME values
VEHICLE_TYPES = {"boat": 11, "rover": 10, "copter": 2}  # MAV_TYPE values by kind of vehicle
LONGEST_HOLD = 32767
MOST_HOLDS = 100  # items of one hold
LEAST_ALTITUDE = 0.01  # metres: ArduPilot counts centimetres, and 0 means the altitude at hand
WIDEST_TURN = 120.0  # degrees that one item turns at most: the vehicle takes the shorter way
TABLE: dict[str, Any] = TABLES["mission"]
REASONS, BY_MOTION, WORDS = TABLE["reasons"], TABLE["motion"], TABLE["words"]

Carried = tuple[tuple[str, ...], str] | None
"""The roles of a skill's parameters that its items hold, and in which form; None: no item."""
Polygon = tuple[tuple[float, float], ...]


@dataclass(frozen=True)
class MissionItem:
    """A MAV_CMD, its first four parameters, and degrees and metres where it has a place."""

    command: int
    parameters: tuple[float, float, float, float] = (0, 0, 0, 0)
    latitude: float = 0.0
    longitude: float = 0.0
    altitude: float = 0.0
    frame: int = FRAME_MISSION

    @property
    def values(self) -> list[float]:
        """All seven parameters."""
        return [*self.parameters, self.latitude, self.longitude, self.altitude]


def build_mission(plan: PlanExport, *, fences: bool) -> Mission:
    """The mission of a plan up to the first task that waits. Raises PlannerError without items."""
    mission = Mission(plan)
    for index in range(plan.ready):
        mission.write_task(index)
    if not mission.items:
        why = plan.blocked[1] if plan.blocked else "it has no movement that a mission can hold"
        raise PlannerError(f"nothing of the plan can be written as a mission: {why}")
    if fences:
        mission.write_fences()
    plan.lose_blocked(mission.ledger)
    return mission


class Mission:
    """The items of a plan, the polygons that fence it in and its home as (latitude, longitude), and
    the account, still open.

    `vehicle_type` is the MAV_TYPE of the vehicle's kind; one whose profile states none is a surface
    boat, or a quadrotor where its movements have altitudes. `heading` is where the bow points, None
    while that is not known.
    """

    def __init__(self, plan: PlanExport) -> None:
        assert plan.origin is not None
        self.plan, self.origin, self.vocabulary = plan, plan.origin, plan.vocabulary
        self.motions, self.vehicle = plan.vocabulary.motion, plan.document["vehicle"]
        moves = [motion for motion in self.motions.skills.values() if motion.kind == "go"]
        usual = "copter" if any("altitude" in one.parameters for one in moves) else "boat"
        kind = self.vehicle.get("kind", usual)
        self.flies, self.vehicle_type = kind == "copter", VEHICLE_TYPES[kind]
        self.items: list[MissionItem] = []
        self.fences: tuple[Polygon, ...] = ()
        area: list[tuple[Path, Sequence[Point]]] = [(("vehicle", "area"), self.vehicle["area"])]
        self.boundaries = area if self.vehicle["area"] else []
        self.home = self.place(*plan.vocabulary.home)
        self.way: list[Point] = [plan.vocabulary.home]
        self.heading: float | None = None
        self.speed = self.usual = self.vehicle["cruise_speed"]
        self.most = math.inf
        self.ledger = plan.ledger()
        for path in self.ledger.items:
            why = next((REASONS[key] for key in path if key in REASONS), WORDS)
            self.ledger.lose(*path, why=why)

    def place(self, x: float, y: float) -> tuple[float, float]:
        """(latitude, longitude) to nine places of degrees: a tenth of a millimetre."""
        latitude, longitude = self.origin.to_geographic(x, y)
        return round(latitude, 9), round(longitude, 9)

    def write_task(self, index: int) -> None:
        """Write the steps of a task; a task without skills goes where its parameters say."""
        task, at, first = self.plan.document["tasks"][index], ("tasks", index), len(self.way)
        known = self.vocabulary.task.get(task["title"])
        self._change_speed(task, at)
        for action in (one for one in self.plan.actions if one.task == index):
            if action.step:
                self._write_step(action)
            elif action.leg:
                self._go(action.leg)
        name = known.position_parameter if known else None
        goal = task["parameters"].get(name) if name else None
        if name and goal and any(math.dist(goal, point) < 0.01 for point in self.way[first:]):
            self.ledger.carry(*at, "parameters", name)

    def write_fences(self) -> None:
        """Fence the mission by the boundaries and the vehicle's area that hold all of it."""
        import shapely

        way = shapely.LineString([*self.way, self.way[-1]])
        fences: dict[tuple[Point, ...], None] = {}
        for path, corners in self.boundaries:
            polygon = shapely.Polygon(corners)
            if not polygon.is_valid or not polygon.covers(way):
                self.ledger.lose(*path, why=TABLE["left" if polygon.is_valid else "crossed"])
                continue
            self.ledger.carry(*path, form=TABLE["fence"])
            ring = shapely.orient_polygons(polygon, exterior_cw=True).exterior
            fences[tuple(ring.coords)[:-1]] = None
        self.fences = tuple(tuple(self.place(*corner) for corner in corners) for corners in fences)

    def _change_speed(self, task: dict[str, Any], at: Path) -> None:
        """Write the speed that a task states, else the vehicle's own, at most what limits allow."""
        self.most = fastest(self.plan.document, int(at[1]) + 1)
        self.usual = speed_of(task, self.vehicle, self.most, self.vocabulary)
        self._set_speed(self.usual)
        said = stated(task, "speed", self.vocabulary)
        if said and said[1] == self.speed:
            self.ledger.carry(*at, "parameters", said[0])

    def _set_speed(self, speed: float | None) -> None:
        if speed and speed != self.speed:
            self.items += [MissionItem(DO_CHANGE_SPEED, (1, speed, -1, 0))] * 2
            self.speed = speed

    def _write_step(self, action: Action) -> None:
        for place, skill in enumerate(action.step["filter_skills"]):
            motion, path = self.motions.of(skill["name"]), (*action.at, "filter_skills", place)
            if motion and motion.kind in BY_MOTION:
                self.ledger.lose(*path, why=BY_MOTION[motion.kind])
            if motion and (corners := motion.value("polygon", skill["parameters"])):
                self.boundaries.append((path, corners))
        motion, leg, at = action.motion, action.leg, (*action.at, "navigation_skill")
        if motion and motion.kind in BY_MOTION:
            self.ledger.lose(*at, why=BY_MOTION[motion.kind])
        if motion is None or leg is None or motion.kind == "drift":
            return
        if self.flies and motion.kind in ("turn-to", "turn-by"):
            self.ledger.lose(*at, why="an ArduPilot multicopter turns only beside a movement")
            return
        if action.timed:
            self.ledger.carry("tasks", action.task, "parameters", action.timed)
        own = action.given.get("speed")
        self._set_speed(min(own, self.most) if own else self.usual)
        if level := self._stays_level(action.given):
            self.ledger.lose(*at, why=TABLE["level"])
        write = {"go": self._move, "arc": self._arc, "hold": self._hold, "wait": self._wait}
        if carried := write.get(motion.kind, self._turn)(action.given, leg):
            roles, form = carried
            if not level:
                self.ledger.carry(*at, "name", form=form)
            if motion.kind == "hold" and "time" not in action.given:
                self.ledger.stop(*at, "name")
            for role, path in action.roles():
                if role in roles and not (level and role == "altitude"):
                    self.ledger.carry(*path, form=form)

    def _stays_level(self, given: Mapping[str, Any]) -> bool:
        """Whether an altitude is stated that the autopilot takes as the one at hand."""
        altitude = given.get("altitude")
        return self.flies and altitude is not None and abs(altitude) < LEAST_ALTITUDE

    def _move(self, given: Mapping[str, Any], leg: Leg) -> Carried:
        if self.flies:
            self._go(leg, float(given.get("altitude") or 0))
            return ("x", "y", "altitude", "speed"), ""
        self._go(leg)
        if given.get("heading") is not None:
            self._turn_to(given["heading"])
        return ("x", "y", "heading", "speed"), ""

    def _arc(self, given: Mapping[str, Any], leg: Leg) -> Carried:
        for point in leg.points[1:]:
            self._waypoint(point)
        self.heading = bearing(*leg.points[-2:])
        form = f"as {len(leg.points) - 1} waypoints along the arc"
        if given.get("angle") is None:
            own = f"{self.vehicle['orbit_angle']:g} degrees are the vehicle's own"
            form += f"; the plan says no angle, {own}"
        return ("radius", "angle", "speed"), form

    def _hold(self, given: Mapping[str, Any], leg: Leg) -> Carried:
        if given.get("time") is not None:
            return self._wait(given, leg)
        self._at(NAV_LOITER_UNLIM, self._start(leg), 0)
        return (), "without an end: the operator sends the vehicle on"

    def _wait(self, given: Mapping[str, Any], leg: Leg) -> Carried:
        seconds = given.get("time")
        if seconds is None:
            return None
        whole, most = math.ceil(seconds), MOST_HOLDS * LONGEST_HOLD
        if whole > most:
            problem = f"{leg.task} holds for {whole} s, and a mission for {most} s at most"
            raise PlannerError(f"{problem}; shorten the hold and plan again")
        for start in range(0, max(whole, 1), LONGEST_HOLD):
            self._at(NAV_LOITER_TIME, self._start(leg), min(whole - start, LONGEST_HOLD))
        return ("time",), f"as {whole} whole seconds" if whole != seconds else ""

    def _start(self, leg: Leg) -> tuple[float, float]:
        """The place where a step begins; degrees of 0 mean where the vehicle is."""
        return self.place(*leg.points[0]) if leg.points else (0.0, 0.0)

    def _turn(self, given: Mapping[str, Any], _leg: Leg) -> Carried:
        heading, angle, start = given.get("heading"), given.get("angle"), self.heading
        if heading is not None:
            self._turn_to(heading)
            return ("heading",), ""
        if angle is None or start is None:
            return None
        count = max(1, math.ceil(abs(float(angle)) / WIDEST_TURN))
        for part in range(1, count + 1):
            self._turn_to(start + float(angle) * part / count)
        return ("angle",), "as the headings that the plan expects"

    def _turn_to(self, heading: float) -> None:
        self.heading = heading % 360
        self.items.append(MissionItem(NAV_SET_YAW_SPEED, (self.heading, 0, 0, 0)))

    def _go(self, leg: Leg, altitude: float = 0.0) -> None:
        if leg.metres:
            self.heading = bearing(*leg.points)
        self._waypoint(leg.points[-1], altitude)

    def _waypoint(self, point: Point, altitude: float = 0.0) -> None:
        self.way.append(point)
        self._at(NAV_WAYPOINT, self.place(*point), 0, altitude)

    def _at(self, command: int, place: Point, first: float, altitude: float = 0.0) -> None:
        """Add an item at (latitude, longitude) with its first parameter."""
        item = MissionItem(command, (first, 0, 0, 0), *place, altitude, FRAME_RELATIVE_ALTITUDE)
        self.items.append(item)


HEADER = "QGC WPL 110"
ARDUPILOT = 3  # MAV_AUTOPILOT value
RELATIVE = 1  # QGroundControl's altitude mode: above home


def write_qgc(plan: PlanExport) -> Written:
    """A .plan file. Raises PlannerError where no item is left."""
    mission = build_mission(plan, fences=True)
    mission.ledger.carry("vehicle", "cruise_speed", form=TABLE["speed"])
    mission.ledger.carry("command", form=TABLE["command"])
    if "kind" in mission.vehicle:
        mission.ledger.carry("vehicle", "kind")
    ours, speed = {"name": plan.name, "approval": plan.mark}, mission.vehicle["cruise_speed"]
    ours |= {key: plan.document[key] for key in ("digest", "command")}
    fences = [{"version": 1, "inclusion": True, "polygon": fence} for fence in mission.fences]
    content = {
        "fileType": "Plan",
        "version": 1,
        "groundStation": "QGroundControl",
        "planner_ft": ours,
        "mission": {
            "version": 2,
            "firmwareType": ARDUPILOT,
            "vehicleType": mission.vehicle_type,
            "globalPlanAltitudeMode": RELATIVE,
            "cruiseSpeed": speed,
            "hoverSpeed": speed,
            "plannedHomePosition": [*mission.home, 0],
            "items": [_qgc_item(number, item) for number, item in enumerate(mission.items, 1)],
        },
        "geoFence": {"version": 2, "circles": [], "polygons": fences},
        "rallyPoints": {"version": 2, "points": []},
    }
    return Written(indented_json(content), mission.ledger.close(WORDS))


def write_waypoints(plan: PlanExport) -> Written:
    """A text mission. Raises PlannerError where no item is left."""
    mission = build_mission(plan, fences=False)
    home = MissionItem(NAV_WAYPOINT, (0, 0, 0, 0), *mission.home, frame=FRAME_GLOBAL)
    lines = [HEADER] if plan.approval else [HEADER, f"# {plan.name}"]
    for number, item in enumerate([home, *mission.items]):
        fields = [number, int(number == 0), item.frame, item.command]
        values = [f"{value:.9f}" for value in item.values]
        lines.append("\t".join([*map(str, fields), *values, "1"]))
    return Written("\n".join(lines) + "\n", mission.ledger.close(TABLE["no_fences"]))


def _qgc_item(number: int, item: MissionItem) -> dict[str, Any]:
    placed = {"AMSLAltAboveTerrain": None, "Altitude": item.altitude, "AltitudeMode": RELATIVE}
    content: dict[str, Any] = {"type": "SimpleItem"}
    content |= placed if item.frame == FRAME_RELATIVE_ALTITUDE else {}
    content |= {"autoContinue": True, "command": item.command, "doJumpId": number}
    return {**content, "frame": item.frame, "params": item.values}


QGC = Format("qgc", ".plan", "QGroundControl plan for ArduPilot Rover", True, write_qgc)
TEXT = "text mission (QGC WPL 110) for ArduPilot Rover"
WAYPOINTS = Format("waypoints", ".waypoints", TEXT, True, write_waypoints)
