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
