"""`plannerft validate`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer


def validate(
    files: Annotated[
        list[Path],
        typer.Argument(
            help=(
                "JSONL or JSON: datasets (expected), predictions (output) or plans, told apart by"
                " their content."
            )
        ),
    ],
    vocabulary: Annotated[
        str, typer.Option(help="Vocabulary: a bundled name or a TOML file.")
    ] = "usv",
    level: Annotated[
        str | None,
        typer.Option(
            help="mission or task, where the content must be of that level.",
            show_default="what the content says",
        ),
    ] = None,
    complete: Annotated[
        bool,
        typer.Option(
            "--complete",
            help="Ask of records what the curated set has: family, spans, tags, all texts.",
        ),
    ] = False,
) -> None:
    """Check files against form, vocabulary and the labelling rules that a program can check.

    Every problem is printed as FILE:LINE: what is wrong. Exits with 0 when there is none, 1 when
    there are some, 2 when a file cannot be read.
    """
    from planner_ft.data.validation import validate_file
    from planner_ft.support.errors import PlannerError
    from planner_ft.vocabulary import load_vocabulary
    from planner_ft.vocabulary.plans import check_level

    definition, checked = load_vocabulary(vocabulary), check_level(level) if level else None
    status = 0
    for path in files:
        try:
            report = validate_file(path, definition, checked, complete=complete)
        except PlannerError as error:
            typer.echo(f"plannerft: {error}", err=True)
            status = 2
            continue
        for problem in report.problems:
            typer.echo(str(problem))
        held = (
            ", ".join(
                f"{count} {kind}{'s' if count > 1 else ''}" for kind, count in report.counts.items()
            )
            or "nothing"
        )
        typer.echo(
            f"{path}: {held}:"
            f" {f'{len(report.problems)} problems' if report.problems else 'no problems'}",
            err=True,
        )
        status = max(status, 1 if report.problems else 0)
    raise typer.Exit(status)
