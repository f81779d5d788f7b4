"""The files of a simulation: results, the table beside the published figures, picture, report."""

from __future__ import annotations

import csv
from collections import Counter
from dataclasses import asdict
from pathlib import Path
from typing import Any

from planner_ft.benchmark.statistics import Estimate
from planner_ft.simulation.measures import METRICS, RunResult, summary
from planner_ft.simulation.mission_report import report_texts
from planner_ft.simulation.picture import track_svg
from planner_ft.simulation.run import MANIFEST, RESULTS, Simulated
from planner_ft.support.files import write_json, write_text
from planner_ft.support.manifest import build_manifest
from planner_ft.support.tables import Cell, Table, csv_table, figure, markdown_table, row

PUBLISHED = Path(__file__).with_name("published.csv")
COLUMNS = {
    "success": ("success % ↑", 100, 1),
    "steps": ("steps", 1, 0),
    "seconds": ("seconds", 1, 1),
    "waypoint_error": ("waypoint m ↓", 1, 3),
    "holding_error": ("holding m ↓", 1, 3),
    "standoff_error": ("stand-off m ↓", 1, 3),
    "fence_violations": ("fences crossed ↓", 1, 2),
    "clearance_violations": ("stand-offs cut ↓", 1, 2),
    "energy": ("thrust kN s ↓", 1e-3, 2),
}
"""Columns by figure: heading, factor and decimals."""
CAPTION = (
    "Means over runs with 95 % intervals (success: Wilson; means: bootstrap over runs). Waypoint:"
    " distance at the end of a step that goes somewhere; holding: mean distance during a hold."
    " Published figures are quoted from the published study: its own simulator, structures and"
    " starts, so that steps and seconds depend on another distance."
)


def write_all(done: Simulated) -> None:
    """Write everything but the logs, which are there already."""
    folder = done.settings.folder
    made = table(done)
    picture = track_svg(done)
    write_text(folder / "table.md", markdown_table(made))
    write_text(folder / "table.csv", csv_table(made))
    write_text(folder / "tracks.svg", picture)
    for ending, text in report_texts(done, picture).items():
        write_text(folder / f"report.{ending}", text)
    write_json(folder / RESULTS, results_json(done))
    write_json(folder / MANIFEST, manifest(done))


def table(done: Simulated, *, narrow: bool = False) -> Table:
    """A row per figure: of this plan, and as published for the same command, or all missions where
    it is none of theirs (`narrow`: none then).
    """
    measured = summary(done.results, done.settings.seed)
    mark = "" if done.plan.approval else ", DRAFT - NOT APPROVED"
    quoted = _published(done, narrow)
    names = [
        f"{done.settings.simulator}{mark}",
        *(f"{one['mission']} (published)" for one in quoted),
    ]
    rows = [row("runs", str(len(done.results)), *(one["runs"] for one in quoted))]
    for name, (heading, *_form) in COLUMNS.items():
        cells = [cell(name, Estimate(number(one, name))) for one in quoted]
        rows.append(row(heading, cell(name, measured[name]), *cells))
    return Table("", names, rows, name="simulation", caption=CAPTION)


def outcome_lines(results: list[RunResult]) -> list[str]:
    """How many runs ended how, in words."""
    counts = Counter((one.outcome, one.reason) for one in results)
    return [
        f"{count} of {len(results)} runs: {outcome}{f' ({reason})' if reason else ''}"
        for (outcome, reason), count in counts.most_common()
    ]


def results_json(done: Simulated) -> dict[str, Any]:
    """The content of results.json."""
    overall = summary(done.results, done.settings.seed)
    return {
        "plan": done.plan.mark,
        "approved": done.plan.approval is not None,
        "command": done.plan.document["command"],
        "overall": {name: one.to_json() for name, one in overall.items()},
        "metrics": list(METRICS),
        "runs": [{**asdict(one), "success": one.success} for one in done.results],
    }


def manifest(done: Simulated) -> dict[str, Any]:
    """What the results depend on."""
    settings, vocabulary = done.settings, done.plan.vocabulary
    names = ("runs", "simulator", "tolerance", "draft", "mcap", "goto", "survey")
    configuration = {
        **{name: getattr(settings, name) for name in names},
        "starts": [list(start) for start in settings.starts],
        "locations": {name: list(place) for name, place in settings.locations.items()},
        "outlines": {name: one.tolist() for name, one in settings.outlines.items()},
        "faults": [fault.text for fault in settings.faults.all],
        "origin": asdict(done.plan.origin) if done.plan.origin else None,
        "vessel": asdict(done.scene.vessel),
        "step_seconds": done.scene.seconds,
        "vocabulary": vocabulary.named,
    }
    inputs: dict[str, Path | str] = {"plan": settings.plan}
    approval = done.plan.mark
    return build_manifest(
        "simulation",
        seed=settings.seed,
        configuration=configuration,
        inputs=inputs,
        approval=approval,
    )


def cell(name: str, value: Estimate) -> Cell:
    _heading, factor, decimals = COLUMNS[name]
    return figure(value.value, value.low, value.high, scale=factor, decimals=decimals)


def published_missions() -> list[dict[str, str]]:
    """The lines of published.csv."""
    with open(PUBLISHED, encoding="utf-8", newline="") as stream:
        return list(csv.DictReader(stream))


def _published(done: Simulated, narrow: bool) -> list[dict[str, str]]:
    """The published missions of this command, or all of them; none of another vehicle."""
    if done.plan.vocabulary.name != "usv":
        return []
    lines = published_missions()
    same = [line for line in lines if line["command"] == done.plan.document["command"].strip()]
    return same or ([] if narrow else lines)


def number(line: dict[str, str], name: str) -> float | None:
    """A published figure, a rate as a fraction; None where none was published."""
    text = line.get(name)
    return float(text) / (float(line["runs"]) if name == "success" else 1) if text else None
