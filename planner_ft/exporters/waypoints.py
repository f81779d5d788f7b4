"""The format `waypoints`: the plain text mission "QGC WPL 110"
(https://mavlink.io/en/file_formats/).

Item 0 is home, as ArduPilot has it. A draft says so in a first comment, which pymavlink (MAVProxy)
and MAVSDK pass over and QGroundControl refuses.
"""

from __future__ import annotations

from planner_ft.exporters.formats import Format, Handover, Written
from planner_ft.exporters.mission import (
    FRAME_GLOBAL,
    NAV_WAYPOINT,
    MissionItem,
    build_mission,
    coordinate,
)

HEADER = "QGC WPL 110"


def write(handover: Handover) -> Written:
    """A text mission. Raises PlannerError where no item is left."""
    mission = build_mission(handover, fences=False)
    assert handover.origin is not None
    latitude, longitude = map(coordinate, handover.origin.to_geographic(*handover.vocabulary.home))
    items = [
        MissionItem(NAV_WAYPOINT, (0, 0, 0, 0), latitude, longitude, 0.0, FRAME_GLOBAL),
        *mission.items,
    ]
    comment = [] if handover.approval else [f"# {handover.name}"]
    lines = [HEADER, *comment, *(_line(number, item) for number, item in enumerate(items))]
    return Written(
        "\n".join(lines) + "\n", mission.ledger.close("the format has no fences and no words")
    )


def _line(number: int, item: MissionItem) -> str:
    values = [*item.parameters, item.latitude, item.longitude, item.altitude]
    return "\t".join(
        [
            str(number),
            str(int(number == 0)),
            str(item.frame),
            str(item.command),
            *(f"{value:.9f}" for value in values),
            "1",
        ]
    )


FORMAT = Format(
    "waypoints",
    ".waypoints",
    "text mission (QGC WPL 110) for ArduPilot Rover",
    needs_origin=True,
    write=write,
)
