"""Rows of the tables: measured, published (published/*.csv), baselines; notes; in a terminal."""

from __future__ import annotations

import functools
from collections.abc import Iterable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from planner_ft.benchmark.catalogue import MAIN, METRIC, METRICS, RIGHT
from planner_ft.benchmark.contrasts import contrast_notes, marks, sentences
from planner_ft.benchmark.results import Results, Row
from planner_ft.benchmark.statistics import Estimate
from planner_ft.support.files import read_csv
from planner_ft.support.tables import Cell, Table, TableRow, row, terminal_table
from planner_ft.vocabulary.plans import Level

if TYPE_CHECKING:
    from rich.console import Console

FOLDER = Path(__file__).parent / "published"
SAMPLES: dict[Level, int] = {"mission": 25, "task": 500}
CONFIGURATIONS = ("base", "lora")
VOCABULARY = "usv"  # the vocabulary that the published figures are about
PERCENT = ("hallucination", "schema_valid")


@functools.cache
def published_rows(level: Level) -> tuple[Row, ...]:
    """The published table of a level, each model in both configurations; rates are fractions."""
    rows, lines = [], read_csv(FOLDER / f"{level}.csv")
    for line, configuration in ((line, name) for line in lines for name in CONFIGURATIONS):
        model, metrics = line["model"], {}
        for column, text in line.items():
            metric, _, of = column.rpartition("_")
            if of == configuration:
                metrics[metric] = Estimate(float(text) / (100 if metric in PERCENT else 1))
        named = model, configuration, f"{model} (published)", model
        rows.append(Row(*named, n=SAMPLES[level], metrics=metrics, quoted=True))
    return tuple(rows)


def published_source(level: Level) -> str:
    """Where the published figures of a level come from."""
    own = f"its own {SAMPLES[level]} test samples, model weights and hardware"
    return f"published study ({level}-level table): {own}"


def lines(results: Results, *, beside: bool = True) -> list[Row]:
    """Measured rows with their marks, each candidate's followed by its published ones, then the
    baselines and the other published rows; `beside` says whether there shall be published ones.
    """
    known = marks(results.contrasts)
    theirs = _published(results) if beside else {}
    found: list[Row] = []
    for of_candidate in by_candidate(results.rows):
        for one in of_candidate:
            own = {metric: mark for (key, metric), mark in known.items() if key == one.key}
            found.append(replace(one, marks=own))
        first = of_candidate[0]
        found += theirs.pop(first.published or "", []) if not first.is_standin else []
    found += results.baselines
    return [*found, *(row for of_model in theirs.values() for row in of_model)]


def shows_published(results: Results) -> bool:
    """Whether published figures stand beside: for real candidates and the vehicle of the study."""
    vocabulary = results.manifest.get("configuration", {}).get("vocabulary", {}).get("name")
    return vocabulary == VOCABULARY and any(not one.is_standin for one in results.rows)


def _published(results: Results) -> dict[str, list[Row]]:
    """Published rows by model, in the configurations of the run if it has any of theirs."""
    if not shows_published(results):
        return {}
    ours = {one.configuration for one in results.rows}
    shown = ours & {*CONFIGURATIONS} or {*CONFIGURATIONS}
    return {
        rows[0].candidate: [one for one in rows if one.configuration in shown]
        for rows in by_candidate(published_rows(results.level))
    }


def by_candidate(rows: Iterable[Row]) -> list[list[Row]]:
    """Rows by candidate, in their order."""
    found: dict[str, list[Row]] = {}
    for one in rows:
        found.setdefault(one.candidate, []).append(one)
    return list(found.values())


def _known(names: Iterable[str], shown: Sequence[Row]) -> list[str]:
    """Those of the metrics that any line has a figure for."""
    return [name for name in names if any(one.figure(name).value is not None for one in shown)]


def metric_table(names: Iterable[str], shown: Sequence[Row], corner: str = "Model") -> Table:
    """A row per line with these metrics; a metric that no line has a figure for is left out."""
    known = _known(names, shown)
    heads = ("Configuration", "n", *(METRIC[one].title for one in known))
    return Table(corner, heads, _figures(shown, known), texts=1)


def figures_table(shown: Sequence[Row]) -> Table:
    """Every metric under its name in results.json, as table.csv has them."""
    return Table("model", ("configuration", "n", *METRICS), _figures(shown, METRICS), texts=1)


def _figures(shown: Sequence[Row], metrics: Sequence[str]) -> list[TableRow]:
    return [
        row(one.label, one.heading, str(one.n), *one.cells(metrics), kind=one.kind) for one in shown
    ]


def notes(results: Results) -> list[str]:
    """What a reader must know to read the tables rightly (templates/notes.txt.j2)."""
    about = {
        "results": results,
        "timed": max((one.latency_n for one in results.rows), default=0),
        "published": published_source(results.level) if shows_published(results) else "",
        "grounded": any(one.configuration.endswith("+grounded") for one in results.rows),
        "systems": {one.candidate: one for one in results.rows}.values(),
        "trained_on": trained_on,
    }
    of_data, of_rows = (sentences("notes", part=part, **about) for part in ("data", "rows"))
    compared = contrast_notes(results.contrasts, results.baseline_notes)
    return list(dict.fromkeys([*of_data, *compared, *of_rows]))


def trained_on(one: Row) -> str:
    """That an adapter was trained on samples that it is measured on."""
    seen = f"{one.seen} of {one.n} samples were in its adapter's training or validation data"
    return f"{one.name}: {seen}; its figures say nothing about other commands."


def print_results(results: Results, console: Console) -> None:
    """Print within 80 columns: the published metrics, right plans, published figures, notes."""
    console.print(f"{results.level} level, n = {results.data['n']}", style="bold")
    found = lines(results)
    ours = [line for line in found if line.kind != "published"]
    theirs = [line for line in found if line.kind == "published"]
    console.print(_narrow(MAIN, ours))
    console.print(_narrow(RIGHT, ours))
    if theirs:
        source = published_source(results.level)
        console.print(f"published, not measured here: {source}", style="bold dim")
        console.print(_narrow(MAIN, theirs))
    for note in notes(results):
        console.print(note, style="dim")


def _narrow(names: Iterable[str], shown: Sequence[Row]) -> Any:
    """A line per configuration below its model, intervals without decimals, for 80 columns."""
    metrics = [METRIC[name] for name in _known(names, shown)]
    rows: list[TableRow] = []
    for line in shown:
        label = line.label
        if line.kind != "baseline":
            if label not in [one.heading for one in rows]:
                rows.append(row(label, kind="section"))
            label = f"  {line.heading}"
        cells = zip(metrics, line.cells(one.name for one in metrics), strict=True)
        short = [_short(cell, one.decimals if one.scale == 1 else 0) for one, cell in cells]
        rows.append(row(label, *short, kind=line.kind))
    return terminal_table(Table("model", [one.short or one.title for one in metrics], rows))


def _short(cell: Cell, decimals: int) -> Cell:
    if not cell.interval or cell.bounds is None:
        return cell
    low, high = (f"{bound or 0:.{decimals}f}" for bound in cell.bounds[1:])
    return Cell(cell.text, f"{low}–{high}", cell.mark)


def print_warnings(results: Results, console: Console) -> None:
    """Name the samples without a prediction, and adapters that were trained on the samples."""
    for one in results.rows:
        if one.seen:
            console.print(f"warning: {trained_on(one)}", soft_wrap=True)
        if one.missing:
            missing = f"no prediction for {', '.join(one.missing)}; counted as empty outputs"
            console.print(f"{one.name}: {missing}", soft_wrap=True)
