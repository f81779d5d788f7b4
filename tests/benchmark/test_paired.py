"""Paired differences, exact tests and Holm's adjustment, against values computed by hand and by
public packages.
"""

from __future__ import annotations

import itertools
from typing import Any

import numpy as np
import pytest

from planner_ft.benchmark.catalogue import Metric
from planner_ft.benchmark.paired import (
    Comparison,
    adjusted,
    difference_cell,
    exact_mcnemar,
    exact_swaps,
    holm,
    p_text,
    paired,
    swaps,
    verdict,
)
from planner_ft.benchmark.statistics import RESAMPLES, Estimate

RATE, MEAN, RATIO = (
    Metric("right", "rate"),
    Metric("f1", "mean"),
    Metric("parameters", "ratio", over=("hits", "tries")),
)


def system(
    values: list[Any], key: str, families: list[int] | None = None
) -> dict[str, list[dict[str, Any]]]:
    return {
        f"s{index}": [
            {"id": f"s{index}", "family": str(families[index] if families else index), key: value}
        ]
        for index, value in enumerate(values)
    }


def test_mcnemar_by_hand_and_by_scipy() -> None:
    # One lost, five won: 2 * (1 + 6) / 64.
    assert exact_mcnemar(1, 5) == pytest.approx(14 / 64)
    assert exact_mcnemar(0, 0) == exact_mcnemar(3, 3) == 1.0
    from scipy.stats import binomtest

    for lost, won in [(0, 6), (2, 9), (10, 3), (40, 70), (700, 900)]:
        assert exact_mcnemar(lost, won) == pytest.approx(
            binomtest(lost, lost + won).pvalue, rel=1e-9
        )


def test_mcnemar_and_holm_by_statsmodels() -> None:
    from statsmodels.stats import contingency_tables as tables
    from statsmodels.stats.multitest import multipletests

    for lost, won in [(1, 5), (2, 9), (10, 3), (40, 70)]:
        assert exact_mcnemar(lost, won) == pytest.approx(
            tables.mcnemar([[30, lost], [won, 20]], exact=True).pvalue, rel=1e-9
        )
    values = np.random.default_rng(0).random(20) ** 3
    assert holm(values.tolist()) == pytest.approx(multipletests(values, method="holm")[1].tolist())


def test_holm_by_hand() -> None:
    assert holm([0.01, 0.04, 0.03, None, 0.005]) == pytest.approx([0.03, 0.06, 0.06, None, 0.02])
    assert holm([0.9, 0.8]) == [1.0, 1.0] and holm([]) == []


def test_swapping_families_of_one_sample_is_mcnemar() -> None:
    first, second = [0] * 9 + [1] * 2 + [1] * 10, [1] * 9 + [0] * 2 + [1] * 10
    found = paired(RATE, system(first, "right"), system(second, "right"), 0)
    assert found.p == found.p_mcnemar == exact_mcnemar(2, 9)
    assert (found.n, found.first_value, found.second_value) == (
        21,
        pytest.approx(12 / 21),
        pytest.approx(19 / 21),
    )
    assert found.difference.value == pytest.approx(7 / 21)


