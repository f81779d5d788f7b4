"""Long and strange texts: read in bounded work, in pieces that add up."""

from __future__ import annotations

from typing import Any

import pytest

from planner_ft.facts import WAYPOINT, near, read
from planner_ft.facts.reading import Evidence, same_place, together
from planner_ft.vocabulary import Parameter

METRES, TEXT = Parameter("radius", "number", "m"), Parameter("what", "text")
FILLER = "Look at the old pier and its ladder. "


def test_a_value_far_behind_is_found_where_it_stands() -> None:
    command = FILLER * 1000 + "Circle the green tower at [310, 42] at 77 m."
    facts = read(command)
    for value, parameter, words in (
        (77, METRES, "77 m"),
        ([310, 42], WAYPOINT, "310, 42"),
        ("green tower", TEXT, "green tower"),
    ):
        found = facts.evidence(value, parameter)
        assert [command[start:end] for ((start, end),) in found.mentions] == [words]
    assert facts.evidence(78, METRES).kind == "nobody"


def test_spelling_is_put_right_in_a_bounded_part_of_a_text() -> None:
    """Other spellings cost the most; a longer command must not have more of them."""
    wanted, time = "hold two hous and five minutes. ", Parameter("time", "number", "s")
    assert read(wanted + FILLER * 500).evidence(7200, time).given
    behind = read(FILLER * 500 + wanted)
    assert not behind.evidence(7200, time).given and behind.evidence(300, time).given


@pytest.mark.parametrize(
    "command",
    [
        "检查浮标 然后返回 七 米",
        "Прибудьте к бую и обойдите его на расстоянии пяти метров, затем вернитесь",
        "<b>[[,]]</b> {} \x00",
    ],
)
def test_other_languages_and_markup_are_no_error(command: str) -> None:
    assert read(command).evidence(5, METRES).kind in ("nobody", "unread")


def test_numbers_of_another_script_are_not_judged() -> None:
    facts = read("检查 [10, 20] 的浮标")
    assert facts.evidence(5, METRES).kind == "unread"
    assert facts.evidence([10, 20], WAYPOINT).kind == "stated"


@pytest.mark.parametrize(
    ("value", "said", "tolerance", "same"),
    [
        # Two decimals are written, and factors of units are rounded: relative 1e-4.
        (5.005, 5, 0, True),
        (5.0052, 5, 0, False),
        (-4.995, -5, 0, True),
        (1000.09, 1000, 0, True),
        (1000.11, 1000, 0, False),
        (-1000.09, -1000, 0, True),
        (5, -5, 0.02, False),
        (1019, 1000, 0.02, True),
        (1021, 1000, 0.02, False),
        (981, 1000, 0.02, True),
        (0.005, 0, 0.02, True),
        (0.006, 0, 0.02, False),
    ],
)
def test_a_value_is_near_what_was_said(
    value: float, said: float, tolerance: float, same: bool
) -> None:
    assert near(value, said, tolerance) == same


@pytest.mark.parametrize(
    ("place", "said", "tolerance", "same"),
    [
        ((5.005, 5.005), (5, 5), 0, True),
        ((5.008, 5), (5, 5), 0, False),
        ((1000.3, 0), (1000, 0), 0, False),
        ((6, 8.19), (6, 8), 0.02, True),
        ((6, 8.21), (6, 8), 0.02, False),
        ((300, 400.5), (300, 400), 0.02, True),
        ((300, 400.51), (300, 400), 0.02, False),
    ],
)
def test_a_place_is_near_what_was_said_by_distance(
    place: tuple[float, float], said: tuple[float, float], tolerance: float, same: bool
) -> None:
    assert same_place(place, said, tolerance) == same


def test_a_value_with_parts_is_as_sure_as_its_weakest_part() -> None:
    order = ["stated", "converted", "vehicle", "derived", "unread", "nobody"]
    for place, kind in enumerate(order):
        parts = [Evidence(one, (((place, 9),),)) for one in order[: place + 1]]
        assert together(parts[::-1]).kind == together(parts).kind == kind
    assert together([]) == Evidence("stated")
    one = Evidence("converted", (((0, 1),), ((5, 6),)), 3)
    assert together([one]) == one
    two = together([one, Evidence("stated", (((3, 4), (8, 9)),))])
    assert two == Evidence("converted", (((0, 1), (3, 4), (8, 9)),), 0)
    assert Evidence("stated").spans == () and one.spans == ((0, 1),)


MOSTLY = (
    "The command is mostly in words that are not known; its numbers are not checked against it."
)
COULD = "The command has a number that could not be read ({}); numbers are not checked against it."


