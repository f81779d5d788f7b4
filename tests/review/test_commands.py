"""Edits as they are typed."""

from __future__ import annotations

from typing import Any

import pytest

from planner_ft.document import PlanDocument, apply
from planner_ft.review.commands import HELP, parse_edit
from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary import Vocabulary, load_vocabulary
from tests.review.conftest import go, mission_document, task


@pytest.mark.parametrize(
    ("text", "edit"),
    [
        ("3.radius=15", {"kind": "parameter", "task": "t3", "name": "radius", "value": 15}),
        (
            " 3.radius = 1.5e1 ",
            {"kind": "parameter", "task": "t3", "name": "radius", "value": 15.0},
        ),
        ("3.radius=", {"kind": "parameter", "task": "t3", "name": "radius", "value": None}),
        (
            "2.target_position=1,-2",
            {"kind": "parameter", "task": "t2", "name": "target_position", "value": [1, -2]},
        ),
        (
            "2.target_position=[1, -2]",
            {"kind": "parameter", "task": "t2", "name": "target_position", "value": [1, -2]},
        ),
        (
            "1.target_description=red buoy = 2",
            {
                "kind": "parameter",
                "task": "t1",
                "name": "target_description",
                "value": "red buoy = 2",
            },
        ),
        (
            '1.target_description="42"',
            {"kind": "parameter", "task": "t1", "name": "target_description", "value": "42"},
        ),
        (
            "1.target_description=42",
            {"kind": "parameter", "task": "t1", "name": "target_description", "value": "42"},
        ),
        (
            "4.1.x=30",
            {
                "kind": "skill",
                "task": "t4",
                "step": 0,
                "role": "navigation",
                "index": 0,
                "name": "x",
                "value": 30,
            },
        ),
        (
            "4.1.GoToXY.y=",
            {
                "kind": "skill",
                "task": "t4",
                "step": 0,
                "role": "navigation",
                "index": 0,
                "name": "y",
                "value": None,
            },
        ),
        ("remove 3", {"kind": "remove", "task": "t3"}),
        ("Move 3 1", {"kind": "move", "task": "t3", "to": 0}),
        (
            "locate GREEN buoy=120,-35",
            {"kind": "locate", "name": "green buoy", "position": [120.0, -35.0]},
        ),
        ("prompt 2 = Go = there.", {"kind": "prompt", "task": "t2", "text": "Go = there."}),
        (
            "insert 2 Transit target_position=[0, 0] prompt=Go home now.",
            {
                "kind": "insert",
                "at": 1,
                "title": "Transit",
                "parameters": {"target_position": [0, 0]},
                "task_prompt": "Go home now.",
            },
        ),
        (
            "insert 1 SmartDataHarvest target_list=sonar log, photos",
            {
                "kind": "insert",
                "at": 0,
                "title": "SmartDataHarvest",
                "parameters": {"target_list": ["sonar log", "photos"]},
                "task_prompt": "",
            },
        ),
        ("skills 4", {"kind": "ask", "tasks": ["t4"]}),
        ("undo", {"kind": "undo"}),
    ],
)
def test_edits(document: PlanDocument, usv: Vocabulary, text: str, edit: dict[str, Any]) -> None:
    assert parse_edit(text, document, usv) == edit


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("", "is no edit; there is 2.radius=15"),
        ("fly away", "is no edit"),
        ("9.radius=1", "task 9: the plan has tasks 1 to 4"),
        ("0.radius=1", "task 0: the plan has tasks 1 to 4"),
        (f"{'9' * 5000}.radius=1", "the plan has tasks 1 to 4"),
        ("3.size=1", "size: is no parameter of PerformOrbit; there is center, radius"),
        ("4.2.x=1", "Transit: has no step 2; it has 1"),
        ("4.1.Fly.x=1", "step 1 has no skill Fly; it has GoToXY"),
        ("4.1.2.3.x=1", "expected TASK.PARAMETER"),
        ("move 3", "such as move 3 1"),
        ("locate green buoy", "expected"),
        ("prompt 2", "such as prompt 2 ="),
        ("insert Transit", "such as insert 2 Transit"),
        ("insert 1 Fly", "Fly: is no task of this vehicle; there is"),
        ("insert 1 Transit speed_=3", "is no parameter of Transit; there is target_position"),
        ("undo 3", "needs nothing after it"),
    ],
)
def test_mistakes_are_one_sentence_with_the_way_out(
    document: PlanDocument, usv: Vocabulary, text: str, sentence: str
) -> None:
    with pytest.raises(PlannerError) as caught:
        parse_edit(text, document, usv)
    assert sentence in str(caught.value) and "\n" not in str(caught.value)


