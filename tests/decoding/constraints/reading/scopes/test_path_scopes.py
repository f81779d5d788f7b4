"""In which steps skills run, told by places on the path of the task."""

from __future__ import annotations

import time

import pytest

from planner_ft.data.task import geometry as g
from planner_ft.decoding.constraints.companions import read_companions
from planner_ft.decoding.constraints.reading.paths.cues import read_cues
from planner_ft.decoding.constraints.reading.scopes.path_scopes import read_path_scopes
from planner_ft.decoding.constraints.waypoints import read_ground
from planner_ft.vocabulary import load_vocabulary

VOCABULARY = load_vocabulary()
NAMES = [
    skill.name for role in ("filter", "perception") for skill in VOCABULARY.skills_in_role(role)
]
SQUARE = tuple(g.survey_square(g.point(0, 0), 10, "east", clockwise=False))
GRID = tuple(g.lawnmower(g.point(0, 0), 40, 60, 20, "south-west", "y"))
RUN = (g.point(0, 0), g.point(0, 80))
SIGNS = {True: "+", False: "-", None: "?"}


def verdicts(
    text: str, skill: str, path: tuple[g.Point, ...], pattern: str, *, known: bool = True
) -> str:
    """What is read for each waypoint of a path: + runs, - does not, ? not known."""
    scope = read_path_scopes(text, NAMES, [path] if known else [], pattern).get(skill)
    return "".join(
        SIGNS[scope.allows(path[: index + 1])] if scope else "?" for index in range(len(path))
    )


@pytest.mark.parametrize(
    ("text", "skill", "steps"),
    [
        (
            "Survey square round the target. At the three points of the south side leave 6 m clearance, elsewhere that is not needed.",
            "ObstacleAvoidance",
            "-----+++",
        ),
        (
            "Survey square round the target. Take a GPS fix at the middle of the west side and nowhere else.",
            "GetGPSLocation",
            "----+---",
        ),
        (
            "Survey square round the target. A geotagged still at the north-west corner alone.",
            "CaptureGeoSnapshot",
            "---+----",
        ),
        (
            "Survey square round the target. Seabed depth at the mid-sides, a geotagged still at the corners.",
            "GetSeabedDepth",
            "+-+-+-+-",
        ),
        (
            "Survey square round the target. Seabed depth at the mid-sides, a geotagged still at the corners.",
            "CaptureGeoSnapshot",
            "-+-+-+-+",
        ),
        (
            "Survey square round the target. Take a GPS fix at the four corners; at every waypoint log the environment.",
            "LogEnvironmentState",
            "++++++++",
        ),
        (
            "Survey square round the target, starting at the middle of the west side. Log the environment.",
            "LogEnvironmentState",
            "????????",
        ),
    ],
)
def test_places_of_a_square(text: str, skill: str, steps: str) -> None:
    assert verdicts(text, skill, SQUARE, "square") == steps


@pytest.mark.parametrize(
    ("text", "skill", "steps"),
    [
        (
            (
                "Mow the planned grid. A margin of 5 m on both waypoints of the last lane, none"
                " before."
            ),
            "ObstacleAvoidance",
            "----++",
        ),
        (
            (
                "Mow the planned grid. On the run along the second lane, and only there, take a GPS"
                " fix."
            ),
            "GetGPSLocation",
            "---+--",
        ),
        (
            (
                "Mow the planned grid. The run to the first waypoint is without soundings; from the"
                " first waypoint on, seabed depth."
            ),
            "GetSeabedDepth",
            "-+++++",
        ),
        (
            (
                "Depth grid as planned. On the way to the first waypoint keep 9 m of clearance, not"
                " afterwards."
            ),
            "ObstacleAvoidance",
            "+-----",
        ),
    ],
)
def test_places_of_a_grid(text: str, skill: str, steps: str) -> None:
    assert verdicts(text, skill, GRID, "lawnmower") == steps


@pytest.mark.parametrize("known", [True, False])
@pytest.mark.parametrize(
    ("text", "skill", "steps"),
    [
        (
            "To the cable's start at [0, 0], then 80 m due north. Take a GPS fix on that leg only.",
            "GetGPSLocation",
            "-+",
        ),
        (
            (
                "Pick the cable up at [0, 0] and follow it 80 m due north. Seabed depth from the"
                " start point onwards, not on the run there."
            ),
            "GetSeabedDepth",
            "-+",
        ),
        (
            (
                "To the start first, then along the cable. Ten metres of clearance on the way to"
                " the start."
            ),
            "ObstacleAvoidance",
            "+-",
        ),
        (
            "Follow the cable from its start on the given heading, with seabed depth.",
            "GetSeabedDepth",
            "??",
        ),
    ],
)
def test_runs_and_the_way_to_their_start(text: str, skill: str, steps: str, known: bool) -> None:
    assert verdicts(text, skill, RUN, "line", known=known) == steps


