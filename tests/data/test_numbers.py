"""Values are said in words that mean them: each way of saying a value, and that it is read back."""

from __future__ import annotations

from random import Random
from typing import Any

import pytest

from planner_ft.data import numbers
from planner_ft.data.numbers import (
    Value,
    angle,
    bearing,
    count_text,
    duration,
    feet,
    in_words,
    knots,
    length,
    pick,
    polygon,
    position,
    rotation,
    say_number,
    speed,
)
from planner_ft.facts import WAYPOINT, read
from planner_ft.facts.numbers import read_numbers
from planner_ft.vocabulary import Parameter
from tests.values import changeable

WAYS = """
    length 1 text: 1 m | 1 meter | 1 metre | 1m | one meter | one metre
    length 0.5 text: 0.5 m | 0.5 meters | 0.5 metres | 0.5m | half a metre
    length 20 text: 20 m | 20 meters | 20 metres | 20m | twenty meters | twenty metres
    length 21 text: 21 m | 21 meters | 21 metres | 21m | twenty-one meters | twenty-one metres
    length 12.5 text: 12.5 m | 12.5 meters | 12.5 metres | 12.5m | twelve and a half meters |
    ... twelve and a half metres
    length 250 text: 250 m | 250 meters | 250 metres | 250m | a quarter of a kilometre | two
    ... hundred and fifty meters | two hundred and fifty metres
    length 1000 text: 1 kilometres | 1 km | 1000 m | 1000 meters | 1000 metres | 1000m | a
    ... kilometre | one kilometre
    length 1050 text: 1050 m | 1050 meters | 1050 metres | 1050m
    length 1500 text: 1.5 kilometres | 1.5 km | 1500 m | 1500 meters | 1500 metres | 1500m | a
    ... kilometre and a half | one and a half kilometres
    length 9900 text: 9.9 kilometres | 9.9 km | 9900 m | 9900 meters | 9900 metres | 9900m
    length 1 short: 1 m | 1-metre | one-metre
    length 20 short: 20 m | 20-metre | twenty-metre
    length 21 short: 21 m | 21-metre
    length 0.5 short: 0.5 m | 0.5-metre
    duration 0 text: 0 s | 0 sec | 0 seconds | 0s | zero seconds
    duration 1 text: 1 s | 1 sec | 1 second | 1s | one second
    duration 45 text: 45 s | 45 sec | 45 seconds | 45s | forty-five seconds | three quarters of
    ... a minute
    duration 60 text: 1 min | 1 minute | 1min | 60 s | 60 sec | 60 seconds | 60s | a full minute
    ... | a minute | one minute | sixty seconds
    duration 61 text: 61 s | 61 sec | 61 seconds | 61s | sixty-one seconds
    duration 75 text: 1 min 15 s | 1 minute 15 seconds | 75 s | 75 sec | 75 seconds | 75s | a
    ... minute and a quarter | seventy-five seconds
    duration 80 text: 80 s | 80 sec | 80 seconds | 80s | eighty seconds
    duration 90 text: 1 min 30 s | 1 minute 30 seconds | 1.5 minutes | 90 s | 90 sec | 90
    ... seconds | 90s | a minute and a half | ninety seconds | one and a half minutes | one
    ... minute thirty
    duration 120 text: 120 s | 120 sec | 120 seconds | 120s | 2 min | 2 minutes | 2min | a
    ... couple of minutes | a hundred and twenty seconds | one hundred and twenty seconds | two
    ... minutes
    duration 630 text: 10 min 30 s | 10 minutes 30 seconds | 10.5 minutes | 630 s | 630 sec |
    ... 630 seconds | 630s | six hundred and thirty seconds
    duration 870 text: 14 min 30 s | 14 minutes 30 seconds | 14.5 minutes | 870 s | 870 sec |
    ... 870 seconds | 870s | eight hundred and seventy seconds
    duration 900 text: 15 min | 15 minutes | 15min | 900 s | 900 sec | 900 seconds | 900s | a
    ... quarter of an hour | fifteen minutes | nine hundred seconds
    duration 930 text: 930 s | 930 sec | 930 seconds | 930s | nine hundred and thirty seconds
    duration 3600 text: 1 h | 1 hour | 3600 s | 3600 sec | 3600 seconds | 3600s | a full hour |
    ... an hour | one hour
    duration 4800 text: 1 h 20 min | 1 hour 20 minutes | 1h 20min | 4800 s | 4800 sec | 4800
    ... seconds | 4800s | 80 min | 80 minutes | 80min | eighty minutes
    duration 7140 text: 1 h 59 min | 1 hour 59 minutes | 119 min | 119 minutes | 119min | 1h
    ... 59min | 7140 s | 7140 sec | 7140 seconds | 7140s | a hundred and nineteen minutes | one
    ... hundred and nineteen minutes
    duration 7200 text: 2 h | 2 hours | 7200 s | 7200 sec | 7200 seconds | 7200s | a couple of
    ... hours | two hours
    duration 7260 text: 2 h 1 min | 2 hours 1 minutes | 2h 1min | 7260 s | 7260 sec | 7260
    ... seconds | 7260s
    duration 9000 text: 2 h 30 min | 2 hours 30 minutes | 2h 30min | 9000 s | 9000 sec | 9000
    ... seconds | 9000s | two and a half hours
    duration 90.5 text: 90.5 s | 90.5 sec | 90.5 seconds | 90.5s
    duration 0 short: 0-second
    duration 20 short: 20-second | twenty-second
    duration 21 short: 21-second
    duration 90 short: 90-second
    duration 1200 short: 1200-second | 20-minute | twenty-minute
    duration 1260 short: 1260-second | 21-minute
    duration 3600 short: 3600-second
    duration 7140 short: 119-minute | 7140-second
    duration 7260 short: 7260-second
    bearing 0 text: 0 | 0 degrees | 000 | 0° | due north | north | zero degrees
    bearing 0 way: north
    bearing 5 text: 005 | 5 | 5 degrees | 5° | five degrees
    bearing 5 way:
    bearing 22.5 text: 22.5 | 22.5 degrees | 22.5° | due north-north-east | north-north-east
    bearing 22.5 way: north-north-east
    bearing 337.5 text: 337.5 | 337.5 degrees | 337.5° | due north-north-west | north-north-west
    bearing 337.5 way: north-north-west
    bearing 100 text: 100 | 100 degrees | 100° | one hundred degrees
    bearing 100 way:
    bearing 360 text: 360 | 360 degrees | 360° | due north | north | three hundred and sixty
    ... degrees
    bearing 360 way: north
    angle 1 text: 1 degree | 1° | one degree
    angle 15 short: 15-degree
    angle 90 noun: a 90-degree arc | a quarter circle | a quarter lap | a quarter of a circle |
    ... an arc of 90 degrees | an arc of 90° | an arc of ninety degrees
    rotation 15 short: +15 degrees | +15° | 15 degrees | 15°
    rotation -15 short: -15 degrees | -15° | minus 15 degrees | minus 15°
    rotation 0 short: -0 degrees | -0° | minus 0 degrees | minus 0°
    rotation -90 noun: a 90-degree arc anticlockwise | a 90-degree arc counter-clockwise | a
    ... 90-degree arc to port | a 90-degree arc to the left | a quarter circle anticlockwise | a
    ... quarter circle counter-clockwise | a quarter circle to port | a quarter circle to the
    ... left | a quarter lap anticlockwise | a quarter lap counter-clockwise | a quarter lap to
    ... port | a quarter lap to the left | a quarter of a circle anticlockwise | a quarter of a
    ... circle counter-clockwise | a quarter of a circle to port | a quarter of a circle to the
    ... left | an arc of 90 degrees anticlockwise | an arc of 90 degrees counter-clockwise | an
    ... arc of 90 degrees to port | an arc of 90 degrees to the left | an arc of ninety degrees
    ... anticlockwise | an arc of ninety degrees counter-clockwise | an arc of ninety degrees to
    ... port | an arc of ninety degrees to the left
    speed 1 text: 1 m/s | 1 metre a second | 1 metre per second | 1m/s | one metre a second |
    ... one metre per second
    speed 0.5 text: 0.5 m/s | 0.5 metres a second | 0.5 metres per second | 0.5m/s | half a
    ... metre per second
    speed 2 text: 2 m/s | 2 metres a second | 2 metres per second | 2m/s | two metres a second |
    ... two metres per second
"""
"""Sense, value and kind of wording: all that is said. A line that begins with dots goes on."""


