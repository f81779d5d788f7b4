"""Places, directions and turns of a text."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import pytest

from planner_ft.facts import WAYPOINT, read
from planner_ft.facts.dictated import dictated_pairs
from planner_ft.facts.geographic import lone_coordinates, read_geographic, without_geographic
from planner_ft.facts.places import read_positions, rows_of, with_brackets, written_positions


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
        ("from 48.123N 7.5E", 48.123, 7.5),
        ("at 48.12 S, 7 W", -48.12, -7),
        ("at 4807.038N 01131.000E", 48.1173, 11.516667),
        ("at 48 07.038 N 011 31.000 W", 48.1173, -11.516667),
        ("at 48-07.038N, 011-31.000W", 48.1173, -11.516667),
        ("at 54 19.3'N, 010 08.5'E", 54.32167, 10.14167),
        ("at Lat 54.3217 N Long 10.1412 E", 54.3217, 10.1412),
        ("at 54 degrees 19.3 north 10 degrees 8.5 east", 54.32167, 10.14167),
        ("at 4807.038,S,01131.000,W", -48.1173, -11.516667),
        ("at 50 degrees 9.06 minutes north, 5 degrees 3.48 minutes west", 50.151, -5.058),
        ("at 54 deg 19 min 21 sec N, 10 deg 8 min 42 sec E", 54.3225, 10.145),
        ("at 50.15 degrees north and 5.06 degrees west", 50.15, -5.06),
        ("to 541921N0100842E", 54.3225, 10.145),
        ("to +54.3225-010.1450/", 54.3225, -10.145),
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
    text = "Go to [-40, 12], then 120 east 45 south of home; at 80 by 50."
    found = {(place.x, place.y): place for place in read(text).positions}
    assert [
        (text[place.start : place.end], place.certain)
        for place in (found[-40, 12], found[120, -45], found[80, 50])
    ] == [("-40, 12", True), ("120 east 45 south", True), ("80 by 50", False)]


def test_a_coordinate_without_a_partner_leaves_positions_open() -> None:
    text = "go to x 40 and somewhere up there, 20 on"
    assert set(read(text).loose) == {40, 20}
    assert stated(text, [40, 20]) and not stated(text, [41, 20])


def rows(table: str) -> list[tuple[str, str]]:
    """(text, what is read of it) of the lines of a table."""
    lines = (line.partition("=>") for line in table.strip().splitlines())
    return [(text.strip(), found.strip()) for text, _, found in lines]


def written(text: str, found: Iterable[Any], *names: str) -> str:
    """What was read as the tables have it: values, <words>, and ! where it is certain."""
    parts = []
    for one in found:
        values = (getattr(one, name) for name in names)
        said = ",".join("?" if value is None else f"{value:.7g}" for value in values)
        mark = "!" if getattr(one, "certain", False) else ""
        parts.append(f"{said} <{text[one.start : one.end]}>{mark}")
    return "; ".join(parts)


POSITIONS = """
    [40, 12] => 40,12 <40, 12>!
    (40, 12) => 40,12 <40, 12>!
    [40 12] => 40,12 <40 12>!
    x=40 y=12 => 40,12 <40 y=12>!
    x: 40, y: -12 => 40,-12 <40, y: -12>!
    y 12 x 40 => 12,40 <12 x 40>; 40,12 <12 x 40>
    y=12, x=40 => 12,40 <12, x=40>; 40,12 <12, x=40>
    at 40, 12 => 40,12 <40, 12>!
    at 40,12 m => 40,12 <40,12 m>
    near 40 12 => 40,12 <40 12>!
    40, 12 => 40,12 <40, 12>
    at 40 by 12 => 40,12 <40 by 12>
    to 40 m by 12 m => 40,12 <40 m by 12 m>
    60 x 40 around the tower at 90,20 => 90,20 <90,20>!
    40 and 12 => 40,12 <40 and 12>
    40 comma 12 => 40,12 <40 comma 12>
    40/12 => 40,12 <40/12>
    40 east 12 north => 40,12 <40 east 12 north>!
    40 m east 12 m north => 40,12 <40 m east 12 m north>
    40 metres to the east, 12 to the north of home => 40,12 <40 metres to the east, 12 to the north>
    40 west, 12 south => -40,-12 <40 west, 12 south>!
    40 south 12 east => 12,-40 <40 south 12 east>!
    south 40, east 12 => 12,-40 <south 40, east 12>!
    east 40 north 12 => 40,12 <east 40 north 12>!
    north 40 east 12 => 12,40 <north 40 east 12>!
    easting 40 northing 12 => 40,12 <easting 40 northing 12>!
    40E 12N => 40,12 <40E 12>
    W40 S12 => -40,-12 <W40 S12>!
    E12 N48, 100 m => 12,48 <E12 N48>!
    E1200 N0 => 1200,0 <E1200 N0>!
    E60 N-25 => 60,-25 <E60 N-25>!
    at 65 east 30 north: forty metres of it => 65,30 <65 east 30 north>!
    at minus twenty, minus five => -20,-5 <minus twenty, minus five>!
    at twenty, thirty metres => 20,30 <twenty, thirty metres>
    40, 40 due east => 40,40 <40, 40>
    120 east 45 north => 120,45 <120 east 45 north>!
    from 22/98 westwards => 22,98 <22/98>; -98,22 <22/98>
    from 22/98 westwards to 30/98 => 22,98 <22/98>; -98,22 <22/98>; 30,98 <30/98>
    40 then 12 =>
    40 buoys 12 =>
    from home 40 12 m => 40,12 <40 12 m>
    40 from home 12 => 40,12 <40 from home 12>
    at 16:00 go 5 =>
    between 08:15 and 9 =>
    at 24:10, 5 =>
    at 23:59 =>
    [1, 2] and [3, 4] => 1,2 <1, 2>!; 3,4 <3, 4>!
    [1, 2] to [3, 4] or [5, 6] => 1,2 <1, 2>!; 3,4 <3, 4>!; 5,6 <5, 6>!
    10,20 30,40 => 10,20 <10,20>; 20,30 <20 30>; 30,40 <30,40>
    10/20 and 30/40 => 10,20 <10/20>; 30,40 <30/40>
    corners in km: [1, 2]. Then [3, 4]. => 1,2 <1, 2>!; 3,4 <3, 4>!; 1000,2000 <1, 2>!
    Go. Corners, in feet: [10, 20]. At [5, 6]. => 10,20 <10, 20>!; 5,6 <5, 6>!; 3.05,6.1 <10, 20>!
    The positions are in yards. [1, 2] => 1,2 <1, 2>!
    all in km [1, 2] => 1,2 <1, 2>!; 1000,2000 <1, 2>!
    in km wading [1, 2] => 1,2 <1, 2>!
    y 40 and x 30 => 40,30 <40 and x 30>; 30,40 <40 and x 30>
    x equals 110 and y equals minus 45 => 110,-45 <110 and y equals minus 45>!
    at 96 / 28 => 96,28 <96 / 28>!
    at 24;56 => 24,56 <24;56>!
    at 1/2 =>
