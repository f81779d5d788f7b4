"""`plannerft bench --suite FILE`."""

from __future__ import annotations

import contextlib
import shlex
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer

if TYPE_CHECKING:
    from planner_ft.benchmark.suite.session import State

EVERY = 30.0
"""Seconds between lines where there is no terminal."""


def bench_suite(
    path: Path,
    out: Path | None,
    values: dict[str, Any],
    *,
    resume: bool,
    overwrite: bool,
    finish: Callable[[Path], None] | None = None,
) -> None:
    """Run a suite, print its overview, call `finish` with its folder, and exit with 1 when a
    candidate could not be measured.
    """
    from planner_ft.benchmark.suite.definition import load_suite
    from planner_ft.benchmark.suite.run import run_suite
    from planner_ft.benchmark.suite.units import Flags
    from planner_ft.support.errors import IncompleteError, PlannerError

    if resume and overwrite:
        raise PlannerError(
            "--resume keeps former results and --overwrite removes them: give one of them"
        )
    suite = load_suite(path)
    folder = out or Path("eval/runs") / path.stem
    try:
        with _shown() as report:
            parts = run_suite(
                suite, folder, Flags(**values), report, resume=resume, overwrite=overwrite
            )
    except KeyboardInterrupt:
        again = [
            argument for argument in sys.argv[1:] if argument not in ("--overwrite", "--resume")
        ]
        typer.echo(
            f"interrupted; go on with: {shlex.join(['plannerft', *again, '--resume'])}", err=True
        )
        raise typer.Exit(130) from None
    typer.echo((folder / "table.md").read_text(encoding="utf-8"))
    typer.echo(
        f"{folder}/: table.md, table.csv, table.tex, results.json; a folder for each of"
        f" {', '.join(part.part.name for part in parts)}"
    )
    if finish is not None:
        finish(folder)
    failed = [
        f"{entry.candidate} {entry.configuration} ({part.part.name})"
        for part in parts
        for entry in part.failed
    ]
    if failed:
        raise IncompleteError(
            f"{len(failed)} of the suite could not be measured: {', '.join(failed)}; the reasons"
            f" are in {folder / 'table.md'}"
        )


@contextlib.contextmanager
def _shown() -> Iterator[Callable[[State], None]]:
    """Show where a suite stands: one line that changes on a terminal, a line now and then
    elsewhere.
    """
    from rich.console import Console

    console = Console(stderr=True, highlight=False)
    if console.is_terminal:
        with console.status("starting") as status:
            yield lambda state: status.update(state_line(state))
        return
    last: dict[str, Any] = {"unit": 0, "time": 0.0}

    def report(state: State) -> None:
        now = time.monotonic()
        if state.unit != last["unit"] or now - last["time"] >= EVERY:
            last.update(unit=state.unit, time=now)
            console.print(state_line(state), soft_wrap=True, markup=False)

    yield report


def state_line(state: State) -> str:
    """Where a suite stands, in a line."""
    from planner_ft.support.resources import clock

    left = f", {clock(state.left)} left in all" if state.left is not None else ""
    return f"({state.unit}/{state.units}) {state.name}: {state.done}/{state.total} queries{left}"
