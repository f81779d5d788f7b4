"""Waypoints of a line, a grid and a square follow from the task where the Task Agent's do not."""

import pytest

from planner_ft.facts.geometry import lawnmower, survey_square
from planner_ft.planning.shapes import shape_problem, with_shape
from planner_ft.vocabulary import load_vocabulary
from tests.documents import step

USV = load_vocabulary()


def cable(prompt="Follow the cable from [20, -60] on heading 90 for 400 m.", **values):
    given = {"start": [20, -60], "heading": 90, "max_dist": 400, **values}
    return {"title": "SubseaCableTrack", "parameters": given, "task_prompt": prompt}


def grid(prompt="Map the depths around [50, 30].", **values):
    given = {"center": [50, 30], "width": 20, "length": 40, "spacing": 10, **values}
    return {"title": "BathymetryGridSurvey", "parameters": given, "task_prompt": prompt}


def square(prompt="Survey the wreck at [50, 30].", **values):
    given = {"target_position": [50, 30], "radius": 10, **values}
    return {"title": "SurveyTarget", "parameters": given, "task_prompt": prompt}


def go(*points):
    return [step("GoToXY", {"x": x, "y": y}) for x, y in points]


def waypoints(steps):
    skills = [one["navigation_skill"] for one in steps]
    return [(one["parameters"]["x"], one["parameters"]["y"]) for one in skills]


def test_the_end_of_a_line_follows_from_its_course():
    steps = go((20, -60), (400, 340))
    steps[1]["perception_skills"] = [{"name": "DetectSonarFeature", "parameters": {}}]
    done, marks = with_shape(cable(), steps, USV)
    assert waypoints(done) == [(20, -60), (420, -60)]
    assert [len(one["perception_skills"]) for one in done] == [0, 1]
    assert {(mark["step"], mark["parameter"], mark["kind"]) for mark in marks} == {
        (at, axis, "vehicle") for at in (0, 1) for axis in ("x", "y")
    }
    assert waypoints(steps) == [(20, -60), (400, 340)]


def test_a_grid_that_is_not_covered_is_run_as_stated():
    lanes = lawnmower((50, 30), 20, 40, 10)
    for points in (
        lanes[:4],
        [*lanes, (70, 10)],
        [(x, y - 10) if y > 30 else (x, y) for x, y in lanes],
    ):
        done, marks = with_shape(grid(), go(*points), USV)
        assert waypoints(done) == lanes and marks
        assert len(done) == 6


def test_lanes_too_far_apart_make_no_grid():
    wide = go(*lawnmower((50, 30), 20, 40, 20))
    assert "20 m apart" in shape_problem(grid(), waypoints(wide), USV)
    assert waypoints(with_shape(grid(), wide, USV)[0]) == lawnmower((50, 30), 20, 40, 10)
    along = lawnmower((50, 30), 20, 40, 10, lanes_along="x")
    assert shape_problem(grid(), along, USV) is None


def test_lanes_that_do_not_fill_an_area_end_at_its_far_side():
    task = grid("Map it with 15 m. Be back by 1600.", spacing=15)
    done, marks = with_shape(task, go((9, 9), (9, 50), (9, 9)), USV)
    assert waypoints(done) == [(40, 10), (40, 50), (55, 50), (55, 10), (60, 10), (60, 50)] and marks
    assert shape_problem(task, waypoints(done), USV) is None


def test_a_square_keeps_its_distance():
    done, _marks = with_shape(square(), go((50, 30), (60, 30)), USV)
    assert waypoints(done) == survey_square((50, 30), 10)


@pytest.mark.parametrize(
    ("task", "points"),
    [
        (cable(), [(20, -60), (420, -60)]),
        (cable("Run up to [20, -60]."), [(20, -60), (9, 9)]),
        (grid("Do the first two lanes."), [(40, 10), (40, 50), (50, 50)]),
        (cable(heading=None), [(20, -60), (9, 9)]),
        (cable(start=[-99, -99]), [(20, -60), (9, 9)]),
        (cable("Follow the cable for 400 m, 60 m to the north."), [(20, -60), (9, 9)]),
        (grid(), lawnmower((50, 30), 20, 40, 10, "north-east")),
        (grid("Begin in the north-east corner."), [(60, 50), (60, 20)]),
        (square("Survey it at 10 m, then at 20 m."), [(60, 30), (70, 30)]),
    ],
)
def test_what_is_made_or_not_known_for_certain_stays(task, points):
    steps = go(*points)
    done, marks = with_shape(task, steps, USV)
    assert done == steps and marks == []
    holding = [*steps, step("StationKeep")]
    assert with_shape(task, holding, USV)[0] == holding


@pytest.mark.parametrize(("x", "right"), [(100, True), (98.2, True), (97, False)])
def test_a_waypoint_of_a_large_square_may_miss_it_by_a_fiftieth(x, right):
    task = {
        "title": "SurveyTarget",
        "parameters": {"target_position": [0, 0], "radius": 100},
        "task_prompt": "Survey it.",
    }
    assert (shape_problem(task, [(x, 0)], load_vocabulary()) is None) is right


@pytest.mark.parametrize(("width", "right"), [(200, True), (196.5, True), (180, False)])
def test_a_large_grid_may_miss_its_sides_by_a_fiftieth(width, right):
    task = {
        "title": "BathymetryGridSurvey",
        "parameters": {"center": [0, 0], "width": 200, "length": 300, "spacing": 10},
        "task_prompt": "Map it.",
    }
    points = lawnmower((0, 0), width, 300, width / 20)
    assert (shape_problem(task, points, load_vocabulary()) is None) is right


def test_a_grid_is_run_once_unless_its_prompt_says_otherwise():
    lanes = lawnmower((50, 30), 20, 40, 10)
    back = go(*lanes, *lanes[-2::-1])
    assert waypoints(with_shape(grid(), back, USV)[0]) == lanes
    assert with_shape(grid("Map the depths around [50, 30], and back again."), back, USV)[0] == back
    ring = go(*survey_square((50, 30), 10), (40, 20))
    assert with_shape(square(), ring, USV)[0] == ring


def test_the_number_of_a_thing_is_no_value_of_its_survey():
    wrong = go(*survey_square((50, 30), 15))
    for prompt in (
        "Survey pen 14 at [50, 30].",
        "Survey pen 14 at [50, 30] at a stand-off of 10 m.",
    ):
        assert waypoints(with_shape(square(prompt), wrong, USV)[0]) == survey_square((50, 30), 10)
    assert with_shape(square("Survey 14 corners at pen [50, 30]."), wrong, USV)[0] == wrong
