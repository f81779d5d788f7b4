"""Missions as ground stations read them, for ArduPilot.

`qgc` is a plan file of QGroundControl with the keys of
https://docs.qgroundcontrol.com/master/en/qgc-dev-guide/file_formats/plan.html; it passes over the
key `planner_ft`, which is ours. `waypoints` is the plain text mission "QGC WPL 110"
(https://mavlink.io/en/file_formats/), whose item 0 is home, as ArduPilot has it. A draft says so in
a first comment, which pymavlink (MAVProxy) and MAVSDK pass over and QGroundControl refuses.
"""

from __future__ import annotations

from typing import Any

from planner_ft.exporters.formats import Format, PlanExport, Written
from planner_ft.exporters.mission import (
    FRAME_GLOBAL,
    FRAME_RELATIVE_ALTITUDE,
    NAV_WAYPOINT,
    WORDS,
    MissionItem,
    build_mission,
)
from planner_ft.support.files import indented_json

HEADER = "QGC WPL 110"
ARDUPILOT = 3
"""MAV_AUTOPILOT value."""
RELATIVE = 1
"""QGroundControl's altitude mode: above home."""
SPEED_FORM = "for the ground station's estimates; the vehicle has its own (WP_SPEED)"
COMMAND_FORM = "in the key planner_ft, which QGroundControl does not show"


def write_qgc(plan: PlanExport) -> Written:
    """A .plan file. Raises PlannerError where no item is left."""
    mission = build_mission(plan, fences=True)
    speed = plan.document["vehicle"]["cruise_speed"]
    mission.ledger.carry("vehicle", "cruise_speed", form=SPEED_FORM)
    mission.ledger.carry("command", form=COMMAND_FORM)
    polygons = [[list(corner) for corner in fence] for fence in mission.fences]
    content = {
        "fileType": "Plan",
        "version": 1,
        "groundStation": "QGroundControl",
        "planner_ft": {
            "name": plan.name,
            "approval": plan.mark,
            "digest": plan.document["digest"],
            "command": plan.document["command"],
        },
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
        "geoFence": {
            "version": 2,
            "circles": [],
            "polygons": [{"version": 1, "inclusion": True, "polygon": one} for one in polygons],
        },
        "rallyPoints": {"version": 2, "points": []},
    }
    return Written(indented_json(content), mission.ledger.close(WORDS))


def write_waypoints(plan: PlanExport) -> Written:
    """A text mission. Raises PlannerError where no item is left."""
    mission = build_mission(plan, fences=False)
    home = MissionItem(NAV_WAYPOINT, (0, 0, 0, 0), *mission.home, 0.0, FRAME_GLOBAL)
    lines = [HEADER] if plan.approval else [HEADER, f"# {plan.name}"]
    for number, item in enumerate([home, *mission.items]):
        fields = [number, int(number == 0), item.frame, item.command]
        values = [f"{value:.9f}" for value in item.values]
        lines.append("\t".join([*map(str, fields), *values, "1"]))
    account = mission.ledger.close("the format has no fences and no words")
    return Written("\n".join(lines) + "\n", account)


def _qgc_item(number: int, item: MissionItem) -> dict[str, Any]:
    placed = {"AMSLAltAboveTerrain": None, "Altitude": item.altitude, "AltitudeMode": RELATIVE}
    return {
        "type": "SimpleItem",
        **(placed if item.frame == FRAME_RELATIVE_ALTITUDE else {}),
        "autoContinue": True,
        "command": item.command,
        "doJumpId": number,
        "frame": item.frame,
        "params": item.values,
    }


QGC = Format("qgc", ".plan", "QGroundControl plan for ArduPilot Rover", True, write_qgc)
WAYPOINTS = Format(
    "waypoints",
    ".waypoints",
    "text mission (QGC WPL 110) for ArduPilot Rover",
    needs_origin=True,
    write=write_waypoints,
)
