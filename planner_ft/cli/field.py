"""`plannerft bench --field`."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer

from planner_ft.cli.options import typed
from planner_ft.cli.progress import Report, interruptible
from planner_ft.support.errors import PlannerError

if TYPE_CHECKING:
    from planner_ft.benchmark.field.cases import Case
    from planner_ft.benchmark.field.checks import Outcome
    from planner_ft.benchmark.field.run import FieldRow
    from planner_ft.document.vehicle import Vehicle
    from planner_ft.planning import Planner
    from planner_ft.planning.settings import PlanSettings

FLAGS = ("candidates", "configurations", "vocabulary", "quantization", "limit")
"""Options of `bench` that say what of field cases is run."""


def check_flags(named: dict[str, Any]) -> None:
    """Raise PlannerError for options that field cases do not have."""
    if extra := [name for name in named if name not in FLAGS]:
        raise PlannerError(f"--field plans whole commands; leave out {typed(extra)}")


def run_field(
    files: Sequence[Path], out: Path, named: dict[str, Any], device: str, *, overwrite: bool
) -> None:
    """Run the cases in every configuration of every candidate; print the table, write results."""
    from rich.console import Console

    from planner_ft.benchmark.field.cases import case_files, load_cases
    from planner_ft.benchmark.field.run import check_out, field_table, write_field
    from planner_ft.support.manifest import build_manifest
    from planner_ft.support.tables import terminal_table
    from planner_ft.vocabulary import load_vocabulary

    vocabulary = load_vocabulary(named.get("vocabulary", "usv"))
    paths = case_files(files)
    cases = load_cases(paths, vocabulary)[: named.get("limit")]
    check_out(out, overwrite=overwrite)
    rows, agents = [], {}
    with interruptible() as progress:
        for settings in _settings(named, vocabulary.source, device):
            made, agents_used = _row(settings, cases, progress)
            rows.append(made)
            agents[made.name] = agents_used
    definition = {"name": vocabulary.name, "sha256": vocabulary.sha256}
    ran = {"cases": len(cases), "vocabulary": definition}
    inputs: dict[str, Path | str] = {str(path): path for path in paths}
    manifest = build_manifest("field", seed=None, configuration=ran, inputs=inputs, agents=agents)
    write_field(out, rows, manifest)
    Console().print(terminal_table(field_table(rows)))
    typer.echo(f"\n{out}/: results.json, plans.jsonl, table.md (with the cases that failed)")


def _settings(named: dict[str, Any], vocabulary: str, device: str) -> list[PlanSettings]:
    """Settings for each configuration of each candidate; the strongest one where none is named."""
    from planner_ft.planning.settings import PlanSettings

    quantization = named.get("quantization")
    return [
        PlanSettings(
            candidate,
            configuration=configuration or None,
            vocabulary=vocabulary,
            device=device,
            quantization=quantization,
        )
        for candidate in _names(named.get("candidates", "embedded"))
        for configuration in _names(named.get("configurations")) or [""]
    ]


def _row(
    settings: PlanSettings, cases: Sequence[Case], progress: Report
) -> tuple[FieldRow, dict[str, Any]]:
    """The cases in one configuration, and what its agents depended on."""
    from planner_ft.benchmark.field.run import FieldRow, judge
    from planner_ft.document.vehicle import load_vehicle
    from planner_ft.planning import Planner

    with Planner(settings) as planner:
        plan = _Plan(planner, load_vehicle(None, planner.vocabulary))
        agents = planner.agents.agents
        name, configuration = settings.candidate, agents["mission"].configuration.name
        judged = judge(cases, plan, planner.vocabulary, progress, f"{name} {configuration}")
        return FieldRow(name, configuration, judged), {
            of: one.record() for of, one in agents.items()
        }


def _names(text: str | None) -> list[str]:
    return [part.strip() for part in (text or "").split(",") if part.strip()]


@dataclass(frozen=True)
class _Plan:
    """Plans a case as `plannerft plan` does."""

    planner: Planner
    vehicle: Vehicle

    def __call__(self, case: Case) -> Outcome:
        from planner_ft.benchmark.field.checks import Outcome
        from planner_ft.document import build
        from planner_ft.support.geodesy import Origin

        origin = Origin(*case.origin) if case.origin else None
        try:
            planned = self.planner.plan(case.command, case.locate, origin=origin)
        except PlannerError as error:
            return Outcome({}, str(error))
        document = build(planned, self.planner.vocabulary, self.vehicle)
        problems = [
            part["problems"][0] for part in (document, *document["tasks"]) if "problems" in part
        ]
        return Outcome(document, problems[0] if problems else None)
