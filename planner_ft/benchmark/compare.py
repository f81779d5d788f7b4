"""Comparing the rows of finished runs, paired by sample: `plannerft compare`."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from planner_ft.benchmark.catalogue import CATALOGUE, Metric
from planner_ft.benchmark.paired import paired
from planner_ft.benchmark.runs import Run, RunRow, load_run, named_apart
from planner_ft.benchmark.statistics import CONFIDENCE, RESAMPLES
from planner_ft.benchmark.verdicts import DEFAULT_METRICS, MARGIN, Comparison, adjusted
from planner_ft.support.errors import PlannerError

__all__ = ["DEFAULT_METRICS", "CompareSettings", "Report", "compare_runs"]

SHOWN = 5
"""Ids that a note names before it only counts the rest."""


@dataclass(frozen=True)
class CompareSettings:
    """`metrics` are names of results.json. `against` names the row that the others are compared
    with, None takes the first one; `same` compares each row with that of the same name in the first
    run instead. `common` allows different data files.
    """

    runs: tuple[Path, ...]
    metrics: tuple[str, ...] = DEFAULT_METRICS
    against: str | None = None
    same: bool = False
    common: bool = False
    seed: int = 0


@dataclass(frozen=True)
class Report:
    """All comparisons of one table, and what a reader must know."""

    settings: CompareSettings
    level: str
    data: tuple[dict[str, Any], ...]
    comparisons: tuple[Comparison, ...]
    notes: tuple[str, ...]

    def to_json(self) -> dict[str, Any]:
        settings = self.settings
        method = {
            "confidence": CONFIDENCE,
            "resamples": RESAMPLES,
            "seed": settings.seed,
            "adjustment": "holm",
            "margin": MARGIN,
        }
        return {
            "level": self.level,
            "runs": [
                {"path": str(path), "data": data}
                for path, data in zip(settings.runs, self.data, strict=True)
            ],
            "against": settings.against,
            "same": settings.same,
            "common": settings.common,
            "method": method,
            "comparisons": [comparison.to_json() for comparison in self.comparisons],
            "notes": list(self.notes),
        }


def compare_runs(settings: CompareSettings) -> Report:
    """Compare rows of runs. Raises PlannerError where they cannot be compared."""
    metrics = _metrics(settings.metrics)
    runs = [load_run(path) for path in dict.fromkeys(settings.runs)]
    _check_same(runs, common=settings.common)
    rows = named_apart(runs)
    pairs = _pairs(rows, runs[0], settings)
    found = []
    for first, second in pairs:
        if not first.scores.keys() & second.scores.keys():
            raise PlannerError(
                f"{first.name} and {second.name} have no sample in common; compare runs of the same"
                " data"
            )
        found += [
            (first.name, second.name, paired(metric, first.scores, second.scores, settings.seed))
            for metric in metrics
        ]
    data = tuple(load.data for path in settings.runs for load in runs if load.path == path)
    return Report(
        settings, runs[0].level, data, tuple(adjusted(found)), tuple(_notes(runs, pairs, metrics))
    )


def _metrics(names: Sequence[str]) -> list[Metric]:
    known = {metric.name: metric for metric in CATALOGUE}
    for name in names:
        if name not in known:
            raise PlannerError(f"--metric {name}: unknown; there are {', '.join(known)}")
    return [known[name] for name in dict.fromkeys(names)]


def _check_same(runs: Sequence[Run], *, common: bool) -> None:
    first = runs[0]
    for run in runs[1:]:
        if run.level != first.level:
            raise PlannerError(
                f"{first.path} is a run of the {first.level} level and {run.path} one of the"
                f" {run.level} level; compare runs of one level"
            )
        if run.data.get("sha256") != first.data.get("sha256") and not common:
            raise PlannerError(
                f"{first.path} was run on {first.data.get('path')} and {run.path} on"
                f" {run.data.get('path')}, which are not the same data; give --common to compare"
                " the samples whose ids are in both"
            )


def _pairs(
    rows: Sequence[RunRow], first_run: Run, settings: CompareSettings
) -> list[tuple[RunRow, RunRow]]:
    if settings.same:
        former = {row.system: row for row in rows if row.run == first_run.path}
        pairs = [
            (former[row.system], row)
            for row in rows
            if row.run != first_run.path and row.system in former and not row.is_baseline
        ]
        if not pairs:
            raise PlannerError(
                f"--same: no row of the other runs has the name of one in {first_run.path}"
                f" ({', '.join(former)}); leave out --same"
            )
        return pairs
    reference = rows[0] if settings.against is None else _named(rows, settings.against)
    pairs = [(reference, row) for row in rows if row is not reference]
    if not pairs:
        raise PlannerError(
            f"{first_run.path}: holds one row, {rows[0].name}; name a second run to compare it with"
        )
    return pairs


def _named(rows: Sequence[RunRow], text: str) -> RunRow:
    """The row of that name; a part of the name is enough where it fits one row alone."""
    names = ", ".join(row.name for row in rows)
    matching = [row for row in rows if row.name == text] or [
        row for row in rows if text in row.name
    ]
    if len(matching) != 1:
        raise PlannerError(
            f"--against {text}: {'is the name of several rows' if matching else 'is no row'}; there"
            f" are {names}"
        )
    return matching[0]


def _notes(
    runs: Sequence[Run], pairs: Sequence[tuple[RunRow, RunRow]], metrics: Sequence[Metric]
) -> list[str]:
    notes: list[str] = []
    if len({str(run.data.get("sha256")) for run in runs}) > 1:
        notes.append(
            "The runs used different data files; samples are paired by id, and nothing says that"
            " the same id is the same sample."
        )
    involved = {row.name: row for pair in pairs for row in pair}.values()
    notes += [
        f"{row.name}: no prediction for {_listed(row.missing)}, counted as empty outputs."
        for row in involved
        if row.missing
    ]
    for first, second in pairs:
        for one, other in ((first, second), (second, first)):
            if absent := [name for name in one.scores if name not in other.scores]:
                notes.append(f"{other.name} lacks {_listed(absent)} of {one.name}: left out.")
        for metric in metrics:
            key = metric.over[0] if metric.kind == "ratio" else metric.name
            if not all(
                any(
                    score.get(key) is not None for scores in row.scores.values() for score in scores
                )
                for row in (first, second)
            ):
                notes.append(
                    f"{metric.name} of {second.name} against {first.name} was not measured in both."
                )
    return list(dict.fromkeys(notes))


def _listed(names: Sequence[str]) -> str:
    shown = ", ".join(names[:SHOWN])
    return (
        f"{len(names)} sample{'s' if len(names) > 1 else ''}"
        f" ({shown}{', ...' if len(names) > SHOWN else ''})"
    )
