"""Several processes, as accelerate starts them: the run of one process with larger batches."""

from __future__ import annotations

import json
import os
import subprocess
from pathlib import Path
from typing import Any

import pytest
import torch
from safetensors.torch import load_file

from planner_ft.benchmark.units import command
from planner_ft.support.errors import PlannerError
from planner_ft.support.ranks import Ranks
from planner_ft.training.run import train

FLAGS = {"epochs": 3, "rank": 4, "learning_rate": 1e-2, "dropout": 0.0, "quantization": "none"}
FLAGS |= {"seed": 3, "validation_answers": 2}


def launched(processes: int, **flags: Any) -> subprocess.CompletedProcess[str]:
    words = [part for name, value in flags.items() for part in (f"--{name}", str(value))]
    arguments = ["train", *(word.replace("_", "-") if "--" in word else word for word in words)]
    environment = {**os.environ, "OMP_NUM_THREADS": "1", "CUDA_VISIBLE_DEVICES": ""}
    starting = command(arguments, processes)
    return subprocess.run(starting, env=environment, capture_output=True, text=True, check=False)


@pytest.mark.usefixtures("forked")
def test_two_processes_train_as_one_with_the_doubled_batch(
    ask, quiet, data, tmp_path, models, step_losses
):
    # Seven samples: the last step of an epoch leaves the second process without one.
    lines = (data / "train.jsonl").read_text().splitlines(keepends=True)
    (data / "train.jsonl").write_text("".join(lines[:7]))
    out = tmp_path / "two"
    named = {"level": "mission", "candidate": "Llama-3.2-1B-Instruct", "data_dir": data}
    done = launched(2, **named, output=out, device="cpu", **FLAGS)
    assert done.returncode == 0, done.stderr
    manifest = json.loads((out / "manifest.json").read_text())
    assert manifest["processes"] == 2
    assert "batch size 2 (1 for each of 2 processes)" in manifest["departures"]
    assert manifest["result"]["validation_answers"]["n"] == 2
    assert done.stdout.count("[1/7]") == 1

    single = train(ask(output=str(tmp_path / "one"), batch_size=2, **FLAGS), quiet)
    assert single is not None
    one, two = step_losses(tmp_path / "one"), step_losses(out)
    assert len(one) == len(two) == manifest["result"]["steps"] == 12
    assert two == pytest.approx(one, rel=2e-3)
    assert one[-1] < 0.97 * one[0]
    for name in ("tokens", "completion_tokens", "epochs"):
        assert manifest["result"][name] == single["result"][name]
    assert manifest["result"]["validation_loss"] == pytest.approx(
        single["result"]["validation_loss"], rel=2e-3
    )
    weights = [load_file(tmp_path / name / "adapter_model.safetensors") for name in ("one", "two")]
    flat = [torch.cat([value.flatten() for _name, value in sorted(w.items())]) for w in weights]
    assert torch.nn.functional.cosine_similarity(*flat, dim=0) > 0.98

    # A run of two processes is not gone on with by one.
    with pytest.raises(PlannerError, match="processes was 2 and is 1"):
        train(ask(output=str(out), resume=True, **FLAGS), quiet)


@pytest.mark.usefixtures("forked")
def test_a_mistake_is_told_once(tmp_path: Path, models: Path) -> None:
    done = launched(2, level="mission", candidate="Llama-3.2-1B-Instruct", data_dir=tmp_path / "no")
    assert done.returncode != 0
    assert done.stderr.count("train.jsonl: no such file") == 1


@pytest.mark.parametrize(
    ("variables", "device", "message"),
    [
        ({}, "cuda:1", "each process takes a GPU of its own"),
        ({"ACCELERATE_USE_FSDP": "true"}, "auto", "FSDP: every process holds the whole model"),
        ({"ACCELERATE_USE_DEEPSPEED": "true"}, "auto", "DeepSpeed: every process holds"),
        ({"ACCELERATE_MIXED_PRECISION": "fp16"}, "auto", "launch with --mixed_precision no"),
        ({"LOCAL_RANK": "2"}, "auto", "more processes than the 2 GPUs of this machine"),
    ],
)
def test_what_several_processes_cannot_do_is_one_sentence(
    ask, monkeypatch, variables, device, message
):
    for name, value in variables.items():
        monkeypatch.setenv(name, value)
    monkeypatch.setattr(torch.cuda, "device_count", lambda: 2)
    with pytest.raises(PlannerError, match=message):
        ask(device=device, ranks=Ranks(1, 2))
    ask()


def test_a_process_alone_takes_any_of_accelerates_variables(ask, monkeypatch):
    monkeypatch.setenv("ACCELERATE_MIXED_PRECISION", "fp16")
    assert ask().processes == 1
