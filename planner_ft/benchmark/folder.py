"""The folder of a run: the files that it writes as it goes (logs of answers and timed queries, and
run.json), and results.

A run can end at any point and go on: logs are append-only and flushed line by line, and every line
carries the key of what it depends on (`plan.Job.key`). run.json says what the folder was made with,
so that it can be gone on with, refused, or scored again without any model.
"""

from __future__ import annotations

import contextlib
import itertools
import json
import os
from collections import defaultdict
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import IO, TYPE_CHECKING, Any

from planner_ft.benchmark.results import Measured, Results, System
from planner_ft.benchmark.tables import render_tables
from planner_ft.support import files
from planner_ft.support.errors import PlannerError
from planner_ft.support.terminal import Report
from planner_ft.vocabulary.plans import check_level

if TYPE_CHECKING:
    from planner_ft.benchmark.plan import Plan

RESULTS, SCORES, BASELINES = "results.json", "scores.jsonl", "baselines.jsonl"
PREDICTIONS, LATENCY, PLANNING = "predictions.jsonl", "latency.jsonl", "planning.jsonl"
PLANS = "plans.jsonl"
RUN, REPORT = "run.json", "report.html"
TABLES = ("table.md", "table.csv", "table.tex")
SCORED = (RESULTS, SCORES, BASELINES, *TABLES)
ALL = (*SCORED, PREDICTIONS, LATENCY, PLANNING, RUN)
OTHER = "give --overwrite to start anew, or another --out"
GO_ON = "give --resume to go on, --overwrite to start anew, or another --out"
Line = dict[str, Any]


def check_folder(
    folder: Path,
    names: Sequence[str],
    hint: str = GO_ON,
    *,
    resume: bool = False,
    overwrite: bool = False,
) -> None:
    """Make the folder. Raises PlannerError when it cannot be used, or holds any of these files and
    neither `resume` nor `overwrite` is given, or both are.
    """
    if resume and overwrite:
        both = "--resume keeps former results and --overwrite removes them"
        raise PlannerError(f"{both}: give one of them")
    present = [name for name in names if (folder / name).exists()]
    if present and not (resume or overwrite):
        raise PlannerError(f"{folder / present[0]}: results are there already; {hint}")
    files.make_folder(folder)


def clear(folder: Path, names: Sequence[str] = ALL) -> None:
    """Remove a former run's files; others in the folder stay."""
    for name in names:
        (folder / name).unlink(missing_ok=True)


