"""Intervals: Wilson for rates, seeded bootstrap for means; families are not independent samples."""

import functools
import math
from collections import Counter
from collections.abc import Hashable, Sequence
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from planner_ft.support.tables import Cell, figure

CONFIDENCE = 0.95
RESAMPLES = 10_000
BLOCK = 2**22  # numbers that are worked on at a time
Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Estimate:
    """A figure with its 95 % interval; None: nothing to measure, or too little for a bound."""

    value: float | None
    low: float | None = None
    high: float | None = None

    def to_json(self) -> dict[str, float | None]:
        return asdict(self)

    def cell(self, **style: Any) -> Cell:
        """As tables show it, in the style of `figure`."""
        return figure(self.value, self.low, self.high, **style)


def wilson(successes: int, n: int) -> Estimate:
    """A rate with its Wilson score interval (Wilson 1927). For independent samples."""
    return _wilson(successes / n, n) if n else Estimate(None)


def clustered_rate(
    successes: Sequence[int], clusters: Sequence[Hashable], sizes: Sequence[int] | None = None
) -> Estimate:
    """A rate with the Wilson interval of its effective sample size, the Wilson interval itself
    where no two samples share a cluster. With `sizes`, `successes` count those of so many samples.

    The effective size is n over the design effect: the variance of the rate with whole clusters as
    units over that of independent samples (Kish 1965), with Korn and Graubard's correction for few
    clusters (Survey Methodology 1998); Dean and Pagano (Journal of Survey Statistics and
    Methodology 2015) compare such intervals.
    """
    hits, of = Counter[Hashable](), Counter[Hashable]()
    sizes = [1] * len(successes) if sizes is None else sizes
    for cluster, right, size in zip(clusters, successes, sizes, strict=True):
        if size:
            hits[cluster] += right
            of[cluster] += size
    if not of:
        return Estimate(None)
    effective = effective_size([(hits[cluster], size) for cluster, size in of.items()])
    return _wilson(hits.total() / of.total(), effective)


def effective_size(counts: Sequence[tuple[int, int]]) -> float:
    """As how many independent samples the samples of some clusters count for a rate; `counts` are
    (successes, samples) of each cluster. Samples are never counted for more than they are, and for
    no less than their clusters are. At 0 and 1, where a variance says nothing, samples of one
    cluster count as one.
    """
    n, clusters = sum(size for _hits, size in counts), len(counts)
    if clusters == n:
        return n
    rate = sum(hits for hits, _size in counts) / n
    most = sum(size**2 for _hits, size in counts) / n
    if clusters < 3 or rate in (0, 1):
        return n / most
    from scipy.special import stdtrit

    between = sum((hits - rate * size) ** 2 for hits, size in counts) * clusters / (clusters - 1)
    effect = min(most, max(1.0, between / n / (rate * (1 - rate))))
    student, of_clusters = stdtrit([n - 1, clusters - 1], (1 + CONFIDENCE) / 2)
    return float(n / effect * (student / of_clusters) ** 2)


@functools.lru_cache(maxsize=16_384)
def _wilson(rate: float, n: float) -> Estimate:
    from statsmodels.stats.proportion import proportion_confint

    low, high = proportion_confint(rate * n, n, alpha=1 - CONFIDENCE, method="wilson")
    return Estimate(rate, float(low) if rate else 0.0, float(high) if rate < 1 else 1.0)


def quantile(values: Sequence[float], share: float) -> Estimate:
    """The smallest value that at least `share` of the values do not exceed, with a
    distribution-free 95 % interval by order statistics (David and Nagaraja 2003, section 7.1). A
    bound that no order statistic can give with that confidence is None.
    """
    from scipy.stats import quantile_test

    if not len(values):
        return Estimate(None)
    # Rounding: 0.9 * 10 must give rank 9.
    rank = max(1, math.ceil(round(len(values) * share, 9)))
    bounds = quantile_test(values, p=share).confidence_interval(CONFIDENCE)
    low, high = (None if math.isnan(bound) else float(bound) for bound in bounds)
    return Estimate(sorted(values)[rank - 1], low, high)


def bootstrap_mean(values: Sequence[float], clusters: Sequence[Hashable], seed: int) -> Estimate:
    """The mean with its percentile bootstrap interval (Efron 1979), whole clusters resampled."""
    return bootstrap_ratio(values, [1.0] * len(values), clusters, seed)


def bootstrap_ratio(
    above: Sequence[float], below: Sequence[float], clusters: Sequence[Hashable], seed: int
) -> Estimate:
    """sum(above) / sum(below) over samples, with its percentile bootstrap interval, whole clusters
    resampled together. Without a second cluster there is no interval.
    """
    if not sum(below):
        return Estimate(None)
    sums = cluster_sums(np.array([above, below], dtype=float).T, clusters)
    top, size = sums.sum(axis=0)
    if len(sums) < 2:
        return Estimate(float(top / size))
    totals = resampled_sums(sums, seed)
    known = totals[totals[:, 1] > 0]
    return Estimate(float(top / size), *percentiles(known[:, 0] / known[:, 1]))


def cluster_sums(rows: Sequence[Sequence[float]] | Floats, clusters: Sequence[Hashable]) -> Floats:
    """Sums of `rows`, (samples, columns), over clusters as they appear: (clusters, columns)."""
    order = {cluster: index for index, cluster in enumerate(dict.fromkeys(clusters))}
    sums = np.zeros((len(order), len(rows[0])))
    np.add.at(sums, [order[cluster] for cluster in clusters], np.asarray(rows, dtype=float))
    return sums


def resampled_sums(sums: Floats, seed: int) -> Floats:
    """Totals of RESAMPLES resamples, (RESAMPLES, columns); a seed draws the same clusters."""
    return in_blocks(_drawn(len(sums), seed), sums)


def in_blocks(weights: NDArray[np.int8], sums: Floats) -> Floats:
    """weights @ sums, with a bounded part of `weights` as numbers of 8 bytes at a time."""
    rows = max(1, BLOCK // len(sums))
    starts = range(0, len(weights), rows)
    return np.concatenate([weights[at : at + rows].astype(float) @ sums for at in starts])


@functools.lru_cache(maxsize=2)
def _drawn(count: int, seed: int) -> NDArray[np.int8]:
    """How often each of `count` clusters is drawn in every resample; a table's rows share it."""
    generator, rows = np.random.default_rng(seed), max(1, BLOCK // count)
    blocks = [
        generator.multinomial(count, np.full(count, 1 / count), size=min(rows, RESAMPLES - start))
        for start in range(0, RESAMPLES, rows)
    ]
    # No cluster is ever drawn 127 times: the chance is under 1e-200.
    return np.concatenate([block.astype(np.int8) for block in blocks])


def percentiles(values: Floats) -> tuple[float, float]:
    """The bounds of the middle CONFIDENCE of the values."""
    low, high = np.quantile(values, [(1 - CONFIDENCE) / 2, (1 + CONFIDENCE) / 2])
    return float(low), float(high)
