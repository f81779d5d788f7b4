"""The ends of a pass follow from its values where the Task Agent's waypoints make no pass."""

import math

import pytest

from planner_ft.planning.passes import face_of, gone_to, pass_ends, with_pass
from planner_ft.planning.shapes import shape_problem
from planner_ft.vocabulary import load_vocabulary
from tests.documents import step

USV = load_vocabulary()
PROMPT = "Run along the east side of the quay at [60, 15] for 120 m, 7 m off."


def task(prompt=PROMPT, title="ParallelStructurePass", **values):
    given = {"side_id": "east", "length": 120, "distance": 7, **values}
    return {"title": title, "parameters": given, "task_prompt": prompt}


def waypoints(steps):
    skills = [one["navigation_skill"] for one in steps]
    return [(s["parameters"]["x"], s["parameters"]["y"]) for s in skills if s["name"] == "GoToXY"]


def test_both_ends_at_one_point_become_the_ends_of_the_face():
    steps = [step("GoToXY", {"x": 67, "y": 15}), step("GoToXY", {"x": 67, "y": 15})]
    done, marks = with_pass(task(), steps, USV)
    assert sorted(waypoints(done)) == [(67, -45), (67, 75)]
    assert {(mark["step"], mark["parameter"]) for mark in marks} == {
        (place, axis) for place in (0, 1) for axis in ("x", "y")
    }
    assert {mark["kind"] for mark in marks} == {"vehicle"}
    assert waypoints(steps) == [(67, 15)] * 2


def test_one_waypoint_becomes_two_and_begins_at_the_nearer_end():
    one = step("GoToXY", {"x": 67, "y": 60})
    one["perception_skills"] = [{"name": "SetStreamRecording", "parameters": {}}]
    done, _marks = with_pass(task(), [one], USV)
    assert waypoints(done) == [(67, 75), (67, -45)]
    assert [len(each["perception_skills"]) for each in done] == [1, 1]


def test_a_pass_beside_its_face_is_put_right():
    steps = [step("GoToXY", {"x": 67, "y": y}) for y in (15, 135)]
    done, _marks = with_pass(task(), steps, USV)
    assert waypoints(done) == [(67, -45), (67, 75)]


@pytest.mark.parametrize(
    ("steps", "changed"),
    [
        ([("GoToXY", 67, -45), ("GoToXY", 67, 75)], {}),
        ([("GoToXY", 67, 85), ("GoToXY", 67, -35)], {}),
        ([("GoToXY", 67, 15)], {"side_id": "port"}),
        ([("GoToXY", 67, 15)], {"length": None}),
        ([("GoToXY", 67, 15)], {"prompt": "Run along the east side for 120 m."}),
        ([("GoToXY", 67, 15)], {"title": "PerformOrbit"}),
        ([("GoToXY", 67, y) for y in (0, 10, 20)], {}),
    ],
)
def test_what_makes_a_pass_or_is_not_known_stays(steps, changed):
    made = [step(name, {"x": x, "y": y}) for name, x, y in steps]
    done, marks = with_pass(task(**changed), made, USV)
    assert done == made and marks == []


def test_ends_lie_off_the_stated_side():
    assert set(pass_ends(task(side_id="south"), USV)) == {(0, 8), (120, 8)}
    assert pass_ends(task(side_id="landward"), USV) is None


def way(prompt="Go to [90, 50].", at=(90, 50)):
    given = {"target_position": list(at)}
    return {"title": "Transit", "parameters": given, "task_prompt": prompt}


BARE = "Run along the east side of the quay for 120 m, 7 m off."


@pytest.mark.parametrize(
    ("made", "side", "ends"),
    [
        ([(12, -35), (12, 35)], "east", [(90, 50), (90, 170)]),
        ([(12, 35), (12, -35)], "east", [(90, 50), (90, -70)]),
        ([(7, 0)], "west", [(90, 50), (90, 170)]),
        ([(0, 8), (0, 8)], "south", [(90, 50), (210, 50)]),
        ([(60, 8), (-60, 8)], "north", [(90, 50), (-30, 50)]),
    ],
)
def test_a_pass_without_a_place_begins_where_the_vehicle_has_gone_to(made, side, ends):
    steps = [step("GoToXY", {"x": x, "y": y}) for x, y in made]
    begun = with_pass(task(BARE, side_id=side), steps, USV, gone_to([way()], USV))
    assert waypoints(begun[0]) == ends and begun[1]
    again = with_pass(task(BARE, side_id=side), begun[0], USV, way())
    assert again == (begun[0], [])
    ran = {**task(BARE, side_id=side), "skill_sequence": begun[0]}
    face, (x, y) = face_of(ran, USV), ends[0]
    assert face and min(math.dist((x, y), end) for end in face.ends) == pytest.approx(7)


def test_a_pass_of_what_the_vehicle_has_gone_to_has_its_middle_there():
    steps = [step("GoToXY", {"x": 7, "y": y}) for y in (60, -60)]
    done, _marks = with_pass(task(BARE), steps, USV, way("Go to the quay at [90, 50]."))
    assert waypoints(done) == [(97, 110), (97, -10)]


def test_where_the_vehicle_is_may_not_be_known():
    orbit = {"title": "PerformOrbit", "parameters": {"center": [90, 50]}, "task_prompt": "Circle."}
    assert gone_to([], USV) is None
    assert gone_to([way(), orbit], USV) is None
    assert gone_to([way(at=(-99, -99))], USV) is None
    assert gone_to([way(), way(at=(1, 2))], USV) == way(at=(1, 2))
    steps = [step("GoToXY", {"x": 7, "y": y}) for y in (60, -60)]
    assert with_pass(task(BARE), steps, USV) == (steps, [])
    assert face_of({**task(BARE), "skill_sequence": steps[:1]}, USV) is None


def test_a_side_that_is_no_direction_is_said():
    steps = [(32, -45), (32, 75)]
    assert shape_problem(task(), steps, USV) is None
    assert '"river" is no compass direction' in shape_problem(task(side_id="river"), steps, USV)
