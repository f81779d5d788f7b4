"""How often the 95 % interval of a rate holds the truth when samples share phrasing families: the
Wilson interval, and the one that is used.

    python benchmarks/interval_coverage.py [--trials 2000]

Families have their own rates (beta-binomial with an intra-family correlation). Prints a line per
design, correlation and rate: coverage of both.
"""

from __future__ import annotations

import argparse

import numpy as np
from numpy.typing import NDArray

from planner_ft.benchmark.statistics import Estimate, clustered_rate, wilson

TEST_SPLIT = [2] * 8 + [1] * 9
DESIGNS = {
    "mission test split: 25 samples in 17 families": TEST_SPLIT,
    "the same, 4 repeats": [4 * size for size in TEST_SPLIT],
    "120 samples in 30 families": [4] * 30,
    "100 samples in 10 families": [10] * 10,
}


def family_rates(
    rate: float, correlation: float, count: int, generator: np.random.Generator
) -> NDArray[np.float64]:
    if correlation == 0:
        return np.full(count, rate)
    if correlation == 1:
        return (generator.random(count) < rate).astype(float)
    scale = (1 - correlation) / correlation
    return generator.beta(rate * scale, (1 - rate) * scale, count)


def holds(estimate: Estimate, rate: float) -> bool:
    assert estimate.low is not None and estimate.high is not None
    return estimate.low <= rate <= estimate.high


def coverage(sizes: list[int], rate: float, correlation: float, trials: int) -> tuple[float, float]:
    generator = np.random.default_rng(0)
    families = [family for family, size in enumerate(sizes) for _ in range(size)]
    plain = clustered = 0
    for _ in range(trials):
        hits = (
            generator.random(len(families))
            < family_rates(rate, correlation, len(sizes), generator)[families]
        ).tolist()
        plain += holds(wilson(sum(hits), len(hits)), rate)
        clustered += holds(clustered_rate(hits, families), rate)
    return plain / trials, clustered / trials


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--trials", type=int, default=2000)
    trials = parser.parse_args().trials
    print("| design | correlation | rate | Wilson | used |\n|---|---:|---:|---:|---:|")
    for name, sizes in DESIGNS.items():
        for correlation in (0, 0.3, 0.7):
            for rate in (0.5, 0.8, 0.95):
                plain, clustered = coverage(sizes, rate, correlation, trials)
                print(
                    f"| {name} | {correlation} | {rate} | {100 * plain:.1f} % |"
                    f" {100 * clustered:.1f} % |"
                )


if __name__ == "__main__":
    main()
