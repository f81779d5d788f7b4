"""Which steps a skill runs in, as it is said and as it is labelled."""

import itertools
import re

import pytest

from planner_ft.data.task.compose import frames
from planner_ft.data.task.sampler import sample_tasks
from planner_ft.data.templates.grammar import all_slots
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


SCOPE = re.compile(r"\{([DF]\d+)[^}]*\} \(*(?:only |)(?:in|during|for) the (\w+) \{step\}")
NTH = ("first", "second", "third", "fourth", "fifth")


def test_frames_label_the_step_that_they_name():
    checked = 0
    for frame in [*itertools.chain(*frames(unseen=False).values())]:
        for key, nth in SCOPE.findall(frame.text):
            named = len(frame.steps) - 1 if nth == "last" else NTH.index(nth)
            runs = [key in {call.name for call in step.calls()} for step in frame.steps]
            assert runs == [place == named for place in range(len(frame.steps))], frame.text
            checked += 1
    assert checked > 80


def test_frames_say_and_plan_the_same_slots():
    for unseen in (False, True):
        found = frames(unseen=unseen)
        assert sorted(found) == [0, 1, 2, 3, 4, 5]
        for frame in itertools.chain(*found.values()):
            said = {slot.key for slot in all_slots(frame.nodes)} - {"step"}
            assert said == {call.name for step in frame.steps for call in step.calls()} - {"Hold"}


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
