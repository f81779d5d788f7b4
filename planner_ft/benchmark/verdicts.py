"""The meaning of a comparison, in a word and in a mark."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any, Literal

from planner_ft.benchmark.catalogue import METRIC
from planner_ft.benchmark.paired import Paired, holm
from planner_ft.benchmark.statistics import Estimate
from planner_ft.support.tables import NOTHING, Cell, figure

Verdict = Literal["better", "worse", "higher", "lower", "equal", "not told apart", "not compared"]

DEFAULT_METRICS = (
    *("f1", "exact_sequence", "parameters", "whole_plan", "hallucination"),
    "strict_valid",
)
SIGNIFICANCE = 0.05
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
        return verdict(self.paired.metric, self.paired.difference, self.p_adjusted)

    @property
    def mark(self) -> str:
        return MARKS[self.verdict]

    def difference(self) -> Cell:
        """The difference with its interval and mark."""
        return difference_cell(self.paired.metric, self.paired.difference, self.mark)

    def to_json(self) -> dict[str, Any]:
        """As results.json and comparison.json have it."""
        values = asdict(self.paired)
        return {
            "first": self.first,
            "second": self.second,
            "metric": values.pop("metric"),
            "first_value": values.pop("first"),
            "second_value": values.pop("second"),
            **values,
            "p_adjusted": self.p_adjusted,
            "verdict": self.verdict,
        }

    @classmethod
    def from_json(cls, record: Mapping[str, Any]) -> Comparison:
        """A comparison as `to_json` wrote it."""
        values = {key: record[key] for key in ("metric", "n", "families", "p", "p_mcnemar")}
        ends = {"first": record["first_value"], "second": record["second_value"]}
        found = Paired(**values, **ends, difference=Estimate(**record["difference"]))
        return cls(record["first"], record["second"], found, record["p_adjusted"])


def verdict(name: str, difference: Estimate, p_adjusted: float | None) -> Verdict:
    """A difference is real where p, adjusted for the table, is under 0.05; equal is a difference
    that is known to be less than MARGIN. Everything else is not told apart.
    """
    metric = METRIC.get(name)
    if difference.value is None or p_adjusted is None:
        return "not compared"
    better = metric.better if metric else "↑"
    up = difference.value > 0
    if p_adjusted < SIGNIFICANCE:
        if not better:
            return "higher" if up else "lower"
        return "better" if up == (better == "↑") else "worse"
    low, high = difference.low, difference.high
    within = low is not None and high is not None and low >= -MARGIN and high <= MARGIN
    return "equal" if within and (metric is None or metric.fraction) else "not told apart"


def adjusted(found: Sequence[tuple[str, str, Paired]]) -> list[Comparison]:
    """Comparisons (first, second, figures) of one table, their p-values adjusted together."""
    ps = holm([one.p for _first, _second, one in found])
    return [Comparison(*one, p) for one, p in zip(found, ps, strict=True)]


def p_text(p: float | None) -> str:
    """A p-value as tables show it."""
    return NOTHING if p is None else "< 0.001" if p < 0.001 else f"{p:.3f}"


def difference_cell(name: str, found: Estimate, mark: str = "") -> Cell:
    """A difference with its sign, interval and mark, in the unit of its metric."""
    metric = METRIC[name]
    decimals = 3 if metric.scale == 1 and metric.fraction else metric.decimals
    bounds = found.value, found.low, found.high
    return figure(*bounds, scale=metric.scale, decimals=decimals, mark=mark, sign=True)
