"""Which predicted task or skill stands for which expected one."""

from __future__ import annotations

import random
from typing import Any

import pytest

from planner_ft.benchmark.metrics.alignment import (
    Alignment,
    align,
    plan_entries,
    replaced,
    substitutions,
)
from planner_ft.vocabulary import load_vocabulary
from planner_ft.vocabulary.plans import Level

from .plans import mission, step, steps

USV = load_vocabulary()


def aligned(level: Level, expected: Any, predicted: Any) -> Alignment:
    return align(plan_entries(level, expected), plan_entries(level, predicted), USV)


def transit(x: int, y: int) -> tuple[str, dict[str, Any]]:
    return "Transit", {"target_position": [x, y]}


def test_the_best_assignment_is_not_the_greedy_one() -> None:
    """The first expected pass agrees with both predicted ones in part; taking the first would leave
    the second with nothing.
    """
    expected = mission(
        ("SurveyTarget", {"radius": 10, "center": [0, 5]}),
        ("SurveyTarget", {"radius": 10, "center": [9, 9]}),
    )
    predicted = mission(
        ("SurveyTarget", {"radius": 10, "center": [7, 7]}),
        ("SurveyTarget", {"radius": 30, "center": [0, 5]}),
    )
    assert aligned("mission", expected, predicted).pairs == ((0, 1), (1, 0))


def test_parameters_that_are_all_right_come_before_everything() -> None:
    expected = mission(transit(5, 5), "Diagnostics", transit(0, 0))
    assert aligned(
        "mission", expected, mission(transit(0, 0), "Diagnostics", transit(7, 7))
    ).pairs == ((0, 2), (1, 1), (2, 0))


@pytest.mark.parametrize(
    ("near", "far", "partner"),
    [(300, 301, 0), (301, 300, 0), ("5 min", 301, 2), ("5 min", 300, 2), (400, 300, 2)],
)
def test_a_value_within_tolerance_is_as_right_as_the_stated_one(
    near: Any, far: Any, partner: int
) -> None:
    expected = mission(("KeepStation", {"duration": 300}))
    predicted = mission(
        ("KeepStation", {"duration": near}), "Diagnostics", ("KeepStation", {"duration": far})
    )
    assert aligned("mission", expected, predicted).pairs == ((0, partner),)


def test_a_share_counts_the_keys_of_both() -> None:
    """Nearness would take the first, which has the same key right and one more too many."""
    expected = mission(("PerformOrbit", {"center": [1, 1], "radius": 20}))
    more, fewer = {"radius": 20, "arc": 90, "speed": 2}, {"radius": 20, "center": [9, 9]}
    predicted = mission(("PerformOrbit", more), ("PerformOrbit", fewer))
    assert aligned("mission", expected, predicted).pairs == ((0, 1),)


def test_keys_come_before_company_and_company_before_nearness() -> None:
    expected = mission("KeepStation", ("PerformOrbit", {"center": [1, 1], "radius": 20}), "Hover")
    less, more = {"radius": 20, "arc": 90, "speed": 2}, {"radius": 20, "center": [9, 9]}
    by_keys = mission("KeepStation", ("PerformOrbit", less), "Hover", ("PerformOrbit", more))
    assert (1, 3) in aligned("mission", expected, by_keys).pairs
    far = ["Diagnostics"] * 8
    by_company = mission(
        "Hover", ("PerformOrbit", more), *far, "KeepStation", ("PerformOrbit", more)
    )
    assert (1, 11) in aligned("mission", expected, by_company).pairs


@pytest.mark.parametrize("radius", [20, 20.2])
@pytest.mark.parametrize("others", [[], ["Diagnostics"] * 18])
def test_all_right_comes_before_shares_that_add_up_to_more(
    radius: float, others: list[str]
) -> None:
    all_of_it = {"center": [1, 1], "radius": 20, "arc": 360, "speed": 2}
    expected = mission(("PerformOrbit", all_of_it), ("PerformOrbit", {"speed": 2}), *others)
    predicted = mission(
        ("PerformOrbit", {**all_of_it, "speed": 9}),
        ("PerformOrbit", {**all_of_it, "radius": radius}),
        *others,
    )
    assert aligned("mission", expected, predicted).pairs[:2] == ((0, 1), (1, 0))


def test_a_share_comes_before_nearness_however_long_the_answer_is() -> None:
    expected = mission(("PerformOrbit", {"center": [1, 1], "radius": 20}))
    near, far = {"center": [9, 9], "radius": 1}, {"center": [9, 9], "radius": 20}
    others = ["Diagnostics"] * 120
    predicted = mission(("PerformOrbit", near), *others, ("PerformOrbit", far))
    assert aligned("mission", expected, predicted).pairs == ((0, 121),)


