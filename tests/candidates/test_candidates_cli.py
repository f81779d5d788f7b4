"""`plannerft candidates` and `plannerft doctor`."""

from __future__ import annotations

import csv
import json
from pathlib import Path
from typing import Any

import pytest
import typer
from typer.testing import CliRunner

from planner_ft.candidates import diagnosis
from planner_ft.candidates.costs import ANSWER_TOKENS
from planner_ft.candidates.diagnosis import probe_four_bit
from planner_ft.cli.models import candidates, doctor

ROOT = Path(__file__).parents[2]
PUBLISHED = ROOT / "planner_ft" / "benchmark" / "published"


@pytest.fixture
def run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Any:
    monkeypatch.setenv("HF_HUB_CACHE", str(tmp_path / "hub"))
    monkeypatch.setenv("COLUMNS", "120")
    app = typer.Typer()
    app.command()(candidates)
    app.command()(doctor)

    def invoke(*arguments: str) -> str:
        result = CliRunner().invoke(app, arguments, catch_exceptions=False)
        assert result.exit_code == 0, result.output
        return result.output

    return invoke


def test_the_table_says_what_fits_and_how_to_get_it(
    run: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv("PLANNERFT_MODELS", raising=False)
    output = run("candidates")
    row = next(line for line in output.splitlines() if line.startswith("Llama-3.2-3B-Instruct"))
    assert "3.21 B" in row
    assert "12 6*" in row
    assert "gated" in row
    embedded = next(line for line in output.splitlines() if line.startswith("embedded"))
    assert embedded.split()[-1] == "package"
    assert 'hf download meta-llama/Llama-3.2-3B-Instruct --exclude "original/*"' in output
    assert "accept the licence" in output


def test_the_times_are_estimates_that_fit_the_published_latencies(run: Any) -> None:
    """One constant gives the study's seconds a token of all seven within 6 %."""
    lines = (PUBLISHED / "mission.csv").read_text().splitlines()
    published = {row["model"]: row for row in csv.DictReader(lines)}
    entries = [one for one in json.loads(run("candidates", "--json")) if one["row"] in published]
    assert len(entries) == len(published) == 7
    for entry in entries:
        row = published[entry["row"]]
        seconds = float(row["latency_s_lora"]) / float(row["tokens_lora"])
        assert entry["times"]["answer_s"] == pytest.approx(ANSWER_TOKENS * seconds, rel=0.06)
    assert "Estimates, not measurements" in run("candidates")


def test_training_takes_longer_for_more_weights_and_more_samples(run: Any) -> None:
    times = {one["name"]: one["times"] for one in json.loads(run("candidates", "--json"))}
    small, middle, large = (times[f"Llama-3.{name}B"] for name in ("2-1", "2-3", "1-8"))
    assert small["train_mission_s"] < middle["train_mission_s"] < large["train_mission_s"]
    # 32 times as many samples, of more tokens.
    assert 32 < large["train_task_s"] / large["train_mission_s"] < 32 * 420 / 270


def test_the_table_in_the_documentation_is_what_the_command_prints(
    run: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv("PLANNERFT_MODELS", raising=False)
    page = (ROOT / "docs" / "training.md").read_text("utf-8")
    assert run("candidates", "--markdown").strip() in page


def test_where_a_model_is_stands_there_as_words(run: Any, models: Path) -> None:
    output = run("candidates")
    assert "stand-in" in output and "[" not in output.split("To get")[0]


def test_json_holds_every_candidate_with_memory_and_place(run: Any, models: Path) -> None:
    found = {entry["name"]: entry for entry in json.loads(run("candidates", "--json"))}
    assert list(found)[7] == "embedded"
    entry = found["Qwen2.5-3B"]
    assert (entry["row"], entry["standin"], entry["here"], entry["folder"]) == (
        "Qwen2.5-3B (stand-in)",
        True,
        True,
        str(models / "Qwen2.5-3B"),
    )
    assert set(entry["memory"]["train_fits"]) == {"6 GB", "12 GB"}


def test_an_incomplete_folder_is_reported_not_hidden(run: Any, tmp_path: Path) -> None:
    folder = tmp_path / "mine"
    folder.mkdir()
    (folder / "config.json").write_text('{"architectures": ["LlamaForCausalLM"]}')
    output = run("candidates", str(folder))
    assert "incomplete" in output
    assert f"{folder}: no tokenizer.json" in output


def test_doctor_reports_what_it_tried(run: Any, models: Path) -> None:
    report = run("doctor")
    for heading in (
        "libraries",
        "devices",
        "4-bit",
        "disk",
        "environment",
        "vocabulary",
        "candidates",
        "warnings",
    ):
        assert f"\n{heading}" in report
    assert "Llama-3.1-8B (4-bit) (stand-in): models folder" in report
    assert f"PLANNERFT_MODELS: {models}" in report
    found = json.loads(run("doctor", "--json"))
    assert found["4-bit"]["cpu"]["problem"] is None
    assert found["vocabulary"]["tasks"] == 21


def test_doctor_lists_what_is_wrong_and_hides_the_home_folder(
    run: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("HF_HOME", str(Path.home() / "models"))
    monkeypatch.setattr(
        "planner_ft.candidates.diagnosis.probe_four_bit",
        lambda device: {"device": device, "problem": "no kernel"},
    )
    monkeypatch.setattr(diagnosis, "LITTLE_DISK_GIB", 1e9)
    report = run("doctor")
    assert "- 4-bit layers do not work on cpu (no kernel); use --quantization none" in report
    assert "are free in the working folder" in report
    assert f"HF_HOME: ~{'/'}models" in report


def test_a_broken_kernel_is_found_out(monkeypatch: pytest.MonkeyPatch) -> None:
    import bitsandbytes

    assert probe_four_bit("cpu")["problem"] is None
    original = bitsandbytes.matmul_4bit
    monkeypatch.setattr(
        bitsandbytes,
        "matmul_4bit",
        lambda *arguments, **options: 1.5 * original(*arguments, **options),
    )
    assert "wrong results" in str(probe_four_bit("cpu")["problem"])

    def fail(*_: object, **__: object) -> None:
        raise RuntimeError("no kernel\nat all")

    monkeypatch.setattr(bitsandbytes, "matmul_4bit", fail)
    assert probe_four_bit("cpu")["problem"] == "RuntimeError: no kernel"
