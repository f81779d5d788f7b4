"""`plannerft bench --field` and `--level both`: commands planned with both agents."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from planner_ft.cli.bench import names
from planner_ft.cli.options import Options, typed
from planner_ft.cli.progress import working
from planner_ft.support.errors import PlannerError
from planner_ft.support.terminal import show, terminal

if TYPE_CHECKING:
    from planner_ft.benchmark.field.cases import Case, Outcome
    from planner_ft.planning import Planner

FLAGS = ("candidates", "configurations", "vocabulary", "quantization", "limit")
"""Options of `bench` that say what of whole plans is run."""
PLACE = (100.0, 50.0)
"""Metres: where demands take a place to be that is open; the next ones lie further east."""


def run_whole(o: Options, named: dict[str, Any]) -> None:
    """Run field cases, or with --level both the demands of --data; print the table. `named` are
    the options that say what is run.
    """
    from planner_ft.benchmark.field.cases import DEMANDS, case_files
    from planner_ft.benchmark.field.run import Demands, Field, run_cases
    from planner_ft.benchmark.folder import PLANS
    from planner_ft.planning.settings import PlanSettings
    from planner_ft.support.tables import terminal_table
    from planner_ft.vocabulary import load_vocabulary

    also, flag = ((), "--field") if o.field else (("level", "data"), "--level both")
    if extra := [name for name in named if name not in (*FLAGS, *also)]:
        raise PlannerError(f"{flag} plans whole commands; leave out {typed(extra)}")
    vocabulary = load_vocabulary(o.vocabulary or "usv")
    bench: Field | Demands = Field() if o.field else Demands()
    files = case_files(o.cases or ()) if o.field else [o.data or DEMANDS]
    how = {"vocabulary": vocabulary.source, **o.take("quantization", "device")}
    agents = [
        PlanSettings(candidate, configuration=one or None, **how)
        for candidate in names(o.candidates or "embedded")
        for one in names(o.configurations) or [""]
    ]
    folder = o.out or Path("eval/runs") / bench.kind
    with working(folder, PLANS) as progress:
        asked = files, folder, vocabulary, agents, _Plan, progress
        table = run_cases(bench, *asked, **o.take("limit", "resume", "overwrite"))
    terminal().print(terminal_table(table))
    show(f"\n{folder}/: {', '.join(bench.files)}")


class _Plan:
    """Plans a case as `plannerft plan` does; `everywhere` takes open places to be somewhere."""

    def __init__(self, planner: Planner, everywhere: bool) -> None:
        from planner_ft.document.vehicle import load_vehicle

        self.planner, self.everywhere = planner, everywhere
        self.vehicle = load_vehicle(None, planner.vocabulary)

    def __call__(self, case: Case) -> Outcome:
        from planner_ft.benchmark.field.cases import Outcome
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