def test_equal_tasks_are_paired_by_their_neighbours_and_then_by_nearness() -> None:
    found = transit(-99, -99)
    expected = mission(
        "SearchAndDetect", found, "PerformOrbit", "SearchAndDetect", found, "SurveyTarget"
    )
    alignment = aligned("mission", expected, mission("SearchAndDetect", found, "SurveyTarget"))
    assert (4, 1) in alignment.pairs and alignment.missing[-1] == 3
    held = step("StationKeep")
    assert aligned("task", steps(held, held, held), steps(held, held)).pairs == ((0, 0), (1, 1))


def test_skills_are_paired_in_aligned_steps() -> None:
    """The first step is lost: its skills are missing, and those of the second step stay
    together.
    """
    expected = steps(
        step(("GoToXY", {"x": 1, "y": 1}), perception=("DetectObjects",)),
        step(("GoToXY", {"x": 9, "y": 9}), perception=("DetectObjects",)),
    )
    predicted = steps(step(("GoToXY", {"x": 9, "y": 9}), perception=("DetectObjects",)))
    alignment = aligned("task", expected, predicted)
    assert alignment.pairs == ((2, 0), (3, 1)) and alignment.missing == (0, 1)


def test_navigation_skills_alike_are_told_apart_by_their_company() -> None:
    expected = steps(
        step("StationKeep", perception=("DetectObjects",)),
        step("StationKeep", perception=("GetGPSLocation",)),
    )
    alignment = aligned(
        "task", expected, steps(step("StationKeep", perception=("GetGPSLocation",)))
    )
    assert alignment.pairs == ((2, 0), (3, 1)) and alignment.missing == (0, 1)


def test_a_skill_in_another_role_is_still_paired() -> None:
    assert aligned(
        "task", steps(step("StationKeep")), steps(step("GoToXY", perception=("StationKeep",)))
    ).pairs == ((0, 1),)


def test_each_entry_is_paired_once_and_as_many_as_there_are() -> None:
    rng = random.Random(0)
    for _ in range(300):
        plans = [
            mission(
                *(
                    transit(rng.randrange(3), 0) if rng.random() < 0.6 else "Diagnostics"
                    for _ in range(rng.randrange(7))
                )
            )
            for _ in range(2)
        ]
        alignment = aligned("mission", *plans)
        assert (
            len({one for one, _ in alignment.pairs})
            == len({other for _, other in alignment.pairs})
            == len(alignment.pairs)
        )
        names = [[task["title"] for task in plan["tasks"]] for plan in plans]
        assert len(alignment.pairs) == sum(
            min(names[0].count(name), names[1].count(name)) for name in set(names[0])
        )
        assert all(names[0][one] == names[1][other] for one, other in alignment.pairs)
        assert sorted([*alignment.missing, *(one for one, _ in alignment.pairs)]) == list(
            range(len(names[0]))
        )
        assert sorted([*alignment.extra, *(other for _, other in alignment.pairs)]) == list(
            range(len(names[1]))
        )


def test_what_stands_instead_has_the_same_neighbours() -> None:
    expected = mission("Diagnostics", "KeepStation", transit(0, 0))
    assert substitutions(
        aligned("mission", expected, mission("Diagnostics", "ThermalTimeLapse", transit(0, 0)))
    ) == [("KeepStation", "ThermalTimeLapse")]
    shifted = mission("Diagnostics", transit(0, 0), "ThermalTimeLapse")
    assert set(substitutions(aligned("mission", expected, shifted))) == {
        ("KeepStation", None),
        (None, "ThermalTimeLapse"),
    }
    assert substitutions(aligned("mission", mission("KeepStation"), mission("Hover"))) == [
        ("KeepStation", "Hover")
    ]
    assert substitutions(aligned("mission", mission("KeepStation", "Diagnostics"), None)) == [
        ("KeepStation", None),
        ("Diagnostics", None),
    ]


def test_one_neighbour_is_enough_where_the_other_has_moved() -> None:
    expected, predicted = (
        mission("Diagnostics", "KeepStation", transit(0, 0), "DriftAudit"),
        mission("Diagnostics", "FeatureStare", "DriftAudit", transit(0, 0)),
    )
    assert substitutions(aligned("mission", expected, predicted)) == [
        ("KeepStation", "FeatureStare")
    ]


