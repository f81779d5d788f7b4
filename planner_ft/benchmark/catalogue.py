"""Every metric of results.json, and how it is summed up from the values of samples (keys of scores.jsonl)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

Kind = Literal["rate", "mean", "ratio"]


@dataclass(frozen=True)
class Metric:
    """A metric over samples; samples whose value is None say nothing about it and are left out.

    rate: share of samples whose value is true. mean: mean of the values. ratio: sum of the values under `over`[0] by the sum of those
    under `over`[1]. Rates and means have their value in scores.jsonl under their own name.
    """

    name: str
    kind: Kind
    over: tuple[str, str] = ("", "")


CATALOGUE = (
    Metric("f1", "mean"),
    Metric("hallucination", "rate"),
    Metric("hallucination_with_unparsed", "rate"),
    Metric("hallucination_without_unparsed", "rate"),
    Metric("parsed", "rate"),
    Metric("schema_valid", "rate"),
    Metric("strict_valid", "rate"),
    Metric("exact_sequence", "rate"),
    Metric("parameters", "ratio", ("parameters_right", "parameters_matched")),
    Metric("whole_plan", "rate"),
    Metric("latency_s", "mean"),
    Metric("tokens", "mean"),
    Metric("forward_passes", "mean"),
)
METRICS = tuple(metric.name for metric in CATALOGUE)
"""Names of the metrics in results.json and in gate files."""
