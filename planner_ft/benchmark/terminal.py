"""The tables in a terminal of 80 columns."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

from rich.console import Console
from rich.text import Text

from planner_ft.benchmark import published
from planner_ft.benchmark.catalogue import MAIN, METRIC, RIGHT
from planner_ft.benchmark.layout import known_metrics, lines, notes, trained_on
from planner_ft.benchmark.results import Results, Row
from planner_ft.support.tables import Cell, Table, TableRow, row, terminal_table


def print_results(results: Results, console: Console) -> None:
    """Print the figures in the order of the published table, whether plans are right, the published
    figures, and notes.
    """
    console.print(Text(f"{results.level} level, n = {results.data['n']}", style="bold"))
    found = lines(results)
    ours = [line for line in found if line.kind != "published"]
    theirs = [line for line in found if line.kind == "published"]
    console.print(_narrow(MAIN, ours))
    console.print(_narrow(RIGHT, ours))
    if theirs:
        source = published.source(results.level)
        console.print(Text(f"published, not measured here: {source}", style="bold dim"))
        console.print(_narrow(MAIN, theirs))
    for note in notes(results):
        console.print(Text(note, style="dim"))


def _narrow(names: Iterable[str], shown: Sequence[Row]) -> Any:
    """A line per configuration below its model, intervals without decimals, for 80 columns."""
    metrics = [METRIC[name] for name in known_metrics(names, shown)]
    rows: list[TableRow] = []
    for line in shown:
        label = line.system.label
        if line.kind != "baseline":
            if label not in [one.heading for one in rows]:
                rows.append(row(label, kind="section"))
            label = f"  {line.configuration}"
        cells = zip(metrics, line.cells(one.name for one in metrics), strict=True)
        short = [_short(cell, one.decimals if one.scale == 1 else 0) for one, cell in cells]
        rows.append(row(label, *short, kind=line.kind))
    heads = tuple(one.short or one.title for one in metrics)
    return terminal_table(Table("terminal", "", "", "model", heads, tuple(rows)))


def _short(cell: Cell, decimals: int) -> Cell:
    if not cell.interval or cell.bounds is None:
        return cell
    low, high = (f"{bound or 0:.{decimals}f}" for bound in cell.bounds[1:])
    return Cell(cell.text, f"{low}–{high}", cell.mark)


def print_warnings(results: Results, console: Console) -> None:
    """Name the samples without a prediction, and adapters that were trained on the samples."""
    for one in results.rows:
        if one.system.seen:
            console.print(Text(f"warning: {trained_on(one)}"), soft_wrap=True)
        if one.missing:
            missing = f"no prediction for {', '.join(one.missing)}; counted as empty outputs"
            console.print(Text(f"{one.name}: {missing}"), soft_wrap=True)
