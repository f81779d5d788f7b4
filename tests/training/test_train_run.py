"""Whole runs on stand-ins: the adapter folder, interruption and resuming, and everything that can
go wrong on the way.
"""

from __future__ import annotations

import json
import multiprocessing
import signal
import sys
import time
from pathlib import Path

import jsonschema
import pytest
import torch
from safetensors.torch import load_file

from planner_ft.support.alone import alone
from planner_ft.support.errors import PlannerError
from planner_ft.training import checkpoint, loop
from planner_ft.training.loop import InterruptedRunError
from planner_ft.training.model import adapter_tensors
from planner_ft.training.run import train


def test_the_folder_of_a_finished_run(ask, quiet, tmp_path, short):
    manifest = train(ask(**short), quiet)
    output = tmp_path / "adapter"
    names = {path.name for path in output.iterdir()}
    assert names == {
        "adapter_config.json",
        "adapter_model.safetensors",
        "tokenizer.json",
        "tokenizer_config.json",
        "chat_template.jinja",
        "generation_config.json",
        "manifest.json",
        "README.md",
        "samples.txt",
        "train_log.jsonl",
        "loss.png",
        "loss.svg",
    }
    assert json.loads((output / "manifest.json").read_text()) == json.loads(json.dumps(manifest))
    schema = json.loads(
        (Path(__file__).parents[2] / "schemas" / "manifest.schema.json").read_text()
    )
    jsonschema.validate(manifest, schema)
    assert manifest["is_standin"] is True
    assert manifest["samples"] == {"training": 8, "validation": 3}
    assert manifest["result"]["steps"] == 16
    assert manifest["result"]["tokens"] == sum(
        json.loads(line).get("step_tokens", 0)
        for line in (output / "train_log.jsonl").read_text().splitlines()
    )
    assert [entry["epoch"] for entry in manifest["result"]["history"]] == [1, 2]
    assert manifest["configuration"]["alpha"] == 8
    assert (output / "loss.png").read_bytes().startswith(b"\x89PNG")
    card = (output / "README.md").read_text()
    assert card.startswith(
        "---\nbase_model: meta-llama/Llama-3.2-1B-Instruct\nlanguage: en\nlibrary_name: peft\n"
    )
    assert "**Stand-in.**" in card


def test_the_adapter_loads_with_plain_peft_and_has_learned(ask, quiet, tmp_path, models):
    from peft import PeftModel
    from transformers import AutoModelForCausalLM, AutoTokenizer

    from planner_ft.candidates.adapters import check_adapter

    request = ask(epochs=6, learning_rate=1e-2, quantization="none")
    manifest = train(request, quiet)
    config = json.loads((tmp_path / "adapter" / "adapter_config.json").read_text())
    assert config["base_model_name_or_path"] == str(models / "Llama-3.2-1B-Instruct")
    base = AutoModelForCausalLM.from_pretrained(config["base_model_name_or_path"])
    model = PeftModel.from_pretrained(base, str(tmp_path / "adapter")).eval()
    tokenizer = AutoTokenizer.from_pretrained(tmp_path / "adapter")
    assert tokenizer.chat_template
    assert validation(model, request, tokenizer) == pytest.approx(
        manifest["result"]["validation_loss"], rel=0.01
    )
    history = manifest["result"]["history"]
    assert history[-1]["train_loss"] < history[0]["train_loss"] - 0.3
    known = {"level": "mission", "vocabulary": request.vocabulary}
    check_adapter(tmp_path / "adapter", request.candidate, **known)
    assert model.peft_config["default"].r == 16


def validation(model, request, tokenizer) -> float:
    """Mean loss a completion token of the validation split, with the model's own loss function."""
    from planner_ft.prompts import render_sample

    total, count = 0.0, 0
    for line in request.validation_file.read_text().splitlines():
        rendered = render_sample("mission", json.loads(line), tokenizer, request.vocabulary)
        ids = torch.tensor([rendered.input_ids])
        mask = torch.tensor([rendered.completion_mask])
        with torch.no_grad():
            total += float(
                model(input_ids=ids, labels=ids.masked_fill(mask == 0, -100)).loss
            ) * int(mask.sum())
        count += int(mask.sum())
    return total / count


def test_the_same_seed_gives_the_same_run_and_another_seed_another(
    ask, quiet, tmp_path, reference, step_losses, short
):
    train(ask(**short), quiet)
    assert step_losses(tmp_path / "adapter") == reference[0]
    train(ask(**short, seed=1, output=str(tmp_path / "other")), quiet)
    assert step_losses(tmp_path / "other") != reference[0]


