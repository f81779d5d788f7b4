"""Scoring answers: per sample, then per candidate and configuration."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from planner_ft.benchmark.metrics import (
    FAILURES,
    exact_sequence,
    failure_kind,
    hallucinated,
    parameter_agreement,
    schema_valid,
    set_f1,
    strict_valid,
)
from planner_ft.benchmark.metrics.hallucination import UNPARSED_COUNTS
from planner_ft.benchmark.outputs import parse_output
from planner_ft.benchmark.samples import Sample
from planner_ft.benchmark.statistics import Estimate, bootstrap_mean, bootstrap_ratio, wilson
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import Level, plan_names

METRICS = (
    "f1", "hallucination", "hallucination_with_unparsed", "hallucination_without_unparsed", "parsed", "schema_valid", "strict_valid",
    "exact_sequence", "parameters", "whole_plan", "latency_s", "tokens", "forward_passes",
)  # fmt: skip
"""Names of the metrics in results.json and in gate files."""


@dataclass(frozen=True)
class SampleScore:
    """What one answer scored. `parameters_right` of `parameters_matched` entries had the expected parameters."""

    id: str
    family: str
    f1: float
    parsed: bool
    invented: bool
    schema_valid: bool
    strict_valid: bool
    exact_sequence: bool
    parameters_right: int
    parameters_matched: int
    failure: str | None
    group: str | None = None
    tokens: int | None = None
    latency_s: float | None = None
    forward_passes: int | None = None


def score_sample(
    level: Level, sample: Sample, prediction: Mapping[str, Any] | None, vocabulary: Vocabulary, timed: Mapping[str, Any] | None = None
) -> SampleScore:
    """Score one prediction (`output`, and `tokens` where they are known); None counts as an empty output. `timed` is the sample's timed query."""
    prediction, timed = prediction or {}, timed or {}
    plan = parse_output(prediction.get("output")).plan
    agreement = parameter_agreement(level, plan, sample.expected, vocabulary)
    return SampleScore(
        id=sample.id,
        family=sample.family,
        f1=set_f1(plan_names(level, plan), plan_names(level, sample.expected)),
        parsed=plan is not None,
        invented=hallucinated(level, plan, vocabulary, unparsed=False),
        schema_valid=schema_valid(level, plan, vocabulary),
        strict_valid=strict_valid(level, plan, vocabulary),
        exact_sequence=exact_sequence(level, plan, sample.expected),
        parameters_right=agreement.right,
        parameters_matched=agreement.matched,
        failure=failure_kind(level, plan, sample.expected, vocabulary),
        group=sample.group,
        tokens=prediction.get("tokens"),
        latency_s=timed.get("latency_s"),
        forward_passes=timed.get("forward_passes"),
    )


def summarise(level: Level, scores: Sequence[SampleScore], seed: int) -> dict[str, Estimate]:
    """Every metric over the scored samples: Wilson intervals for rates, bootstrap clustered by family for the others.

    `hallucination` counts answers that do not parse as the published table of this level does.
    """
    n = len(scores)
    families = [score.family for score in scores]
    unparsed = sum(not score.parsed for score in scores)
    invented = sum(score.invented for score in scores)
    both = {True: wilson(invented + unparsed, n), False: wilson(invented, n)}
    return {
        "f1": bootstrap_mean([score.f1 for score in scores], families, seed),
        "hallucination": both[UNPARSED_COUNTS[level]],
        "hallucination_with_unparsed": both[True],
        "hallucination_without_unparsed": both[False],
        "parsed": wilson(n - unparsed, n),
        "schema_valid": wilson(sum(score.schema_valid for score in scores), n),
        "strict_valid": wilson(sum(score.strict_valid for score in scores), n),
        "exact_sequence": wilson(sum(score.exact_sequence for score in scores), n),
        "parameters": bootstrap_ratio([score.parameters_right for score in scores], [score.parameters_matched for score in scores], families, seed),
        "whole_plan": wilson(sum(score.failure is None for score in scores), n),
        "latency_s": _mean_of_known([(score.latency_s, score.family) for score in scores], seed),
        "tokens": _mean_of_known([(score.tokens, score.family) for score in scores], seed),
        "forward_passes": _mean_of_known([(score.forward_passes, score.family) for score in scores], seed),
    }


def failure_counts(scores: Sequence[SampleScore]) -> dict[str, int]:
    """Number of wrong answers per kind of failure, every kind named."""
    counts = Counter(score.failure for score in scores)
    return {kind: counts[kind] for kind in FAILURES}


def _mean_of_known(values: Sequence[tuple[float | None, str]], seed: int) -> Estimate:
    known = [(value, family) for value, family in values if value is not None]
    return bootstrap_mean([value for value, _family in known], [family for _value, family in known], seed)
