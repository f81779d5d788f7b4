"""Learning curves: which parts are trained on, what a kill leaves, and what the answer says. The
processes are stood in for but in one test.
"""

from __future__ import annotations

import json
import os
import random
import shutil
import signal
import time
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from typer.testing import CliRunner

from planner_ft.benchmark import folder, units
from planner_ft.benchmark.curve import (
    Curve,
    Point,
    answer,
    begin,
    compared,
    given_as,
    prepare,
    run_units,
    write_curve,
)
from planner_ft.benchmark.results import Measured, System, assemble
from planner_ft.benchmark.samples import load_bench_data
from planner_ft.cli.app import app
from planner_ft.report.pictures import write_figure
from planner_ft.support.errors import IncompleteError, PlannerError
from planner_ft.support.files import compact_json, read_json, read_jsonl, write_json, write_jsonl
from planner_ft.training.request import build_request
from planner_ft.vocabulary import load_vocabulary
from tests.kills import changes

CANDIDATE = "Llama-3.2-1B-Instruct"
DRONE = load_vocabulary("inspection_drone")
CURATED = Path(__file__).parents[2] / "data" / "inspection_drone" / "mission"


@pytest.fixture
def data(tmp_path: Path) -> Path:
    """Eight short training samples of the drone, one to validate and four to test with."""
    parts = {"train": 8, "validation": 1, "test": 4}
    for split, count in parts.items():
        records = sorted(read_jsonl(CURATED / f"{split}.jsonl"), key=lambda one: len(str(one)))
        write_jsonl(tmp_path / "data" / f"{split}.jsonl", records[:count])
    return tmp_path / "data"


@pytest.fixture
def plan(models: Path, data: Path, tmp_path: Path) -> Callable[..., Curve]:
    def build(sizes: tuple[int, ...] | None = (0, 2, 4), **values: Any) -> Curve:
        named = {"level": "mission", "candidate": CANDIDATE, "vocabulary": DRONE.name}
        settings = values.pop("settings", {})
        request = build_request(named | {"data_dir": str(data)}, settings)
        values = {"seeds": 2, "data": data / "test.jsonl", "settings": settings} | values
        return prepare(request, tmp_path / "curve", sizes, **values)

    return build


class Runs:
    """Stands in for processes: an adapter of n samples answers the first n test samples rightly."""

    def __init__(self) -> None:
        self.started: list[list[str]] = []
        self.interrupt: int | None = None
        self.failure: str | None = None

    def __call__(self, arguments: list[str], log: Path, processes: int) -> Runs:
        self.started.append(arguments)
        return self

    def running(self) -> bool:
        if len(self.started) == self.interrupt:
            raise KeyboardInterrupt
        return False

    def problem(self) -> str | None:
        values = dict(zip(self.started[-1][1::2], self.started[-1][2::2], strict=False))
        if self.failure:
            return self.failure
        if self.started[-1][0] == "train":
            count = len(read_jsonl(Path(values["--train-file"])))
            write_json(Path(values["--output"]) / "manifest.json", {"samples": count})
        else:
            self.bench(values)
        return None

    def bench(self, values: dict[str, str]) -> None:
        adapter = Path(values.get("--adapter", "none")) / "manifest.json"
        right = read_json(adapter)["samples"] if adapter.is_file() else 0
        tests = load_bench_data(values["--data"], "mission", DRONE)
        answers = {
            one.id: {"output": compact_json(one.expected) if index < right else ""}
            for index, one in enumerate(tests.samples)
        }
        system = System(values["--candidates"], values["--configurations"], label="stand-in")
        measured = [Measured(system, answers)]
        out = Path(values["--out"])
        folder.write_results(out, assemble(tests, DRONE, measured, {"seed": 0}))

    def __enter__(self) -> Runs:
        return self

    def __exit__(self, *_: object) -> None:
        pass


@pytest.fixture
def runs(monkeypatch: pytest.MonkeyPatch) -> Runs:
    stands_in = Runs()
    monkeypatch.setattr(units, "Process", stands_in)
    return stands_in


def run(curve: Curve, **rerun: bool) -> None:
    begin(curve, **{"resume": False, "overwrite": False} | rerun)
    run_units(curve, lambda _state: None)


def trained(curve: Curve) -> dict[str, list[str]]:
    files = sorted((curve.out / "runs").glob("*/train.jsonl"))
    return {path.parent.name: [one["id"] for one in read_jsonl(path)] for path in files}


