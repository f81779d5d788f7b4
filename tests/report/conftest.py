"""Runs without any model: scripted answers to a few commands, scored as `plannerft score` does."""

from __future__ import annotations

import json
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from planner_ft.benchmark.folder import write_results
from planner_ft.benchmark.samples import load_bench_data
from planner_ft.benchmark.submission import score_predictions
from planner_ft.vocabulary import load_vocabulary

HOSTILE = (
    "</script><script>window.attacked=1</script><img src=x onerror='window.attacked=1'>\u2028<!--"
)


def task(title: str, prompt: str = "", **parameters: Any) -> dict[str, Any]:
    return {"title": title, "parameters": parameters, "task_prompt": prompt}


def plan(*tasks: dict[str, Any]) -> dict[str, Any]:
    return {"tasks": list(tasks), "assumptions": [], "constraints": []}


SEARCH, GO = (
    task("SearchAndDetect", "Find the buoy.", target_description="red buoy"),
    task("Transit", "Go there.", target_position=[-99, -99]),
)
ORBIT, HOME = (
    task("PerformOrbit", "Circle it.", center=[-99, -99], radius=20, arc=360),
    task("Transit", "Go home.", target_position=[0, 0]),
)
EXPECTED = {
    "orbit": plan(SEARCH, GO, ORBIT, HOME),
    "home": plan(HOME),
    "hold": plan(GO, task("KeepStation", "Hold.", duration=300)),
    "impossible": plan(),
}
COMMANDS = {
    "orbit": "Circle the red buoy & come home.",
    "home": "Come <b>home</b>.",
    "hold": "Hold there for five minutes.",
    "impossible": "Fly to the moon.",
}
ANSWERS: dict[str, dict[str, Any]] = {
    "good": {**EXPECTED, "hold": plan(GO, task("KeepStation", "Hold.", duration=30))},
    "hostile": {
        "orbit": plan(ORBIT, task(HOSTILE, HOSTILE, **{HOSTILE: HOSTILE})),
        "home": HOSTILE,
        "hold": plan(GO, task("Diagnostics", "Check.")),
        "impossible": plan(HOME),
    },
}


def write_lines(path: Path, records: list[dict[str, Any]]) -> Path:
    path.write_text("".join(json.dumps(record) + "\n" for record in records), encoding="utf-8")
    return path


def write_data(folder: Path, name: str = "test.jsonl", *, grouped: bool = True) -> Path:
    groups = {"orbit": "long", "home": "short", "hold": "short", "impossible": "refuse"}
    records = [
        {
            "id": key,
            "prompt": COMMANDS[key],
            "expected": expected,
            **({"group": groups[key]} if grouped else {}),
        }
        for key, expected in EXPECTED.items()
    ]
    return write_lines(folder / name, records)


def write_run(
    folder: Path, data: Path, answers: dict[str, dict[str, Any]], *, timed: bool = True
) -> Path:
    """A run folder of scripted systems."""
    folder.mkdir(parents=True)
    lines = []
    for number, (candidate, outputs) in enumerate(answers.items()):
        for index, (key, output) in enumerate(outputs.items()):
            cost = {"latency_s": 0.5 + number + 0.1 * index, "tokens": 10 * index} if timed else {}
            text = output if isinstance(output, str) else json.dumps(output)
            lines.append(
                {"id": key, "candidate": candidate, "configuration": "base", "output": text, **cost}
            )
    vocabulary = load_vocabulary("usv")
    path = write_lines(folder / "predictions.jsonl", lines)
    write_results(
        folder, score_predictions(path, load_bench_data(data, "mission", vocabulary), vocabulary)
    )
    return folder


@pytest.fixture(scope="session")
def written(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with the test data and a run of two systems, one of which answers as an attacker
    would. Do not write to it.
    """
    folder = tmp_path_factory.mktemp("written")
    write_run(folder / "run", write_data(folder), ANSWERS)
    return folder


@pytest.fixture
def data(tmp_path: Path) -> Path:
    return write_data(tmp_path)


@pytest.fixture
def run(tmp_path: Path, data: Path, written: Path) -> Path:
    """The run, on the test's own data."""
    shutil.copytree(written / "run", tmp_path / "run")
    results = tmp_path / "run" / "results.json"
    results.write_text(results.read_text().replace(str(written), str(tmp_path)))
    return tmp_path / "run"


@pytest.fixture
def make_run(tmp_path: Path, data: Path) -> Callable[..., Path]:
    """Further runs on the same data: name, answers."""
    return lambda name, answers, **options: write_run(tmp_path / name, data, answers, **options)