"""


@pytest.mark.parametrize(("text", "found"), rows(POSITIONS))
def test_positions(text: str, found: str) -> None:
    assert written(text, read(text).positions, "x", "y") == found


GEOGRAPHIC = """
    54.3217 N 10.1412 E => 54.3217,10.1412 <54.3217 N 10.1412 E>
    54.3217, -10.1412 => 54.3217,-10.1412 <54.3217, -10.1412>
    54.321, 10.141 =>
    54.32 N 10.14 E => 54.32,10.14 <54.32 N 10.14 E>
    54.3 N 10.1 E => 54.3,10.1 <54.3 N 10.1 E>
    54 N 10 E =>
    54.3 N and 12 m E =>
    54.32 north 10.14 east => 54.32,10.14 <54.32 north 10.14 east>
    N 54.32 E 10.14 => 54.32,10.14 <N 54.32 E 10.14>
    N 36 07.820 W 005 21.310 => 36.13033,-5.355167 <N 36 07.820 W 005 21.310>
    36º 31' 55,2'' N; 6º 17' 10,5'' W => 36.532,-6.28625 <36º 31' 55,2'' N; 6º 17' 10,5'' W>
    54,3208° North, 10,1421° East => 54.3208,10.1421 <54,3208° North, 10,1421° East>
    40,20° to port =>
    36-07-30N 005-21-15W => 36.125,-5.354167 <36-07-30N 005-21-15W>
    33 51 30 S, 151 12 36 E => -33.85833,151.21 <33 51 30 S, 151 12 36 E>
    54,1815 Nord 7,8921 Ost => 54.1815,7.8921 <54,1815 Nord 7,8921 Ost>
    40,1200 60,1300 =>
    54°19'18"N 10°08'30"E => 54.32167,10.14167 <54°19'18"N 10°08'30"E>
    54° 19.3' N, 10° 8.5' W => 54.32167,-10.14167 <54° 19.3' N, 10° 8.5' W>
    54° N 10° E => 54,10 <54° N 10° E>
    54° 10° =>
    lat 54 lon 10 => 54,10 <lat 54 lon 10>
    latitude: 54, longitude: -10 => 54,-10 <latitude: 54, longitude: -10>
    lon 10 lat 54 => 54,10 <lon 10 lat 54>
    lat/long 50.3601 / -4.1432 => 50.3601,-4.1432 <lat/long 50.3601 / -4.1432>
    latitude and longitude: 54.25 10.5 => 54.25,10.5 <latitude and longitude: 54.25 10.5>
    lng 10 lat 54 => 54,10 <lng 10 lat 54>
    54.3217 S =>
    54°19' N => 54.31667,? <54°19' N>
    54°19' N then 5 => 54.31667,? <54°19' N>
    54.3217 N and 10.1412 E by 5 => 54.3217,10.1412 <54.3217 N and 10.1412 E>
    54.3217 N over 10.1412 E =>
    54.32171,10.1412 5.4217,1.2412 => 54.32171,10.1412 <54.32171,10.1412>; 5.4217,1.2412 <5.4217,1.2412>
    1234.56789, 5.12345 =>
