"""Options of the commands: names, kinds, defaults and help texts are all in help.toml."""

from __future__ import annotations

import contextlib
import functools
import inspect
import os
import shlex
import signal
import sys
import threading
import time
import tomllib
from collections import ChainMap
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import TYPE_CHECKING, Annotated, Any, TypeVar, get_args

import typer

from planner_ft.support.alone import alone
from planner_ft.support.terminal import Report, terminal

if TYPE_CHECKING:
    from types import FrameType

    from rich.console import Console

    from planner_ft.support.tables import Table

AGAIN = "give --overwrite or another --out"
TEXTS = tomllib.loads(Path(__file__).with_name("help.toml").read_text(encoding="utf-8"))
Made = TypeVar("Made")
OPTION = inspect.Parameter.KEYWORD_ONLY
LEAST = {"seed": 0, "processes": 1}
"""The smallest values of numbers, checked before a command begins."""
KINDS: dict[str, Any] = {"text": str | None, "texts": list[str] | None, "int": int | None}
KINDS |= {"path": Path | None, "paths": list[Path] | None, "float": float | None}


class Options(SimpleNamespace):
    """The options of a command by name; what has no default is None, a flag False."""

    def take(self, *names: str) -> dict[str, Any]:
        """Some of them."""
        return {name: getattr(self, name) for name in names}

    def given(self, *names: str) -> dict[str, Any]:
        """Those of them that were given."""
        values = self.take(*names).items()
        return {name: one for name, one in values if one is not None and one is not False}

    def into(self, settings: Callable[..., Made], **own: Any) -> Made:
        """Settings from the options that have the names of their fields, and from `own`."""
        named = inspect.signature(settings).parameters.keys() & vars(self).keys() - own.keys()
        return settings(**self.take(*named), **own)


def command(function: Callable[[Options], None]) -> Callable[..., None]:
    """The command that help.toml describes under the name of `function`."""

    @functools.wraps(function)
    def run(**values: Any) -> None:
        function(Options(**values))

    name, help_of = function.__name__, _helps(function.__name__)
    set_parameters(run, [_option(item, *help_of) for item in TEXTS["options"][name].split()])
    run.__doc__ = TEXTS["about"].get(name, function.__doc__)
    return run


def _helps(command: str) -> tuple[dict[str, Any], dict[str, str]]:
    """The help of a command's options, else that of all commands, and the panels of some."""
    own = TEXTS.get(command, {})
    panels = {key: texts for key, texts in own.items() if isinstance(texts, dict)}
    panel_of = {name: key for key, texts in panels.items() for name in texts}
    return dict(ChainMap(own, *panels.values(), TEXTS["shared"])), panel_of


def _option(item: str, help_of: dict[str, Any], panel_of: dict[str, str]) -> inspect.Parameter:
    """An option of a command as [options] of help.toml writes it."""
    name, _, kind = item.partition(":")
    kind, has_default, default = kind.partition("=")
    annotation: Any = KINDS[kind.removesuffix("!")] if kind else bool
    value: Any = None if kind else False
    if has_default or kind.endswith("!"):
        annotation = get_args(annotation)[0]
        value = annotation(default) if has_default else inspect.Parameter.empty
    text, *shown = [help_of[name]] if isinstance(help_of[name], str) else help_of[name]
    if panel_of.get(name) == "arguments":
        about: Any = typer.Argument(help=text, show_default=False)
    else:
        # A flag has no --no- form.
        flags = (typed([name]),) if annotation is bool else ()
        how: dict[str, Any] = {"min": LEAST.get(name), "rich_help_panel": panel_of.get(name)}
        about = typer.Option(*flags, help=text, show_default=shown[0] if shown else True, **how)
    return inspect.Parameter(name, OPTION, default=value, annotation=Annotated[annotation, about])


def set_parameters(function: Callable[..., None], parameters: list[inspect.Parameter]) -> None:
    """Have typer see these parameters."""
    function.__signature__ = inspect.Signature(parameters)  # type: ignore[attr-defined]
    function.__annotations__ = {item.name: item.annotation for item in parameters}


def show_table(table: Table) -> None:
    """Print a table."""
    from planner_ft.support.tables import terminal_table

    terminal().print(terminal_table(table))


def typed(names: Iterable[str]) -> str:
    """Options as they are typed: "--level, --batch-size"."""
    return ", ".join(f"--{name.replace('_', '-')}" for name in names)


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
        due = _due()

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

    def press(number: int, frame: FrameType | None) -> None:
        pressed.set()
        if frame and frame.f_code.co_filename.startswith("<frozen importlib"):
            # There it would be swallowed, or leave a lock of Python held for ever: a moment later.
            threading.Timer(0.01, os.kill, (os.getpid(), number)).start()
            return
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
    due = _due()

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


def _due() -> Callable[..., bool]:
    """Says whether a line is due: the first of a step, and one in EVERY seconds."""
    shown: dict[object, float] = {}

    def due(step: object, *, always: bool = False) -> bool:
        now = time.monotonic()
        if step in shown and not always and now - max(shown.values()) < EVERY:
            return False
        shown[step] = now
        return True

    return due
