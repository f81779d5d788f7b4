"""Places, directions and turns of a text."""

from __future__ import annotations

import pytest

from planner_ft.facts import WAYPOINT, read
from planner_ft.facts.places import lone_coordinates, read_positions


def stated(text: str, position: list[float]) -> bool:
    return read(text).evidence(position, WAYPOINT).kind == "stated"


FORMS = (
    *(
        "[45.0, -12]",
        "(45, -12)",
        "x=45 y=-12",
        "x 45 y -12",
        "X45 Y-12",
        "y -12 x 45",
        "at 45, -12.",
    ),
    *("45 minus 12", "forty five comma minus twelve", "45 east 12 south", "45E 12S"),
)


@pytest.mark.parametrize("text", FORMS)
def test_coordinates_are_read_in_many_forms(text: str) -> None:
    assert stated(text, [45, -12])
    assert not stated(text, [45, 12])
    assert not stated(text, [45, -11])


def test_numbers_of_two_places_make_no_third() -> None:
    assert not stated("from [10, 20] to [30, 40]", [10, 40])
    assert [(place.x, place.y) for place in read_positions("from [10, 20] over to [30, 40]")] == [
        (10, 20),
        (30, 40),
    ]


@pytest.mark.parametrize(
    ("text", "position"),
    [
        ("the position minus sixty one hundred and eighty", [-60, 180]),
        ("at position seventy one hundred and eighty seven", [70, 187]),
        ("x minus seven hundred and fifty eight y twenty six meters off", [-758, 20]),
        ("120 metres east and 35 metres south of home", [120, -35]),
        ("forty to the east and twelve to the north", [40, 12]),
        ("west 40, south 12", [-40, -12]),
        ("N40 E12", [12, 40]),
        ("33w 15s: drift there", [-33, -15]),
        ("the cable from 227/98 westwards", [227, 98]),
        ("easting 40 northing -12", [40, -12]),
    ],
)
def test_coordinates_are_found_however_they_are_said(text: str, position: list[float]) -> None:
    assert stated(text, position)


def test_numbers_in_a_row_are_no_third_place() -> None:
    assert not stated("from [10, 20] to [30, 40]", [20, 30])
    assert read("inspect the red buoy").positions == ()


@pytest.mark.parametrize(
    ("text", "latitude", "longitude"),
    [
        ("go to 54.3217 N 10.1412 E", 54.3217, 10.1412),
        ("go to 54.3217 N, 10.1412 W and hold", 54.3217, -10.1412),
        ("at 54°19'18\"N 10°08.5'E", 54.32167, 10.14167),
        ("at N 54°19.3' E 10°08.5'", 54.32167, 10.14167),
        ("at 10°08.5'E", None, 10.14167),
        ("54.3217, -10.1412", 54.3217, -10.1412),
        ("[54.3217, 10.1412]", 54.3217, 10.1412),
        ("lat 54.32 lon 10.14", 54.32, 10.14),
        ("longitude 10.14, latitude -54.32", -54.32, 10.14),
        ("at 33.85 S 151.21 E", -33.85, 151.21),
        ("at 4807.038N 01131.000E", 48.1173, 11.516667),
        ("at 4807.038,S,01131.000,W", -48.1173, -11.516667),
    ],
)
def test_geographic_positions_are_degrees_and_nothing_else(
    text: str, latitude: float | None, longitude: float
) -> None:
    (place,) = read(text).geographic
    assert place.latitude == (latitude and pytest.approx(latitude, abs=1e-5))
    assert place.longitude == pytest.approx(longitude, abs=1e-5)
    assert read(text).positions == () and read(text).loose == ()
    assert read(text).numbers("m") == read(text).numbers("deg") == ()


@pytest.mark.parametrize(
    "text",
    ["40 east, 25 north", "120 east 45 north", "40E 25N", "40.5 E, 12 S", "x 54.5 y 10.25",
     "[54.32, 10.14]", "turn to 045°", "60 wide, 90 long, 15 m lanes", "90° north of it"],
)  # fmt: skip
def test_local_positions_and_angles_are_not_geographic(text: str) -> None:
    assert read(text).geographic == ()


def test_positions_know_their_words_and_whether_they_are_certain() -> None:
    text = "Go to [-40, 12], then 120 east 45 south of home; 80 by 50 there."
    found = {(place.x, place.y): place for place in read(text).positions}
    assert [
        (text[place.start : place.end], place.certain)
        for place in (found[-40, 12], found[120, -45], found[80, 50])
    ] == [("-40, 12", True), ("120 east 45 south", True), ("80 by 50", False)]


def test_a_coordinate_without_a_partner_leaves_positions_open() -> None:
    text = "go to x 40 and somewhere up there, 20 on"
    assert set(read(text).loose) == {40, 20}
    assert stated(text, [40, 20]) and not stated(text, [41, 20])


@pytest.mark.parametrize(
    ("text", "angles"),
    [
        ("head north-west", [315]),
        ("head northwest, then SSE", [315, 157.5]),
        ("Newton", []),
        ("lanes north south", [0, 180]),
        ("south-bound, east-north-east", [180, 67.5]),
        ("the north-facing wall", []),
    ],
)
def test_bearings(text: str, angles: list[float]) -> None:
    assert [bearing.value for bearing in read(text).bearings] == angles


@pytest.mark.parametrize(
    ("text", "angle"),
    [("half a circle", 180), ("three quarters of a circle", 270), ("two full orbits", 720),
     ("twice round", 720), ("all the way round", 360), ("a third of the way round", 120),
     ("two thirds of a circle", 240)],
)  # fmt: skip
def test_turns(text: str, angle: float) -> None:
    assert any(turn.value == pytest.approx(angle) for turn in read(text).turns)


def test_degrees_with_minutes_and_seconds_are_read_whole() -> None:
    facts = read("go to 54°19'18\"N 10°08'30\"E")
    (place,) = facts.geographic
    assert (place.latitude, place.longitude) == pytest.approx((54.321667, 10.141667))
    assert facts.unread == () and facts.positions == ()


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("do not go north of 54.3216N, the range begins there", ["54.3216N"]),
        ("stay west of longitude 10.14", ["longitude 10.14"]),
        ("go to 54.3217 N, 10.1412 E", []),
        ("go to 1234.5 then 500 m north", []),
        ("go to 40E, 25N", []),
    ],
)
def test_a_coordinate_with_a_hemisphere_may_stand_alone(text: str, words: list[str]) -> None:
    assert [text[start:end].strip() for start, end in lone_coordinates(text)] == words


def test_a_time_of_day_is_no_position() -> None:
    text = "Do not leave [0, 100]. Be home by 16:00."
    assert [(place.x, place.y) for place in read_positions(text)] == [(0, 100)]


def test_a_latitude_without_a_partner_takes_none_of_the_next_position() -> None:
    (place,) = read("34.12345 then at -33.85678, 151.21534").geographic
    assert (place.latitude, place.longitude) == (-33.85678, 151.21534)


def test_a_unit_of_coordinates_holds_for_its_sentence() -> None:
    text = "Go to [7, 8]. Fence corners, in kilometres: [1, 2] and [3, 4]. Hold at [5, 6]."
    for place in ([7, 8], [1000, 2000], [3000, 4000], [5, 6]):
        assert stated(text, place), place
    for place in ([7000, 8000], [5000, 6000]):
        assert not stated(text, place), place
