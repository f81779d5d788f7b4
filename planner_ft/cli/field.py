"""`plannerft bench --field` and `--level both`: commands planned with both agents."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from planner_ft.cli.options import typed
from planner_ft.cli.progress import interruptible
from planner_ft.support.alone import alone
from planner_ft.support.errors import PlannerError
from planner_ft.support.terminal import show, terminal

if TYPE_CHECKING:
    from planner_ft.benchmark.field.cases import Case
    from planner_ft.benchmark.field.checks import Outcome
    from planner_ft.benchmark.field.run import Judged
    from planner_ft.document.vehicle import Vehicle
    from planner_ft.planning import Planner
    from planner_ft.planning.settings import PlanSettings
    from planner_ft.support.tables import Table
    from planner_ft.vocabulary import Vocabulary

Name = tuple[str, str]
"""A candidate and its configuration."""

FLAGS = ("candidates", "configurations", "vocabulary", "quantization", "limit")
"""Options of `bench` that say what of whole plans is run."""
PLACE = (100.0, 50.0)
"""Metres: where --level both takes a place to be that is open; the next ones lie further east."""


def check_flags(named: dict[str, Any], flag: str, *also: str) -> None:
    """Raise PlannerError for options that whole plans do not have."""
    if extra := [name for name in named if name not in (*FLAGS, *also)]:
        raise PlannerError(f"{flag} plans whole commands; leave out {typed(extra)}")


def run_field(
    files: Sequence[Path], out: Path, named: dict[str, Any], device: str, *, overwrite: bool
) -> None:
    """Run the cases in every configuration of every candidate; print the table, write results."""
    from planner_ft.benchmark.field import run
    from planner_ft.benchmark.field.cases import case_files, load_cases
    from planner_ft.vocabulary import load_vocabulary

    vocabulary = load_vocabulary(named.get("vocabulary", "usv"))
    paths = case_files(files)
    cases = load_cases(paths, vocabulary)[: named.get("limit")]
    with alone(out, "--out", "a benchmark"):
        _check_out(out, run.FILES, overwrite=overwrite)
        found, manifest = _judged("field", cases, named, vocabulary, device, paths)
        rows = [run.FieldRow(*name, judged) for name, judged in found.items()]
        run.write_field(out, rows, manifest)
    _show(run.field_table(rows), out, run.FILES)


def run_both(
    data: Path | None, out: Path, named: dict[str, Any], device: str, *, overwrite: bool
) -> None:
    """Score what commands demand end to end, in every configuration of every candidate."""
    from planner_ft.benchmark import demands
    from planner_ft.vocabulary import load_vocabulary

    vocabulary = load_vocabulary(named.get("vocabulary", "usv"))
    path = data or demands.DEFAULT
    cases = demands.load_demands(path, vocabulary)[: named.get("limit")]
    with alone(out, "--out", "a benchmark"):
        _check_out(out, demands.FILES, overwrite=overwrite)
        found, manifest = _judged("both", cases, named, vocabulary, device, [path])
        rows = [demands.demand_row(name, judged, vocabulary) for name, judged in found.items()]
        demands.write_demands(out, rows, manifest)
    _show(demands.demand_table(rows), out, demands.FILES)


def _check_out(out: Path, names: Sequence[str], *, overwrite: bool) -> None:
    from planner_ft.benchmark.folder import check_folder

    check_folder(out, () if overwrite else names, "give --overwrite or another --out")


def _judged(
    kind: str,
    cases: Sequence[Case],
    named: dict[str, Any],
    vocabulary: Vocabulary,
    device: str,
    files: Sequence[Path],
) -> tuple[dict[Name, tuple[Judged, ...]], dict[str, Any]]:
    """The cases in each configuration of each candidate, and the manifest of all."""
    from planner_ft.benchmark.field.run import judge
    from planner_ft.document.vehicle import load_vehicle
    from planner_ft.planning import Planner
    from planner_ft.support.manifest import build_manifest

    found: dict[Name, tuple[Judged, ...]] = {}
    used: dict[str, Any] = {}
    with interruptible() as progress:
        for settings in _settings(named, vocabulary.source, device):
            with Planner(settings) as planner:
                agents = planner.agents.agents
                name = settings.candidate, agents["mission"].configuration.name
                vehicle = load_vehicle(None, planner.vocabulary)
                plan = _Plan(planner, vehicle, everywhere=kind == "both")
                found[name] = judge(cases, plan, vocabulary, progress, " ".join(name))
                used[" ".join(name)] = {of: one.record() for of, one in agents.items()}
    definition = {"name": vocabulary.name, "sha256": vocabulary.sha256}
    ran = {"limit": named.get("limit"), "vocabulary": definition}
    inputs: dict[str, Path | str] = {str(path): path for path in files}
    return found, build_manifest(kind, seed=None, configuration=ran, inputs=inputs, agents=used)


def _show(table: Table, out: Path, files: Sequence[str]) -> None:
    from planner_ft.support.tables import terminal_table

    terminal().print(terminal_table(table))
    show(f"\n{out}/: {', '.join(files)}")


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


def _names(text: str | None) -> list[str]:
    return [part.strip() for part in (text or "").split(",") if part.strip()]


@dataclass(frozen=True)
class _Plan:
    """Plans a case as `plannerft plan` does; `everywhere` takes open places to be somewhere."""

    planner: Planner
    vehicle: Vehicle
    everywhere: bool

    def __call__(self, case: Case) -> Outcome:
        from planner_ft.benchmark.field.checks import Outcome
        from planner_ft.document import build
        from planner_ft.support.geodesy import Origin

        origin = Origin(*case.origin) if case.origin else None
        try:
            planned = self.planner.plan(case.command, case.locate, origin=origin)
            if self.everywhere and planned.open_places:
                (east, north), places = PLACE, dict(case.locate)
                for number, place in enumerate(planned.open_places, 1):
                    places[place.name] = (east * number, north)
                planned = self.planner.plan(case.command, places, origin=origin)
        except PlannerError as error:
            return Outcome({}, str(error))
        document = build(planned, self.planner.vocabulary, self.vehicle)
        parts = [] if self.everywhere else [document, *document["tasks"]]
        problems = [part["problems"][0] for part in parts if "problems" in part]
        return Outcome(document, problems[0] if problems else None)
