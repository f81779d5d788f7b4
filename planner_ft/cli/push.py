"""`plannerft push`."""

from __future__ import annotations

from pathlib import Path

from planner_ft.cli.options import command
from planner_ft.support.terminal import show


@command
def push(
    folder: Path,
    repo: str,
    dataset: str | None = None,
    private: bool = False,
    dry_run: bool = False,
) -> None:
    """Upload an adapter or a data set to the Hugging Face Hub."""
    from planner_ft.model_export.hub import prepare, upload

    prepared = prepare(folder, repo, dataset)
    for note in prepared.notes:
        show(f"note: {note}", error=True)
    if dry_run:
        for name, size in prepared.sizes():
            show(f"{size:>12,} bytes  {name}")
        show(f"{len(prepared.files)} files for {prepared.page} ({prepared.kind}); nothing was sent")
        return
    show(upload(prepared, private=private))
