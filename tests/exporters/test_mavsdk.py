"""MAVSDK's own importers read what we write; a heartbeat in memory stands for the vehicle, nothing
is connected.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any

import pytest
from pymavlink.dialects.v20 import ardupilotmega

from planner_ft.exporters import Origin, PlanExport, load_format

from .plans import BUOY, DRONE, MAST, USV, document, step, task
from .readers import plan_items

pytest.importorskip("mavsdk", reason="MAVSDK's Python package is not installed")

FLIGHT = [
    task(
        "FlyToPoint",
        {"target_position": [9, 9]},
        [step("FlyToXY", {"x": 9, "y": 9, "altitude": 20}), step("Hover", {"time": 5})],
    )
]


@pytest.fixture(scope="module")
def importer() -> Iterator[Any]:
    from mavsdk.component_type import ComponentType
    from mavsdk.mavsdk import Configuration, Mavsdk
    from mavsdk.plugins.mission_raw import MissionRaw

    station = Mavsdk(Configuration.create_with_component_type(ComponentType.GROUND_STATION))
    station.add_any_connection("raw://")
    vehicle = ardupilotmega.MAVLink(None, srcSystem=1, srcComponent=1)
    heartbeat = vehicle.heartbeat_encode(
        ardupilotmega.MAV_TYPE_SURFACE_BOAT, ardupilotmega.MAV_AUTOPILOT_ARDUPILOTMEGA, 0, 0, 3
    )
    for _beat in range(1000):
        station.pass_received_raw_bytes(heartbeat.pack(vehicle))
        if (found := station.first_autopilot(0.1)) is not None:
            break
    assert found is not None
    yield MissionRaw(found)
    station.destroy()


@pytest.mark.parametrize(
    ("tasks", "vocabulary"),
    [(MAST, USV), (BUOY, USV), (MAST * 125, USV), (FLIGHT, DRONE)],
    ids=["mast", "buoy", "500 tasks", "drone"],
)
def test_mavsdk_imports_both_files_with_the_same_items(
    tasks: list[dict[str, Any]], vocabulary: Any, importer: Any
) -> None:
    plan_export = PlanExport(document(tasks, vocabulary), vocabulary, Origin(-33.9, 151.2))
    text = load_format("qgc").write(plan_export).text
    from_plan = importer.import_qgroundcontrol_mission_from_string(text)
    from_text = importer.import_mission_planner_mission_from_string(
        load_format("waypoints").write(plan_export).text
    )
    # MAVSDK puts home before the items; the text mission brings its own, too.
    read = [_told(item) for item in from_plan.mission_items[1:]]
    assert read == [_told(item) for item in from_text.mission_items[2:]]
    wanted = plan_items(json.loads(text))
    assert [(command, x, y) for command, _first, x, y in read] == [
        (command, round(values[4] * 1e7), round(values[5] * 1e7)) for command, values in wanted
    ]
    assert [first for _command, first, _x, _y in read] == pytest.approx(
        [values[0] for _command, values in wanted], abs=1e-4
    )
    assert len(from_plan.geofence_items) == sum(
        len(polygon["polygon"]) for polygon in json.loads(text)["geoFence"]["polygons"]
    )


def _told(item: Any) -> tuple[int, float, int, int]:
    return item.command, item.param1, item.x, item.y
