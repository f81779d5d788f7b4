"""The tables of a suite: an overview of all data sets, and what could not be measured."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from planner_ft.benchmark import folder
from planner_ft.benchmark.catalogue import METRIC, METRICS
from planner_ft.benchmark.definitions import Part
from planner_ft.benchmark.layout import lines
from planner_ft.benchmark.results import Results, heading
from planner_ft.support.files import read_text, write_json, write_text
from planner_ft.support.tables import Table, TableRow, csv_text, latex_table, markdown_table, row

FIGURES = ("f1", "whole_plan", "latency_s")  # the metrics of the overview
GROUPS = {False: "Published-size splits", True: "Reported apart: data beyond the published size"}
HOW = (
    "In brackets 95 % intervals. Every metric, published figures and notes: table.md in the"
    " folder of each data set."
)


@dataclass(frozen=True)
class PartResults:
    """One data set of a suite with everything that was measured on it; `results` may have no rows.
    `failed` are candidates in configurations that could not be measured: candidate, label,
    configuration, reason.
    """

    part: Part
    results: Results
    failed: tuple[dict[str, str], ...]

    def to_json(self) -> dict[str, Any]:
        named = {"name": self.part.name, "apart": self.part.apart, "level": self.results.level}
        rows = [one.to_json() for one in self.results.rows]
        return {**named, "data": self.results.data, "rows": rows, "failed": list(self.failed)}


def write_suite(
    out: Path, title: str, parts: Sequence[PartResults], manifest: dict[str, Any]
) -> None:
    """Write PART/ and the overview into `out`, results.json last: then all is there."""
    for one in parts:
        where = out / one.part.name
        where.mkdir(parents=True, exist_ok=True)
        folder.write_results(where, one.results, one.to_json())
        for name in folder.TABLES:
            shown = read_text(where / name) if one.results.rows else ""
            write_text(where / name, shown + _not_measured(name, one))
    ordered = sorted(parts, key=lambda one: one.part.apart)
    table, failed = _overview(ordered), _failed(ordered)
    texts = [f"# {title}\n", markdown_table(table)]
    texts += ["## Not measured\n", markdown_table(failed)] if failed.rows else []
    write_text(out / "table.md", "\n".join([*texts, HOW]) + "\n")
    write_text(out / "table.csv", csv_text(_csv(parts)))
    absent = "".join(_not_measured("table.tex", one) for one in ordered)
    write_text(out / "table.tex", latex_table(table) + absent)
    overview = {"title": title, "parts": [one.to_json() for one in parts], "manifest": manifest}
    write_json(out / folder.RESULTS, overview)


def _overview(parts: Sequence[PartResults]) -> Table:
    """F1, whole plans and latency of everything in one table, a section per data set."""
    rows: list[TableRow] = []
    for one in parts:
        named = f"{one.part.name}: {one.results.level} level, n = {one.results.data['n']}"
        rows.append(row(f"{named} ({GROUPS[one.part.apart]})", kind="section"))
        for found in lines(one.results, beside=False):
            cells = [replace(cell, mark="") for cell in found.cells(FIGURES)]
            rows.append(row(found.system.label, found.configuration, *cells, kind=found.kind))
        for entry in one.failed:
            cells_of = ("not measured", *[""] * (len(FIGURES) - 1))
            rows.append(row(entry["label"], heading(entry["configuration"]), *cells_of))
    heads = ("Configuration", *(METRIC[name].title for name in FIGURES))
    return Table("Model", heads, rows, texts=1)


def _failed(parts: Sequence[PartResults]) -> Table:
    rows = [
        row(one.part.name, entry["label"], heading(entry["configuration"]), entry["reason"])
        for one in parts
        for entry in one.failed
    ]
    return Table("Data", ("Model", "Configuration", "Why"), rows, texts=3)


def _not_measured(name: str, one: PartResults) -> str:
    """The lines of a table of one data set about the systems that it lacks."""
    if not one.failed:
        return ""
    if name == "table.md":
        return f"\nNot measured:\n\n{markdown_table(_failed([one]))}"
    rows = [[cell.plain() for cell in line.cells] for line in _failed([one]).rows]
    if name == "table.tex":
        return "".join(f"% not measured: {label}, {name}: {why}\n" for label, name, why in rows)
    n = one.results.data["n"]
    return csv_text([(label, f"not measured: {why}", name, n) for label, name, why in rows])


def _csv(parts: Sequence[PartResults]) -> Iterator[list[Any]]:
    """A line per data set, candidate and configuration with every metric, or why it failed."""
    heads = ["data", "level", "apart", "n", "model", "candidate", "configuration", "status"]
    figures = [f"{name}{end}" for name in METRICS for end in ("", "_low", "_high")]
    yield [*heads, "reason", *figures]
    for one in parts:
        common = [one.part.name, one.results.level, int(one.part.apart), one.results.data["n"]]
        for found in (*one.results.rows, *one.results.baselines):
            system = found.system
            status = "baseline" if system.is_baseline else "measured"
            bounds = [one for name in METRICS for one in found.figure(name).to_json().values()]
            values = [None if bound is None else f"{bound:.6g}" for bound in bounds]
            yield [
                *common,
                system.label,
                system.candidate,
                system.configuration,
                status,
                None,
                *values,
            ]
        for entry in one.failed:
            named = [entry[key] for key in ("label", "candidate", "configuration")]
            yield [*common, *named, "failed", entry["reason"], *[None] * len(figures)]
