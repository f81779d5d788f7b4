"""Parameters: which values agree, and what they count for."""

from __future__ import annotations

from typing import Any

import pytest

from planner_ft.benchmark.metrics.alignment import align, plan_entries
from planner_ft.benchmark.metrics.names import Counts, Parameters, compare_parameters
from planner_ft.benchmark.metrics.values import values_agree
from planner_ft.vocabulary import Parameter, load_vocabulary

from .plans import mission

USV = load_vocabulary()


def counted(expected: Any, predicted: Any) -> Parameters:
    return compare_parameters(
        "mission",
        align(
            "mission", plan_entries("mission", expected), plan_entries("mission", predicted), USV
        ),
        USV,
    )


@pytest.mark.parametrize(
    ("given", "unit", "agree"),
    [
        ("300 s", "s", True),
        ("5 min", "s", True),
        ("five minutes", "s", True),
        ("300", "s", True),
        ("-300 s", "s", False),
        ("300 m", "s", False),
        ("about 300 s or so", "s", False),
        ("0.3 km", "m", True),
        ("300 m", "m", True),
        ("1 to 300 m", "m", False),
        ("", "m", False),
        ("x" * 1000, "m", False),
    ],
)
def test_a_text_with_a_unit_has_the_content_of_a_number_but_not_its_form(
    given: str, unit: str, agree: bool
) -> None:
    parameter = Parameter("p", "number", unit)
    assert values_agree(given, 300, parameter, USV, loose=True) is agree
    assert not values_agree(given, 300, parameter, USV)


@pytest.mark.parametrize(
    ("given", "stated", "agree"),
    [
        ([100, 5], [100, 5], True),
        ([100.3, 5.3], [100, 5], True),
        ([100, 6], [100, 5], False),
        ([100, -5], [100, 5], False),
        ([2, 1], [2.05, 1], False),
        ([2, 1], [2.03, 1], True),
        ([1000, 0], [1010, 0], False),
        ([-99, -99], [-99.1, -99], False),
    ],
)
def test_positions_agree_by_distance(given: list[float], stated: list[float], agree: bool) -> None:
    """2 % of a position a kilometre away would be twenty metres: half a metre is the most."""
    assert values_agree(given, stated, Parameter("p", "position"), USV) is agree


def test_lists_are_sets_by_content_and_in_the_order_of_urgency_by_form() -> None:
    urgency = USV.task["SmartDataHarvest"].by_name["target_list"]
    assert values_agree(["b", "The A"], ["a", "b"], urgency, USV, loose=True)
    assert not values_agree(["b", "a"], ["a", "b"], urgency, USV)
    assert not values_agree(["a"], ["a", "b"], urgency, USV, loose=True)


def test_a_closed_ring_is_the_open_one() -> None:
    ring = [[0, 0], [10, 0], [10, 5]]
    assert values_agree([*ring, ring[0]], ring, Parameter("p", "polygon"), USV)
    there_and_back = [ring[0], ring[1], ring[0]]
    assert not values_agree(there_and_back, ring[:2], Parameter("p", "polygon"), USV)


def test_keys_and_values_in_matched_tasks_and_in_the_whole_plan() -> None:
    """A key-value pair counts in the task that it stands in; an extra or a missing task counts only
    in the whole plan.
    """
    expected = mission(
        ("PerformOrbit", {"center": [1, 1], "radius": 20}), ("Transit", {"target_position": [0, 0]})
    )
    predicted = mission(
        ("PerformOrbit", {"center": [1, 1], "radius": 30, "speed": 2}),
        ("KeepStation", {"duration": 60, "position": [1, 1]}),
    )
    counts = counted(expected, predicted)
    assert (counts.keys, counts.values) == (Counts(2, 3, 2), Counts(1, 3, 2))
    assert (counts.keys_overall, counts.values_overall) == (Counts(2, 5, 3), Counts(1, 5, 3))


def test_a_value_in_the_wrong_task_is_lost_in_one_and_invented_in_the_other() -> None:
    expected = mission(("PerformOrbit", {"radius": 20}), ("SurveyTarget", {}))
    assert counted(
        expected, mission(("PerformOrbit", {}), ("SurveyTarget", {"radius": 20}))
    ).values == Counts(0, 1, 1)


def test_what_is_not_labelled_is_not_compared() -> None:
    names_only = {"tasks": [{"title": "PerformOrbit"}, {"title": "Transit"}]}
    predicted = mission(("PerformOrbit", {"radius": 20}), ("KeepStation", {"duration": 5}))
    assert counted(names_only, predicted) == Parameters(0, 0, *[Counts(0, 0, 0)] * 4, {})
    assert counted(mission(), predicted).values_overall == Counts(0, 2, 0)


def test_a_text_with_a_unit_counts_as_a_value_but_the_entry_is_not_right() -> None:
    stated, given = (
        mission(("KeepStation", {"duration": 300})),
        mission(("KeepStation", {"duration": "5 min"})),
    )
    alignment = align(
        "mission", plan_entries("mission", stated), plan_entries("mission", given), USV
    )
    found = compare_parameters("mission", alignment, USV)
    assert (found.right, found.values, found.types) == (0, Counts(1, 1, 1), {"number": (1, 1)})
