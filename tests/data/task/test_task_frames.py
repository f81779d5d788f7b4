"""Which steps a skill runs in, as it is said and as it is labelled."""

import random
import re

import pytest

from planner_ft.data.task.frames import Scopes
from planner_ft.data.task.sampler import sample_tasks
from planner_ft.data.templates.render import joined
from planner_ft.vocabulary.definition import load_vocabulary

USV = load_vocabulary("usv")


@pytest.fixture(scope="module")
def records():
    return [
        record
        for record in sample_tasks(USV, 11, 8000, "train")
        if not record["family"].startswith("template")
    ]


def scope_words(count, chosen, *, numbered=False):
    """Every wording found for the steps `chosen` of so many movements of one step each."""
    scopes = Scopes(count, "step", random.Random(5), numbered=numbered)
    return {scopes.words(frozenset(chosen)) for _ in range(600)}


@pytest.mark.parametrize(
    ("count", "chosen", "numbered", "some"),
    [
        (2, [0, 1], False, {"throughout", "in every step", "in both steps"}),
        (2, [1], False, {"in the second step", "only during the last step"}),
        (3, [0, 2], False, {"in all steps but the second", "in the first and third steps"}),
        (3, [0, 2], True, {"in steps 1 and 3"}),
    ],
)
def test_words_for_the_steps_in_which_a_skill_runs(count, chosen, numbered, some):
    assert some <= scope_words(count, chosen, numbered=numbered)


def test_nothing_is_said_that_could_mean_another_step():
    assert not any(re.search("first|second|last|only|not", text) for text in scope_words(2, [0, 1]))
    assert all(re.search("second|last|but the first|except", text) for text in scope_words(2, [1]))


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
    pieces = [("take a ", False), ("image every ", False), ("a minute", True), (" in a ", False)]
    said = joined([*pieces, ("8-second", True), (" hold .", False)])
    assert said == "Take an image every \x02minute\x03 in an \x028-second\x03 hold."


def test_most_answers_are_short(records):
    lengths = [len(record["expected"]["skill_sequence"]) for record in records]
    assert sum(length <= 6 for length in lengths) > 0.85 * len(lengths) and max(lengths) <= 24
