"""Rows of movements in other plain words, with chatter around them."""

from __future__ import annotations

from typing import Any

import pytest

from planner_ft.decoding.constraints.reading.rows.sequence import read_sequence
from planner_ft.decoding.constraints.reading.rows.sequence_clauses import Movement
from planner_ft.vocabulary import load_vocabulary

VOCABULARY = load_vocabulary()
SHORT = {
    "GoToXY": "go",
    "StationKeep": "hold",
    "RotateToHeading": "to",
    "NudgeYaw": "by",
    "ArcTurn": "arc",
    "DriftWithCurrent": "drift",
    "WaitForStability": "wait",
    "VisualStationKeep": "see",
}
NAMES = {"heading": "h", "delta_yaw": "a", "radius": "r", "time": "t", "threshold": "d"}


def read(prompt: str, task: str = "Transit", **parameters: Any) -> str | None:
    """The movements in short: "go 4 5; hold r 3 t 60"."""
    found = read_sequence({"task": task, "prompt": prompt, "parameters": parameters}, VOCABULARY)

    def said(one: Movement) -> str:
        return " ".join(
            [
                SHORT[one.name],
                *(
                    f"{NAMES.get(name, '')} {value:g}".strip()
                    for name, value in sorted(one.values.items())
                ),
            ]
        )

    return None if found is None else "; ".join(map(said, found))


@pytest.mark.parametrize(
    ("prompt", "movements"),
    [
        ("Stop the engines for six minutes, then motor back to [8, 3].", "drift t 360; go 8 3"),
        ("Float free for three minutes, engines off.", "drift t 180"),
        (
            "Wait till pitch and roll are under 3 degrees, cut the motors for five minutes.",
            "wait d 3; drift t 300",
        ),
        (
            "Wait for stability, threshold 1.5 degrees, 40 seconds. Then hold.",
            "wait d 1.5 t 40; hold",
        ),
        (
            "Hold until pitch and roll drop below 0.05 radians, then face north.",
            "wait d 2.86; to h 0",
        ),
        ("Give her a minute to settle, then turn to 80.", "wait; to h 80"),
        ("Let the ebb carry her for six minutes, then hold for two.", "drift t 360; hold t 120"),
        (
            "Spend four minutes at [2, 2], then six at [9, 9].",
            "go 2 2; hold t 240; go 9 9; hold t 360",
        ),
    ],
)
def test_drifts_and_waits(prompt: str, movements: str) -> None:
    assert read(prompt) == movements


@pytest.mark.parametrize(
    ("prompt", "movements"),
    [
        (
            "Downstream to [5, -60] if you please. Hold there a minute so Lena can take a sample.",
            "go 5 -60; hold t 60",
        ),
        ("Stand in to [7, 2] and wait until she is steady.", "go 7 2; wait"),
        ("You are lying at [0, 4]. Go to [9, 4], then hold.", "go 9 4; hold"),
        ("From your mooring at [3, 3] run to [9, 9], turn to 10.", "go 9 9; to h 10"),
        (
            "Go to [4, 4], drift for a minute, and when that is done go to [4, 4] again.",
            "go 4 4; drift t 60; go 4 4",
        ),
        ("Hold for a minute. Having held it, go to [6, 6].", "hold t 60; go 6 6"),
        (
            (
                "Before you hold station for two minutes, turn to the south. Having held it, nudge"
                " her five degrees to port."
            ),
            "to h 180; hold t 120; by a -5",
        ),
        (
            (
                "Base to boat. Wind's backing and the ferry leaves at 12:30. Go to [8, 8], hold two"
                " minutes. Out."
            ),
            "go 8 8; hold t 120",
        ),
        ("Stay where you are and watch from here for nine minutes.", "hold t 540"),
    ],
)
def test_going_and_holding(prompt: str, movements: str) -> None:
    assert read(prompt) == movements


