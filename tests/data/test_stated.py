"""Labelling rules of skills: values are said, by the prompt or by the task, but for computed ones."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest

from planner_ft.data.labels import completeness_problems, step_problems, unstated
from planner_ft.facts import read_input
from planner_ft.vocabulary import Parameter, load_vocabulary

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


def test_a_telegram_may_leave_articles_out() -> None:
    camera: Skill = ("SetStreamRecording", {"sensor_id": "camera on the boom", "enable": True})
    assert problems("Hold 30 s with camera on boom.", [hold(30), camera]) == []
    (problem,) = problems("Hold 30 s with camera on mast.", [hold(30), camera])
    assert "'boom' of 'camera on the boom' not in" in problem


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


TIME, PLACE, WHAT = (
    Parameter("it", "number", "s"),
    Parameter("it", "position"),
    Parameter("it", "text"),
)
SAID = "Turn 40 degrees, hold 30 s at [3, 4] by the red buoy and Sierra 2."


@pytest.mark.parametrize(
    ("value", "parameter", "problems"),
    [
        (30, TIME, []),
        (31, TIME, ["31 s does not follow from there"]),
        (31, Parameter("it", "integer"), ["31 does not follow from there"]),
        # Turning left is said without the sign.
        (-40, Parameter("it", "number", "deg"), []),
        (-41, Parameter("it", "number", "deg"), ["-41 deg does not follow from there"]),
        ([3, 4], PLACE, []),
        ([3, 5], PLACE, ["the coordinates [3, 5] are not in there"]),
        ([[3, 5]] * 3, Parameter("it", "polygon"), []),
        ("red buoy", WHAT, []),
        ("green big buoy", WHAT, ["'green', 'big' of 'green big buoy' not in there"]),
        ("the red buoy", WHAT, ["'the red buoy' begins with an article"]),
        ("red buoy,", WHAT, ["'red buoy,' ends or begins with a blank or punctuation"]),
        (" red buoy", WHAT, ["' red buoy' ends or begins with a blank or punctuation"]),
        (2, Parameter("it", "id"), []),
        (
            ["red buoy", "a pier"],
            Parameter("it", "texts"),
            ["'pier' of 'a pier' not in there", "'a pier' begins with an article"],
        ),
    ],
)
def test_why_a_value_was_not_said(value: Any, parameter: Parameter, problems: list[str]) -> None:
    source = read_input({"prompt": SAID}, USV)
    assert list(unstated(value, parameter, source, SAID, "there")) == problems
    assert list(unstated("rad boy", WHAT, source, SAID, "there")) == []
    (missing,) = unstated("rad", WHAT, source, SAID, "there", misspelt=False)
    assert (
        missing == "'rad' of 'rad' not in there (spelling put right needs the tag param.spelling)"
    )


GO = {"title": "Transit", "parameters": {"target_position": [3, 4]}, "task_prompt": "Go to [3, 4]."}
STAY = {"title": "KeepStation", "parameters": {"duration": 30}, "task_prompt": "Hold 30 s."}
COMMAND = "Hold for 30 s at [3, 4]."
ALONE = "expected: {} of the command stand"


def record(*tasks: Any, prompt: str = COMMAND, **more: Any) -> dict[str, Any]:
    expected = {"tasks": list(tasks), "assumptions": [], "constraints": [], **more}
    return {"prompt": prompt, "expected": expected, "tags": []}


@pytest.mark.parametrize(
    ("found", "problems"),
    [
        (record(GO, STAY), []),
        (
            record(GO, {**STAY, "task_prompt": " "}),
            ["expected: tasks[1] KeepStation: task_prompt is empty"],
        ),
        (
            record(prompt="Make tea."),
            ["expected: an empty task list needs a constraint that says why"],
        ),
        (record(prompt="Make tea.", constraints=["No kitchen."]), []),
        (
            record(
                {**GO, "parameters": {"target_position": [-99, -99]}, "task_prompt": "Go."},
                prompt="Go.",
            ),
            ["expected: a plan with an unresolved place needs an assumption about it"],
        ),
        (
            record(
                {**GO, "parameters": {"target_position": [-99, -99]}, "task_prompt": "Go."},
                prompt="Go.",
                assumptions=["It is there."],
            ),
            [],
        ),
        (record(GO, GO, STAY), ["expected: tasks[1] Transit: the same task again"]),
        (record(GO, STAY, GO), []),
        (
            record(GO, STAY, {**STAY, "parameters": {"duration": 30.0}}),
            ["expected: tasks[2] KeepStation: the same task again"],
        ),
        # Numbers that its texts have made up; words are none, and signs do not count.
        (
            record(GO, {**STAY, "task_prompt": "Hold 35 s."}),
            ["expected: tasks[1].task_prompt: 35 is neither in the command nor in a parameter"],
        ),
        (
            record(GO, STAY, constraints=["Stay."], assumptions=["x", "Back in 5 hours."]),
            ["expected: assumptions[1]: 5 is neither in the command nor in a parameter"],
        ),
        (
            record(GO, STAY, constraints=["At most 5 m, in two ways."]),
            ["expected: constraints[0]: 5 is neither in the command nor in a parameter"],
        ),
        (record(GO, {**STAY, "task_prompt": "Hold -30 s at 0, -99 for half a minute."}), []),
        (record(GO, {**STAY, "task_prompt": "Hold 0.5 min."}), []),
        # Values of the command that the plan has lost.
        (record(GO, prompt=COMMAND), [ALONE.format("'30 s'")]),
        (record(STAY, prompt=COMMAND), [ALONE.format("the coordinates '3, 4'")]),
        (record(STAY, prompt="Hold for 30 s at 3, 4."), []),
        (record(STAY, prompt="Hold for 30 s, an hour, a day or a minute."), []),
        (record(GO, STAY, prompt=COMMAND + " Do 7."), []),
        (record(GO, prompt=COMMAND, constraints=["Hold for 30 s."]), []),
        (record(STAY, prompt="Hold for 30 s at (3, 4).", assumptions=["At 3 and 4."]), []),
        (record(prompt=COMMAND, constraints=["No."]), []),
    ],
)
def test_what_a_curated_record_lacks(found: dict[str, Any], problems: list[str]) -> None:
    said = list(completeness_problems(found, USV))
    assert len(said) == len(problems), said
    assert all(text.startswith(part) for part, text in zip(problems, said, strict=True)), said


def test_three_turns_are_computed_and_two_are_said() -> None:
    """Also of one skill beside others, and where a step has no name."""
    assert len(problems("Look.", [turn(10)], [turn(130)])) == 2
    assert problems("Hold 30 s.", [hold(30)], [hold(30)], [hold(30)]) == []
    assert len(problems("Hold 30 s.", [hold(40)], [hold(50)], [hold(60)])) == 3
    assert problems("Look left 90.", [("NudgeYaw", {"delta_yaw": -90})]) == []


def test_texts_of_the_task_are_said_too() -> None:
    mark: Skill = ("CreateMapMarker", {"label": "old mark"})
    assert problems("Mark it.", [hold(30), mark], duration=30, note="old mark") == []
    (problem,) = problems("Mark it.", [hold(30), mark], duration=30)
    assert problem.startswith("skill_sequence[0] CreateMapMarker, label: 'old' of 'old mark'")
    record = {"task": "KeepStation", "prompt": "Hold 30 s.", "parameters": [1]}
    steps = [{"navigation_skill": {"name": "StationKeep", "parameters": {"time": 30}}}]
    assert list(step_problems({**record, "expected": {"skill_sequence": steps}}, USV)) == []
