"""Two systems on the same samples: the difference of a metric, its chance, and the verdict."""

from __future__ import annotations

import functools
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass, fields, replace
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from planner_ft.benchmark import statistics
from planner_ft.benchmark.catalogue import METRIC, Metric
from planner_ft.support.tables import NOTHING, Cell

Score = Mapping[str, Any]  # A line of scores.jsonl
Answers = Mapping[str, Sequence[Score]]
"""The scores of a system by sample id: one per sample, or one per repeat."""
UNKNOWN = statistics.Estimate(None)
ENUMERATED = 12
"""Differing families up to which all 2**12 swaps are tried instead of RESAMPLES random ones."""

Verdict = Literal["better", "worse", "higher", "lower", "equal", "not told apart", "not compared"]
MARKS: dict[Verdict, str] = {"better": "▲", "higher": "▲", "worse": "▼", "lower": "▼"}
MARKS |= {"equal": "≈", "not told apart": "·", "not compared": ""}
SIGNIFICANCE = 0.05
MARGIN = 0.05
"""Two systems whose difference is known to be smaller than this, at 95 %, are called equal."""
EXPLAINED = (
    f"▲ better and ▼ worse beyond chance (p < 0.05 after Holm), ≈ equal within {MARGIN:g} (95 %"
    " interval), · not told apart"
)


@dataclass(frozen=True)
class Comparison:
    """`second` against `first` by one metric of the `n` samples that both answered.

    `difference` is second minus first (95 % interval, whole families resampled), `p` the two-sided
    probability of as large a difference if it made no difference which system answered, families
    being swapped whole. `p_mcnemar` is the exact McNemar test of a rate, which takes all samples
    for independent: where they are, `p` is the same. `p_adjusted` is Holm's over the same table.
    """

    first: str
    second: str
    metric: str
    first_value: float | None = None
    second_value: float | None = None
    n: int = 0
    families: int = 0
    difference: statistics.Estimate = UNKNOWN
    p: float | None = None
    p_mcnemar: float | None = None
    p_adjusted: float | None = None

    @property
    def verdict(self) -> Verdict:
        return verdict(self.metric, self.difference, self.p_adjusted)

    @property
    def mark(self) -> str:
        return MARKS[self.verdict]

    def cell(self) -> Cell:
        """The difference with its interval and mark."""
        return difference_cell(self.metric, self.difference, self.mark)

    def to_json(self) -> dict[str, Any]:
        """As results.json and comparison.json have it."""
        return {**asdict(self), "verdict": self.verdict}

    @classmethod
    def from_json(cls, record: Mapping[str, Any]) -> Comparison:
        """A comparison as `to_json` wrote it."""
        known = {one.name: record[one.name] for one in fields(cls)}
        return cls(**known | {"difference": statistics.Estimate(**record["difference"])})


def paired(
    metric: Metric, first: Answers, second: Answers, seed: int, names: tuple[str, str] = ("", "")
) -> Comparison:
    """Compare by a metric, over samples with a value in both; repeats are averaged first."""
    families, terms = [], []
    for name in (name for name in first if name in second):
        one, other = _terms(metric, first[name]), _terms(metric, second[name])
        if one is not None and other is not None:
            families.append(str(first[name][0].get("family") or first[name][0].get("id")))
            terms.append((*one, *other))
    if not terms:
        return Comparison(*names, metric.name)
    sums = statistics.cluster_sums(terms, families)
    before, after = (float(value) if np.isfinite(value) else None for value in _values(sums.sum(0)))
    found = Comparison(*names, metric.name, before, after, len(terms), len(sums))
    if before is None or after is None:
        return found
    differs = [tuple(term[:2]) != tuple(term[2:]) for term in terms]
    difference = statistics.Estimate(after - before)
    if not any(differs) and metric.fraction:
        # No resample differs either, and the bootstrap would be sure after three samples: the bound
        # is that of the share of samples that may differ.
        most = statistics.clustered_rate(differs, families).high or 0.0
        difference = statistics.Estimate(after - before, -most, most)
    elif len(sums) > 1:
        one, other = _values(statistics.resampled_sums(sums, seed))
        known = (change := other - one)[np.isfinite(change)]
        bounds = statistics.percentiles(known)  # Efron 1979
        difference = statistics.Estimate(after - before, *bounds)
    mcnemar: float | None = None
    if metric.kind == "rate" and all(value in (0, 1) for term in terms for value in term):
        p = exact_swaps(sums[:, 2] - sums[:, 0])
        lost, won = (sum(term[0] - term[2] == sign for term in terms) for sign in (1, -1))
        mcnemar = exact_mcnemar(lost, won)
    else:
        p = swaps(sums, seed)
    return replace(found, difference=difference, p=p, p_mcnemar=mcnemar)


