"""Reading export files back, with the readers of others where there are any."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from pymavlink import mavutil, mavwp

from planner_ft.exporters import Origin


def load_waypoints(path: Path) -> list[Any]:
    """The items of a text mission as pymavlink reads them, home first."""
    loader = mavwp.MAVWPLoader()
    loader.load(str(path))
    return [loader.wp(number) for number in range(loader.count())]


def plan_items(plan: dict[str, Any]) -> list[tuple[int, list[float]]]:
    """(command, its seven parameters) of every item of a .plan file, by the rules that
    QGroundControl's and MAVSDK's readers have for it.
    """
    mission, fence, rally = plan["mission"], plan["geoFence"], plan["rallyPoints"]
    assert (
        plan["fileType"],
        plan["version"],
        mission["version"],
        fence["version"],
        rally["version"],
    ) == ("Plan", 1, 2, 2, 2)
    assert isinstance(plan["groundStation"], str) and len(mission["plannedHomePosition"]) == 3
    assert all(
        isinstance(mission[key], int | float)
        for key in (
            "firmwareType",
            "vehicleType",
            "globalPlanAltitudeMode",
            "cruiseSpeed",
            "hoverSpeed",
        )
    )
    assert isinstance(rally["points"], list) and isinstance(fence["circles"], list)
    for polygon in fence["polygons"]:
        assert (polygon["version"], polygon["inclusion"]) == (1, True) and len(
            polygon["polygon"]
        ) >= 3
    for number, item in enumerate(mission["items"], start=1):
        assert (item["type"], item["doJumpId"], item["autoContinue"]) == (
            "SimpleItem",
            number,
            True,
        )
        assert len(item["params"]) == 7 and all(
            isinstance(value, int | float) for value in item["params"]
        )
        assert isinstance(item["command"], int) and item["frame"] in (2, 3)
    return [(item["command"], item["params"]) for item in mission["items"]]


def command(name: str) -> int:
    """The number of a MAV_CMD, from pymavlink."""
    return int(getattr(mavutil.mavlink, f"MAV_CMD_{name}"))


def local_waypoints(
    items: list[tuple[int, list[float]]], origin: Origin
) -> list[tuple[float, float]]:
    return [
        origin.to_local(values[4], values[5])
        for number, values in items
        if number == command("NAV_WAYPOINT")
    ]
