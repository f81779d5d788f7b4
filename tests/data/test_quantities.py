"""Numbers, units, coordinates and bearings as people say them."""

from __future__ import annotations

import pytest

from planner_ft.data.quantities import bearings, positions, quantities, turns
from planner_ft.data.stated import states_number, states_position


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("four minutes", [(240, "s")]),
        ("a kilometre", [(1000, "m")]),
        ("for a minute and a half", [(90, "s")]),
        ("two and a half minutes", [(150, "s")]),
        ("half an hour", [(1800, "s")]),
        ("three quarters of an hour", [(2700, "s")]),
        ("one point two kilometres", [(1200, "m")]),
        ("one decimal five kilometres", [(1500, "m")]),
        ("two hundred and fifty metres", [(250, "m")]),
        ("heading one two zero", [(120, None)]),
        ("half a metre per second", [(0.5, "m/s")]),
        ("a reading every minute", [(60, "s")]),
        ("a ten-minute drift", [(600, "s")]),
        ("20 minuets", [(1200, "s")]),
        ("1,200 m", [(1200, "m")]),
        ("[1,200]", [(1, None), (200, None)]),
        ("100 by 60", [(100, None), (60, None)]),
        ("100 by 50 yards", [(91.44, "m"), (45.72, "m")]),
        ("niner zero, minus two five", [(90, None), (-25, None)]),
        ("lanes one zero metres apart", [(10, "m")]),
        ("3m30s", [(210, "s")]),
        ("9 minutes and half an hour", [(540, "s"), (1800, "s")]),
        ("two five-minute holds", [(2, None), (300, "s")]),
        ("2/3 of it", [(2 / 3, None)]),
        ("5/5 and 5/35", [(5, None), (5, None), (5, None), (35, None)]),
        (".5 m/s", [(0.5, "m/s")]),
        ("two metres a second", [(2, "m/s")]),
        ("18 km/h", [(5, "m/s")]),
        ("a full hour", [(3600, "s")]),
        ("three-quarter circle", [(0.75, None)]),
        ("one thousand six hundred and seventy-four metres", [(1674, "m")]),
        ("quarter of an horu", [(900, "s")]),
        ("one n a half hours", [(5400, "s")]),
        ("every mnute", [(60, "s")]),
        ("5 knots", [(5 * 1852 / 3600, "m/s")]),
        ("forty five, 20 percent", [(45, None), (20, "%")]),
        ("face 297 - record the radar", [(297, None)]),
        ("a minute and three quarters", [(105, "s")]),
        ("one and three quarter hours", [(6300, "s")]),
        ("two hours and two thirds", [(9600, "s")]),
        ("1 3/4 minutes", [(105, "s")]),
        ("a minute and three quarters of a turn", [(60, "s"), (0.75, None)]),
        ("a minute and three quarter turns", [(60, "s"), (0.75, None)]),
        ("50 inches", [(1.27, "m")]),
        ("nothing to see", []),
    ],
)
def test_numbers_are_read_with_their_unit(text: str, said: list[tuple[float, str | None]]) -> None:
    found = [(quantity.value, quantity.unit) for quantity in quantities(text)]
    assert [unit for _, unit in found[: len(said)]] == [unit for _, unit in said]
    assert [value for value, _ in found[: len(said)]] == pytest.approx([value for value, _ in said])


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
    assert states_position(text, [45, -12])
    assert not states_position(text, [45, 12])
    assert not states_position(text, [45, -11])


def test_numbers_of_two_places_make_no_third() -> None:
    assert not states_position("from [10, 20] to [30, 40]", [10, 40])
    assert [(x, y) for x, y, _start, _end in positions("from [10, 20] over to [30, 40]")] == [
        (10, 20),
        (30, 40),
    ]


def test_a_number_with_another_unit_does_not_count() -> None:
    assert states_number("hold for eight minutes", 480, "s")
    assert not states_number("hold for eight minutes", 8, "s")
    assert not states_number("hold for eight minutes", 8, "m")
    assert states_number("2 minutes and 30 seconds", 150, "s")
    assert states_number("5 minutes 30", 330, "s")
    assert states_number("2 h 30", 9000, "s")


def test_bearings_and_turns() -> None:
    assert bearings("head north-west") == {315}
    assert bearings("head northwest, then SSE") == {315, 157.5}
    assert bearings("Newton") == frozenset()
    assert states_number("towards the south-west", 225, "deg")
    assert {180.0} == turns("half a circle")
    assert 270.0 in turns("three quarters of a circle")
    assert 720.0 in turns("two full orbits") or 720.0 in turns("twice round")
    assert not states_number("circle the buoy", 360, "deg")
    assert states_number("once round the buoy", 360, "deg")
