"""Known words, misspellings and phrases."""

from __future__ import annotations

import pytest

from planner_ft.facts import corrections, is_known, missing_words, read, unknown_words
from planner_ft.facts.words import known_words


@pytest.mark.parametrize(
    ("written", "meant"),
    [
        ("grean", "green"),
        ("barell", "barrel"),
        ("bouy", "buoy"),
        ("woden", "wooden"),
        ("yelow", "yellow"),
        ("craked", "cracked"),
        ("thermla", "thermal"),
        ("nmae", "name"),
        ("phoots", "photos"),
        ("bollrd", "bollard"),
        ("txt", "text"),
        ("thrml", "thermal"),
        ("filles", "files"),
        ("ankor", "anchor"),
    ],
)
def test_misspellings_are_put_right(written: str, meant: str) -> None:
    assert meant in corrections(written)
    assert meant in corrections(written.upper())


@pytest.mark.parametrize("word", ["green", "buoy", "Buoys", "inspected", "it", "Xqzzwv", "中文"])
def test_known_words_and_names_stay(word: str) -> None:
    assert corrections(word) == ()


def test_the_lists_know_words_of_commands_and_of_the_vocabularies() -> None:
    assert all(
        map(is_known, ("inspect", "Buoys", "panorama", "hover", "metres", "seventy", "buoy's"))
    )
    assert not is_known("Stuckquounnous")
    assert len(known_words()) > 2000


def test_words_of_a_phrase_are_found_with_their_spelling_put_right() -> None:
    text = "Find teh grean barell by the pier's end, contact T142."
    assert missing_words(text, "green barrel", misspelt=True) == []
    assert missing_words(text, "green barrel", misspelt=False) == ["green", "barrel"]
    assert missing_words(text, "contact T143", misspelt=True) == ["t143"]
    assert missing_words(text, "pier", misspelt=False) == []


def test_a_phrase_is_where_it_stands_or_where_its_words_are() -> None:
    text = "There are two buoys. Inspect the red one, then the green barrel."
    spans = read(text).phrases.spans
    assert [text[start:end] for start, end in spans("green barrel")[0]] == ["green barrel"]
    assert [text[start:end] for start, end in spans("red buoy")[0]] == ["buoys", "red"]
    assert spans("yellow whale") == []


def test_unknown_words_are_counted_without_letters_and_designations() -> None:
    text = "Go to x 5 and inspect the zorbl of mast-qwrt, tag b2."
    assert unknown_words(text) == (["zorbl", "mast-qwrt"], 2 / 9)
    assert unknown_words("") == ([], 0)
