"""Which steps a skill runs in, as it is said and as it is labelled."""

import random
import re

import pytest

from planner_ft.data.task.context import Movement
from planner_ft.data.task.frames import Scopes
from planner_ft.data.task.phrasebook import Phrasebook, Saying, Slots
from planner_ft.data.task.sampler import sample_tasks
from planner_ft.data.task.template import close_gaps, compile_template
from planner_ft.vocabulary.definition import load_vocabulary

USV = load_vocabulary("usv")
BOOK = Phrasebook(USV, unseen=False)
SKILLS = {
    "goto": "GoToXY",
    "hold": "StationKeep",
    "wait": "WaitForStability",
    "turn_to": "RotateToHeading",
    "waypoints": "GoToXY",
}


@pytest.fixture(scope="module")
def records():
    return [
        record
        for record in sample_tasks(USV, 11, 8000, "train")
        if not record["family"].startswith("template")
    ]


def scope_words(kinds, chosen, *, numbered=False):
    """Every wording found for the steps `chosen` of movements of these kinds; "waypoints" has two
    steps.
    """
    rng = random.Random(5)
    saying = Saying([compile_template("~move on")], Slots(BOOK, rng))
    movements = [
        Movement(kind, [(SKILLS[kind], {})] * (2 if kind == "waypoints" else 1), saying)
        for kind in kinds
    ]
    scopes = Scopes(movements, BOOK, rng, numbered=numbered)
    return {scopes.alone(frozenset(chosen)) for _ in range(600)}


def test_all_steps():
    said = scope_words(["goto", "hold"], [0, 1])
    assert {"throughout", "in every step", "in both steps"} <= said
    assert not any(re.search("first|second|last|only|not", words) for words in said)


def test_one_of_two_holds_is_told_from_both():
    assert {"in both holds", "while holding"} <= scope_words(["hold", "goto", "hold"], [0, 2])
    first = scope_words(["hold", "goto", "hold"], [0])
    assert {"in the first hold", "in the first step only"} <= first
    assert not any("both" in words or words.startswith("while holding") for words in first)


def test_the_only_movement_of_its_kind_is_named_by_it():
    said = scope_words(["goto", "hold"], [1])
    assert {"during the hold", "in the second step", "during the hold, not on the way"} & said
    assert all(re.search("hold|station|spot|second|last|stop", words) for words in said)


def test_nothing_is_said_that_could_mean_another_step():
    assert not any("waiting" in words for words in scope_words(["wait", "hold"], [0]))
    assert not any("leg" in words for words in scope_words(["waypoints", "goto"], [1]))


def test_all_but_one_and_numbers():
    assert {"in all steps but the second", "in the first and third steps"} <= scope_words(
        ["goto", "hold", "turn_to"], [0, 2]
    )
    assert {"in steps 1 and 3", "in the first and third steps"} <= scope_words(
        ["goto", "hold", "turn_to"], [0, 2], numbered=True
    )


def test_refusals_add_nothing(records):
    refused = [
        record
        for record in records
        if re.search(r"\b[Nn]o (recording|video|filming)\.", record["prompt"])
    ]
    assert refused
    assert not any(
        call["name"] == "SetStreamRecording"
        for record in refused
        for step in record["expected"]["skill_sequence"]
        for call in step["perception_skills"]
    )


def test_one_skill_can_stand_twice_with_other_parameters(records):
    twice = 0
    for step in (step for record in records for step in record["expected"]["skill_sequence"]):
        names = [call["name"] for call in step["perception_skills"]]
        assert names.count("SelectActiveStream") < 2
        if len(set(names)) < len(names):
            twice += 1
            assert len({repr(call) for call in step["perception_skills"]}) == len(names)
    assert twice > 50


def test_articles_fit_what_stands_behind_them():
    assert (
        close_gaps("Take a image every \x02a minute in a \x028-second hold .")
        == "Take an image every \x02minute in an \x028-second hold."
    )
    assert close_gaps("a USV, a unit, a one-off, a hold") == "a USV, a unit, a one-off, a hold"


def test_most_answers_are_short(records):
    lengths = [len(record["expected"]["skill_sequence"]) for record in records]
    assert sum(length <= 6 for length in lengths) > 0.85 * len(lengths) and max(lengths) <= 24
