"""Outputs of a run while it runs: terminal, log file, experiment trackers; the loss curve."""

from __future__ import annotations

import contextlib
import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from planner_ft.support.errors import PlannerError
from planner_ft.support.files import atomic_writer, compact_json, write_jsonl
from planner_ft.support.resources import clock, memory_size
from planner_ft.training.settings import TrainSettings

if TYPE_CHECKING:
    from rich.console import Console

LOG = "train_log.jsonl"
Record = dict[str, Any]
"""A line of the log."""


class Display:
    """One line every `every` steps, for files and pipes."""

    def __init__(self, console: Console, total: int, every: int) -> None:
        self.console, self.total, self.every = console, total, every
        self.losses: list[float] = []
        self.tokens, self.seconds = 0.0, 0.0

    def step(self, record: Record, eta_seconds: float, peak: int) -> None:
        self.losses.append(record["loss"])
        self.tokens += record["step_tokens"]
        self.seconds += record["step_tokens"] / record["tokens_per_s"]
        if record["step"] % self.every and record["step"] != self.total:
            return
        loss, rate = sum(self.losses) / len(self.losses), self.tokens / self.seconds
        self.losses, self.tokens, self.seconds = [], 0.0, 0.0
        place = f"step {record['step']}/{self.total}  epoch {record['epoch']:.2f}"
        learning = f"loss {loss:.4f}  lr {record['lr']:.2e}  {rate:.0f} tokens/s"
        self.note(f"{place}  {learning}  {clock(eta_seconds)} left  peak {memory_size(peak)}")

    def note(self, text: str) -> None:
        self.console.print(text, markup=False, highlight=False, soft_wrap=True)

    def close(self) -> None:
        pass


class BarDisplay(Display):
    """A progress bar with loss, tokens/s, time left and peak memory, for terminals."""

    def __init__(self, console: Console, total: int, done: int) -> None:
        from rich.progress import BarColumn, Progress, TextColumn

        super().__init__(console, total, 1)
        count, text = "step {task.completed:.0f}/{task.total:.0f}", "{task.description}"
        columns = (TextColumn(count), BarColumn(bar_width=24), TextColumn(text))
        self.progress = Progress(*columns, console=console, transient=True)
        self.task = self.progress.add_task("first step ...", total=total, completed=done)
        self.means: dict[str, float] = {}
        self.progress.start()

    def step(self, record: Record, eta_seconds: float, peak: int) -> None:
        # Running means over about ten steps: loss and speed of a single sample jump.
        for name in ("loss", "tokens_per_s"):
            value = float(record[name])
            self.means[name] = 0.9 * self.means.get(name, value) + 0.1 * value
        speed = f"loss {self.means['loss']:.3f}  {self.means['tokens_per_s']:.0f} tokens/s"
        text = f"{speed}  {clock(eta_seconds)} left  peak {memory_size(peak)}"
        self.progress.update(self.task, completed=record["step"], description=text)

    def close(self) -> None:
        self.progress.stop()


def make_display(console: Console, total: int, done: int, every: int) -> Display:
    """A bar on a terminal, lines elsewhere."""
    bar = console.is_terminal
    return BarDisplay(console, total, done) if bar else Display(console, total, every)


class TrainLog:
    """`train_log.jsonl`: a line per step and per validation, flushed as it is made."""

    def __init__(self, output: Path, step: int) -> None:
        """Open the log in `output`, keeping its lines up to `step`."""
        self.path = output / LOG
        write_jsonl(self.path, [record for record in read_log(self.path) if record["step"] <= step])
        self.stream = open(self.path, "a", encoding="utf-8")  # noqa: SIM115

    def write(self, record: Record) -> None:
        try:
            self.stream.write(compact_json(record) + "\n")
            self.stream.flush()
        except OSError as error:
            way_out = "free some space and run the same command with --resume"
            text = f"{self.path}: cannot be written ({error.strerror}); {way_out}"
            raise PlannerError(text) from error

    def close(self) -> None:
        with contextlib.suppress(OSError):
            self.stream.close()


