"""From the scores of samples to figures with intervals."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from planner_ft.benchmark.catalogue import CATALOGUE, Metric
from planner_ft.benchmark.metrics import FAILURES
from planner_ft.benchmark.scoring import SampleScore
from planner_ft.benchmark.statistics import Estimate, bootstrap_mean, bootstrap_ratio, clustered_rate


def summarise(scores: Sequence[SampleScore], seed: int) -> dict[str, Estimate]:
    """Every metric of the catalogue over the scored samples, 95 %, families counted as such: Wilson intervals for rates, bootstrap for the others."""
    return {metric.name: estimate(metric, scores, seed) for metric in CATALOGUE}


def estimate(metric: Metric, scores: Sequence[SampleScore], seed: int) -> Estimate:
    """One metric over those samples that have a value for it."""
    key = metric.over[1] if metric.kind == "ratio" else metric.name
    known = [score for score in scores if score.values.get(key) is not None]
    values = [float(score.values[key] or 0) for score in known]
    families = [score.family for score in known]
    if metric.kind == "rate":
        return clustered_rate([value == 1 for value in values], families)
    if metric.kind == "mean":
        return bootstrap_mean(values, families, seed)
    return bootstrap_ratio([float(score.values[metric.over[0]] or 0) for score in known], values, families, seed)


def failure_counts(scores: Sequence[SampleScore]) -> dict[str, int]:
    """Number of wrong answers per kind of failure, every kind named."""
    counts = Counter(score.failure for score in scores)
    return {kind: counts[kind] for kind in FAILURES}