class RecordLog(contextlib.AbstractContextManager["RecordLog"]):
    """An append-only JSONL file of records with `key` and `id`, which the processes of a run share.
    Opening drops a last line that a killed run left without its end, and reads the records. Raises
    PlannerError when a line is damaged, or the file cannot be written.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        with files.writing(path, "give another --out"):
            # Unbuffered: after a failed write nothing is left to be written again at closing.
            self.stream: IO[bytes] = open(path, "a+b", buffering=0)  # noqa: SIM115
        self.stream.seek(0)
        self.stream.truncate(self.stream.read().rfind(b"\n") + 1)
        self.stream.seek(0, os.SEEK_END)
        self.records = defaultdict[str, dict[str, Line]](dict)  # by key and id
        self.read()

    def read(self) -> None:
        """Read the records again, those of other processes, too."""
        way = "remove the line, or start with --overwrite"
        try:
            for record in _checked(self.path, _record_problem, way):
                self.records[record["key"]][record["id"]] = record
        except PlannerError:
            self.close()
            raise

    def of_key(self, key: str) -> dict[str, Line]:
        """The records of a key by sample id."""
        return self.records.get(key, {})

    def missing(self, key: str, names: Iterable[str]) -> list[str]:
        """Those of the sample ids that have no record of the key."""
        return [name for name in names if name not in self.of_key(key)]

    def fill(
        self, key: str, made: Iterable[Line], report: Report, label: str, left: int, total: int
    ) -> None:
        """Append records under the key as they are made: the `left` ones of `total` in all."""
        report(label, total - left, total)
        for done, record in enumerate(made, total - left + 1):
            self.append({**record, "key": key})
            report(label, done, total)

    def refuse_others(self, keys: Mapping[str, Collection[str]]) -> None:
        """Raise PlannerError for records of a system ("candidate configuration") with keys beside
        its own: they were made with something else.
        """
        for record in itertools.chain(*map(dict.values, self.records.values())):
            name = f"{record.get('candidate')} {record.get('configuration')}"
            if record["key"] not in keys.get(name, {record["key"]}):
                what = f"holds answers of {name} that are not of this run"
                raise PlannerError(f"{self.path}: {what}; {OTHER}")

    def append(self, record: Line) -> None:
        """Write a record as one line, whole, at the end of the file."""
        self.records[record["key"]][record["id"]] = record
        with files.writing(self.path, "free some space and run the command again with --resume"):
            line = f"{files.compact_json(record)}\n".encode()
            while line:
                line = line[self.stream.write(line) :]

    def close(self) -> None:
        self.stream.close()

    def __exit__(self, *_: object) -> None:
        self.close()


def kept(path: Path) -> str:
    """How many answers an interrupted run has left in its log."""
    count = path.read_bytes().count(b"\n") if path.is_file() else 0
    return f"{count} answers are kept in {path}"


def _record_problem(record: Any) -> str | None:
    known = _holds(record, key=str, id=str)
    return None if known else "no record of a run (key and id are expected)"


def _checked(path: Path, problem_of: Callable[[Any], str | None], way: str) -> Iterator[Line]:
    """The records of a file. Raises PlannerError with the way out for the first with a problem."""
    record: Any
    for number, record, problem in files.iterate_jsonl(path):
        if problem := problem or problem_of(record):
            raise PlannerError(f"{path}:{number}: {problem}; {way}")
        yield record


def records_by_key(path: Path) -> dict[str, dict[str, Line]]:
    """A file's records by key and id; lines that are none, or not finished, are passed over."""
    found: dict[str, dict[str, Line]] = {}
    text = path.read_bytes() if path.is_file() else b""
    for line in text[: text.rfind(b"\n") + 1].splitlines():
        with contextlib.suppress(ValueError):
            record = json.loads(line)
            if _record_problem(record) is None:
                found.setdefault(record["key"], {})[record["id"]] = record
    return found


def begin_run(plan: Plan, predictions: RecordLog) -> None:
    """Write run.json. Raises PlannerError when the folder holds a run of something else.

    `jobs` are the parts that answers depend on, `keys` their digests, `systems` those measured, all
    by job name; `costs` are a candidate's costs beside its queries; `settings` are level, data,
    limit, vocabulary and seed.
    """
    path, settings = plan.settings.folder / RUN, plan.settings
    before: dict[str, Any] = files.read_json(path) if path.is_file() else {}
    _check_jobs(plan, path, before.get("jobs", {}))
    keys: dict[str, set[str]] = {}
    for job in plan.jobs:
        keys.setdefault(job.system.key, set()).add(job.key)
    predictions.refuse_others(keys)
    own: dict[str, dict[str, Any]] = {
        "jobs": {job.name: job.parts for job in plan.jobs},
        "keys": {job.name: job.key for job in plan.jobs},
        "systems": {job.name: asdict(job.system) for job in plan.jobs},
        "costs": {},
    }
    named = {name: getattr(settings, name) for name in ("level", "limit", "vocabulary", "seed")}
    inputs = {**named, "data": str(plan.data.path), "data_sha256": plan.data.sha256}
    merged = {name: {**before.get(name, {}), **values} for name, values in own.items()}
    files.write_json(path, {"settings": inputs, **merged})


def _check_jobs(plan: Plan, path: Path, recorded: dict[str, dict[str, Any]]) -> None:
    """Jobs of one folder share level, data and vocabulary; a job is gone on with as it was."""
    same = {name: plan.jobs[0].parts[name] for name in ("level", "data", "vocabulary")}
    wanted = [(name, parts, same) for name, parts in recorded.items()]
    wanted += [(job.name, recorded.get(job.name, job.parts), job.parts) for job in plan.jobs]
    for name, before, now in wanted:
        if changed := [part for part in now if before.get(part) != now[part]]:
            what = " and another ".join(changed)
            raise PlannerError(f"{path}: {name} was begun with another {what}; {OTHER}")


