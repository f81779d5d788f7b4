"""Text values as spans of a command."""

from __future__ import annotations

from typing import Any

import pytest

from planner_ft.decoding.constraints.grammar import Grammar
from planner_ft.decoding.constraints.grounded import MOST_WORDS, Spans
from planner_ft.support.files import compact_json


def admitted(tokenizer: Any, texts: list[str], value: str, without: tuple[str, ...] = ()) -> bool:
    from llguidance import LLMatcher

    from planner_ft.decoding.constraints.tokens import tokens_of

    grammar = Grammar()
    terminal = Spans(texts).terminal(grammar, without)
    if terminal is None:
        return False
    tokens = tokens_of(tokenizer, (tokenizer.eos_token_id,))
    matcher = LLMatcher(tokens.engine, grammar.text(f'{terminal} "!"'))
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
        ("stay behind Rangi's heels", "Rangi"),
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
        ("stay behind Rangi's heels", "Rangi's"),
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


WORD = "x" * 32


@pytest.mark.parametrize(
    ("command", "value", "possible"),
    [
        # Behind four function words in a row a span may end all the same.
        ("steam to of the and buoy", "steam to of", False),
        ("steam to of the and buoy", "steam to of the", False),
        ("steam to of the and buoy", "steam to of the and", True),
        ("steam to of the and in buoy", "steam to of the and in", False),
        ("the buoy", "the", False),
        ("the buoy", "the buoy", False),
        ('sail the "the Wave"', "the Wave", True),
        ("sail the 'the Wave'", "the Wave", True),
        ("sail (the Wave)", "the Wave", False),
        ("plan A is best", "plan A", True),
        ("plan a is best", "plan a", False),
        ("region a, then left", "region a", True),
        ("region a, then left", "a", True),
        ("camera_a is on", "camera_a", True),
        ("camera_a is on", "camera", False),
        ("camera-a is on", "camera-a", True),
        # A word of up to 32 bytes.
        (WORD, WORD, True),
        (WORD + "x", WORD + "x", False),
        ("é" * 16, "é" * 16, True),
        ("é" * 17, "é" * 17, False),
        # Gaps: a hyphen or slash may be a blank, other signs inside a word stay.
        ("pier-end lamp", "pier end lamp", True),
        ("pier/end lamp", "pier end", True),
        ("pier&end lamp", "pier&end", True),
        ("pier&end lamp", "pier end", False),
        ("no. 7 buoy", "no. 7", True),
        ("no. 7 buoy", "no 7", True),
        ("pos. 7 buoy", "pos. 7", True),
        ("pier. 7 buoys", "pier. 7", False),
        ("pier. 7 buoys", "pier 7", False),
        ("big,  red buoy", "big,  red buoy", False),
        ("big  red buoy", "big red buoy", True),
        ("big: red buoy", "big red buoy", False),
        ("the pier (old)", "pier old", False),
        ("find 'Anna' now", "find Anna", True),
        # Possessives.
        ("the bow's weld", "bow's weld", True),
        ("the bow's weld", "bow weld", True),
        ("the bow's", "bow's", True),
        ("the bow't weld", "bow weld", False),
        # Capitals.
        ("THE GAS BOTTLE", "GAS BOTTLE", True),
        ("THE GAS BOTTLE", "Gas Bottle", True),
        ("THE GAS BOTTLE", "gas bottle", True),
        ("the gas bottle", "Gas bottle", False),
        ("track Q now", "q", True),
        # With words left out, a plural is its singular, and a value may be two spans.
        ("two buoys and the other one", "buoy", True),
        ("old buoys", "buoy", False),
        ("two passes and the other one", "passe", True),
        ("the glass and the other one", "glas", False),
        ("the gas and the other one", "ga", False),
        ("red lamp here, pier there and the other one", "red pier", True),
        ("red lamp here, pier there", "red pier", False),
        ("請查浮標", "查浮標", True),
        ("請查浮標", "查標", False),
    ],
)
def test_what_a_value_may_be_of_a_command(
    embedded: Any, command: str, value: str, possible: bool
) -> None:
    assert admitted(embedded, [command], value) is possible


def test_a_command_of_2000_words_keeps_its_spans() -> None:
    assert not Spans(["word " * MOST_WORDS]).too_long
    assert not Spans(["word " * (MOST_WORDS // 2)] * 2).too_long
    assert Spans(["word " * (MOST_WORDS // 2), "word " * (MOST_WORDS // 2 + 1)]).too_long


def test_where_all_spans_are_ruled_out_there_is_none(embedded: Any) -> None:
    assert Spans(["buoy"]).terminal(Grammar(), ["Buoy"]) is None
    assert Spans(["the"]).terminal(Grammar()) is Spans([]).terminal(Grammar()) is None
    assert not admitted(embedded, ["red buoy"], "buoy", ("buoy",))
    assert admitted(embedded, ["red buoy"], "red buoy", ("buoy",))
    grammar, spans = Grammar(), Spans(["red buoy"])
    assert spans.terminal(grammar) == spans.terminal(grammar)
    assert spans.terminal(grammar, ["buoy"]) != spans.terminal(grammar)
