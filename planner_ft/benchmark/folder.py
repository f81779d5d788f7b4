"""The output folder of a run: its files, refusing to overwrite them, writing results."""

from __future__ import annotations

import contextlib
import os
from collections.abc import Sequence
from pathlib import Path

from planner_ft.benchmark.results import Results
from planner_ft.benchmark.tables import render_tables
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import write_json, write_jsonl, write_text

RESULTS, SCORES, BASELINES = "results.json", "scores.jsonl", "baselines.jsonl"
PREDICTIONS, LATENCY, PLANNING = "predictions.jsonl", "latency.jsonl", "planning.jsonl"
RUN, REPORT = "run.json", "report.html"
TABLES = ("table.md", "table.csv", "table.tex")
SCORED = (RESULTS, SCORES, BASELINES, *TABLES)
ALL = (*SCORED, PREDICTIONS, LATENCY, PLANNING, RUN)


def check_folder(folder: Path, names: Sequence[str], hint: str) -> None:
    """Raise PlannerError when the folder holds any of these files, cannot be written, or is a
    file.
    """
    present = [name for name in names if (folder / name).exists()]
    if present:
        raise PlannerError(f"{folder / present[0]}: results are there already; {hint}")
    check_writable(folder)


def check_writable(folder: Path) -> None:
    """Make the folder if need be. Raises PlannerError when that or writing into it fails."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except (FileExistsError, NotADirectoryError):
        raise PlannerError(f"--out {folder}: is or lies below a file; give a folder") from None
    except OSError as error:
        problem = f"cannot be made ({error.strerror}); give another folder"
        raise PlannerError(f"--out {folder}: {problem}") from None
    if not os.access(folder, os.W_OK | os.X_OK):
        raise PlannerError(f"--out {folder}: cannot be written; give another folder")


def clear(folder: Path, names: Sequence[str] = ALL) -> None:
    """Remove a former run's files; others in the folder stay."""
    for name in names:
        with contextlib.suppress(FileNotFoundError):
            (folder / name).unlink()


def write_results(folder: Path, results: Results) -> None:
    """Write results.json, scores.jsonl and the tables; results.json last, so that it is there only
    when all is.
    """
    # A report of earlier results would be taken for one of these.
    (folder / REPORT).unlink(missing_ok=True)
    write_jsonl(folder / SCORES, results.scores)
    write_jsonl(folder / BASELINES, results.baseline_scores)
    for name, text in render_tables(results).items():
        write_text(folder / name, text)
    write_json(folder / RESULTS, results.to_json())
