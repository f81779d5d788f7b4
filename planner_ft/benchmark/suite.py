"""`plannerft bench --suite`: every candidate on every data set is a process and a run folder of its
own; one that fails is named, the others go on. All answers are scored again for the overview.
"""

import functools
import itertools
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from planner_ft.benchmark import folder
from planner_ft.benchmark.catalogue import METRIC, METRICS
from planner_ft.benchmark.definitions import Part, Suite
from planner_ft.benchmark.folder import measured_in, read_run
from planner_ft.benchmark.layout import lines
from planner_ft.benchmark.plan import Plan, make_plan
from planner_ft.benchmark.results import Measured, Results, assemble, heading
from planner_ft.benchmark.samples import BenchData, load_bench_data
from planner_ft.benchmark.settings import BenchSettings
from planner_ft.benchmark.units import UNIT, State, Unit, Units, arguments
from planner_ft.candidates import Candidate, resolve_candidate
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_json, read_text, write_json, write_text
from planner_ft.support.manifest import build_manifest
from planner_ft.support.tables import Table, TableRow, csv_text, latex_table, markdown_table, row
from planner_ft.vocabulary import load_vocabulary

SUITE, LOG = "suite.json", "log.txt"
NAMED = ("label", "candidate", "configuration")
FIGURES = ("f1", "whole_plan", "latency_s")  # the metrics of the overview
GROUPS = {False: "Published-size splits", True: "Reported apart: data beyond the published size"}
HOW = (
    "In brackets 95 % intervals. Every metric, published figures and notes: table.md in the"
    " folder of each data set."
)


@dataclass(frozen=True, kw_only=True)
class Run(Unit):
    """One candidate on one data set, as the run that `settings` describe. `failed` says why
    configurations could not be run.
    """

    part: Part
    candidate: Candidate
    data: BenchData
    settings: BenchSettings
    failed: dict[str, str] = field(default_factory=dict)

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
    for (slug, candidate), (part, data) in itertools.product(candidates.items(), parts):
        adapter = suite.adapters.get(candidate.name, {}).get(part.settings.level)
        where, own = out / part.name / slug, (str(adapter),) if adapter else ()
        settings = replace(part.settings, candidates=(candidate.given_as,), adapters=own, out=where)
        each = len(data.samples) + settings.latency_samples
        known = f"{part.name}, {candidate.name}", where, each * len(settings.configurations)
        run: dict[str, Any] = {"part": part, "candidate": candidate, "data": data}
        units.append(Run(*known, candidate.parameters or 1, settings=settings, **run))
    return units


def opened(
    suite: Suite, out: Path, flags: dict[str, Any], *, resume: bool = False, overwrite: bool = False
) -> list[Run]:
    """The units of a suite in its folder, which whoever calls holds; `flags` are settings of the
    command line. Raises PlannerError, also when data changed since an earlier session.
    """
    units = make_units(suite, out, flags)
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


@dataclass(frozen=True)
class PartResults:
    """One data set of a suite with everything that was measured on it; `results` may have no rows.
    `failed` are candidates in configurations that could not be measured: candidate, label,
    configuration, reason.
    """

    part: Part
    results: Results
    failed: tuple[dict[str, str], ...]

    def to_json(self) -> dict[str, Any]:
        named = {"name": self.part.name, "apart": self.part.apart, "level": self.results.level}
        rows = [one.to_json() for one in self.results.rows]
        return {**named, "data": self.results.data, "rows": rows, "failed": list(self.failed)}


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
    _write(out, suite.title, parts, manifest)
    return parts


def combine(
    suite: Suite, units: Sequence[Run], session: Units, changes: dict[str, Any]
) -> tuple[list[PartResults], dict[str, Any]]:
    """The results of every part, and one manifest: all files, what units ran with and took."""
    begun = [unit for unit in units if (unit.folder / folder.RUN).is_file()]
    records = {unit.name: read_run(unit.folder) for unit in begun}
    ran, settings = dict[str, Any](), units[0].settings
    for name, unit in ((unit.name, unit) for unit in units):
        given = arguments((unit.plan or unit).settings)
        times = {"seconds": session.seconds.get(name), "finished_before": name in session.finished}
        record = records.get(name)
        made = {key: record[key] if record else {} for key in ("jobs", "costs")}
        ran[name] = {"arguments": given, **times, **made}
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
    units: Sequence[Run], records: dict[str, dict[str, Any]], manifest: dict[str, Any]
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
        results = assemble(data, vocabulary, found, own)
    return PartResults(part, results, tuple(failed))


