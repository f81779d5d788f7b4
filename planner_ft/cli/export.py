"""`plannerft export` and `simulate`."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import typer

from planner_ft.cli.options import command, typed
from planner_ft.cli.progress import interruptible
from planner_ft.support.errors import PlannerError
from planner_ft.support.terminal import show, terminal

PLAN_FLAGS = ("format", "origin", "log", "draft")
MODEL_FLAGS = ("candidate", "merge", "level", "adapter", "gguf", "outtype", "checks", "check_data")


@command
def export(
    context: typer.Context,
    plan: Path | None = None,
    format: list[str] | None = None,
    origin: str | None = None,
    log: Path | None = None,
    draft: bool = False,
    out: Path | None = None,
    vocabulary: str = "usv",
    overwrite: bool = False,
    candidate: str | None = None,
    merge: bool = False,
    level: str = "mission",
    adapter: str | None = None,
    gguf: bool = False,
    outtype: str = "f32",
    checks: int = 8,
    check_data: Path | None = None,
) -> None:
    """Hand a plan over, or write a candidate as a model for other servers."""
    given = {name for name in (*PLAN_FLAGS, *MODEL_FLAGS, "vocabulary") if _is_given(context, name)}
    _check_kind(plan, given)
    if plan is not None:
        named = vocabulary if "vocabulary" in given else None
        _export_plan(plan, tuple(format or ()), origin, out, log, draft, named, overwrite)
        return
    from planner_ft.model_export.settings import ExportSettings
    from planner_ft.vocabulary.plans import check_level

    if out is None:
        raise PlannerError("--out: a model needs a folder to be written to; give --out DIR")
    matrices: Any = outtype  # checked by the settings
    answers = (matrices, checks, check_data, vocabulary, overwrite)
    assert candidate is not None
    model = (candidate, out, check_level(level), merge, adapter, gguf)
    _export_model(ExportSettings(*model, *answers))


def _is_given(context: typer.Context, name: str) -> bool:
    source = context.get_parameter_source(name)
    return source is not None and source.name == "COMMANDLINE"


def _check_kind(plan: Path | None, given: set[str]) -> None:
    """Raise PlannerError for flags of a model beside a plan, and the reverse, and for neither."""
    wrong = [name for name in (PLAN_FLAGS if plan is None else MODEL_FLAGS) if name in given][:1]
    flag = typed(wrong)
    if wrong and plan is not None:
        problem = f"exports a model, and {plan} is a plan"
        raise PlannerError(f"{flag}: {problem}; leave one of the two out")
    if wrong:
        way_out = f"name the plan's file, as in `plannerft export plan.json {flag} ...`"
        raise PlannerError(f"{flag}: hands a plan over; {way_out}")
    if plan is None and "candidate" not in given:
        ways = "name a plan's file with --format, or a model with --candidate and --out"
        raise PlannerError(f"nothing to export: {ways}")


def _export_plan(plan: Path, formats: tuple[str, ...], origin: str | None, *settings: Any) -> None:
    """`settings` are those of PlanExportSettings after the origin, in their order."""
    from planner_ft.exporters import parse_origin, run

    place = parse_origin(origin) if origin is not None else None
    done = run.export_plan(run.PlanExportSettings(plan, formats, place, *settings))
    for one in done:
        show(f"{one.file}: {run.loss_summary(one.account)} (report: {one.report})")
        for line in run.loss_lines(one.account):
            show(f"  {line}")
    if done[0].origin:
        show(done[0].origin, error=True)


def _export_model(settings: Any) -> None:
    from planner_ft.model_export.run import export as run_export

    done = run_export(settings, lambda line: show(line, error=True))
    check = done.check
    same = f"{check.same} of {check.count} answers as before"
    most = f"logits differ by at most {check.largest_logit_difference:.2g}"
    show(f"{done.folder}: {same}, {most}")
    if done.gguf is not None:
        show(f"{done.gguf}: {done.gguf.stat().st_size / 1e6:.1f} MB")
    model = f"--level {settings.named_adapter[0]} --candidates {done.folder}"
    show(f"next: plannerft bench {model} --configurations base --quantization none")


@command
def simulate(
    plan: Path,
    runs: int = 20,
    seed: int = 0,
    simulator: str = "fast",
    locate: list[str] | None = None,
    start: list[str] | None = None,
    fault: list[str] | None = None,
    tolerance: float = 1.0,
    mcap: int = 1,
    origin: str | None = None,
    log: Path | None = None,
    draft: bool = False,
    vocabulary: str | None = None,
    out: Path | None = None,
    overwrite: bool = False,
) -> None:
    """Run an approved plan in a simulator."""
    from planner_ft.planning.locations import parse_locations
    from planner_ft.simulation.faults import read_faults
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
    )
    with interruptible(lambda: f"{settings.folder} holds the logs so far") as report:
        done = run(settings, report)
    terminal().print(terminal_table(table(done, narrow=True)))
    for line in outcome_lines(done.results):
        show(line)
    if any("nothing found" in one.reason for one in done.results):
        show("what is to be found is placed with --locate NAME=x,y", error=True)
    show(f"{settings.folder}: table.md, tracks.svg, report.html, results.json and a log per run")


def _place(text: str) -> tuple[float, float]:
    """A --start. Raises PlannerError."""
    try:
        x, y = (float(part) for part in text.split(","))
    except ValueError:
        raise PlannerError(f'--start {text}: expected "x,y" in metres, such as 12,-4') from None
    if not abs(x) + abs(y) < 1e6:
        raise PlannerError(f"--start {text}: must be within 1000 km of home")
    return x, y
