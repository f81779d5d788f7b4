"""Our figures beside those of public scorers on the same predictions, and the traps that lie
between.
"""

from __future__ import annotations

import random

import numpy as np
import pytest
from rapidfuzz.distance import LCSseq, Levenshtein
from sklearn.metrics import f1_score, precision_recall_fscore_support
from sklearn.preprocessing import MultiLabelBinarizer

from planner_ft.benchmark.metrics.alignment import Entries, plan_entries
from planner_ft.benchmark.metrics.answers import (
    Counts,
    common_subsequence,
    counts_by,
    edit_distance,
    set_counts,
)

KNOWN = ["Transit", "Orbit", "Survey", "Search", "Report"]


def lists(seed: int, count: int = 200, most: int = 6) -> list[tuple[list[str], list[str]]]:
    """(predicted, expected) names: repetitions, invented names and empty lists among them."""
    rng = random.Random(seed)
    return [
        (
            rng.choices([*KNOWN, "Invented"], k=rng.randrange(most)),
            rng.choices(KNOWN, k=rng.randrange(most)),
        )
        for _ in range(count)
    ]


PAIRS = lists(0)


def titled(names: list[str]) -> Entries:
    return plan_entries("mission", {"tasks": [{"title": name} for name in names]})


def test_set_f1_is_the_samples_average_of_scikit_learn() -> None:
    """With `zero_division=1`: two empty sets score 1, as ours do. One empty set scores 0 in
    both.
    """
    binary = MultiLabelBinarizer(classes=[*KNOWN, "Invented"])
    expected, predicted = (
        binary.fit_transform([pair[1] for pair in PAIRS]),
        binary.transform([pair[0] for pair in PAIRS]),
    )
    theirs = f1_score(expected, predicted, average="samples", zero_division=1)
    assert np.mean([set_counts(*pair).f1 for pair in PAIRS]) == pytest.approx(theirs)


def test_the_default_of_scikit_learn_gives_nothing_for_a_right_refusal() -> None:
    """Trap: `zero_division=0` counts two empty sets as 0, so that a command rightly refused costs
    F1.
    """
    binary = MultiLabelBinarizer(classes=KNOWN)
    both = binary.fit_transform([[], ["Transit"]])
    assert f1_score(both, both, average="samples", zero_division=0) == 0.5
    assert np.mean([set_counts([], []).f1, set_counts(["Transit"], ["Transit"]).f1]) == 1


@pytest.mark.filterwarnings("ignore:unknown class")
def test_classes_fitted_on_the_expected_names_hide_invented_ones() -> None:
    """Trap: a binarizer that was fitted on the expected names drops what it does not know, and
    hallucinations with it.
    """
    binary = MultiLabelBinarizer()
    expected = binary.fit_transform([["Transit"], ["Orbit"]])
    assert (
        f1_score(
            expected, binary.transform([["Transit", "Invented"], ["Orbit"]]), average="samples"
        )
        == 1
    )
    assert np.mean(
        [set_counts(["Transit", "Invented"], ["Transit"]).f1, set_counts(["Orbit"], ["Orbit"]).f1]
    ) == pytest.approx((2 / 3 + 1) / 2)


def test_per_name_figures_are_those_of_scikit_learn_over_occurrences() -> None:
    """Occurrences become labels of their own ("Transit 2"), which a multilabel scorer can count;
    summed up per name they give our table.
    """
    names = [*KNOWN, "Invented"]
    labels = [f"{name} {number}" for name in names for number in range(6)]
    binary = MultiLabelBinarizer(classes=labels)
    expected, predicted = (
        binary.fit_transform(
            [
                [f"{name} {number}" for name in names for number in range(pair[side].count(name))]
                for pair in PAIRS
            ]
        )
        for side in (1, 0)
    )
    for index, name in enumerate(names):
        columns = slice(6 * index, 6 * index + 6)
        precision, recall, f1, _support = precision_recall_fscore_support(
            expected[:, columns].ravel(), predicted[:, columns].ravel(), zero_division=0
        )
        found = [counts_by("name", *map(titled, pair)).get(name, Counts(0, 0, 0)) for pair in PAIRS]
        ours = Counts(
            sum(entry.right for entry in found),
            sum(entry.predicted for entry in found),
            sum(entry.expected for entry in found),
        )
        assert (ours.precision, ours.recall, ours.f1) == pytest.approx(
            (precision[1], recall[1], f1[1])
        )


def test_set_precision_and_recall_are_those_of_scikit_learn_where_both_have_names() -> None:
    pairs = [pair for pair in PAIRS if pair[0] and pair[1]]
    binary = MultiLabelBinarizer(classes=[*KNOWN, "Invented"])
    expected, predicted = (
        binary.fit_transform([pair[1] for pair in pairs]),
        binary.transform([pair[0] for pair in pairs]),
    )
    precision, recall, _f1, _support = precision_recall_fscore_support(
        expected, predicted, average="samples", zero_division=0
    )
    ours = [set_counts(*pair) for pair in pairs]
    assert (
        np.mean([entry.precision for entry in ours]),
        np.mean([entry.recall for entry in ours]),
    ) == pytest.approx((precision, recall))


def test_edit_distance_is_that_of_rapidfuzz_over_names() -> None:
    """Over lists of names: over joined text a long name would cost more than a short one."""
    for predicted, expected in PAIRS:
        assert edit_distance(predicted, expected) == pytest.approx(
            Levenshtein.normalized_distance(predicted, expected)
        )
    assert edit_distance(["Transit", "Orbit"], ["Transit", "BathymetryGridSurvey"]) == 0.5
    assert Levenshtein.normalized_distance("Transit Orbit", "Transit BathymetryGridSurvey") > 0.6


def test_the_common_subsequence_has_the_length_that_rapidfuzz_finds() -> None:
    for predicted, expected in PAIRS:
        assert common_subsequence(predicted, expected).right == LCSseq.similarity(
            predicted, expected
        )