def draws(say: Any, count: int = 2500) -> list[Value]:
    rng = Random(0)
    return [say(rng) for _ in range(count)]


@pytest.mark.parametrize("row", WAYS.replace("\n    ... ", " ").strip().splitlines())
def test_all_ways_of_saying_a_value(row: str) -> None:
    head, _, said = row.partition(":")
    sense, value, wording = head.split()
    number = float(value) if "." in value else int(value)
    found = {
        getattr(one, wording) for one in draws(lambda rng: say_number(number, sense, None, rng))
    }
    assert found - {None} == {one.strip() for one in said.split(" | ")} - {""}


def test_what_is_said_cannot_be_changed() -> None:
    assert changeable("planner_ft.data.numbers", "planner_ft.data.rules") == []


READ: list[tuple[Any, str, list[float]]] = [
    (length, "m", [1, 0.5, 12.5, 20, 250, 999, 1000, 1050, 2500]),
    (duration, "s", [1, 30, 45, 75, 90, 150, 630, 885, 900, 3600, 4500, 4800, 7140, 9000, 12000]),
    (bearing, "deg", [0, 5, 22.5, 45, 90, 120, 202.5, 337.5]),
    (angle, "deg", [1, 15, 90, 180, 270, 360, 720]),
    (speed, "m/s", [0.5, 1, 1.5, 12]),
]


