"""Scoring one answer: every metric of a sample."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

from planner_ft.benchmark.answer import Answer, Value
from planner_ft.benchmark.catalogue import METRICS
from planner_ft.benchmark.metrics import (
    Counts,
    agreement_by_type,
    common_subsequence,
    counts_by_role,
    edge_f1,
    edit_distance,
    exact_sequence,
    failure_kind,
    hallucinated,
    multiset_counts,
    parameter_counts,
    right_entries,
    set_counts,
    whole_plan_unordered,
)
from planner_ft.benchmark.metrics.alignment import Alignment
from planner_ft.benchmark.metrics.exact_sequence import flat_sequence, name_sequence
from planner_ft.benchmark.metrics.hallucination import UNPARSED_COUNTS
from planner_ft.benchmark.plan_logic import plan_logic
from planner_ft.benchmark.samples import Sample
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.definition import ROLES
from planner_ft.vocabulary.outputs import parse_output
from planner_ft.vocabulary.plans import Level

__all__ = ["METRICS", "SampleScore", "score_sample"]

TIMED = ("latency_s", "forward_passes")
Values = dict[str, Value]


@dataclass(frozen=True)
class SampleScore:
    """What one answer scored: `values` by metric, and the kind of failure, None when names, order
    and parameters are right.

    `alignment` and `types` (per type of parameter: values that agree, values that there are) are
    what tables by name and type are made of, `details` what explains values: where the plan stops,
    values that nobody gave, slots by kind (`plan_logic`).
    """

    id: str
    family: str
    group: str | None
    failure: str | None
    values: Values
    alignment: Alignment = field(default=Alignment((), (), ()), repr=False)
    types: dict[str, tuple[int, int]] = field(default_factory=dict, repr=False)
    details: dict[str, Any] = field(default_factory=dict, repr=False)

    def to_json(self) -> dict[str, Any]:
        """A line of scores.jsonl."""
        return {
            "id": self.id,
            "family": self.family,
            **self.values,
            "failure": self.failure,
            "group": self.group,
            "alignment": self.alignment.to_json(),
            **self.details,
        }


def score_sample(
    level: Level,
    sample: Sample,
    prediction: Mapping[str, Any] | None,
    vocabulary: Vocabulary,
    timed: Mapping[str, Any] | None = None,
) -> SampleScore:
    """Score one prediction (`output`, and `tokens` where they are known); None counts as an empty
    output. `timed` is the sample's timed query.
    """
    prediction, timed = prediction or {}, timed or {}
    answer = Answer(level, sample, parse_output(prediction.get("output")).plan, vocabulary)
    failure = failure_kind(
        level, answer.plan, sample.expected, vocabulary, valid=answer.schema_valid
    )
    values: Values = {}
    for part in PARTS:
        values |= part(answer)
    logic = plan_logic(answer)
    values |= logic.values()
    values |= {
        "whole_plan": failure is None,
        "whole_plan_unordered": failure is None or unordered(answer),
    }
    values |= {"tokens": prediction.get("tokens")} | {key: timed.get(key) for key in TIMED}
    types = agreement_by_type(level, answer.alignment, vocabulary)
    return SampleScore(
        sample.id,
        sample.family,
        sample.group,
        failure,
        values,
        answer.alignment,
        types,
        logic.details(),
    )


def published_values(answer: Answer) -> Values:
    """Hallucination in both readings and validity, as the published tables have them."""
    invented = hallucinated(answer.level, answer.plan, answer.vocabulary, unparsed=False)
    both = {True: invented or answer.plan is None, False: invented}
    return {
        "parsed": answer.plan is not None,
        "invented": invented,
        "hallucination": both[UNPARSED_COUNTS[answer.level]],
        "hallucination_with_unparsed": both[True],
        "hallucination_without_unparsed": both[False],
        "schema_valid": answer.schema_valid,
        "strict_valid": answer.strict_valid,
    }


def name_values(answer: Answer) -> Values:
    """Names as a set (the published F1) and as a multiset; at task level also per role."""
    distinct, all_of_them = (
        set_counts(answer.given_names, answer.wanted_names),
        multiset_counts(answer.given_names, answer.wanted_names),
    )
    values: Values = {"f1": distinct.f1, "precision": distinct.precision, "recall": distinct.recall}
    values |= {
        "multiset_f1": all_of_them.f1,
        "multiset_precision": all_of_them.precision,
        "multiset_recall": all_of_them.recall,
    }
    if answer.level == "task":
        by_role = counts_by_role(answer.given, answer.wanted)
        for role in ROLES:
            values |= _pooled(role, by_role.get(role, Counts(0, 0, 0)))
    return values


def order_values(answer: Answer) -> Values:
    """Order of the names; at task level also of the steps."""
    level, plan, expected = answer.level, answer.plan or {}, answer.expected
    ours, theirs = flat_sequence(level, plan), flat_sequence(level, expected)
    steps, their_steps = name_sequence(level, plan), name_sequence(level, expected)
    return {
        "exact_sequence": exact_sequence(level, answer.plan, expected),
        "edit_distance": edit_distance(ours, theirs),
        "step_edit_distance": edit_distance(steps, their_steps) if level == "task" else None,
        "lcs_f1": common_subsequence(ours, theirs).f1,
        "edge_f1": edge_f1(steps, their_steps),
    }


def parameter_values(answer: Answer) -> Values:
    """Parameters of aligned entries: all right, keys and key-value pairs; these also over the whole
    plan.
    """
    agreement = right_entries(answer.level, answer.alignment, answer.vocabulary)
    counts = parameter_counts(answer.level, answer.alignment, answer.vocabulary)
    return {
        "parameters_right": agreement.right,
        "parameters_matched": agreement.matched,
        **_pooled("parameter_keys", counts.keys),
        **_pooled("parameter_values", counts.values),
        **_pooled("parameter_keys_overall", counts.keys_overall),
        **_pooled("parameter_values_overall", counts.values_overall),
    }


def unordered(answer: Answer) -> bool:
    """Whether the plan is right but for the order of its tasks or steps."""
    return whole_plan_unordered(
        answer.level, answer.plan, answer.expected, answer.vocabulary, valid=answer.schema_valid
    )


def _pooled(prefix: str, counts: Counts) -> Values:
    """What an F1 over all samples is summed up from (`catalogue.pooled_f1`)."""
    return {
        f"{prefix}_right": counts.right,
        f"{prefix}_size": (counts.predicted + counts.expected) / 2,
    }


PARTS: tuple[Callable[[Answer], Values], ...] = (
    published_values,
    name_values,
    order_values,
    parameter_values,
)
"""What a sample is scored by: each gives values under names of its own. The catalogue says how they
are summed up.
"""
