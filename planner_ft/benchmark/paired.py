"""Two systems on the same samples: the difference of a metric with its interval, and how likely it
is by chance.
"""

from __future__ import annotations

import functools
from collections.abc import Hashable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from planner_ft.benchmark.catalogue import Metric
from planner_ft.benchmark.statistics import (
    RESAMPLES,
    Estimate,
    Floats,
    cluster_sums,
    clustered_rate,
    in_blocks,
    percentiles,
    resampled_sums,
)

Score = Mapping[str, Any]
"""A line of scores.jsonl."""
Answers = Mapping[str, Sequence[Score]]
"""The scores of a system by sample id: one per sample, or one per repeat."""

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


def paired(metric: Metric, first: Answers, second: Answers, seed: int) -> Paired:
    """Compare two systems by a metric, over the samples for which both have a value. Repeats of a
    sample are averaged first.
    """
    families, terms = [], []
    for name in (name for name in first if name in second):
        one, other = _terms(metric, first[name]), _terms(metric, second[name])
        if one is not None and other is not None:
            families.append(str(first[name][0].get("family") or first[name][0].get("id")))
            terms.append((*one, *other))
    if not terms:
        return Paired(metric.name, 0, 0, None, None, Estimate(None))
    sums = cluster_sums(terms, families)
    before, after = (float(value) if np.isfinite(value) else None for value in _values(sums.sum(0)))
    if before is None or after is None:
        return Paired(metric.name, len(terms), len(sums), before, after, Estimate(None))
    difference = _difference(metric, terms, sums, families, after - before, seed)
    mcnemar: float | None = None
    if metric.kind == "rate" and all(value in (0, 1) for term in terms for value in term):
        lost = sum(term[0] > term[2] for term in terms)
        won = sum(term[0] < term[2] for term in terms)
        p = exact_swaps(sums[:, 2] - sums[:, 0])
        mcnemar = exact_mcnemar(lost, won)
    else:
        p = swaps(sums, seed)
    return Paired(metric.name, len(terms), len(sums), before, after, difference, p, mcnemar)


def _terms(metric: Metric, scores: Sequence[Score]) -> tuple[float, float] | None:
    """Numerator and denominator of a sample, means over its repeats; None where it says nothing
    about the metric.
    """
    known = [terms for score in scores if (terms := metric.terms(score))]
    above, below = (sum(column) for column in zip(*known, strict=True)) if known else (0.0, 0.0)
    return (above / len(known), below / len(known)) if known else None


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
    """Two-sided p of the exact McNemar test (1947): `lost` samples were right with the first system
    alone, `won` with the second.
    """
    from statsmodels.stats.contingency_tables import mcnemar

    return float(mcnemar([[0, lost], [won, 0]], exact=True).pvalue)


def exact_swaps(differences: Iterable[float]) -> float:
    """Two-sided p that whole numbers, each with a random sign, have a sum as far from 0 as theirs:
    exact, from the sum's distribution. With differences of one sample each it is the exact McNemar
    test.
    """
    whole = [round(value) for value in differences if value]
    seen, total = abs(sum(whole)), sum(map(abs, whole))
    if not seen:
        return 1.0
    chances = np.zeros(2 * total + 1)
    chances[total] = 1
    for size in map(abs, whole):
        chances = (np.roll(chances, size) + np.roll(chances, -size)) / 2
    return float(min(1.0, chances[: total - seen + 1].sum() + chances[total + seen :].sum()))


def swaps(sums: Floats, seed: int) -> float:
    """Two-sided p of a difference if the two systems were swapped at random, family by family
    (Fisher 1935; Pitman 1937).

    `sums` are those of `_values`, (families, 4). All ways to swap are tried where few families
    differ, else RESAMPLES random ones.
    """
    differing = sums[(sums[:, :2] != sums[:, 2:]).any(1)]
    count = len(differing)
    if not count:
        return 1.0
    exact = count <= ENUMERATED
    swapped = _all_swaps(count) if exact else _random_swaps(count, seed)
    moved = in_blocks(swapped, differing[:, 2:] - differing[:, :2])
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
    """p-values adjusted for how many there are (Holm 1979). None stands for a comparison that could
    not be made; it stays None and does not count.
    """
    known = [value for value in values if value is not None]
    if not known:
        return [None] * len(values)
    # statsmodels' multipletests collects all garbage of the process, which takes longer than a table.
    order, adjusted = np.argsort(known), np.empty(len(known))
    steps = np.asarray(known)[order] * np.arange(len(known), 0, -1)
    adjusted[order] = np.minimum(np.maximum.accumulate(steps), 1)
    each = iter(adjusted.tolist())
    return [None if value is None else next(each) for value in values]
