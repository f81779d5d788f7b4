"""The format `qgc`: a plan file of QGroundControl, for ArduPilot Rover.

Its keys are those of
https://docs.qgroundcontrol.com/master/en/qgc-dev-guide/file_formats/plan.html. The key `planner_ft`
is ours: QGroundControl passes over keys that it does not know.
"""

from __future__ import annotations

from typing import Any

from planner_ft.exporters.formats import Format, Handover, Written
from planner_ft.exporters.mission import (
    FRAME_RELATIVE_ALTITUDE,
    WORDS,
    MissionItem,
    build_mission,
    coordinate,
)
from planner_ft.support.files import indented_json

ARDUPILOT = 3
"""MAV_AUTOPILOT value."""
RELATIVE = 1
"""QGroundControl's altitude mode: above home."""


def write(handover: Handover) -> Written:
    """A .plan file. Raises PlannerError where no item is left."""
    mission = build_mission(handover, fences=True)
    speed = handover.document["vehicle"]["cruise_speed"]
    mission.ledger.carry(
        "vehicle",
        "cruise_speed",
        form="for the ground station's estimates; the vehicle has its own (WP_SPEED)",
    )
    mission.ledger.carry(
        "command", form="in the key planner_ft, which QGroundControl does not show"
    )
    plan = {
        "fileType": "Plan",
        "version": 1,
        "groundStation": "QGroundControl",
        "planner_ft": {
            "name": handover.name,
            "approval": handover.mark,
            "digest": handover.document["digest"],
            "command": handover.document["command"],
        },
        "mission": {
            "version": 2,
            "firmwareType": ARDUPILOT,
            "vehicleType": mission.vehicle_type,
            "globalPlanAltitudeMode": RELATIVE,
            "cruiseSpeed": speed,
            "hoverSpeed": speed,
            "plannedHomePosition": [*_home(handover), 0],
            "items": [_item(number, item) for number, item in enumerate(mission.items, start=1)],
        },
        "geoFence": {
            "version": 2,
            "circles": [],
            "polygons": [
                {"version": 1, "inclusion": True, "polygon": [list(corner) for corner in fence]}
                for fence in mission.fences
            ],
        },
        "rallyPoints": {"version": 2, "points": []},
    }
    return Written(indented_json(plan), mission.ledger.close(WORDS))


def _home(handover: Handover) -> tuple[float, float]:
    assert handover.origin is not None
    latitude, longitude = handover.origin.to_geographic(*handover.vocabulary.home)
    return coordinate(latitude), coordinate(longitude)


def _item(number: int, item: MissionItem) -> dict[str, Any]:
    placed = (
        {"AMSLAltAboveTerrain": None, "Altitude": item.altitude, "AltitudeMode": RELATIVE}
        if item.frame == FRAME_RELATIVE_ALTITUDE
        else {}
    )
    parameters = [*item.parameters, item.latitude, item.longitude, item.altitude]
    return {
        "type": "SimpleItem",
        **placed,
        "autoContinue": True,
        "command": item.command,
        "doJumpId": number,
        "frame": item.frame,
        "params": parameters,
    }


FORMAT = Format(
    "qgc", ".plan", "QGroundControl plan for ArduPilot Rover", needs_origin=True, write=write
)
