"""Expected and predicted plans side by side."""

from __future__ import annotations

from typing import Any

from planner_ft.benchmark.metrics.alignment import plan_entries
from planner_ft.report.answers import differences
from planner_ft.vocabulary import load_vocabulary

USV = load_vocabulary("usv")


def mission(*tasks: tuple[str, dict[str, Any]]) -> Any:
    return plan_entries(
        "mission",
        {"tasks": [{"title": title, "parameters": parameters} for title, parameters in tasks]},
    )


def step(navigation: str, *perception: str) -> dict[str, Any]:
    return {
        "navigation_skill": {"name": navigation, "parameters": {}},
        "filter_skills": [],
        "perception_skills": [{"name": name, "parameters": {}} for name in perception],
    }


HOME, PLACE = ("Transit", {"target_position": [0, 0]}), ("Transit", {"target_position": [40, 20]})
HOLD, CHECK = ("KeepStation", {"duration": 300}), ("Diagnostics", {})


def marks(
    expected: Any, predicted: Any, level: Any = "mission"
) -> list[tuple[str, int | None, int | None]]:
    return [
        (line.mark, line.expected, line.predicted)
        for line in differences(level, expected, predicted, USV)
    ]


def test_equal_plans_have_no_difference() -> None:
    assert marks(mission(PLACE, HOLD, HOME), mission(PLACE, HOLD, HOME)) == [
        ("same", 0, 0),
        ("same", 1, 1),
        ("same", 2, 2),
    ]


def test_missing_and_extra_tasks_stand_where_they_belong() -> None:
    assert marks(mission(PLACE, HOLD, HOME), mission(PLACE, HOME)) == [
        ("same", 0, 0),
        ("missing", 1, None),
        ("same", 2, 1),
    ]
    assert marks(mission(PLACE, HOME), mission(CHECK, PLACE, HOLD, HOME)) == [
        ("extra", None, 0),
        ("same", 0, 1),
        ("extra", None, 2),
        ("same", 1, 3),
    ]


def test_a_task_instead_of_another_is_one_line() -> None:
    assert marks(mission(PLACE, HOLD, HOME), mission(PLACE, CHECK, HOME)) == [
        ("same", 0, 0),
        ("substituted", 1, 1),
        ("same", 2, 2),
    ]


def test_a_changed_value_is_named_and_tolerance_is_that_of_the_benchmark() -> None:
    lines = differences(
        "mission", mission(HOLD), mission(("KeepStation", {"duration": 30, "speed": 1})), USV
    )
    assert [(line.mark, line.changed) for line in lines] == [("changed", ("duration", "speed"))]
    assert marks(mission(HOLD), mission(("KeepStation", {"duration": 301}))) == [("same", 0, 0)]


def test_only_what_left_its_place_has_moved() -> None:
    found = marks(mission(CHECK, PLACE, HOLD, HOME), mission(PLACE, HOLD, HOME, CHECK))
    assert found == [("moved", 0, 3), ("same", 1, 0), ("same", 2, 1), ("same", 3, 2)]


def test_a_skill_in_another_step_has_moved() -> None:
    expected = plan_entries(
        "task", {"skill_sequence": [step("StationKeep", "DetectObjects"), step("GoToXY")]}
    )
    predicted = plan_entries(
        "task", {"skill_sequence": [step("StationKeep"), step("GoToXY", "DetectObjects")]}
    )
    assert marks(expected, predicted, "task") == [("same", 0, 0), ("moved", 1, 2), ("same", 2, 1)]


def test_an_answer_that_is_empty_misses_everything() -> None:
    assert marks(mission(PLACE, HOME), ()) == [("missing", 0, None), ("missing", 1, None)]
    assert marks((), mission(HOME)) == [("extra", None, 0)]
