from __future__ import annotations

import numpy as np
import pytest

from planner_ft.benchmark.statistics import (
    bootstrap_mean,
    bootstrap_ratio,
    cluster_sums,
    clustered_rate,
    effective_size,
    percentiles,
    quantile,
    resampled_sums,
    wilson,
)


@pytest.mark.parametrize(
    ("successes", "n", "low", "high"),
    # scipy.stats.binomtest(successes, n).proportion_ci(method="wilson")
    [
        (0, 25, 0.0, 0.13319),
        (1, 25, 0.00710, 0.19544),
        (24, 25, 0.80456, 0.99290),
        (25, 25, 0.86681, 1.0),
        (250, 500, 0.45635, 0.54365),
    ],
)
def test_wilson(successes: int, n: int, low: float, high: float) -> None:
    estimate = wilson(successes, n)
    assert estimate.value == successes / n
    assert estimate.low == pytest.approx(low, abs=1e-4)
    assert estimate.high == pytest.approx(high, abs=1e-4)


def test_nothing_measured_is_no_figure() -> None:
    with pytest.raises(ValueError):
        clustered_rate([True, False], ["a"])
    assert wilson(0, 0).value is None
    assert (wilson(0, 7).low, wilson(7, 7).high) == (0, 1)
    assert bootstrap_mean([], [], 0).value is None
    assert bootstrap_ratio([0.0], [0.0], ["a"], 0).value is None


def test_the_bootstrap_agrees_with_the_normal_interval_of_a_large_sample() -> None:
    values = np.random.default_rng(0).normal(5, 2, 400).tolist()
    estimate = bootstrap_mean(values, range(400), seed=1)
    half = 1.96 * float(np.std(values)) / 20
    assert estimate.value == pytest.approx(float(np.mean(values)))
    assert estimate.low == pytest.approx(estimate.value - half, abs=0.02)
    assert estimate.high == pytest.approx(estimate.value + half, abs=0.02)


def test_same_seed_same_interval() -> None:
    values = np.random.default_rng(0).random(40).tolist()
    assert bootstrap_mean(values, range(40), 7) == bootstrap_mean(values, range(40), 7)
    assert bootstrap_mean(values, range(40), 7) != bootstrap_mean(values, range(40), 8)