@pytest.mark.parametrize(
    ("say", "unit", "values"), READ, ids=lambda one: getattr(one, "__name__", "")
)
def test_a_value_is_read_from_every_way_of_saying_it(
    say: Any, unit: str, values: list[float]
) -> None:
    parameter = Parameter("it", "number", unit)
    for value in values:
        for one in draws(lambda rng, value=value: say(value, rng), 300):
            assert one.value == value
            for text in {one.text, one.short, one.noun, one.way} - {None}:
                assert read(f"do it: {text}.").evidence(value, parameter).given, (value, text)


def test_turns_are_said_with_their_side() -> None:
    right, left = {"right", "clockwise", "starboard"}, {"left", "anticlockwise", "port"}
    right_words, left_words = right, left | {"counter-clockwise"}
    for value in (1, 15, 90, 360, -1, -15, -90, -360):
        degrees = Parameter("it", "number", "deg")
        for one in draws(lambda rng, value=value: rotation(value, rng), 400):
            own, other = (right_words, left_words) if value > 0 else (left_words, right_words)
            assert one.value == value and set(one.way.split()) & own
            for text in (one.text, one.noun, one.way):
                assert not set(text.split()) & other, text
                size = abs(value) if set(text.split()) & own else value
                given = read(f"turn {text}").evidence(size, degrees).given
                assert given or read(f"turn {text}").evidence(abs(size), degrees).given, text
            assert one.short[:1] == "-" or "minus" in one.short or value > 0
    # A turn to the right needs no word for it.
    assert any(one.noun == "an arc of 15 degrees" for one in draws(lambda rng: rotation(15, rng)))


@pytest.mark.parametrize(
    ("low", "high", "numbers_of_feet"),
    [(2, 3.1, {10}), (3.048, 3.05, {10}), (3.05, 4.6, {15}), (152.4, 400, {500}), (1, 3, set())],
)
def test_feet_are_round_and_in_range(low: float, high: float, numbers_of_feet: set[int]) -> None:
    found = {one and (one.value, one.text) for one in draws(lambda rng: feet(rng, low, high), 100)}
    assert found == {
        (round(n * 0.3048, 2), f"{n} {unit}") for n in numbers_of_feet for unit in ("ft", "feet")
    } | ({None} if not numbers_of_feet else set())


def test_knots_are_metres_a_second_in_the_plan() -> None:
    for one in draws(knots, 300):
        (number,) = read_numbers(one.text)
        assert one.value == pytest.approx(number.value, abs=0.006) and number.unit == "m/s"
        assert one.short.endswith("-knot")
    assert {one.value for one in draws(knots, 300)} == {
        0.26,
        0.51,
        0.77,
        1.03,
        1.29,
        1.54,
        2.06,
        2.57,
    }


