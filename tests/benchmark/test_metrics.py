"""Metrics against cases computed by hand."""

from __future__ import annotations

import copy
import random
from typing import Any

import pytest

from planner_ft.benchmark.metrics.alignment import align, plan_entries, values_agree
from planner_ft.benchmark.metrics.answers import (
    FAILURES,
    PUBLISHED,
    Answer,
    Parameters,
    compare_parameters,
    failure_kind,
    set_counts,
)
from planner_ft.benchmark.samples import Sample
from planner_ft.benchmark.scoring import score_sample
from planner_ft.vocabulary import load_vocabulary
from planner_ft.vocabulary.plans import Level
from tests.values import changeable

USV = load_vocabulary()


def mission(*tasks: tuple[str, dict[str, Any]]) -> dict[str, Any]:
    entries = [
        {"title": title, "parameters": dict(parameters), "task_prompt": "Do it."}
        for title, parameters in tasks
    ]
    return {"tasks": entries, "assumptions": [], "constraints": []}


def step(
    navigation: tuple[str, dict[str, Any]],
    filters: tuple[str, ...] = (),
    perception: tuple[str, ...] = (),
) -> dict[str, Any]:
    return {
        "navigation_skill": {"name": navigation[0], "parameters": navigation[1]},
        "filter_skills": [{"name": name, "parameters": {}} for name in filters],
        "perception_skills": [{"name": name, "parameters": {}} for name in perception],
        "stop_conditions": [],
        "failure_modes": [],
        "expected_outputs": [],
    }


def parameter_agreement(level: Level, plan: Any, expected: Any) -> Parameters:
    entries = plan_entries(level, expected), plan_entries(level, plan)
    return compare_parameters(align(*entries, USV), USV)


ORBIT = mission(
    ("SearchAndDetect", {"target_description": "green barrel"}),
    ("Transit", {"target_position": [-99, -99]}),
    ("PerformOrbit", {"center": [-99, -99], "radius": 20}),
    ("Transit", {"target_position": [0, 0]}),
)


def test_what_was_measured_cannot_be_changed() -> None:
    names = ("metrics", "paired", "statistics")
    assert changeable(*(f"planner_ft.benchmark.{name}" for name in names)) == []


@pytest.mark.parametrize(
    ("predicted", "expected", "value"),
    [
        ([], [], 1.0),
        (["A"], [], 0.0),
        ([], ["A"], 0.0),
        (["A", "B"], ["B", "A", "A"], 1.0),
        (["A"], ["A", "B"], 2 / 3),
        (["A", "X"], ["A", "B", "C"], 2 * (1 / 2) * (1 / 3) / (1 / 2 + 1 / 3)),
        (["X"], ["A"], 0.0),
    ],
)
def test_set_f1(predicted: list[str], expected: list[str], value: float) -> None:
    assert set_counts(predicted, expected).f1 == pytest.approx(value)


def test_hallucination_in_both_readings() -> None:
    invented = mission(("Berthing", {}), ("Transit", {"target_position": [0, 0]}))
    sample = Sample("a", "a", {"id": "a", "prompt": "Go.", "expected": ORBIT})
    for output, counted, named in (
        ("no", True, False),
        (invented, True, True),
        (ORBIT, False, False),
    ):
        values = score_sample("mission", sample, {"output": output}, USV).values
        assert values["hallucination"] == values["hallucination_with_unparsed"] == counted
        assert values["hallucination_without_unparsed"] == named
    smelt = {"skill_sequence": [step(("StationKeep", {}), perception=("SmellWater",))]}
    assert Answer("task", smelt, {}, USV).invented == ["SmellWater"]


def test_an_invented_name_is_schema_valid_but_not_strictly_valid() -> None:
    invented = mission(("Berthing", {}))
    assert Answer("mission", invented, {}, USV).schema_valid
    assert not Answer("mission", invented, {}, USV).strict_valid
    assert Answer("mission", ORBIT, {}, USV).schema_valid
    assert Answer("mission", ORBIT, {}, USV).strict_valid
    assert not Answer("mission", {"tasks": []}, {}, USV).schema_valid
    assert not Answer("mission", None, {}, USV).schema_valid
    wrong_role = {"skill_sequence": [step(("LockHeading", {"heading": 0}))]}
    assert Answer("task", wrong_role, {}, USV).schema_valid
    assert not Answer("task", wrong_role, {}, USV).strict_valid


def test_the_published_agent_failed_on_nine_of_25_commands() -> None:
    assert PUBLISHED == {
        "prerequisite omission": 4,
        "parameter propagation": 2,
        "substitution": 2,
        "hallucination": 1,
    }
    assert tuple(PUBLISHED) == FAILURES[:4]


