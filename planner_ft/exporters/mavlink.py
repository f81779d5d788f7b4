"""Missions as ground stations read them, for ArduPilot.

`qgc` is a plan file of QGroundControl with the keys of
https://docs.qgroundcontrol.com/master/en/qgc-dev-guide/file_formats/plan.html; it passes over the
key `planner_ft`, which is ours. `waypoints` is the plain text mission "QGC WPL 110"
(https://mavlink.io/en/file_formats/), whose item 0 is home, as ArduPilot has it. A draft says so in
a first comment, which pymavlink (MAVProxy) and MAVSDK pass over and QGroundControl refuses.
"""

from __future__ import annotations

from typing import Any

from planner_ft.exporters import mission as items
from planner_ft.exporters.formats import TABLES, Format, PlanExport, Written
from planner_ft.exporters.mission import Mission, MissionItem, build_mission
from planner_ft.support.files import indented_json

HEADER = "QGC WPL 110"
ARDUPILOT = 3  # MAV_AUTOPILOT value
RELATIVE = 1  # QGroundControl's altitude mode: above home
TABLE: dict[str, str] = TABLES["mission"]


def write_qgc(plan: PlanExport) -> Written:
    """A .plan file. Raises PlannerError where no item is left."""
    mission = build_mission(plan, fences=True)
    mission.ledger.carry("vehicle", "cruise_speed", form=TABLE["speed"])
    mission.ledger.carry("command", form=TABLE["command"])
    ours = {"name": plan.name, "approval": plan.mark}
    ours |= {key: plan.document[key] for key in ("digest", "command")}
    fences = [{"version": 1, "inclusion": True, "polygon": fence} for fence in mission.fences]
    content = {
        "fileType": "Plan",
        "version": 1,
        "groundStation": "QGroundControl",
        "planner_ft": ours,
        "mission": _qgc_mission(mission),
        "geoFence": {"version": 2, "circles": [], "polygons": fences},
        "rallyPoints": {"version": 2, "points": []},
    }
    return Written(indented_json(content), mission.ledger.close(items.WORDS))


def write_waypoints(plan: PlanExport) -> Written:
    """A text mission. Raises PlannerError where no item is left."""
    mission = build_mission(plan, fences=False)
    home = MissionItem(items.NAV_WAYPOINT, (0, 0, 0, 0), *mission.home, frame=items.FRAME_GLOBAL)
    lines = [HEADER] if plan.approval else [HEADER, f"# {plan.name}"]
    for number, item in enumerate([home, *mission.items]):
        fields = [number, int(number == 0), item.frame, item.command]
        values = [f"{value:.9f}" for value in item.values]
        lines.append("\t".join([*map(str, fields), *values, "1"]))
    return Written("\n".join(lines) + "\n", mission.ledger.close(TABLE["no_fences"]))


def _qgc_mission(mission: Mission) -> dict[str, Any]:
    speed = mission.vehicle["cruise_speed"]
    return {
        "version": 2,
        "firmwareType": ARDUPILOT,
        "vehicleType": mission.vehicle_type,
        "globalPlanAltitudeMode": RELATIVE,
        "cruiseSpeed": speed,
        "hoverSpeed": speed,
        "plannedHomePosition": [*mission.home, 0],
        "items": [_qgc_item(number, item) for number, item in enumerate(mission.items, 1)],
    }


def _qgc_item(number: int, item: MissionItem) -> dict[str, Any]:
    placed = {"AMSLAltAboveTerrain": None, "Altitude": item.altitude, "AltitudeMode": RELATIVE}
    content: dict[str, Any] = {"type": "SimpleItem"}
    content |= placed if item.frame == items.FRAME_RELATIVE_ALTITUDE else {}
    content |= {"autoContinue": True, "command": item.command, "doJumpId": number}
    return {**content, "frame": item.frame, "params": item.values}


QGC = Format("qgc", ".plan", "QGroundControl plan for ArduPilot Rover", True, write_qgc)
TEXT = "text mission (QGC WPL 110) for ArduPilot Rover"
WAYPOINTS = Format("waypoints", ".waypoints", TEXT, True, write_waypoints)
