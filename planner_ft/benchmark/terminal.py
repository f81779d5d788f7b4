"""The tables in a terminal: a line per model and configuration, so that they fit 80 columns."""

from __future__ import annotations

from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.table import Table
from rich.text import Text

from planner_ft.benchmark.layout import (
    COLUMNS,
    MORE_COLUMNS,
    Column,
    TableRow,
    baseline_rows,
    heading,
    measured_rows,
    notes,
    system_name,
    table_rows,
)
from planner_ft.benchmark.published import CONFIGURATIONS, source
from planner_ft.benchmark.results import Results
from planner_ft.benchmark.statistics import Estimate

HEADINGS = {
    "f1": "F1 ↑",
    "hallucination": "halluc.\n% ↓",
    "schema_valid": "schema\nvalid % ↑",
    "strict_valid": "strictly\nvalid % ↑",
    "latency_s": "latency\ns ↓",
    "tokens": "tokens",
    "exact_sequence": "exact\nsequence % ↑",
    "parameters": "parameters\nright % ↑",
    "whole_plan": "whole plan\nright % ↑",
    "parsed": "parses\n% ↑",
}


def print_results(results: Results, console: Console) -> None:
    """Print the figures in the order of the published table, what that leaves out, the published
    figures, and notes.
    """
    console.print(Text(f"{results.level} level, n = {results.data['n']}", style="bold"))
    console.print(_measured(results, COLUMNS))
    console.print(
        _measured(results, tuple(column for column in MORE_COLUMNS if column.metric in HEADINGS))
    )
    theirs = [row for row in table_rows(results) if row.source == "published"]
    if theirs:
        console.print(
            Text(f"published, not measured here: {source(results.level)}", style="bold dim")
        )
        console.print(_published(theirs))
    for note in notes(results):
        console.print(Text(note, style="dim"))


def print_missing(results: Results, console: Console) -> None:
    """Name the samples without a prediction."""
    for row in results.rows:
        if row.missing:
            console.print(
                Text(
                    f"{system_name(row)}: no prediction for {', '.join(row.missing)}; counted as"
                    " empty outputs"
                ),
                soft_wrap=True,
            )


def _new_table(columns: tuple[Column, ...]) -> Table:
    table = Table(box=SIMPLE_HEAD, show_edge=False, pad_edge=False, padding=(0, 1, 0, 0))
    table.add_column("model", overflow="fold")
    for column in columns:
        table.add_column(HEADINGS[column.metric], justify="right", no_wrap=True)
    return table


def _measured(results: Results, columns: tuple[Column, ...]) -> Table:
    table = _new_table(columns)
    for row in measured_rows(results):
        table.add_row(Text(row.model, style="bold"))
        for name in dict.fromkeys(configuration for _metric, configuration in row.cells):
            table.add_row(
                f"  {heading(name)}",
                *(
                    _cell(
                        column,
                        row.cells.get((column.metric, name)),
                        row.marks.get((column.metric, name), ""),
                    )
                    for column in columns
                ),
            )
    for row in baseline_rows(results):
        name = next(configuration for _metric, configuration in row.cells)
        table.add_row(
            Text(row.model, style="italic"),
            *(_cell(column, row.cells.get((column.metric, name))) for column in columns),
        )
    return table


def _published(rows: list[TableRow]) -> Table:
    """Base and LoRA in one cell: these figures have no intervals."""
    columns = tuple(column for column in COLUMNS if (column.metric, "base") in rows[0].cells)
    table = _new_table(columns)
    table.columns[0].header = "Base/LoRA"
    for row in rows:
        pairs = [
            "/".join(
                column.text(row.cells[column.metric, name].value, source="published")
                for name in CONFIGURATIONS
            )
            for column in columns
        ]
        table.add_row(row.model.removesuffix(" (published)"), *pairs, style="dim")
    return table


def _cell(column: Column, estimate: Estimate | None, mark: str = "") -> Text:
    """The figure with its mark, and below it the interval, bounds in percent without decimals."""
    if estimate is None or estimate.value is None:
        return Text("–")
    if estimate.low is None or estimate.high is None:
        return Text(column.text(estimate.value) + mark)
    decimals = 0 if column.scale == 100 or column.metric == "tokens" else column.decimals
    low, high = (f"{bound * column.scale:.{decimals}f}" for bound in (estimate.low, estimate.high))
    return Text.assemble(column.text(estimate.value) + mark, "\n", (f"{low}–{high}", "dim"))
