"""Two systems on the same samples: the difference of a metric with its interval, and how likely it
is by chance.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Hashable, Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from planner_ft.benchmark.catalogue import Metric
from planner_ft.benchmark.statistics import (
    BLOCK,
    RESAMPLES,
    Estimate,
    cluster_sums,
    clustered_rate,
    percentiles,
    resampled_sums,
)

Floats = NDArray[np.float64]
Score = Mapping[str, Any]
"""A line of scores.jsonl."""
Answers = Mapping[str, Sequence[Score]]
"""The scores of a system by sample id: one per sample, or one per repeat."""

SIGNIFICANCE = 0.05
ENUMERATED = 12
"""Families with a difference up to which all ways to swap them are tried (2**12) instead of
RESAMPLES random ones.
"""


@dataclass(frozen=True)
class Paired:
    """One metric of two systems over the samples that both answered.

    `first` and `second` are its values, `difference` is second minus first (95 % interval, whole
    families resampled), `p` the two-sided probability of as large a difference if it made no
    difference which system answered, families being swapped whole. `p_mcnemar` is the exact McNemar
    test of a rate, which takes all samples for independent: where they are, `p` is the same. `n`
    counts samples.
    """

    metric: str
    n: int
    families: int
    first: float | None
    second: float | None
    difference: Estimate
    p: float | None = None
    p_mcnemar: float | None = None

    def to_json(self) -> dict[str, Any]:
        return asdict(self)


def paired(metric: Metric, first: Answers, second: Answers, seed: int) -> Paired:
    """Compare two systems by a metric, over the samples for which both have a value. Repeats of a
    sample are averaged first.
    """
    both = {
        name: (_terms(metric, first[name]), _terms(metric, second[name]))
        for name in first
        if name in second
    }
    known = {
        name: (*one, *other)
        for name, (one, other) in both.items()
        if one is not None and other is not None
    }
    if not known:
        return Paired(metric.name, 0, 0, None, None, Estimate(None))
    families = [_family(first[name]) for name in known]
    terms = list(known.values())
    sums = cluster_sums(terms, families)
    one, other = (float(value) if np.isfinite(value) else None for value in _values(sums.sum(0)))
    if one is None or other is None:
        return Paired(metric.name, len(known), len(sums), one, other, Estimate(None))
    binary = metric.kind == "rate" and all(value in (0, 1) for term in terms for value in term)
    mcnemar = (
        exact_mcnemar(
            sum(term[0] > term[2] for term in terms), sum(term[0] < term[2] for term in terms)
        )
        if binary
        else None
    )
    p = exact_swaps(sums[:, 2] - sums[:, 0]) if binary else swaps(sums, seed)
    return Paired(
        metric.name,
        len(known),
        len(sums),
        one,
        other,
        _difference(metric, terms, sums, families, other - one, seed),
        p,
        mcnemar,
    )


def _terms(metric: Metric, scores: Sequence[Score]) -> tuple[float, float] | None:
    """Numerator and denominator of a sample, means over its repeats; None where it says nothing
    about the metric.
    """
    keys = metric.over if metric.kind == "ratio" else (metric.name, None)
    known = [score for score in scores if score.get(keys[0]) is not None]
    if not known:
        return None
    numerator = sum(float(score[keys[0]]) for score in known) / len(known)
    return numerator, (
        1.0
        if keys[1] is None
        else sum(float(score.get(keys[1]) or 0) for score in known) / len(known)
    )


def _family(scores: Sequence[Score]) -> str:
    return str(scores[0].get("family") or scores[0].get("id"))


def _values(sums: Floats) -> tuple[Any, Any]:
    """The metric of both systems from sums of (numerator, denominator) of the first and of the
    second, along the last axis.
    """
    with np.errstate(invalid="ignore", divide="ignore"):
        return sums[..., 0] / sums[..., 1], sums[..., 2] / sums[..., 3]


def _difference(
    metric: Metric,
    terms: Sequence[Sequence[float]],
    sums: Floats,
    families: Sequence[Hashable],
    value: float,
    seed: int,
) -> Estimate:
    """The difference with its bootstrap interval (Efron 1979).

    Where no sample differs no resample does, and the bootstrap would be sure of a difference of
    nothing after three samples. A share of something then takes the bound of the share of samples
    that may differ.
    """
    differs = [tuple(term[:2]) != tuple(term[2:]) for term in terms]
    if not any(differs) and metric.fraction:
        most = clustered_rate(differs, families).high
        assert most is not None
        return Estimate(value, -most, most)
    if len(sums) < 2:
        return Estimate(value)
    one, other = _values(resampled_sums(sums, seed))
    found = other - one
    return Estimate(value, *percentiles(found[np.isfinite(found)]))


def exact_mcnemar(lost: int, won: int) -> float:
    """Two-sided p of McNemar's test by the binomial distribution: `lost` samples were right with
    the first system alone, `won` with the second.

    McNemar 1947; the exact form is the sign test of the pairs that differ.
    """
    n = lost + won
    tail = sum(math.comb(n, count) for count in range(min(lost, won) + 1))
    # Integers throughout: with 2,000 pairs the terms are beyond a float.
    return min(1.0, 2 * tail / 2**n) if n else 1.0


def exact_swaps(differences: Iterable[float]) -> float:
    """Two-sided p that whole numbers, each with a random sign, have a sum as far from 0 as theirs:
    exact, from the sum's distribution.

    With differences of one sample each it is the exact McNemar test.
    """
    whole = [round(abs(value)) for value in differences if value]
    seen = abs(sum(round(value) for value in differences if value)) if whole else 0
    total = sum(whole)
    chances = np.zeros(2 * total + 1)
    chances[total] = 1
    for size in whole:
        chances = (np.roll(chances, size) + np.roll(chances, -size)) / 2
    return (
        float(min(1.0, chances[: total - seen + 1].sum() + chances[total + seen :].sum()))
        if seen
        else 1.0
    )


def swaps(sums: Floats, seed: int) -> float:
    """Two-sided p of a difference if the two systems were swapped at random, family by family
    (Fisher 1935; Pitman 1937).

    `sums` are those of `_values`, (families, 4). All ways to swap are tried where few families
    differ, else RESAMPLES random ones.
    """
    differing = sums[(sums[:, :2] != sums[:, 2:]).any(1)]
    if not len(differing):
        return 1.0
    exact = len(differing) <= ENUMERATED
    swapped = _all_swaps(len(differing)) if exact else _random_swaps(len(differing), seed)
    gained = (differing[:, 2:] - differing[:, :2])[None]
    rows = max(1, BLOCK // len(differing))
    moved = np.concatenate(
        [
            swapped[start : start + rows].astype(float) @ gained[0]
            for start in range(0, len(swapped), rows)
        ]
    )
    whole = sums.sum(0)
    one, other = _values(np.concatenate([whole[:2] + moved, whole[2:] - moved], axis=1))
    seen_one, seen_other = _values(whole)
    # Sums in another order differ in their last bits.
    extreme = int((np.abs(other - one) >= abs(seen_other - seen_one) - 1e-9).sum())
    return extreme / len(swapped) if exact else (extreme + 1) / (len(swapped) + 1)


@functools.cache
def _all_swaps(count: int) -> NDArray[np.int8]:
    return (np.arange(2**count)[:, None] >> np.arange(count) & 1).astype(np.int8)


@functools.lru_cache(maxsize=4)
def _random_swaps(count: int, seed: int) -> NDArray[np.int8]:
    return np.random.default_rng(seed).integers(0, 2, (RESAMPLES, count), dtype=np.int8)


def holm(values: Sequence[float | None]) -> list[float | None]:
    """p-values adjusted for how many there are (Holm 1979): the chance of one false difference
    among all stays under SIGNIFICANCE.

    None stands for a comparison that could not be made; it stays None and does not count.
    """
    order = sorted((p, index) for index, p in enumerate(values) if p is not None)
    adjusted: list[float | None] = [None] * len(values)
    highest = 0.0
    for rank, (p, index) in enumerate(order):
        highest = max(highest, min(1.0, p * (len(order) - rank)))
        adjusted[index] = highest
    return adjusted


def is_real(p_adjusted: float | None) -> bool:
    """Whether an adjusted p says that a difference is no chance."""
    return p_adjusted is not None and p_adjusted < SIGNIFICANCE
