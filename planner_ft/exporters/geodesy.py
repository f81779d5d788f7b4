"""Local metres to latitude and longitude, and back.

The projection is azimuthal equidistant about the origin, computed as geodesics on WGS 84 (PROJ's
`Geod`, Karney 2013, https://doi.org/10.1007/s00190-012-0578-z): a point's distance and bearing from
the origin are exact. The distance between two points that lie 10 km from the origin is off by at
most 4 mm per 10 km (d^2 / 6R^2 of its length, across the line of sight).
"""

from __future__ import annotations

import functools
import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from planner_ft.support.errors import PlannerError

if TYPE_CHECKING:
    from pyproj import Geod

NEAREST_POLE = 89.0
"""Degrees of latitude beyond which there is no useful north for the local frame's y axis."""


@functools.cache
def _wgs84() -> Geod:
    from pyproj import Geod

    return Geod(ellps="WGS84")


@dataclass(frozen=True)
class Origin:
    """Where the local frame's [0, 0] lies: degrees on WGS 84, north and east positive."""

    latitude: float
    longitude: float

    def __post_init__(self) -> None:
        """Raise PlannerError for degrees out of range and for a place at a pole."""
        given = f"--origin {self.latitude:g},{self.longitude:g}"
        north, east = abs(self.latitude), abs(self.longitude)
        if not (north <= 90 and east <= 180):  # also where one is no number
            swapped = north <= 180 and east <= 90
            hint = "; the two may stand in the wrong order: latitude comes first" if swapped else ""
            raise PlannerError(
                f"{given}: a latitude lies between -90 and 90 degrees, a longitude between -180 and"
                f" 180{hint}"
            )
        if north > NEAREST_POLE:
            raise PlannerError(
                f"{given}: too near a pole, where the local frame has no north; latitudes up to"
                f" {NEAREST_POLE:g} degrees can be used"
            )

    def to_geographic(self, x: float, y: float) -> tuple[float, float]:
        """(latitude, longitude) in degrees, `x` metres east and `y` metres north of the origin."""
        azimuth, distance = math.degrees(math.atan2(x, y)), math.hypot(x, y)
        longitude, latitude, _back = _wgs84().fwd(self.longitude, self.latitude, azimuth, distance)
        return float(latitude), float(longitude)

    def to_local(self, latitude: float, longitude: float) -> tuple[float, float]:
        """(x, y) in metres east and north of the origin. The inverse of `to_geographic`."""
        azimuth, _back, distance = _wgs84().inv(self.longitude, self.latitude, longitude, latitude)
        angle = math.radians(azimuth)
        return distance * math.sin(angle), distance * math.cos(angle)


def parse_origin(text: str) -> Origin:
    """Read "LAT,LON" in decimal degrees. Raises PlannerError that says what was expected."""
    try:
        latitude, longitude = (float(part) for part in text.split(","))
    except ValueError:
        raise PlannerError(
            f'--origin {text}: expected "LAT,LON" in decimal degrees, such as 59.9075,10.7231'
            " (south and west are negative)"
        ) from None
    return Origin(latitude, longitude)
