"""Scoring one answer: every metric of a sample."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from planner_ft.benchmark.answer import Answer, Value
from planner_ft.benchmark.catalogue import METRICS
from planner_ft.benchmark.metrics import (
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
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import Level, plan_names

__all__ = ["METRICS", "SampleScore", "score_sample"]

TIMED = ("latency_s", "forward_passes")


@dataclass(frozen=True)
class SampleScore:
    """What one answer scored: `values` by metric, and the kind of failure, None when names, order and parameters are right."""

    id: str
    family: str
    group: str | None
    failure: str | None
    values: dict[str, Value]

    def to_json(self) -> dict[str, Any]:
        """A line of scores.jsonl."""
        return {"id": self.id, "family": self.family, **self.values, "failure": self.failure, "group": self.group}


def score_sample(
    level: Level, sample: Sample, prediction: Mapping[str, Any] | None, vocabulary: Vocabulary, timed: Mapping[str, Any] | None = None
) -> SampleScore:
    """Score one prediction (`output`, and `tokens` where they are known); None counts as an empty output. `timed` is the sample's timed query."""
    prediction, timed = prediction or {}, timed or {}
    answer = Answer(level, sample, parse_output(prediction.get("output")).plan, vocabulary)
    failure = failure_kind(level, answer.plan, sample.expected, vocabulary)
    values: dict[str, Value] = {}
    for part in PARTS:
        values |= part(answer)
    values |= {"whole_plan": failure is None, "tokens": prediction.get("tokens")} | {key: timed.get(key) for key in TIMED}
    return SampleScore(sample.id, sample.family, sample.group, failure, values)


def published_values(answer: Answer) -> dict[str, Value]:
    """F1, hallucination in both readings and validity: what the published tables have."""
    level, plan, vocabulary = answer.level, answer.plan, answer.vocabulary
    invented = hallucinated(level, plan, vocabulary, unparsed=False)
    both = {True: invented or plan is None, False: invented}
    return {
        "f1": set_f1(plan_names(level, plan), plan_names(level, answer.expected)),
        "parsed": plan is not None,
        "invented": invented,
        "hallucination": both[UNPARSED_COUNTS[level]],
        "hallucination_with_unparsed": both[True],
        "hallucination_without_unparsed": both[False],
        "schema_valid": schema_valid(level, plan, vocabulary),
        "strict_valid": strict_valid(level, plan, vocabulary),
    }


def sequence_values(answer: Answer) -> dict[str, Value]:
    """Whether names and order are right."""
    return {"exact_sequence": exact_sequence(answer.level, answer.plan, answer.expected)}


def parameter_values(answer: Answer) -> dict[str, Value]:
    """Of the matched entries, how many have the expected parameters."""
    agreement = parameter_agreement(answer.level, answer.plan, answer.expected, answer.vocabulary)
    return {"parameters_right": agreement.right, "parameters_matched": agreement.matched}


PARTS: tuple[Callable[[Answer], dict[str, Value]], ...] = (published_values, sequence_values, parameter_values)
"""What a sample is scored by: each gives values under names of its own. The catalogue says how they are summed up."""
