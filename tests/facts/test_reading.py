"""Long and strange texts: read in bounded work, in pieces that add up."""

from __future__ import annotations

import pytest

from planner_ft.facts import WAYPOINT, pieces, read
from planner_ft.facts.variants import Variant, variants
from planner_ft.vocabulary import Parameter

METRES, TEXT = Parameter("radius", "number", "m"), Parameter("what", "text")
FILLER = "Look at the old pier and its ladder. "


@pytest.mark.parametrize("text", ["", "a", "x" * 5000, FILLER * 200, " " * 4000, "word " * 999])
def test_pieces_add_up_to_the_text(text: str) -> None:
    found = list(pieces(text))
    assert "".join(piece for _offset, piece in found) == text
    assert all(text[offset : offset + len(piece)] == piece for offset, piece in found)


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


def test_what_is_read_in_every_way_is_bounded(monkeypatch: pytest.MonkeyPatch) -> None:
    """Other readings of a text cost the most; a longer command must not have more of them."""
    lengths: list[int] = []

    def counted(text: str) -> tuple[Variant, ...]:
        lengths.append(len(text))
        return variants(text)

    monkeypatch.setattr("planner_ft.facts.reading.variants", counted)
    for length in (300, 3000):
        lengths.clear()
        read(f"{length} " + FILLER * length).evidence(5, METRES)
        assert 0 < sum(lengths) <= 8000


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
