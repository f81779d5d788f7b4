"""`plannerft export`."""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path
from typing import Any

import typer

from planner_ft.cli.options import command, typed
from planner_ft.support.errors import PlannerError, QuestionError
from planner_ft.support.terminal import show

PLAN_FLAGS = ("format", "origin", "log", "draft", "origin_is_right")
MODEL_FLAGS = ("candidate", "merge", "level", "adapter", "gguf", "outtype", "checks", "check_data")


@command
def export(context: typer.Context, plan: Path | None = None, **options: Any) -> None:
    """Hand a plan over, or write a candidate as a model for other servers."""
    every = (*PLAN_FLAGS, *MODEL_FLAGS, "vocabulary")
    given = {name: options[name] for name in every if _is_given(context, name)}
    _check_kind(plan, given)
    shared = {name: options[name] for name in ("out", "overwrite")}
    if plan is not None:
        _export_plan(plan, {**given, **shared})
        return
    from planner_ft.model_export import ExportSettings
    from planner_ft.vocabulary.plans import check_level

    if options["out"] is None:
        raise PlannerError("--out: a model needs a folder to be written to; give --out DIR")
    model = {name: options[name] for name in (*MODEL_FLAGS, "vocabulary")} | shared
    model |= {"level": check_level(options["level"]), "data": model.pop("check_data")}
    _export_model(ExportSettings(**model))


def _is_given(context: typer.Context, name: str) -> bool:
    source = context.get_parameter_source(name)
    return source is not None and source.name == "COMMANDLINE"


def _check_kind(plan: Path | None, given: dict[str, Any]) -> None:
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


def _export_plan(plan: Path, given: dict[str, Any]) -> None:
    from planner_ft.exporters import parse_origin, run

    formats, origin = tuple(given.pop("format", None) or ()), given.pop("origin", None)
    given["sure"] = given.pop("origin_is_right", False)
    place = parse_origin(origin) if origin is not None else None
    asked = run.PlanExportSettings(plan, formats, place, **given)
    try:
        done = run.export_plan(asked)
    except QuestionError as error:
        if not (sys.stdin.isatty() and sys.stdout.isatty()):
            raise
        if not typer.confirm(error.question):
            raise PlannerError("nothing was written; give the right --origin LAT,LON") from None
        done = run.export_plan(replace(asked, sure=True))
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