def _write(out: Path, title: str, parts: Sequence[PartResults], manifest: dict[str, Any]) -> None:
    """Write PART/ and the overview into `out`, results.json last: then all is there."""
    for one in parts:
        where = out / one.part.name
        where.mkdir(parents=True, exist_ok=True)
        folder.write_results(where, one.results, one.to_json())
        for name in folder.TABLES:
            shown = read_text(where / name) if one.results.rows else ""
            write_text(where / name, shown + _not_measured(name, one))
    ordered = sorted(parts, key=lambda one: one.part.apart)
    table, failed = _overview(ordered), _failed(ordered)
    texts = [f"# {title}\n", markdown_table(table)]
    texts += ["## Not measured\n", markdown_table(failed)] if failed.rows else []
    write_text(out / "table.md", "\n".join([*texts, HOW]) + "\n")
    write_text(out / "table.csv", csv_text(_csv(parts)))
    absent = "".join(_not_measured("table.tex", one) for one in ordered)
    write_text(out / "table.tex", latex_table(table) + absent)
    overview = {"title": title, "parts": [one.to_json() for one in parts], "manifest": manifest}
    write_json(out / folder.RESULTS, overview)


def _overview(parts: Sequence[PartResults]) -> Table:
    """F1, whole plans and latency of everything in one table, a section per data set."""
    rows: list[TableRow] = []
    for one in parts:
        named = f"{one.part.name}: {one.results.level} level, n = {one.results.data['n']}"
        rows.append(row(f"{named} ({GROUPS[one.part.apart]})", kind="section"))
        for found in lines(one.results, beside=False):
            cells = [replace(cell, mark="") for cell in found.cells(FIGURES)]
            rows.append(row(found.label, found.heading, *cells, kind=found.kind))
        for entry in one.failed:
            cells_of = ("not measured", *[""] * (len(FIGURES) - 1))
            rows.append(row(entry["label"], heading(entry["configuration"]), *cells_of))
    heads = ("Configuration", *(METRIC[name].title for name in FIGURES))
    return Table("Model", heads, rows, texts=1)


def _failed(parts: Sequence[PartResults]) -> Table:
    rows = [
        row(one.part.name, entry["label"], heading(entry["configuration"]), entry["reason"])
        for one in parts
        for entry in one.failed
    ]
    return Table("Data", ("Model", "Configuration", "Why"), rows, texts=3)


def _not_measured(name: str, one: PartResults) -> str:
    """The lines of a table of one data set about the systems that it lacks."""
    if not one.failed:
        return ""
    if name == "table.md":
        return f"\nNot measured:\n\n{markdown_table(_failed([one]))}"
    rows = [[cell.plain() for cell in line.cells] for line in _failed([one]).rows]
    if name == "table.tex":
        return "".join(f"% not measured: {label}, {name}: {why}\n" for label, name, why in rows)
    n = one.results.data["n"]
    return csv_text([(label, f"not measured: {why}", name, n) for label, name, why in rows])


def _csv(parts: Sequence[PartResults]) -> Iterator[list[Any]]:
    """A line per data set, candidate and configuration with every metric, or why it failed."""
    heads = ["data", "level", "apart", "n", "model", "candidate", "configuration", "status"]
    figures = [f"{name}{end}" for name in METRICS for end in ("", "_low", "_high")]
    yield [*heads, "reason", *figures]
    for one in parts:
        common = [one.part.name, one.results.level, int(one.part.apart), one.results.data["n"]]
        for found in (*one.results.rows, *one.results.baselines):
            named = [getattr(found, key) for key in NAMED]
            bounds = [one for name in METRICS for one in found.figure(name).to_json().values()]
            values = [None if bound is None else f"{bound:.6g}" for bound in bounds]
            yield [*common, *named, found.kind, None, *values]
        for entry in one.failed:
            named = [entry[key] for key in NAMED]
            yield [*common, *named, "failed", entry["reason"], *[None] * len(figures)]
