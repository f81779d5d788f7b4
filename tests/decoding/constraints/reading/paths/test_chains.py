"""Places, legs and returns, from a place or from where the vehicle lies."""

from __future__ import annotations

import itertools
from typing import Any

import pytest

from planner_ft.data.task import geometry as g
from planner_ft.decoding.constraints.reading.paths.chains import read_chain
from planner_ft.decoding.constraints.waypoints import read_ground
from planner_ft.vocabulary import load_vocabulary

VOCABULARY = load_vocabulary()
Points = list[tuple[float, float]]


def legs(start: tuple[float, float], *ways: tuple[float, float]) -> Points:
    return list(itertools.accumulate(ways, lambda at, way: g.offset(at, *way), initial=start))


def record(prompt: str, **parameters: Any) -> dict[str, Any]:
    return {"task": "Transit", "parameters": parameters, "prompt": prompt}


@pytest.mark.parametrize(
    ("prompt", "path"),
    [
        (
            (
                "You lie at [8, 2]. 50 m on bearing 090, 20 m on bearing 000, then straight back to"
                " the point you left."
            ),
            [(58, 2), (58, 22), (8, 2)],
        ),
        ("You are at [8, 2]. Go 70 m on 270 and come straight back.", [(-62, 2), (8, 2)]),
        (
            "From [8, 2], your present position, 60 m on bearing 000, then go to [30, 80].",
            [(8, 62), (30, 80)],
        ),
        (
            "Three legs from where you lie, [8, 2]: 10 m on 090, 10 m on 000, 10 m on 270.",
            [(18, 2), (18, 12), (8, 12)],
        ),
        (
            (
                "The boat is moored at [8, 2]. Take it 60 m on 090, then 25 m on 180, and bring it"
                " straight back to its berth."
            ),
            [(68, 2), (68, -23), (8, 2)],
        ),
        (
            (
                "Go to [8, 2], from that point run 30 m east along the pontoon, then the same line"
                " back to where the run began."
            ),
            [(8, 2), (38, 2), (8, 2)],
        ),
        (
            (
                "Go to [8, 2]. From there run 90 m on bearing 000 and return to [8, 2] along the"
                " same line."
            ),
            [(8, 2), (8, 92), (8, 2)],
        ),
        (
            "[8, 2] first, then 50 m on course 180, then half of that back along the same line.",
            [(8, 2), (8, -48), (8, -23)],
        ),
        (
            (
                "From your berth at [8, 2] go to [40, 9], hold there for a minute, then back to"
                " [8, 2]."
            ),
            [(40, 9), (8, 2)],
        ),
        (
            "Expanding square from [8, 2]: 20 m east, 20 m south, 40 m west.",
            [(8, 2), (28, 2), (28, -18), (-12, -18)],
        ),
        ("Datum is [8, 2], go there. Then 20 m north and 30 m east.", [(8, 2), (8, 22), (38, 22)]),
        (
            "Start [8, 2], end [8, 90], and straight back to where the run began.",
            [(8, 2), (8, 90), (8, 2)],
        ),
        (
            "3 legs from [8, 2] (u r there): 40m on 090, 40m on 000, 40m on 270. drop the last one",
            [(48, 2), (48, 42)],
        ),
        (
            (
                "To the pipe's start at [8, 2], then run 20 m in a straight line on bearing 090. On"
                " that run, not before it, sonar on."
            ),
            [(8, 2), (28, 2)],
        ),
    ],
)
def test_legs_and_returns(prompt: str, path: Points) -> None:
    assert read_chain(record(prompt), (0, 0)) == tuple(path)
    assert read_ground(record(prompt), VOCABULARY).itinerary == tuple(path)


@pytest.mark.parametrize(
    "prompt",
    [
        (
            "The boat lies at [8, 2]. Point the bow at the front light, [40, 50]; after that at the"
            " rear one, [8, 90]."
        ),
        "The berth begins at [8, 2] and goes 50 m on 180. Stay 8 m to the right of it.",
        "From home: out 25 m south, then 12 west, and back to the start.",
        "Head for 68 metres east 200 metres south, then [3, 4].",
        "The line from [8, 2] to [50, 9], shifted 7 m south, is where you run.",
        "From [8, 2] 20 m on 030 and twenty metres further on the same heading.",
        "Go to [8, 2] and from there 60 m due east, then 90 degrees to port and another 60 m.",
    ],
)
def test_what_is_not_clear_is_not_read(prompt: str) -> None:
    assert read_chain(record(prompt), (0, 0)) is None


@pytest.mark.parametrize(
    "scope",
    [
        "not on the way to its start",
        "on the run to the start too",
        "while going to the start as well",
    ],
)
def test_the_way_to_the_start_is_no_return(scope: str) -> None:
    prompt = (
        f"Go to [8, 2] and from there run 60 m due east. Save LiDAR slices on the run, {scope}."
    )
    assert read_ground(record(prompt), VOCABULARY).itinerary == ((8, 2), (68, 2))


@pytest.mark.parametrize(
    "prompt",
    [
        (
            "The wall runs from [0, 0] due north to [0, 60]. Run its whole length 5 m off on the"
            " east side, south to north."
        ),
        (
            "The pier goes from [0, 0] north to [0, 60]. Run along it 5 m off on the east side,"
            " from south to north."
        ),
    ],
)
def test_a_direction_between_two_ends_adds_nothing(prompt: str) -> None:
    assert read_ground(record(prompt), VOCABULARY).itinerary == ((5, 0), (5, 60))


def test_cables_are_lengths() -> None:
    assert read_ground(
        record("Half a cable north of [8, 2], hold there."), VOCABULARY
    ).itinerary == ((8, 94.6),)


@pytest.mark.parametrize(
    ("prompt", "alone"),
    [
        ("Go to [8, 2], saving the LiDAR sweep at angle 45.", True),
        ("Go to the mooring dolphin at [8, 2].", True),
        ("Go to [8, 2] and turn to 045.", False),
    ],
)
def test_words_of_other_movements_in_other_senses(prompt: str, alone: bool) -> None:
    assert read_ground(record(prompt), VOCABULARY).alone is alone
