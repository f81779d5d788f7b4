"""Every metric of results.json, and how it is summed up from the values of samples (keys of
scores.jsonl).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

Kind = Literal["rate", "mean", "ratio"]


@dataclass(frozen=True)
class Metric:
    """A metric over samples; samples whose value is None say nothing about it and are left out.

    rate: share of samples whose value is true. mean: mean of the values. ratio: sum of the values
    under `over`[0] by the sum of those under `over`[1]. Rates and means have their value in
    scores.jsonl under their own name. `fraction` says whether it lies between 0 and 1.
    """

    name: str
    kind: Kind
    over: tuple[str, str] = ("", "")
    fraction: bool = True


def pooled_f1(name: str, prefix: str) -> Metric:
    """The F1 of all samples together: PREFIX_right by PREFIX_size, which is half of predicted and
    expected items.
    """
    return Metric(name, "ratio", (f"{prefix}_right", f"{prefix}_size"))


CATALOGUE = (
    Metric("f1", "mean"),
    Metric("hallucination", "rate"),
    Metric("hallucination_with_unparsed", "rate"),
    Metric("hallucination_without_unparsed", "rate"),
    Metric("parsed", "rate"),
    Metric("schema_valid", "rate"),
    Metric("strict_valid", "rate"),
    Metric("precision", "mean"),
    Metric("recall", "mean"),
    Metric("multiset_f1", "mean"),
    Metric("multiset_precision", "mean"),
    Metric("multiset_recall", "mean"),
    pooled_f1("navigation_f1", "navigation"),
    pooled_f1("filter_f1", "filter"),
    pooled_f1("perception_f1", "perception"),
    Metric("exact_sequence", "rate"),
    Metric("edit_distance", "mean"),
    Metric("step_edit_distance", "mean"),
    Metric("lcs_f1", "mean"),
    Metric("edge_f1", "mean"),
    Metric("parameters", "ratio", ("parameters_right", "parameters_matched")),
    pooled_f1("parameter_keys_f1", "parameter_keys"),
    pooled_f1("parameter_values_f1", "parameter_values"),
    pooled_f1("parameter_keys_overall_f1", "parameter_keys_overall"),
    pooled_f1("parameter_values_overall_f1", "parameter_values_overall"),
    Metric("whole_plan", "rate"),
    Metric("whole_plan_unordered", "rate"),
    Metric("executable", "rate"),
    Metric("grounded", "rate"),
    Metric("grounded_values", "ratio", ("values_grounded", "values_judged")),
    Metric("slots_in_parameters", "ratio", ("slots_in_parameters_right", "slots_stated")),
    Metric("slots_in_prompt", "ratio", ("slots_in_prompt_right", "slots_prompted")),
    Metric("right_refusal", "rate"),
    Metric("wrong_refusal", "rate"),
    Metric("latency_s", "mean", fraction=False),
    Metric("tokens", "mean", fraction=False),
    Metric("forward_passes", "mean", fraction=False),
)
WORST_CASES = {"worst_f1": "f1", "paraphrases_right": "whole_plan"}
"""Metrics of phrasing families with at least two samples: the mean over families of the smallest
F1, and the share of families of which every sample is right.
"""
METRICS = (*(metric.name for metric in CATALOGUE), *WORST_CASES)
"""Names of the metrics in results.json and in gate files."""