@pytest.mark.parametrize(
    ("text", "notes"),
    [
        ("go to [10, 20]", ()),
        ("vai alla boa", ()),  # Four words are too few to tell.
        ("vai alla boa rossa ora", (MOSTLY,)),
        ("go to the zxq wvb", ()),
        ("go to the zxq wvb kpf", ()),
        ("go to zxq wvb kpf", (MOSTLY,)),
        ("Überprüfe Ölfaß ab gleich bitte", (MOSTLY,)),
        ("5 7 8 9 a b c", ()),
        ("at 1.2.3 m", (COULD.format("1.2.3"),)),
        ("12'6 and 10^3", (COULD.format("12'6"),)),
        ("5 × 10 n", (COULD.format("× 10"),)),
        ("5 × 10 m", ()),
        ("address 0xff", (COULD.format("0xff"),)),
        ("three boat lengths off", (COULD.format("three boat lengths"),)),
        ("half furlong", (COULD.format("half furlong"),)),
        ("a month ago", (COULD.format("a month"),)),
        ("1.23456789.12345678.12345678.9", (COULD.format("1.23456789.12345678.1234"),)),
        (
            "检查 5",
            ("The command has words in another script; its numbers are not checked against it.",),
        ),
    ],
)
def test_why_numbers_of_a_text_are_not_checked(text: str, notes: tuple[str, ...]) -> None:
    assert read(text).unread == notes


def test_whether_a_value_was_given_cannot_always_be_told() -> None:
    assert [Evidence(kind).given for kind in ("nobody", "unread", "derived", "vehicle")] == [
        *(False, None, True, True)
    ]


@pytest.mark.parametrize(
    ("text", "value", "parameter", "kind", "words"),
    [
        ("hold 90 s", 90, Parameter("it", "number", "s"), "stated", ["90 s"]),
        ("hold 90 s", 90.0051, Parameter("it", "number", "s"), "stated", ["90 s"]),
        ("hold 90 s", "90", Parameter("it", "number", "s"), "nobody", []),
        ("hold 90 s", True, Parameter("it", "number", "s"), "nobody", []),
        ("four times, 4", 4, Parameter("it", "integer"), "stated", ["four", "4"]),
        (
            "turn to the east",
            90,
            Parameter("it", "number", "deg", False, 0, 360),
            "stated",
            ["east"],
        ),
        (
            "turn to the east",
            450,
            Parameter("it", "number", "deg", False, 0, 360),
            "stated",
            ["east"],
        ),
        ("turn to the east", 90, Parameter("it", "number", "deg", False, 0, 3600), "nobody", []),
        ("once round", 360, Parameter("it", "number", "deg"), "derived", ["once"]),
        ("once round", -360, Parameter("it", "number", "deg"), "derived", ["once"]),
        (
            "360 degrees, once round",
            360,
            Parameter("it", "number", "deg"),
            "stated",
            ["360 degrees"],
        ),
        ("once round, 360", 360, Parameter("it", "number", "deg"), "derived", ["once"]),
        ("once round", 360, Parameter("it", "number", "m"), "nobody", []),
        ("5, then 5 m", 5, Parameter("it", "number", "m"), "stated", ["5 m"]),
        ("at 5, 6 for 5", 5, Parameter("it", "number", "s"), "stated", ["5"]),
        ("5 km and 5000 m", 5000, Parameter("it", "number", "m"), "converted", ["5 km", "5000 m"]),
        ("0 m", 0, Parameter("it", "number", "m"), "derived", ["0 m"]),
        ("5000 m", 5, Parameter("it", "number", "km"), "converted", ["5000 m"]),
        ("1000000000 m", 1e9, Parameter("it", "number", "m"), "nobody", []),
        ("999999999 m", 999999999, Parameter("it", "number", "m"), "stated", ["999999999 m"]),
        ("1000000000, 5 m", [1e9, 5], WAYPOINT, "nobody", []),
        (
            "[1, 2] to [3, 4]",
            [[1, 2], [3, 4]],
            Parameter("it", "polygon"),
            "stated",
            ["1, 2", "3, 4"],
        ),
        ("[1, 2] to [3, 4]", [[1, 2], [3, 5]], Parameter("it", "polygon"), "nobody", ["1, 2"]),
        ("[1, 2] to [3, 4]", [1, 2, 3], WAYPOINT, "nobody", []),
        ("[1, 2], go again to [1, 2]", [1, 2], WAYPOINT, "stated", ["1, 2"] * 2),
        ("x 40, then on 20", [40, 20], WAYPOINT, "stated", []),
        ("x 40, then on 20", [40, 21], WAYPOINT, "nobody", []),
        ("x 40, then on 20 furlongs", [40, 21], WAYPOINT, "unread", []),
        ("red buoy, pier", ["pier", "buoy"], Parameter("it", "texts"), "stated", ["buoy", "pier"]),
        ("red buoy, pier", ["pier", "tower"], Parameter("it", "texts"), "nobody", ["pier"]),
        ("call 7 red", 7, Parameter("it", "id"), "stated", ["7"]),
    ],
)
def test_where_a_value_is_said(
    text: str, value: Any, parameter: Parameter, kind: str, words: list[str]
) -> None:
    found = read(text).evidence(value, parameter)
    spans = (
        found.spans
        if parameter.type in ("polygon", "texts")
        else [one[0] for one in found.mentions]
    )
    assert (found.kind, [text[start:end] for start, end in spans]) == (kind, words)