def test_the_best_adapter_is_kept(ask, quiet, tmp_path, monkeypatch):
    seen = []
    values = iter([2.0, 1.0, 3.0])

    def pretended(model, *args):
        seen.append(adapter_tensors(model))
        return next(values)

    monkeypatch.setattr(loop, "validation_loss", pretended)
    manifest = train(ask(epochs=3, rank=4, learning_rate=1e-2), quiet)
    assert (manifest["result"]["validation_loss"], manifest["result"]["best_epoch"]) == (1.0, 2)
    saved = load_file(tmp_path / "adapter" / "adapter_model.safetensors")
    for name, value in seen[1].items():
        assert torch.equal(saved[name.replace(".default", "")], value)


@pytest.mark.parametrize("step", [3, 8, 11])
def test_ctrl_c_then_resume_gives_the_losses_of_an_uninterrupted_run(
    ask, quiet, tmp_path, monkeypatch, reference, step_losses, step, short, interrupt_at
):
    """In an epoch, at its end, and after the best adapter was put aside."""
    with monkeypatch.context() as patch:
        interrupt_at(patch, step)
        with pytest.raises(InterruptedRunError) as stop:
            train(ask(**short), quiet)
    assert (stop.value.step, stop.value.total, stop.value.signal_number) == (
        step,
        16,
        signal.SIGINT,
    )
    assert not (tmp_path / "adapter" / "manifest.json").exists()
    torch.manual_seed(999)
    train(ask(**short, resume=True), quiet)
    assert step_losses(tmp_path / "adapter") == reference[0]
    assert (tmp_path / "adapter" / "adapter_model.safetensors").read_bytes() == reference[1]
    assert not (tmp_path / "adapter" / "checkpoints").exists()


@pytest.mark.parametrize(
    "values",
    [
        {"optimizer": "adamw-8bit", "rank": 64},
        {"batch_size": 2, "gradient_accumulation": 2, "gradient_checkpointing": "on"},
    ],
)
def test_resuming_is_exact_with_other_optimizers_and_batches(
    ask, quiet, tmp_path, monkeypatch, step_losses, values, short, interrupt_at
):
    settings = {**short, "epochs": 3, **values}
    train(ask(**settings, output=str(tmp_path / "whole")), quiet)
    with monkeypatch.context() as patch:
        interrupt_at(patch, 3)
        with pytest.raises(InterruptedRunError):
            train(ask(**settings), quiet)
    train(ask(**settings, resume=True), quiet)
    assert step_losses(tmp_path / "adapter") == step_losses(tmp_path / "whole")


COMMAND = (
    "--level",
    "mission",
    "--candidate",
    "Llama-3.2-1B-Instruct",
    "--rank",
    "4",
    "--epochs",
    "2",
    "--log-every",
    "1",
)


def test_kill_9_loses_only_what_came_after_the_last_checkpoint(
    ask, quiet, data, tmp_path, reference, step_losses, short
):
    output = tmp_path / "killed"
    first, step = ask(**short, output=str(output)), loop._step

    def slow() -> None:
        # It stops before step 11: the kill meets the run between the checkpoint after step 8 and
        # the end.
        torch.set_num_threads(1)
        loop._step = lambda run, *a: (run.state.step == 10 and signal.pause(), step(run, *a))
        train(first, quiet)

    process = multiprocessing.get_context("fork").Process(target=slow)
    process.start()
    resumed = ask(**short, output=str(output), resume=True)
    deadline = time.monotonic() + 600
    while (
        process.is_alive()
        and time.monotonic() < deadline
        and not ((output / "train_log.jsonl").exists() and len(step_losses(output)) >= 10)
    ):
        time.sleep(0.02)
    with pytest.raises(PlannerError, match="a training runs there; wait for its end"):
        train(resumed, quiet)
    process.kill()
    process.join()
    assert process.exitcode == -signal.SIGKILL
    assert [path.name for path in checkpoint.checkpoints(output)] == ["step-00000008"]
    (output / "checkpoints" / ".step-00000099.1.tmp").mkdir()
    with open(output / "train_log.jsonl", "a") as log:
        log.write('{"step": 99, "lo')
    train(resumed, quiet)
    assert step_losses(output) == reference[0]
    assert (output / "adapter_model.safetensors").read_bytes() == reference[1]


