from __future__ import annotations

import pytest

from planner_ft.data.lexicon import corrections, is_known, known_words


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
