"""`plannerft bench` and `plannerft score`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

LEVEL = Annotated[str, typer.Option(help="mission (commands to tasks) or task (tasks to skills).", show_default=False)]
VOCABULARY = Annotated[str, typer.Option(help="Vocabulary: a bundled name or a TOML file.")]
SEED = Annotated[int, typer.Option(help="Seed of the bootstrap intervals.")]


def score(
    level: LEVEL,
    predictions: Annotated[Path, typer.Option(help="JSONL with id and output per line; candidate, configuration, tokens and latency_s are used if given.")],
    data: Annotated[Path | None, typer.Option(help="Test data that the predictions were made for.", show_default="data/LEVEL/test.jsonl")] = None,
    out: Annotated[Path | None, typer.Option(help="Folder for results.json and the tables; without it the table is only printed.", show_default=False)] = None,
    name: Annotated[str | None, typer.Option(help="The system's name in the table, where lines name no candidate.", show_default="the file's name")] = None,
    vocabulary: VOCABULARY = "usv",
    seed: SEED = 0,
    overwrite: Annotated[bool, typer.Option("--overwrite", help="Replace results that are in --out already.")] = False,
) -> None:
    """Score any system's outputs. No model is needed; a sample without a prediction counts as an empty output."""
    from planner_ft.benchmark import folder
    from planner_ft.benchmark.samples import default_data, load_bench_data
    from planner_ft.benchmark.submission import score_predictions
    from planner_ft.vocabulary import load_vocabulary
    from planner_ft.vocabulary.plans import check_level

    checked, definition = check_level(level), load_vocabulary(vocabulary)
    if out is not None:
        folder.check_folder(out, () if overwrite else folder.SCORED, "give --overwrite or another --out")
    results = score_predictions(predictions, load_bench_data(data or default_data(checked), checked, definition), definition, seed=seed, name=name)
    _show(results, out)
    if out is not None:
        folder.write_results(out, results)


def _show(results: object, out: Path | None) -> None:
    """Print the table, the samples without prediction and where the files lie."""
    from rich.console import Console

    from planner_ft.benchmark.results import Results
    from planner_ft.benchmark.terminal import print_missing, print_results

    assert isinstance(results, Results)
    print_results(results, Console())
    print_missing(results, Console(stderr=True))
    if out is not None:
        typer.echo(f"\n{out}/: results.json, scores.jsonl, table.md, table.csv, table.tex")