def test_exact_sequence_minds_order_and_repetition() -> None:
    assert Answer("mission", copy.deepcopy(ORBIT), ORBIT, USV).exact_sequence
    assert not Answer(
        "mission", {**ORBIT, "tasks": ORBIT["tasks"][::-1]}, ORBIT, USV
    ).exact_sequence
    assert not Answer("mission", {**ORBIT, "tasks": ORBIT["tasks"][:3]}, ORBIT, USV).exact_sequence
    assert not Answer("mission", None, mission(), USV).exact_sequence
    assert Answer("mission", mission(), mission(), USV).exact_sequence


def test_exact_sequence_ignores_the_order_of_skills_that_run_together() -> None:
    here = {
        "skill_sequence": [
            step(("StationKeep", {}), perception=("DetectObjects", "GetGPSLocation"))
        ]
    }
    there = {
        "skill_sequence": [
            step(("StationKeep", {}), perception=("GetGPSLocation", "DetectObjects"))
        ]
    }
    apart = {
        "skill_sequence": [
            step(("StationKeep", {}), perception=("GetGPSLocation",)),
            step(("StationKeep", {}), perception=("DetectObjects",)),
        ]
    }
    assert Answer("task", here, there, USV).exact_sequence
    assert not Answer("task", apart, here, USV).exact_sequence


@pytest.mark.parametrize(
    ("given", "stated", "agree"),
    [
        (100, 100.0, True),
        (101.9, 100, True),
        (102.1, 100, False),
        (0, 0, True),
        (0.004, 0, True),
        (0.006, 0, False),
        (0.12, 0.1, False),
        ([45, 10], [45.0, 10.0], True),
        ([45, 10], [10, 45], False),
        ([45.5, 10], [45, 10], True),
        ([45], [45, 10], False),
        ([-99, -99], [-99, -99], True),
        ([-98, -99], [-99, -99], False),
        ([-99, -99], [-98, -99], False),
        ("the Green  barrel", "green barrel", True),
        ("red barrel", "green barrel", False),
        ("7", 7, False),
        (True, 1, False),
        (1, "1", False),
        (["a", "b"], ["b", "a"], False),
        (["A", "the b"], ["a", "b"], True),
        (None, None, True),
    ],
)
def test_values_agree(given: Any, stated: Any, agree: bool) -> None:
    assert values_agree(given, stated, None, USV) is agree


def test_identifiers_may_be_numbers_and_polygons_turn() -> None:
    identifier = USV.task["FollowTarget"].by_name["target_id"]
    assert values_agree(7, "7", identifier, USV)
    assert not values_agree(7, "8", identifier, USV)
    polygon = next(
        parameter
        for skill in USV.skills
        for parameter in skill.parameters
        if parameter.type == "polygon"
    )
    ring = [[0, 0], [10, 0], [10, 5], [0, 5]]
    assert values_agree(ring[2:] + ring[:2], ring, polygon, USV)
    assert values_agree(ring[::-1], ring, polygon, USV)
    assert not values_agree([ring[0], ring[2], ring[1], ring[3]], ring, polygon, USV)
    assert not values_agree("ring", ring, polygon, USV)


def test_parameters_match_entries_of_equal_name_best_first() -> None:
    swapped = {**ORBIT, "tasks": [ORBIT["tasks"][3], *ORBIT["tasks"][1:3], ORBIT["tasks"][0]]}
    agreement = parameter_agreement("mission", swapped, ORBIT)
    assert (agreement.right, agreement.matched) == (4, 4)
    changed = mission(
        ("Transit", {"target_position": [0, 0]}),
        ("PerformOrbit", {"center": [-99, -99], "radius": 30}),
        ("Diagnostics", {}),
    )
    agreement = parameter_agreement("mission", changed, ORBIT)
    assert (agreement.right, agreement.matched) == (1, 2)
    agreement = parameter_agreement("mission", None, ORBIT)
    assert (agreement.right, agreement.matched) == (0, 0)


def test_an_invented_parameter_is_wrong_and_an_unlabelled_one_is_not_compared() -> None:
    extra = mission(("PerformOrbit", {"center": [-99, -99], "radius": 20, "speed": 1}))
    stated = mission(("PerformOrbit", {"center": [-99, -99], "radius": 20}))
    assert parameter_agreement("mission", extra, stated).right == 0
    names_only = {"tasks": [{"title": "PerformOrbit"}]}
    assert parameter_agreement("mission", extra, names_only).matched == 0
    assert failure_kind(Answer("mission", extra, names_only, USV)) is None