@pytest.mark.parametrize(
    ("place", "forms", "some"),
    [
        (
            (40, 12),
            22,
            {"40,12", "40, 12", "40 east, 12 north", "forty comma twelve", "40/12", "40 12"},
        ),
        (
            (-40, 12),
            22,
            {"-40, 12", "minus 40, 12", "40 m west and 12 m north", "minus forty, twelve"},
        ),
        (
            (40, -12),
            22,
            {"40,-12", "40, minus 12", "40 m east and 12 m south", "forty, minus twelve"},
        ),
        ((0, 5), 17, {"0, 5", "zero comma five", "0 5"}),
        ((0.5, -3), 20, {"0.5, minus 3", "0.5 metres east and 3 metres south"}),
        ((999, -1), 22, {"nine hundred and ninety-nine, minus one"}),
        ((1000, -1), 20, {"1000 east 1 south"}),
    ],
)
def test_positions_are_said_in_many_forms_and_read_back(
    place: tuple[float, float], forms: int, some: set[str]
) -> None:
    found = draws(lambda rng: position(place, rng))
    texts = {one.text for one in found}
    assert some <= texts and len(texts) == forms
    assert {one.short for one in found} == {
        f"[{place[0]}, {place[1]}]",
        f"({place[0]}, {place[1]})",
    }
    assert all(one.value == list(place) for one in found)
    for text in texts:
        assert read(f"go to {text}").evidence(list(place), WAYPOINT).given, text


def test_a_form_is_taken_where_the_position_has_its_fields() -> None:
    rng = Random(0)
    assert position((1, 2), rng, "{x}/{y}").text == "1/2"
    assert position((1, 2), rng, "{plain_x} {plain_y}").text == "1 2"
    assert position((-1, 2), rng, "{plain_x} {plain_y}").text != "-1 2"


BOX, SQUARE = [(0, 0), (50, 0), (50, 40), (0, 40)], [(10, 0), (60, 0), (60, 50), (10, 50)]
BOXES = {
    f"{before}{mark.format(*BOX[0])} {joint} {mark.format(*BOX[2])}"
    for mark in ("[{}, {}]", "({}, {})")
    for before, joint in (
        *(("the box from ", "to"), ("the rectangle from ", "to")),
        *(("", "to"), ("", "up to"), ("", "-")),
    )
}
AROUND = {
    f"a 25{unit} square around {place}"
    for unit in ("-metre", " m")
    for place in ("[35, 25]", "(35, 25)")
}


@pytest.mark.parametrize(
    ("ring", "nouns"),
    [
        (BOX, BOXES),
        (BOX[:3], {None}),
        (BOX[2:] + BOX[:2], {None}),
        ([(0, 0), (50, 0), (60, 40), (0, 40)], BOXES),
        ([(0, 0), (50, 1), (50, 40), (0, 40)], {None}),
        ([(50, 0), (0, 0), (0, 40), (50, 40)], {None}),
        ([(0, 40), (50, 40), (50, 0), (0, 0)], {None}),
        ([*BOX, (0, 20)], {None}),
    ],
)
def test_a_box_from_its_south_west_corner_on_has_a_noun(
    ring: list[tuple[float, float]], nouns: set[str | None]
) -> None:
    found = {one.noun for one in draws(lambda rng: polygon(ring, rng), 400)}
    assert found == ({one.replace("50", "60") for one in nouns} if (60, 40) in ring else nouns)


def test_a_square_may_be_said_by_its_middle_and_half_its_side() -> None:
    nouns = {one.noun for one in draws(lambda rng: polygon(SQUARE, rng), 400)}
    assert nouns > AROUND and any(
        noun.startswith("the box from [10, 0]") for noun in nouns - AROUND
    )


