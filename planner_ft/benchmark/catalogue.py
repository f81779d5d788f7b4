"""Every metric of results.json (catalogue.toml): how it is summed up and shown."""

import tomllib
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

from planner_ft.benchmark.statistics import Estimate
from planner_ft.support.tables import Cell

Kind = Literal["rate", "mean", "ratio"]


@dataclass(frozen=True)
class Metric:
    """A metric over samples; samples whose value is None say nothing about it and are left out.

    rate: share of samples whose value is true. mean: mean of the values. ratio: sum of the values
    under `over`[0] by the sum of those under `over`[1]; of a pooled F1 that is half of predicted
    and expected items. Rates and means have their value in scores.jsonl under their own name.
    `fraction` says whether it lies between 0 and 1, `better` which way is better: ↑, ↓ or neither.
    `worst` names the metric of samples that one of phrasing families is made of: the mean over
    families of the smallest value, or the share of families with no wrong one.
    """

    name: str
    kind: Kind
    heading: str = ""
    better: str = "↑"
    over: tuple[str, str] = ("", "")
    fraction: bool = True
    short: str = ""
    worst: str = ""

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

    def terms(self, score: Mapping[str, Any]) -> tuple[float, float] | None:
        """Numerator and denominator of a sample (a line of scores.jsonl); None: it says nothing."""
        top, below = self.over if self.kind == "ratio" else (self.name, "")
        if score.get(below or top) is None:
            return None
        return float(score[top] or 0), float(score[below]) if below else 1.0

    def value(self, scores: Iterable[Mapping[str, Any]]) -> float | None:
        """The metric over samples, each of which counts once; None where none says anything."""
        known = [terms for score in scores if (terms := self.terms(score))]
        above, below = (sum(column) for column in zip(*known, strict=True)) if known else (0, 0)
        return above / below if below else None

    def cell(self, found: Estimate, mark: str = "", *, published: bool = False) -> Cell:
        """A figure with its interval; published latencies have one decimal."""
        decimals = min(1, self.decimals) if published and not self.fraction else self.decimals
        return found.cell(scale=self.scale, decimals=decimals, mark=mark)


_RAW: dict[str, Any] = tomllib.loads(Path(__file__).with_name("catalogue.toml").read_text("utf-8"))
METRIC = {
    name: Metric(name, **values | {"over": tuple(values.get("over", Metric.over))})
    for name, values in {**_RAW["metrics"], **_RAW["families"]}.items()
}
CATALOGUE = tuple(metric for metric in METRIC.values() if not metric.worst)
"""Those that are not of phrasing families with at least two samples."""
METRICS = tuple(METRIC)  # names of the metrics in results.json and in gate files
MAIN: tuple[str, ...] = tuple(_RAW["first"]["main"])
RIGHT: tuple[str, ...] = tuple(_RAW["first"]["right"])
SECTIONS: dict[str, list[str]] = _RAW["sections"]  # names of metrics by the heading of their table
Columns = Sequence[Sequence[Any]]
"""Columns of figures: heading, place in a record (keys joined by dots), scale, decimals."""
COLUMNS: dict[str, Columns] = _RAW["columns"]  # columns of tables that are not of metrics, by table
