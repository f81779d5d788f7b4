"""Names and order against cases computed by hand."""

from __future__ import annotations

import pytest

from planner_ft.benchmark.metrics.alignment import Entries, plan_entries
from planner_ft.benchmark.metrics.answers import (
    Answer,
    Counts,
    common_subsequence,
    counts_by,
    edge_f1,
    edit_distance,
    multiset_counts,
    set_counts,
    whole_plan_unordered,
)
from planner_ft.vocabulary import load_vocabulary

from .plans import mission, step, steps

USV = load_vocabulary()


def titled(*names: str) -> Entries:
    return plan_entries("mission", {"tasks": [{"title": name} for name in names]})


def test_a_set_drops_repetitions_and_a_multiset_counts_them() -> None:
    """The trap of set scores: of three Transits one is enough."""
    predicted, expected = ["T", "O"], ["T", "O", "T", "T"]
    assert set_counts(predicted, expected) == Counts(2, 2, 2)
    assert multiset_counts(predicted, expected) == Counts(2, 2, 4)
    assert multiset_counts(predicted, expected).f1 == pytest.approx(2 / 3)


def test_a_name_outside_the_vocabulary_is_a_false_positive() -> None:
    """The trap of scorers that take their classes from the expected names: an invented name costs
    nothing.
    """
    assert set_counts(["A", "Invented"], ["A"]).precision == 0.5
    found = counts_by("name", titled("A", "Invented"), titled("A"))
    assert found["Invented"] == Counts(0, 1, 0)


def test_nothing_predicted_is_no_success_unless_nothing_is_expected() -> None:
    """The trap of `zero_division=1`: an empty answer to a command that asks for something has
    precision 1.
    """
    empty = Counts(0, 0, 2)
    assert (empty.precision, empty.recall, empty.f1) == (0, 0, 0)
    both = Counts(0, 0, 0)
    assert (both.precision, both.recall, both.f1) == (1, 1, 1)
    assert (Counts(0, 2, 0).precision, Counts(0, 2, 0).recall) == (0, 0)


def test_per_name_and_per_role() -> None:
    assert counts_by("name", titled("T", "T", "B"), titled("T", "A")) == {
        "T": Counts(1, 2, 1),
        "A": Counts(0, 0, 1),
        "B": Counts(0, 1, 0),
    }
    expected = plan_entries(
        "task", steps(step("StationKeep", filters=("LockHeading",), perception=("DetectObjects",)))
    )
    predicted = plan_entries(
        "task", steps(step("StationKeep", perception=("DetectObjects", "LockHeading")))
    )
    assert counts_by("role", predicted, expected) == {
        "navigation": Counts(1, 1, 1),
        "filter": Counts(0, 0, 1),
        "perception": Counts(1, 2, 1),
    }


@pytest.mark.parametrize(
    ("predicted", "expected", "distance"),
    [
        ("", "", 0),
        ("ABC", "ABC", 0),
        ("", "AB", 1),
        ("AB", "", 1),
        ("ABD", "ABC", 1 / 3),
        ("BC", "ABC", 1 / 3),
        ("CBA", "ABC", 2 / 3),
        ("XY", "ABCD", 1),
        ("ABAB", "BABA", 2 / 4),
    ],
)
def test_edit_distance(predicted: str, expected: str, distance: float) -> None:
    assert edit_distance(list(predicted), list(expected)) == pytest.approx(distance)


@pytest.mark.parametrize(
    ("predicted", "expected", "length"),
    [("", "", 0), ("ABC", "ABC", 3), ("ACB", "ABC", 2), ("CBA", "ABC", 1), ("AXBXC", "ABC", 3)],
)
def test_common_subsequence(predicted: str, expected: str, length: int) -> None:
    assert common_subsequence(list(predicted), list(expected)) == Counts(
        length, len(predicted), len(expected)
    )


@pytest.mark.parametrize(
    ("predicted", "expected", "f1"),
    [
        ("ABC", "ABC", 1),
        ("ACB", "ABC", 0),
        ("AB", "ABC", 2 / 3),
        ("ABCD", "BCDA", 2 / 3),
        ("TATB", "TATB", 1),
        # T1 A T2 B against A T1 B: the Transit before B is another one.
        ("ATB", "TATB", 0),
        # Without edges nothing is matched, and nothing is credited: the trap of scorers that give 1
        # to an empty set of edges.
        ("A", "A", 1),
        ("B", "A", 0),
        ("", "", 1),
        ("", "A", 0),
        ("A", "AB", 0),
    ],
)
def test_edge_f1(predicted: str, expected: str, f1: float) -> None:
    assert edge_f1(list(predicted), list(expected)) == pytest.approx(f1)


def test_a_whole_plan_in_any_order() -> None:
    there, home = ("Transit", {"target_position": [5, 5]}), ("Transit", {"target_position": [0, 0]})
    expected = mission(there, "Diagnostics", home)
    assert whole_plan_unordered(
        Answer("mission", mission(home, there, "Diagnostics"), expected, USV)
    )
    assert not whole_plan_unordered(
        Answer("mission", mission(home, home, "Diagnostics"), expected, USV)
    )
    assert not whole_plan_unordered(Answer("mission", mission(home, there), expected, USV))
    assert not whole_plan_unordered(Answer("mission", None, expected, USV))
    assert not whole_plan_unordered(Answer("mission", {"tasks": expected["tasks"]}, expected, USV))


def test_skills_of_one_step_stay_in_one_step() -> None:
    expected = steps(
        step("StationKeep", perception=("DetectObjects",)),
        step(("GoToXY", {"x": 1, "y": 2}), perception=("GetGPSLocation",)),
    )
    assert whole_plan_unordered(
        Answer("task", steps(*expected["skill_sequence"][::-1]), expected, USV)
    )
    mixed = steps(
        step("StationKeep", perception=("GetGPSLocation",)),
        step(("GoToXY", {"x": 1, "y": 2}), perception=("DetectObjects",)),
    )
    assert not whole_plan_unordered(Answer("task", mixed, expected, USV))


def test_the_same_skill_twice_in_a_step_is_compared_in_any_order() -> None:
    low, high = (
        ("DetectObjects", {"class_list": ["buoy"]}),
        ("DetectObjects", {"class_list": ["ship"]}),
    )
    expected = steps(step("StationKeep", perception=(low, high)))
    assert whole_plan_unordered(
        Answer("task", steps(step("StationKeep", perception=(high, low))), expected, USV)
    )
    assert not whole_plan_unordered(
        Answer("task", steps(step("StationKeep", perception=(high, high))), expected, USV)
    )


def test_precision_counts_what_was_predicted_and_recall_what_was_expected() -> None:
    counts = Counts(2, 3, 4)
    assert (counts.precision, counts.recall, counts.f1) == (2 / 3, 2 / 4, 4 / 7)