def test_corners_are_said_in_one_notation_and_read_back() -> None:
    found = draws(lambda rng: polygon(BOX, rng), 1500)
    texts = {one.text for one in found}
    assert len(texts) == 38 and all(one.value == [[*corner] for corner in BOX] for one in found)
    assert {
        "[0, 0], [50, 0], [50, 40] and [0, 40]",
        "[[0, 0], [50, 0], [50, 40], [0, 40]]",
        "(0,0) (50,0) (50,40) (0,40)",
        "0 0, 50 0, 50 40, 0 40",
        "x=0 y=0 - x=50 y=0 - x=50 y=40 - x=0 y=40",
    } <= texts
    assert "[(0, 0), (50, 0), (50, 40), (0, 40)]" not in texts
    assert not any("] and [" in text and "[[" in text for text in texts)
    polygon_of = Parameter("it", "polygon")
    for text in texts:
        given = read(f"stay inside {text}").evidence([[*corner] for corner in BOX], polygon_of)
        assert given.given, text


@pytest.mark.parametrize(
    ("value", "words"),
    [
        *((0, "zero"), (10, "ten"), (19, "nineteen"), (20, "twenty"), (21, "twenty-one")),
        *((99, "ninety-nine"), (100, "one hundred"), (101, "one hundred and one")),
        *((320, "three hundred and twenty"), (999, "nine hundred and ninety-nine")),
    ],
)
def test_whole_numbers_in_words(value: int, words: str) -> None:
    assert in_words(value) == words


@pytest.mark.parametrize(
    ("value", "texts", "share"),
    [
        (0, {"0", "zero"}, 0.32),
        (20, {"20", "twenty"}, 0.32),
        (21, {"21", "twenty-one"}, 0.05),
        (30, {"30", "thirty"}, 0.17),
        (110, {"110", "one hundred and ten", "a hundred and ten"}, 0.05),
        (200, {"200", "two hundred"}, 0.17),
        (100, {"100", "one hundred", "a hundred"}, 0.17),
        (999, {"999", "nine hundred and ninety-nine"}, 0.05),
        (1000, {"1000"}, 0),
        (-5, {"-5"}, 0),
        (1.5, {"1.5", "one and a half"}, 0.22),
        (19.5, {"19.5", "nineteen and a half"}, 0.22),
        (20.5, {"20.5"}, 0),
        (0.5, {"0.5"}, 0),
        (1.25, {"1.25"}, 0),
    ],
)
def test_a_count_is_in_words_now_and_then(value: float, texts: set[str], share: float) -> None:
    rng = Random(0)
    said = [count_text(value, rng) for _ in range(4000)]
    assert set(said) == texts
    assert sum(not text[-1].isdigit() for text in said) / 4000 == pytest.approx(share, abs=0.02)


def test_a_number_without_a_sense_has_its_unit() -> None:
    rng = Random(1)
    assert say_number(1000, None, "m", rng) == Value(1000, "1000 m")
    assert say_number(1000, None, None, rng) == say_number(1000, None, "count", rng)
    assert say_number(1000, "unknown", None, rng).text == "1000"
    assert say_number(40, "temperature", "°C", rng).text.split()[0].rstrip("°C") == "40"
    said = {duration(60 * count, rng).text for count in (1, 2) for _ in range(300)}
    assert {"1 minute", "2 minutes"} <= said and not {"1 minutes", "2 minute"} & said
    assert {pick("abc", rng) for _ in range(100)} == set("abc")


def test_a_wording_is_taken_where_a_slot_asks_for_it_and_the_value_has_it() -> None:
    value = Value(15, "15 degrees", "15-degree", "an arc", "left by 15 degrees")
    bare = Value(15, "15 degrees")
    asked = {"adj": "15-degree", "num": "15-degree", "noun": "an arc", "way": "left by 15 degrees"}
    for option, text in asked.items():
        assert value.worded(frozenset({option})) == text and value.has(frozenset({option}))
        assert bare.worded(frozenset({option})) == "15 degrees"
        assert not bare.has(frozenset({option}))
    assert value.worded(frozenset()) == value.worded(frozenset({"cap"})) == "15 degrees"
    assert bare.has(frozenset({"cap"})) and not bare.has(frozenset({"cap", "adj"}))
    assert set(numbers.COMPASS.items()) > {(0, "north"), (45, "north-east"), (315, "north-west")}
