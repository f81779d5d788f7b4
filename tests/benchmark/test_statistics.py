from __future__ import annotations

import numpy as np
import pytest

from planner_ft.benchmark.statistics import bootstrap_mean, bootstrap_ratio, wilson


@pytest.mark.parametrize(
    ("successes", "n", "low", "high"),
    # scipy.stats.binomtest(successes, n).proportion_ci(method="wilson")
    [(0, 25, 0.0, 0.13319), (1, 25, 0.00710, 0.19544), (24, 25, 0.80456, 0.99290), (25, 25, 0.86681, 1.0), (250, 500, 0.45635, 0.54365)],
)
def test_wilson(successes: int, n: int, low: float, high: float) -> None:
    estimate = wilson(successes, n)
    assert estimate.value == successes / n
    assert estimate.low == pytest.approx(low, abs=1e-4)
    assert estimate.high == pytest.approx(high, abs=1e-4)


def test_nothing_measured_is_no_figure() -> None:
    assert wilson(0, 0).value is None
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
    assert bootstrap_ratio([1, 9], [2, 10], ["a", "b"], 0).value == pytest.approx(10 / 12)
