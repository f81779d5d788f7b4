"""Small data and runs for the tests of training."""

from __future__ import annotations

import json
import os
import signal
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from rich.console import Console

from planner_ft.support.terminal import terminal

CURATED = Path(__file__).parents[2] / "data" / "mission" / "train.jsonl"
STANDIN = "Llama-3.2-1B-Instruct"


def records(count: int, skip: int = 0) -> list[dict[str, Any]]:
    """The shortest curated records, without the first `skip`."""
    lines = sorted(CURATED.read_text(encoding="utf-8").splitlines(), key=len)
    return [json.loads(line) for line in lines[skip : skip + count]]


def write_records(path: Path, items: list[dict[str, Any]]) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("".join(json.dumps(item) + "\n" for item in items), encoding="utf-8")
    return path


@pytest.fixture
def data(tmp_path: Path) -> Path:
    """A data folder: eight training and three validation samples."""
    write_records(tmp_path / "data" / "train.jsonl", records(8))
    write_records(tmp_path / "data" / "validation.jsonl", records(3, skip=8))
    return tmp_path / "data"


@pytest.fixture
def quiet() -> Console:
    """A console whose text can be read back with `export_text()`."""
    return terminal(record=True, file=open("/dev/null", "w"), width=200, soft_wrap=True)


@pytest.fixture
def ask(models: Path, data: Path, tmp_path: Path) -> Callable[..., Any]:
    """Build a request for the stand-in: keywords are settings, or names of `run` values."""
    from planner_ft.training.request import build_request

    def build(**values: Any) -> Any:
        run = {
            "level": "mission",
            "candidate": STANDIN,
            "data_dir": str(data),
            "output": str(tmp_path / "adapter"),
        }
        names = (
            "level",
            "candidate",
            "data_dir",
            "output",
            "vocabulary",
            "train_file",
            "validation_file",
            "corrections",
        )
        run |= {key: values.pop(key) for key in names if key in values}
        options = {
            key: values.pop(key)
            for key in ("recipe", "overwrite", "resume", "ranks")
            if key in values
        }
        return build_request(run, values, **options)

    return build


def losses(output: Path) -> list[float]:
    """The loss of every step in a run's log."""
    lines = [json.loads(line) for line in (output / "train_log.jsonl").read_text().splitlines()]
    return [line["loss"] for line in lines if "loss" in line]


@pytest.fixture
def step_losses() -> Callable[[Path], list[float]]:
    return losses


@pytest.fixture
def write() -> Callable[[Path, list[dict[str, Any]]], Path]:
    return write_records


@pytest.fixture
def curated() -> Callable[..., list[dict[str, Any]]]:
    return records


SHORT = {"epochs": 2, "rank": 4, "log_every": 1}
"""16 steps on the eight samples."""


@pytest.fixture
def short() -> dict[str, Any]:
    return dict(SHORT)


REFERENCE: list[tuple[list[float], bytes]] = []
"""What `reference` gives, once it has been made: it depends on nothing of a test."""


@pytest.fixture
def reference(ask: Callable[..., Any], quiet: Console, tmp_path: Path) -> tuple[list[float], bytes]:
    """Losses and adapter of an uninterrupted run with dropout."""
    from planner_ft.training.run import train

    if not REFERENCE:
        train(ask(**SHORT, output=str(tmp_path / "reference")), quiet)
        weights = tmp_path / "reference" / "adapter_model.safetensors"
        REFERENCE.append((losses(tmp_path / "reference"), weights.read_bytes()))
    return REFERENCE[0]


@pytest.fixture
def interrupt_at() -> Callable[..., None]:
    """Let this process get a signal while a run works on a step: `interrupt_at(patch, step,
    signal)`.
    """
    from planner_ft.training.report import Report

    def arrange(monkeypatch: pytest.MonkeyPatch, step: int, number: int = signal.SIGINT) -> None:
        original = Report.step

        def stepping(self: Any, record: dict[str, Any], *values: Any) -> None:
            original(self, record, *values)
            if record["step"] == step:
                os.kill(os.getpid(), number)

        monkeypatch.setattr(Report, "step", stepping)

    return arrange
