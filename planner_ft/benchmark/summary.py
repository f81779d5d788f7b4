"""From the scores of samples to figures with intervals."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Sequence

from planner_ft.benchmark.catalogue import CATALOGUE, WORST_CASES, Metric
from planner_ft.benchmark.metrics import FAILURES
from planner_ft.benchmark.metrics.paraphrases import worst_cases
from planner_ft.benchmark.scoring import SampleScore
from planner_ft.benchmark.statistics import (
    Estimate,
    bootstrap_mean,
    bootstrap_ratios,
    clustered_rate,
)


def summarise(scores: Sequence[SampleScore], seed: int) -> dict[str, Estimate]:
    """Every metric of the catalogue over the scored samples, 95 %, families counted as such: Wilson
    intervals for rates, bootstrap for the others.
    """
    rates = {metric.name: rate(metric, scores) for metric in CATALOGUE if metric.kind == "rate"}
    others = _resampled([metric for metric in CATALOGUE if metric.kind != "rate"], scores, seed)
    return {metric.name: (rates | others)[metric.name] for metric in CATALOGUE} | worst_figures(
        scores, seed
    )


def rate(metric: Metric, scores: Sequence[SampleScore]) -> Estimate:
    """A rate over those samples that have a value for it."""
    known = [score for score in scores if score.values.get(metric.name) is not None]
    return clustered_rate(
        [bool(score.values[metric.name]) for score in known], [score.family for score in known]
    )


def worst_figures(scores: Sequence[SampleScore], seed: int) -> dict[str, Estimate]:
    """The metrics of phrasing families (`catalogue.WORST_CASES`), each family counting once."""
    ids, families = [score.id for score in scores], [score.family for score in scores]
    lowest, right = (
        worst_cases([float(score.values[name] or 0) for score in scores], ids, families)
        for name in WORST_CASES.values()
    )
    names = list(WORST_CASES)
    mean = bootstrap_mean(list(lowest.values()), list(lowest), seed)
    return {
        names[0]: _bounded(Metric(names[0], "mean"), mean, list(lowest)),
        names[1]: clustered_rate([value == 1 for value in right.values()], list(right)),
    }


def failure_counts(scores: Sequence[SampleScore]) -> dict[str, int]:
    """Number of wrong answers per kind of failure, every kind named."""
    counts = Counter(score.failure for score in scores)
    return {kind: counts[kind] for kind in FAILURES}


def _resampled(
    metrics: Sequence[Metric], scores: Sequence[SampleScore], seed: int
) -> dict[str, Estimate]:
    """Means and ratios; those that the same samples have a value for are resampled together."""
    together: dict[tuple[int, ...], list[Metric]] = defaultdict(list)
    for metric in metrics:
        key = metric.over[1] or metric.name
        together[
            tuple(index for index, score in enumerate(scores) if score.values.get(key) is not None)
        ].append(metric)
    found: dict[str, Estimate] = {}
    for indices, members in together.items():
        known = [scores[index] for index in indices]
        families = [score.family for score in known]
        estimates = bootstrap_ratios([_terms(metric, known) for metric in members], families, seed)
        found |= {
            metric.name: _bounded(metric, estimate, families)
            for metric, estimate in zip(members, estimates, strict=True)
        }
    return found


def _terms(metric: Metric, scores: Sequence[SampleScore]) -> tuple[list[float], list[float]]:
    """Numerators and denominators."""
    if metric.kind == "mean":
        return [float(score.values[metric.name] or 0) for score in scores], [1.0] * len(scores)
    return [float(score.values[metric.over[0]] or 0) for score in scores], [
        float(score.values[metric.over[1]] or 0) for score in scores
    ]


def _bounded(metric: Metric, estimate: Estimate, families: Sequence[str]) -> Estimate:
    """Where every sample is all right, or none is, every resample is the same and the bootstrap
    knows no doubt: the interval is that of a rate.
    """
    if not metric.fraction or estimate.value not in (0, 1):
        return estimate
    return clustered_rate([estimate.value == 1] * len(families), families)
