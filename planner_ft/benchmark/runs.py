"""Run folders as they lie on disk: the rows of results.json with the scores of their samples."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from planner_ft.benchmark.folder import BASELINES, RESULTS, SCORES
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import iterate_jsonl, read_json

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


def load_run(path: Path) -> Run:
    """Read a run folder. Raises PlannerError when it is none, or not complete."""
    if not (path / RESULTS).is_file():
        raise PlannerError(
            f"{path}: no {RESULTS}; give a folder that `plannerft bench` or `plannerft score --out`"
            " has written to its end"
        )
    results = read_json(path / RESULTS)
    if not isinstance(results, dict) or not all(
        isinstance(results.get(key), kind)
        for key, kind in (("level", str), ("data", dict), ("rows", list))
    ):
        raise PlannerError(
            f"{path / RESULTS}: is no result of `plannerft bench` (level, data and rows are"
            " expected)"
        )
    scores = _scores(path / SCORES)
    if (path / BASELINES).is_file():
        scores |= _scores(path / BASELINES)
    rows = [_row(path, row, scores) for row in [*results["rows"], *results.get("baselines", [])]]
    return Run(path, results["level"], results["data"], tuple(rows))


def _row(path: Path, row: dict[str, Any], scores: dict[tuple[str, str], Scores]) -> RunRow:
    key = str(row.get("candidate")), str(row.get("configuration"))
    if key not in scores:
        raise PlannerError(
            f"{path / SCORES}: has no scores of {key[0]} {key[1]}; score the run again with"
            f" `plannerft score --run {path}`"
        )
    baseline = row.get("is_baseline") is True
    name = key[0] if baseline else " ".join(key)
    return RunRow(name, name, path, scores[key], tuple(row.get("missing", ())), baseline)


def _scores(path: Path) -> dict[tuple[str, str], Scores]:
    found: dict[tuple[str, str], Scores] = {}
    seen: set[tuple[Any, ...]] = set()
    for number, line, problem in iterate_jsonl(path):
        if problem or not isinstance(line, dict) or not isinstance(line.get("id"), str):
            raise PlannerError(
                f"{path}:{number}: {problem or 'no score of a sample (id is expected)'}; score the"
                " run again with `plannerft score --run`"
            )
        key = (str(line.get("candidate")), str(line.get("configuration")))
        if (*key, line["id"], line.get("repeat")) in seen:
            raise PlannerError(
                f"{path}:{number}: {key[0]} {key[1]} has a score of {line['id']!r} already; score"
                " the run again with `plannerft score --run`"
            )
        seen.add((*key, line["id"], line.get("repeat")))
        found.setdefault(key, {}).setdefault(line["id"], []).append(line)
    return found


def named_apart(runs: Sequence[Run]) -> list[RunRow]:
    """The rows of all runs, with the name of the run before those that several runs have."""
    rows = [row for run in runs for row in run.rows]
    twice = {row.system for row in rows if sum(other.system == row.system for other in rows) > 1}
    short = len({run.path.name for run in runs}) == len(runs)
    return [
        (
            replace(row, name=f"{row.run.name if short else row.run}: {row.system}")
            if row.system in twice
            else row
        )
        for row in rows
    ]