@pytest.mark.parametrize(
    ("text", "skill", "steps"),
    [
        (
            "Run along the wall. Log the lidar slice both at the start point and at the end point.",
            "LogLidarSlice",
            "++",
        ),
        ("Run along the wall. Take a GPS fix at the end point only.", "GetGPSLocation", "-+"),
        (
            (
                "Run along the wall. At the start point log the environment, at the very last one"
                " drop a pin."
            ),
            "LogEnvironmentState",
            "+-",
        ),
        (
            (
                "Run along the wall. At the start point log the environment, at the very last one"
                " drop a pin."
            ),
            "CreateMapMarker",
            "-+",
        ),
        (
            "Run along the wall. At the end point hold for a minute and take a GPS fix.",
            "GetGPSLocation",
            "??",
        ),
    ],
)
def test_ends_of_a_run(text: str, skill: str, steps: str) -> None:
    assert verdicts(text, skill, RUN, "line") == steps
    unknown = verdicts(text, skill, RUN, "line", known=False)
    assert all(found in (step, "?") for found, step in zip(unknown, steps, strict=True))


@pytest.mark.parametrize(
    ("text", "skill", "steps"),
    [
        (
            (
                "Mow the grid and then head home. Seabed depth on the lanes, nothing on the way"
                " home; 6 m of clearance."
            ),
            "GetSeabedDepth",
            "++++++-",
        ),
        (
            "Mow the grid and then head home. Take a GPS fix on the way home only.",
            "GetGPSLocation",
            "------+",
        ),
        (
            (
                "Mow the grid and then go back home. A GPS fix on the grid including the last"
                " point, not on the way home."
            ),
            "GetGPSLocation",
            "++++++-",
        ),
        ("Mow the grid. Seabed depth on the lanes.", "GetSeabedDepth", "???????"),
        (
            (
                "Mow the grid and then head home. Seabed depth on the lanes, not on the hops"
                " between them."
            ),
            "GetSeabedDepth",
            "???????",
        ),
    ],
)
def test_the_way_home_behind_a_path(text: str, skill: str, steps: str) -> None:
    assert verdicts(text, skill, (*GRID, g.point(0, 0)), "lawnmower", known=False) == steps


def test_runs_both_ways() -> None:
    text = (
        "Two runs: northbound 9 m off, then southbound 18 m off. On the northbound run itself, not"
        " on the way to its start, check whether the wall is flat."
    )
    path = (g.point(9, 0), g.point(9, 50), g.point(18, 50), g.point(18, 0))
    assert verdicts(text, "CheckPlanarity", path, "pass") == "-+--"


def test_legs_that_are_numbered_behind_a_start_point() -> None:
    text = (
        "Start point [0, 0]. Leg 1: 50 m on bearing 000. Leg 2: 30 m on bearing 090. Log the"
        " environment on leg 2, seabed depth on legs 1 and 2."
    )
    path = (g.point(0, 0), g.point(0, 50), g.point(30, 50))
    assert verdicts(text, "LogEnvironmentState", path, "line", known=False) == "--+"
    assert verdicts(text, "GetSeabedDepth", path, "line", known=False) == "-++"


def test_what_another_length_goes_on_about_is_not_read() -> None:
    text = (
        "Legs are [0, 0], [0, 80]. Twenty metres of clearance until the first point is reached;"
        " from the first point to the end, ten."
    )
    assert verdicts(text, "ObstacleAvoidance", RUN, "line") == "??"


def test_companions_know_the_path_of_their_task() -> None:
    text = (
        "Survey square round the target. At the three points of the north side log the environment,"
        " elsewhere not."
    )
    record = {
        "task": "SurveyTarget",
        "parameters": {"target_position": [0, 0], "radius": 10},
        "prompt": text,
    }
    ground = read_ground(record, VOCABULARY)
    assert ground.one_path == (SQUARE,)
    companions = read_companions(record, VOCABULARY).along(text, ground.one_path, "square")
    runs = [
        companions.runs("LogEnvironmentState", "GoToXY", ["GoToXY"] * index, SQUARE[: index + 1])
        for index in range(8)
    ]
    assert runs == [False, True, True, True, False, False, False, False]


def test_long_texts_are_read_in_no_time() -> None:
    text = (
        "At the three points of the north side and at the corners and on the way to the start and"
        " from the first point on, " * 9
    )
    begin = time.perf_counter()
    read_path_scopes(text, NAMES, [SQUARE], "square")
    assert time.perf_counter() - begin < 0.5


@pytest.mark.parametrize(
    "text",
    [
        "Survey square round the target. At the three points of the west side take a GPS fix.",
        (
            "Survey square forty feet from the target. A still at the four corners, none at the"
            " middles of the sides."
        ),
    ],
)
def test_where_something_is_done_is_not_where_the_square_begins(text: str) -> None:
    assert read_cues(text).starts == ("east",)


def test_a_minimum_distance_of_so_many_metres_is_a_clearance() -> None:
    companions = read_companions(
        {"prompt": "Hold for an hour, bow locked, four metres minimum distance."}, VOCABULARY
    )
    assert (
        "ObstacleAvoidance" in (companions.spoken or ())
        and "GetSectorDistance" not in companions.asked
    )
