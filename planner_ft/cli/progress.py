"""Progress of a long command: bars on a terminal, lines elsewhere; and what Ctrl-C leaves."""

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

from planner_ft.support.alone import alone
from planner_ft.support.terminal import Report, terminal

if TYPE_CHECKING:
    from rich.console import Console

EVERY = 30.0
"""Seconds between lines where there is no terminal."""


@contextlib.contextmanager
def interruptible(kept: Callable[[], str] | None = None, *, lines: bool = True) -> Iterator[Report]:
    """Show progress (without `lines` on terminals alone); after Ctrl-C print `kept`, exit 130."""
    with (
        _interruptible(kept) as (console, stopped),
        (_bars if console.is_terminal else _lines)(console) as report,
    ):

        def reporting(label: str, done: int, total: int) -> None:
            if stopped.is_set():
                raise KeyboardInterrupt
            if lines or console.is_terminal:
                report(label, done, total)

        yield reporting


@contextlib.contextmanager
def status(kept: Callable[[], str]) -> Iterator[Callable[[object, str], None]]:
    """As `interruptible`, with one line of text that changes, for a step."""
    with _interruptible(kept) as (console, _stopped):
        if console.is_terminal:
            with console.status("starting") as line:
                yield lambda _step, text: line.update(text)
            return
        due = _Due()

        def report(step: object, text: str) -> None:
            if due(step):
                console.print(text, soft_wrap=True, markup=False)

        yield report


@contextlib.contextmanager
def working(folder: Path, log: str, *, keeps: bool = True) -> Iterator[Report]:
    """Hold the --out of a benchmark, show progress, and say after Ctrl-C what its `log` keeps."""
    from planner_ft.benchmark.folder import kept

    again = (lambda: f"{kept(folder / log)}; go on with: {resume_command()}") if keeps else None
    with alone(folder, "--out", "a benchmark"), interruptible(again) as report:
        yield report


def resume_command() -> str:
    """The command line of this process with --resume instead of --overwrite."""
    words = [word for word in sys.argv[1:] if word not in ("--overwrite", "--resume")]
    return shlex.join(["plannerft", *words, "--resume"])


@contextlib.contextmanager
def _interruptible(kept: Callable[[], str] | None) -> Iterator[tuple[Console, threading.Event]]:
    """A console, and an event that Ctrl-C sets: libraries swallow KeyboardInterrupt."""
    console, pressed = terminal(stderr=True), threading.Event()

    def press(_number: int, _frame: object) -> None:
        pressed.set()
        raise KeyboardInterrupt

    before = signal.getsignal(signal.SIGINT)
    is_ours = threading.current_thread() is threading.main_thread() and before != signal.SIG_IGN
    if is_ours:
        signal.signal(signal.SIGINT, press)
    try:
        yield console, pressed
    except KeyboardInterrupt:
        text = f"interrupted{f'; {kept()}' if kept else ''}"
        console.print(text, soft_wrap=True, markup=False)
        raise typer.Exit(130) from None
    finally:
        if is_ours:
            signal.signal(signal.SIGINT, before)


@contextlib.contextmanager
def _bars(console: Console) -> Iterator[Report]:
    from rich import progress

    columns = (
        progress.SpinnerColumn(),
        progress.TextColumn("{task.description}", markup=False),
        progress.BarColumn(bar_width=20),
        progress.MofNCompleteColumn(),
        progress.TimeElapsedColumn(),
        progress.TextColumn("left"),
        progress.TimeRemainingColumn(),
    )
    bars: dict[str, progress.TaskID] = {}
    with progress.Progress(*columns, console=console, transient=True) as shown:

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
    due = _Due()

    def report(label: str, done: int, total: int) -> None:
        started, before = begun.setdefault(label, (time.monotonic(), done))
        if not due(label, always=done == total):
            return
        seconds = time.monotonic() - started
        left = seconds / (done - before) * (total - done) if done > before else 0
        count = f" {done}/{total}" if total else ""
        rest = f", {left:.0f} s left" if left else ""
        console.print(f"{label}{count}{rest}", soft_wrap=True, markup=False)

    yield report


class _Due:
    """Whether a line is due: the first of a step, and one in EVERY seconds."""

    def __init__(self) -> None:
        self.steps: set[object] = set()
        self.last = 0.0

    def __call__(self, step: object, *, always: bool = False) -> bool:
        now = time.monotonic()
        if step in self.steps and not always and now - self.last < EVERY:
            return False
        self.steps.add(step)
        self.last = now
        return True