def test_a_resumed_run_still_knows_the_best_adapter(
    ask, quiet, tmp_path, monkeypatch, short, interrupt_at
):
    seen = []
    values = iter([1.0, 2.0])

    def pretended(model, *args):
        seen.append(adapter_tensors(model))
        return next(values)

    monkeypatch.setattr(loop, "validation_loss", pretended)
    with monkeypatch.context() as patch:
        interrupt_at(patch, 11)
        with pytest.raises(InterruptedRunError):
            train(ask(**short), quiet)
    assert train(ask(**short, resume=True), quiet)["result"]["best_epoch"] == 1
    saved = load_file(tmp_path / "adapter" / "adapter_model.safetensors")
    assert all(
        torch.equal(saved[name.replace(".default", "")], value) for name, value in seen[0].items()
    )


def test_ctrl_c_on_the_command_line_exits_with_130_and_says_how_to_go_on(
    models, data, tmp_path, monkeypatch, capsys, interrupt_at
):
    from planner_ft.cli import main

    output = str(tmp_path / "adapter")
    monkeypatch.setattr(
        sys,
        "argv",
        [
            "plannerft",
            "train",
            *COMMAND,
            "--data-dir",
            str(data),
            "--output",
            output,
            "--overwrite",
        ],
    )
    with monkeypatch.context() as patch:
        interrupt_at(patch, 4)
        with pytest.raises(SystemExit) as stop:
            main()
    assert stop.value.code == 130
    printed = capsys.readouterr().out
    assert "stopped at step 4 of 16" in printed
    assert (
        f"plannerft train {' '.join(COMMAND)} --data-dir {data} --output {output} --resume"
        in printed
    )
    with monkeypatch.context() as patch:
        patch.setattr(
            sys,
            "argv",
            ["plannerft", "train", *COMMAND, "--data-dir", str(data), "--output", output],
        )
        with pytest.raises(SystemExit) as stop:
            main()
    assert stop.value.code == 2
    assert (
        "holds an unfinished run; give --resume to continue it, --overwrite to start again"
        in capsys.readouterr().err
    )


def test_termination_saves_as_well(ask, quiet, monkeypatch, short, interrupt_at):
    interrupt_at(monkeypatch, 2, signal.SIGTERM)
    with pytest.raises(InterruptedRunError) as stop:
        train(ask(**short), quiet)
    assert stop.value.signal_number == signal.SIGTERM


def test_resume_refuses_another_run(
    ask, quiet, data, monkeypatch, write, curated, short, interrupt_at
):
    with monkeypatch.context() as patch:
        interrupt_at(patch, 2)
        with pytest.raises(InterruptedRunError):
            train(ask(**short), quiet)
    with pytest.raises(
        PlannerError, match=r"--learning-rate was 0.0002 and is 0.001; --seed was 0 and is 3"
    ):
        train(ask(**short, seed=3, learning_rate=1e-3, resume=True), quiet)
    write(data / "train.jsonl", curated(8, skip=1))
    with pytest.raises(PlannerError, match="the training data changed since"):
        train(ask(**short, resume=True), quiet)


def test_a_finished_run_is_complete_protected_and_can_be_replaced(ask, quiet, tmp_path, short):
    first = train(ask(**short), quiet)
    (tmp_path / "adapter" / "notes.txt").write_text("mine")
    assert train(ask(**short, resume=True), quiet) is None
    assert "this run is complete; nothing to resume" in quiet.export_text()
    with pytest.raises(PlannerError, match="holds a finished adapter; give --overwrite"):
        train(ask(**short), quiet)
    second = train(ask(**short, overwrite=True), quiet)
    assert (
        second["outputs"]["adapter_model.safetensors"]
        == first["outputs"]["adapter_model.safetensors"]
    )
    assert (tmp_path / "adapter" / "notes.txt").read_text() == "mine"


@pytest.mark.parametrize("options", [{}, {"overwrite": True}, {"resume": True}])
def test_a_second_run_in_one_folder_is_refused(ask, quiet, tmp_path, short, options):
    with (
        alone(tmp_path / "new" / "adapter", "--output", "a training"),
        pytest.raises(PlannerError, match=r"--output .*adapter: a training runs there"),
    ):
        train(ask(**short, **options, output=str(tmp_path / "new" / "adapter")), quiet)
    assert not (tmp_path / "new").exists()


