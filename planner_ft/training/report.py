"""Outputs of a run while it runs: terminal, log file, experiment trackers; the loss curve."""

import contextlib
import json
from pathlib import Path
from typing import Any

from rich.console import Console

from planner_ft.support.files import atomic_writer, compact_json, write_jsonl, writing
from planner_ft.support.resources import clock, memory_size
from planner_ft.training.settings import TrainSettings

LOG, TRACKED = "train_log.jsonl", "logs"
GO_ON = "free some space and run the same command with --resume"
Record = dict[str, Any]
"""A line of the log."""


class Report:
    """A run's log (a line per step and validation, flushed), trackers, and console lines."""

    def __init__(
        self, console: Console, output: Path, settings: TrainSettings, name: str, step: int = 0
    ) -> None:
        """Open the log in `output`, keeping its lines up to `step`."""
        self.console, self.every, self.path = console, settings.log_every, output / LOG
        self.steps: list[Record] = []
        write_jsonl(self.path, [record for record in read_log(self.path) if record["step"] <= step])
        self.stream = open(self.path, "a", encoding="utf-8")  # noqa: SIM115
        self.trackers = start_trackers(settings, output, name)
        self.status = console.status("first step ...")
        self.status.start()

    def record(self, values: Record) -> None:
        """Write a line of the log and tell the trackers."""
        with writing(self.path, GO_ON):
            self.stream.write(compact_json(values) + "\n")
            self.stream.flush()
        if self.trackers:
            numbers = {key: one for key, one in values.items() if isinstance(one, int | float)}
            self.trackers.log(numbers, step=numbers.pop("step"))

    def step(self, record: Record, total: int, seconds_left: float, peak: int) -> None:
        """Record a step and show means since the last line."""
        self.record(record)
        self.steps.append(record)
        due = record["step"] % self.every == 0 or record["step"] == total
        loss = sum(one["loss"] for one in self.steps) / len(self.steps)
        tokens = sum(one["step_tokens"] for one in self.steps)
        rate = tokens / sum(one["step_tokens"] / one["tokens_per_s"] for one in self.steps)
        place = f"step {record['step']}/{total}  epoch {record['epoch']:.2f}"
        learning = f"loss {loss:.4f}  lr {record['lr']:.2e}  {rate:.0f} tokens/s"
        text = f"{place}  {learning}  {clock(seconds_left)} left  peak {memory_size(peak)}"
        if self.console.is_terminal:
            self.status.update(text)
        elif due:
            self.note(text)
        if due:
            self.steps = []

    def note(self, text: str) -> None:
        self.console.print(text)

    def close(self) -> None:
        self.status.stop()
        with contextlib.suppress(OSError):
            self.stream.close()
        if self.trackers:
            self.trackers.end_training()


class Silence(Report):
    """The report of a process that another one speaks for."""

    def __init__(self) -> None:
        """Open nothing."""

    def silent(self, *_values: Any, **_named: Any) -> None:
        """Say nothing."""

    record = step = note = close = silent


def read_log(path: Path) -> list[Record]:
    """The records of a log; a last line that a killed run left incomplete is passed over."""
    records = []
    for line in path.read_text(encoding="utf-8").splitlines() if path.is_file() else []:
        with contextlib.suppress(json.JSONDecodeError):
            records.append(json.loads(line))
    return records


def start_trackers(settings: TrainSettings, output: Path, name: str) -> Any:
    """An Accelerator with the trackers of `report_to`, None without."""
    if not settings.trackers:
        return None
    from accelerate import Accelerator
    from accelerate.utils import ProjectConfiguration

    folders = ProjectConfiguration(logging_dir=str(output / TRACKED))
    on_cpu = settings.device == "cpu"
    accelerator = Accelerator(cpu=on_cpu, log_with=settings.trackers, project_config=folders)
    values = settings.as_dict().items()
    accelerator.init_trackers(name, {key: "" if v is None else v for key, v in values})
    return accelerator


def tracker_problems(settings: TrainSettings) -> list[str]:
    """Unknown names in `report_to`, and trackers that are not installed."""
    if not settings.trackers:
        return []
    from accelerate.tracking import LOGGER_TYPE_TO_CLASS as KNOWN
    from accelerate.tracking import get_available_trackers

    available = {str(name) for name in get_available_trackers()}
    return [
        f"--report-to {name}: not installed; run `pip install {name}`"
        if name in KNOWN
        else f"--report-to {name}: unknown; there are {', '.join(KNOWN)}"
        for name in settings.trackers
        if name not in available
    ]


def plot_losses(records: list[Record], folder: Path, title: str) -> None:
    """Write `loss.png` and `loss.svg`: training loss, its running mean, validation loss."""
    from matplotlib.figure import Figure

    steps = [record for record in records if "loss" in record]
    checks = [record for record in records if "validation_loss" in record]
    at, losses = [one["step"] for one in steps], [one["loss"] for one in steps]
    window = max(1, len(losses) // 30)
    recent = [losses[max(0, end - window) : end] for end in range(1, len(losses) + 1)]
    figure = Figure(figsize=(7, 4), layout="constrained")
    axes, blue = figure.subplots(), "tab:blue"
    axes.plot(at, losses, color=blue, alpha=0.25, linewidth=0.8, label="training, each step")
    means = [sum(values) / len(values) for values in recent]
    axes.plot(at, means, color=blue, label="training, running mean")
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
