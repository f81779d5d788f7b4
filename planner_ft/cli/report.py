"""`plannerft report`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer


def report(
    runs: Annotated[
        list[Path],
        typer.Argument(
            help="Folders of finished runs, or folders that hold some.", show_default=False
        ),
    ],
    out: Annotated[
        Path | None,
        typer.Option(
            help="Folder for report.html, figures/ and tables/.",
            show_default="the run's folder, where there is one",
        ),
    ] = None,
    data: Annotated[
        list[Path] | None,
        typer.Option(
            help="Where test data lies now, if it was moved; its content must be the same.",
            show_default=False,
        ),
    ] = None,
    title: Annotated[
        str, typer.Option(help="Title of the page.", show_default="the runs' names")
    ] = "",
    pictures: Annotated[
        str,
        typer.Option(
            help=(
                "Charts that become files in figures/: all, overall (those over all systems) or"
                " none."
            )
        ),
    ] = "all",
    card: Annotated[
        Path | None,
        typer.Option(
            help=(
                "Adapter folder: write what the runs measured with it into its model card instead."
            ),
            show_default=False,
        ),
    ] = None,
    overwrite: Annotated[
        bool, typer.Option("--overwrite", help="Replace a report that is in --out already.")
    ] = False,
) -> None:
    """Write report.html (one file, opens offline), the figures as PNG and SVG, and the tables as
    Markdown, CSV and LaTeX.
    """
    from planner_ft.support.errors import PlannerError

    if card is not None:
        from planner_ft.report.card import write_card

        count = write_card(card, runs)
        typer.echo(f"{card / 'README.md'}: {count} measured figures")
        return
    if out is None and len(runs) > 1:
        raise PlannerError("--out is missing: with several runs, name a folder for the report")
    from planner_ft.report.write import check_pictures, write_report

    target = out or runs[0]
    written = write_report(
        runs,
        target,
        data=data or (),
        overwrite=overwrite,
        title=title,
        pictures=check_pictures(pictures),
    )
    counts = [sum(path.parent.name == name for path in written) for name in ("figures", "tables")]
    typer.echo(f"{target}/: report.html, figures/ ({counts[0]} files), tables/ ({counts[1]} files)")
