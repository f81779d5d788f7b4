"""Parameters: which values agree, and what they count for."""

from __future__ import annotations

from typing import Any

import pytest

from planner_ft.benchmark.metrics.alignment import Entry, align, plan_entries, values_agree
from planner_ft.benchmark.metrics.answers import Counts, Parameters, compare_parameters
from planner_ft.vocabulary import Parameter, load_vocabulary

from .plans import mission

USV = load_vocabulary()


def counted(expected: Any, predicted: Any) -> Parameters:
    entries = (plan_entries("mission", plan) for plan in (expected, predicted))
    return compare_parameters(align(*entries, USV), USV)


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


NUMBER, POLYGON = Parameter("p", "number", "s"), Parameter("p", "polygon")
RING = [[0, 0], [10, 0], [10, 5], [0, 5]]
UNRESOLVED = list(USV.unresolved)


@pytest.mark.parametrize(
    ("given", "stated", "parameter", "agree"),
    [
        # 2 % of a number, at least half a unit of the second decimal.
        (10.2, 10, NUMBER, True),
        (9.8, 10, NUMBER, True),
        (10.201, 10, NUMBER, False),
        (-10.2, -10, NUMBER, True),
        (-10.201, -10, NUMBER, False),
        (0.005, 0, NUMBER, True),
        (0.0051, 0, NUMBER, False),
        (0.105, 0.1, NUMBER, True),
        (0.1051, 0.1, NUMBER, False),
        (0.306, 0.3, NUMBER, True),
        (True, 1, NUMBER, False),
        ("10", 10, NUMBER, False),
        (None, 10, NUMBER, False),
        (True, True, None, True),
        (1, True, None, False),
        (None, None, None, True),
        # 2 % of a place's distance from the origin, half a metre at most.
        ([10.2, 0], [10, 0], None, True),
        ([10.21, 0], [10, 0], None, False),
        ([1000.5, 0], [1000, 0], None, True),
        ([1000.51, 0], [1000, 0], None, False),
        ([300.3, 400.4], [300, 400], None, True),
        (UNRESOLVED, UNRESOLVED, None, True),
        ([-99, -99.1], UNRESOLVED, None, False),
        ([1, 2, 3], [1, 2], None, False),
        ([1, 2], "1, 2", None, False),
        (["a", 1], ["A", 1.01], None, True),
        (["a"], ["a", "b"], None, False),
        ("a", ["a"], None, False),
        ("The  Red buoy", "red Buoy", None, True),
        ("red buoys", "red buoy", None, False),
        (4, "4", Parameter("p", "id"), True),
        ("4", 4, Parameter("p", "id"), True),
        (5, 4, Parameter("p", "id"), False),
        # Rings from any corner, either way round, closed or open.
        (RING[2:] + RING[:2], RING, POLYGON, True),
        (RING[::-1], RING, POLYGON, True),
        ([*RING, RING[0]], RING, POLYGON, True),
        (RING, [*RING, RING[0]], POLYGON, True),
        ([RING[0], RING[2], RING[1], RING[3]], RING, POLYGON, False),
        (RING[:3], RING, POLYGON, False),
        ([*RING[:3], RING[0]], RING[:3], POLYGON, True),
        ([], [], POLYGON, True),
        ([], RING, POLYGON, False),
        ("ring", RING, POLYGON, False),
        (RING, "ring", POLYGON, False),
        (5, RING, POLYGON, False),
        (RING, None, POLYGON, False),
        (None, RING, POLYGON, False),
    ],
)
def test_values_agree_up_to_the_labelling_rules(
    given: Any, stated: Any, parameter: Parameter | None, agree: bool
) -> None:
    assert values_agree(given, stated, parameter, USV) is agree


def test_a_text_of_up_to_40_characters_is_read_as_a_quantity() -> None:
    text = "one hundred thousand two hundred minutes"
    assert len(text) == 40
    assert values_agree(f" {text} ", 100200 * 60, NUMBER, USV, loose=True)
    longer = text.replace("two", "nine")
    assert not values_agree(longer, 100900 * 60, NUMBER, USV, loose=True)
    assert not values_agree("5 min", 300, None, USV, loose=True)
    assert not values_agree("5 min 5", 300, NUMBER, USV, loose=True)
    assert values_agree("x", "X", NUMBER, USV, loose=True)


def test_changed_keys_are_those_of_either_side() -> None:
    def entry(name: str, role: str = "task", /, **parameters: Any) -> Entry:
        return Entry(name, role, 0, parameters, True)

    stated = entry("PerformOrbit", center=[1, 1], radius=20)
    changed = stated.changed(entry("PerformOrbit", radius=21, speed=2), USV)
    assert changed == ("center", "radius", "speed")
    assert stated.changed(entry("PerformOrbit", center=[1, 1], radius=20.1), USV) == ()
    stated, given = entry("KeepStation", duration=300), entry("KeepStation", duration="5 min")
    assert stated.changed(given, USV) == ("duration",)
    assert stated.agreeing(given, USV) == ["duration"]
    assert set(entry("GoToXY", "navigation").known(USV)) > {"x", "y"}
    assert entry("GoToXY").known(USV) == entry("Sail", "navigation").known(USV) == {}


def test_lists_are_sets_by_content_and_in_the_order_of_urgency_by_form() -> None:
    urgency = USV.task["SmartDataHarvest"].by_name["target_list"]
    assert values_agree(["b", "The A"], ["a", "b"], urgency, USV, loose=True)
    assert not values_agree(["b", "a"], ["a", "b"], urgency, USV)
    assert not values_agree(["a"], ["a", "b"], urgency, USV, loose=True)
    assert not values_agree("ab", ["a", "b"], urgency, USV, loose=True)
    assert not values_agree(["a", 1], ["a", "b"], urgency, USV, loose=True)


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
    found = counted(stated, given)
    assert (found.right, found.values, found.types) == (0, Counts(1, 1, 1), {"number": (1, 1)})


def test_parameters_of_tasks_and_skills_by_their_type() -> None:
    expected = mission(
        ("PerformOrbit", {"center": [1, 1], "radius": 20, "colour": "red"}),
        ("PerformOrbit", {"center": [9, 9], "radius": 30}),
        "Diagnostics",
    )
    predicted = mission(
        ("PerformOrbit", {"center": [1, 1], "radius": 20, "colour": "red"}),
        ("PerformOrbit", {"center": [9, 9], "speed": 1}),
        ("Sail", {"far": 1}),
        "Diagnostics",
    )
    found = counted(expected, predicted)
    assert (found.right, found.matched) == (2, 3)
    assert (found.keys, found.keys_overall) == (Counts(4, 5, 5), Counts(4, 6, 5))
    assert found.values == Counts(4, 5, 5)
    assert found.types == {"position": (2, 2), "number": (1, 2), "unknown": (1, 1)}