def changed_orbit(index: int, **parameters: Any) -> dict[str, Any]:
    plan = copy.deepcopy(ORBIT)
    plan["tasks"][index]["parameters"].update(parameters)
    return plan


def without(*indices: int) -> dict[str, Any]:
    return {
        **ORBIT,
        "tasks": [task for index, task in enumerate(ORBIT["tasks"]) if index not in indices],
    }


def inserted(index: int, title: str, **parameters: Any) -> dict[str, Any]:
    plan = copy.deepcopy(ORBIT)
    plan["tasks"].insert(index, {"title": title, "parameters": parameters, "task_prompt": "."})
    return plan


def retitled(index: int, title: str) -> dict[str, Any]:
    plan = copy.deepcopy(ORBIT)
    plan["tasks"][index]["title"] = title
    return plan


@pytest.mark.parametrize(
    ("plan", "kind"),
    [
        (ORBIT, None),
        (changed_orbit(2, radius=20.2), None),
        (without(0), "prerequisite omission"),
        (without(1), "prerequisite omission"),
        (without(3), "omission"),
        (without(0, 1), "prerequisite omission"),
        (without(2, 3), "omission"),
        (changed_orbit(2, radius=25), "parameter propagation"),
        (changed_orbit(1, target_position=[20, 20]), "parameter propagation"),
        (inserted(3, "Transit", target_position=[-99, -99]), "parameter propagation"),
        (inserted(0, "Diagnostics"), "extra step"),
        (retitled(2, "SurveyTarget"), "substitution"),
        (retitled(2, "Circling"), "hallucination"),
        ({**ORBIT, "tasks": ORBIT["tasks"][::-1]}, "wrong order"),
        (
            {**ORBIT, "tasks": [ORBIT["tasks"][index] for index in (0, 3, 2, 1)]},
            "parameter propagation",
        ),
        (None, "invalid output"),
        ({"tasks": ORBIT["tasks"]}, "invalid output"),
    ],
)
def test_failure_kinds_of_the_mission_level(plan: dict[str, Any] | None, kind: str | None) -> None:
    assert failure_kind(Answer("mission", plan, ORBIT, USV)) == kind


def test_an_upstream_transit_without_a_later_one_is_a_prerequisite() -> None:
    expected = mission(
        ("Transit", {"target_position": [5, 5]}),
        ("KeepStation", {"position": [5, 5], "duration": 60}),
    )
    assert (
        failure_kind(Answer("mission", {**expected, "tasks": expected["tasks"][1:]}, expected, USV))
        == "prerequisite omission"
    )


def test_failure_kinds_of_the_task_level() -> None:
    expected = {
        "skill_sequence": [
            step(("GoToXY", {"x": 1, "y": 2}), perception=("DetectObjects",)),
            step(("StationKeep", {"time": 60})),
        ]
    }
    assert failure_kind(Answer("task", copy.deepcopy(expected), expected, USV)) is None
    moved = copy.deepcopy(expected)
    moved["skill_sequence"][0]["navigation_skill"]["parameters"]["x"] = 3
    assert failure_kind(Answer("task", moved, expected, USV)) == "parameter propagation"
    assert (
        failure_kind(
            Answer("task", {"skill_sequence": expected["skill_sequence"][:1]}, expected, USV)
        )
        == "omission"
    )
    assert (
        failure_kind(
            Answer("task", {"skill_sequence": expected["skill_sequence"][::-1]}, expected, USV)
        )
        == "wrong order"
    )


def test_metrics_survive_any_json() -> None:
    rng = random.Random(0)
    pieces: list[Any] = [None, True, 3, -1.5, "Transit", "x", [], {}]

    def anything(depth: int) -> Any:
        if depth == 0:
            return rng.choice(pieces)
        if rng.random() < 0.5:
            return [anything(depth - 1) for _ in range(rng.randrange(3))]
        keys = [
            "tasks",
            "skill_sequence",
            "title",
            "name",
            "parameters",
            "navigation_skill",
            "filter_skills",
            "perception_skills",
        ]
        return {rng.choice(keys): anything(depth - 1) for _ in range(rng.randrange(4))}

    expected = {"mission": ORBIT, "task": {"skill_sequence": [step(("StationKeep", {}))]}}
    for _ in range(3000):
        plan = anything(5)
        if isinstance(plan, dict):
            for level in ("mission", "task"):
                answer = Answer(level, plan, expected[level], USV)
                assert failure_kind(answer) is not None
                parameter_agreement(level, plan, expected[level])
                assert isinstance(answer.invented, list)
                assert {type(answer.strict_valid), type(answer.exact_sequence)} == {bool}