def _terms(metric: Metric, scores: Sequence[Score]) -> tuple[float, float] | None:
    """A sample's numerator and denominator, means over its repeats; None where it says nothing."""
    known = [terms for score in scores if (terms := metric.terms(score))]
    if not known:
        return None
    above, below = (sum(column) / len(known) for column in zip(*known, strict=True))
    return above, below


def _values(sums: statistics.Floats) -> tuple[Any, Any]:
    """The metric of both systems, from (numerator, denominator) of each along the last axis."""
    with np.errstate(invalid="ignore", divide="ignore"):
        return sums[..., 0] / sums[..., 1], sums[..., 2] / sums[..., 3]


def exact_mcnemar(lost: int, won: int) -> float:
    """Two-sided p of the exact McNemar test (1947): right by the first alone, by the second."""
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
    return min(1.0, 2 * float(chances[total + seen :].sum()))


def swaps(sums: statistics.Floats, seed: int) -> float:
    """Two-sided p of a difference if the two systems were swapped at random, family by family
    (Fisher 1935; Pitman 1937). `sums` are those of `_values`, (families, 4). All ways to swap are
    tried where few families differ, else RESAMPLES random ones.
    """
    differing = sums[(sums[:, :2] != sums[:, 2:]).any(1)]
    count = len(differing)
    if not count:
        return 1.0
    exact = count <= ENUMERATED
    swapped = _all_swaps(count) if exact else _random_swaps(count, seed)
    moved = statistics.in_blocks(swapped, differing[:, 2:] - differing[:, :2])
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
    return np.random.default_rng(seed).integers(0, 2, (statistics.RESAMPLES, count), dtype=np.int8)


def holm(values: Sequence[float | None]) -> list[float | None]:
    """p-values adjusted after Holm 1979; None, for no comparison, stays and does not count."""
    known = [value for value in values if value is not None]
    if not known:
        return [None] * len(values)
    # statsmodels' multipletests collects all garbage of the process, which takes longer than a table.
    order, adjusted = np.argsort(known), np.empty(len(known))
    steps = np.asarray(known)[order] * np.arange(len(known), 0, -1)
    adjusted[order] = np.minimum(np.maximum.accumulate(steps), 1)
    each = iter(adjusted.tolist())
    return [None if value is None else next(each) for value in values]


def verdict(name: str, difference: statistics.Estimate, p_adjusted: float | None) -> Verdict:
    """Real: adjusted p under 0.05; equal: known to differ by less than MARGIN; else unknown."""
    metric = METRIC.get(name)
    if difference.value is None or p_adjusted is None:
        return "not compared"
    better = metric.better if metric else "↑"
    up = difference.value > 0
    if p_adjusted < SIGNIFICANCE:
        if not better:
            return "higher" if up else "lower"
        return "better" if up == (better == "↑") else "worse"
    low, high = difference.low, difference.high
    within = low is not None and high is not None and low >= -MARGIN and high <= MARGIN
    return "equal" if within and (metric is None or metric.fraction) else "not told apart"


def adjusted(found: Sequence[Comparison]) -> list[Comparison]:
    """Comparisons of one table, their p-values adjusted together."""
    ps = holm([one.p for one in found])
    return [replace(one, p_adjusted=p) for one, p in zip(found, ps, strict=True)]


def p_text(p: float | None) -> str:
    """A p-value as tables show it."""
    return NOTHING if p is None else "< 0.001" if p < 0.001 else f"{p:.3f}"


def difference_cell(name: str, found: statistics.Estimate, mark: str = "") -> Cell:
    """A difference with its sign, interval and mark, in the unit of its metric."""
    metric = METRIC[name]
    decimals = 3 if metric.scale == 1 and metric.fraction else metric.decimals
    return found.cell(scale=metric.scale, decimals=decimals, mark=mark, sign=True)