@pytest.mark.parametrize("place", [0, 2])
def test_the_beginning_and_the_end_of_a_plan_are_neighbours(place: int) -> None:
    ours, theirs = ["Diagnostics", "DriftAudit"], ["DriftAudit", "Diagnostics"]
    ours.insert(place, "KeepStation")
    theirs.insert(place, "FeatureStare")
    assert replaced(aligned("mission", mission(*ours), mission(*theirs))) == {place: place}


def test_a_filter_never_stands_for_a_perception_skill() -> None:
    expected, predicted = (
        steps(step("StationKeep", filters=("LockHeading",))),
        steps(step("StationKeep", perception=("DetectObjects",))),
    )
    assert set(substitutions(aligned("task", expected, predicted))) == {
        ("LockHeading", None),
        (None, "DetectObjects"),
    }


def test_entries_are_what_has_a_name() -> None:
    def entries(level: Level, plan: Any) -> list[tuple[str, str, int, bool]]:
        found = plan_entries(level, plan)
        return [(one.name, one.role, one.step, one.stated) for one in found]

    odd = {"tasks": ["x", {"title": 5}, {"title": None}, {"title": "A", "parameters": [1]}]}
    assert entries("mission", odd) == [("5", "task", 1, False), ("A", "task", 3, False)]
    assert entries("mission", {"tasks": {"title": "A"}}) == entries("task", [1]) == []
    held = steps(step("StationKeep"), step("GoToXY", ("LockHeading",), ("DetectObjects",)))
    assert entries("task", held) == [
        ("StationKeep", "navigation", 0, True),
        ("GoToXY", "navigation", 1, True),
        ("LockHeading", "filter", 1, True),
        ("DetectObjects", "perception", 1, True),
    ]


def test_company_is_a_share_of_the_larger_step() -> None:
    """The first predicted step has both skills too, and two more that nobody expects."""
    expected = steps(step("StationKeep", perception=("DetectObjects",)))
    crowd = step("StationKeep", perception=("DetectObjects", "GetGPSLocation", "OCRScanning"))
    predicted = steps(crowd, expected["skill_sequence"][0])
    assert aligned("task", expected, predicted).pairs == ((0, 4), (1, 5))


def test_a_sum_of_nearness_decides_between_equals() -> None:
    """Two tasks of five: the nearest places are kept, not the order of the others."""
    expected = mission("KeepStation", *["Diagnostics"] * 3, "KeepStation")
    predicted = mission("Hover", "KeepStation", "Hover", "Hover", "Hover", "KeepStation")
    assert aligned("mission", expected, predicted).pairs == ((0, 1), (4, 5))
    once = mission("KeepStation", "Hover", "Hover", "Hover", "Hover", "KeepStation", "Hover")
    middle = mission("Hover", "Hover", "Hover", "Hover", "KeepStation", "Hover", "Hover")
    assert (4, 5) in aligned("mission", middle, once).pairs
    two, three = ["Hover"] * 2, ["Hover"] * 3
    twice = mission(*three, "KeepStation", *three, "KeepStation", *three)
    alone = mission(*two, "KeepStation", *two)
    assert (2, 3) in aligned("mission", alone, twice).pairs
    assert (3, 2) in aligned("mission", twice, alone).pairs


def test_unlabelled_parameters_are_no_reason_to_pair() -> None:
    expected = {"tasks": [{"title": "PerformOrbit"}, {"title": "Hover"}]}
    predicted = mission(("PerformOrbit", {"radius": 2}), "Diagnostics", ("PerformOrbit", {}))
    assert aligned("mission", expected, predicted).pairs == ((0, 0),)
    stated = mission(("PerformOrbit", {"radius": 2}), ("PerformOrbit", {"radius": 2, "arc": 5}))
    given = mission(("PerformOrbit", {"radius": 2, "arc": 5}), ("PerformOrbit", {"radius": 2}))
    assert aligned("mission", stated, given).pairs == ((0, 1), (1, 0))


def test_one_entry_stands_for_one_other_and_two_neighbours_come_first() -> None:
    expected = mission("Diagnostics", "KeepStation", "DriftAudit", transit(0, 0))
    predicted = mission("Diagnostics", "Hover", "Sail", transit(0, 0))
    alignment = aligned("mission", expected, predicted)
    assert replaced(alignment) == {1: 1, 2: 2}
    assert replaced(aligned("mission", expected, mission("Sail", "Diagnostics"))) == {}
    one = aligned("mission", mission("KeepStation", "Diagnostics"), mission("Diagnostics", "Hover"))
    assert replaced(one) == {}
    assert one.to_json() == {"pairs": [[1, 0]], "missing": [0], "extra": [1]}
