"""Samples whose targets go by words that the generators do not have."""

import json
from dataclasses import replace
from itertools import islice
from random import Random
from typing import Any

from planner_ft.data.varying import unfamiliar_word, with_unfamiliar_words
from planner_ft.pretraining.corpus import Mixture, stream
from planner_ft.vocabulary import load_vocabulary
from planner_ft.vocabulary.plans import plan_problems

VOCABULARY = load_vocabulary()
MISSION: dict[str, Any] = {
    "prompt": (
        "Trawlers everywhere. Find the green trawler Hilda, then hold 60 s at the trawler's north"
        " side."
    ),
    "expected": {
        "tasks": [
            {
                "title": "SearchAndDetect",
                "parameters": {"target_description": "green trawler Hilda"},
                "task_prompt": "Search for the green trawler Hilda.",
            },
            {
                "title": "KeepStation",
                "parameters": {"duration": 60},
                "task_prompt": "Hold position for 60 seconds at the north side of the trawler.",
            },
        ],
        "assumptions": [],
        "constraints": ["The green trawler Hilda must be found first."],
    },
}


def changed(record: dict[str, Any], seed: int) -> dict[str, Any]:
    result = with_unfamiliar_words(record, VOCABULARY, Random(seed))
    assert result is not None
    return result


def test_a_word_is_replaced_wherever_it_stands_and_nothing_else_is() -> None:
    before = json.dumps(MISSION)
    for seed in range(40):
        record = changed(MISSION, seed)
        target = record["expected"]["tasks"][0]["parameters"]["target_description"]
        assert target != "green trawler Hilda"
        assert f"Find the {target}, then" in record["prompt"]
        assert record["expected"]["constraints"] == [f"The {target} must be found first."]
        assert record["prompt"].endswith("north side."), "words of directions stay"
        assert record["expected"]["tasks"][1]["parameters"] == {"duration": 60}
        if "trawler" not in target:
            assert "rawler" not in json.dumps(record), (
                "neither the plural nor a capital keeps the old word"
            )
    assert json.dumps(MISSION) == before, "the record itself is left alone"


def test_words_of_titles_stay_however_these_are_written() -> None:
    locate, hold = (VOCABULARY.task[one["title"]] for one in MISSION["expected"]["tasks"])
    for title in ("find-trawler", "find_trawler", "sea.trawler", "Find Trawler", "Find trawlers"):
        vehicle = replace(VOCABULARY, tasks=(replace(locate, title=title), hold))
        tasks = [{**MISSION["expected"]["tasks"][0], "title": title}]
        mission = {**MISSION, "expected": {**MISSION["expected"], "tasks": tasks}}
        for seed in range(8):
            record = with_unfamiliar_words(mission, vehicle, Random(seed), own=True)
            assert record and record["expected"]["tasks"][0]["title"] == title
            assert "Hilda" not in json.dumps(record)


def test_what_names_no_thing_has_nothing_to_replace() -> None:
    record = {
        "prompt": "Hold for a minute.",
        "expected": {
            "tasks": [
                {"title": "KeepStation", "parameters": {"duration": 60}, "task_prompt": "Hold."}
            ]
        },
    }
    assert with_unfamiliar_words(record, VOCABULARY, Random(0)) is None


def test_names_stay_names_and_articles_right() -> None:
    rng = Random(3)
    words = [
        unfamiliar_word(word, rng) for word in ("Hilda", "anchor", "trawler") for _ in range(200)
    ]
    assert all(word[0].isupper() for word in words[:200])
    assert all(word[0] in "aeio" for word in words[200:400])
    assert not any(word[0] in "aeiou" for word in words[400:])
    assert len(set(words)) > 400
    assert any(not word.isascii() for word in words)


def test_the_corpus_stays_valid_and_the_same_for_a_seed() -> None:
    samples = list(islice(stream(VOCABULARY, 8, Mixture(0.5, unfamiliar=1.0)), 120))
    assert samples == list(islice(stream(VOCABULARY, 8, Mixture(0.5, unfamiliar=1.0)), 120))
    assert not [
        problem
        for level, record, _vehicle in samples
        for problem in plan_problems(level, record["expected"], VOCABULARY, strict=True)
    ]
    plain = list(islice(stream(VOCABULARY, 8, Mixture(0.5)), 120))
    assert [level for level, *_ in plain] == [level for level, *_ in samples], (
        "the samples drawn are the same ones"
    )
    assert 20 < sum(one != other for one, other in zip(plain, samples, strict=True)) < 120
