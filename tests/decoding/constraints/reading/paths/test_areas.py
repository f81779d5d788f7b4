"""Areas told by corners, squares told by their sides, and squares that are run twice."""

from __future__ import annotations

from typing import Any

import pytest

from planner_ft.data.task import geometry as g
from planner_ft.decoding.constraints.ground import Ground
from planner_ft.decoding.constraints.waypoints import read_ground
from planner_ft.vocabulary import load_vocabulary

VOCABULARY = load_vocabulary()
Points = list[tuple[float, float]]


def ground(task: str, prompt: str, **parameters: Any) -> Ground:
    return read_ground({"task": task, "parameters": parameters, "prompt": prompt}, VOCABULARY)


def ways(ground: Ground) -> list[Points]:
    return (
        [list(ground.itinerary)]
        if ground.itinerary is not None
        else [list(path) for path in ground.paths]
    )


@pytest.mark.parametrize(
    ("prompt", "corner"),
    [
        (
            (
                "The box has its south-west corner at [-5, 0] and its north-east corner at [25,"
                " 40]. Lanes every 10 m."
            ),
            "south-west",
        ),
        (
            (
                "Opposite corners [-5, 0] and [25, 40], lanes north-south, 10 m between them,"
                " south-east corner first."
            ),
            "south-east",
        ),
        (
            (
                "Area with its south-west corner at [-5, 0], 30 m wide and 40 m long, lanes 10 m"
                " apart, start in the south-west corner."
            ),
            "south-west",
        ),
        (
            (
                "Sound a box with corners [-5, 0], [25, 0], [25, 40] and [-5, 40], lanes 10 m"
                " apart, north-south, from the north-west."
            ),
            "north-west",
        ),
        (
            (
                "Area from x = -5 to x = 25 and from y = 0 to y = 40, north-south lanes 10 m apart,"
                " south-west corner first."
            ),
            "south-west",
        ),
        (
            "Sound 0.03 km (width) by 0.04 km (length) about [10, 20], lane spacing 1000 cm.",
            "south-west",
        ),
    ],
)
def test_areas_by_corners(prompt: str, corner: g.Corner) -> None:
    assert ways(ground("BathymetryGridSurvey", prompt, center=[10, 20])) == [
        g.lawnmower((10, 20), 30, 40, 10, corner)
    ]


def test_area_around_home_and_square_area() -> None:
    assert ways(
        ground("BathymetryGridSurvey", "Mow 30 by 40 m around home, 10 m spacing.", center=[0, 0])
    ) == [g.lawnmower((0, 0), 30, 40, 10)]
    square = "A square of 40 m side length centred on [10, 20], to be sounded in lanes 10 m apart."
    assert ways(ground("BathymetryGridSurvey", square, center=[10, 20])) == [
        g.lawnmower((10, 20), 40, 40, 10)
    ]


@pytest.mark.parametrize(
    ("prompt", "path"),
    [
        (
            "Survey square round the tower at [7, 3] with sides of 24 m.",
            g.survey_square((7, 3), 12),
        ),
        (
            (
                "Survey square round [7, 3], each side 20 m long, clockwise from the north-west"
                " corner."
            ),
            g.survey_square((7, 3), 10, "north-west", clockwise=True),
        ),
        (
            "A square of 40 m side length round the pile at [7, 3], eight waypoints.",
            g.survey_square((7, 3), 20),
        ),
        ("Survey square round [7, 3] with a half side of 12 m.", g.survey_square((7, 3), 12)),
        (
            (
                "Survey square at 9 m round [7, 3]. At the three waypoints of the north side keep 5"
                " m of clearance."
            ),
            g.survey_square((7, 3), 9),
        ),
        (
            "Square round the wreck at [7, 3] clockwise, the first waypoint due south of it.",
            g.survey_square((7, 3), 9, "south", clockwise=True),
        ),
        (
            "Survey square round the target and back to its first waypoint.",
            [*g.survey_square((7, 3), 9), (16, 3)],
        ),
        (
            "Survey the target at 9 m, starting from the middle of the west side.",
            g.survey_square((7, 3), 9, "west"),
        ),
        (
            "Only the mid-side points of the square, starting in the north.",
            g.survey_square((7, 3), 9, "north")[::2],
        ),
        (
            "Two survey squares, one after the other: radius 9 m, then radius 15 m.",
            [*g.survey_square((7, 3), 9), *g.survey_square((7, 3), 15)],
        ),
        ("Go round the survey square twice.", g.survey_square((7, 3), 9) * 2),
        (
            "The square twice, first clockwise, then anticlockwise.",
            [*g.survey_square((7, 3), 9, clockwise=True), *g.survey_square((7, 3), 9)],
        ),
    ],
)
def test_squares(prompt: str, path: Points) -> None:
    assert ways(ground("SurveyTarget", prompt, target_position=[7, 3], radius=9)) == [path]
