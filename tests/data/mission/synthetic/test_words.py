"""Targets: real nouns with fitting words, names and ids of many forms; invented words are rare."""

import re
from random import Random

from planner_ft.data.mission.synthetic import lexicon
from planner_ft.data.mission.synthetic.lexicon_names import (
    PLACE_ENDS,
    PLACE_STARTS,
    SHIP_ENDS,
    SHIP_STARTS,
)
from planner_ft.data.mission.synthetic.names import code, place_name, ship_name
from planner_ft.data.mission.synthetic.words import FEATURE_LOOKS, noun, structure, things


def known_words() -> set[str]:
    pools = (
        lexicon.TARGET_NOUNS,
        lexicon.TARGET_ADJECTIVES,
        lexicon.WITH_PHRASES,
        lexicon.PROPER_NAMES,
        FEATURE_LOOKS,
        SHIP_STARTS,
        SHIP_ENDS,
        (
            "with",
            "the",
            "a",
            "an",
            "of",
            "number",
            "No.",
            "KP",
            "Alpha",
            "Beta",
            "Gamma",
            "Delta",
            "Echo",
            "Bravo",
        ),
    )
    texts = [text for pool in pools for text in pool]
    return {*things(), *(word for text in texts for word in text.split(" "))}


def test_few_descriptions_hold_an_invented_word():
    known, invented = known_words(), 0
    places = {start + end for start in PLACE_STARTS for end in PLACE_ENDS}
    for seed in range(3000):
        words = (structure(Random(seed), 1, located=False).description or "").split(" ")
        invented += any(
            word not in known and word not in places and not re.search(r"\d|^[A-Z]+$|^[A-Z]/", word)
            for word in words
        )
    assert 0.02 < invented / 3000 < 0.08


def test_names_are_also_put_together_of_any_things():
    drawn = {noun(Random(seed)) for seed in range(3000)} - set(lexicon.TARGET_NOUNS)
    assert len(drawn) > 200
    assert not {"home", "base", "search", "north", "port", "first"} & set(things())


def test_codes_take_many_forms():
    shapes = {re.sub(r"[A-Z]", "A", re.sub(r"\d", "1", code(Random(seed)))) for seed in range(2000)}
    assert {"A1", "A-11", "1A", "11", "AA 11.1", "AAA-11"} <= shapes


def test_names_are_made_of_real_elements():
    assert place_name(Random(3)) != place_name(Random(4))
    assert ship_name(Random(1)).split(" ")[0] in {start.split(" ")[0] for start in SHIP_STARTS}
