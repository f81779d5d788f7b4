"""Parts of a task's grid or square, halfway points, and faces with the way to where a pass
begins.
"""

from __future__ import annotations

from typing import Any

import pytest

from planner_ft.data.task import geometry as g
from planner_ft.decoding.constraints.reading.paths.faces import read_faces
from planner_ft.decoding.constraints.reading.paths.lanes import read_lanes
from planner_ft.decoding.constraints.waypoints import read_ground
from planner_ft.vocabulary import load_vocabulary

VOCABULARY = load_vocabulary()
GRID = {"center": [0, 0], "width": 20, "length": 30, "spacing": 5}
SQUARE = {"target_position": [10, 20], "radius": 8}
TRACK = {"start": [0, 0], "heading": 90, "max_dist": 60}
WALL = {"side_id": "north", "length": 40, "distance": 6}
LANES = g.lawnmower((0, 0), 20, 30, 5)
RING = g.survey_square((10, 20), 8)
HOME = (0, 0)


def record(task: str, prompt: str, parameters: dict[str, Any]) -> dict[str, Any]:
    return {"task": task, "parameters": parameters, "prompt": prompt}


@pytest.mark.parametrize(
    ("prompt", "path"),
    [
        ("Run only the first two lanes of the grid, then come home.", [*LANES[:4], HOME]),
        ("Do just the first three lanes.", LANES[:6]),
        ("Run the grid, but stop after the fourth lane.", LANES[:8]),
        ("Run the grid but leave out the last lane.", LANES[:8]),
        (
            (
                "Time is short: of the planned grid take only the first three lanes and head home."
                " No depth on the way home."
            ),
            [*LANES[:6], HOME],
        ),
        ("Run the grid. Depths on the first two lanes only.", LANES),
    ],
)
def test_some_lanes(prompt: str, path: list[g.Point]) -> None:
    ground = read_ground(record("BathymetryGridSurvey", prompt, GRID), VOCABULARY)
    assert (ground.itinerary or ground.paths[0]) == tuple(path)


@pytest.mark.parametrize(
    ("prompt", "path"),
    [
        (
            "Corners of the survey square only, from the south-west clockwise.",
            [(2, 12), (2, 28), (18, 28), (18, 12)],
        ),
        (
            (
                "Only the four corners of the square: north-west first, then north-east, south-east"
                " and south-west."
            ),
            [(2, 28), (18, 28), (18, 12), (2, 12)],
        ),
        ("Run the square without the mid-sides.", [(18, 28), (2, 28), (2, 12), (18, 12)]),
        (
            "Visit just the north-east corner, then the middle of the south side.",
            [(18, 28), (10, 12)],
        ),
        (
            "Run the survey square and close it at the first waypoint, then return home.",
            [*RING, RING[0], HOME],
        ),
        (
            (
                "Survey square round the target. At the corners take a still, at the mid-sides only"
                " read the depth."
            ),
            RING,
        ),
        ("Survey square. At each corner take a still from the mast camera.", RING),
    ],
)
def test_points_of_a_square(prompt: str, path: list[g.Point]) -> None:
    ground = read_ground(record("SurveyTarget", prompt, SQUARE), VOCABULARY)
    assert (ground.itinerary or ground.paths[0]) == tuple(path)


@pytest.mark.parametrize(
    ("task", "prompt", "parameters", "path"),
    [
        (
            "SubseaCableTrack",
            (
                "From the start go to the halfway point of the track, hold there for a minute, then"
                " go on to its end."
            ),
            TRACK,
            [(0, 0), (30, 0), (60, 0)],
        ),
        (
            "SubseaCableTrack",
            "Run half the maximum distance along the heading and stop there.",
            TRACK,
            [(0, 0), (30, 0)],
        ),
        (
            "Transit",
            "From [2, 4] run to the target position with a stop of a minute halfway.",
            {"target_position": [8, 4]},
            [(2, 4), (5, 4), (8, 4)],
        ),
        (
            "Transit",
            (
                "Three evenly spaced stations on the line from [2, 4] to the target position, ends"
                " included."
            ),
            {"target_position": [8, 4]},
            [(2, 4), (5, 4), (8, 4)],
        ),
        (
            "Transit",
            "Begin at [0, 0] and go 20 m south-west of it.",
            {"target_position": [8, 4]},
            [(0, 0), (-14.14, -14.14)],
        ),
    ],
)
def test_halfway(task: str, prompt: str, parameters: dict[str, Any], path: list[g.Point]) -> None:
    assert read_ground(record(task, prompt, parameters), VOCABULARY).itinerary == tuple(path)


@pytest.mark.parametrize(
    ("prompt", "path"),
    [
        (
            (
                "The quay lies along y = 10 from x = 0 to x = 40. On its north side go to the east"
                " end, then run along to the west end."
            ),
            [(40, 16), (0, 16)],
        ),
        (
            (
                "The mole runs along x = 5 from y = 0 to y = 40. Two runs on its east side:"
                " northbound at 4 m off, southbound at 9 m off."
            ),
            [(9, 0), (9, 40), (14, 40), (14, 0)],
        ),
        (
            (
                "Dam wall on x = 5, y from 0 to 40. Off its west side I want two runs: southbound"
                " at 3 m off, then northbound at 6 m off. Film it on the southbound run only, not"
                " on the way to its start. Nothing on the northbound one."
            ),
            [(2, 40), (2, 0), (-1, 0), (-1, 40)],
        ),
        (
            (
                "Pier along x = 5 between y = 0 and y = 40. Keep 7 m off on the west side: go to"
                " its south end, then follow it to its north end."
            ),
            [(-2, 0), (-2, 40)],
        ),
    ],
)
def test_faces(prompt: str, path: list[g.Point]) -> None:
    assert read_faces(record("ParallelStructurePass", prompt, WALL)) == tuple(path)


def test_a_corner_right_behind_the_lanes() -> None:
    assert read_lanes("East-west lanes from the north-west corner.") == ("north-west", "x")
