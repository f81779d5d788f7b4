"""`plannerft bench --suite`: every candidate on every data set is a process and a run folder of its
own; one that fails is named, the others go on. All answers are scored again for the overview.
"""

from __future__ import annotations

import functools
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from planner_ft.benchmark import folder
from planner_ft.benchmark.definitions import Part, Suite
from planner_ft.benchmark.folder import RunRecord, measured_in, read_run
from planner_ft.benchmark.plan import Plan, make_plan
from planner_ft.benchmark.results import Measured, Results, assemble
from planner_ft.benchmark.samples import BenchData, load_bench_data
from planner_ft.benchmark.settings import BenchSettings
from planner_ft.benchmark.suite.tables import PartResults, write_suite
from planner_ft.benchmark.units import UNIT, State, Unit, Units, arguments
from planner_ft.candidates import Candidate, resolve_candidate
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_json, write_json
from planner_ft.support.manifest import build_manifest
from planner_ft.vocabulary import load_vocabulary

SUITE, LOG = "suite.json", "log.txt"


@dataclass(frozen=True)
class Run(Unit):
    """One candidate on one data set, as the run that `settings` describe. `failed` says why
    configurations could not be run.
    """

    part: Part = field(kw_only=True)
    candidate: Candidate = field(kw_only=True)
    data: BenchData = field(kw_only=True)
    settings: BenchSettings = field(kw_only=True)
    failed: dict[str, str] = field(default_factory=dict, kw_only=True)

    @functools.cached_property
    def plan(self) -> Plan | None:
        """The run of the configurations that can be run, None without any."""
        names, runs = self.settings.configurations, []
        for name in names:
            try:
                plan = make_plan(replace(self.settings, configurations=(name,)))
                runs.append(name)
            except PlannerError as error:
                self.failed[name] = str(error)
        if len(runs) > 1:
            plan = make_plan(replace(self.settings, configurations=tuple(runs)))
        return plan if runs else None

    def asked(self) -> dict[str, Any]:
        if self.plan is None:
            return {}
        given = arguments(replace(self.plan.settings, out=None))
        return {"arguments": given, "keys": {job.name: job.key for job in self.plan.jobs}}

    def is_finished(self) -> bool:
        return (self.folder / folder.RESULTS).is_file() and super().is_finished()

    def steps(self) -> Iterator[tuple[str, list[str], Path]]:
        if self.plan:
            yield "bench", arguments(self.plan.settings), self.folder / LOG


def make_units(suite: Suite, out: Path, changes: dict[str, Any]) -> list[Run]:
    """Every candidate on every data set, with the command line's `changes`. Raises PlannerError."""
    parts: list[tuple[Part, BenchData]] = []
    for part in suite.parts:
        limits = (part.settings.limit, changes.get("limit"))
        limit = min((one for one in limits if one is not None), default=None)
        settings = replace(part.settings, **changes | {"limit": limit})
        vocabulary = load_vocabulary(settings.vocabulary)
        data = load_bench_data(settings.data or "", settings.level, vocabulary, limit)
        timed = min(settings.latency_samples, len(data.samples))
        parts.append((replace(part, settings=replace(settings, latency_samples=timed)), data))
    candidates: dict[str, Candidate] = {}
    for name in suite.candidates:
        # A folder relative to the suite file, else a name or a hub id.
        beside = suite.path.parent / name
        candidate = resolve_candidate(str(beside) if beside.is_dir() else name)
        if candidate.slug in candidates:
            way = "leave one out, or rename its folder"
            raise PlannerError(f"{suite.path}: two candidates are named {candidate.slug}; {way}")
        candidates[candidate.slug] = candidate
    units = []
    for slug, candidate in candidates.items():
        for part, data in parts:
            adapter = suite.adapters.get(candidate.name, {}).get(part.settings.level)
            where, own = out / part.name / slug, (str(adapter),) if adapter else ()
            settings = replace(
                part.settings, candidates=(candidate.given_as,), adapters=own, out=where
            )
            each = len(data.samples) + settings.latency_samples
            known = f"{part.name}, {candidate.name}", where, each * len(settings.configurations)
            run: dict[str, Any] = {"part": part, "candidate": candidate, "data": data}
            run |= {"settings": settings, "weight": candidate.parameters or 1}
            units.append(Run(*known, **run))
    return units


