"""Text values as spans of a command."""

from __future__ import annotations

from typing import Any

import pytest

from planner_ft.decoding.constraints.grammar import Grammar
from planner_ft.decoding.constraints.spans import MOST_WORDS, Spans
from planner_ft.support.files import compact_json


def admitted(tokenizer: Any, texts: list[str], value: str, without: tuple[str, ...] = ()) -> bool:
    from planner_ft.decoding.constraints.tokens import tokens_of

    grammar = Grammar()
    terminal = Spans(texts).terminal(grammar, without)
    if terminal is None:
        return False
    tokens = tokens_of(tokenizer, (tokenizer.eos_token_id,))
    matcher = tokens.compile(grammar.text(f'{terminal} "!"'))
    ids = tokens.engine.tokenize_bytes((compact_json(value) + "!").encode())
    return bool(matcher.validate_tokens(ids) == len(ids))


@pytest.mark.parametrize(
    ("command", "value"),
    [
        ("Inspect the rusty mooring dolphin.", "rusty mooring dolphin"),
        ("Inspect the rusty mooring dolphin.", "dolphin"),
        ("look for teh grean barell", "green barrel"),
        ("look for the grean barrell", "green barrel"),
        ("INSPECT THE GAS BOTTLE NEAR STAVANGER", "gas bottle near Stavanger"),
        ("film the bow's cracked weld", "bow cracked weld"),
        ("film the bow's cracked weld", "bow's cracked weld"),
        ("circle the big, red buoy", "big red buoy"),
        ("circle the big, red buoy", "big, red buoy"),
        ("the north-facing wall", "north"),
        ("the north-facing wall", "north-facing wall"),
        ('the yacht "Sea \\ Breeze"', "yacht Sea"),
        ("track contact KK-98 and 14", "KK-98"),
        ("track contact KK-98 and 14", "14"),
        ("check lens of A-40", "A-40"),
        ("scan region a, then b", "region a"),
        ('take a photo, note "as found"', "as found"),
        ("survey the red can buoy, then the green one", "green buoy"),
        ("survey the red can buoy, then the green one", "green can buoy"),
        ("two buoys, a striped one and a yellow one", "striped buoy"),
        ("send the OCR txt", "OCR text"),
        ("inspect the yacht Here Comes Everybody", "yacht Here Comes Everybody"),
        ("请检查红色浮标", "红色浮标"),
        ("steam to St. Mary's light", "St. Mary's light"),
    ],
)
def test_spans_can_be_written(embedded: Any, command: str, value: str) -> None:
    assert admitted(embedded, [command], value)


@pytest.mark.parametrize(
    ("command", "value"),
    [
        ("Inspect the rusty mooring dolphin.", "the rusty mooring dolphin"),
        ("Inspect the rusty mooring dolphin.", "rusty dolphin"),
        ("Inspect the rusty mooring dolphin.", "mooring rusty"),
        ("Inspect the rusty mooring dolphin.", "rusty mooring dol"),
        ("Inspect the rusty mooring dolphin.", "usty mooring"),
        ("Inspect the rusty mooring dolphin.", "rusty mooring dolphin."),
        ("Inspect the rusty mooring dolphin.", "red buoy"),
        ("Inspect the rusty mooring dolphin.", ""),
        ("Inspect the rusty mooring dolphin.", " dolphin"),
        ("inspect the buoy with the lamp", "buoy with"),
        ("send the clip; the rest stays on board for now", "now"),
        ("find the buoy and then the pier", "and then the pier"),
        ("inspect the buoy; send the photos", "buoy send"),
        ("inspect the buoy\nsend the photos", "buoy send the photos"),
        ("find Krösting Demel", "Krosting Demel"),
        ("", "buoy"),
        ("x" * 200, "x" * 200),
    ],
)
def test_what_nobody_said_cannot(embedded: Any, command: str, value: str) -> None:
    assert not admitted(embedded, [command], value)


def test_a_span_can_be_ruled_out_in_capitals_or_not(embedded: Any) -> None:
    command = ["Find the Red Buoy, then the green buoy"]
    assert not admitted(embedded, command, "Red Buoy", without=("red buoy",))
    assert not admitted(embedded, command, "red buoy", without=("Red Buoy",))
    assert admitted(embedded, command, "green buoy", without=("red buoy",))
    assert admitted(embedded, command, "Buoy", without=("red buoy",))


def test_spans_of_several_texts_do_not_run_into_one_another(embedded: Any) -> None:
    texts = ["keep it centred", "checkerboard marker"]
    assert admitted(embedded, texts, "checkerboard marker")
    assert not admitted(embedded, texts, "centred checkerboard marker")


def test_long_commands_keep_their_spans(embedded: Any) -> None:
    words = [f"word{number}" for number in range(180)]
    for place in range(0, len(words) - 5, 7):
        assert admitted(embedded, [" ".join(words)], " ".join(words[place : place + 5]))
    assert admitted(embedded, [" ".join(words)], " ".join(words[10:170]))
    assert Spans([" ".join(words)]).too_long is False
    assert Spans(["word " * (MOST_WORDS + 1)]).too_long is True
