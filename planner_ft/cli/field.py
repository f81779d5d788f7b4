"""`plannerft bench --field` and `--level both`: commands planned with both agents."""

from __future__ import annotations

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
    from planner_ft.planning import Planner

FLAGS = ("candidates", "configurations", "vocabulary", "quantization", "limit", "device")
"""Options of `bench` that say what of whole plans is run."""
PLACE = (100.0, 50.0)
"""Metres: where demands take a place to be that is open; the next ones lie further east."""


def run_whole(
    cases: list[Path] | None, out: Path | None, named: dict[str, Any], *, overwrite: bool
) -> None:
    """Run field cases, or without `cases` the demands of --data; print the table."""
    also = () if cases is not None else ("level", "data")
    if extra := [name for name in named if name not in (*FLAGS, *also)]:
        flag = "--level both" if also else "--field"
        raise PlannerError(f"{flag} plans whole commands; leave out {typed(extra)}")
    from planner_ft.benchmark.field.cases import DEMANDS, case_files
    from planner_ft.benchmark.field.run import TABLE, Demands, Field, run_cases
    from planner_ft.planning.settings import PlanSettings
    from planner_ft.support.tables import terminal_table
    from planner_ft.vocabulary import load_vocabulary

    vocabulary = load_vocabulary(named.get("vocabulary", "usv"))
    bench: Field | Demands = Demands() if cases is None else Field()
    files = [named.get("data") or DEMANDS] if cases is None else case_files(cases)
    known: dict[str, Any] = {name: named.get(name) for name in ("quantization", "device")}
    agents = [
        PlanSettings(candidate, configuration=one or None, vocabulary=vocabulary.source, **known)
        for candidate in _names(named.get("candidates", "embedded"))
        for one in _names(named.get("configurations")) or [""]
    ]
    folder, limit = out or Path("eval/runs") / bench.kind, named.get("limit")
    with alone(folder, "--out", "a benchmark"), interruptible() as progress:
        how: dict[str, Any] = {"limit": limit, "overwrite": overwrite}
        table = run_cases(bench, files, folder, vocabulary, agents, _Plan, progress, **how)
    terminal().print(terminal_table(table))
    show(f"\n{folder}/: results.json, {bench.log}, {TABLE}")


class _Plan:
    """Plans a case as `plannerft plan` does; `everywhere` takes open places to be somewhere."""

    def __init__(self, planner: Planner, everywhere: bool) -> None:
        from planner_ft.document.vehicle import load_vehicle

        self.planner, self.everywhere = planner, everywhere
        self.vehicle = load_vehicle(None, planner.vocabulary)

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


def _names(text: str | None) -> list[str]:
    return [part.strip() for part in (text or "").split(",") if part.strip()]
