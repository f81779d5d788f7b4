"""`plannerft simulate`."""

from __future__ import annotations

import inspect
from pathlib import Path
from typing import Any

from planner_ft.cli.options import command
from planner_ft.cli.progress import interruptible
from planner_ft.support.errors import PlannerError
from planner_ft.support.terminal import show, terminal


@command
def simulate(
    plan: Path | None = None,
    suite: Path | None = None,
    runs: int = 20,
    seed: int = 0,
    simulator: str = "fast",
    locate: list[str] | None = None,
    start: list[str] | None = None,
    fault: list[str] | None = None,
    goto: str = "guidance",
    survey: str = "waypoints",
    outline: list[str] | None = None,
    tolerance: float = 1.0,
    mcap: int = 1,
    origin: str | None = None,
    log: Path | None = None,
    draft: bool = False,
    vocabulary: str | None = None,
    out: Path | None = None,
    overwrite: bool = False,
) -> None:
    """Run an approved plan in a simulator, or a suite of missions from the command on."""
    options = locals()
    if (plan is None) == (suite is None):
        raise PlannerError("give a plan, or --suite FILE, not both")
    if suite is not None:
        _suite(suite, options)
        return
    assert plan is not None
    from planner_ft.planning.locations import parse_locations
    from planner_ft.simulation.faults import read_faults
    from planner_ft.simulation.outlines import read_outlines
    from planner_ft.simulation.output import outcome_lines, table
    from planner_ft.simulation.run import SimulationSettings
    from planner_ft.simulation.run import simulate as run
    from planner_ft.support.geodesy import parse_origin
    from planner_ft.support.tables import terminal_table

    settings = SimulationSettings(
        *(plan, out, runs, seed, simulator, tolerance),
        locations=parse_locations(locate or []),
        starts=tuple(_place(text) for text in start or ()),
        faults=read_faults(fault or []),
        origin=parse_origin(origin) if origin is not None else None,
        mcap=mcap,
        log=log,
        draft=draft,
        vocabulary=vocabulary,
        overwrite=overwrite,
        goto=goto,
        survey=survey,
        outlines=read_outlines(outline or []),
    )
    with interruptible(lambda: f"{settings.folder} holds the logs so far") as report:
        done = run(settings, report)
    terminal().print(terminal_table(table(done, narrow=True)))
    for line in outcome_lines(done.results):
        show(line)
    if any("nothing found" in one.reason for one in done.results):
        show("what is to be found is placed with --locate NAME=x,y", error=True)
    show(f"{settings.folder}: table.md, tracks.svg, report.html, results.json and a log per run")


def _suite(path: Path, options: dict[str, Any]) -> None:
    """Run a suite, which says everything itself but where to."""
    from planner_ft.simulation.suite import SHORT, read_suite, run_suite, suite_table
    from planner_ft.support.tables import terminal_table

    own = ("plan", "suite", "out", "overwrite")
    for name, item in inspect.signature(simulate).parameters.items():
        if name not in own and options[name] != item.default:
            raise PlannerError(f"--{name}: a suite says this itself; leave it out or edit {path}")
    suite, out = read_suite(path), options["out"] or Path(f"{path.stem}.simulation")
    again = f"{out} holds what is done; the same command goes on"
    with interruptible(lambda: again) as report:
        ran = run_suite(suite, out, report, overwrite=options["overwrite"])
    terminal().print(terminal_table(suite_table(suite, ran, SHORT)))
    show(f"{out}: table.md, table.csv, and a folder per mission with plan, log and runs")


def _place(text: str) -> tuple[float, float]:
    """A --start. Raises PlannerError."""
    try:
        x, y = (float(part) for part in text.split(","))
    except ValueError:
        raise PlannerError(f'--start {text}: expected "x,y" in metres, such as 12,-4') from None
    if not abs(x) + abs(y) < 1e6:
        raise PlannerError(f"--start {text}: must be within 1000 km of home")
    return x, y
