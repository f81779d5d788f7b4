"""How metrics are shown, and the tables of figures."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

from planner_ft.benchmark import published
from planner_ft.benchmark.catalogue import METRIC, RIGHT, SECTIONS, Metric
from planner_ft.benchmark.costs import QUANTILES
from planner_ft.benchmark.results import heading
from planner_ft.benchmark.statistics import Estimate
from planner_ft.report.charts import number
from planner_ft.report.runs import System, TestSet
from planner_ft.support.tables import NOTHING, Cell, Table, TableRow

MAIN = (
    "f1",
    "whole_plan",
    "exact_sequence",
    "parameters",
    "hallucination",
    "schema_valid",
    "strict_valid",
    "latency_s",
    "tokens",
)
"""The metrics of the first table: the published five, and those that show whether a plan is
right.
"""


def column(name: str) -> Metric:
    """How a metric is shown; one that the benchmark does not know by its name."""
    return METRIC.get(name) or Metric(name, "mean", name.replace("_", " ").capitalize(), "")


BESIDE = {"load_s": 1, "adapter_swap_s": 1000, "peak_memory_bytes": 2**-20}
"""Costs without an interval, with the factor to their unit in the table."""


def estimate(system: System, metric: str) -> Estimate:
    """A system's figure with its interval."""
    found = system.metric(metric)
    return Estimate(found.get("value"), found.get("low"), found.get("high"))


def main_table(tests: TestSet, marks: dict[tuple[str, str], str]) -> Table:
    """A row per system with the metrics that matter most, published rows beside. `marks` by
    (system, metric).
    """
    shown = [
        column(name)
        for name in MAIN
        if any(estimate(system, name).value is not None for system in tests.systems)
    ]
    rows = []
    theirs = published_rows(tests)
    for system in tests.systems:
        cells = tuple(
            figure_cell(one, estimate(system, one.name), marks.get((system.name, one.name), ""))
            for one in shown
        )
        rows.append(TableRow(system.name, cells, "baseline" if system.is_baseline else "measured"))
        key = (str(system.row.get("published")), str(system.row.get("configuration")))
        if key in theirs:
            rows.append(_published(key, theirs.pop(key), shown))
    rows += [_published(key, figures, shown) for key, figures in theirs.items()]
    heads = tuple(one.title for one in shown)
    return Table(
        f"{tests.key}-main", "Systems", "In brackets 95 % intervals.", "System", heads, tuple(rows)
    )


def metric_tables(tests: TestSet) -> list[Table]:
    """Every metric of the runs, a row each, a column per system, in the sections of table.md."""
    sections = [("Whole plan", ("f1", *RIGHT)), *SECTIONS]
    named = {name for _title, of_section in sections for name in of_section}
    every = (name for system in tests.systems for name in system.row.get("metrics", {}))
    others = tuple(name for name in dict.fromkeys(every) if name not in named)
    parts = [*sections, ("Output and cost", others)]
    tables = [_metric_table(tests, title, of_section) for title, of_section in parts]
    return [table for table in tables if table.rows]


def _metric_table(tests: TestSet, title: str, shown: Iterable[str]) -> Table:
    rows = []
    for one in map(column, shown):
        cells = tuple(figure_cell(one, estimate(system, one.name)) for system in tests.systems)
        if any(cell.text != NOTHING for cell in cells):
            rows.append(TableRow(one.title, cells))
    name = f"{tests.key}-{title.lower().replace(' ', '-')}"
    return Table(
        name, title, "", "Metric", tuple(system.name for system in tests.systems), tuple(rows)
    )


