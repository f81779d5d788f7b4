"""`plannerft export`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer


def export(
    candidate: Annotated[str, typer.Option(help="A name that `plannerft candidates` lists, a folder, or a hub id.", show_default=False)],
    out: Annotated[Path, typer.Option(help="Folder of the exported model.", show_default=False)],
    merge: Annotated[bool, typer.Option("--merge", help="Fold the adapter of --level into the weights.")] = False,
    level: Annotated[str, typer.Option(help="mission or task: whose adapter is folded in, and with which commands answers are checked.")] = "mission",
    adapter: Annotated[str | None, typer.Option(help="Adapter folder, or LEVEL=DIR.", show_default="the candidate's")] = None,
    gguf: Annotated[bool, typer.Option("--gguf", help="Write a GGUF file for llama.cpp, too (Llama and Qwen2).")] = False,
    outtype: Annotated[str, typer.Option(help="Matrices in the GGUF file: f32 or f16.")] = "f32",
    checks: Annotated[int, typer.Option(help="Commands that are answered before and after.")] = 8,
    check_data: Annotated[Path | None, typer.Option(help="JSONL with the commands to answer.", show_default="the level's validation set")] = None,
    vocabulary: Annotated[str, typer.Option(help="Vocabulary: a bundled name or a TOML file.")] = "usv",
    overwrite: Annotated[bool, typer.Option("--overwrite", help="Replace a model that was exported to --out before.")] = False,
) -> None:
    """Write a candidate, with its adapter merged, as a float32 model folder and a GGUF file that other servers load.

    Answers are compared before and after; when one differs, nothing is written.
    """
    from planner_ft.export.settings import ExportSettings
    from planner_ft.vocabulary.plans import check_level

    known: Any = outtype  # checked by the settings
    settings = ExportSettings(candidate, out, check_level(level), merge, adapter, gguf, known, checks, check_data, vocabulary, overwrite)
    from planner_ft.export.run import export as run_export

    done = run_export(settings, lambda line: typer.echo(line, err=True))
    check = done.check
    typer.echo(f"{done.folder}: {check.same} of {check.count} answers as before, logits differ by at most {check.largest_logit_difference:.2g}")
    if done.gguf is not None:
        typer.echo(f"{done.gguf}: {done.gguf.stat().st_size / 1e6:.1f} MB")
    typer.echo(f"next: plannerft bench --level {settings.named_adapter[0]} --candidates {done.folder} --configurations base --quantization none")
