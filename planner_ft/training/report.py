"""What a run says while it runs: terminal, log file, experiment trackers."""

from __future__ import annotations

import contextlib
import json
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol

from planner_ft.support.errors import PlannerError
from planner_ft.support.files import compact_json, write_jsonl
from planner_ft.support.resources import clock, memory_size
from planner_ft.training.settings import TrainSettings

if TYPE_CHECKING:
    from rich.console import Console

LOG = "train_log.jsonl"


class Display(Protocol):
    """Shows the steps of a run. `record` is a line of the log."""

    def step(self, record: dict[str, Any], eta_seconds: float, peak: int) -> None: ...

    def note(self, text: str) -> None: ...

    def close(self) -> None: ...


class PlainDisplay:
    """One line every `every` steps, for files and pipes."""

    def __init__(self, console: Console, total: int, every: int) -> None:
        self.console, self.total, self.every = console, total, every
        self.losses: list[float] = []
        self.tokens, self.seconds = 0.0, 0.0

    def step(self, record: dict[str, Any], eta_seconds: float, peak: int) -> None:
        self.losses.append(record["loss"])
        self.tokens += record["step_tokens"]
        self.seconds += record["step_tokens"] / record["tokens_per_s"]
        if record["step"] % self.every and record["step"] != self.total:
            return
        loss, rate = sum(self.losses) / len(self.losses), self.tokens / self.seconds
        self.losses, self.tokens, self.seconds = [], 0.0, 0.0
        self.note(
            f"step {record['step']}/{self.total}  epoch {record['epoch']:.2f}  loss {loss:.4f}  lr"
            f" {record['lr']:.2e}  {rate:.0f} tokens/s  {clock(eta_seconds)} left  peak"
            f" {memory_size(peak)}"
        )

    def note(self, text: str) -> None:
        self.console.print(text, markup=False, highlight=False, soft_wrap=True)

    def close(self) -> None:
        pass


class BarDisplay:
    """A progress bar with loss, tokens/s, time left and peak memory, for terminals."""

    def __init__(self, console: Console, total: int, done: int) -> None:
        from rich.progress import BarColumn, Progress, TextColumn

        self.progress = Progress(
            TextColumn("step {task.completed:.0f}/{task.total:.0f}"),
            BarColumn(bar_width=24),
            TextColumn("{task.description}"),
            console=console,
            transient=True,
        )
        self.task = self.progress.add_task("first step ...", total=total, completed=done)
        self.average: float | None = None
        self.rate = 0.0
        self.progress.start()

    def step(self, record: dict[str, Any], eta_seconds: float, peak: int) -> None:
        # Running means over about ten steps: loss and speed of a single sample jump.
        first = self.average is None
        self.average = (
            record["loss"] if self.average is None else 0.9 * self.average + 0.1 * record["loss"]
        )
        self.rate = (
            record["tokens_per_s"] if first else 0.9 * self.rate + 0.1 * record["tokens_per_s"]
        )
        text = (
            f"loss {self.average:.3f}  {self.rate:.0f} tokens/s  {clock(eta_seconds)} left  peak"
            f" {memory_size(peak)}"
        )
        self.progress.update(self.task, completed=record["step"], description=text)

    def note(self, text: str) -> None:
        self.progress.console.print(text, markup=False, highlight=False, soft_wrap=True)

    def close(self) -> None:
        self.progress.stop()


def make_display(console: Console, total: int, done: int, every: int) -> Display:
    """A bar on a terminal, lines elsewhere."""
    return (
        BarDisplay(console, total, done)
        if console.is_terminal
        else PlainDisplay(console, total, every)
    )


class TrainLog:
    """`train_log.jsonl`: a line per step and per validation, flushed as it is made."""

    def __init__(self, output: Path, step: int) -> None:
        """Open the log in `output`, keeping only what stands there up to `step`."""
        self.path = output / LOG
        write_jsonl(self.path, [record for record in read_log(self.path) if record["step"] <= step])
        self.stream = open(self.path, "a", encoding="utf-8")  # noqa: SIM115

    def write(self, record: dict[str, Any]) -> None:
        try:
            self.stream.write(compact_json(record) + "\n")
            self.stream.flush()
        except OSError as error:
            raise PlannerError(
                f"{self.path}: cannot be written ({error.strerror}); free some space and run the"
                " same command with --resume"
            ) from error

    def close(self) -> None:
        with contextlib.suppress(OSError):
            self.stream.close()


def read_log(path: Path) -> list[dict[str, Any]]:
    """The records of a log; a last line that a killed run left incomplete is passed over."""
    records = []
    for line in path.read_text(encoding="utf-8").splitlines() if path.is_file() else []:
        with contextlib.suppress(json.JSONDecodeError):
            records.append(json.loads(line))
    return records


class Trackers:
    """The experiment trackers of `report_to`, through accelerate's tracker classes."""

    def __init__(self, settings: TrainSettings, output: Path, run_name: str) -> None:
        if not settings.trackers:
            self.trackers: list[Any] = []
            return
        from accelerate import PartialState
        from accelerate.tracking import LOGGER_TYPE_TO_CLASS

        PartialState(cpu=settings.device == "cpu")
        self.trackers = []
        for name in settings.trackers:
            kind = LOGGER_TYPE_TO_CLASS[name]
            tracker = (
                kind(run_name, logging_dir=output / "logs")
                if kind.requires_logging_directory
                else kind(run_name)
            )
            tracker.start()
            tracker.store_init_configuration(
                {
                    key: value if value is not None else ""
                    for key, value in settings.as_dict().items()
                }
            )
            self.trackers.append(tracker)

    def log(self, record: dict[str, Any]) -> None:
        values = {
            key: value
            for key, value in record.items()
            if isinstance(value, int | float) and key != "step"
        }
        for tracker in self.trackers:
            tracker.log(values, step=record["step"])

    def close(self) -> None:
        for tracker in self.trackers:
            tracker.finish()


def tracker_problems(settings: TrainSettings) -> list[str]:
    """What keeps the trackers of `report_to` from working."""
    if not settings.trackers:
        return []
    from accelerate.tracking import LOGGER_TYPE_TO_CLASS, get_available_trackers

    available = {str(name) for name in get_available_trackers()}
    unknown = [name for name in settings.trackers if name not in LOGGER_TYPE_TO_CLASS]
    missing = [
        name for name in settings.trackers if name in LOGGER_TYPE_TO_CLASS and name not in available
    ]
    problems = [
        f"--report-to {name}: unknown; there are {', '.join(LOGGER_TYPE_TO_CLASS)}"
        for name in unknown
    ]
    return problems + [
        f"--report-to {name}: not installed; run `pip install {name}`" for name in missing
    ]
