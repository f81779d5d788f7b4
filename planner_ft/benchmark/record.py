"""run.json: what a run folder was made with, so that it can be gone on with, refused, or scored
again without any model.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, fields
from pathlib import Path
from typing import TYPE_CHECKING, Any

from planner_ft.benchmark.folder import LATENCY, PLANNING, PREDICTIONS, RUN
from planner_ft.benchmark.results import System
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import iterate_jsonl, read_json, write_json

if TYPE_CHECKING:
    from planner_ft.benchmark.assembly import Measured
    from planner_ft.benchmark.plan import Plan
    from planner_ft.benchmark.predictions import RecordLog


@dataclass(frozen=True)
class RunRecord:
    """What run.json holds. `jobs` are the parts that answers depend on, `keys` their digests,
    `systems` what was measured, all by job name; `costs` is what a candidate cost beside its
    queries; `settings` are level, data, limit, vocabulary and seed.
    """

    jobs: dict[str, dict[str, Any]]
    keys: dict[str, str]
    systems: dict[str, System]
    settings: dict[str, Any]
    costs: dict[str, dict[str, Any]]


def begin_run(plan: Plan, predictions: RecordLog) -> None:
    """Write run.json. Raises PlannerError when the folder holds a run that was made with something
    else.
    """
    path = plan.settings.folder / RUN
    before: dict[str, Any] = read_json(path) if path.is_file() else {}
    _check_jobs(plan, path, before)
    _check_predictions(plan, predictions)
    settings = {
        "level": plan.settings.level,
        "data": str(plan.data.path),
        "data_sha256": plan.data.sha256,
        "limit": plan.settings.limit,
        "vocabulary": plan.settings.vocabulary,
        "seed": plan.settings.seed,
    }
    write_json(
        path,
        {
            "settings": settings,
            "jobs": {**before.get("jobs", {}), **{job.name: job.parts for job in plan.jobs}},
            "keys": {**before.get("keys", {}), **{job.name: job.key for job in plan.jobs}},
            "systems": {
                **before.get("systems", {}),
                **{job.name: asdict(job.system) for job in plan.jobs},
            },
            "costs": before.get("costs", {}),
        },
    )


def add_costs(folder: Path, candidate: str, costs: Mapping[str, Any]) -> None:
    """Record what a candidate cost; figures that are None leave those of an earlier session."""
    record = read_json(folder / RUN)
    record["costs"][candidate] = {
        **record["costs"].get(candidate, {}),
        **{name: value for name, value in costs.items() if value is not None},
    }
    write_json(folder / RUN, record)


def read_run(folder: Path) -> RunRecord:
    """Read run.json. Raises PlannerError when there is none, or it is of a version that recorded
    less.
    """
    if not (folder / RUN).is_file():
        raise PlannerError(
            f"{folder}: no {RUN}, so no run of `plannerft bench`; for other predictions give"
            " --predictions FILE"
        )
    record = read_json(folder / RUN)
    names = [field.name for field in fields(RunRecord)]
    if not isinstance(record, dict) or any(
        not isinstance(record.get(name), dict) for name in names
    ):
        raise PlannerError(
            f"{folder / RUN}: does not say what was run; score its answers with --predictions"
            f" {folder / PREDICTIONS}"
        )
    values = {name: record[name] for name in names}
    return RunRecord(
        **{
            **values,
            "systems": {name: System(**system) for name, system in record["systems"].items()},
        }
    )


def measured_in(folder: Path, record: RunRecord) -> list[Measured]:
    """The systems of a run with their answers and timed queries, read without locking: a line that
    is being written is left out.
    """
    from planner_ft.benchmark.assembly import Measured

    answers, timed = (records_by_key(folder / name) for name in (PREDICTIONS, LATENCY))
    return [
        Measured(
            system,
            answers.get(record.keys[name], {}),
            timed.get(record.keys[name], {}),
            *costs_of(folder, record.costs, system),
        )
        for name, system in record.systems.items()
    ]


def costs_of(
    folder: Path, costs: Mapping[str, Mapping[str, Any]], system: System
) -> tuple[Mapping[str, Any], list[dict[str, Any]]]:
    """What run.json has on a system's candidate, and the system's lines of planning.jsonl."""
    beside = costs.get(system.candidate, {})
    key = beside.get("planning_keys", {}).get(system.configuration)
    return beside, list(records_by_key(folder / PLANNING).get(key, {}).values()) if key else []


def records_by_key(path: Path) -> dict[str, dict[str, dict[str, Any]]]:
    """The records of a file by key and id; a line that is not whole is left out."""
    found: dict[str, dict[str, dict[str, Any]]] = {}
    if path.is_file():
        for _number, line, _problem in iterate_jsonl(path):
            if isinstance(line, dict) and "key" in line and "id" in line:
                found.setdefault(line["key"], {})[line["id"]] = line
    return found


def _check_jobs(plan: Plan, path: Path, recorded: dict[str, Any]) -> None:
    same = {name: plan.jobs[0].parts[name] for name in ("level", "data", "vocabulary")}
    for name, parts in recorded.get("jobs", {}).items():
        other = [part for part, value in same.items() if parts.get(part) != value]
        if other:
            raise PlannerError(
                f"{path}: {name} was begun with another {' and another '.join(other)}; give"
                " --overwrite to start anew, or another --out"
            )
    for job in plan.jobs:
        before = recorded.get("jobs", {}).get(job.name, job.parts)
        changed = [name for name in job.parts if before.get(name) != job.parts[name]]
        if changed:
            raise PlannerError(
                f"{path}: {job.name} was begun with another {' and another '.join(changed)}; give"
                " --overwrite to start anew, or another --out"
            )


def _check_predictions(plan: Plan, predictions: RecordLog) -> None:
    keys: dict[tuple[str, str], set[str]] = {}
    for job in plan.jobs:
        keys.setdefault((job.candidate.name, job.configuration.name), set()).add(job.key)
    for record in predictions.records.values():
        name = str(record.get("candidate")), str(record.get("configuration"))
        if record["key"] not in keys.get(name, {record["key"]}):
            raise PlannerError(
                f"{predictions.path}: holds answers of {name[0]} {name[1]} that are not of this"
                " run; give --overwrite or another --out"
            )
