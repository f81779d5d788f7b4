"""Straight runs, cable tracks, passes along a face and ways off a place, as task inputs word
them.
"""

from __future__ import annotations

import itertools
from typing import Any

import pytest

from planner_ft.data.task.sampler import sample_tasks
from planner_ft.decoding.constraints.reading.paths.itinerary import read_itinerary
from planner_ft.decoding.constraints.reading.paths.runs import read_runs
from planner_ft.decoding.constraints.waypoints import read_ground
from planner_ft.vocabulary import load_vocabulary

VOCABULARY = load_vocabulary()
TRACK = {"start": [200, 100], "heading": 90, "max_dist": 300}
NORTH = {"side_id": "north", "length": 60, "distance": 12}


def runs(task: str, prompt: str, **parameters: Any) -> Any:
    return read_runs({"task": task, "prompt": prompt, "parameters": parameters}, VOCABULARY)


@pytest.mark.parametrize(
    ("prompt", "path"),
    [
        ("To the start, then along the heading for the full distance.", [(200, 100), (500, 100)]),
        (
            (
                "The cable both ways please: start point, down the heading to the end, then back to"
                " the start."
            ),
            [(200, 100), (500, 100), (200, 100)],
        ),
        (
            "Track it from the start with a waypoint every 100 m up to the maximum distance.",
            [(200, 100), (300, 100), (400, 100), (500, 100)],
        ),
        (
            "Other way round: begin at the far end of the cable and follow it back to the start.",
            [(500, 100), (200, 100)],
        ),
        (
            (
                "Go to the start at (200, 100), turn onto its bearing of 90, follow it 60 m and"
                " remain there."
            ),
            [(200, 100), (260, 100)],
        ),
        ("Run the planned track, then come home.", [(200, 100), (500, 100), (0, 0)]),
        (
            "Follow the cable on one-eight-zero for half a kilometre, beginning at [10, 20].",
            [(10, 20), (10, -480)],
        ),
    ],
)
def test_tracks_are_run_as_the_prompt_says(prompt: str, path: list[tuple[float, float]]) -> None:
    assert runs("SubseaCableTrack", prompt, **TRACK) == tuple(path)


def test_a_wall_that_is_only_run_along_has_no_stand_off() -> None:
    assert runs(
        "ParallelStructurePass", "Run parallel to the wall from (0, 30) to (90, 30).", **NORTH
    ) == ((0, 30), (90, 30))


@pytest.mark.parametrize(
    ("prompt", "path"),
    [
        (
            (
                "From home: two hundred metres due east, then one hundred metres due south, then"
                " direct to home again."
            ),
            [(200, 0), (200, -100), (0, 0)],
        ),
        ("Just out to the target position and straight back to home.", [(7, 8), (0, 0)]),
        ("Make for the spot 80 m north of the buoy at [75, 50].", [(75, 130)]),
        (
            (
                "Begin 30 m south of the pile at [40, -40] and then cross to the point 30 m west"
                " of it."
            ),
            [(40, -70), (10, -40)],
        ),
        (
            "Go to (20, 40) and from there run 60 m due east along the north face.",
            [(20, 40), (80, 40)],
        ),
        (
            "Go to [10, 10] and from there dead straight 100 m on bearing 045.",
            [(10, 10), (80.71, 80.71)],
        ),
        (
            (
                "From home steer due north, 4 knots for a quarter of an hour, and stay there ten"
                " minutes."
            ),
            [(0, 1852)],
        ),
        (
            (
                "Head for the position a quarter of a nautical mile due west of the lighthouse,"
                " which stands at [1000, 200]."
            ),
            [(537, 200)],
        ),
        (
            "Go to the waypoint one and a half kilometres east and 200 m north of home.",
            [(1500, 200)],
        ),
        ("Motor back up to [12, 8]. Float another five minutes.", [(12, 8)]),
        (
            (
                "To minus 20, 15, hold a minute, bow to 090, then on to [3, 4]; depth on the way to"
                " [3, 4]."
            ),
            [(-20, 15), (3, 4)],
        ),
        ("Approach [10, 20] from the south and stop 9 m off.", [(10, 11)]),
    ],
)
def test_legs_lead_from_place_to_place(prompt: str, path: list[tuple[float, float]]) -> None:
    assert runs("Transit", prompt, target_position=[7, 8]) == tuple(path)


@pytest.mark.parametrize(
    "prompt",
    [
        "Go to [3, 4]. Sorry, no, make that [5, 6].",
        "Go to [3, 4], but call at [5, 6] first.",
        "Before going to [3, 4], go to [5, 6].",
        "Hold position and watch the buoy at [3, 4].",
        "To the pump station and to [3, 4].",
        "Keep inside the box (0, 0), (9, 0), (9, 9), (0, 9) and drift for ten minutes.",
        "Run a zig-zag from [3, 4] to [50, 4].",
        "Turn to 90, then 180, and hold.",
        "If the wind is up go to [3, 4].",
        "Go to [3, 4] and from there 60 m on the usual course of 45 degrees or 90 degrees.",
    ],
)
def test_what_is_not_certain_is_not_read(prompt: str) -> None:
    assert runs("Transit", prompt, target_position=[7, 8]) is None


def _expected(record: dict[str, Any]) -> list[tuple[float, float]]:
    steps = [step["navigation_skill"] for step in record["expected"]["skill_sequence"]]
    return [
        (step["parameters"]["x"], step["parameters"]["y"])
        for step in steps
        if step["name"] == "GoToXY"
    ]


def test_what_is_read_of_sampled_inputs_is_expected() -> None:
    read = right = 0
    for record in itertools.islice(sample_tasks(VOCABULARY, 77, None, "train"), 500):
        if (
            read_itinerary(record, VOCABULARY) is None
            and not read_ground(record, VOCABULARY).shaped
        ):
            found = read_runs(record, VOCABULARY)
            read += found is not None
            right += found is not None and found == tuple(_expected(record))
    assert read >= 25
    # The fourth templates are hard on purpose: 56 of 61.
    assert right >= 0.9 * read


def test_two_ways_off_one_place_are_one_and_a_measured_point_is_no_place() -> None:
    assert runs(
        "Transit", "Go to the point 60 m south and 30 m west of (100, 50).", target_position=[1, 2]
    ) == ((70, -10),)
    assert (
        runs(
            "FollowTarget",
            "Keep the picture on it and work out how we lie with respect to target 4.",
            target_position=[1, 2],
        )
        is None
    )