def test_sizes_are_parts_of_each_other(plan: Callable[..., Curve], runs: Runs) -> None:
    curve = plan()
    run(curve)
    ids = trained(curve)
    assert {name: len(one) for name, one in ids.items()} == {"2-0": 2, "2-1": 2, "4-0": 4, "4-1": 4}
    assert ids["2-0"] == ids["4-0"][:2] and ids["2-1"] == ids["4-1"][:2]
    assert ids["4-0"] != ids["4-1"]
    asked = [
        line[line.index("--configurations") + 1] for line in runs.started if line[0] == "bench"
    ]
    assert asked == ["base+schema", *["lora+schema"] * 4]
    seeds = [line[line.index("--seed") + 1] for line in runs.started if line[0] == "train"]
    assert seeds == ["0", "0", "1", "1"]


def test_without_sizes_they_double_up_to_all(plan: Callable[..., Curve], data: Path) -> None:
    assert plan(None).sizes == (0, 8)
    write_jsonl(data / "train.jsonl", read_jsonl(CURATED / "train.jsonl"))
    assert plan(None).sizes == (0, 8, 16, 32, 64, 125)


def test_the_test_set_of_the_data_folder_is_tested_on(
    plan: Callable[..., Curve], data: Path
) -> None:
    assert plan(data=None).data.path == data / "test.jsonl"
    (data / "test.jsonl").unlink()
    assert plan(data=None).data.path == DRONE.data / "mission" / "test.jsonl"


@pytest.mark.parametrize("step", range(1, 10))
def test_after_ctrl_c_in_any_phase_the_rest_is_run(
    plan: Callable[..., Curve], runs: Runs, step: int
) -> None:
    curve, runs.interrupt = plan(), step
    with pytest.raises(KeyboardInterrupt):
        run(curve)
    with pytest.raises(PlannerError, match="give --resume to go on"):
        run(plan())
    finished = len(list((curve.out / "runs").glob("*/unit.json")))
    runs.interrupt, before = None, len(runs.started)
    run(plan(), resume=True)
    # The base is one step, every other unit two.
    assert len(runs.started) - before == 9 - max(0, 2 * finished - 1)
    assert [point.size for point in write_curve(curve)] == [0, 2, 4]


def test_a_curve_that_is_killed_at_any_of_its_files_is_gone_on_with(
    plan: Callable[..., Curve], runs: Runs, tmp_path: Path
) -> None:
    def work() -> None:
        curve = plan((0, 2), seeds=1)
        run(curve, resume=True)
        write_curve(curve)

    out = tmp_path / "curve"
    total = changes(work, out)
    assert total
    whole = (out / "table.md").read_text()
    shutil.rmtree(out)
    for last in sorted(random.Random(0).sample(range(total), 3)):
        changes(work, out, last)
    assert changes(work, out) is not None
    assert (out / "table.md").read_text() == whole


def test_sizes_and_seeds_are_added_to_a_curve(plan: Callable[..., Curve], runs: Runs) -> None:
    run(plan((0, 2), seeds=1))
    before = len(runs.started)
    run(plan((0, 2, 4), seeds=2), resume=True)
    assert len(runs.started) - before == 6


def test_another_curve_is_not_gone_on_with(
    plan: Callable[..., Curve], runs: Runs, data: Path
) -> None:
    run(plan())
    with pytest.raises(PlannerError, match="--rank was 16 and is 4;"):
        run(plan(settings={"rank": 4}), resume=True)
    write_jsonl(data / "test.jsonl", read_jsonl(data / "test.jsonl")[:2])
    with pytest.raises(PlannerError, match="the test data changed since"):
        run(plan(), resume=True)
    before = len(runs.started)
    run(plan(), overwrite=True)
    assert len(runs.started) - before == 9


def test_a_failure_is_named_and_the_rest_kept(plan: Callable[..., Curve], runs: Runs) -> None:
    curve, runs.failure = plan(), "out of memory on cpu"
    with pytest.raises(IncompleteError, match=r"0 samples: bench: out of memory on cpu \(.*log\)"):
        run(curve)
    runs.failure = None
    run(plan(), resume=True)


def test_table_figure_and_manifest(plan: Callable[..., Curve], runs: Runs) -> None:
    curve = plan()
    run(curve)
    points = write_curve(curve)
    values = [point.metrics["whole_plan"].value for point in points]
    assert values == [0, 0.5, 1]
    record = read_json(curve.out / "learning_curve.json")
    assert [one["n"] for one in record["points"]] == [4, 8, 8]
    assert record["manifest"]["configuration"]["sizes"] == [0, 2, 4]
    assert set(record["manifest"]["inputs"]) == {"training", "validation", "data"}
    table = (curve.out / "table.md").read_text()
    assert record["is_standin"] and "is a tiny, randomly initialised model" in table
    assert "| 2 | 0.50 [" in table and record["answer"] in table
    drawn = write_figure(points, "commands", curve.out)
    assert [path.suffix for path in drawn] == [".png", ".svg"]
    assert "commands trained on" in drawn[1].read_text()


