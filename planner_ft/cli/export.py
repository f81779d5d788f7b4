"""`plannerft export`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer

A_PLAN, A_MODEL = "A plan", "A model"
PLAN_FLAGS = ("format", "origin", "log", "draft")
MODEL_FLAGS = ("candidate", "merge", "level", "adapter", "gguf", "outtype", "checks", "check_data")


def export(
    context: typer.Context,
    plan: Annotated[
        Path | None,
        typer.Argument(
            help="A plan that `plannerft plan --out` wrote; without it a model is exported.",
            show_default=False,
        ),
    ] = None,
    format: Annotated[
        list[str] | None,
        typer.Option(
            help="qgc, waypoints, geojson, bt, moos, one that a package adds, or all. Repeatable.",
            show_default=False,
            rich_help_panel=A_PLAN,
        ),
    ] = None,
    origin: Annotated[
        str | None,
        typer.Option(
            help='"LAT,LON": where the plan\'s [0, 0] lies.',
            show_default=False,
            rich_help_panel=A_PLAN,
        ),
    ] = None,
    log: Annotated[
        Path | None,
        typer.Option(
            help="Approval log.",
            show_default="approvals.jsonl beside the plan",
            rich_help_panel=A_PLAN,
        ),
    ] = None,
    draft: Annotated[
        bool,
        typer.Option(
            "--draft",
            help="Hand over a plan that is not approved; the file says so.",
            rich_help_panel=A_PLAN,
        ),
    ] = False,
    out: Annotated[
        Path | None,
        typer.Option(
            help="The file of a plan, or the folder of a model.",
            show_default="a plan's name with the format's extension",
        ),
    ] = None,
    vocabulary: Annotated[
        str,
        typer.Option(
            help="Vocabulary: a bundled name or a TOML file.",
            show_default="the plan's own; usv for a model",
        ),
    ] = "usv",
    overwrite: Annotated[
        bool, typer.Option("--overwrite", help="Replace what was exported before.")
    ] = False,
    candidate: Annotated[
        str | None,
        typer.Option(
            help="A name that `plannerft candidates` lists, a folder, or a hub id.",
            show_default=False,
            rich_help_panel=A_MODEL,
        ),
    ] = None,
    merge: Annotated[
        bool,
        typer.Option(
            "--merge", help="Fold the adapter of --level into the weights.", rich_help_panel=A_MODEL
        ),
    ] = False,
    level: Annotated[
        str,
        typer.Option(
            help=(
                "mission or task: whose adapter is folded in, and with which commands answers are"
                " checked."
            ),
            rich_help_panel=A_MODEL,
        ),
    ] = "mission",
    adapter: Annotated[
        str | None,
        typer.Option(
            help="Adapter folder, or LEVEL=DIR.",
            show_default="the candidate's",
            rich_help_panel=A_MODEL,
        ),
    ] = None,
    gguf: Annotated[
        bool,
        typer.Option(
            "--gguf",
            help="Write a GGUF file for llama.cpp, too (Llama and Qwen2).",
            rich_help_panel=A_MODEL,
        ),
    ] = False,
    outtype: Annotated[
        str, typer.Option(help="Matrices in the GGUF file: f32 or f16.", rich_help_panel=A_MODEL)
    ] = "f32",
    checks: Annotated[
        int,
        typer.Option(help="Commands that are answered before and after.", rich_help_panel=A_MODEL),
    ] = 8,
    check_data: Annotated[
        Path | None,
        typer.Option(
            help="JSONL with the commands to answer.",
            show_default="the level's validation set",
            rich_help_panel=A_MODEL,
        ),
    ] = None,
) -> None:
    """Hand an approved plan over in a format that vehicles read, or write a candidate as a model
    that other servers load.

    A plan: a report beside each file says what the format cannot hold. A model: a float32 folder
    with the adapter merged, and a GGUF file; answers are compared before and after, and when one
    differs, nothing is written.
    """
    given = {name for name in (*PLAN_FLAGS, *MODEL_FLAGS, "vocabulary") if _is_given(context, name)}
    _check_kind(plan, given)
    if plan is not None:
        _export_plan(
            plan,
            format or [],
            origin,
            out,
            log,
            draft,
            vocabulary if "vocabulary" in given else None,
            overwrite,
        )
        return
    from planner_ft.model_export.settings import ExportSettings
    from planner_ft.vocabulary.plans import check_level

    known: Any = outtype  # checked by the settings
    assert candidate is not None
    folder = _required_out(out)
    _export_model(
        ExportSettings(
            candidate,
            folder,
            check_level(level),
            merge,
            adapter,
            gguf,
            known,
            checks,
            check_data,
            vocabulary,
            overwrite,
        )
    )


def _is_given(context: typer.Context, name: str) -> bool:
    source = context.get_parameter_source(name)
    return source is not None and source.name == "COMMANDLINE"


def _check_kind(plan: Path | None, given: set[str]) -> None:
    """Raise PlannerError for flags of a model beside a plan, flags of a plan without one, and for
    neither plan nor model.
    """
    from planner_ft.support.errors import PlannerError

    if plan is not None:
        wrong = next((name for name in MODEL_FLAGS if name in given), None)
        if wrong:
            raise PlannerError(
                f"{_flag(wrong)}: exports a model, and {plan} is a plan; leave one of the two out"
            )
        return
    wrong = next((name for name in PLAN_FLAGS if name in given), None)
    if wrong:
        raise PlannerError(
            f"{_flag(wrong)}: hands a plan over; name the plan's file, as in `plannerft export"
            f" plan.json {_flag(wrong)} ...`"
        )
    if "candidate" not in given:
        raise PlannerError(
            "nothing to export: name a plan's file with --format, or a model with --candidate and"
            " --out"
        )


def _flag(name: str) -> str:
    return "--" + name.replace("_", "-")


def _required_out(out: Path | None) -> Path:
    from planner_ft.support.errors import PlannerError

    if out is None:
        raise PlannerError("--out: a model needs a folder to be written to; give --out DIR")
    return out


def _export_plan(
    plan: Path,
    formats: list[str],
    origin: str | None,
    out: Path | None,
    log: Path | None,
    draft: bool,
    vocabulary: str | None,
    overwrite: bool,
) -> None:
    from planner_ft.exporters.geodesy import parse_origin
    from planner_ft.exporters.losses import loss_lines, loss_summary
    from planner_ft.exporters.run import PlanExportSettings, export_plan

    place = parse_origin(origin) if origin is not None else None
    for one in export_plan(
        PlanExportSettings(plan, tuple(formats), place, out, log, draft, vocabulary, overwrite)
    ):
        typer.echo(f"{one.file}: {loss_summary(one.account)} (report: {one.report})")
        for line in loss_lines(one.account):
            typer.echo(f"  {line}")


def _export_model(settings: Any) -> None:
    from planner_ft.model_export.run import export as run_export

    done = run_export(settings, lambda line: typer.echo(line, err=True))
    check = done.check
    typer.echo(
        f"{done.folder}: {check.same} of {check.count} answers as before, logits differ by at most"
        f" {check.largest_logit_difference:.2g}"
    )
    if done.gguf is not None:
        typer.echo(f"{done.gguf}: {done.gguf.stat().st_size / 1e6:.1f} MB")
    typer.echo(
        f"next: plannerft bench --level {settings.named_adapter[0]} --candidates {done.folder}"
        " --configurations base --quantization none"
    )
