"""Numbers of a text with their units, however they are said."""

from __future__ import annotations

import pytest

from planner_ft.facts import WAYPOINT, read
from planner_ft.facts.numbers import in_unit, read_numbers
from planner_ft.vocabulary import Parameter


def states(text: str, value: float, unit: str | None) -> str:
    return read(text).evidence(value, Parameter("it", "number", unit)).kind


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
        ("20*20 m", [(20.0, "m"), (20.0, "m")]),
        ("100x60x20 ft", [(30.48, "m"), (18.288, "m"), (6.096, "m")]),
        ("niner zero, minus two five", [(90, None), (-25, None)]),
        ("lanes one zero metres apart", [(10, "m")]),
        ("3m30s", [(210, "s")]),
        ("9 minutes and half an hour", [(540, "s"), (1800, "s")]),
        ("two five-minute holds", [(2, None), (300, "s")]),
        ("hold two-five minutes", [(1500, "s")]),
        ("hold two-three minutes", [(2, None), (180, "s")]),
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
        ("10 mph", [(4.4704, "m/s")]),
        ("2 m s-1", [(2, "m/s")]),
        ("forty five, 20 percent", [(45, None), (20, "%")]),
        ("20 per cent of 40 m", [(20, "%"), (40, "m")]),
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
    found = [(number.value, number.unit) for number in read_numbers(text)]
    assert [unit for _, unit in found[: len(said)]] == [unit for _, unit in said]
    assert [value for value, _ in found[: len(said)]] == pytest.approx([value for value, _ in said])


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
    assert states(text, value, unit) != "nobody"


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
        ("two feet 5 metres", 1, "m"),
        ("1 of them", 100, "%"),
        ("by the tree, on the fifth leg", 3, "s"),
    ],
)
def test_values_that_nobody_said_are_not_found(text: str, value: float, unit: str) -> None:
    assert states(text, value, unit) == "nobody"


@pytest.mark.parametrize(
    ("text", "value", "unit", "kind", "words"),
    [
        ("hold for 20 s", 20, "s", "stated", "20 s"),
        ("hold for eight minutes", 480, "s", "converted", "eight minutes"),
        ("2 minutes and 30 seconds", 150, "s", "derived", "2 minutes and 30 seconds"),
        ("5 minutes 30", 330, "s", "derived", "5 minutes 30"),
        ("2 h 30", 9000, "s", "derived", "2 h 30"),
        ("2 foot 6 off", 0.762, "m", "derived", "2 foot 6"),
        ("two minutes, no, three", 180, "s", "converted", "three"),
        ("ten minutes here and five there", 300, "s", "converted", "five"),
        ("speed 1.5, please", 1.5, "m/s", "stated", "1.5"),
        ("wait minute at each", 60, "s", "converted", "minute"),
        ("for twenty minuets", 1200, "s", "converted", "twenty minuets"),
        ("go half round it", 180, "deg", "derived", "half"),
        ("go to the north-west", 315, "deg", "stated", "north-west"),
        ("at minus 40 degrees", -40, "deg", "stated", "minus 40 degrees"),
        ("100x60 m", 100, "m", "stated", "100"),
        ("20x20 lanes of 5 m", 20, "m", "stated", "20"),
        ("a ½ mile", 926, "m", "converted", "½ mile"),
    ],
)
def test_a_value_comes_with_its_kind_and_its_words(
    text: str, value: float, unit: str, kind: str, words: str
) -> None:
    found = read(text).evidence(value, Parameter("it", "number", unit))
    assert found.kind == kind
    assert [text[start:end].strip() for start, end in found.spans] == [words]


@pytest.mark.parametrize(
    ("text", "value", "unit"),
    [
        ("Survey the two wrecks", 2, "m"),
        ("Go to [120, -35] and hold", 120, "m"),
        ("the other one", 1, "m"),
        ("heading 045", 45, "m"),
        ("2 h 20 min", 7200, "s"),
        ("circle the buoy", 360, "deg"),
        ("hold for eight minutes", 8, "s"),
    ],
)
def test_counts_coordinates_and_parts_are_no_measures(text: str, value: float, unit: str) -> None:
    assert states(text, value, unit) == "nobody"


@pytest.mark.parametrize("text", ["three furlongs off", "at 1.2.3 m", "10^3 m", "0x20 m", "12'6 m"])
def test_numbers_that_cannot_be_read_are_not_judged(text: str) -> None:
    assert read(text).unread
    assert states(text, 77, "m") == "unread"


@pytest.mark.parametrize("text", ["a 20x20 m box", "100x60 m", "100 × 60 m", "a 100 × 10 m box"])
def test_areas_can_be_read(text: str) -> None:
    assert read(text).unread == ()


def test_scoring_allows_two_per_cent_and_the_document_none() -> None:
    radius = Parameter("radius", "number", "m")
    assert read("at 500 m").evidence(505, radius).kind == "nobody"
    assert read("at 500 m").evidence(505, radius, tolerance=0.02).kind == "stated"
    assert read("at 500 m").evidence(511, radius, tolerance=0.02).kind == "nobody"


@pytest.mark.parametrize(
    ("text", "value", "unit"),
    [
        ("hold from 11:10 to 11:30", 1200, "s"),
        ("between 23:50 and 00:20 keep station", 1800, "s"),
        ("a still every other minute", 120, "s"),
        ("turn half a right angle to port", 45, "deg"),
        ("turn through a right angle", 90, "deg"),
        ("two right angles", 180, "deg"),
    ],
)
def test_values_that_words_stand_for(text: str, value: float, unit: str) -> None:
    assert states(text, value, unit) in ("stated", "converted", "derived")


def test_scoring_allows_half_a_metre_of_a_place_at_most() -> None:
    for place, allowed in (([10.2, 0], True), ([10.3, 0], False)):
        found = read("go to [10, 0]").evidence(place, WAYPOINT, tolerance=0.02)
        assert (found.kind == "stated") == allowed
    for place, allowed in (([1000.5, 0], True), ([1000.6, 0], False)):
        found = read("go to [1000, 0]").evidence(place, WAYPOINT, tolerance=0.02)
        assert (found.kind == "stated") == allowed


def test_a_misspelt_word_behind_a_number_is_a_unit() -> None:
    """The likeliest correction of "fet" is "get"; where no number stands before it, it may be."""
    radius = Parameter("radius", "number", "m")
    assert read("keep 30 fet off").evidence(9.144, radius).given
    assert not read("keep 30 m off and fet it").evidence(9.144, radius).given


def test_figures_of_a_clock_time_are_no_values() -> None:
    text = "Do nothing until 14:30, then hold at [75, 75]."
    assert [number.value for number in read_numbers(text)] == [75, 75]
    assert {14, 30}.isdisjoint(number.value for number in in_unit(text, "s"))
    assert 150 in [number.value for number in in_unit("Hold for 2:30.", "s")]