def test_samples_of_one_family_count_as_one() -> None:
    values = [0.0] * 10 + [1.0] * 10 + [0.0] * 10 + [1.0] * 10
    apart = bootstrap_mean(values, range(40), 0)
    together = bootstrap_mean(values, [index // 10 for index in range(40)], 0)
    assert together.value == apart.value
    assert (together.low, together.high) == (0.0, 1.0)
    assert apart.low is not None
    assert apart.low > 0.3
    assert bootstrap_mean(values, ["one"] * 40, 0).low is None


def test_a_ratio_pools_its_samples() -> None:
    found = bootstrap_ratio([1, 9], [2, 10], ["a", "b"], 0)
    assert (found.value, found.low, found.high) == (pytest.approx(10 / 12), 0.5, 0.9)
    parts = bootstrap_ratio([0.1, 0.2], [0.4, 0.4], ["a", "b"], 0)
    assert (parts.low, parts.high) == (0.25, 0.5)


def test_a_rate_of_independent_samples_has_the_wilson_interval() -> None:
    for hits in (0, 3, 25):
        flags = [index < hits for index in range(25)]
        assert clustered_rate(flags, range(25)) == wilson(hits, 25)
    assert clustered_rate([], []).value is None


def test_phrasings_of_a_family_that_agree_count_as_one_sample() -> None:
    families = [index // 4 for index in range(40)]
    agree = clustered_rate([family < 5 for family in families], families)
    differ = clustered_rate([index % 2 == 0 for index in range(40)], families)
    assert agree.value == differ.value == 0.5
    assert agree.low is not None and differ.low is not None
    # Ten families: no narrower than the interval of ten samples; answers that differ within each
    # family are as good as independent.
    assert agree.low <= wilson(5, 10).low  # type: ignore[operator]
    assert wilson(5, 10).low < differ.low < wilson(20, 40).low  # type: ignore[operator]


def test_nothing_wrong_in_families_is_as_sure_as_in_as_many_samples() -> None:
    assert clustered_rate([False] * 40, [index // 4 for index in range(40)]).high == pytest.approx(
        wilson(0, 10).high
    )
    assert clustered_rate([True] * 6, ["one"] * 6) == wilson(1, 1)


def test_counts_of_several_samples_are_the_samples_one_by_one() -> None:
    counted = clustered_rate([2, 0, 1], ["a", "b", "a"], [3, 0, 1])
    assert counted == clustered_rate([1, 1, 0, 1], ["a"] * 4)
    assert clustered_rate([0], ["a"], [0]).value is None


def test_the_effective_size_by_hand() -> None:
    # Three families of two with 2, 1 and 0 hits: rate 1/2, variance (1 + 0 + 1) * 3/2 / 36 = 1/12,
    # of six independent samples 1/24: effect 2; Student's quantiles for 5 and 2 degrees of freedom:
    # 2.5706 and 4.3027.
    assert effective_size([(2, 2), (1, 2), (0, 2)]) == pytest.approx(
        3 * (2.5706 / 4.3027) ** 2, rel=1e-4
    )


def test_intervals_of_clustered_rates_hold_what_they_promise() -> None:
    """Repeated families of four with correlated answers: the plain Wilson interval misses the truth
    far more often than one time in twenty.
    """
    generator, families = np.random.default_rng(0), [index // 4 for index in range(80)]
    plain = clustered = 0
    for _ in range(300):
        hits = (generator.random(80) < np.repeat(generator.beta(0.8, 0.2, 20), 4)).tolist()
        for_all, for_families = wilson(sum(hits), 80), clustered_rate(hits, families)
        plain += for_all.low <= 0.8 <= for_all.high  # type: ignore[operator]
        clustered += for_families.low <= 0.8 <= for_families.high  # type: ignore[operator]
    assert plain < 255 and clustered > 276


def test_many_clusters_are_resampled_in_blocks_as_few_are(monkeypatch: pytest.MonkeyPatch) -> None:
    from planner_ft.benchmark import statistics

    sums = np.random.default_rng(0).random((30, 2))
    whole = resampled_sums(sums, 5)
    monkeypatch.setattr(statistics, "BLOCK", 30 * 7)
    statistics._drawn.cache_clear()
    assert np.allclose(resampled_sums(sums, 5), whole) and whole.shape == (10_000, 2)


@pytest.mark.parametrize(
    ("counts", "size"),
    [
        # Without a variance to go by, samples of one family count as one: 6 / (6 * 4 / 12) ...
        ([(2, 2)] * 3, 3),
        ([(0, 2)] * 3, 3),
        ([(0, 1), (0, 3)], 4 / (10 / 4)),
        ([(3, 6)], 1),
        ([(1, 2), (0, 2)], 2),
        ([(2, 4), (2, 4)], 2),
        ([(1, 1), (0, 1), (1, 1)], 3),
        # The effect is at least 1: families no more alike than samples of others, Student's
        # quantiles for 7 and 3 degrees of freedom 2.3646 and 3.1824.
        ([(1, 2)] * 4, 8 * (2.3646 / 3.1824) ** 2),
        # And at most the size of a family: rate 1/2, effect 4 * 2 / 3 held to 2.
        ([(2, 2), (2, 2), (0, 2), (0, 2)], 4 * (2.3646 / 3.1824) ** 2),
        # Between the two: rate 1/2, variance (4 + 4) * 4/3 / 16 of a sample, effect 8/3; quantiles
        # for 15 and 3 degrees of freedom 2.1314 and 3.1824.
        ([(4, 4), (2, 4), (2, 4), (0, 4)], 16 / (8 / 3) * (2.1314 / 3.1824) ** 2),
    ],
)
def test_effective_sizes(counts: list[tuple[int, int]], size: float) -> None:
    assert effective_size(counts) == pytest.approx(size, rel=1e-4)


def test_a_quantile_is_bounded_where_enough_values_lie_beyond_it() -> None:
    assert quantile([], 0.5).value is None
    assert quantile([3, 1, 2], 0.01).value == 1
    values = [float(value) for value in range(10, 0, -1)]
    assert [quantile(values, share).value for share in (0.5, 0.9, 0.91)] == [5, 9, 10]
    found = quantile([float(value) for value in range(1, 101)], 0.95)
    assert (found.value, found.low, found.high) == (95, 90, 100)
    assert quantile([1.0, 2.0], 0.5).to_json() == {"value": 1.0, "low": None, "high": None}


def test_sums_over_clusters_and_the_middle_95_percent() -> None:
    sums = cluster_sums([[1, 2], [3, 4], [5, 6]], ["b", "a", "b"])
    assert sums.tolist() == [[6, 8], [3, 4]]
    assert percentiles(np.arange(1001.0)) == pytest.approx((25, 975))


def test_resamples_draw_as_many_clusters_as_there_are() -> None:
    totals = resampled_sums(np.ones((7, 1)), 0)
    assert totals.shape == (10_000, 1) and set(totals[:, 0]) == {7}


def test_a_ratio_of_one_cluster_has_no_interval_and_resamples_of_nothing_are_left_out() -> None:
    one = bootstrap_ratio([1, 9], [2, 10], ["a", "a"], 0)
    assert (one.value, one.low, one.high) == (pytest.approx(10 / 12), None, None)
    rare = bootstrap_ratio([0, 1, 0], [0, 2, 0], ["a", "b", "c"], 0)
    assert (rare.value, rare.low, rare.high) == (0.5, 0.5, 0.5)
