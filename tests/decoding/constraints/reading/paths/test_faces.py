"""Passes beside a line that a task input lays down by equations, ends, bearings or its middle, and
stations along a bearing.
"""

from __future__ import annotations

from typing import Any

import pytest

from planner_ft.decoding.constraints.reading.paths.faces import read_faces
from planner_ft.decoding.constraints.reading.paths.stations import read_stations

Points = list[tuple[float, float]]


def record(prompt: str, **parameters: Any) -> dict[str, Any]:
    return {"task": "ParallelStructurePass", "parameters": parameters, "prompt": prompt}


@pytest.mark.parametrize(
    ("prompt", "parameters", "path"),
    [
        (
            (
                "The caisson's south face stands on y = 0 and stretches from x = 100 to x = 150."
                " Pass it westbound, 9 m off."
            ),
            {},
            [(150, -9), (100, -9)],
        ),
        (
            (
                "West wall of the lock is at x = -20, y between 10 and 60. Go down it from the"
                " north end to the south end at the set distance."
            ),
            {"distance": 5},
            [(-25, 60), (-25, 10)],
        ),
        (
            (
                "Barge side on y = 12 (x from 0 to 60): one run west to east at 5 m to the north of"
                " it, and one run back at 8 m."
            ),
            {},
            [(0, 17), (60, 17), (60, 20), (0, 20)],
        ),
        (
            (
                "The quay's north face is on y = 8, from x = 0 to x = 30. Pass it 4 m off, east to"
                " west, and straight back along the same line."
            ),
            {},
            [(30, 12), (0, 12), (30, 12)],
        ),
    ],
)
def test_faces_on_an_axis(prompt: str, parameters: dict[str, Any], path: Points) -> None:
    assert read_faces(record(prompt, **parameters)) == tuple(path)


@pytest.mark.parametrize(
    ("prompt", "path"),
    [
        (
            (
                "The mole goes from (0, 0) to (30, 40). Run parallel to it in that direction, five"
                " metres out on the left-hand side."
            ),
            [(-4, 3), (26, 43)],
        ),
        (
            (
                "The mole goes from (0, 0) to (30, 40). Pass along its south-east side, 5 m off,"
                " from the north-eastern end to the south-western one."
            ),
            [(34, 37), (4, -3)],
        ),
        (
            (
                "The quay runs from (0, 0) to (0, 80). Run along it 6 m off, keeping it on your"
                " port side."
            ),
            [(6, 0), (6, 80)],
        ),
        (
            (
                "Pontoon from (10, 0) to (50, 0). Go along its north side and come back along its"
                " south side, 3 m off both times."
            ),
            [(10, 3), (50, 3), (50, -3), (10, -3)],
        ),
        (
            (
                "Two runs beside the boom, (0, 5) to (40, 5): the first 10 m to the south of it,"
                " the second, the other way, at double that."
            ),
            [(0, -5), (40, -5), (40, -15), (0, -15)],
        ),
        (
            (
                "Groyne: one end at (0, 0), from there it goes 50 m on 090. Pass it 7 m off on the"
                " side that faces 180, end to end."
            ),
            [(0, -7), (50, -7)],
        ),
        (
            (
                "Keep the dyke from (0, 0) to (60, 0) 10 m away on a run along its north side,"
                " beginning with the second point given."
            ),
            [(60, 10), (0, 10)],
        ),
        (
            (
                "The pier is straight, exactly north-south, 40 m long, midpoint (20, 0). Pass it on"
                " its east side, 5 m off, southbound."
            ),
            [(25, 20), (25, -20)],
        ),
        (
            "A line of 60 m that has (0, 30) in its middle, run on 180 from end to end.",
            [(0, 60), (0, 0)],
        ),
    ],
)
def test_lines_by_ends_bearings_and_middles(prompt: str, path: Points) -> None:
    assert read_faces(record(prompt)) == tuple(path)


