"""The ends of a pass follow from its values where the Task Agent's waypoints make no pass."""

import pytest

from planner_ft.planning.shapes import pass_ends, with_pass
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
