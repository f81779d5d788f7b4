"""`plannerft gen-data`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer


def gen_data(
    level: Annotated[
        str,
        typer.Option(
            help="mission (commands to tasks, curated), task (tasks to skills, sampled) or all."
        ),
    ] = "all",
    out: Annotated[Path, typer.Option(help="Folder for mission/ and task/.")] = Path("data"),
    seed: Annotated[int, typer.Option(help="Seed of the sampled set; same seed, same bytes.")] = 0,
    train: Annotated[
        int | None, typer.Option(help="Training records.", show_default="125 mission, 10000 task")
    ] = None,
    validation: Annotated[
        int | None, typer.Option(help="Validation records.", show_default="25 mission, 500 task")
    ] = None,
    test: Annotated[
        int | None,
        typer.Option(
            help="Test records; at task level test_unseen gets as many.",
            show_default="25 mission, 500 task",
        ),
    ] = None,
    synthetic: Annotated[
        int | None,
        typer.Option(
            help="Also N synthetic commands with their plans, in OUT/mission-synthetic.",
            show_default=False,
        ),
    ] = None,
    vocabulary: Annotated[
        str, typer.Option(help="Vocabulary: a bundled name or a TOML file.")
    ] = "usv",
    source: Annotated[
        Path | None,
        typer.Option(
            help="Folder with the curated mission set.",
            show_default="data/mission, or the copy in the package",
        ),
    ] = None,
    overwrite: Annotated[
        bool, typer.Option("--overwrite", help="Replace data in --out that is different.")
    ] = False,
    chat: Annotated[
        bool,
        typer.Option(
            "--chat",
            help="Also write chat/SPLIT.jsonl with `messages`, the form that TRL and others take.",
        ),
    ] = False,
) -> None:
    """Make the training data: the curated mission set, checked and converted, and the sampled task
    set.

    Each level gets train, validation and test (task also test_unseen, whose phrasings occur nowhere
    else) as JSONL, a dataset card (README.md), a leakage report (leakage.json) and a manifest.
    """
    from rich.console import Console
    from rich.progress import (
        BarColumn,
        MofNCompleteColumn,
        Progress,
        TaskID,
        TextColumn,
        TimeElapsedColumn,
    )

    from planner_ft.data.generate import GenerationSettings, generate
    from planner_ft.prompts.chat import chat_messages

    settings = GenerationSettings(
        level, out, seed, train, validation, test, vocabulary, source, overwrite, chat, synthetic
    )
    bars: dict[str, TaskID] = {}
    columns = (
        TextColumn("{task.description:<34}"),
        BarColumn(),
        MofNCompleteColumn(),
        TimeElapsedColumn(),
    )
    with Progress(*columns, console=Console(stderr=True), transient=True) as shown:

        def progress(label: str, done: int, total: int) -> None:
            if label not in bars:
                bars[label] = shown.add_task(label, total=total or None)
            shown.update(bars[label], completed=done, total=total or None)

        results = generate(settings, progress, chat_messages)
    for result in results:
        counts = ", ".join(f"{split} {count}" for split, count in result.counts.items())
        typer.echo(f"{result.folder}: {counts}{'' if result.written else ' (up to date)'}")
        typer.echo(
            "  "
            + ", ".join(
                f"{stage} {seconds:.1f} s{_rate(stage, seconds, result.counts)}"
                for stage, seconds in result.seconds.items()
            )
        )


def _rate(stage: str, seconds: float, counts: dict[str, int]) -> str:
    return (
        f" ({sum(counts.values()) / seconds:.0f} records/s)"
        if stage.startswith("sampling") and seconds
        else ""
    )
