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
"""Degrees of latitude beyond which no origin is taken: at a pole there is no north for the local
frame's y axis.
"""


@functools.cache
def _wgs84() -> Geod:
    from pyproj import Geod

    return Geod(ellps="WGS84")


@dataclass(frozen=True)
class Origin:
    """Where the local frame's [0, 0] lies: degrees on WGS 84, latitude positive north, longitude
    positive east.
    """

    latitude: float
    longitude: float

    def __post_init__(self) -> None:
        """Raise PlannerError for degrees out of range and for a place at a pole."""
        said = f"--origin {self.latitude:g},{self.longitude:g}"
        if not (
            math.isfinite(self.latitude)
            and math.isfinite(self.longitude)
            and abs(self.longitude) <= 180
            and abs(self.latitude) <= 90
        ):
            swapped = abs(self.latitude) <= 180 and abs(self.longitude) <= 90
            hint = "; the two may stand in the wrong order: latitude comes first" if swapped else ""
            raise PlannerError(
                f"{said}: a latitude lies between -90 and 90 degrees, a longitude between -180 and"
                f" 180{hint}"
            )
        if abs(self.latitude) > NEAREST_POLE:
            raise PlannerError(
                f"{said}: too near a pole, where the local frame has no north; latitudes up to"
                f" {NEAREST_POLE:g} degrees can be used"
            )

    def to_geographic(self, x: float, y: float) -> tuple[float, float]:
        """(latitude, longitude) in degrees of the place `x` metres east and `y` metres north of the
        origin.
        """
        longitude, latitude, _back = _wgs84().fwd(
            self.longitude, self.latitude, math.degrees(math.atan2(x, y)), math.hypot(x, y)
        )
        return float(latitude), float(longitude)

    def to_local(self, latitude: float, longitude: float) -> tuple[float, float]:
        """(x, y) in metres east and north of the origin. The inverse of `to_geographic`."""
        azimuth, _back, distance = _wgs84().inv(self.longitude, self.latitude, longitude, latitude)
        return distance * math.sin(math.radians(azimuth)), distance * math.cos(
            math.radians(azimuth)
        )


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
