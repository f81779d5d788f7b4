"""Comparing the rows of finished runs, paired by sample: `plannerft compare`."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.text import Text

from planner_ft.benchmark.catalogue import CATALOGUE, METRIC, Metric
from planner_ft.benchmark.folder import BASELINES, RESULTS, SCORES
from planner_ft.benchmark.paired import paired
from planner_ft.benchmark.statistics import CONFIDENCE, RESAMPLES
from planner_ft.benchmark.verdicts import (
    DEFAULT_METRICS,
    EXPLAINED,
    MARGIN,
    Comparison,
    adjusted,
    p_text,
)
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import iterate_jsonl, read_json
from planner_ft.support.tables import (
    Cell,
    Table,
    TableRow,
    csv_text,
    figure,
    latex_table,
    markdown_table,
    row,
    terminal_table,
)

SHOWN = 5
"""Ids that a note names before it only counts the rest."""
__all__ = ["DEFAULT_METRICS", "CompareSettings", "compare_runs", "print_report", "render_report"]

CSV = (
    *("first", "second", "metric", "n", "families", "first_value", "second_value", "difference"),
    *("low", "high", "p", "p_mcnemar", "p_adjusted", "verdict"),
)
Scores = dict[str, list[dict[str, Any]]]
"""Lines of scores.jsonl by sample id; several where a sample was repeated."""


@dataclass(frozen=True)
class RunRow:
    """One system of a run. `name` is "candidate configuration", with the run before it where that
    is needed to tell rows apart.
    """

    name: str
    system: str
    run: Path
    scores: Scores
    missing: tuple[str, ...]
    is_baseline: bool


@dataclass(frozen=True)
class Run:
    """A folder of `bench` or `score`."""

    path: Path
    level: str
    data: dict[str, Any]
    rows: tuple[RunRow, ...]


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
    """All comparisons of one table, with notes for the reader."""

    settings: CompareSettings
    level: str
    data: tuple[dict[str, Any], ...]
    comparisons: tuple[Comparison, ...]
    notes: tuple[str, ...]

    def to_json(self) -> dict[str, Any]:
        settings = self.settings
        runs = zip(settings.runs, self.data, strict=True)
        return {
            "level": self.level,
            "runs": [{"path": str(path), "data": data} for path, data in runs],
            "against": settings.against,
            "same": settings.same,
            "common": settings.common,
            "method": {
                "confidence": CONFIDENCE,
                "resamples": RESAMPLES,
                "seed": settings.seed,
                "adjustment": "holm",
                "margin": MARGIN,
            },
            "comparisons": [comparison.to_json() for comparison in self.comparisons],
            "notes": list(self.notes),
        }


def compare_runs(settings: CompareSettings) -> Report:
    """Compare rows of runs. Raises PlannerError where they cannot be compared."""
    metrics = _metrics(settings.metrics)
    runs = {path: load_run(path) for path in settings.runs}
    _check_same(list(runs.values()), common=settings.common)
    first_run = runs[settings.runs[0]]
    pairs = _pairs(_named_apart(list(runs.values())), first_run, settings)
    found = []
    for first, second in pairs:
        if not first.scores.keys() & second.scores.keys():
            raise PlannerError(
                f"{first.name} and {second.name} have no sample in common; compare runs of the same"
                " data"
            )
        for metric in metrics:
            one = paired(metric, first.scores, second.scores, settings.seed)
            found.append((first.name, second.name, one))
    data = tuple(runs[path].data for path in settings.runs)
    said = tuple(_notes(list(runs.values()), pairs, metrics))
    return Report(settings, first_run.level, data, tuple(adjusted(found)), said)


def load_run(path: Path) -> Run:
    """Read a run folder. Raises PlannerError when it is none, or not complete."""
    if not (path / RESULTS).is_file():
        raise PlannerError(
            f"{path}: no {RESULTS}; give a folder that `plannerft bench` or `plannerft score --out`"
            " has written to its end"
        )
    results = read_json(path / RESULTS)
    kinds = {"level": str, "data": dict, "rows": list}
    if not isinstance(results, dict) or not all(
        isinstance(results.get(key), kind) for key, kind in kinds.items()
    ):
        raise PlannerError(
            f"{path / RESULTS}: is no result of `plannerft bench` (level, data and rows are"
            " expected)"
        )
    scores = _scores(path / SCORES)
    if (path / BASELINES).is_file():
        scores |= _scores(path / BASELINES)
    rows = []
    for one in [*results["rows"], *results.get("baselines", [])]:
        key = str(one.get("candidate")), str(one.get("configuration"))
        if key not in scores:
            raise PlannerError(
                f"{path / SCORES}: has no scores of {' '.join(key)}; score the run again with"
                f" `plannerft score --run {path}`"
            )
        baseline = one.get("is_baseline") is True
        name = key[0] if baseline else " ".join(key)
        rows.append(RunRow(name, name, path, scores[key], tuple(one.get("missing", ())), baseline))
    return Run(path, results["level"], results["data"], tuple(rows))


def _scores(path: Path) -> dict[tuple[str, str], Scores]:
    found: dict[tuple[str, str], Scores] = {}
    seen: set[tuple[Any, ...]] = set()
    for number, line, problem in iterate_jsonl(path):
        key = ("", "")
        if not problem and not (isinstance(line, dict) and isinstance(line.get("id"), str)):
            problem = "no score of a sample (id is expected)"
        elif isinstance(line, dict):
            key = str(line.get("candidate")), str(line.get("configuration"))
            if (*key, line["id"], line.get("repeat")) in seen:
                problem = f"{' '.join(key)} has a score of {line['id']!r} already"
        if problem or not isinstance(line, dict):
            raise PlannerError(
                f"{path}:{number}: {problem}; score the run again with `plannerft score --run`"
            )
        seen.add((*key, line["id"], line.get("repeat")))
        found.setdefault(key, {}).setdefault(line["id"], []).append(line)
    return found


def _named_apart(runs: Sequence[Run]) -> list[RunRow]:
    """The rows of all runs, with the name of the run before those that several runs have."""
    rows = [one for run in runs for one in run.rows]
    names = [one.system for one in rows]
    short = len({run.path.name for run in runs}) == len(runs)
    return [
        replace(one, name=f"{one.run.name if short else one.run}: {one.system}")
        if names.count(one.system) > 1
        else one
        for one in rows
    ]


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
        former = {one.system: one for one in rows if one.run == first_run.path}
        others = [one for one in rows if one.run != first_run.path and not one.is_baseline]
        pairs = [(former[one.system], one) for one in others if one.system in former]
        if not pairs:
            raise PlannerError(
                f"--same: no row of the other runs has the name of one in {first_run.path}"
                f" ({', '.join(former)}); leave out --same"
            )
        return pairs
    reference = rows[0] if settings.against is None else _named(rows, settings.against)
    if len(rows) == 1:
        raise PlannerError(
            f"{first_run.path}: holds one row, {rows[0].name}; name a second run to compare it with"
        )
    return [(reference, one) for one in rows if one is not reference]


def _named(rows: Sequence[RunRow], text: str) -> RunRow:
    """The row of that name; a part of the name is enough where it fits one row alone."""
    exact = [one for one in rows if one.name == text]
    matching = exact or [one for one in rows if text in one.name]
    if len(matching) != 1:
        problem = "is the name of several rows" if matching else "is no row"
        names = ", ".join(one.name for one in rows)
        raise PlannerError(f"--against {text}: {problem}; there are {names}")
    return matching[0]


def _notes(
    runs: Sequence[Run], pairs: Sequence[tuple[RunRow, RunRow]], metrics: Sequence[Metric]
) -> list[str]:
    found: list[str] = []
    if len({str(run.data.get("sha256")) for run in runs}) > 1:
        found.append(
            "The runs used different data files; samples are paired by id, and nothing says that"
            " the same id is the same sample."
        )
    for one in {one.name: one for pair in pairs for one in pair}.values():
        if one.missing:
            found.append(
                f"{one.name}: no prediction for {_listed(one.missing)}, counted as empty outputs."
            )
    for first, second in pairs:
        for one, other in ((first, second), (second, first)):
            if absent := [name for name in one.scores if name not in other.scores]:
                found.append(f"{other.name} lacks {_listed(absent)} of {one.name}: left out.")
        for metric in metrics:
            key = metric.over[0] or metric.name
            if not (_knows(first, key) and _knows(second, key)):
                found.append(
                    f"{metric.name} of {second.name} against {first.name} was not measured in both."
                )
    return list(dict.fromkeys(found))


def _knows(one: RunRow, key: str) -> bool:
    return any(score.get(key) is not None for scores in one.scores.values() for score in scores)


def _listed(names: Sequence[str]) -> str:
    shown = f"{', '.join(names[:SHOWN])}{', ...' if len(names) > SHOWN else ''}"
    return f"{len(names)} sample{'s' if len(names) > 1 else ''} ({shown})"


def render_report(report: Report) -> dict[str, str]:
    """The texts of comparison.md, comparison.csv (all figures unrounded, rates as fractions) and
    comparison.tex.
    """
    tables, below = _tables(report), notes(report)
    lines: list[list[Any]] = [list(CSV)]
    for comparison in report.comparisons:
        values = comparison.to_json()
        difference = values.pop("difference")
        values |= {"difference": difference.pop("value"), **difference}
        lines.append([values[name] for name in CSV])
    rows = [(row(table.title, kind="section"), *table.rows) for table in tables]
    together = replace(tables[0], title="", rows=tuple(one for of_pair in rows for one in of_pair))
    texts = [*map(markdown_table, tables), *(f"- {note}" for note in below)]
    return {
        "comparison.md": "\n".join(texts) + "\n",
        "comparison.csv": csv_text(lines),
        "comparison.tex": latex_table(together) + "".join(f"% {note}\n" for note in below),
    }


def print_report(report: Report, console: Console) -> None:
    """Print a table per pair of rows, and notes; fits 80 columns."""
    for table in _tables(report, raw=False):
        console.print(Text(table.title, style="bold"))
        console.print(terminal_table(table))
    for note in notes(report):
        console.print(Text(note, style="dim"))


def notes(report: Report) -> list[str]:
    """What a reader must know to read the comparison rightly."""
    count = sum(comparison.p_adjusted is not None for comparison in report.comparisons)
    families = max((comparison.paired.families for comparison in report.comparisons), default=0)
    return [
        f"Paired by sample, whole phrasing families kept together ({families} families at most)."
        f" {EXPLAINED}.",
        "Differences: this minus against, 95 % bootstrap intervals. p: families swapped at random"
        " (for rates of independent samples the exact McNemar test), adjusted for the"
        f" {count} comparisons of this table. Seed {report.settings.seed}.",
        *report.notes,
    ]


def _tables(report: Report, *, raw: bool = True) -> list[Table]:
    """A table per pair of rows, a row per metric; `raw` shows p before its adjustment, too."""
    rows: dict[str, list[TableRow]] = {}
    for one in report.comparisons:
        metric, found = METRIC[one.paired.metric], one.paired
        values = [
            figure(value, scale=metric.scale, decimals=metric.decimals)
            for value in (found.first, found.second)
        ]
        shown: list[Cell | str] = [*values, replace(one.difference(), mark="")]
        shown += [p_text(found.p)] if raw else []
        verdict = f"{one.mark} {one.verdict}".strip()
        of_pair = rows.setdefault(f"{one.second} against {one.first}", [])
        of_pair.append(row(metric.name, str(found.n), *shown, p_text(one.p_adjusted), verdict))
    heads = ("n", "against", "this", "difference", *(["p"] if raw else []), "p, Holm", "")
    return [
        Table("comparison", title, "", "Metric", heads, tuple(of_pair))
        for title, of_pair in rows.items()
    ]