def cost_table(tests: TestSet) -> Table | None:
    """Quantiles of latency, time to first token, throughput, loading and memory, as far as they
    were measured.
    """
    rows = []
    for system in tests.systems:
        costs = system.row.get("costs")
        if not isinstance(costs, dict) or not costs:
            continue
        latency = costs.get("latency_s") or {}
        figures = [latency.get(name) for name, _share in QUANTILES]
        figures += [costs.get("first_token_s"), costs.get("tokens_per_s")]
        for name, scale in BESIDE.items():
            value = costs.get(name)
            figures.append({"value": None if value is None else value * scale})
        cells = tuple(_cost(figure or {}) for figure in figures)
        rows.append(TableRow(system.name, cells))
    if not rows:
        return None
    heads = (
        *(f"Latency {name} (s)" for name, _share in QUANTILES),
        *("First token (s)", "Tokens/s", "Load (s)", "Adapter switch (ms)", "Peak memory (MiB)"),
    )
    caption = (
        "One query at a time after a warm-up. In brackets 95 % intervals; – where too few queries"
        " were timed to know a bound."
    )
    return Table(f"{tests.key}-cost", "Cost", caption, "System", heads, tuple(rows))


def _cost(figure: dict[str, Any]) -> Cell:
    value, low, high = (figure.get(name) for name in ("value", "low", "high"))
    interval = "" if low is None and high is None else f"[{number(low)}, {number(high)}]"
    return Cell(number(value), interval, bounds=(value, low, high))


def group_table(tests: TestSet) -> Table | None:
    """F1 and whole plans right per group of the data; None where it has no groups."""
    entries = [
        entry
        for results in tests.results
        for entry in results.get("groups", [])
        if isinstance(entry, dict) and entry.get("group")
    ]
    if not entries:
        return None
    names = sorted({str(entry["group"]) for entry in entries})
    sizes = {str(entry["group"]): entry.get("n", 0) for entry in entries}
    cells = {
        (_owner(tests.systems, entry), str(entry["group"])): Cell(
            _share(entry.get("whole_plan")), heat=_heat(entry.get("whole_plan"))
        )
        for entry in entries
    }
    rows = tuple(
        TableRow(
            system.name,
            tuple(cells.get((system.name, name), Cell(NOTHING)) for name in names),
            "baseline" if system.is_baseline else "measured",
        )
        for system in tests.systems
    )
    caption = (
        "Whole plans right (%) by kind of difficulty. Groups are small: they tell where to look,"
        " not which system is better."
    )
    return Table(
        f"{tests.key}-groups",
        "By group",
        caption,
        "System",
        tuple(f"{name} (n = {sizes[name]})" for name in names),
        rows,
    )


def published_rows(tests: TestSet) -> dict[tuple[str, str], dict[str, float]]:
    """The published figures of this level by (model, configuration).

    None for another vehicle, for stand-ins alone, and beside other data than the level's test split
    (test.jsonl): they are of the published test set, and neither challenge commands nor unseen
    phrasings compare with it.
    """
    vehicle = (
        tests.results[0]
        .get("manifest", {})
        .get("configuration", {})
        .get("vocabulary", {})
        .get("name")
    )
    real = any(
        not system.row.get("is_standin") and not system.is_baseline for system in tests.systems
    )
    if vehicle != published.VOCABULARY or not real or Path(tests.path).stem != "test":
        return {}
    found: dict[tuple[str, str], dict[str, float]] = {}
    for row in published.published_rows(tests.level):
        for (metric, configuration), value in row.figures.items():
            found.setdefault((row.model, configuration), {})[metric] = value
    return found


def published_label(key: tuple[str, str]) -> str:
    """A published row's name."""
    return f"{key[0]}, {heading(key[1])} (published)"


def _published(
    key: tuple[str, str], figures: dict[str, float], shown: Iterable[Metric]
) -> TableRow:
    cells = [one.cell(Estimate(figures.get(one.name)), published=True) for one in shown]
    return TableRow(published_label(key), tuple(cells), "published")


def figure_cell(one: Metric, found: Estimate, mark: str = "") -> Cell:
    """A figure with its interval, in the unit of its column."""
    return one.cell(found, mark)


def _owner(systems: Sequence[System], entry: dict[str, Any]) -> str:
    wanted = (str(entry.get("candidate")), str(entry.get("configuration")))
    return next(
        (
            system.name
            for system in systems
            if (str(system.row.get("candidate")), str(system.row.get("configuration"))) == wanted
        ),
        "",
    )


def _share(value: float | None) -> str:
    return NOTHING if value is None else f"{100 * value:.0f}"


def _heat(value: float | None) -> int | None:
    return None if value is None else round(6 * value)
