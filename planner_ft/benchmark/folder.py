"""The folder of a run: its files, refusing to overwrite them, writing and reading results."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from planner_ft.benchmark.results import Results
from planner_ft.benchmark.tables import render_tables
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import (
    iterate_jsonl,
    make_folder,
    read_json,
    write_json,
    write_jsonl,
    write_text,
)
from planner_ft.vocabulary.plans import check_level

RESULTS, SCORES, BASELINES = "results.json", "scores.jsonl", "baselines.jsonl"
PREDICTIONS, LATENCY, PLANNING = "predictions.jsonl", "latency.jsonl", "planning.jsonl"
RUN, REPORT = "run.json", "report.html"
TABLES = ("table.md", "table.csv", "table.tex")
SCORED = (RESULTS, SCORES, BASELINES, *TABLES)
ALL = (*SCORED, PREDICTIONS, LATENCY, PLANNING, RUN)


def check_folder(folder: Path, names: Sequence[str], hint: str) -> None:
    """Make the folder if need be. Raises PlannerError when it holds any of these files, cannot be
    written, or is a file.
    """
    present = [name for name in names if (folder / name).exists()]
    if present:
        raise PlannerError(f"{folder / present[0]}: results are there already; {hint}")
    make_folder(folder)


def clear(folder: Path, names: Sequence[str] = ALL) -> None:
    """Remove a former run's files; others in the folder stay."""
    for name in names:
        with contextlib.suppress(FileNotFoundError):
            (folder / name).unlink()


def write_results(folder: Path, results: Results, more: dict[str, Any] | None = None) -> None:
    """Write results.json (with `more` first), scores.jsonl and the tables; results.json last, so
    that it is there only when all is.
    """
    # A report of earlier results would be taken for one of these.
    (folder / REPORT).unlink(missing_ok=True)
    write_jsonl(folder / SCORES, results.scores)
    write_jsonl(folder / BASELINES, results.baseline_scores)
    for name, text in render_tables(results).items():
        write_text(folder / name, text)
    write_json(folder / RESULTS, (more or {}) | results.to_json())


def read_results(folder: Path) -> tuple[Results, dict[str, Any]]:
    """The results of a run with its scores, where they are there, and results.json as it is. Raises
    PlannerError for a folder without results and for damaged files.
    """
    path = folder / RESULTS
    if not path.is_file():
        written = "`plannerft bench` or `plannerft score --out` has written to its end"
        raise PlannerError(f"{folder}: no {RESULTS}; give a folder that {written}")
    record = read_json(path)
    kinds = {"level": str, "data": dict, "rows": list}
    if not isinstance(record, dict) or not all(
        isinstance(record.get(key), kind) for key, kind in kinds.items()
    ):
        expected = "level, data and rows are expected"
        raise PlannerError(f"{path}: is no result of `plannerft bench` ({expected})")
    check_level(record["level"])
    lines = [list(_scores(folder / name)) for name in (SCORES, BASELINES)]
    return Results.from_json(record, *lines), record


def _scores(path: Path) -> Iterator[dict[str, Any]]:
    seen: set[tuple[Any, ...]] = set()
    for number, line, problem in iterate_jsonl(path) if path.is_file() else ():
        if not problem and not (isinstance(line, dict) and isinstance(line.get("id"), str)):
            problem = "no score of a sample (id is expected)"
        if not problem and line is not None:
            key = line.get("candidate"), line.get("configuration"), line["id"], line.get("repeat")
            if key in seen:
                problem = f"{key[0]} {key[1]} has a score of {line['id']!r} already"
            seen.add(key)
        if problem or line is None:
            way = "score the run again with `plannerft score --run`"
            raise PlannerError(f"{path}:{number}: {problem}; {way}")
        yield line