@pytest.mark.parametrize(
    ("values", "text"),
    [
        ({"sizes": (0, 9)}, "--sizes 0,9: must be between 0 and 8"),
        ({"sizes": (-1,)}, "--sizes -1: must be between 0 and 8"),
        ({"seeds": 0}, "--seeds 0: must be at least 1"),
        ({"strength": "hard"}, "--strength hard: must be one of free, schema"),
        ({"data": Path("gone.jsonl")}, "gone.jsonl: no such file"),
    ],
)
def test_what_cannot_be_run_is_one_sentence(
    plan: Callable[..., Curve], values: dict[str, Any], text: str
) -> None:
    with pytest.raises(PlannerError, match=text):
        plan(**values)


def points(*rates: float, n: int = 200) -> list[Point]:
    """Points of 10, 20, ... commands where these shares of the test samples are right."""
    found = []
    for index, rate in enumerate(rates, 1):
        lines = {}
        for at in range(n):
            right = at < round(rate * n)
            metrics = {"f1": float(right), "exact_sequence": right, "whole_plan": right}
            lines[str(at)] = [{"id": str(at), "family": str(at), **metrics}]
        found.append(Point(10 * index, {}, (), lines))
    return found


@pytest.mark.parametrize(
    ("found", "beginning", "part"),
    [
        (points(0.2, 0.5, 0.8), "Still rising", "10 more are worth writing"),
        (points(0.2, 0.8, 0.8), "Flat: from 20 to 30 commands", "20 do what 30 do"),
        (points(0.5, 0.8, 0.5), "Falling", "Check the labels"),
        (points(0.5, 0.6, n=20), "Open: from 10 to 20", "20 test commands leave room"),
        (points(0.5), "One size", "give --sizes at least two"),
    ],
)
def test_how_many_more_are_worth_writing(found: list[Point], beginning: str, part: str) -> None:
    said = answer(found, compared(found), "commands")
    assert said.startswith(beginning) and part in said


@pytest.mark.usefixtures("forked")
def test_ctrl_c_in_a_training_keeps_its_steps(
    models: Path, data: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    out = tmp_path / "curve"
    log = out / "runs" / "2-0" / "train.log"
    arguments = ["learning-curve", "--level", "mission", "--candidate", CANDIDATE]
    arguments += ["--vocabulary", DRONE.name, "--data-dir", str(data), "--sizes", "2", "--seeds"]
    arguments += ["1", "--data", str(data / "test.jsonl"), "--limit", "1", "--out", str(out)]
    arguments += ["--epochs", "8", "--log-every", "1", "--validation-answers", "0"]

    def sleep(_seconds: float) -> None:
        if "step 1/" in log.read_text():
            os.kill(os.getpid(), signal.SIGINT)
        time.sleep(0.1)

    with monkeypatch.context() as patch:
        patch.setattr(units, "time", SimpleNamespace(sleep=sleep, monotonic=time.monotonic))
        stopped = CliRunner().invoke(app, arguments)
    assert stopped.exit_code == 130, stopped.output
    assert "--resume" in stopped.output
    assert "all saved" in log.read_text()
    ended = CliRunner().invoke(app, [*arguments, "--resume"], catch_exceptions=False)
    assert ended.exit_code == 0, ended.output
    assert "step 1/" not in log.read_text()
    steps = [json.loads(line) for line in (log.parent / "adapter" / "train_log.jsonl").open()]
    assert sum("loss" in one for one in steps) == 16
    assert "One size" in (out / "table.md").read_text()


def test_progress_is_counted_while_a_training_drops_its_checkpoints(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for below in ("bench", "checkpoints/step-10"):
        (tmp_path / below).mkdir(parents=True)
        (tmp_path / below / units.LOGS[0]).write_text("{}\n{}\n", "utf-8")
    own = os.scandir

    def gone(path: Any) -> Any:
        if str(path).endswith("step-10"):
            raise FileNotFoundError(path)
        return own(path)

    unit = units.Unit("2 commands", tmp_path, queries=3)
    monkeypatch.setattr(os, "scandir", gone)
    assert unit.written() == 2


def test_settings_are_given_to_a_training_as_train_takes_them() -> None:
    assert given_as("vocabulary_in_prompt", True) == ["--vocabulary-in-prompt"]
    assert given_as("vocabulary_in_prompt", False) == ["--no-vocabulary-in-prompt"]
    assert given_as("learning_rate", 1e-3) == ["--learning-rate", "0.001"]
    for form in ("--vocabulary-in-prompt", "--no-vocabulary-in-prompt"):
        given = ["train", "--level", "mission", "--candidate", "nosuch", form]
        assert "nosuch" in str(CliRunner().invoke(app, given).exception)
