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

NEAREST_POLE = 89.0  # degrees of latitude beyond which the local frame's y axis has no useful north


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
            ranges = "a latitude lies between -90 and 90 degrees, a longitude between -180 and 180"
            raise PlannerError(f"{given}: {ranges}{hint}")
        if north > NEAREST_POLE:
            limit = f"latitudes up to {NEAREST_POLE:g} degrees can be used"
            why = "too near a pole, where the local frame has no north"
            raise PlannerError(f"{given}: {why}; {limit}")

    def __str__(self) -> str:
        """The place as people write it: 54.32° N, 10.14° E."""
        north, east = "NS"[self.latitude < 0], "EW"[self.longitude < 0]
        return f"{abs(self.latitude):.7g}° {north}, {abs(self.longitude):.7g}° {east}"

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


def from_utm(zone: int, easting: float, northing: float, *, south: bool) -> tuple[float, float]:
    """(latitude, longitude) in degrees of UTM coordinates in metres on WGS 84."""
    from pyproj import Proj

    longitude, latitude = Proj(proj="utm", zone=zone, south=south)(easting, northing, inverse=True)
    return float(latitude), float(longitude)


def parse_origin(text: str) -> Origin:
    """Read "LAT,LON" in decimal degrees. Raises PlannerError that says what was expected."""
    try:
        latitude, longitude = (float(part) for part in text.split(","))
    except ValueError:
        expected = 'expected "LAT,LON" in decimal degrees, such as 59.9075,10.7231'
        hint = "south and west are negative"
        raise PlannerError(f"--origin {text}: {expected} ({hint})") from None
    return Origin(latitude, longitude)
