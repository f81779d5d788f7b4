"""Intervals: Wilson for rates, seeded bootstrap for means, resampled by cluster where samples share a family."""

from __future__ import annotations

import math
from collections.abc import Hashable, Sequence
from dataclasses import asdict, dataclass

import numpy as np

CONFIDENCE = 0.95
Z = 1.959963984540054
"""Normal quantile of (1 + CONFIDENCE) / 2."""
RESAMPLES = 10_000


@dataclass(frozen=True)
class Estimate:
    """A figure with its 95 % interval; `value` is None where there is nothing to measure, the bounds where too little."""

    value: float | None
    low: float | None = None
    high: float | None = None

    def to_json(self) -> dict[str, float | None]:
        return asdict(self)


def wilson(successes: int, n: int) -> Estimate:
    """A rate with its Wilson score interval (Wilson 1927), which stays inside [0, 1] and is not empty at 0 and 1."""
    if n == 0:
        return Estimate(None)
    rate = successes / n
    centre = (rate + Z**2 / (2 * n)) / (1 + Z**2 / n)
    half = Z * math.sqrt(rate * (1 - rate) / n + Z**2 / (4 * n**2)) / (1 + Z**2 / n)
    return Estimate(rate, max(0.0, centre - half) if successes else 0.0, min(1.0, centre + half) if successes < n else 1.0)


def bootstrap_mean(values: Sequence[float], clusters: Sequence[Hashable], seed: int) -> Estimate:
    """The mean of `values` with its percentile bootstrap interval (Efron 1979), whole clusters resampled together."""
    return bootstrap_ratio(values, [1.0] * len(values), clusters, seed)


def bootstrap_ratio(numerators: Sequence[float], denominators: Sequence[float], clusters: Sequence[Hashable], seed: int) -> Estimate:
    """sum(numerators) / sum(denominators) with its percentile bootstrap interval, whole clusters resampled together.

    The three sequences have one entry per sample. Samples of one cluster (phrasings of one family) are not independent:
    resampling them one by one would make the interval too narrow. Without a second cluster there is no interval.
    """
    if sum(denominators) == 0:
        return Estimate(None)
    order = {cluster: index for index, cluster in enumerate(dict.fromkeys(clusters))}
    sums = np.zeros((len(order), 2))
    for numerator, denominator, cluster in zip(numerators, denominators, clusters, strict=True):
        sums[order[cluster]] += (numerator, denominator)
    value = float(sums[:, 0].sum() / sums[:, 1].sum())
    if len(order) < 2:
        return Estimate(value)
    count = len(order)
    totals = np.random.default_rng(seed).multinomial(count, np.full(count, 1 / count), size=RESAMPLES) @ sums
    totals = totals[totals[:, 1] > 0]
    low, high = np.quantile(totals[:, 0] / totals[:, 1], [(1 - CONFIDENCE) / 2, (1 + CONFIDENCE) / 2])
    return Estimate(value, float(low), float(high))
