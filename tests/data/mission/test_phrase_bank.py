"""The phrase bank and the lexicon: complete, legal, and no phrase that two tasks share."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterator

import pytest

from planner_ft.data.mission.synthetic import lexicon
from planner_ft.data.mission.synthetic.bank import BANK, BANK_RETURN
from planner_ft.data.mission.synthetic.phrases import TaskPhrases, listed, pairs
from planner_ft.vocabulary.definition import load_vocabulary

VOCABULARY = load_vocabulary()
CORES = (
    "imperatives",
    "noun_phrases",
    "gerunds",
    "here_imperatives",
    "bare_imperatives",
    "bare_noun_phrases",
    "bare_gerunds",
    "valued_imperatives",
    "valued_noun_phrases",
)
ARTICLES = re.compile(r"\b(?:the|an|a) ")
SLOT = re.compile(r"\{(\w+)\}")


def cores(phrases: TaskPhrases) -> Iterator[str]:
    for name in CORES:
        yield from getattr(phrases, name)


def plain(text: str) -> str:
    return ARTICLES.sub("", text.lower())


def test_every_task_has_its_language() -> None:
    assert set(BANK) == set(VOCABULARY.task)


@pytest.mark.parametrize("title", sorted(BANK))
def test_task_has_enough_phrases(title: str) -> None:
    phrases = BANK[title]
    assert len(phrases.imperatives) >= 25
    assert len(phrases.noun_phrases) >= 10
    assert len(phrases.gerunds) >= 8
    assert all(
        len(texts) >= (8 if SLOT.search("".join(texts)) else 6)
        for name, texts in phrases.adjuncts.items()
        if not name.startswith("arc_noun")
    )


@pytest.mark.parametrize("title", sorted(BANK))
def test_every_value_can_be_said(title: str) -> None:
    phrases = BANK[title]
    in_core = {slot for text in cores(phrases) for slot in SLOT.findall(text)}
    named = {part for name in phrases.adjuncts for part in name.split(":")[0].split("+")}
    position = VOCABULARY.task[title].position_parameter
    for name in VOCABULARY.task[title].by_name:
        assert name in named | in_core or name == position, name


@pytest.mark.parametrize("title", sorted(BANK))
def test_slots_are_the_task_s(title: str) -> None:
    phrases = BANK[title]
    parameters = set(VOCABULARY.task[title].by_name)
    legal = (
        parameters
        | {f"{name}_compound" for name in parameters}
        | {"target"}
        | ({"arc_noun"} if "arc" in parameters else set())
    )
    legal |= {"cable"} if title == "SubseaCableTrack" else set()
    texts = [
        *cores(phrases),
        *(text for adjuncts in phrases.adjuncts.values() for text in adjuncts),
    ]
    for text in texts:
        assert set(SLOT.findall(text)) <= legal, text
        assert text.count("{") == len(SLOT.findall(text)), text
    for text in (
        *phrases.bare_imperatives,
        *phrases.bare_noun_phrases,
        *phrases.bare_gerunds,
        *phrases.here_imperatives,
    ):
        assert "{target}" not in text, text
    for name, adjuncts in phrases.adjuncts.items():
        base = name.split(":")[0].replace("arc_noun", "arc")
        for text in adjuncts:
            wanted = (
                set()
                if name
                in ("arc:360", "arc:180", "arc:90", "arc_noun:360", "arc_noun:180", "arc_noun:90")
                else set(base.split("+"))
            )
            assert {slot.removesuffix("_compound") for slot in SLOT.findall(text)} == wanted, text


def test_no_phrase_serves_two_tasks() -> None:
    owners = defaultdict(set)
    for title, phrases in BANK.items():
        for text in cores(phrases):
            owners[plain(text)].add(title)
    for text in BANK_RETURN:
        owners[plain(text)].add("return")
    assert {text: titles for text, titles in owners.items() if len(titles) > 1} == {}


@pytest.mark.parametrize("title", sorted(BANK))
def test_no_two_phrases_differ_by_an_article_only(title: str) -> None:
    for name in CORES:
        texts = [plain(text) for text in getattr(BANK[title], name)]
        assert sorted({text for text in texts if texts.count(text) > 1}) == [], name


@pytest.mark.parametrize("title", sorted(BANK))
def test_no_adjunct_stands_twice(title: str) -> None:
    for name, texts in BANK[title].adjuncts.items():
        assert len({text.lower() for text in texts}) == len(texts), name


def test_an_orbit_speaks_of_its_arc_only_where_the_arc_is_said() -> None:
    told = re.compile(r"\b(?:full|complete|once|half|quarter|degrees?|360|180|90)\b")
    assert [text for text in cores(BANK["PerformOrbit"]) if told.search(text)] == []


def test_station_keeping_names_no_sensor() -> None:
    sensor = re.compile(
        r"film|video|camera|thermal|photo|lidar|panorama|record|measure|watch|observe|scan",
        re.IGNORECASE,
    )
    assert [text for text in cores(BANK["KeepStation"]) if sensor.search(text)] == []


def test_thermal_series_and_glare_are_named_in_every_phrase() -> None:
    thermal = re.compile(r"thermal|temperature|infrared|\bIR\b|warms|heat", re.IGNORECASE)
    assert [text for text in cores(BANK["ThermalTimeLapse"]) if not thermal.search(text)] == []
    glare = re.compile(r"glare|reflect|\bsun\b|mirrored", re.IGNORECASE)
    assert [text for text in cores(BANK["GlareFreeApproach"]) if not glare.search(text)] == []


COUNTS = {
    "TARGET_NOUNS": 200,
    "TARGET_ADJECTIVES": 100,
    "WITH_PHRASES": 80,
    "FEATURES": 120,
    "FEATURE_PHRASES": 50,
    "SIDES": 16,
    "DOCK_SPOTS": 80,
    "DOCK_MARKS": 60,
    "MOVING_TARGETS": 60,
    "CALLSIGN_PATTERNS": 30,
    "PROPER_NAMES": 150,
    "DATA_ITEMS": 120,
    "OPERATOR_LIMITS": 60,
    "SMALL_TALK": 80,
    "FILLERS": 20,
    "WHEREABOUTS": 80,
    "IMPOSSIBLE_REQUESTS": 150,
    "OPENERS": 40,
    "CLOSERS": 40,
}


@pytest.mark.parametrize("name", sorted(COUNTS))
def test_lexicon_is_broad_and_without_doubles(name: str) -> None:
    entries = getattr(lexicon, name)
    assert len(entries) >= COUNTS[name]
    assert len(set(entries)) == len(entries)


def test_words_stand_without_articles() -> None:
    for name in (
        "TARGET_NOUNS",
        "MOVING_TARGETS",
        "FEATURES",
        "DOCK_SPOTS",
        "DOCK_MARKS",
        "DATA_ITEMS",
        "SIDES",
    ):
        assert [text for text in getattr(lexicon, name) if re.match(r"(?:the|an|a) ", text)] == []
    assert all(text.startswith("with ") for text in lexicon.WITH_PHRASES)
    assert all(text.startswith(("with ", "on ")) for text in lexicon.FEATURE_PHRASES)


def test_sides_are_bare_words() -> None:
    assert [text for text in lexicon.SIDES if " " in text] == []


def test_whereabouts_are_no_part_of_a_description() -> None:
    assert [text for text in lexicon.WHEREABOUTS if text.startswith("with ")] == []


def test_constraints_are_sentences() -> None:
    for said, constraint in (
        *lexicon.OPERATOR_LIMITS,
        *lexicon.OPERATOR_LIMITS_VALUED,
        *lexicon.IMPOSSIBLE_REQUESTS,
    ):
        assert said and not said.endswith("."), said
        assert constraint[0].isupper() and constraint.endswith("."), constraint


def test_small_talk_has_no_numbers() -> None:
    assert [
        text
        for text in lexicon.SMALL_TALK
        if re.search(r"\d|\b(?:one|two|three|four|five|six|seven|eight|nine|ten|twenty)\b", text)
    ] == []
    assert all(text[0].isupper() and text.endswith(".") for text in lexicon.SMALL_TALK)


def test_purposes_belong_to_tasks() -> None:
    assert set(lexicon.PURPOSES) == set(VOCABULARY.task)


def test_blocks_are_taken_apart() -> None:
    assert listed("\n  one thing; another\n  a third;\n") == ("one thing", "another", "a third")
    assert pairs("\n  said so => Meant so.\n") == (("said so", "Meant so."),)