def test_values_out_of_range_are_refused_when_they_are_applied(
    document: PlanDocument, usv: Vocabulary
) -> None:
    for text in (
        "3.radius=NaN",
        "3.radius=-4",
        "3.radius=wide",
        "2.target_position=1",
        "2.target_position=1,2,3",
        "2.target_position=[[[",
        "4.1.x=far",
    ):
        with pytest.raises(PlannerError):
            apply(document, parse_edit(text, document, usv), usv)


def test_the_second_skill_of_a_name_can_be_meant(usv: Vocabulary) -> None:
    skills = go((0, 0))
    names = [
        skill.name
        for skill in usv.skills_in_role("perception")
        if any(parameter.type == "number" for parameter in skill.parameters)
    ]
    parameter = next(item.name for item in usv.skill[names[0]].parameters if item.type == "number")
    skills[0]["perception_skills"] = [
        {"name": names[0], "parameters": {}},
        {"name": names[0], "parameters": {}},
    ]
    document = mission_document(
        "Go home.", [task("Transit", {"target_position": [0, 0]})], {1: skills}, usv
    )
    edit = parse_edit(f"1.1.{names[0]}#2.{parameter}=1", document, usv)
    assert (edit["role"], edit["index"]) == ("perception", 1)
    assert parse_edit(f"1.1.{names[0]}.{parameter}=1", document, usv)["index"] == 0


def test_skills_without_a_number_are_for_every_task_that_lacks_them(
    document: PlanDocument, usv: Vocabulary
) -> None:
    assert parse_edit("skills", document, usv) == {"kind": "ask", "tasks": []}
    located = apply(document, parse_edit("locate green buoy=120,-35", document, usv), usv)
    assert parse_edit("skills", located, usv)["tasks"] == ["t2", "t3"]
    stale = apply(located, parse_edit("prompt 1 = Look for the green buoy.", located, usv), usv)
    assert parse_edit("skills", stale, usv)["tasks"] == ["t1", "t2", "t3"]


def test_every_example_of_the_help_can_be_read(usv: Vocabulary) -> None:
    skills = go((0, 0))
    skills[0]["perception_skills"] = [{"name": "LogLidarSlice", "parameters": {}}]
    tasks = [
        task("SearchAndDetect", {"target_description": "green buoy"}),
        task("PerformOrbit", {"center": [-99, -99]}),
        task("Transit", {"target_position": [0, 0]}),
    ]
    document = mission_document("Circle the green buoy.", tasks, {2: skills}, usv)
    document["choices"] = [{"task": "t2", "parameter": "radius", "value": 12, "others": [15]}]
    for example in HELP:
        parse_edit(example, document, usv)


def test_another_vehicle() -> None:
    drone = load_vocabulary("inspection_drone")
    known = next(entry for entry in drone.tasks if entry.position_parameter)
    text = f"insert 1 {known.title} {known.position_parameter}=3,4 prompt=Go."
    empty = mission_document("Do nothing.", [], {}, drone)
    document = apply(empty, parse_edit(text, empty, drone), drone)
    assert document["tasks"][0]["parameters"] == {known.position_parameter: [3, 4]}


@pytest.fixture
def longer(usv: Vocabulary) -> PlanDocument:
    """A plan with two steps in its last task, and two questions."""
    going = go((3, 4), (0, 0))
    going[1]["perception_skills"] = [{"name": "LogLidarSlice", "parameters": {}}] * 2
    going[1]["filter_skills"] = [{"name": "ObstacleAvoidance", "parameters": {}}]
    tasks = [
        task("SearchAndDetect", {"target_description": "green buoy"}),
        task("PerformOrbit", {"center": [-99, -99], "radius": 12}, "Circle the green buoy."),
        task("Transit", {"target_position": [0, 0]}),
    ]
    plan = mission_document("Circle it.", tasks, {3: going}, usv)
    others: list[dict[str, Any]] = [
        {"task": "t2", "parameter": "radius", "value": 12, "others": [15, 20]},
        {"task": "t2", "parameter": None, "value": "PerformOrbit", "others": ["SurveyTarget"]},
    ]
    return {**plan, "choices": others}


def skill(step: int, role: str, index: int, name: str, value: Any) -> dict[str, Any]:
    where = {"step": step, "role": role, "index": index}
    return {"kind": "skill", "task": "t3", **where, "name": name, "value": value}


