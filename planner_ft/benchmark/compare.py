"""Comparing the rows of finished runs, paired by sample: `plannerft compare`."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from planner_ft.benchmark.catalogue import CATALOGUE, METRIC, Metric
from planner_ft.benchmark.contrasts import DEFAULTS, Scores, by_system, sentences
from planner_ft.benchmark.folder import SCORES, read_results
from planner_ft.benchmark.paired import EXPLAINED, MARGIN, Comparison, adjusted, p_text, paired
from planner_ft.benchmark.results import Results
from planner_ft.benchmark.statistics import CONFIDENCE, RESAMPLES
from planner_ft.support import tables as written
from planner_ft.support.errors import PlannerError
from planner_ft.support.tables import Cell, Table, TableRow, figure, row

if TYPE_CHECKING:
    from rich.console import Console

CSV = (
    *("first", "second", "metric", "n", "families", "first_value", "second_value", "difference"),
    *("low", "high", "p", "p_mcnemar", "p_adjusted", "verdict"),
)


@dataclass(frozen=True)
class RunRow:
    """One system of a run; `name` has the run before `system` where several runs have it."""

    name: str
    system: str
    run: Path
    scores: Scores
    missing: tuple[str, ...]
    is_baseline: bool

    def knows(self, metric: Metric) -> bool:
        """Whether any sample says something about the metric."""
        return any(metric.terms(score) for scores in self.scores.values() for score in scores)


@dataclass(frozen=True)
class Report:
    """All comparisons of one table, notes for the reader, and what it is made of: level, runs and
    arguments of `compare_runs`.
    """

    comparisons: tuple[Comparison, ...]
    notes: tuple[str, ...]
    seed: int
    made_of: dict[str, Any]

    def to_json(self) -> dict[str, Any]:
        method = {"confidence": CONFIDENCE, "resamples": RESAMPLES, "seed": self.seed}
        return {
            **self.made_of,
            "method": {**method, "adjustment": "holm", "margin": MARGIN},
            "comparisons": [comparison.to_json() for comparison in self.comparisons],
            "notes": list(self.notes),
        }


def compare_runs(
    folders: Sequence[Path],
    metrics: Sequence[str] | None = None,
    *,
    against: str | None = None,
    same: bool = False,
    common: bool = False,
    seed: int = 0,
) -> Report:
    """Compare rows of runs by metrics of results.json, else by DEFAULTS. `against` names the row
    that the others are compared with, None takes the first one; `same` compares each row with that
    of the same name in the first run instead. `common` allows different data files. Raises
    PlannerError where they cannot be compared.
    """
    metrics, known = metrics or DEFAULTS, [metric.name for metric in CATALOGUE]
    for name in (name for name in metrics if name not in known):
        raise PlannerError(f"--metric {name}: unknown; there are {', '.join(known)}")
    asked = [METRIC[name] for name in dict.fromkeys(metrics)]
    runs = {path: read_results(path)[0] for path in folders}
    _check_same(runs, common=common)
    rows = _named_apart([one for run in runs.items() for one in run_rows(*run)], list(runs))
    pairs = _same(rows, folders[0]) if same else _pairs(rows, folders[0], against)
    found = []
    for first, second in pairs:
        if not first.scores.keys() & second.scores.keys():
            way = "compare runs of the same data"
            raise PlannerError(f"{first.name} and {second.name} have no sample in common; {way}")
        for metric in asked:
            names = first.name, second.name
            found.append(paired(metric, first.scores, second.scores, seed, names))
    files = len({str(run.data.get("sha256")) for run in runs.values()})
    named = {one.name: one for pair in pairs for one in pair}
    about = {"rows": named.values(), "files": files, "pairs": pairs, "metrics": asked}
    lacks = sentences("comparison", part="lacks", **about)
    data = [{"path": str(path), "data": runs[path].data} for path in folders]
    how = {"against": against, "same": same, "common": common}
    made_of = {"level": runs[folders[0]].level, "runs": data, **how}
    return Report(tuple(adjusted(found)), tuple(lacks), seed, made_of)


def run_rows(path: Path, results: Results) -> list[RunRow]:
    """The rows of a run and its baselines. Raises PlannerError for one without scores."""
    scores, rows = by_system([*results.scores, *results.baseline_scores]), []
    for one in [*results.rows, *results.baselines]:
        key = one.candidate, one.configuration
        if key not in scores:
            way = f"score the run again with `plannerft score --run {path}`"
            raise PlannerError(f"{path / SCORES}: has no scores of {one.key}; {way}")
        name = one.candidate if one.is_baseline else one.key
        rows.append(RunRow(name, name, path, scores[key], one.missing, one.is_baseline))
    return rows


def _named_apart(rows: Sequence[RunRow], runs: Sequence[Path]) -> list[RunRow]:
    """The rows, with the name of the run before those that several runs have."""
    names, apart = [one.system for one in rows], []
    short = len({path.name for path in runs}) == len(runs)
    for one in rows:
        named = f"{one.run.name if short else one.run}: {one.system}"
        apart.append(replace(one, name=named) if names.count(one.system) > 1 else one)
    return apart


def _check_same(runs: dict[Path, Results], *, common: bool) -> None:
    (path, first), *others = runs.items()
    for other, run in others:
        if run.level != first.level:
            levels = f"{path} is a run of the {first.level} level and {other} one of the"
            raise PlannerError(f"{levels} {run.level} level; compare runs of one level")
        if run.data.get("sha256") != first.data.get("sha256") and not common:
            raise PlannerError(
                f"{path} was run on {first.data.get('path')} and {other} on"
                f" {run.data.get('path')}, which are not the same data; give --common to compare"
                " the samples whose ids are in both"
            )


def _same(rows: Sequence[RunRow], first: Path) -> list[tuple[RunRow, RunRow]]:
    """The rows of the other runs with those of the same name in the first one."""
    former = {one.system: one for one in rows if one.run == first}
    others = [one for one in rows if one.run != first and not one.is_baseline]
    pairs = [(former[one.system], one) for one in others if one.system in former]
    if not pairs:
        problem = f"no row of the other runs has the name of one in {first}"
        raise PlannerError(f"--same: {problem} ({', '.join(former)}); leave out --same")
    return pairs


def _pairs(rows: Sequence[RunRow], first: Path, name: str | None) -> list[tuple[RunRow, RunRow]]:
    """All rows with that of the name, of which a part is enough where it fits one row alone."""
    matching = [one for one in rows if one.name == name] if name is not None else [rows[0]]
    matching = matching or [one for one in rows if str(name) in one.name]
    if len(matching) != 1:
        problem = "is the name of several rows" if matching else "is no row"
        names = ", ".join(one.name for one in rows)
        raise PlannerError(f"--against {name}: {problem}; there are {names}")
    if len(rows) == 1:
        problem = f"holds one row, {rows[0].name}; name a second run to compare it with"
        raise PlannerError(f"{first}: {problem}")
    return [(matching[0], one) for one in rows if one is not matching[0]]


def render_report(report: Report) -> dict[str, str]:
    """Texts of comparison.md, comparison.csv (unrounded, rates as fractions), comparison.tex."""
    tables, below = _tables(report), notes(report)
    lines: list[list[Any]] = [list(CSV)]
    for values in (comparison.to_json() for comparison in report.comparisons):
        values |= values["difference"]
        lines.append([values["value" if name == "difference" else name] for name in CSV])
    rows = [one for table in tables for one in (row(table.title, kind="section"), *table.rows)]
    together = replace(tables[0], title="", rows=tuple(rows))
    texts = [*map(written.markdown_table, tables), *(f"- {note}" for note in below)]
    return {
        "comparison.md": "\n".join(texts) + "\n",
        "comparison.csv": written.csv_text(lines),
        "comparison.tex": written.latex_table(together) + "".join(f"% {one}\n" for one in below),
    }


def print_report(report: Report, console: Console) -> None:
    """Print a table per pair of rows, and notes; fits 80 columns."""
    for table in _tables(report, raw=False):
        console.print(table.title, style="bold")
        console.print(written.terminal_table(table))
    for note in notes(report):
        console.print(note, style="dim")


def notes(report: Report) -> list[str]:
    """What a reader must know to read the comparison rightly."""
    count = sum(comparison.p_adjusted is not None for comparison in report.comparisons)
    families = max((comparison.families for comparison in report.comparisons), default=0)
    how = {"count": count, "families": families, "seed": report.seed}
    return [*sentences("comparison", part="how", explained=EXPLAINED, **how), *report.notes]


def _tables(report: Report, *, raw: bool = True) -> list[Table]:
    """A table per pair of rows, a row per metric; `raw` shows p before its adjustment, too."""
    rows: dict[str, list[TableRow]] = {}
    for one in report.comparisons:
        metric = METRIC[one.metric]
        shown: list[Cell | str] = [
            figure(value, scale=metric.scale, decimals=metric.decimals)
            for value in (one.first_value, one.second_value)
        ]
        shown += [replace(one.cell(), mark=""), *([p_text(one.p)] if raw else [])]
        verdict = f"{one.mark} {one.verdict}".strip()
        of_pair = rows.setdefault(f"{one.second} against {one.first}", [])
        of_pair.append(row(metric.name, str(one.n), *shown, p_text(one.p_adjusted), verdict))
    heads = ("n", "against", "this", "difference", *(["p"] if raw else []), "p, Holm", "")
    return [Table("Metric", heads, of_pair, title=title) for title, of_pair in rows.items()]
