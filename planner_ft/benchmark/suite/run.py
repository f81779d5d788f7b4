"""`plannerft bench --suite`: run missing units, then write a folder per data set, scored again from
the answers that are there, and one overview of all.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, NamedTuple

from planner_ft.benchmark import folder
from planner_ft.benchmark.catalogue import METRIC, METRICS
from planner_ft.benchmark.layout import lines
from planner_ft.benchmark.records import measured_in, read_run
from planner_ft.benchmark.results import Measured, Results, assemble, heading
from planner_ft.benchmark.suite.definition import Part, Suite
from planner_ft.benchmark.suite.session import Report, Session, State, opened
from planner_ft.benchmark.suite.units import Flags, Unit
from planner_ft.support.files import read_text, write_json, write_text
from planner_ft.support.manifest import build_manifest
from planner_ft.support.tables import Table, TableRow, csv_text, latex_table, markdown_table, row

__all__ = ["State", "run_suite"]

FIGURES = ("f1", "whole_plan", "latency_s")
"""The metrics of the overview."""
GROUPS = {False: "Published-size splits", True: "Reported apart: data beyond the published size"}
HOW = (
    "In brackets 95 % intervals. Every metric, published figures and notes: table.md in the"
    " folder of each data set."
)


class Failed(NamedTuple):
    """A candidate in a configuration that could not be measured, and why."""

    candidate: str
    label: str
    configuration: str
    reason: str


@dataclass(frozen=True)
class PartResults:
    """One data set of a suite with everything that was measured on it; `results` may have no
    rows.
    """

    part: Part
    results: Results
    failed: tuple[Failed, ...]

    def to_json(self) -> dict[str, Any]:
        return {
            "name": self.part.name,
            "apart": self.part.apart,
            "level": self.part.level,
            "data": self.results.data,
            "rows": [one.to_json() for one in self.results.rows],
            "failed": [one._asdict() for one in self.failed],
        }


def run_suite(
    suite: Suite,
    out: Path,
    flags: Flags,
    report: Report,
    *,
    resume: bool = False,
    overwrite: bool = False,
) -> list[PartResults]:
    """Run every unit of a suite that is not finished and write the tables of all into `out`.

    A unit that fails is named in the result and in the tables, and the others go on. Raises
    PlannerError for problems that keep the suite from starting.
    """
    session = opened(suite, out, flags, report, resume=resume, overwrite=overwrite)
    session.run()
    parts, manifest = combine(session)
    _write(out, suite.title, parts, manifest)
    return parts


def combine(session: Session) -> tuple[list[PartResults], dict[str, Any]]:
    """The results of every part, and the suite's manifest."""
    manifest = _manifest(session)
    return [_part(session, part, manifest) for part in session.suite.parts], manifest


def _manifest(session: Session) -> dict[str, Any]:
    """One manifest for all: the suite file, every data set, and what each unit was run with and
    took.
    """
    suite, flags, seconds = session.suite, session.units[0].flags, session.seconds
    units: dict[str, Any] = {}
    for unit in session.units:
        recorded = read_run(unit.folder) if (unit.folder / folder.RUN).is_file() else None
        units[unit.name] = {
            "arguments": unit.arguments(),
            "seconds": round(seconds[unit.name], 1) if unit.name in seconds else None,
            "finished_before": unit.name in session.skipped,
            "jobs": recorded.jobs if recorded else {},
            "costs": recorded.costs if recorded else {},
        }
    configuration = {
        "title": suite.title,
        "vocabulary": {"name": session.vocabulary.name, "sha256": session.vocabulary.sha256},
        "device": flags.device,
        "batch_size": flags.batch_size or "auto",
        "limit": flags.limit,
        "processes": flags.processes,
    }
    inputs: dict[str, Path | str] = {
        "suite": suite.path,
        **{part.name: part.data for part in suite.parts},
    }
    return build_manifest(
        "suite", seed=flags.seed, configuration=configuration, inputs=inputs, units=units
    )


