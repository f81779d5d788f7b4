"""Local metres to latitude and longitude and back."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pyproj import Geod, Transformer

from planner_ft.support.errors import PlannerError
from planner_ft.support.geodesy import Origin, parse_origin
from tests.exporters.plans import origins

METRES = st.floats(-1e6, 1e6, allow_nan=False)
GEOD = Geod(ellps="WGS84")


@given(origins(), METRES, METRES)
def test_a_place_returns_to_the_millimetre(origin: Origin, x: float, y: float) -> None:
    assert origin.to_local(*origin.to_geographic(x, y)) == pytest.approx((x, y), abs=1e-3)


@given(origins(), METRES, METRES)
def test_degrees_are_in_range(origin: Origin, x: float, y: float) -> None:
    latitude, longitude = origin.to_geographic(x, y)
    assert -90 <= latitude <= 90 and -180 <= longitude <= 180


@given(st.floats(-80, 80), st.floats(-170, 170), st.floats(-5000, 5000), st.floats(-5000, 5000))
def test_it_is_projs_azimuthal_equidistant_projection(
    latitude: float, longitude: float, x: float, y: float
) -> None:
    projection = Transformer.from_crs(
        "EPSG:4326",
        f"+proj=aeqd +lat_0={latitude!r} +lon_0={longitude!r} +datum=WGS84",
        always_xy=True,
    )
    there_latitude, there_longitude = Origin(latitude, longitude).to_geographic(x, y)
    assert projection.transform(there_longitude, there_latitude) == pytest.approx((x, y), abs=1e-3)


@given(origins(), st.floats(0, 2 * math.pi), st.floats(0, 2 * math.pi))
def test_between_two_places_10_km_away_lengths_are_off_by_millimetres(
    origin: Origin, one: float, other: float
) -> None:
    ends = [(10_000 * math.cos(angle), 10_000 * math.sin(angle)) for angle in (one, other)]
    (south, west), (north, east) = (origin.to_geographic(*end) for end in ends)
    _azimuth, _back, length = GEOD.inv(west, south, east, north)
    assert length == pytest.approx(math.dist(*ends), abs=4e-3)


def test_north_is_up_and_east_is_right() -> None:
    latitude, longitude = Origin(0, 0).to_geographic(0, 110_574.389)
    assert (latitude, longitude) == pytest.approx((1, 0), abs=1e-6)
    latitude, longitude = Origin(0, 0).to_geographic(111_319.491, 0)
    assert (latitude, longitude) == pytest.approx((0, 1), abs=1e-6)


def test_an_origin_is_read() -> None:
    assert parse_origin("-33.9, 151.2") == Origin(-33.9, 151.2)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("59.9", 'expected "LAT,LON"'),
        ("59,9,10,7", 'expected "LAT,LON"'),
        ("north,east", 'expected "LAT,LON"'),
        ("151.2,-33.9", "wrong order"),
        ("nan,10", "between -90 and 90"),
        ("91,200", "between -90 and 90"),
        ("90,0", "pole"),
        ("-89.5,10", "pole"),
    ],
)
def test_an_origin_that_is_none_says_what_was_expected(text: str, said: str) -> None:
    with pytest.raises(PlannerError, match=said) as raised:
        parse_origin(text)
    assert str(raised.value).startswith("--origin ")