@pytest.mark.parametrize("left", [None, "checkpoints/.run.json.12.abcdef.tmp"])
def test_resume_without_a_run_starts_and_says_so(ask, quiet, tmp_path, short, left):
    """Also after a kill during start-up, which left no more than part of a file."""
    if left:
        (tmp_path / "adapter" / left).parent.mkdir(parents=True)
        (tmp_path / "adapter" / left).write_text("{")
    assert train(ask(**short, resume=True), quiet)["result"]["steps"] == 16
    assert "holds no run: starting from the beginning" in quiet.export_text()


def test_a_kill_while_the_former_run_is_removed_leaves_a_run_to_resume(
    ask, quiet, tmp_path, monkeypatch, reference, step_losses, short
):
    from planner_ft.training import output

    def killed(*args, **options):
        raise KeyboardInterrupt

    train(ask(**short, seed=1), quiet)
    with monkeypatch.context() as patch:
        patch.setattr(output.shutil, "rmtree", killed)
        with pytest.raises(KeyboardInterrupt):
            train(ask(**short, overwrite=True), quiet)
    train(ask(**short, resume=True), quiet)
    assert step_losses(tmp_path / "adapter") == reference[0]


def test_checkpoints_can_be_kept(ask, quiet, tmp_path, short):
    train(ask(**short, keep_checkpoints=True), quiet)
    kept = sorted(path.name for path in (tmp_path / "adapter" / "checkpoints").iterdir())
    assert kept == ["step-00000008", "step-00000016"]
    assert train(ask(**short, resume=True), quiet) is None


def test_max_steps_ends_the_run_with_a_validation(ask, quiet, short):
    manifest = train(ask(**short, max_steps=3), quiet)
    assert manifest["result"]["steps"] == 3
    assert [entry["step"] for entry in manifest["result"]["history"]] == [3]


def test_without_validation_the_last_adapter_is_kept(ask, quiet, data, tmp_path, short):
    manifest = train(ask(**short, data_dir=None, train_file=str(data / "train.jsonl")), quiet)
    assert manifest["result"]["validation_loss"] is None
    assert load_file(tmp_path / "adapter" / "adapter_model.safetensors")


def test_trackers_get_the_losses(ask, quiet, tmp_path, short):
    pytest.importorskip("tensorboard")
    from tensorboard.backend.event_processing.event_accumulator import EventAccumulator

    train(ask(**short, max_steps=3, report_to="tensorboard"), quiet)
    events = EventAccumulator(str(tmp_path / "adapter" / "logs" / "Llama-3.2-1B-Instruct-mission"))
    events.Reload()
    assert [event.step for event in events.Scalars("loss")] == [1, 2, 3]
    assert [event.step for event in events.Scalars("validation_loss")] == [3]


@pytest.mark.parametrize(
    "name",
    [
        "Llama-3.2-1B",
        "Llama-3.2-1B-Instruct",
        "Llama-3.2-3B",
        "Llama-3.2-3B-Instruct",
        "Qwen2.5-3B",
        "Qwen2.5-3B-Instruct",
        "Llama-3.1-8B",
    ],
)
def test_every_published_candidate_trains(ask, quiet, name):
    manifest = train(ask(candidate=name, max_steps=2, max_samples=2), quiet)
    assert manifest["base"]["name"] == name
    assert manifest["result"]["steps"] == 2


def test_the_task_level_trains(ask, quiet, write, tmp_path):
    from planner_ft.data.task.sampler import sample_tasks
    from planner_ft.vocabulary import load_vocabulary

    records = sorted(
        sample_tasks(load_vocabulary(), 0, 40, "train"), key=lambda record: len(str(record))
    )
    write(tmp_path / "task" / "train.jsonl", records[:4])
    write(tmp_path / "task" / "validation.jsonl", records[4:6])
    manifest = train(ask(level="task", data_dir=str(tmp_path / "task")), quiet)
    assert manifest["level"] == "task"
    assert (manifest["configuration"]["rank"], manifest["result"]["steps"]) == (8, 8)


def test_the_next_command_names_vehicle_and_data(ask, data, write, curated):
    from planner_ft.cli.train import _next

    assert not {"--vocabulary", "--data"} & set(_next(ask()))
    tests = write(data / "test.jsonl", curated(1))
    drone = _next(ask(vocabulary="inspection_drone"))
    assert drone[-4:] == ["--vocabulary", "inspection_drone", "--data", str(tests)]
