"""Tasks that are handed down as a whole: their movement is that of the task, at its own place."""

from __future__ import annotations

import itertools
from typing import Any

import pytest

from planner_ft.data.task import geometry as g
from planner_ft.data.task.handed_down import handed_down_tasks
from planner_ft.decoding.constraints.reading.paths.own_movement import own_movement
from planner_ft.decoding.constraints.waypoints import read_ground
from planner_ft.vocabulary import load_vocabulary

VOCABULARY = load_vocabulary()
GRID = {"center": [40, 20], "width": 20, "length": 30, "spacing": 10}


def read(
    title: str, prompt: str, own: tuple[float, float] | None = None, **parameters: Any
) -> tuple[g.Point, ...] | None:
    return own_movement(
        prompt, parameters, g.point(*own) if own else None, VOCABULARY.task[title], VOCABULARY
    )


def test_a_grid_a_square_and_a_track_are_those_of_the_parameters() -> None:
    said = "Survey the depths around [40, 20] over 20 m by 30 m with lines 10 m apart."
    assert read("BathymetryGridSurvey", said, (40, 20), **GRID) == tuple(
        g.lawnmower((40, 20), 20, 30, 10)
    )
    inspect = "Inspect the red buoy at a stand-off of 8 m once it has been found."
    assert read("SurveyTarget", inspect, (5, 6), target_position=[5, 6], radius=8) == tuple(
        g.survey_square((5, 6), 8)
    )
    track = (
        "Track the cable by sonar from where it has been found on a heading of 90 degrees for at"
        " most 50 m."
    )
    assert read("SubseaCableTrack", track, (0, 10), start=[0, 10], heading=90, max_dist=50) == (
        (0, 10),
        (50, 10),
    )


def test_a_grid_whose_spacing_does_not_divide_its_width_has_the_lanes_that_fit() -> None:
    grid = {"center": [0, 0], "width": 40, "length": 30, "spacing": 12}
    lanes = read(
        "BathymetryGridSurvey",
        "Survey the depths around [0, 0] over 40 m by 30 m with lines 12 m apart.",
        (0, 0),
        **grid,
    )
    assert (
        lanes is not None
        and [x for x, _y in lanes] == [-20, -20, -8, -8, 4, 4, 16, 16]
        and lanes[0] == (-20, -15)
    )


def test_a_place_that_was_found_is_gone_to() -> None:
    assert read(
        "Transit", "Go to the barge once it has been found.", (7, -3), target_position=[7, -3]
    ) == ((7, -3),)
    assert read("Transit", "Return home to [0, 0].", (0, 0), target_position=[0, 0]) == ((0, 0),)


@pytest.mark.parametrize(
    "prompt",
    [
        "Circle the mast at [12, 30] at a stand-off of 25 m.",
        "Orbit the mast.",
        "Circle the barge Goedthorpe at [12, 30].",
    ],
)
def test_what_is_performed_on_site_has_no_waypoint(prompt: str) -> None:
    parameters = {"center": [12, 30], "radius": 25}
    assert read("PerformOrbit", prompt, (12, 30), **parameters) == ()
    ground = read_ground(
        {"task": "PerformOrbit", "parameters": parameters, "prompt": prompt}, VOCABULARY
    )
    assert ground.following(()) == [] and ground.ending(()) == "may", (
        "the vehicle is not sent into the mast"
    )


@pytest.mark.parametrize(
    "prompt",
    [
        "Survey the depths around [40, 20] over 20 m by 30 m with lines 11 m apart.",
        "Survey the depths around [41, 20] over 20 m by 30 m with lines 10 m apart.",
        (
            "Survey the depths around [40, 20] over 20 m by 30 m with lines 10 m apart, lanes"
            " east-west."
        ),
        "Survey the depths around [40, 20] with lines 10 m apart. Then go to [5, 5].",
        "Survey the depths 5 m north of [40, 20] with lines 10 m apart.",
        "Hold position.",
    ],
)
def test_what_says_more_or_something_else_is_left_to_other_readings(prompt: str) -> None:
    assert read("BathymetryGridSurvey", prompt, (40, 20), **GRID) is None


def test_home_is_no_other_place() -> None:
    assert read("Transit", "Go back to base.", (80, 5), target_position=[80, 5]) is None
    assert (
        read("Transit", "Come back to where you started.", (80, 5), target_position=[80, 5]) is None
    )


def test_tasks_of_synthetic_missions_are_read_right() -> None:
    seen = wrong = 0
    for record in itertools.islice(handed_down_tasks(VOCABULARY, 5), 600):
        steps = [step["navigation_skill"] for step in record["expected"]["skill_sequence"]]
        expected = tuple(
            (step["parameters"]["x"], step["parameters"]["y"])
            for step in steps
            if step["name"] == "GoToXY"
        )
        itinerary = read_ground(record, VOCABULARY).itinerary
        if itinerary is not None:
            seen += 1
            wrong += itinerary != expected
    assert seen > 300 and wrong <= seen * 0.01
