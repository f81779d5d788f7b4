"""`plannerft export` and `plannerft push`."""

from __future__ import annotations

import sys
from dataclasses import replace
from typing import Any

import typer

from planner_ft.cli.options import Options, command, typed
from planner_ft.support.errors import PlannerError, QuestionError
from planner_ft.support.terminal import show

PLAN_FLAGS = ("format", "origin", "log", "draft", "origin_is_right")
MODEL_FLAGS = ("candidate", "merge", "level", "adapter", "gguf", "outtype", "checks", "check_data")


@command
def export(o: Options) -> None:
    """Hand a plan over, or write a candidate as a model for other servers."""
    wrong = list(o.given(*(PLAN_FLAGS if o.plan is None else MODEL_FLAGS)))[:1]
    flag, shared = typed(wrong), o.given("vocabulary", "out", "overwrite")
    if wrong and o.plan is not None:
        problem = f"exports a model, and {o.plan} is a plan"
        raise PlannerError(f"{flag}: {problem}; leave one of the two out")
    if wrong:
        way_out = f"name the plan's file, as in `plannerft export plan.json {flag} ...`"
        raise PlannerError(f"{flag}: hands a plan over; {way_out}")
    if o.plan is not None:
        _export_plan(o, shared)
        return
    if o.candidate is None:
        ways = "name a plan's file with --format, or a model with --candidate and --out"
        raise PlannerError(f"nothing to export: {ways}")
    if o.out is None:
        raise PlannerError("--out: a model needs a folder to be written to; give --out DIR")
    _export_model(o.given(*MODEL_FLAGS) | shared)


def _export_plan(o: Options, shared: dict[str, Any]) -> None:
    from planner_ft.exporters import parse_origin, run

    place = parse_origin(o.origin) if o.origin is not None else None
    how = o.given("log", "draft") | shared
    asked = run.PlanExportSettings(
        o.plan, tuple(o.format or ()), place, sure=o.origin_is_right, **how
    )
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


def _export_model(given: dict[str, Any]) -> None:
    from planner_ft.model_export import ExportSettings
    from planner_ft.model_export.run import export as run_export
    from planner_ft.vocabulary.plans import check_level

    named = {"level": check_level(given.pop("level", "mission"))}
    settings = ExportSettings(data=given.pop("check_data", None), **given | named)
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
def push(o: Options) -> None:
    """Upload an adapter or a data set to the Hugging Face Hub."""
    from planner_ft.model_export.hub import prepare, upload

    prepared = prepare(o.folder, o.repo, o.dataset)
    for note in prepared.notes:
        show(f"note: {note}", error=True)
    if not o.dry_run:
        show(upload(prepared, private=o.private))
        return
    for name, size in prepared.sizes():
        show(f"{size:>12,} bytes  {name}")
    show(f"{len(prepared.files)} files for {prepared.page} ({prepared.kind}); nothing was sent")