def read_log(path: Path) -> list[Record]:
    """The records of a log; a last line that a killed run left incomplete is passed over."""
    records = []
    for line in path.read_text(encoding="utf-8").splitlines() if path.is_file() else []:
        with contextlib.suppress(json.JSONDecodeError):
            records.append(json.loads(line))
    return records


class Trackers:
    """The experiment trackers of `report_to`, through accelerate's tracker classes."""

    def __init__(self, settings: TrainSettings, output: Path, run_name: str) -> None:
        self.trackers: list[Any] = []
        if not settings.trackers:
            return
        from accelerate import PartialState
        from accelerate.tracking import LOGGER_TYPE_TO_CLASS

        PartialState(cpu=settings.device == "cpu")
        values = settings.as_dict().items()
        for name in settings.trackers:
            kind = LOGGER_TYPE_TO_CLASS[name]
            folder = {"logging_dir": output / "logs"} if kind.requires_logging_directory else {}
            tracker = kind(run_name, **folder)
            tracker.start()
            tracker.store_init_configuration({k: "" if v is None else v for k, v in values})
            self.trackers.append(tracker)

    def log(self, record: Record) -> None:
        values = {key: value for key, value in record.items() if isinstance(value, int | float)}
        step = values.pop("step")
        for tracker in self.trackers:
            tracker.log(values, step=step)

    def close(self) -> None:
        for tracker in self.trackers:
            tracker.finish()


def tracker_problems(settings: TrainSettings) -> list[str]:
    """Unknown names in `report_to`, and trackers that are not installed."""
    if not settings.trackers:
        return []
    from accelerate.tracking import LOGGER_TYPE_TO_CLASS, get_available_trackers

    available = {str(name) for name in get_available_trackers()}
    known = ", ".join(LOGGER_TYPE_TO_CLASS)
    unknown = [name for name in settings.trackers if name not in LOGGER_TYPE_TO_CLASS]
    missing = [name for name in settings.trackers if name not in (*available, *unknown)]
    return [
        *(f"--report-to {name}: unknown; there are {known}" for name in unknown),
        *(f"--report-to {name}: not installed; run `pip install {name}`" for name in missing),
    ]


def plot_losses(records: list[Record], folder: Path, title: str) -> None:
    """Write `loss.png` and `loss.svg`: training loss a step with its mean, validation loss."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib.figure import Figure

    steps = [record for record in records if "loss" in record]
    checks = [record for record in records if "validation_loss" in record]
    at, losses = [record["step"] for record in steps], [record["loss"] for record in steps]
    figure = Figure(figsize=(7, 4), layout="constrained")
    axes, blue = figure.subplots(), "tab:blue"
    axes.plot(at, losses, color=blue, alpha=0.25, linewidth=0.8, label="training, each step")
    axes.plot(at, running_mean(losses), color=blue, label="training, running mean")
    if checks:
        at, losses = [r["step"] for r in checks], [r["validation_loss"] for r in checks]
        axes.plot(at, losses, "o-", color="tab:orange", label="validation")
    axes.set(xlabel="optimiser step", ylabel="cross-entropy per completion token", title=title)
    axes.set_ylim(bottom=0)
    axes.grid(alpha=0.3)
    axes.legend()
    for suffix, options in (("png", {"dpi": 150}), ("svg", {"metadata": {"Date": None}})):
        with atomic_writer(folder / f"loss.{suffix}", "wb") as stream:
            figure.savefig(stream, format=suffix, **options)


def running_mean(values: list[float]) -> list[float]:
    """Mean over the last values, a thirtieth of all of them."""
    window, sums = max(1, len(values) // 30), np.cumsum([0.0, *values])
    ends = np.arange(1, len(values) + 1)
    starts = np.maximum(0, ends - window)
    means: list[float] = ((sums[ends] - sums[starts]) / (ends - starts)).tolist()
    return means
