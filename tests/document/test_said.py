"""Long and strange commands: read in bounded work, in pieces that add up."""

from __future__ import annotations

import pytest

from planner_ft.data import stated
from planner_ft.document.said import pieces, read_command
from planner_ft.vocabulary import Parameter
from tests.documents import USV

METRES, TEXT, PLACE = (
    Parameter("radius", "number", "m"),
    Parameter("what", "text"),
    Parameter("where", "position", "m"),
)
FILLER = "Look at the old pier and its ladder. "


@pytest.mark.parametrize("text", ["", "a", "x" * 5000, FILLER * 200, " " * 4000, "word " * 999])
def test_pieces_add_up_to_the_text(text: str) -> None:
    found = list(pieces(text))
    assert "".join(piece for _offset, piece in found) == text
    assert all(text[offset : offset + len(piece)] == piece for offset, piece in found)


def test_a_value_far_behind_is_found_where_it_stands() -> None:
    command = FILLER * 1000 + "Circle the green tower at [310, 42] at 77 m."
    said = read_command(command, USV)
    for value, parameter, words in (
        (77, METRES, "77 m"),
        ([310, 42], PLACE, "310, 42"),
        ("green tower", TEXT, "green tower"),
    ):
        assert said.states(value, parameter)
        assert [
            command[start:end]
            for mention in said.mentions(value, parameter)
            for start, end in mention.spans
        ] == [words]
    assert said.states(78, METRES) is False


def test_what_is_read_in_every_way_is_bounded(monkeypatch: pytest.MonkeyPatch) -> None:
    """Other readings of a text cost the most; a longer command must not have more of them."""
    read: list[int] = []
    real = stated.rewritings
    monkeypatch.setattr(
        "planner_ft.document.said_numbers.rewritings",
        lambda text: read.append(len(text)) or real(text),
    )
    for length in (300, 3000):
        read.clear()
        read_command(f"{length} " + FILLER * length, USV).states(5, METRES)
        read_command(f"{length} " + FILLER * length, USV).mentions(5, METRES)
        assert sum(read) <= 8000


@pytest.mark.parametrize(
    "command",
    [
        "检查浮标 然后返回 七 米",
        "Прибудьте к бую и обойдите его на расстоянии пяти метров, затем вернитесь",
        "<b>[[,]]</b> {} \x00",
    ],
)
def test_other_languages_and_markup_are_no_error(command: str) -> None:
    assert read_command(command, USV).states(5, METRES) in (None, False)


def test_numbers_of_another_script_are_not_judged() -> None:
    assert read_command("检查 [10, 20] 的浮标", USV).states(5, METRES) is None
    assert read_command("检查 [10, 20] 的浮标", USV).states([10, 20], PLACE) is True
