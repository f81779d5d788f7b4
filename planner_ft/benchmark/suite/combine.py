"""What a suite's units measured, put together: results per data set, scored again from the answers
that are there.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from planner_ft.benchmark import folder
from planner_ft.benchmark.assembly import Measured, assemble
from planner_ft.benchmark.record import measured_in, read_run
from planner_ft.benchmark.results import Results
from planner_ft.benchmark.suite.definition import Part
from planner_ft.benchmark.suite.session import Session
from planner_ft.benchmark.suite.units import Unit
from planner_ft.support.files import sha256_file
from planner_ft.support.manifest import build_manifest


@dataclass(frozen=True)
class Failed:
    """A candidate in a configuration that could not be measured, and why."""

    candidate: str
    label: str
    configuration: str
    reason: str


@dataclass(frozen=True)
class PartResults:
    """One data set of a suite with everything that was measured on it. `results` has no rows where
    nothing was.
    """

    part: Part
    results: Results
    failed: tuple[Failed, ...]


def combine(session: Session) -> tuple[list[PartResults], dict[str, Any]]:
    """The results of every part, and the suite's manifest."""
    manifest = suite_manifest(session)
    return [_part(session, part, manifest) for part in session.suite.parts], manifest


def suite_manifest(session: Session) -> dict[str, Any]:
    """One manifest for all: the suite file, every data set, and what each unit was run with and
    took.
    """
    suite = session.suite
    units: dict[str, Any] = {}
    for unit in session.units:
        recorded = read_run(unit.folder) if (unit.folder / folder.RUN).is_file() else None
        units[unit.name] = {
            "arguments": unit.arguments(),
            "seconds": round(session.seconds[unit.name], 1)
            if unit.name in session.seconds
            else None,
            "finished_before": unit.name in session.skipped,
            "jobs": recorded.jobs if recorded else {},
            "costs": recorded.costs if recorded else {},
        }
    flags = session.units[0].flags
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


def _part(session: Session, part: Part, manifest: Mapping[str, Any]) -> PartResults:
    units = [unit for unit in session.units if unit.part is part]
    measured, failed = [], []
    for unit in units:
        found = _measured(unit)
        for configuration in part.configurations:
            reason = session.failures.get((part.name, unit.candidate.name, configuration))
            entry = found.get(configuration)
            whole = entry is not None and len(entry.predictions) >= len(unit.data.samples)
            if entry is not None and whole:
                measured.append(entry)
            else:
                kept = (
                    f" ({len(entry.predictions)} of {len(unit.data.samples)} answers are kept)"
                    if entry and entry.predictions
                    else ""
                )
                failed.append(
                    Failed(
                        unit.candidate.name,
                        unit.candidate.row_name,
                        configuration,
                        (reason or "not run yet") + kept,
                    )
                )
    data = units[0].data
    own = {
        **manifest,
        "inputs": {"data": {"path": str(data.path), "sha256": sha256_file(data.path)}},
        "units": {unit.name: manifest["units"][unit.name] for unit in units},
    }
    seed = units[0].flags.seed
    results = (
        assemble(data, session.vocabulary, measured, seed=seed, manifest=own)
        if measured
        else Results(part.level, data.summary(), (), own)
    )
    return PartResults(part, results, tuple(failed))


def _measured(unit: Unit) -> dict[str, Measured]:
    """What is in a unit's folder by configuration, of samples of its data alone."""
    if not (unit.folder / folder.RUN).is_file():
        return {}
    known = {sample.id for sample in unit.data.samples}
    found = {}
    for entry in measured_in(unit.folder, read_run(unit.folder)):
        lines = {key: line for key, line in entry.predictions.items() if key in known}
        found[entry.system.configuration] = replace(entry, predictions=lines)
    return found
