"""`plannerft vocabulary`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer


def vocabulary(
    vocabulary: Annotated[
        str, typer.Option(help="Vocabulary: a bundled name or a TOML file.")
    ] = "usv",
    schemas: Annotated[
        Path | None,
        typer.Option(help="Write the JSON Schemas into this folder.", show_default=False),
    ] = None,
    docs: Annotated[
        Path | None,
        typer.Option(help="Write the documentation page to this file.", show_default=False),
    ] = None,
    check: Annotated[
        bool,
        typer.Option(
            "--check", help="Write nothing; exit with 1 when a schema or the page is stale."
        ),
    ] = False,
) -> None:
    """Show the vocabulary, or write the schemas and the documentation page that derive from it."""
    from planner_ft.support.files import write_text
    from planner_ft.vocabulary import load_vocabulary
    from planner_ft.vocabulary.schema import stale_schemas, write_schemas
    from planner_ft.vocabulary.text import documentation_page, stale_page

    definition = load_vocabulary(vocabulary)
    if check:
        folder, page = schemas or Path("schemas"), docs or Path("docs") / "vocabulary.md"
        stale = [str(folder / name) for name in stale_schemas(folder, definition)] + (
            [str(page)] if stale_page(page, definition) else []
        )
        for name in stale:
            typer.echo(
                f"{name}: stale; write it again with plannerft vocabulary --schemas {folder} --docs"
                f" {page}"
            )
        raise typer.Exit(1 if stale else 0)
    if schemas is not None:
        for path in write_schemas(schemas, definition):
            typer.echo(str(path))
    if docs is not None:
        write_text(docs, documentation_page(definition))
        typer.echo(str(docs))
    if schemas is None and docs is None:
        _show(documentation_page(definition))


def _show(page: str) -> None:
    import sys

    if not sys.stdout.isatty():
        typer.echo(page, nl=False)
        return
    from rich.console import Console
    from rich.markdown import Markdown

    Console().print(Markdown(page.replace("<br>", "; ")))