@pytest.mark.parametrize(
    ("prompt", "path"),
    [
        (
            (
                "Pen wall on y = 5 from x = 0 to x = 20. Pass it 4 m to the north, west to east,"
                " then step out to 9 m north of it and come back."
            ),
            [(0, 9), (20, 9), (20, 14), (0, 14)],
        ),
        (
            (
                "East face on x = 10, from y = 0 to y = 40. Run northbound 4 m east of it, move out"
                " to 8 m and run southbound, move out to 12 m and run northbound."
            ),
            [(14, 0), (14, 40), (18, 40), (18, 0), (22, 0), (22, 40)],
        ),
        (
            (
                "Mole from (0, 0) to (80, 0). Three passes on its north side at 5, 10 and 15 m,"
                " back and forth, from the west end."
            ),
            [(0, 5), (80, 5), (80, 10), (0, 10), (0, 15), (80, 15)],
        ),
        (
            (
                "Wall on y = 0 from x = 0 to x = 50. Two passes on the north side, 6 m and 12 m"
                " off, each from west to east."
            ),
            [(0, 6), (50, 6), (0, 12), (50, 12)],
        ),
        (
            (
                "The mole runs from (0, 0) on bearing 090, 30 m long. Run along it 5 m off on the"
                " right as seen along 090, starting at (0, 0)."
            ),
            [(0, -5), (30, -5)],
        ),
        (
            (
                "The wall runs from (0, 0) for 40 m on 090. Pass it 3 m off on its south side in"
                " that direction, then 4 m further out and back."
            ),
            [(0, -3), (40, -3), (40, -7), (0, -7)],
        ),
    ],
)
def test_passes_at_several_distances(prompt: str, path: Points) -> None:
    assert read_faces(record(prompt)) == tuple(path)


@pytest.mark.parametrize(
    ("prompt", "path"),
    [
        (
            (
                "The jetty's north face runs from [0, 40] to [60, 40]. Make one pass along it, west"
                " to east, at the stand-off given."
            ),
            [(0, 52), (60, 52)],
        ),
        (
            (
                "The wall lies on x = -200, from y = 0 to y = 90. Run northbound, 10 m off it on"
                " the west side."
            ),
            [(-210, 0), (-210, 90)],
        ),
        (
            (
                "The quay edge is the straight line from [0, 0] to [80, 60]. Run parallel to it in"
                " that direction on the north-west side, 10 m off."
            ),
            [(-6, 8), (74, 68)],
        ),
        (
            (
                "The pier face runs from [0, 0] to [50, 0]. First run eastbound at 10 m on its"
                " north side. Then run westbound at 20 m on its north side."
            ),
            [(0, 10), (50, 10), (50, 20), (0, 20)],
        ),
    ],
)
def test_passes_keep_off_a_described_face(prompt: str, path: Points) -> None:
    assert read_faces(record(prompt, side_id="north", length=60, distance=12)) == tuple(path)


@pytest.mark.parametrize(
    "prompt",
    [
        "Run parallel to the wall from (0, 30) to (90, 30), keep 8 m from all obstacles.",
        "The east face is at x = 10, from y = 0 to y = 40. Pass it 5 m off, then come home.",
        "The wall runs from (0, 0) to (40, 0). Pass it 5 m off.",
        "Three passes along the quay, (0, 0) to (40, 0), 5 m off on its north side.",
        "Start at x = 5, y = 7 and run to x = 20, y = 9.",
    ],
)
def test_what_is_not_clear_is_not_read(prompt: str) -> None:
    assert read_faces(record(prompt)) is None


@pytest.mark.parametrize(
    ("prompt", "parameters", "path"),
    [
        (
            "Start from (0, 10), bearing 090, with a waypoint every 20 m until you have done 60 m.",
            {},
            [(0, 10), (20, 10), (40, 10), (60, 10)],
        ),
        (
            "From (5, 5) on bearing 180 put a waypoint every 25 m up to the maximum distance.",
            {"max_dist": 50},
            [(5, 5), (5, -20), (5, -45)],
        ),
        (
            "We are lying at (40, 10) already. Do 80 m on bearing 090 and come back to this spot.",
            {},
            [(120, 10), (40, 10)],
        ),
    ],
)
def test_stations_and_runs_from_here(prompt: str, parameters: dict[str, Any], path: Points) -> None:
    assert read_stations(record(prompt, **parameters)) == tuple(path)
