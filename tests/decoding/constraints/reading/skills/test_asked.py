"""Movements that an input asks for beyond doubt."""

from __future__ import annotations

import itertools

import pytest

from planner_ft.data.task.sampler import sample_tasks
from planner_ft.decoding.constraints.reading.skills.asked import asked_movements
from planner_ft.vocabulary import load_vocabulary

VOCABULARY = load_vocabulary()


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("Go to the buoy, then stay there for two and a half minutes.", {"StationKeep"}),
        ("A quarter of an hour on station at the end.", {"StationKeep"}),
        ("Hold position inside a circle of 4 m.", {"StationKeep"}),
        ("Turn to 090 and hlod for 20 secnds.", {"StationKeep"}),
        ("Hold position visually on the red float.", {"VisualStationKeep"}),
        (
            "Keep the ladder centred in the frame and let her settle first.",
            {"VisualStationKeep", "WaitForStability"},
        ),
        ("Wait there until pitch and roll are steady below 3 degrees.", {"WaitForStability"}),
        (
            "Drift for ten minutes, then an arc of 90 degrees to port.",
            {"DriftWithCurrent", "ArcTurn"},
        ),
        ("Send the drift log within 30 s.", set()),
        ("Do not hold for 20 s there; go straight on.", set()),
        ("Rather than drifting for 5 minutes, go home.", set()),
        ("If she rolls, wait until she is steady.", set()),
        ("Hold the heading while you run to [5, 5].", set()),
    ],
)
def test_plain_wordings_are_read_and_what_is_ruled_out_is_not(
    text: str, expected: set[str]
) -> None:
    assert asked_movements(text, VOCABULARY) == expected


def test_hardly_a_sample_is_asked_for_a_movement_that_it_has_not() -> None:
    said = wrong = 0
    for record in itertools.islice(sample_tasks(VOCABULARY, 717, None, "train"), 400):
        labelled = {
            step["navigation_skill"]["name"] for step in record["expected"]["skill_sequence"]
        }
        asked = asked_movements(record["prompt"], VOCABULARY)
        said, wrong = said + len(asked), wrong + len(asked - labelled)
    assert said > 60 and wrong <= 1
