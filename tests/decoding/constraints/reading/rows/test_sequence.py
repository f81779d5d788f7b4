"""All movements of an input that is nothing but movements in plain words."""

from __future__ import annotations

import itertools
import time
from typing import Any

import pytest

from planner_ft.data.task.sampler import sample_tasks
from planner_ft.decoding.constraints.reading.rows.sequence import agreed, read_sequence
from planner_ft.decoding.constraints.reading.rows.sequence_clauses import Movement
from planner_ft.vocabulary import load_vocabulary

VOCABULARY = load_vocabulary()
SHORT = {
    "go": "GoToXY",
    "hold": "StationKeep",
    "to": "RotateToHeading",
    "by": "NudgeYaw",
    "arc": "ArcTurn",
    "drift": "DriftWithCurrent",
    "wait": "WaitForStability",
    "see": "VisualStationKeep",
}
NAMES = {"heading": "h", "delta_yaw": "a", "radius": "r", "time": "t"}


def read(prompt: str, task: str = "KeepStation", **parameters: Any) -> str | None:
    """The movements in short: "go 4 5; hold r 3 t 60"."""
    found = read_sequence({"task": task, "prompt": prompt, "parameters": parameters}, VOCABULARY)
    called = {name: short for short, name in SHORT.items()}

    def said(one: Movement) -> str:
        values = [
            f"{NAMES.get(name, '')} {value:g}".strip()
            for name, value in sorted(one.values.items(), key=lambda item: item[0])
        ]
        return " ".join([called[one.name], *values])

    return None if found is None else "; ".join(map(said, found))


@pytest.mark.parametrize(
    ("prompt", "movements"),
    [
        (
            "Go to [12, 8], turn to 140, hold there for six minutes in a 4 m circle.",
            "go 12 8; to h 140; hold r 4 t 360",
        ),
        (
            "Move in to [3, 9] with a yaw of 45 on arrival and keep station for 90 s.",
            "go 3 9 45; hold t 90",
        ),
        (
            "Engines off, drift for ten minutes. Then motor back to [0, 30] and hold.",
            "drift t 600; go 0 30; hold",
        ),
        (
            "Sail to [5, 5]; let her settle; keep the yellow ring in the middle of the frame.",
            "go 5 5; wait; see",
        ),
        (
            (
                "Turn to south-west, wait until pitch and roll are below 2 degrees, then nudge 10"
                " degrees to port."
            ),
            "to h 225; wait 2; by a -10",
        ),
        (
            "Make for [1, 2], [1, 22] and [31, 22] one after another, then go home.",
            "go 1 2; go 1 22; go 31 22; go 0 0",
        ),
        ("Keep station within 3 m for a minute and three quarters.", "hold r 3 t 105"),
        ("Hold for two minutes at [6, -6], then return home.", "go 6 -6; hold t 120; go 0 0"),
        ("Go to [30, 30] via [10, 10], then hold.", "go 10 10; go 30 30; hold"),
        ("Stay here for an hour and keep within 5 metres.", "hold r 5 t 3600"),
        (
            "Hold here for a minute, turn to 100, hold another two minutes.",
            "hold t 60; to h 100; hold t 120",
        ),
        (
            "Face north for ten seconds, then east for twenty seconds.",
            "to h 0; hold t 10; to h 90; hold t 20",
        ),
        ("Turn to 080, hold 20 s, turn to the reciprocal bearing.", "to h 80; hold t 20; to h 260"),
    ],
)
def test_movements_are_read_in_their_order(prompt: str, movements: str) -> None:
    assert read(prompt) == movements


@pytest.mark.parametrize(
    ("prompt", "movements"),
    [
        (
            (
                "An arc of 80 degrees to port and one of 50 degrees to starboard, radius 12 m for"
                " both."
            ),
            "arc a -80 r 12; arc a 50 r 12",
        ),
        (
            (
                "A sweeping turn, 120 degrees clockwise on a 15 m radius, then 20 degrees to port"
                " on the spot."
            ),
            "arc a 120 r 15; by a -20",
        ),
        (
            "Quarter turn to port, wait until steady, half turn to starboard.",
            "by a -90; wait; by a 180",
        ),
        (
            "Four points to starboard, hold ten seconds, then two points to port.",
            "by a 45; hold t 10; by a -22.5",
        ),
        ("Pan: 15 left, 30 right, 15 left.", "by a -15; by a 30; by a -15"),
        ("Come to 120 and pan: 20 left, 40 right.", "to h 120; by a -20; by a 40"),
    ],
)
def test_turns_and_arcs(prompt: str, movements: str) -> None:
    assert read(prompt) == movements


@pytest.mark.parametrize(
    ("prompt", "movements"),
    [
        (
            "Turn to 30, 150 and 270. After each turn hold for 8 s.",
            "to h 30; hold t 8; to h 150; hold t 8; to h 270; hold t 8",
        ),
        (
            "Go to [4, 4]. Turn to 10, 130 and 250, holding five seconds on each heading.",
            "go 4 4; to h 10; hold t 5; to h 130; hold t 5; to h 250; hold t 5",
        ),
        (
            (
                "Turn to the cardinal points clockwise, starting with south. On every heading wait"
                " until she is steady."
            ),
            "to h 180; wait; to h 270; wait; to h 0; wait; to h 90; wait",
        ),
    ],
)
def test_what_is_done_after_every_turn(prompt: str, movements: str) -> None:
    assert read(prompt) == movements


