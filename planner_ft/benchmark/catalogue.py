"""Every metric of results.json: how it is summed up from the values of samples (keys of
scores.jsonl), and how tables show it.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from planner_ft.benchmark.statistics import Estimate
from planner_ft.support.tables import Cell, figure

Kind = Literal["rate", "mean", "ratio"]


@dataclass(frozen=True)
class Metric:
    """A metric over samples; samples whose value is None say nothing about it and are left out.

    rate: share of samples whose value is true. mean: mean of the values. ratio: sum of the values
    under `over`[0] by the sum of those under `over`[1]. Rates and means have their value in
    scores.jsonl under their own name. `fraction` says whether it lies between 0 and 1, `better`
    which way is better: ↑, ↓ or neither.
    """

    name: str
    kind: Kind
    heading: str = ""
    better: str = "↑"
    over: tuple[str, str] = ("", "")
    fraction: bool = True

    @property
    def scale(self) -> int:
        """100 where tables show percent."""
        return 100 if "(%)" in self.heading else 1

    @property
    def decimals(self) -> int:
        return 1 if self.scale == 100 or self.name in ("tokens", "forward_passes") else 2

    @property
    def title(self) -> str:
        """The heading of a column, with the way that is better."""
        return f"{self.heading} {self.better}".strip()

    def cell(self, found: Estimate, mark: str = "", *, published: bool = False) -> Cell:
        """A figure with its interval; published latencies have one decimal."""
        decimals = min(1, self.decimals) if published and not self.fraction else self.decimals
        bounds = found.value, found.low, found.high
        return figure(*bounds, scale=self.scale, decimals=decimals, mark=mark)


def _pooled_f1(name: str, prefix: str, heading: str) -> Metric:
    """The F1 of all samples together: PREFIX_right by PREFIX_size, which is half of predicted and
    expected items.
    """
    return Metric(name, "ratio", heading, over=(f"{prefix}_right", f"{prefix}_size"))


def _share(name: str, over: tuple[str, str], heading: str) -> Metric:
    return Metric(name, "ratio", heading, over=over)


CATALOGUE = (
    Metric("f1", "mean", "F1"),
    Metric("hallucination", "rate", "Hallucination (%)", "↓"),
    Metric("hallucination_with_unparsed", "rate", "Hallucination, unparsed counted (%)", "↓"),
    Metric(
        "hallucination_without_unparsed", "rate", "Hallucination, unparsed not counted (%)", "↓"
    ),
    Metric("parsed", "rate", "Parses (%)"),
    Metric("schema_valid", "rate", "Schema valid (%)"),
    Metric("strict_valid", "rate", "Strictly valid (%)"),
    Metric("precision", "mean", "Set precision"),
    Metric("recall", "mean", "Set recall"),
    Metric("multiset_f1", "mean", "Multiset F1"),
    Metric("multiset_precision", "mean", "Multiset precision"),
    Metric("multiset_recall", "mean", "Multiset recall"),
    _pooled_f1("navigation_f1", "navigation", "Navigation F1"),
    _pooled_f1("filter_f1", "filter", "Filter F1"),
    _pooled_f1("perception_f1", "perception", "Perception F1"),
    Metric("exact_sequence", "rate", "Exact sequence (%)"),
    Metric("edit_distance", "mean", "Edit distance", "↓"),
    Metric("step_edit_distance", "mean", "Edit distance, steps", "↓"),
    Metric("lcs_f1", "mean", "Common subsequence F1"),
    Metric("edge_f1", "mean", "Edge F1"),
    _share("parameters", ("parameters_right", "parameters_matched"), "Parameters right (%)"),
    _pooled_f1("parameter_keys_f1", "parameter_keys", "Keys F1"),
    _pooled_f1("parameter_values_f1", "parameter_values", "Values F1"),
    _pooled_f1("parameter_keys_overall_f1", "parameter_keys_overall", "Keys F1, whole plan"),
    _pooled_f1("parameter_values_overall_f1", "parameter_values_overall", "Values F1, whole plan"),
    Metric("whole_plan", "rate", "Whole plan right (%)"),
    Metric("whole_plan_unordered", "rate", "Whole plan right in any order (%)"),
    Metric("executable", "rate", "Runs to the end (%)"),
    Metric("grounded", "rate", "Answers without a value that nobody gave (%)"),
    _share(
        "grounded_values", ("values_grounded", "values_judged"), "Values that somebody gave (%)"
    ),
    _share(
        "slots_in_parameters",
        ("slots_in_parameters_right", "slots_stated"),
        "Stated facts in the right parameter (%)",
    ),
    _share(
        "slots_in_prompt",
        ("slots_in_prompt_right", "slots_prompted"),
        "Stated facts in the task prompt (%)",
    ),
    Metric("right_refusal", "rate", "Impossible commands refused (%)"),
    Metric("wrong_refusal", "rate", "Possible commands refused (%)", "↓"),
    Metric("latency_s", "mean", "Latency (s)", "↓", fraction=False),
    Metric("tokens", "mean", "Tokens", "", fraction=False),
    Metric("forward_passes", "mean", "Forward passes", "↓", fraction=False),
)
WORST_CASES = {
    Metric("worst_f1", "mean", "F1, worst of a family"): "f1",
    Metric("paraphrases_right", "rate", "Families all right (%)"): "whole_plan",
}
"""Metrics of phrasing families with at least two samples, with the metric of samples that each is
made of: the mean over families of the smallest F1, and the share of families all of whose samples
are right.
"""
METRIC = {metric.name: metric for metric in (*CATALOGUE, *WORST_CASES)}
METRICS = tuple(METRIC)
"""Names of the metrics in results.json and in gate files."""

MAIN = ("f1", "hallucination", "schema_valid", "strict_valid", "latency_s", "tokens")
"""The published figures, and strict validity."""
RIGHT = ("exact_sequence", "parameters", "whole_plan", "parsed", "forward_passes")
"""Beside the published figures: whether plans are right."""
SECTIONS: tuple[tuple[str, tuple[str, ...]], ...] = (
    ("Hallucination", ("hallucination_with_unparsed", "hallucination_without_unparsed")),
    ("Names", ("precision", "recall", "multiset_f1", "multiset_precision", "multiset_recall")),
    ("Names by role", ("navigation_f1", "filter_f1", "perception_f1")),
    ("Order", ("edit_distance", "step_edit_distance", "lcs_f1", "edge_f1", "whole_plan_unordered")),
    (
        "Parameters of matched entries",
        (
            *("parameter_keys_f1", "parameter_values_f1"),
            *("parameter_keys_overall_f1", "parameter_values_overall_f1"),
        ),
    ),
    (
        "Facts of the command",
        ("slots_in_parameters", "slots_in_prompt", "grounded", "grounded_values"),
    ),
    (
        "Logic of the plan",
        ("executable", "right_refusal", "wrong_refusal", "worst_f1", "paraphrases_right"),
    ),
)
"""Tables with a line per system. A column that no system has a figure for is left out."""