@pytest.mark.parametrize(
    ("prompt", "movements"),
    [
        ("Visit [3, 3] and [4, 9], holding 30 s at each.", "go 3 3; hold t 30; go 4 9; hold t 30"),
        (
            (
                "Three traps: [1, 5], [2, 5], [3, 5]. At each of them hold 40 s. After the third,"
                " home."
            ),
            "go 1 5; hold t 40; go 2 5; hold t 40; go 3 5; hold t 40; go 0 0",
        ),
        (
            "Go to [3, 3] and [9, 3]. At each stop wait until she is steady, then hold for 30 s.",
            "go 3 3; wait; hold t 30; go 9 3; wait; hold t 30",
        ),
    ],
)
def test_what_is_done_at_every_place(prompt: str, movements: str) -> None:
    assert read(prompt) == movements


@pytest.mark.parametrize(
    ("prompt", "movements"),
    [
        (
            "Come left to 200, then thirty degrees to the right, then face 010.",
            "to h 200; by a 30; to h 10",
        ),
        (
            "Turn to 020, then two nudges of 15 degrees clockwise, and stay for a minute.",
            "to h 20; by a 15; by a 15; hold t 60",
        ),
        (
            "Face 100; from there all the way round counter-clockwise in four equal nudges.",
            "to h 100; by a -90; by a -90; by a -90; by a -90",
        ),
        ("Nudge 10 degrees to port twice, then hold a minute.", "by a -10; by a -10; hold t 60"),
        ("Pan left, three times, twenty degrees a time.", "by a -20; by a -20; by a -20"),
        (
            "Turn onto the reciprocal of 060, hold a minute, then onto 060 itself.",
            "to h 240; hold t 60; to h 60",
        ),
        ("Bring her through north to 015 and then hold ten seconds.", "to h 15; hold t 10"),
        (
            (
                "Rotate eight degrees to port, wait till she is stable, rotate six more, same"
                " direction."
            ),
            "by a -8; wait; by a -6",
        ),
        (
            "Nudge 10 degrees to port, hold 20 s, then 15 degrees in the opposite direction.",
            "by a -10; hold t 20; by a 15",
        ),
    ],
)
def test_turns(prompt: str, movements: str) -> None:
    assert read(prompt) == movements


@pytest.mark.parametrize(
    ("prompt", "movements"),
    [
        ("Arc turn to the left, one hundred degrees, twenty metres radius.", "arc a -100 r 20"),
        (
            "After that an arc, 15 m radius, 60 degrees, also to starboard. Then [7, 7].",
            "arc a 60 r 15; go 7 7",
        ),
        (
            (
                "Anticlockwise arc turn, 90 degrees, at the radius given; hold a minute; then a"
                " further 90 degrees the same way at the same radius."
            ),
            "arc a -90 r 12; hold t 60; arc a -90 r 12",
        ),
        (
            (
                "Make a sweeping turn to port, three quarters of a full circle, with the ordered"
                " radius."
            ),
            "arc a -270 r 12",
        ),
        (
            "Keep station for the ordered time in an 8 metre circle, then turn to 90.",
            "hold r 8 t 600; to h 90",
        ),
        (
            "Turn to 0 and 120. Upon every heading hold for the wait that is set.",
            "to h 0; hold t 15; to h 120; hold t 15",
        ),
    ],
)
def test_arcs_and_the_task_s_own_values(prompt: str, movements: str) -> None:
    assert read(prompt, radius=12, duration=600, wait=15) == movements


def test_a_sweeping_turn_alone_has_no_values() -> None:
    assert read("Make a sweeping turn, wait for stability, then hold.") == "arc; wait; hold"


@pytest.mark.parametrize(
    "prompt",
    [
        "Check the lens of the mast camera and the horizon angle, please.",
        "Register the observation float 7 adrift and drop a pin labelled turn buoy.",
        "Pre-survey check: picture quality, position fix. The ferry comes in ten minutes.",
    ],
)
def test_a_task_on_station_that_names_no_movement_is_a_hold(prompt: str) -> None:
    assert read(prompt, "Diagnostics") == "hold"
    assert read(prompt, "Transit") is None


@pytest.mark.parametrize(
    "prompt",
    [
        "Log the environment for ten minutes.",
        "Check the lens, then turn a bit to port.",
        "See to it that you log the depth the whole time you aim the nose.",
        "Go to [4, 4]. Hold for six minutes or for ten.",
        "From [4, 4] go to the buoy.",
        "Hold until the motion is low or 14:30.",
    ],
)
def test_what_is_not_certain_is_left_open(prompt: str) -> None:
    assert read(prompt, "Diagnostics") is None
