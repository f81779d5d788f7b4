"""What a command can be taken to state, in all the ways in which people write it."""

from __future__ import annotations

import pytest

from planner_ft.data.stated import (
    MOST_REWRITINGS,
    rewritings,
    stated_numbers,
    stated_positions,
    states_number,
    states_position,
)


@pytest.mark.parametrize(
    ("text", "value", "unit"),
    [
        ("hold for hour or so", 3600, "s"),
        ("waiting minute at each", 60, "s"),
        ("for next minute and half", 90, "s"),
        ("holding full minute on each heading", 60, "s"),
        ("two and a half hous adrift", 9000, "s"),
        ("a full hur on video", 3600, "s"),
        ("drift 4 an hour and a half", 5400, "s"),
        ("for a couple of minutes", 120, "s"),
        ("a score of minutes", 1200, "s"),
        ("every 2:30", 150, "s"),
        ("a tenth of an hour on station", 360, "s"),
        ("three tenths of a mile", 555.6, "m"),
        ("a twentieth of a nautical mile", 92.6, "m"),
        ("an eighth of a turn to port", 45, "deg"),
        ("for tree minutes", 180, "s"),
        ("in a wun zero metre circle", 10, "m"),
        ("half a cable off", 92.6, "m"),
        ("heading like one eighty", 180, "deg"),
        ("come to two twenty-five", 225, "deg"),
        ("two cables out", 370.4, "m"),
        ("2:30 hours", 9000, "s"),
        ("1½ hours", 5400, "s"),
        ("for an hour and ten minutes, a reading every five", 300, "s"),
        ("three quartesr of an hour", 2700, "s"),
        ("at 4 m and a half hour of film", 4, "m"),
        ("at 4 m and a half hour of film", 1800, "s"),
        ("500 fewt by 170", 152.4, "m"),
        ("20 yards off", 18.288, "m"),
        ("from 22/0 a kilometre", 1000, "m"),
        ("1,250 out", 1250, "m"),
        ("at one metre second", 1, "m/s"),
        ("at one metre per secodn", 1, "m/s"),
        ("0.2 mrtres per second", 0.2, "m/s"),
        ("a dozen headings", 12, "count"),
        ("half a dozen headings", 6, "count"),
        ("two dozen", 24, "count"),
        ("eight secotrs", 8, "count"),
        ("a quarter overlap", 25, "%"),
        ("fifty per cent", 50, "%"),
        ("go round it onec", 360, "deg"),
        ("one time around", 360, "deg"),
        ("south-bound", 180, "deg"),
        ("the cable, sw, 917 metres", 225, "deg"),
        ("lanes one five metres apart", 15, "m"),
        ("a field of view of three zero degrees", 30, "deg"),
    ],
)
def test_values_are_found_however_they_are_said(text: str, value: float, unit: str) -> None:
    assert states_number(text, value, unit)


@pytest.mark.parametrize(
    ("text", "value", "unit"),
    [
        ("hold for eight minutes", 8, "m"),
        ("seventy-five metres", 5, "m"),
        ("the second buoy", 1, "s"),
        ("45 minus 12", 2700, "s"),
        ("ten metres", 10, "s"),
        ("thirty seconds", 30, "m"),
        ("nothing", 1, "s"),
        ("by the tree, on the fifth leg", 3, "s"),
    ],
)
def test_values_that_nobody_said_are_not_found(text: str, value: float, unit: str) -> None:
    assert not states_number(text, value, unit)


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
    assert states_position(text, position)


def test_numbers_in_a_row_are_no_third_place() -> None:
    assert not states_position("from [10, 20] to [30, 40]", [20, 30])
    assert stated_positions("inspect the red buoy") == ()


def test_rewritings_are_few_and_begin_with_the_text() -> None:
    text = (
        "go to twenty five thirty five forty five fifty five sixty five, wait minute, then hous"
        " two, then 4 an hour, 1,000 and 2:30 " * 20
    )
    assert rewritings(text)[0] == text
    assert len(rewritings(text)) <= MOST_REWRITINGS
    assert rewritings("inspect the red buoy") == ("inspect the red buoy",)
    assert stated_numbers("inspect the red buoy", "m") == frozenset()
