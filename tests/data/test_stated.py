"""Labelling rules of skills: values are said, by the prompt or by the task, but for computed ones."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest

from planner_ft.data.stated import completeness_problems, step_problems
from planner_ft.vocabulary import load_vocabulary

USV = load_vocabulary()
Skill = tuple[str, dict[str, Any]]


def problems(prompt: str, *steps: list[Skill], **parameters: Any) -> list[str]:
    """Of steps, each a navigation skill and the perception skills beside it."""
    sequence = []
    for navigation, *others in steps:
        first, *rest = (
            {"name": name, "parameters": values} for name, values in (navigation, *others)
        )
        sequence.append({"navigation_skill": first, "perception_skills": rest})
    record = {"task": "KeepStation", "prompt": prompt, "parameters": parameters}
    return list(step_problems({**record, "expected": {"skill_sequence": sequence}}, USV))


def hold(seconds: Any) -> Skill:
    return "StationKeep", {"time": seconds}


def turn(heading: float) -> Skill:
    return "RotateToHeading", {"heading": heading}


def test_a_value_is_said_by_the_prompt_or_by_the_task() -> None:
    assert problems("Hold for 30 seconds.", [hold(30)]) == []
    assert problems("Hold for the duration.", [hold(30)], duration=30) == []
    (problem,) = problems("Hold for 30 seconds.", [hold(30)], [hold(40)])
    assert problem.startswith("skill_sequence[1] StationKeep, time: 40 s does not follow from")


def test_waypoints_and_three_turns_and_more_are_computed() -> None:
    assert problems("Go round it.", [("GoToXY", {"x": 3, "y": 4})]) == []
    assert problems("Look round.", [turn(10)], [turn(130)], [turn(250)]) == []
    two = problems("Look to both sides.", [turn(10)], [turn(200)])
    assert [problem.split(",")[0] for problem in two] == [
        "skill_sequence[0] RotateToHeading",
        "skill_sequence[1] RotateToHeading",
    ]


def test_a_skill_stands_once_in_a_step_with_the_same_parameters() -> None:
    look: Skill = ("DetectObjects", {})
    assert problems("Hold 30 s and look.", [hold(30), look], [hold(30), look]) == []
    (problem,) = problems("Hold 30 s and look.", [hold(30), look, look])
    assert "DetectObjects: stands twice in the step" in problem


@pytest.mark.parametrize("skill", [hold("long"), ("StationKeep", {"depth": 7}), ("Fly", {"z": 1})])
def test_what_the_schema_refuses_is_left_to_it(skill: Skill) -> None:
    assert problems("Hold for 30 seconds.", [skill]) == []


@pytest.mark.parametrize("expected", [{}, {"skill_sequence": 3}])
def test_an_answer_without_steps_has_none_to_check(expected: dict[str, Any]) -> None:
    record = {"task": "KeepStation", "prompt": "Hold.", "parameters": {}, "expected": expected}
    assert list(step_problems(record, USV)) == []


def lost(prompt: str, *tags: str) -> list[str]:
    """What the complete record of a plan that holds at [3, 4] for 30 s lacks of the command."""
    place = {"target_position": [3, 4]}
    tasks = [
        {"title": "Transit", "parameters": place, "task_prompt": "Go to [3, 4]."},
        {"title": "KeepStation", "parameters": {"duration": 30}, "task_prompt": "Hold 30 s."},
    ]
    expected = {"tasks": tasks, "assumptions": [], "constraints": []}
    record = {"prompt": prompt, "expected": expected, "tags": list(tags)}
    return list(completeness_problems(record, USV))


def test_sayings_and_what_is_only_told_are_no_lost_values() -> None:
    hold = "Hold for 30 s at [3, 4]"
    assert lost(f"{hold}, then we call it a day. Handover in an hour.") == []
    (problem,) = lost(f"{hold}; the battery is down to 18 %.")
    assert "'18 %' of the command stands in no parameter" in problem and "rule.told" in problem
    assert lost(f"{hold}; the battery is down to 18 %.", "rule.told") == []


def test_a_value_in_a_unit_of_the_vehicle_is_not_lost() -> None:
    (task,) = [task for task in USV.tasks if task.title == "KeepStation"]
    (time,) = [item for item in task.parameters if item.name == "duration"]
    minutes = replace(task, parameters=(replace(time, unit="min"),))
    others = tuple(minutes if one is task else one for one in USV.tasks)
    tasks = [{"title": "KeepStation", "parameters": {"duration": 30}, "task_prompt": "Hold."}]
    expected = {"tasks": tasks, "assumptions": [], "constraints": []}
    record = {"prompt": "Hold for half an hour.", "expected": expected, "tags": []}
    assert list(completeness_problems(record, replace(USV, tasks=others))) == []
    assert list(completeness_problems(record, USV)) != []