@pytest.mark.parametrize(
    ("text", "edit"),
    [
        ("1a", {"kind": "parameter", "task": "t2", "name": "radius", "value": 15}),
        ("1b", {"kind": "parameter", "task": "t2", "name": "radius", "value": 20}),
        ("2a", {"kind": "title", "task": "t2", "title": "SurveyTarget"}),
        ("remove 3.GoToXY", {"kind": "drop", "task": "t3", "name": "GoToXY"}),
        ("remove 3.2.GoToXY", {"kind": "drop", "task": "t3", "name": "GoToXY", "step": 1}),
        ("remove 3.1.GoToXY", {"kind": "drop", "task": "t3", "name": "GoToXY", "step": 0}),
        ("move 3 3", {"kind": "move", "task": "t3", "to": 2}),
        ("constraint 1", {"kind": "constraint", "at": 0}),
        ("constraint 2 Hurry up.", {"kind": "constraint", "at": 1, "text": "Hurry up."}),
        (
            "insert 4 Diagnostics",
            {
                "kind": "insert",
                "at": 3,
                "title": "Diagnostics",
                "parameters": {},
                "task_prompt": "",
            },
        ),
        ("3.2.x=3", skill(1, "navigation", 0, "x", 3)),
        ("3.1.x=3", skill(0, "navigation", 0, "x", 3)),
        ("3.2.LogLidarSlice.scan_angle=3", skill(1, "perception", 0, "scan_angle", 3)),
        ("3.2.LogLidarSlice#1.scan_angle=3", skill(1, "perception", 0, "scan_angle", 3)),
        ("3.2.LogLidarSlice#2.scan_angle=3", skill(1, "perception", 1, "scan_angle", 3)),
        ("3.2.ObstacleAvoidance.min_distance=3", skill(1, "filter", 0, "min_distance", 3)),
        ("2.center=(1,2)", {"kind": "parameter", "task": "t2", "name": "center", "value": [1, 2]}),
        (
            "1.target_description=[1]",
            {"kind": "parameter", "task": "t1", "name": "target_description", "value": "[1]"},
        ),
        ("skills 2", {"kind": "ask", "tasks": ["t2"]}),
        ("skills", {"kind": "ask", "tasks": ["t1"]}),
        ("origin 54,10", {"kind": "origin", "place": "54,10"}),
        ("locate red buoy=1,2", {"kind": "locate", "name": "red buoy", "position": [1, 2]}),
        ("locate Green Buoy=1,2", {"kind": "locate", "name": "green buoy", "position": [1, 2]}),
    ],
)
def test_numbers_are_counted_from_one(
    longer: PlanDocument, usv: Vocabulary, text: str, edit: dict[str, Any]
) -> None:
    assert parse_edit(text, longer, usv) == edit


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("0a", "0a: is no question of the plan; there are 2"),
        ("3a", "3a: is no question of the plan; there are 2"),
        ("1c", "1c: the question has no such answer; the last is 1b"),
        ("2b", "2b: the question has no such answer; the last is 2a"),
        ("remove 0", "task 0: the plan has tasks 1 to 3"),
        ("remove 4", "task 4: the plan has tasks 1 to 3"),
        ("remove", "task ?: the plan has tasks 1 to 3"),
        ("remove 3.0.GoToXY", "such as remove 2.1.GetSeabedDepth"),
        ("remove 3.1.2.GoToXY", "such as remove 2.1.GetSeabedDepth"),
        ("constraint 0", "constraint 0: expected its number"),
        ("constraint", "expected its number"),
        ("insert 1", "insert 1: expected a place"),
        ("insert x Diagnostics", "expected a place"),
        ("insert 1 Transit junk target_position=1,2", "'junk' is no parameter of Transit"),
        ("3.0.x=3", "Transit: has no step 0; it has 2"),
        ("3.3.x=3", "Transit: has no step 3; it has 2"),
        ("1.1.x=3", "SearchAndDetect: has no step 1; it has 0"),
        (
            "3.2.LogLidarSlice#3.scan_angle=1",
            "step 2 has no skill LogLidarSlice#3; it has GoToXY, ObstacleAvoidance, LogLidarSlice",
        ),
        ("3.x.y=3", "such as 2.1.GoToXY.x"),
        ("999999999.radius=1", "task 999999999: the plan has tasks 1 to 3"),
        ("skills 4", "task 4: the plan has tasks 1 to 3"),
    ],
)
def test_the_first_and_last_that_can_be_named(
    longer: PlanDocument, usv: Vocabulary, text: str, sentence: str
) -> None:
    with pytest.raises(PlannerError) as caught:
        parse_edit(text, longer, usv)
    assert sentence in str(caught.value)


def test_a_plan_without_tasks_and_questions_says_so(usv: Vocabulary) -> None:
    empty = mission_document("Do nothing.", [], {}, usv)
    for text, sentence in (("remove 1", "the plan has no tasks"), ("1a", "there are none")):
        with pytest.raises(PlannerError, match=sentence):
            parse_edit(text, empty, usv)