def _part(session: Session, part: Part, manifest: dict[str, Any]) -> PartResults:
    units = [unit for unit in session.units if unit.part is part]
    found: list[Measured] = []
    failed: list[Failed] = []
    for unit in units:
        measured, n = _measured(unit), len(unit.data.samples)
        for configuration in part.configurations:
            candidate, entry = unit.candidate, measured.get(configuration)
            answers = len(entry.predictions) if entry else 0
            if entry is not None and answers >= n:
                found.append(entry)
                continue
            key = part.name, candidate.name, configuration
            kept = f" ({answers} of {n} answers are kept)" if answers else ""
            reason = session.failures.get(key, "not run yet") + kept
            failed.append(Failed(candidate.name, candidate.row_name, configuration, reason))
    data, seed = units[0].data, units[0].flags.seed
    own = {
        **manifest,
        "inputs": {"data": {"path": str(data.path), "sha256": data.sha256}},
        "units": {unit.name: manifest["units"][unit.name] for unit in units},
    }
    results = Results(part.level, data.summary(), (), own)
    if found:
        results = assemble(data, session.vocabulary, found, seed=seed, manifest=own)
    return PartResults(part, results, tuple(failed))


def _measured(unit: Unit) -> dict[str, Measured]:
    """The answers in a unit's folder by configuration, of samples of its data alone."""
    if not (unit.folder / folder.RUN).is_file():
        return {}
    known = {sample.id for sample in unit.data.samples}
    found = {}
    for entry in measured_in(unit.folder, read_run(unit.folder)):
        own = {key: line for key, line in entry.predictions.items() if key in known}
        found[entry.system.configuration] = replace(entry, predictions=own)
    return found


def _write(out: Path, title: str, parts: Sequence[PartResults], manifest: dict[str, Any]) -> None:
    """Write PART/ and the overview of all parts into `out`; results.json last, so that it is there
    only when all is.
    """
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
        named = f"{one.part.name}: {one.part.level} level, n = {one.results.data['n']}"
        rows.append(row(f"{named} ({GROUPS[one.part.apart]})", kind="section"))
        for found in lines(one.results, beside=False):
            cells = [replace(cell, mark="") for cell in found.cells(FIGURES)]
            rows.append(row(found.model, found.configuration, *cells, kind=found.kind))
        for entry in one.failed:
            blank = [""] * (len(FIGURES) - 1)
            rows.append(row(entry.label, heading(entry.configuration), "not measured", *blank))
    heads = ("Configuration", *(METRIC[name].title for name in FIGURES))
    return Table("overview", "", "", "Model", heads, tuple(rows), texts=1)


def _failed(parts: Sequence[PartResults]) -> Table:
    rows = tuple(
        row(one.part.name, entry.label, heading(entry.configuration), entry.reason)
        for one in parts
        for entry in one.failed
    )
    return Table("failed", "", "", "Data", ("Model", "Configuration", "Why"), rows, texts=3)


def _not_measured(name: str, one: PartResults) -> str:
    """The lines of a table of one data set about the systems that it lacks."""
    if not one.failed:
        return ""
    if name == "table.md":
        return f"\nNot measured:\n\n{markdown_table(_failed([one]))}"
    missing = [(entry.label, heading(entry.configuration), entry.reason) for entry in one.failed]
    if name == "table.tex":
        return "".join(f"% not measured: {', '.join(line[:2])}: {line[2]}\n" for line in missing)
    n = one.results.data["n"]
    return csv_text([(label, f"not measured: {why}", name, n) for label, name, why in missing])


def _csv(parts: Sequence[PartResults]) -> Iterator[list[Any]]:
    """A line per data set, candidate and configuration with every metric; rates are fractions.
    Failed ones have a reason and no figures.
    """
    heads = ["data", "level", "apart", "n", "model", "candidate", "configuration", "status"]
    figures = [f"{name}{end}" for name in METRICS for end in ("", "_low", "_high")]
    yield [*heads, "reason", *figures]
    for one in parts:
        common = [one.part.name, one.part.level, int(one.part.apart), one.results.data["n"]]
        for found in (*one.results.rows, *one.results.baselines):
            system = found.system
            status = "baseline" if system.is_baseline else "measured"
            bounds = [one for name in METRICS for one in found.figure(name).to_json().values()]
            values = [None if bound is None else f"{bound:.6g}" for bound in bounds]
            named = [system.label, system.candidate, system.configuration, status, None]
            yield [*common, *named, *values]
        for entry in one.failed:
            named = [entry.label, entry.candidate, entry.configuration, "failed", entry.reason]
            yield [*common, *named, *[None] * len(figures)]
