"""Legs by bearing and length, tracks run the other way, and waypoints at even distances."""

from __future__ import annotations

import itertools
from typing import Any

import pytest

from planner_ft.data.task import geometry as g
from planner_ft.decoding.constraints.reading.paths.legs import read_legs
from planner_ft.decoding.constraints.waypoints import read_ground
from planner_ft.vocabulary import load_vocabulary

VOCABULARY = load_vocabulary()
Points = list[tuple[float, float]]
CABLE = {"start": [40, -20], "heading": 120, "max_dist": 90}
FIRST, LAST = g.straight_line((40, -20), 120, 90)


def legs(start: tuple[float, float], *ways: tuple[float, float]) -> Points:
    return list(itertools.accumulate(ways, lambda at, way: g.offset(at, *way), initial=start))


def record(prompt: str, **parameters: Any) -> dict[str, Any]:
    return {"task": "SubseaCableTrack", "parameters": parameters, "prompt": prompt}


@pytest.mark.parametrize(
    ("prompt", "path"),
    [
        (
            (
                "The pipe leaves [5, 5], goes 40 m on 200, bends and runs a further 25 m on 250."
                " Follow it to the end."
            ),
            legs((5, 5), (200, 40), (250, 25)),
        ),
        (
            "You are lying at [5, 5]. Go 80 m on 045 and from there 30 m due south.",
            legs((5, 5), (45, 80), (180, 30))[1:],
        ),
        (
            "From home steer 270 for 50 m, then 000 for 20 m, then straight back home.",
            [(-50, 0), (-50, 20), (0, 0)],
        ),
        (
            "From the start: 60 m on a course of 100, then another 30 m on 190. Bow locked.",
            legs((40, -20), (100, 60), (190, 30)),
        ),
        (
            (
                "Dog-leg from [0, 0]: 70 m on 060, then alter course to 120 for 70 m. Detect rafts"
                " on both legs."
            ),
            legs((0, 0), (60, 70), (120, 70)),
        ),
        (
            "Start at [1, 2], run 10 m east, 20 m north and 10 m west.",
            [(1, 2), (11, 2), (11, 22), (1, 22)],
        ),
        (
            (
                "The cable begins at [0, 0], runs 30 m on 090 and 40 m on 000. Follow it there and"
                " back."
            ),
            [(0, 0), (30, 0), (30, 40), (30, 0), (0, 0)],
        ),
        (
            "The cable begins at [0, 0], runs 30 m on 090 and 40 m on 000. Do it from the far end.",
            [(30, 40), (30, 0), (0, 0)],
        ),
        (
            "The pipe goes from [0, 0] 50 m on 090. Take it in reverse and finish at [0, 0].",
            [(50, 0), (0, 0)],
        ),
    ],
)
def test_legs_follow_one_another(prompt: str, path: Points) -> None:
    assert read_legs(record(prompt, **CABLE), (0, 0)) == tuple(path)


@pytest.mark.parametrize(
    "prompt",
    [
        "From [0, 0] 30 m on 090, then 90 degrees to port and another 30 m.",
        "From [0, 0] 30 m on 090 and 40 m on 000, twice.",
        "Go to [0, 0], then [10, 0], then 30 m on 090 and 20 m on 000.",
        "From [0, 0] 30 m on 090, then 40 m on 000, then on to the pontoon.",
        "Turn to 090 and then to 180, 5 m clear of everything.",
        "From [0, 0] 30 m on 090.",
        "From x 0, y 0 to 50 m west, 20 m south.",
        "From [0, 0] two steps, each 30 m south and then 30 m east.",
    ],
)
def test_what_is_not_clear_is_not_read(prompt: str) -> None:
    assert read_legs(record(prompt, **CABLE), (0, 0)) is None


@pytest.mark.parametrize(
    ("prompt", "path"),
    [
        ("Do the cable in reverse: start at its far end and finish at the start.", [LAST, FIRST]),
        ("Run the planned track from the far end back to the start, sonar on.", [LAST, FIRST]),
        ("Follow the cable backwards, from its end to its start.", [LAST, FIRST]),
        ("Follow the cable to its end and back to the start again.", [FIRST, LAST, FIRST]),
        (
            "Follow the cable from the start with waypoints 30 m apart, both ends counted.",
            legs((40, -20), (120, 30), (120, 30), (120, 30)),
        ),
        (
            "The planned track, a stop at 45 m intervals, first and last one at the ends of it.",
            legs((40, -20), (120, 45), (120, 45)),
        ),
        (
            "Begin at [40, -20], course south, 60 m long, one waypoint every 20 m.",
            [(40, -20), (40, -40), (40, -60), (40, -80)],
        ),
    ],
)
def test_tracks_are_run_as_the_prompt_says(prompt: str, path: Points) -> None:
    assert read_ground(record(prompt, **CABLE), VOCABULARY).itinerary == tuple(path)
