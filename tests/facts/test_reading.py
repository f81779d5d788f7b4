"""Long and strange texts: read in bounded work, in pieces that add up."""

from __future__ import annotations

import pytest

from planner_ft.facts import WAYPOINT, read
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
