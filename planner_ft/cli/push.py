"""`plannerft push`."""

from __future__ import annotations

from planner_ft.cli.options import Options, command
from planner_ft.support.terminal import show


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