@pytest.mark.parametrize(
    ("prompt", "movements"),
    [
        (
            (
                "Go to [10, 0] and turn to 090 there. But before you head there: go to [0, -10] and"
                " drift for two minutes."
            ),
            "go 0 -10; drift t 120; go 10 0; to h 90",
        ),
        ("Before you go to [4, 5], hold for 20 seconds.", "hold t 20; go 4 5"),
        ("Hold for 30 s before going to [7, 7].", "hold t 30; go 7 7"),
    ],
)
def test_what_comes_before(prompt: str, movements: str) -> None:
    assert read(prompt) == movements


@pytest.mark.parametrize(
    ("prompt", "movements"),
    [
        (
            (
                "Split the half hour: hold the first ten minutes within 3 m, turn to 90, hold the"
                " other twenty minutes within 6 m."
            ),
            "hold r 3 t 600; to h 90; hold r 6 t 1200",
        ),
        (
            (
                "Split the thirty minutes: hold the first ten within 3 m, turn to 90, and hold the"
                " other twenty within 6 m."
            ),
            "hold r 3 t 600; to h 90; hold r 6 t 1200",
        ),
        (
            (
                "Go to [1, 1] and hold there for half the time, then over to [9, 1] and hold for"
                " the rest."
            ),
            "go 1 1; hold t 900; go 9 1; hold t 900",
        ),
        (
            (
                "Two holds of five minutes, radius 4 both times, and between them 30 degrees to"
                " port on the spot."
            ),
            "hold r 4 t 300; by a -30; hold r 4 t 300",
        ),
    ],
)
def test_shared_times_and_radii(prompt: str, movements: str) -> None:
    assert read(prompt, duration=1800) == movements


@pytest.mark.parametrize(
    ("prompt", "movements"),
    [
        (
            "Go to [8, 8], then hold a minute. Check the lens of the bow camera in the hold only.",
            "go 8 8; hold t 60",
        ),
        (
            (
                "Hold ten minutes within 5 m of the spot, save the last 30 s of the buffer, 6 m"
                " clearance at all times."
            ),
            "hold r 5 t 600",
        ),
        (
            (
                "Turn to 200. On the turn measure the sector distance at bearing 5. Then drift five"
                " minutes."
            ),
            "to h 200; drift t 300",
        ),
        (
            (
                "With the heading locked go to [3, 3]. Stay inside the fence (0, 0), (9, 0), (9,"
                " 9), (0, 9) at all times."
            ),
            "go 3 3",
        ),
    ],
)
def test_what_runs_beside_the_movements_says_nothing(prompt: str, movements: str) -> None:
    assert read(prompt) == movements


@pytest.mark.parametrize(
    "prompt",
    [
        "Go 40 m north of [5, 5], then hold.",
        "Survey the area around [5, 5], then hold for a minute.",
        "Go to [5, 5] and back again.",
        "Turn to 90 three times.",
        "Hold for a minute after you have been at [4, 4], or longer if the current allows.",
        "Do not hold at [4, 4].",
        "Keep the camera on the buoy, then hold for a minute.",
        "Of [4, 4] and [8, 8] take the last one first.",
        "Nudge 10 degrees left. Actually that's too much, 15 is plenty.",
        "Go to [7, 7], bow 90.",
    ],
)
def test_what_may_be_meant_otherwise_is_left_open(prompt: str) -> None:
    assert read(prompt) is None


def test_waypoints_of_another_reading_make_it_uncertain() -> None:
    found = read_sequence({"prompt": "Go to [4, 5], then hold.", "parameters": {}}, VOCABULARY)
    assert found is not None
    assert agreed(found, ((4.0, 5.0),), VOCABULARY) == agreed(found, None, VOCABULARY) == found
    assert agreed(found, ((4.0, 6.0),), VOCABULARY) is None
    assert agreed((Movement("StationKeep", {"radius": 5000.0}),), None, VOCABULARY) is None


def test_sampled_inputs() -> None:
    """Of those that are read the most are as labelled: all but about 2 in a hundred."""
    right, wrong = 0, []
    for record in itertools.islice(sample_tasks(VOCABULARY, 606, None, "train"), 250):
        found = read_sequence(record, VOCABULARY)
        if found is None:
            continue
        label = [
            (step["navigation_skill"]["name"], step["navigation_skill"]["parameters"])
            for step in record["expected"]["skill_sequence"]
        ]
        same = [one.name for one in found] == [name for name, _values in label]
        same = same and all(
            one.free or dict(one.values) == values
            for one, (_name, values) in zip(found, label, strict=True)
        )
        right, wrong = right + same, wrong if same else [*wrong, record["prompt"]]
    assert right >= 25
    assert len(wrong) <= 2, wrong


def test_long_prompts_are_read_quickly() -> None:
    for prompt in (
        "Keep the red buoy and the green one " * 28,
        "hold and " * 110,
        "1 minute 2 " * 90,
        "with a clearance of " * 50,
        "turn to the " * 80,
    ):
        read(prompt)
        began = time.perf_counter()
        read(prompt + ".")
        assert time.perf_counter() - began < 0.5
