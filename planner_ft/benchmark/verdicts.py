"""What a comparison says in words and in a mark."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal

from planner_ft.benchmark.catalogue import CATALOGUE
from planner_ft.benchmark.paired import Paired, holm, is_real
from planner_ft.benchmark.statistics import Estimate

Verdict = Literal["better", "worse", "higher", "lower", "equal", "not told apart", "not compared"]

DEFAULT_METRICS = (
    "f1",
    "exact_sequence",
    "parameters",
    "whole_plan",
    "hallucination",
    "strict_valid",
)
"""What systems are compared by where nothing else is asked for."""
LOWER_IS_BETTER = frozenset(
    {
        "hallucination",
        "hallucination_with_unparsed",
        "hallucination_without_unparsed",
        "edit_distance",
        "step_edit_distance",
        "wrong_refusal",
        "latency_s",
        "forward_passes",
    }
)
NEITHER = frozenset({"tokens"})
UNBOUNDED = frozenset(metric.name for metric in CATALOGUE if not metric.fraction)
"""Metrics that are no share of anything."""
MARGIN = 0.05
"""Two systems whose difference is known to be smaller than this, at 95 %, are called equal."""
MARKS: dict[Verdict, str] = {
    "better": "▲",
    "higher": "▲",
    "worse": "▼",
    "lower": "▼",
    "equal": "≈",
    "not told apart": "·",
    "not compared": "",
}
EXPLAINED = (
    f"▲ better and ▼ worse beyond chance (p < 0.05 after Holm), ≈ equal within {MARGIN:g} (95 %"
    " interval), · not told apart"
)


@dataclass(frozen=True)
class Comparison:
    """`second` against `first` by one metric. `p_adjusted` is Holm's, over all comparisons of the
    same table.
    """

    first: str
    second: str
    paired: Paired
    p_adjusted: float | None

    @property
    def verdict(self) -> Verdict:
        """What is known of `second` against `first`."""
        return verdict(self.paired, self.p_adjusted)

    @property
    def mark(self) -> str:
        return MARKS[self.verdict]

    def to_json(self) -> dict[str, Any]:
        return {
            "first": self.first,
            "second": self.second,
            **self.renamed(),
            "p_adjusted": self.p_adjusted,
            "verdict": self.verdict,
        }

    def renamed(self) -> dict[str, Any]:
        """The figures, with names that do not clash with those of the systems."""
        values = self.paired.to_json()
        return {
            "metric": values.pop("metric"),
            "first_value": values.pop("first"),
            "second_value": values.pop("second"),
            **values,
        }


def verdict(paired: Paired, p_adjusted: float | None) -> Verdict:
    """A difference is real where p, adjusted for the table, is under 0.05; equal is what is known
    to differ by less than MARGIN.

    Everything else is not told apart: too few samples to say which of the two it is.
    """
    difference = paired.difference
    if difference.value is None or p_adjusted is None:
        return "not compared"
    if is_real(p_adjusted):
        up: Verdict = (
            "higher"
            if paired.metric in NEITHER
            else "worse"
            if paired.metric in LOWER_IS_BETTER
            else "better"
        )
        down: Verdict = (
            "lower"
            if paired.metric in NEITHER
            else "better"
            if paired.metric in LOWER_IS_BETTER
            else "worse"
        )
        return up if difference.value > 0 else down
    return (
        "equal"
        if paired.metric not in UNBOUNDED and _within(difference, MARGIN)
        else "not told apart"
    )


def _within(difference: Estimate, margin: float) -> bool:
    return (
        difference.low is not None
        and difference.high is not None
        and -margin <= difference.low
        and difference.high <= margin
    )


def adjusted(found: Sequence[tuple[str, str, Paired]]) -> list[Comparison]:
    """Comparisons (first, second, figures) of one table, their p-values adjusted together."""
    return [
        Comparison(first, second, one, p)
        for (first, second, one), p in zip(
            found, holm([one.p for _first, _second, one in found]), strict=True
        )
    ]


def p_text(p: float | None) -> str:
    """A p-value as tables show it."""
    return "–" if p is None else "< 0.001" if p < 0.001 else f"{p:.3f}"


def signed(estimate: Estimate, scale: int = 1, decimals: int = 3) -> str:
    """A difference with its sign and interval."""
    if estimate.value is None:
        return "–"
    text = f"{estimate.value * scale:+.{decimals}f}"
    if estimate.low is None or estimate.high is None:
        return text
    return f"{text} [{estimate.low * scale:+.{decimals}f}, {estimate.high * scale:+.{decimals}f}]"