def add_costs(folder: Path, candidate: str, costs: Mapping[str, Any]) -> None:
    """Record a candidate's costs; figures that are None leave those of an earlier session."""
    record = files.read_json(folder / RUN)
    known = {name: value for name, value in costs.items() if value is not None}
    record["costs"][candidate] = {**record["costs"].get(candidate, {}), **known}
    files.write_json(folder / RUN, record)


def read_run(folder: Path) -> Line:
    """Read run.json. Raises PlannerError when there is none, or an earlier version wrote less."""
    path = folder / RUN
    if not path.is_file():
        other = "for other predictions give --predictions FILE"
        raise PlannerError(f"{folder}: no {RUN}, so no run of `plannerft bench`; {other}")
    record = files.read_json(path)
    if not _holds(record, **dict.fromkeys(("jobs", "keys", "systems", "settings", "costs"), dict)):
        way = f"score its answers with --predictions {folder / PREDICTIONS}"
        raise PlannerError(f"{path}: does not say what was run; {way}")
    known: Line = record
    return known


def _holds(record: Any, **kinds: type) -> bool:
    """Whether a value is an object with these keys, and values of these types."""
    found = record if isinstance(record, dict) else {}
    return all(isinstance(found.get(name), kind) for name, kind in kinds.items())


def measured_in(folder: Path, run: Line, names: Iterable[str] | None = None) -> list[Measured]:
    """A run's systems, or those of these jobs, with all their lines, read without locking."""
    logs = [records_by_key(folder / name) for name in (PREDICTIONS, LATENCY)]
    planned, found = records_by_key(folder / PLANNING), []
    for name in run["systems"] if names is None else names:
        system = System(**run["systems"][name])
        costs = run["costs"].get(system.candidate, {})
        planning = costs.get("planning_keys", {}).get(system.configuration)
        answers, timed = (log.get(run["keys"][name], {}) for log in logs)
        found.append(Measured(system, answers, timed, costs, [*planned.get(planning, {}).values()]))
    return found


def write_results(folder: Path, results: Results, more: dict[str, Any] | None = None) -> None:
    """Write scores, tables and, last, results.json (`more` first): then all is there."""
    # A report of earlier results would be taken for one of these.
    (folder / REPORT).unlink(missing_ok=True)
    files.write_jsonl(folder / SCORES, results.scores)
    files.write_jsonl(folder / BASELINES, results.baseline_scores)
    for name, text in render_tables(results).items():
        files.write_text(folder / name, text)
    files.write_json(folder / RESULTS, (more or {}) | results.to_json())


def read_results(folder: Path) -> tuple[Results, dict[str, Any]]:
    """A run's results with scores, and results.json as it is. Raises PlannerError."""
    path = folder / RESULTS
    if not path.is_file():
        written = "`plannerft bench` or `plannerft score --out` has written to its end"
        raise PlannerError(f"{folder}: no {RESULTS}; give a folder that {written}")
    record = files.read_json(path)
    if not _holds(record, level=str, data=dict, rows=list):
        expected = "level, data and rows are expected"
        raise PlannerError(f"{path}: is no result of `plannerft bench` ({expected})")
    check_level(record["level"])
    lines = [_scores(folder / name) for name in (SCORES, BASELINES)]
    return Results.from_json(record, *lines), record


def _scores(path: Path) -> list[Line]:
    """The lines of a file of scores, none without it, each system and sample once."""
    seen: set[tuple[Any, ...]] = set()

    def problem_of(line: Any) -> str | None:
        if not _holds(line, id=str):
            return "no score of a sample (id is expected)"
        key = tuple(str(line.get(one)) for one in ("candidate", "configuration", "id", "repeat"))
        if key in seen:
            return f"{key[0]} {key[1]} has a score of {line['id']!r} already"
        seen.add(key)
        return None

    way = "score the run again with `plannerft score --run`"
    return list(_checked(path, problem_of, way)) if path.is_file() else []
