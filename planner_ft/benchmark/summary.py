"""From the scores of samples to figures with intervals."""

from __future__ import annotations

import math
from collections import Counter, defaultdict
from collections.abc import Callable, Iterable, Sequence
from typing import Any

from planner_ft.benchmark.catalogue import METRIC, Metric
from planner_ft.benchmark.metrics.failures import FAILURES
from planner_ft.benchmark.scoring import SampleScore
from planner_ft.benchmark.statistics import (
    Estimate,
    bootstrap_mean,
    bootstrap_ratio,
    clustered_rate,
)

OF_GROUPS = ("f1", "exact_sequence", "parameters", "whole_plan", "strict_valid")
Scores = Sequence[SampleScore]
Term = tuple[float, float, str]
"""Numerator, denominator and family."""


def summarise(scores: Scores, seed: int, names: Iterable[str] = METRIC) -> dict[str, Estimate]:
    """Every metric, or those named, over the scored samples, 95 %, families counted as such: Wilson intervals for
    rates, bootstrap for the others.
    """
    return {name: _estimate(METRIC[name], _terms(METRIC[name], scores), seed) for name in names}


def failure_counts(scores: Scores) -> dict[str, int]:
    """Number of wrong answers per kind of failure, every kind named."""
    counts = Counter(score.failure for score in scores)
    return {kind: counts[kind] for kind in FAILURES}


def _terms(metric: Metric, scores: Scores) -> list[Term]:
    """The terms of the samples that have a value, or of phrasing families, each counting once."""
    if metric.worst:
        values = [float(score.values[metric.worst] or 0) for score in scores]
        ids, families = [score.id for score in scores], [score.family for score in scores]
        return [(one, 1.0, family) for family, one in worst_cases(values, ids, families).items()]
    found = ((metric.terms(score.values), score.family) for score in scores)
    return [(*terms, family) for terms, family in found if terms]


def _estimate(metric: Metric, terms: Sequence[Term], seed: int) -> Estimate:
    """Where every sample is all right, or none is, every resample is the same and the bootstrap
    knows no doubt: the interval is that of a rate.
    """
    if not terms:
        return Estimate(None)
    tops, belows, families = zip(*terms, strict=True)
    if metric.kind == "rate":
        return clustered_rate([top == 1 for top in tops], families)
    estimate = bootstrap_ratio(tops, belows, families, seed)
    if metric.fraction and estimate.value in (0, 1):
        return clustered_rate([estimate.value == 1] * len(families), families)
    return estimate


def worst_cases(
    values: Sequence[float], samples: Sequence[str], families: Sequence[str]
) -> dict[str, float]:
    """The smallest value of each family with at least two samples (ids); for truths, whether all
    are true. Of a sample that was answered several times every answer counts.
    """
    members: dict[str, list[float]] = defaultdict(list)
    ids: dict[str, set[str]] = defaultdict(set)
    for value, sample, family in zip(values, samples, families, strict=True):
        members[family].append(value)
        ids[family].add(sample)
    return {family: min(found) for family, found in members.items() if len(ids[family]) > 1}


def group_figures(scores: Sequence[dict[str, Any]]) -> list[dict[str, Any]]:
    """Per candidate, configuration and group of the data: `n` and means without interval (groups
    are small). Empty where no sample has a group.
    """
    found: dict[tuple[str, str, str], list[dict[str, Any]]] = {}
    for score in scores:
        if score.get("group"):
            key = score["candidate"], score["configuration"], score["group"]
            # Scores of earlier versions do not say whether the whole plan is right.
            right = score["failure"] is None
            found.setdefault(key, []).append({**score, "whole_plan": right})
    return [
        {
            **dict(zip(("candidate", "configuration", "group"), key, strict=True)),
            "n": len(members),
            **{name: METRIC[name].value(members) for name in OF_GROUPS},
        }
        for key, members in found.items()
    ]


def all_of(right: int, n: int, k: int) -> float:
    """pass^k of one sample: the chance that k of its n answers, drawn without replacement, are all
    right, C(right, k) / C(n, k) (tau-bench: Yao et al. 2024, arXiv:2406.12045, section 3).
    """
    return math.comb(right, k) / math.comb(n, k)


def any_of(right: int, n: int, k: int) -> float:
    """pass@k of one sample: the chance that at least one of k of its n answers is right, 1 - C(n -
    right, k) / C(n, k) (Chen et al. 2021, arXiv:2107.03374, equation 1).
    """
    return 1 - math.comb(n - right, k) / math.comb(n, k)


def pass_figures(scores: Scores, seed: int) -> dict[str, Any]:
    """pass^k and pass@k for k = 1 to the least number of answers that a sample has, an answer being
    right when the whole plan is.

    Means over samples with 95 % bootstrap intervals, whole phrasing families resampled.
    """
    attempts: dict[str, list[bool]] = {}
    for score in scores:
        attempts.setdefault(score.id, []).append(score.failure is None)
    family = {score.id: score.family for score in scores}
    families = [family[name] for name in attempts]
    counts = [(sum(right), len(right)) for right in attempts.values()]
    most = min((n for _right, n in counts), default=0)

    def mean(estimator: Callable[[int, int, int], float], k: int) -> dict[str, Any]:
        values = [estimator(right, n, k) for right, n in counts]
        return bootstrap_mean(values, families, seed).to_json()

    kinds = {"all_of_k": all_of, "any_of_k": any_of}
    means = {
        kind: {str(k): mean(one, k) for k in range(1, most + 1)} for kind, one in kinds.items()
    }
    return {"k": most, **means}
