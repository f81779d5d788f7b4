"""How metrics are shown, and the tables of figures."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from planner_ft.benchmark import published
from planner_ft.benchmark.catalogue import METRIC, RIGHT, SECTIONS, Metric
from planner_ft.benchmark.costs import QUANTILES
from planner_ft.benchmark.results import heading
from planner_ft.benchmark.statistics import Estimate
from planner_ft.report.charts import number
from planner_ft.report.runs import System, TestSet, key_of, within
from planner_ft.support.tables import NOTHING, Cell, Table, TableRow

MAIN: tuple[str, ...] = ("f1", "whole_plan", "exact_sequence", "parameters", "hallucination")
MAIN += ("schema_valid", "strict_valid", "latency_s", "tokens")
"""The first table: the published five, and the metrics that show whether a plan is right."""
BESIDE = {"load_s": 1, "adapter_swap_s": 1000, "peak_memory_bytes": 2**-20}
"""Costs without an interval, with the factor to their unit in the table."""
COSTS = ("First token (s)", "Tokens/s", "Load (s)", "Adapter switch (ms)", "Peak memory (MiB)")


def column(name: str) -> Metric:
    """How a metric is shown; one that the benchmark does not know by its name."""
    return METRIC.get(name) or Metric(name, "mean", name.replace("_", " ").capitalize(), "")


def estimate(system: System, metric: str) -> Estimate:
    """A system's figure with its interval."""
    found = system.metric(metric)
    return Estimate(found.get("value"), found.get("low"), found.get("high"))


def main_columns(systems: Sequence[System]) -> list[Metric]:
    """The metrics of the first table that any of these systems has a figure for."""

    def known(name: str) -> bool:
        return any(estimate(system, name).value is not None for system in systems)

    return [column(name) for name in MAIN if known(name)]


def system_cells(
    system: System, shown: Sequence[Metric], marks: Mapping[tuple[str, str], str]
) -> tuple[Cell, ...]:
    """A system's figures; `marks` by (system, metric)."""
    found = [(one, marks.get((system.name, one.name), "")) for one in shown]
    return tuple(one.cell(estimate(system, one.name), mark) for one, mark in found)


def main_table(tests: TestSet, marks: dict[tuple[str, str], str]) -> Table:
    """A row per system, published rows beside; `marks` by (system, metric)."""
    shown, theirs = main_columns(tests.systems), published_rows(tests)
    rows = []
    for system in tests.systems:
        rows.append(TableRow(system.name, system_cells(system, shown, marks), system.kind))
        key = (str(system.row.get("published")), system.configuration)
        if key in theirs:
            rows.append(_published(key, theirs.pop(key), shown))
    rows += [_published(key, figures, shown) for key, figures in theirs.items()]
    heads, how = tuple(one.title for one in shown), "In brackets 95 % intervals."
    return Table(f"{tests.key}-main", "Systems", how, "System", heads, tuple(rows))


def metric_tables(tests: TestSet) -> list[Table]:
    """Every metric of the runs, a row each, a column per system, in the sections of table.md."""
    sections = [("Whole plan", ("f1", *RIGHT)), *SECTIONS]
    named = {name for _title, of_section in sections for name in of_section}
    every = (name for system in tests.systems for name in system.row.get("metrics", {}))
    others = tuple(name for name in dict.fromkeys(every) if name not in named)
    parts = [*sections, ("Output and cost", others)]
    tables = [_metric_table(tests, title, of_section) for title, of_section in parts]
    return [table for table in tables if table.rows]


def _metric_table(tests: TestSet, title: str, shown: Sequence[str]) -> Table:
    rows = []
    for one in map(column, shown):
        cells = tuple(one.cell(estimate(system, one.name)) for system in tests.systems)
        if any(cell.text != NOTHING for cell in cells):
            rows.append(TableRow(one.title, cells))
    name = f"{tests.key}-{title.lower().replace(' ', '-')}"
    return Table(name, title, "", "Metric", tuple(one.name for one in tests.systems), tuple(rows))


def cost_table(tests: TestSet) -> Table | None:
    """Quantiles of latency, throughput, loading and memory, as far as they were measured."""
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
        rows.append(TableRow(system.name, tuple(_cost(figure or {}) for figure in figures)))
    if not rows:
        return None
    heads = (*(f"Latency {name} (s)" for name, _share in QUANTILES), *COSTS)
    caption = "One query at a time after a warm-up. In brackets 95 % intervals; – where too few"
    caption += " queries were timed to know a bound."
    return Table(f"{tests.key}-cost", "Cost", caption, "System", heads, tuple(rows))


def _cost(figure: dict[str, Any]) -> Cell:
    value, low, high = (figure.get(name) for name in ("value", "low", "high"))
    interval = "" if low is None and high is None else f"[{number(low)}, {number(high)}]"
    return Cell(number(value), interval, bounds=(value, low, high))


def group_table(tests: TestSet) -> Table | None:
    """Whole plans right per group of the data; None where it has no groups."""
    entries = [entry for results in tests.results for entry in results.get("groups", [])]
    entries = [entry for entry in entries if isinstance(entry, dict) and entry.get("group")]
    if not entries:
        return None
    sizes = {str(entry["group"]): entry.get("n", 0) for entry in entries}
    names = sorted(sizes)
    owners = {key_of(system.row): system.name for system in reversed(tests.systems)}
    cells: dict[tuple[str, str], Cell] = {}
    for entry in entries:
        value = entry.get("whole_plan")
        shown = (
            Cell(NOTHING) if value is None else Cell(f"{100 * value:.0f}", heat=round(6 * value))
        )
        cells[owners.get(key_of(entry), ""), str(entry["group"])] = shown
    rows = []
    for system in tests.systems:
        of_system = tuple(cells.get((system.name, name), Cell(NOTHING)) for name in names)
        rows.append(TableRow(system.name, of_system, system.kind))
    caption = "Whole plans right (%) by kind of difficulty. Groups are small: they tell where to"
    caption += " look, not which system is better."
    heads = tuple(f"{name} (n = {sizes[name]})" for name in names)
    return Table(f"{tests.key}-groups", "By group", caption, "System", heads, tuple(rows))


def published_rows(tests: TestSet) -> dict[tuple[str, str], dict[str, float]]:
    """The published figures of this level by (model, configuration).

    None for another vehicle, for stand-ins alone, and beside other data than the level's test split
    (test.jsonl): they are of the published test set, and neither challenge commands nor unseen
    phrasings compare with it.
    """
    vehicle = within(tests.results[0], "manifest", "configuration", "vocabulary", "name")
    real = any(not system.row.get("is_standin") for system in tests.candidates)
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


def _published(key: tuple[str, str], figures: dict[str, float], shown: list[Metric]) -> TableRow:
    cells = [one.cell(Estimate(figures.get(one.name)), published=True) for one in shown]
    return TableRow(published_label(key), tuple(cells), "published")
