"""From the scores of samples to figures with intervals."""

from __future__ import annotations

import math
from collections import Counter, defaultdict
from collections.abc import Callable, Sequence
from typing import Any

from planner_ft.benchmark.catalogue import CATALOGUE, METRIC, WORST_CASES, Metric
from planner_ft.benchmark.metrics.failures import FAILURES
from planner_ft.benchmark.metrics.paraphrases import worst_cases
from planner_ft.benchmark.scoring import SampleScore
from planner_ft.benchmark.statistics import (
    Estimate,
    bootstrap_mean,
    bootstrap_ratios,
    clustered_rate,
)

Scores = Sequence[SampleScore]


def summarise(scores: Scores, seed: int) -> dict[str, Estimate]:
    """Every metric over the scored samples, 95 %, families counted as such: Wilson intervals for
    rates, bootstrap for the others.
    """
    found = {metric.name: _rate(metric, scores) for metric in CATALOGUE if metric.kind == "rate"}
    found |= _resampled([metric for metric in CATALOGUE if metric.kind != "rate"], scores, seed)
    found |= _worst_figures(scores, seed)
    return {name: found[name] for name in METRIC}


def failure_counts(scores: Scores) -> dict[str, int]:
    """Number of wrong answers per kind of failure, every kind named."""
    counts = Counter(score.failure for score in scores)
    return {kind: counts[kind] for kind in FAILURES}


def _rate(metric: Metric, scores: Scores) -> Estimate:
    """A rate over those samples that have a value for it."""
    known = [score for score in scores if score.values.get(metric.name) is not None]
    hits = [bool(score.values[metric.name]) for score in known]
    return clustered_rate(hits, [score.family for score in known])


def _worst_figures(scores: Scores, seed: int) -> dict[str, Estimate]:
    """The metrics of phrasing families, each family counting once."""
    ids, families = [score.id for score in scores], [score.family for score in scores]
    found = {}
    for metric, name in WORST_CASES.items():
        worst = worst_cases([float(score.values[name] or 0) for score in scores], ids, families)
        values, names = list(worst.values()), list(worst)
        if metric.kind == "rate":
            found[metric.name] = clustered_rate([value == 1 for value in values], names)
        else:
            found[metric.name] = _bounded(metric, bootstrap_mean(values, names, seed), names)
    return found


def _resampled(metrics: Sequence[Metric], scores: Scores, seed: int) -> dict[str, Estimate]:
    """Means and ratios; those that the same samples have a value for are resampled together."""
    together: dict[tuple[int, ...], list[Metric]] = defaultdict(list)
    for metric in metrics:
        key = metric.over[1] or metric.name
        known = (at for at, score in enumerate(scores) if score.values.get(key) is not None)
        together[tuple(known)].append(metric)
    found: dict[str, Estimate] = {}
    for indices, members in together.items():
        some = [scores[index] for index in indices]
        families = [score.family for score in some]
        estimates = bootstrap_ratios([_terms(metric, some) for metric in members], families, seed)
        for metric, estimate in zip(members, estimates, strict=True):
            found[metric.name] = _bounded(metric, estimate, families)
    return found


def _terms(metric: Metric, scores: Scores) -> tuple[list[float], list[float]]:
    """Numerators and denominators."""
    top, below = metric.over if metric.kind == "ratio" else (metric.name, None)
    return (
        [float(score.values[top] or 0) for score in scores],
        [float(score.values[below] or 0) if below else 1.0 for score in scores],
    )


def _bounded(metric: Metric, estimate: Estimate, families: Sequence[str]) -> Estimate:
    """Where every sample is all right, or none is, every resample is the same and the bootstrap
    knows no doubt: the interval is that of a rate.
    """
    if not metric.fraction or estimate.value not in (0, 1):
        return estimate
    return clustered_rate([estimate.value == 1] * len(families), families)


def group_figures(scores: Sequence[dict[str, Any]]) -> list[dict[str, Any]]:
    """Per candidate, configuration and group of the data: `n` and means without interval (groups
    are small). Empty where no sample has a group.
    """
    found: dict[tuple[str, str, str], list[dict[str, Any]]] = {}
    for score in scores:
        if score.get("group"):
            key = score["candidate"], score["configuration"], score["group"]
            found.setdefault(key, []).append(score)
    lines = []
    for (candidate, configuration, group), members in found.items():
        n = len(members)
        matched = sum(score["parameters_matched"] for score in members)
        right = sum(score["parameters_right"] for score in members)
        lines.append(
            {
                "candidate": candidate,
                "configuration": configuration,
                "group": group,
                "n": n,
                "f1": sum(score["f1"] for score in members) / n,
                "exact_sequence": sum(score["exact_sequence"] for score in members) / n,
                "parameters": right / matched if matched else None,
                "whole_plan": sum(score["failure"] is None for score in members) / n,
                "strict_valid": sum(score["strict_valid"] for score in members) / n,
            }
        )
    return lines


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

    def means(estimator: Callable[[int, int, int], float]) -> dict[str, Any]:
        found = {}
        for k in range(1, most + 1):
            values = [estimator(right, n, k) for right, n in counts]
            found[str(k)] = bootstrap_mean(values, families, seed).to_json()
        return found

    return {"k": most, "all_of_k": means(all_of), "any_of_k": means(any_of)}