def test_a_family_that_changes_as_one_counts_once() -> None:
    first, second, families = [0] * 8 + [1] * 4, [1] * 12, [index // 4 for index in range(12)]
    apart, together = (
        paired(RATE, system(first, "right", one), system(second, "right", one), 0)
        for one in (None, families)
    )
    assert apart.p == together.p_mcnemar == 2 / 2**8
    # Two families of three went from wrong to right: 2 of 4 ways to swap them are as extreme.
    assert together.p == 0.5 and together.families == 3


def test_exact_swaps_are_those_of_all_signs() -> None:
    sizes = [1, -2, 2, 3, 1, -1, 0]
    sums = [
        abs(sum(sign * size for sign, size in zip(signs, sizes, strict=True)))
        for signs in itertools.product((1, -1), repeat=len(sizes))
    ]
    assert exact_swaps(sizes) == pytest.approx(
        sum(value >= abs(sum(sizes)) for value in sums) / len(sums)
    )


def test_swaps_of_a_mean_agree_with_scipy() -> None:
    from scipy.stats import permutation_test

    generator = np.random.default_rng(0)
    for count in (9, 60):
        first = generator.random(count)
        second = first + generator.normal(0.12, 0.3, count)
        ones = np.ones(count)
        ours = swaps(np.stack([first, ones, second, ones], 1), 0)
        theirs = permutation_test(
            (first, second),
            lambda one, two, axis: (two - one).mean(axis),
            permutation_type="samples",
            vectorized=True,
            rng=0,
        )
        assert ours == pytest.approx(theirs.pvalue, abs=1e-9 if count == 9 else 0.015)


def test_random_swaps_count_what_was_seen_as_one_of_them() -> None:
    """No random swap comes near a difference of all of 60 families: p is never 0."""
    ones = np.ones(60)
    assert swaps(np.stack([0 * ones, ones, ones, ones], 1), 0) == 1 / (RESAMPLES + 1)


@pytest.mark.parametrize("count", [12, 13])
def test_swaps_are_all_tried_where_few_families_differ(count: int) -> None:
    ones = np.ones(count)
    exact = swaps(np.stack([0 * ones, ones, ones, ones], 1), 0) == 2 / 2**count
    assert exact == (count == 12)


def test_a_ratio_is_pooled_and_paired() -> None:
    first = {"a": [{"id": "a", "hits": 1, "tries": 4}], "b": [{"id": "b", "hits": 2, "tries": 2}]}
    second = {"a": [{"id": "a", "hits": 3, "tries": 4}], "b": [{"id": "b", "hits": 0, "tries": 0}]}
    found = paired(RATIO, first, second, 0)
    assert (found.first_value, found.second_value) == (0.5, 0.75)
    assert found.difference.value == 0.25 and found.p is not None and 0 < found.p <= 1


def test_repeats_of_a_sample_are_averaged_and_unmeasured_ones_left_out() -> None:
    first = {
        "a": [{"id": "a", "right": True}, {"id": "a", "right": False}],
        "b": [{"id": "b", "right": None}],
        "d": [{"id": "d", "right": True}],
    }
    second = {
        "a": [{"id": "a", "right": True}],
        "b": [{"id": "b", "right": True}],
        "c": [{"id": "c", "right": True}],
        "d": [{"id": "d", "right": True}],
    }
    found = paired(RATE, first, second, 0)
    assert (found.n, found.first_value, found.second_value, found.p_mcnemar) == (2, 0.75, 1.0, None)


def test_the_interval_of_a_paired_difference_is_the_bootstrap_of_the_differences() -> None:
    from planner_ft.benchmark.statistics import bootstrap_mean

    generator = np.random.default_rng(1)
    first, second = generator.random(40).tolist(), generator.random(40).tolist()
    families = [index // 2 for index in range(40)]
    found = paired(MEAN, system(first, "f1", families), system(second, "f1", families), 3)
    expected = bootstrap_mean(
        [two - one for one, two in zip(first, second, strict=True)], families, 3
    )
    for ours, theirs in zip(
        found.difference.to_json().values(), expected.to_json().values(), strict=True
    ):
        assert ours == pytest.approx(theirs)


def test_no_difference_in_few_samples_is_no_equality() -> None:
    few, many = (system([1.0] * count, "f1") for count in (10, 200))
    (small,), (large,) = (adjusted([paired(MEAN, one, one, 0)]) for one in (few, many))
    assert small.verdict == "not told apart" and large.verdict == "equal"
    assert small.difference.value == 0
    assert small.difference.high == pytest.approx(0.2775, abs=1e-3)
    pooled = {name: [{"id": name, "hits": 3, "tries": 4}] for name in few}
    (ratio,) = adjusted([paired(RATIO, pooled, pooled, 0)])
    assert ratio.verdict == "not told apart"


def test_verdicts_know_which_way_is_better() -> None:
    def said(metric: str, value: float, p: float | None) -> str:
        found = paired(
            Metric(metric, "mean"),
            system([0.0, 0.5], metric),
            system([value, 0.5 + value], metric),
            0,
        )
        return verdict(metric, found.difference, p)

    assert said("f1", 0.4, 0.01) == "better" and said("f1", -0.4, 0.01) == "worse"
    assert said("hallucination", 0.4, 0.01) == "worse" and said("latency_s", -0.4, 0.01) == "better"
    assert said("tokens", 3.0, 0.01) == "higher"
    assert said("f1", 0.4, 0.05) == "not told apart" and said("f1", 0.01, 0.5) == "equal"
    assert said("latency_s", 0.01, 0.5) == "not told apart"
    assert verdict(MEAN.name, paired(MEAN, {}, {}, 0).difference, None) == "not compared"
    assert paired(MEAN, {}, {}, 0).difference == Estimate(None)


@pytest.mark.parametrize(
    ("name", "difference", "p", "said", "mark"),
    [
        ("f1", (0.2, 0.1, 0.3), 0.0499, "better", "▲"),
        ("f1", (-0.2, -0.3, -0.1), 0.0499, "worse", "▼"),
        ("f1", (0.2, 0.1, 0.3), 0.05, "not told apart", "·"),
        ("hallucination", (0.2, 0.1, 0.3), 0.01, "worse", "▼"),
        ("hallucination", (-0.2, -0.3, -0.1), 0.01, "better", "▲"),
        ("tokens", (2, 1, 3), 0.01, "higher", "▲"),
        ("tokens", (-2, -3, -1), 0.01, "lower", "▼"),
        # An unknown metric is better where it is higher.
        ("unknown", (0.2, 0.1, 0.3), 0.01, "better", "▲"),
        # Equal: the whole interval within 0.05 of nothing, for a metric between 0 and 1.
        ("f1", (0.0, -0.05, 0.05), 1.0, "equal", "≈"),
        ("f1", (0.0, -0.051, 0.05), 1.0, "not told apart", "·"),
        ("f1", (0.0, -0.05, 0.051), 1.0, "not told apart", "·"),
        ("f1", (0.0, None, 0.05), 1.0, "not told apart", "·"),
        ("f1", (0.0, -0.05, None), 1.0, "not told apart", "·"),
        ("unknown", (0.0, -0.01, 0.01), 1.0, "equal", "≈"),
        ("tokens", (0.0, -0.01, 0.01), 1.0, "not told apart", "·"),
        ("f1", (None, None, None), 0.01, "not compared", ""),
        ("f1", (0.2, 0.1, 0.3), None, "not compared", ""),
    ],
)
def test_a_comparison_says_its_verdict_and_is_read_back(
    name: str, difference: tuple[Any, Any, Any], p: float | None, said: str, mark: str
) -> None:
    figures = 0.5, 0.7, 20, 10, Estimate(*difference), 0.01, 0.02
    comparison = Comparison("a", "b", name, *figures, p)
    assert (comparison.verdict, comparison.mark) == (said, mark)
    record = comparison.to_json()
    assert Comparison.from_json(record) == comparison
    assert record == {
        "first": "a",
        "second": "b",
        "metric": name,
        "first_value": 0.5,
        "second_value": 0.7,
        "n": 20,
        "families": 10,
        "p": 0.01,
        "p_mcnemar": 0.02,
        "p_adjusted": p,
        "difference": dict(zip(("value", "low", "high"), difference, strict=True)),
        "verdict": said,
    }


@pytest.mark.parametrize(
    ("name", "text", "interval"),
    [
        ("f1", "+0.123", "[-0.001, +0.200]"),
        ("latency_s", "+0.12", "[-0.00, +0.20]"),
        ("hallucination", "+12.3", "[-0.1, +20.0]"),
        ("tokens", "+0.1", "[-0.0, +0.2]"),
    ],
)
def test_a_difference_is_shown_with_its_sign_in_the_unit_of_its_metric(
    name: str, text: str, interval: str
) -> None:
    cell = difference_cell(name, Estimate(0.1234, -0.0012, 0.2), "▲")
    assert (cell.text, cell.interval, cell.mark) == (text, interval, "▲")


def test_p_values_as_tables_show_them() -> None:
    assert [p_text(p) for p in (None, 0.00099, 0.001, 0.0496, 1.0)] == [
        *("–", "< 0.001", "0.001", "0.050", "1.000")
    ]


def test_nothing_in_common_or_nothing_to_divide_by_is_no_comparison() -> None:
    nothing = Comparison("", "", "parameters")
    assert paired(RATIO, {}, {}, 0) == nothing
    tries = {"a": [{"id": "a", "hits": 0, "tries": 0}], "b": [{"id": "b", "hits": 1, "tries": 2}]}
    other = {"a": [{"id": "a", "hits": 1, "tries": 2}], "c": [{"id": "c", "hits": 1, "tries": 2}]}
    assert paired(RATIO, tries, other, 0) == Comparison("", "", "parameters", None, 0.5, 1, 1)
    assert paired(RATIO, other, tries, 0) == Comparison("", "", "parameters", 0.5, None, 1, 1)


def test_a_single_family_has_a_difference_without_an_interval() -> None:
    one, other = (system([value] * 3, "f1", [0] * 3) for value in (0.25, 0.75))
    found = paired(MEAN, one, other, 0)
    assert (found.n, found.families, found.difference) == (3, 1, Estimate(0.5))
    assert found.p == 1.0 and found.p_mcnemar is None
    # Samples without a family are families of their own.
    alone = {name: [{**scores[0], "family": ""}] for name, scores in one.items()}
    assert paired(MEAN, alone, other, 0).families == 3


def test_a_rate_that_is_half_right_over_repeats_is_no_mcnemar_test() -> None:
    whole, half = system([0, 1, 1, 0], "right"), system([0, 1, 0.5, 0], "right")
    assert paired(RATE, whole, whole, 0).p_mcnemar == 1.0
    assert paired(RATE, whole, half, 0).p_mcnemar is None
    assert paired(MEAN, *(system([0, 1], "f1"),) * 2, 0).p_mcnemar is None


def test_exact_swaps_of_one_sign_and_of_none() -> None:
    assert exact_swaps([]) == exact_swaps([0, 0]) == exact_swaps([3, -3]) == 1.0
    assert exact_swaps([2]) == 1.0 and exact_swaps([1, 1]) == exact_swaps([-1, -1]) == 0.5
    assert exact_swaps([1] * 5 + [3]) == 2 / 64
    assert exact_swaps([1] * 5 + [-3]) == pytest.approx(54 / 64)


def test_all_swaps_of_few_families_by_hand() -> None:
    """Differences of 1 and 3 over three families: 4, 2, -2 and -4 when they are swapped."""
    first, second = np.array([[0, 1], [0, 1], [5, 1]]), np.array([[1, 1], [3, 1], [5, 1]])
    assert swaps(np.hstack([first, second]), 0) == 2 / 4
    assert swaps(np.hstack([second, first]), 0) == 2 / 4
    assert swaps(np.hstack([first, [[1, 1], [0, 1], [5, 1]]]), 0) == 1.0
    assert swaps(np.hstack([first, first]), 0) == 1.0
    # A family whose denominators alone differ is swapped, too.
    assert swaps(np.array([[1, 2, 1, 4], [1, 1, 1, 1]]), 0) == 1.0
    # One whose parts all differ, or whose first part is the other system's denominator, as well.
    assert swaps(np.array([[1, 2, 3, 4], [1, 3, 4, 5]]), 0) == 2 / 4
    assert swaps(np.array([[1, 1, 0, 1]] * 2), 0) == 2 / 4
