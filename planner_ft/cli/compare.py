"""`plannerft compare`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer


def compare(
    runs: Annotated[
        list[Path],
        typer.Argument(
            help="Folders of `plannerft bench` or `plannerft score --out`.", show_default=False
        ),
    ],
    metric: Annotated[
        list[str] | None,
        typer.Option(
            help="Metric of results.json; once for each.",
            show_default="f1, exact_sequence, parameters, whole_plan, hallucination, strict_valid",
        ),
    ] = None,
    against: Annotated[
        str | None,
        typer.Option(
            help="The row that all others are compared with, or a part of its name.",
            show_default="the first row of the first run",
        ),
    ] = None,
    same: Annotated[
        bool,
        typer.Option(
            "--same",
            help="Compare each row with the row of the same name in the first run instead.",
        ),
    ] = False,
    common: Annotated[
        bool,
        typer.Option(
            "--common", help="Allow different data files: compare the samples whose ids all have."
        ),
    ] = False,
    out: Annotated[
        Path | None,
        typer.Option(
            help="Folder for comparison.json, .md, .csv and .tex.", show_default="print only"
        ),
    ] = None,
    overwrite: Annotated[
        bool, typer.Option("--overwrite", help="Replace a comparison that is in --out already.")
    ] = False,
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON.")] = False,
    seed: Annotated[int, typer.Option(help="Seed of the resamples.")] = 0,
) -> None:
    """Compare rows of finished runs, paired by sample: difference, 95 % interval, p adjusted after
    Holm, and a verdict in words.

    Without --against, every row is compared with the first row of the first run. No model is
    needed.
    """
    from rich.console import Console

    from planner_ft.benchmark.compare import DEFAULT_METRICS, CompareSettings, compare_runs
    from planner_ft.benchmark.compare_text import print_report, render_report
    from planner_ft.benchmark.folder import check_folder
    from planner_ft.support.errors import PlannerError
    from planner_ft.support.files import indented_json, write_json, write_text

    if same and against is not None:
        raise PlannerError(
            f"--same compares rows of the same name and --against {against} one row with all: give"
            " one of them"
        )
    if out is not None:
        check_folder(
            out, () if overwrite else ("comparison.json",), "give --overwrite or another --out"
        )
    report = compare_runs(
        CompareSettings(tuple(runs), tuple(metric or DEFAULT_METRICS), against, same, common, seed)
    )
    if out is not None:
        for name, text in render_report(report).items():
            write_text(out / name, text)
        write_json(out / "comparison.json", report.to_json())
    if as_json:
        typer.echo(indented_json(report.to_json()), nl=False)
    else:
        print_report(report, Console())
