"""`plannerft plan` as a user runs it, with the embedded candidate and stand-ins."""

from __future__ import annotations

import io
import json
import sys
from pathlib import Path
from typing import Any

import jsonschema
import pytest

from planner_ft.candidates import resolve_candidate
from planner_ft.candidates.adapters import adapter_record
from planner_ft.candidates.loading import load_model
from planner_ft.cli import main
from planner_ft.decoding.configurations import STRENGTHS
from planner_ft.decoding.engine import Engine
from planner_ft.support.files import read_json, write_json
from planner_ft.vocabulary import load_vocabulary

SCHEMA = jsonschema.Draft202012Validator(
    read_json(Path(__file__).parents[2] / "schemas" / "plan.schema.json")
)
COMMAND = "Go to [30, -12], then come home."


def run(monkeypatch: pytest.MonkeyPatch, *arguments: object) -> int:
    monkeypatch.setattr(sys, "argv", ["plannerft", "plan", *map(str, arguments)])
    with pytest.raises(SystemExit) as left:
        main()
    return int(left.value.code or 0)


@pytest.fixture
def nothing_loads(monkeypatch: pytest.MonkeyPatch) -> None:
    """For mistakes that are found before a model is loaded."""

    def load(*_arguments: object, **_settings: object) -> Any:
        raise AssertionError("a model is loaded")

    monkeypatch.setattr(Engine, "load", load)


def test_a_command_becomes_a_tree(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    status = run(monkeypatch, COMMAND, "--configuration", "base+schema", "--device", "cpu")
    shown = capsys.readouterr()
    assert status == 0, shown.err
    assert shown.out.startswith(f"{COMMAND}\nHow sure: ")
    assert "\n 1 Transit(target_position=[30,-12])\n" in shown.out
    assert "    1. GoToXY(x=30, y=-12)" in shown.out
    assert (
        "Mission Agent  embedded base+schema, no adapter: 1 answer, " in shown.out
        and "\npeak memory " in shown.out
    )
    assert list(tmp_path.iterdir()) == []
    assert shown.err.startswith("the command does not say: Which sensor"), (
        "what is missing is asked before anything is planned"
    )


def test_an_adapter_that_lies_here_is_used_and_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    from peft import LoraConfig, get_peft_model

    embedded, folder = resolve_candidate("embedded"), Path("adapters/embedded/mission")
    model = get_peft_model(
        load_model(embedded, device="cpu", trainable=True),
        LoraConfig(r=2, target_modules=["q_proj"], task_type="CAUSAL_LM"),
    )
    monkeypatch.chdir(tmp_path)
    model.save_pretrained(folder, save_embedding_layers=False)
    write_json(folder / "manifest.json", adapter_record(embedded, "mission", load_vocabulary()))
    status = run(monkeypatch, COMMAND, "--mission-only", "--device", "cpu", "--json")
    shown = capsys.readouterr()
    assert status == 0, shown.err
    value = json.loads(shown.out)
    SCHEMA.validate(value)
    assert value["usage"]["mission"]["configuration"] == f"lora+{STRENGTHS[-1]}" and value["usage"][
        "mission"
    ]["adapter"] == str(folder)
    assert len(value["manifest"]["agents"]["mission"]["adapter_sha256"]) == 64


def test_the_command_may_come_from_standard_input_and_the_plan_go_to_a_file(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(COMMAND.encode() + b"\n")))
    out = tmp_path / "plans" / "plan.json"
    arguments = (
        "-",
        "--json",
        "--mission-only",
        "--configuration",
        "base+schema",
        "--device",
        "cpu",
        "--out",
        out,
    )
    assert run(monkeypatch, *arguments) == 0
    shown = json.loads(capsys.readouterr().out)
    SCHEMA.validate(shown)
    assert shown["command"] == COMMAND and [entry["title"] for entry in shown["tasks"]] == [
        "Transit",
        "Transit",
    ]
    assert shown["manifest"]["agents"]["mission"]["vocabulary_in_the_prompt"] is False
    assert read_json(out) == shown
    assert run(monkeypatch, *arguments) == 2
    assert "exists; give --overwrite to replace it" in capsys.readouterr().err
    assert read_json(out) == shown


def test_an_answer_that_is_not_valid_is_shown_and_exits_with_1(
    models: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    limits = dict.fromkeys(("mission", "task"), 12)
    monkeypatch.setattr("planner_ft.decoding.engine.MAX_NEW_TOKENS", limits)
    assert (
        run(
            monkeypatch,
            COMMAND,
            "--candidate",
            "Qwen2.5-3B-Instruct",
            "--configuration",
            "base",
            "--device",
            "cpu",
            "--json",
        )
        == 1
    )
    shown = json.loads(capsys.readouterr().out)
    SCHEMA.validate(shown)
    assert not shown["valid"] and shown["problems"] and shown["output"] and shown["tasks"] == []
    assert shown["usage"]["mission"]["candidate"] == "Qwen2.5-3B-Instruct (stand-in)"


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["  "], "the command is empty"),
        ([COMMAND, "--locate", "buoy"], '--locate buoy: expected "NAME=x,y"'),
        ([COMMAND, "--locate", "buoy=1,2", "--locate", "buoy=2,2"], "two positions are given"),
        ([COMMAND, "--candidate", "embeded"], "did you mean embedded or"),
        ([COMMAND, "--configuration", "best"], "best: unknown"),
        ([COMMAND, "--mission-adapter", "nowhere"], "nowhere: no such adapter folder"),
        ([COMMAND, "--quantization", "int8"], "must be nf4 or none"),
        ([COMMAND, "--vocabulary", "submarine"], "no bundled vocabulary of that name"),
        ([COMMAND, "--device", "tpu"], "--device tpu: "),
        ([COMMAND, "--out", "."], "--out .: is a folder"),
        ([COMMAND, "--out", f"{__file__}/plan.json"], "cannot be written (Not a directory)"),
        (
            [COMMAND, "--mission-only", "--task-candidate", "embedded"],
            "there is no Task Agent with --mission-only",
        ),
    ],
)
def test_a_mistake_is_one_sentence_before_anything_is_loaded(
    nothing_loads: None,
    arguments: list[str],
    message: str,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert run(monkeypatch, *arguments) == 2
    shown = capsys.readouterr()
    assert shown.out == "" and shown.err.startswith("plannerft: ") and shown.err.count("\n") == 1
    assert message in shown.err


def test_a_command_that_is_no_text_is_refused(
    nothing_loads: None, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(b"go \xff")))
    assert run(monkeypatch, "-") == 2
    assert "not UTF-8 text (byte 3)" in capsys.readouterr().err


def test_a_command_that_is_too_long_is_refused(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    assert (
        run(
            monkeypatch, "go on and on " * 8000, "--configuration", "base+schema", "--device", "cpu"
        )
        == 2
    )
    error = capsys.readouterr().err.splitlines()[-1]
    assert (
        error.startswith("plannerft: embedded: the prompt of ")
        and "leaves no room in the model's context of 4096; shorten the command" in error
    )
