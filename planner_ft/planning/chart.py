"""Named places and an area from GeoJSON files, in local metres."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

from planner_ft.planning.locations import Position
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_json
from planner_ft.support.geodesy import Origin

LOCAL = "local metres"
"""What "frame" says in a file whose coordinates are [x, y] in local metres."""


def read_places(path: Path, origin: Origin | None) -> dict[str, Position]:
    """The points of a GeoJSON file by their property "name". Raises PlannerError."""
    flag, places = f"--locate-file {path}", dict[str, Position]()
    content = _content(path, flag)
    local = _converter(content, origin, flag)
    for number, feature in enumerate(_features(content), start=1):
        geometry, name = (
            feature.get("geometry") or {},
            (feature.get("properties") or {}).get("name"),
        )
        if geometry.get("type") != "Point":
            continue
        if not isinstance(name, str) or not name.strip():
            raise PlannerError(f'{flag}: point {number} has no "name" among its properties')
        position = local(geometry.get("coordinates"))
        if places.setdefault(name.strip(), position) != position:
            raise PlannerError(f'{flag}: two points are named "{name}"; rename one of them')
    if not places:
        raise PlannerError(
            f'{flag}: has no points; a feature with a "Point" and a "name" is needed'
        )
    return places


def read_area(path: Path, origin: Origin | None) -> list[Position]:
    """The corners of the one polygon of a GeoJSON file. Raises PlannerError."""
    flag = f"--area {path}"
    content = _content(path, flag)
    local = _converter(content, origin, flag)
    shapes = [feature.get("geometry") or {} for feature in _features(content)]
    rings = [shape.get("coordinates") for shape in shapes if shape.get("type") == "Polygon"]
    if len(rings) != 1 or not isinstance(rings[0], list) or len(rings[0]) != 1:
        raise PlannerError(f"{flag}: must have one polygon without holes, and has {len(rings)}")
    corners = [local(corner) for corner in rings[0][0]]
    return corners[:-1] if corners[0] == corners[-1] else corners


def _content(path: Path, flag: str) -> dict[str, Any]:
    if not path.is_file():
        raise PlannerError(f"{flag}: no such file")
    value = read_json(path)
    if not isinstance(value, dict) or value.get("type") not in ("FeatureCollection", "Feature"):
        raise PlannerError(f"{flag}: is no GeoJSON FeatureCollection")
    return value


def _features(content: dict[str, Any]) -> Iterator[dict[str, Any]]:
    found = content.get("features") if content["type"] == "FeatureCollection" else [content]
    yield from (item for item in found or () if isinstance(item, dict))


def _converter(
    content: dict[str, Any], origin: Origin | None, flag: str
) -> Callable[[Any], Position]:
    """From a coordinate of the file to local metres."""
    in_metres = content.get("frame") == LOCAL
    if not in_metres and origin is None:
        ways = f'give --origin LAT,LON, or "frame": "{LOCAL}" in the file where they are metres'
        raise PlannerError(f"{flag}: has longitudes and latitudes; {ways}")

    def local(coordinate: Any) -> Position:
        pair = coordinate[:2] if isinstance(coordinate, list) else []
        numbers = [item for item in pair if type(item) in (int, float) and math.isfinite(item)]
        if len(numbers) != 2:
            raise PlannerError(f"{flag}: {str(coordinate)[:60]} is no coordinate [x, y]")
        first, second = map(float, numbers)
        if in_metres or origin is None:
            return first, second
        if abs(first) > 180 or abs(second) > 90:
            problem = "is no [longitude, latitude] in degrees"
            raise PlannerError(f"{flag}: {str(coordinate)[:60]} {problem}")
        x, y = origin.to_local(second, first)
        return round(x, 2), round(y, 2)

    return local
