"""Skills that a sentence of their own asks for in every step."""

from __future__ import annotations

import pytest

from planner_ft.decoding.constraints.companions import read_companions
from planner_ft.decoding.constraints.reading.telegrams import in_small_letters
from planner_ft.vocabulary import load_vocabulary

VOCABULARY = load_vocabulary()
TWO = ["GoToXY", "StationKeep"]


@pytest.mark.parametrize(
    ("text", "skill"),
    [
        (
            (
                "Go to (10, 20), then hold for two minutes. Rate the usability of the picture on"
                " the stern camera."
            ),
            "GetImageQualityMetrics",
        ),
        (
            (
                "Go to (10, 20), then hold for two minutes. Five metres minimum to any obstacle,"
                " please."
            ),
            "ObstacleAvoidance",
        ),
        (
            "Go to (10, 20), then hold for two minutes. Meanwhile the tracker follows tug 4.",
            "TrackObjects",
        ),
        (
            "GO TO (10, 20) STOP THEN HOLD TWO MINUTES STOP LOG ENVIRONMENT STOP",
            "LogEnvironmentState",
        ),
    ],
)
def test_what_a_sentence_behind_the_movements_asks_for_runs_in_every_step(
    text: str, skill: str
) -> None:
    companions = read_companions({"prompt": in_small_letters(text)}, VOCABULARY)
    assert skill in companions.asked
    assert [companions.runs(skill, name, TWO[:number]) for number, name in enumerate(TWO)] == [
        True,
        True,
    ]


@pytest.mark.parametrize(
    ("text", "skill"),
    [
        ("Go to (10, 20), then hold for two minutes. Horizon tilt last.", "GetHorizonAngle"),
        ("Go to (10, 20). Depth soundings. Then hold for two minutes.", "GetSeabedDepth"),
        (
            (
                "Go to (10, 20), then hold for two minutes. Lens check of the bow camera. That goes"
                " for the hold."
            ),
            "CheckLensClearness",
        ),
        ("Out to (10, 20) and home. Soundings out, environment snapshots back.", "GetSeabedDepth"),
    ],
)
def test_a_sentence_that_may_say_where_is_not_read(text: str, skill: str) -> None:
    companions = read_companions({"prompt": text}, VOCABULARY)
    assert (
        companions.runs(skill, "GoToXY", []) is not True
        or companions.runs(skill, "StationKeep", ["GoToXY"]) is not True
    )