"""


@pytest.mark.parametrize(("text", "found"), rows(GEOGRAPHIC))
def test_geographic_positions(text: str, found: str) -> None:
    assert written(text, read(text).geographic, "latitude", "longitude") == found


BEARINGS = """
    head north => 0 <north>
    northwest => 315 <northwest>
    north-west by west => 315 <north-west>; 270 <west>
    southerly wind, go eastwards => 180 <southerly>; 90 <eastwards>
    the north-facing wall =>
    north-bound => 0 <north-bound>
    NNW => 337.5 <NNW>
    n =>
    ne => 45 <ne>
    it is ne of here => 45 <ne>
    turn SE => 135 <SE>
    North 5 => 0 <North>
    Newton =>
    head north-west => 315 <north-west>
    nor'-east, then sou'west => 45 <nor'-east>; 225 <sou'west>
    head northwest, then SSE => 315 <northwest>; 157.5 <SSE>
    lanes north south => 0 <north>; 180 <south>
    south-bound, east-north-east => 180 <south-bound>; 67.5 <east-north-east>
"""


@pytest.mark.parametrize(("text", "found"), rows(BEARINGS))
def test_bearings(text: str, found: str) -> None:
    assert written(text, read(text).bearings, "value") == found


TURNS = """
    once round => 360 <once>
    half way round => 180 <half>
    all the way round => 360 <all the way round>
    all the way =>
    full circle twice => 360 <full>; 720 <twice>
    half a circle => 180 <half>
    three quarters of a turn => 270 <three quarters>
    2 laps => 720 <2 laps>
    two counter-clockwise laps => 720 <two counter-clockwise laps>
    one clockwise turn => 360 <one clockwise turn>
    3 left hand rounds => 1080 <3 left hand rounds>
    3 times => 1080 <3 times>
    1.5 circles => 540 <1.5 circles>
    1.5 => 540 <1.5>
    0.75 => 270 <0.75>
    2/3 => 240 <2/3>
    2 thirds =>
    5 of the circle => 1800 <5>
    a quarter of the way about => 90 <quarter>
    twice round => 720 <twice>
    2x round => 720 <2x>
    a lap at half a knot => 360 <lap>
    two full orbits => 360 <full>; 720 <two full orbits>
    two thirds of a circle => 240 <two thirds>
