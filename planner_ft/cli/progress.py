"""Progress of a benchmark run: bars with the time left on a terminal, lines now and then
elsewhere.
"""

from __future__ import annotations

import contextlib
import shlex
import signal
import sys
import threading
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import typer

if TYPE_CHECKING:
    from rich.console import Console

Report = Callable[[str, int, int], None]
EVERY = 30.0
"""Seconds between lines where there is no terminal."""


@contextlib.contextmanager
def interruptible(folder: Path | None) -> Iterator[Report]:
    """Show progress of the block; after Ctrl-C say what is kept and how to go on, and exit with
    130.
    """
    from rich.console import Console

    console = Console(stderr=True, highlight=False)
    try:
        with (
            _not_swallowed() as stopped,
            _bars(console) if console.is_terminal else _lines(console) as report,
        ):

            def reporting(label: str, done: int, total: int) -> None:
                if stopped():
                    raise KeyboardInterrupt
                report(label, done, total)

            yield reporting
    except KeyboardInterrupt:
        console.print(
            f"interrupted{f'; {_kept(folder)}' if folder else ''}", soft_wrap=True, markup=False
        )
        raise typer.Exit(130) from None


@contextlib.contextmanager
def _not_swallowed() -> Iterator[Callable[[], bool]]:
    """Yield a function that says whether Ctrl-C was pressed: libraries swallow a KeyboardInterrupt
    while they load.
    """
    pressed = threading.Event()
    if threading.current_thread() is not threading.main_thread():
        yield pressed.is_set
        return
    before = signal.getsignal(signal.SIGINT)

    def press(_number: int, _frame: object) -> None:
        pressed.set()
        raise KeyboardInterrupt

    if before is not signal.SIG_IGN:
        signal.signal(signal.SIGINT, press)
    try:
        yield pressed.is_set
    finally:
        signal.signal(signal.SIGINT, before)


@contextlib.contextmanager
def _bars(console: Console) -> Iterator[Report]:
    from rich.progress import (
        BarColumn,
        MofNCompleteColumn,
        Progress,
        SpinnerColumn,
        TaskID,
        TextColumn,
        TimeElapsedColumn,
        TimeRemainingColumn,
    )

    columns = (
        SpinnerColumn(),
        TextColumn("{task.description}"),
        BarColumn(bar_width=20),
        MofNCompleteColumn(),
        TimeElapsedColumn(),
        TextColumn("left"),
        TimeRemainingColumn(),
    )
    bars: dict[str, TaskID] = {}
    with Progress(*columns, console=console, transient=True) as shown:

        def report(label: str, done: int, total: int) -> None:
            if label not in bars:
                for task in bars.values():
                    shown.stop_task(task)
                bars[label] = shown.add_task(label, total=total or None)
            shown.update(bars[label], completed=done, total=total or None)

        yield report


@contextlib.contextmanager
def _lines(console: Console) -> Iterator[Report]:
    begun: dict[str, tuple[float, int]] = {}
    last = 0.0

    def report(label: str, done: int, total: int) -> None:
        nonlocal last
        now = time.monotonic()
        first = label not in begun
        started, before = begun.setdefault(label, (now, done))
        if not (first or done == total or now - last >= EVERY):
            return
        last = now
        left = (now - started) / (done - before) * (total - done) if done > before else None
        rest = f", {left:.0f} s left" if left else ""
        console.print(
            f"{label}{f' {done}/{total}' if total else ''}{rest}", soft_wrap=True, markup=False
        )

    yield report


def _kept(folder: Path) -> str:
    from planner_ft.benchmark.runner import resume_hint

    arguments = [
        argument for argument in sys.argv[1:] if argument not in ("--overwrite", "--resume")
    ]
    return f"{resume_hint(folder)}; go on with: {shlex.join(['plannerft', *arguments, '--resume'])}"
