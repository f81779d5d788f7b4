"""Corners, axes and sizes of grids as task inputs word them, and where on the way something else is
done.
"""

from __future__ import annotations

from typing import Any

import pytest

from planner_ft.data.task import geometry as g
from planner_ft.decoding.constraints.ground import Ground
from planner_ft.decoding.constraints.reading.paths.extents import extents
from planner_ft.decoding.constraints.reading.paths.halts import halts_at, read_halts
from planner_ft.decoding.constraints.reading.paths.lanes import read_lanes
from planner_ft.decoding.constraints.waypoints import read_ground
from planner_ft.vocabulary import load_vocabulary

VOCABULARY = load_vocabulary()
BOX = {"center": [-20, 70], "width": 30, "length": 60, "spacing": 15}
SQUARE = {"target_position": [4, 6], "radius": 10}


def ground(task: str, prompt: str, parameters: dict[str, Any]) -> Ground:
    return read_ground({"task": task, "prompt": prompt, "parameters": parameters}, VOCABULARY)


@pytest.mark.parametrize(
    ("prompt", "lanes"),
    [
        ("Run the grid. Depth from the bow sounder.", ("south-west", "y")),
        (
            (
                "First lane along the north side, starting at its east end, then southward lane by"
                " lane."
            ),
            ("north-east", "x"),
        ),
        (
            "Begin at the north-east corner heading west and work your way south.",
            ("north-east", "x"),
        ),
        ("From the south-east corner, stepping west.", ("south-east", "y")),
        (
            "North-south lanes, the first one on the eastern edge, run from north to south.",
            ("north-east", "y"),
        ),
        (
            "Lanes east-west, starting from the north side and working southwards.",
            ("north-west", "x"),
        ),
        (
            (
                "East-west lanes, each one further north than the one before; enter at the"
                " south-east corner."
            ),
            ("south-east", "x"),
        ),
        ("Take the easternmost lane first, southbound.", ("north-east", "y")),
        (
            "Lanes east-west rather than north-south, from the north-west corner.",
            ("north-west", "x"),
        ),
        ("North-south lanes, from east to west.", ("south-east", "y")),
        ("Lanes along the long side, from the south-west corner.", ("south-west", "y")),
        ("When the last lane is done hold for a minute.", ("south-west", "y")),
        ("Begin at the far corner.", None),
        ("Lanes east-west, stepping east.", None),
        ("Begin in the north-west corner, first lane on the east side.", None),
    ],
)
def test_corner_and_axis_are_put_together(prompt: str, lanes: tuple[str, str] | None) -> None:
    assert read_lanes(prompt, 30, 60) == lanes


@pytest.mark.parametrize(
    ("prompt", "written"),
    [
        ("40 m in x, 20 m in y", "40 m wide, 20 m long"),
        ("80 m east to west by 30 m north to south", "80 m wide by 30 m long"),
        ("width 80, length 30, lane spacing 7.5.", "width 80 m, length 30 m, lane spacing 7.5 m."),
        ("a box of 25 x 15, E-W lanes", "a box of 25 m by 15 m, east-west lanes"),
        ("from the top left corner, working down", "from the north-west corner, working south"),
        ("at (3, 4), 12 x 6 lanes", "at (3, 4), 12 x 6 lanes"),
    ],
)
def test_sizes_are_written_out(prompt: str, written: str) -> None:
    assert extents(prompt) == written


@pytest.mark.parametrize(
    ("prompt", "path"),
    [
        (
            (
                "Mud survey: centre [-20, 70], width 30, length 60, lines every 15 m. Once the last"
                " one is finished hold for a minute."
            ),
            ("south-west", "y"),
        ),
        (
            (
                "[-20, 70] in the middle, 30 m in x, 60 m in y, transects parallel to the x axis"
                " every 15 m, from the north-east corner."
            ),
            ("north-east", "x"),
        ),
        (
            (
                "Grid of 30 x 60 about [-20, 70], lane spacing 15, north-west corner first,"
                " stepping east."
            ),
            ("north-west", "y"),
        ),
    ],
)
def test_a_grid_that_leaves_no_choice(prompt: str, path: tuple[g.Corner, g.Axis]) -> None:
    facts = ground("BathymetryGridSurvey", prompt, BOX)
    lanes = g.lawnmower((-20, 70), 30, 60, 15, *path)
    assert all(
        facts.following(tuple(lanes[:place])) == [point] for place, point in enumerate(lanes)
    )


@pytest.mark.parametrize(
    ("prompt", "halts"),
    [
        ("At each corner stop and hold for ten seconds; a photo in these holds.", {"corners"}),
        ("Square round it with a 20-second stop at each of the four corners.", {"corners"}),
        ("Run the grid, then hold for a minute.", {"end"}),
        ("When the last line is finished turn to north and wait until steady.", {"end"}),
        ("Hold ten seconds at every waypoint.", {"each"}),
        ("Wait half a minute at the end of each lane.", {"lanes"}),
        ("Run the grid with the heading locked.", None),
        ("Grid. Hold for a minute.", None),
    ],
)
def test_where_something_else_is_done(prompt: str, halts: set[str] | None) -> None:
    assert read_halts(prompt) == halts


def test_a_hold_comes_where_it_is_asked_for_and_nowhere_else() -> None:
    facts = ground(
        "SurveyTarget",
        "Square round the pile at [4, 6], 10 m off. Hold 15 s at each corner and fit a cylinder to"
        " the point cloud.",
        SQUARE,
    )
    path = tuple(g.survey_square((4, 6), 10))
    assert [facts.halts_here(path[:done]) for done in range(9)] == [
        False,
        False,
        True,
        False,
        True,
        False,
        True,
        False,
        True,
    ]
    facts = ground(
        "BathymetryGridSurvey", "The planned grid. When it is finished hold for two minutes.", BOX
    )
    lanes = tuple(g.lawnmower((-20, 70), 30, 60, 15))
    assert [facts.halts_here(lanes[:done]) for done in range(len(lanes) + 1)] == [False] * len(
        lanes
    ) + [True]
    assert (
        halts_at(frozenset({"lanes"}), lanes, 2) is True
        and halts_at(frozenset({"lanes"}), lanes, 3) is False
    )
    assert (
        ground("SurveyTarget", "Square round the target. Hold for a minute.", SQUARE).halts_here(
            path[:3]
        )
        is None
    )
