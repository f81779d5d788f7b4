"""The regression gate."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
import typer
from typer.testing import CliRunner

from planner_ft.benchmark.definitions import load_gate
from planner_ft.cli.bench import bench
from planner_ft.support.errors import GateError, PlannerError

GATE = (
    'level = "mission"\ncandidate = "Qwen2.5-3B"\nconfiguration = "base"\ndata ='
    ' "data.jsonl"\nmax_new_tokens = 4\n'
)


@pytest.fixture
def folder(tmp_path: Path, models: Path) -> Path:
    record = {"id": "a", "prompt": "go home", "expected": {"tasks": [{"title": "Transit"}]}}
    (tmp_path / "data.jsonl").write_text(json.dumps(record) + "\n")
    return tmp_path


def write(folder: Path, thresholds: str, head: str = GATE) -> Path:
    path = folder / "gate.toml"
    path.write_text(f"{head}\n[thresholds]\n{thresholds}\n")
    return path


def invoke(*arguments: str | Path) -> Any:
    app = typer.Typer()
    app.command()(bench)
    return CliRunner().invoke(app, [str(argument) for argument in arguments])


def test_a_gate_that_holds_passes_and_leaves_nothing_behind(folder: Path) -> None:
    before = sorted(folder.iterdir())
    path = write(folder, "schema_valid = { max = 0.5 }\ntokens = { min = 1, max = 4 }")
    result = invoke("--gate", path)
    assert result.exit_code == 0, result.exception
    assert "passed (schema_valid, tokens)" in result.stdout
    assert sorted(folder.iterdir()) == sorted([*before, path])


def test_a_figure_that_falls_short_is_named_with_its_threshold(folder: Path) -> None:
    path = write(
        folder, "schema_valid = { min = 0.98 }\ntokens = { max = 2 }\nhallucination = { max = 1.0 }"
    )
    result = invoke("--gate", path, "--out", folder / "out")
    assert isinstance(result.exception, GateError)
    text = str(result.exception)
    assert "schema_valid is 0, below the minimum 0.98" in text
    assert "tokens is 4, above the maximum 2" in text
    assert "hallucination" not in text
    assert "Qwen2.5-3B (stand-in), base" in text
    assert (folder / "out" / "results.json").is_file()


def test_latency_is_measured_when_it_has_a_threshold(folder: Path) -> None:
    result = invoke("--gate", write(folder, "latency_s = { max = 0 }"))
    assert "latency_s is" in str(result.exception)


def test_a_figure_that_was_not_measured_falls_short(folder: Path) -> None:
    assert "parameters was not measured" in str(
        invoke("--gate", write(folder, "parameters = { min = 0.1 }")).exception
    )


@pytest.mark.parametrize(
    ("thresholds", "head", "problem"),
    [
        ("f2 = { min = 1 }", GATE, "unknown metric 'f2'; there are f1,"),
        ("f1 = 1", GATE, "f1 must be a table"),
        ("f1 = { least = 1 }", GATE, "f1 must be a table"),
        ("f1 = {}", GATE, "f1 must be a table"),
        ("schema_valid = { min = 95 }", GATE, "fraction between 0 and 1"),
        ("", GATE, "names no metric"),
        (
            "f1 = { min = 1 }",
            GATE.replace("level", "level_"),
            "level is missing; unknown key 'level_'",
        ),
        ("f1 = { min = 1 }", GATE + "limit = '3'\n", "limit must be a int"),
        ("f1 = { min = 1 }", GATE.replace('"mission"', '"fleet"'), "--level fleet"),
        ("f1 = {", GATE, "not TOML"),
    ],
)
def test_a_bad_gate_file_is_an_error_of_its_own(
    folder: Path, thresholds: str, head: str, problem: str
) -> None:
    with pytest.raises(PlannerError, match=problem) as caught:
        load_gate(write(folder, thresholds, head))
    assert not isinstance(caught.value, GateError)


def test_a_gate_takes_no_flags_that_it_sets_itself(folder: Path) -> None:
    result = invoke(
        "--gate", write(folder, "f1 = { max = 1 }"), "--level", "mission", "--limit", "3"
    )
    assert "leave out --level, --limit" in str(result.exception)
    assert isinstance(invoke("--gate", folder / "none.toml").exception, PlannerError)


def test_the_gate_of_ci_reads() -> None:
    gate = load_gate(Path(__file__).parents[2] / "eval" / "gates" / "ci.toml")
    assert gate.settings.candidates == ("embedded",)
    assert "schema_valid" in gate.thresholds
    assert gate.settings.data is not None
    assert gate.settings.data.is_file()