def opened(
    suite: Suite,
    out: Path,
    changes: dict[str, Any],
    *,
    resume: bool = False,
    overwrite: bool = False,
) -> list[Run]:
    """The units of a suite in its folder, which whoever calls holds; `changes` are settings of the
    command line. Raises PlannerError, also when data changed since an earlier session.
    """
    units = make_units(suite, out, changes)
    folder.check_folder(out, (SUITE,), resume=resume, overwrite=overwrite)
    if overwrite:
        (out / SUITE).unlink(missing_ok=True)
        for unit in units:
            folder.clear(unit.folder, (*folder.ALL, UNIT, LOG))
    path = out / SUITE
    data: dict[str, str] = read_json(path)["data"] if path.is_file() else {}
    for unit in units:
        if data.setdefault(unit.part.name, unit.data.sha256) != unit.data.sha256:
            way = "restore it, give --overwrite to start anew, or another --out"
            raise PlannerError(f"{unit.data.path}: changed since {out} was begun; {way}")
    write_json(path, {"title": suite.title, "suite": str(suite.path), "data": data})
    return units


def run_suite(
    suite: Suite,
    out: Path,
    changes: dict[str, Any],
    report: Callable[[State], None],
    *,
    processes: int = 1,
    **rerun: bool,
) -> list[PartResults]:
    """Run every unit of a suite that is not finished and write the tables of all into `out`;
    `changes` are settings of the command line, and `processes` share each run. Raises PlannerError
    for problems that keep the suite from starting.
    """
    units = opened(suite, out, changes, **rerun)
    session = Units(units, report, processes, suite.stall_minutes)
    for unit, _step, problem, _log in session.run():
        assert isinstance(unit, Run) and unit.plan
        unit.failed.update(dict.fromkeys(unit.plan.settings.configurations, problem))
    parts, manifest = combine(suite, units, session, changes)
    write_suite(out, suite.title, parts, manifest)
    return parts


def combine(
    suite: Suite, units: Sequence[Run], session: Units, changes: dict[str, Any]
) -> tuple[list[PartResults], dict[str, Any]]:
    """The results of every part, and one manifest: all files, what units ran with and took."""
    begun = [unit for unit in units if (unit.folder / folder.RUN).is_file()]
    records = {unit.name: read_run(unit.folder) for unit in begun}
    ran = {
        unit.name: {
            "arguments": arguments((unit.plan or unit).settings),
            "seconds": session.seconds.get(unit.name),
            "finished_before": unit.name in session.finished,
            "jobs": records[unit.name].jobs if unit.name in records else {},
            "costs": records[unit.name].costs if unit.name in records else {},
        }
        for unit in units
    }
    settings = units[0].settings
    manifest = build_manifest(
        "suite",
        seed=settings.seed,
        configuration={
            "title": suite.title,
            "vocabulary": load_vocabulary(settings.vocabulary).named,
            "device": settings.device,
            "batch_size": settings.batch_size or "auto",
            "limit": changes.get("limit"),
            "processes": session.processes,
        },
        inputs={"suite": suite.path, **{one.part.name: one.data.path for one in units}},
        units=ran,
    )
    of_parts = ([unit for unit in units if unit.part.name == part.name] for part in suite.parts)
    return [_part(of_part, records, manifest) for of_part in of_parts], manifest


def _part(
    units: Sequence[Run], records: dict[str, RunRecord], manifest: dict[str, Any]
) -> PartResults:
    part, data = units[0].part, units[0].data
    found: list[Measured] = []
    failed: list[dict[str, str]] = []
    for unit in units:
        record, n = records.get(unit.name), len(data.samples)
        every = measured_in(unit.folder, record) if record else []
        measured = {one.system.configuration: one for one in every}
        for name in part.settings.configurations:
            entry = measured.get(name)
            answers = sum(sample.id in entry.predictions for sample in data.samples) if entry else 0
            if entry is not None and answers == n:
                found.append(entry)
                continue
            kept = f" ({answers} of {n} answers are kept)" if answers else ""
            reason = unit.failed.get(name, "not run yet") + kept
            named = {"candidate": unit.candidate.name, "label": unit.candidate.row_name}
            failed.append({**named, "configuration": name, "reason": reason})
    own = {
        **manifest,
        "inputs": {"data": {"path": str(data.path), "sha256": data.sha256}},
        "units": {unit.name: manifest["units"][unit.name] for unit in units},
    }
    results = Results(data.level, data.summary(), (), own)
    if found:
        vocabulary = load_vocabulary(units[0].settings.vocabulary)
        results = assemble(data, vocabulary, found, seed=manifest["seed"], manifest=own)
    return PartResults(part, results, tuple(failed))
