"""How sure the agents are, in a document: levels, questions, and what an edit does to them."""

from __future__ import annotations

import math
from typing import Any

import pytest

from planner_ft.confidence.calibration import Judgement
from planner_ft.document import adopt, apply, document_digest, revise, undo
from planner_ft.document.build import PlanDocument, build, document_problem
from planner_ft.document.confidence import (
    choice_lines,
    confidence_lines,
    doubtful_text,
    held,
    least_sure,
    open_choices,
)
from planner_ft.document.tree import plan_tree
from planner_ft.planning.result import AgentUse, Answer, Planned, PlannedTask, doubts
from planner_ft.review.commands import parse_edit
from planner_ft.support.errors import PlannerError
from tests.documents import USV, document, step

COMMAND = "Circle the pier at [40, 10] at 12 m or 15 m, hold at [40, 10] for ten minutes."
TASKS: list[dict[str, Any]] = [
    {"title": "PerformOrbit", "parameters": {"center": [40, 10], "radius": 12}},
    {"title": "KeepStation", "parameters": {"duration": 600}},
]
RADIUS, TITLE = ("tasks", 0, "parameters", "radius"), ("tasks", 1, "title")


def judged(count: int = 2, **reason: str) -> Judgement:
    """The second title is a guess, the radius to be checked, and the rest is sure."""
    if reason:
        return Judgement(**reason)
    held: dict[Any, float] = {(): 0.5}
    for at, task in enumerate(TASKS * (count // 2)):
        held |= {("tasks", at): 0.97, ("tasks", at, "title"): 0.99}
        held |= {("tasks", at, "parameters", name): 0.99 for name in task["parameters"]}
    others = {RADIUS: (("15", 0.3),), TITLE: (('"FeatureSt', 0.4), ('"Dia', 0.2))}
    return Judgement("", {**held, RADIUS: 0.8, TITLE: 0.4}, others)


def planned(mission: Judgement, skills: Judgement, count: int = 2) -> PlanDocument:
    entries = [{**task, "task_prompt": "Do it."} for task in TASKS * (count // 2)]
    plan = {"tasks": entries, "assumptions": [], "constraints": []}
    steps = {"skill_sequence": [step("StationKeep", {"time": 600})]}
    answer = Answer("", steps, (), (), 1, 1, 1, 1.0, judged=skills)
    tasks = tuple(PlannedTask(**entry, answer=answer) for entry in entries)
    own = Answer("", plan, (), (), 1, 1, 1, 1.0, judged=mission)
    asked = tuple(doubts(COMMAND, plan, mission, USV))
    manifest = document([])["manifest"]
    use = {"mission": AgentUse("embedded", "lora", None, 0.0, 1, 1, 1, 1, 1.0)}
    what = COMMAND, own, tasks, (), {}, use, 1, manifest
    return build(Planned(*what, doubts=asked), USV)


@pytest.fixture
def plan() -> PlanDocument:
    return planned(judged(), Judgement("", {(): 0.96}))


def levels(plan: PlanDocument, at: int) -> dict[str, str]:
    found = plan["tasks"][at]["confidence"]
    return {name: one["level"] for name, one in found.get("values", {}).items()}


def test_levels_stand_in_document_and_terminal(plan: PlanDocument) -> None:
    assert document_problem(plan, USV) is None
    assert plan["confidence"] == {
        "level": "unsure",
        "probability": pytest.approx(0.5 * 0.96**2, abs=1e-4),
    }
    assert levels(plan, 0) == {"title": "sure", "center": "sure", "radius": "check"}
    assert levels(plan, 1) == {"title": "unsure", "duration": "sure"}
    assert {one["confidence"]["skills"]["level"] for one in plan["tasks"]} == {"sure"}
    text = plan_tree(plan)
    assert "How sure: unsure (task 1 check, task 2 unsure)" in text
    assert "(how sure: radius check)" in text and "0.8" not in text


def test_the_least_sure_choices_are_questions_with_the_models_alternatives(
    plan: PlanDocument,
) -> None:
    assert [(one["text"], one["others"]) for one in plan["choices"]] == [
        ("Task 2: KeepStation or FeatureStare?", ["FeatureStare"]),
        ("Task 1, PerformOrbit: radius 12 m or 15 m?", [15]),
    ]
    assert " - Task 1, PerformOrbit: radius 12 m or 15 m? (2a for 15)" in plan_tree(plan)
    assert plan["complete"], "a question of choice keeps no task from its skills"


def test_an_answer_is_an_edit_and_its_question_goes(plan: PlanDocument) -> None:
    changed = apply(plan, parse_edit("2a", plan, USV), USV, by="Ada")
    assert changed["tasks"][0]["parameters"]["radius"] == 15
    assert levels(changed, 0) == {"title": "sure", "center": "sure"}
    assert "task" not in changed["tasks"][0]["confidence"]
    assert [one["task"] for one in changed["choices"]] == ["t2"]
    other = apply(changed, parse_edit("1a", changed, USV), USV)
    assert other["tasks"][1]["title"] == "FeatureStare" and other["tasks"][1]["stale"]
    assert "choices" not in other and document_problem(other, USV) is None
    back = undo(undo(other, USV), USV)
    assert back["choices"] == plan["choices"] and back["tasks"] == plan["tasks"]


@pytest.mark.parametrize("typed", ["3a", "1b", "0a"])
def test_an_answer_that_is_not_offered_is_one_sentence(plan: PlanDocument, typed: str) -> None:
    with pytest.raises(PlannerError, match=f"{typed}: "):
        parse_edit(typed, plan, USV)


def test_a_title_that_needs_more_than_the_task_has_is_refused(plan: PlanDocument) -> None:
    with pytest.raises(PlannerError, match="needs more than the parameters of KeepStation"):
        apply(plan, {"kind": "title", "task": "t2", "title": "Transit"}, USV)


def test_new_skills_have_their_own_confidence(plan: PlanDocument) -> None:
    edit = {"kind": "skills", "task": "t1", "skill_sequence": [step("StationKeep")]}
    sure = {"skills": {"level": "check", "probability": 0.8}}
    assert (
        apply(plan, {**edit, "confidence": sure}, USV)["tasks"][0]["confidence"]["skills"]
        == (sure["skills"])
    )
    assert "skills" not in apply(plan, edit, USV)["tasks"][0]["confidence"]


def test_a_plan_with_confidence_that_was_altered_outside_is_adopted(plan: PlanDocument) -> None:
    plan["tasks"][0]["task_prompt"] = "Wait."
    assert adopt(plan, USV)["tasks"][0]["task_prompt"] == "Wait."


def test_what_is_not_known_is_said() -> None:
    found = planned(judged(reason="no log-probabilities"), Judgement("", {(): 0.96}))
    assert found["confidence"] == {"reason": "Mission Agent: no log-probabilities"}
    assert "choices" not in found and "values" not in found["tasks"][0]["confidence"]
    assert "How sure: not known (Mission Agent: no log-probabilities)" in plan_tree(found)


def test_a_plan_of_many_tasks_is_as_sure_as_all_of_them_together() -> None:
    found = planned(judged(30), Judgement("", {(): 0.96}), 30)
    probability = found["confidence"]["probability"]
    assert probability == pytest.approx(0.5 * 0.96**30, abs=1e-4) and math.isfinite(probability)
    assert len(found["tasks"]) == 30 and len(found["choices"]) <= 3
    assert document_problem(found, USV) is None


def test_an_older_document_says_nothing_and_stays_as_it_is() -> None:
    old = document([{**TASKS[0], "task_prompt": "Do it.", "skill_sequence": None}])
    old = {key: value for key, value in old.items() if key != "confidence"}
    old["digest"] = document_digest(old)
    assert document_problem(old, USV) is None
    assert revise(old, USV) == old
    assert "How sure" not in plan_tree(old)


def sure(level: str) -> dict[str, Any]:
    return {"level": level, "probability": 0.5}


@pytest.mark.parametrize(
    ("found", "least", "doubtful"),
    [
        ({}, None, ""),
        ({"task": sure("sure")}, "sure", ""),
        ({"task": sure("check")}, "check", "check"),
        ({"skills": sure("unsure")}, "unsure", "skills unsure"),
        (
            {"task": sure("check"), "values": {"radius": sure("unsure")}},
            "unsure",
            "check: radius unsure",
        ),
        (
            {"values": {"a": sure("check"), "b": sure("sure")}, "skills": sure("check")},
            "check",
            "a check, skills check",
        ),
    ],
)
def test_the_least_sure_part_of_a_task(found: Any, least: str | None, doubtful: str) -> None:
    assert least_sure({"confidence": found}) == least
    assert doubtful_text({"confidence": found}) == doubtful


def test_tasks_that_are_to_be_checked_are_counted_from_one() -> None:
    tasks = [{"confidence": {"task": sure(one)}} for one in ("sure", "check", "unsure")]
    plan = {"confidence": sure("check"), "tasks": tasks}
    assert list(confidence_lines(plan)) == ["How sure: check (task 2 check, task 3 unsure)"]
    assert list(confidence_lines({**plan, "tasks": tasks[:1]})) == ["How sure: check"]


def test_a_probability_has_four_digits() -> None:
    assert held(0.123456)["probability"] == 0.1235


def test_what_an_edit_leaves_of_the_confidence(plan: PlanDocument) -> None:
    other = {"kind": "parameter", "task": "t1", "name": "center", "value": [9, 9]}
    left = apply(plan, other, USV)["tasks"][0]["confidence"]
    assert sorted(left) == ["values"] and sorted(left["values"]) == ["radius", "title"]
    prompt = apply(plan, {"kind": "prompt", "task": "t1", "text": "Go."}, USV)
    left = prompt["tasks"][0]["confidence"]
    assert sorted(left) == ["task", "values"] and len(left["values"]) == 3
    gone = apply(plan, {"kind": "remove", "task": "t1"}, USV)
    assert [one["text"] for one in gone["choices"]] == ["Task 1: KeepStation or FeatureStare?"]
    first = apply(plan, {"kind": "insert", "at": 0, "title": "Diagnostics"}, USV)
    assert [one["text"].split(":")[0] for one in first["choices"]] == [
        "Task 3",
        "Task 2, PerformOrbit",
    ]


def test_a_choice_of_a_place_says_where_it_is_not_known() -> None:
    choice = {
        "task": "t1",
        "parameter": "center",
        "value": [40, 10],
        "others": [[-99, -99], [1, 2]],
    }
    shown = {"proposed": {"choices": [choice]}, "tasks": [{**TASKS[0], "id": "t1"}]}
    (asked,) = open_choices(shown, USV)
    assert asked["text"] == "Task 1, PerformOrbit: center [40,10] m, not known yet or [1,2] m?"
    listed = list(choice_lines({"choices": [asked]}))
    assert listed[0].endswith(" (1a for [-99,-99], 1b for [1,2])")