"""


@pytest.mark.parametrize(("text", "found"), rows(TURNS))
def test_turns(text: str, found: str) -> None:
    assert written(text, read(text).turns, "value") == found


@pytest.mark.parametrize(
    ("text", "loose"),
    [
        ("x 40, thence on by 5 m for 8 s", (40, 5)),
        ("x is 40", (40,)),
        ("the grid x2", ()),
        ("at 40 m east of home", ()),
        ("400 feet due east of home", ()),
        ("40 m east, then go 20 m north", (40, 20)),
        ("60 x 40 around it", ()),
        ("40 north of home", (40,)),
        ("North 5, then hold 8 s", (5,)),
        ("the northing is -5", (-5,)),
        ("coordinates: 5", (5,)),
        ("x 40 y 5", ()),
        ("40 metres north of it", ()),
        ("40 m north face", ()),
        ("40 north side", ()),
        ("20 s north", ()),
        ("go north. 5 buoys", ()),
    ],
)
def test_numbers_of_a_coordinate_without_a_partner(text: str, loose: tuple[float, ...]) -> None:
    assert read(text).loose == loose


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("[1, 2] and [3, 4]", ["1,2 3,4"]),
        ("[1, 2], (3, 4); then [5, 6].", ["1,2 3,4 5,6"]),
        ("[1, 2] to [3, 4] or [5, 6]", ["1,2 3,4", "5,6"]),
        ("from [1, 2] over to [3, 4]", ["1,2", "3,4"]),
        ("10,20 30,40", ["10,20 30,40"]),
        ("10/20 and 30/40", ["10,20 30,40"]),
        ("40,12 m and 5 by 6", []),
        ("5, 12 then at 30, 40", ["5,12", "30,40"]),
    ],
)
def test_rows_of_positions(text: str, found: list[str]) -> None:
    rows = rows_of(text, written_positions(text))
    assert [" ".join(f"{one.x:g},{one.y:g}" for one in row) for row in rows] == found


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
        ("go to 4807.038 , N", []),
        ("stay north of 4807.038,N", ["4807.038,N"]),
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


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("mow E12 N48, 100 m", "mow [12, 48], 100 m"),
        ("to one fifty zero, then to one fifty one hundred", "to [150, 0], then to [150, 100]"),
        ("at sixty ten seventy five by forty", "at [60, 10] seventy five by forty"),
        ("be at easting 72, northing 36 by ten", "be at [72, 36] by ten"),
        ("x=-4, y=9 then (3, 4)", "[-4, 9] then (3, 4)"),
        ("go to x equals minus 4 and y equals 9", "go to [-4, 9]"),
        ("Patrol 2;-3, 4;5 twice", "Patrol [2, -3], [4, 5] twice"),
        ("easting 571240.5, northing 6020310", "[571240.5, 6020310]"),
        ("start at 96 / 28, ten metres", "start at [96, 28], ten metres"),
        ("pile (96 | -28), then at 9 | 8", "pile (96, -28), then at [9, 8]"),
        # A comma alone, directions behind it, degrees and what is in brackets stay.
        ("First N50.1502 W5.0631, then E3 N4.", "First N50.1502 W5.0631, then [3, 4]."),
        ("Go to 4, 9, no, 5, 9.", "Go to 4, 9, no, 5, 9."),
        ("from 22, 98 westwards", "from 22, 98 westwards"),
        ("12 east and 9 south of the buoy", "12 east and 9 south of the buoy"),
        ("y=9 x=4", "y=9 x=4"),
        ("at [4, 9]", "at [4, 9]"),
        ("a grid of 40 by 60", "a grid of 40 by 60"),
    ],
)
def test_certain_positions_are_told_in_brackets(text: str, told: str) -> None:
    assert with_brackets(text) == told


def test_the_number_of_a_thing_is_no_coordinate_of_what_stands_behind_it() -> None:
    assert [(one.x, one.y) for one in read_positions("Net pen 3, 55/70.")] == [(55, 70)]
    assert len(read_positions("Net pen 3, 5/7.")) == 2


def test_coordinates_behind_at_or_to_are_no_other_numbers() -> None:
    known = read("Go to 75, 150 for ten minutes.")
    assert {one.value for one in known.numbers("s")} == {600}
    assert {one.value for one in read("Survey at 12, 18 and 25 m.").numbers("m")} == {12, 18, 25}


@pytest.mark.parametrize(
    ("text", "place"),
    [
        ("hold at fifty fifty", (50, 50)),
        ("go to seventy twenty and film it", (70, 20)),
        ("to seven five plus thirty", (75, 30)),
        ("to one hundred twenty comma sixty", (120, 60)),
        ("at one fifty comma minus one ten", (150, -110)),
    ],
)
def test_dictated_positions_behind_at_or_to_are_certain(text: str, place: tuple[int, int]) -> None:
    assert [(one.x, one.y) for one in read_positions(text) if one.certain] == [place]
    assert not any(one.certain for one in read_positions(f"{text[:4]} twenty five"))


@pytest.mark.parametrize(
    ("text", "latitude", "longitude"),
    [
        (
            "to fifty three decimal four one one two north three decimal zero one eight one west. Stay",
            53.4112,
            -3.0181,
        ),
        (
            "Go to fifty-seven degrees eight decimal four minutes north, two degrees four decimal two "
            "minutes west, and wait",
            57.14,
            -2.07,
        ),
    ],
)
def test_dictated_degrees_are_geographic(text: str, latitude: float, longitude: float) -> None:
    (place,) = read(text).geographic
    assert (place.latitude, place.longitude) == pytest.approx((latitude, longitude), abs=1e-5)
    assert text[place.start : place.end].startswith("fifty")
    assert text[place.start : place.end].endswith("west")
    assert read(text).positions == ()


def test_two_decimals_with_both_sides_are_degrees() -> None:
    said = "go to fifty five point three two north ten point one four east and hold"
    (place,) = read(said).geographic
    assert (place.latitude, place.longitude) == (55.32, 10.14)
    assert read("go 12.50 east 43.25 north and hold").geographic == ()


def test_three_decimals_with_a_side_are_degrees() -> None:
    (place,) = read("go to 43.102 south 147.203 east and hold").geographic
    assert (place.latitude, place.longitude) == (-43.102, 147.203)
    assert read("go 43.10 south 147.20 east of it").geographic == ()


@pytest.mark.parametrize(
    ("text", "latitude", "longitude"),
    [
        ("in UTM, zone 32U: easting 571240, northing 6020310. Go there", 54.3257, 10.0954),
        ("UTM zone 32, E 573210 N 6021100. Go there", 54.3325, 10.1259),
        ("starts at 32V 581200 6398400.", 57.7204, 10.3632),
        ("to 33S 500000 6250000", -33.8904, 15.0),
        ("to 32U E 571 240, N 6 020 310", 54.3257, 10.0954),
    ],
)
def test_utm_coordinates_are_geographic(text: str, latitude: float, longitude: float) -> None:
    (place,) = read_geographic(text)
    assert place.latitude == pytest.approx(latitude, abs=1e-4)
    assert place.longitude == pytest.approx(longitude, abs=1e-4)
    assert not read_positions(without_geographic(text))


def test_utm_coordinates_without_a_zone_are_no_metres() -> None:
    (place,) = read("the wreck, UTM: E 412 345, N 6 178 901. Go there").geographic
    assert (place.latitude, place.longitude) == (None, None)
    assert read("the wreck, UTM: E 412 345, N 6 178 901.").positions == ()


def test_dictated_metres_are_not_geographic() -> None:
    for text in ("one point five north two point five east", "forty five degrees north of it"):
        assert read(text).geographic == ()


@pytest.mark.parametrize(
    ("text", "place"),
    [
        ("along the wall at one ten minus fifty", (110, -50)),
        ("at one thirty ninety at fifteen metres", (130, 90)),
        ("to one fifty one hundred and hold", (150, 100)),
        ("at two hundred one fifty forty metres off", (200, 150)),
        ("at one fifty one fifty please", (150, 150)),
        ("take one at ten fifty and a third one behind it", (10, 50)),
        ("at sixty ten seventy five by forty", (60, 10)),
        ("at twenty five sixty eighty metres long", (25, 60)),
        ("at minus eighty five ten scan it", (-85, 10)),
        ("to eight zero eight zero", (80, 80)),
        ("to six five comma two five ten minutes", (65, 25)),
        ("centred at one twenty sixty lanes every five metres", (120, 60)),
        ("two piers: one at forty comma sixty one at the end", (40, 60)),
        ("at one hundred comma thirty two times", (100, 30)),
        ("at one ten comma minus sixty fifteen no sorry fifty metres", (110, -60)),
        ("to two hundred zero and hold", (200, 0)),
        ("at eighty eight comma fourteen one hundred and ten metres along", (88, 14)),
        ("at seventy seven comma thirty one starboard side", (77, 31)),
        ("at minus twenty comma one hundred and six that's all", (-20, 106)),
        ("to two hundred and fifty comma one hundred and ten", (250, 110)),
        ("dock at five five please", (5, 5)),
        ("down to x one eighty y forty ten metres off", (180, 40)),
        ("visit one hundred comma fifty", (100, 50)),
        ("the schooner at 85,40 - a minute and a half", (85, 40)),
        ("visit x = 42,5 ; y = -18,25", (42.5, -18.25)),
        ("head for ninety zero hold there two minutes", (90, 0)),
        ("to fifty comma one twenty four times", (50, 120)),
        ("at minus fifty comma seventy one full circle", (-50, 70)),
    ],
)
def test_dictated_coordinates_are_those_of_one_place(text: str, place: tuple[int, int]) -> None:
    known = read_positions(text)
    assert [(one.x, one.y) for one in known if one.certain] == [place]
    first = text.index(" at ") + 4 if " at " in text else 3
    assert all((one.x, one.y) == place for one in known if abs(one.start - first) < 2)


@pytest.mark.parametrize(
    "text",
    [
        "turn to one hundred ninety",
        "at seventy minus twenty eight sectors",
        "dock at five five metres off",
        "to niner zero, minus two five, break",
        "at ten comma twenty times",
        "ten comma five thirty comma twenty metres",
    ],
)
def test_words_that_can_be_split_in_several_ways_are_no_certain_place(text: str) -> None:
    assert not dictated_pairs(text)


def test_rows_of_dictated_coordinates_are_places() -> None:
    said = "each ten comma fifty minus thirty comma one twenty fifty comma fifty and five comma ten"
    places = [(10, 50), (-30, 120), (50, 50), (5, 10)]
    assert [pair[:2] for pair in dictated_pairs(said)] == places
    assert with_brackets(said) == "each [10, 50] [-30, 120] [50, 50] and [5, 10]"
    assert {(one.x, one.y) for one in read_positions(said)} == {*places}


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("first twenty ten then forty ten and hold", "first [20, 10] then [40, 10] and hold"),
        ("go to ten thirty then one hundred thirty", "go to [10, 30] then [100, 30]"),
        ("corners twenty ten, eighty ten, then up", "corners [20, 10], [80, 10], then up"),
        ("by thirty zero then minus thirty forty", "by [30, 0] then [-30, 40]"),
        ("corners zero zero sixty zero and ten forty", "corners [0, 0] [60, 0] and [10, 40]"),
        ("a ten and twenty five metre hold", "a ten and twenty five metre hold"),
        ("wait twenty five and thirty five", "wait twenty five and thirty five"),
        ("zero nine zero then one eight zero", "zero nine zero then one eight zero"),
        ("one fifty and two twenty then six ten", "one fifty and two twenty then six ten"),
        ("one hundred ten then two hundred ten", "one hundred ten then two hundred ten"),
    ],
)
def test_dictated_pairs_in_a_row_are_places(text: str, told: str) -> None:
    assert with_brackets(text) == told


def test_dictated_coordinates_are_no_other_numbers() -> None:
    said = read("Go round the buoy at one ten eighty fifty metres off.")
    assert {one.value for one in said.numbers("m")} == {50}


def test_a_time_is_no_coordinate() -> None:
    said = read("A 20,20 B 60,60, two minutes at each").positions
    assert {(one.x, one.y) for one in said} == {(20, 20), (60, 60)}


NOTATIONS = [
    *("85,40", "[85, 40]", "(85,40)", "85/40", "x 85 y 40", "x=85, y=40", "x of 85 and y of 40"),
    *("85 east 40 north", "E85 N40", "85 m east and 40 m north", "+85,+40"),
    *("eighty five forty", "eighty five comma forty", "x eighty five y forty"),
]
BEHIND = [
    *(".", " for two minutes", " - a minute and a half", " - two minutes", ", 90 s", " twice"),
    *(" a minute", " an hour", " one minute", " five minutes", " one lap", " two laps at 12 m"),
    *(" half a knot", " at 2 knots", " 10 m off", ", radius 15", " 60x40", " heading 090"),
    *(" then home", "; hold 60", " 3 times", ", 4 sectors", " -> 120,60", " – hold 2 min"),
]


@pytest.mark.parametrize("written", NOTATIONS)
@pytest.mark.parametrize("before", ["go to ", "hold at ", "visit ", "@ ", "the buoy at "])
def test_a_position_is_read_whatever_stands_behind_it(before: str, written: str) -> None:
    texts = [before + written + behind for behind in BEHIND]
    # "An hour" behind a measure can be a speed.
    texts = [one for one in texts if "m north an" not in one and "m north a " not in one]
    lost = [one for one in texts if (85, 40) not in {(at.x, at.y) for at in read_positions(one)}]
    assert not lost


@pytest.mark.parametrize("text", ["go to - 85, - 40", "pos - 85 / - 40 a minute", "to −85, −40"])
def test_a_sign_with_a_blank_behind_it_is_a_sign(text: str) -> None:
    assert [(at.x, at.y) for at in read_positions(text)] == [(-85, -40)]
