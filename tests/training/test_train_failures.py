"""What goes wrong in the middle of a run: one sentence with the way out, and the last checkpoint is
kept.
"""

from __future__ import annotations

import errno
import json

import pytest
import torch

from planner_ft.support.errors import PlannerError
from planner_ft.training import checkpoint, loop
from planner_ft.training.loop import InterruptedRunError
from planner_ft.training.run import train


def fail_at(monkeypatch, call: int, outcome) -> None:
    """Let the loss of the given optimiser step be `outcome()`."""
    original, calls = loop.loss_sum, []

    def failing(model, batch, dtype):
        calls.append(batch.ids)
        return outcome(model, batch, dtype) if len(calls) == call else original(model, batch, dtype)

    monkeypatch.setattr(loop, "loss_sum", failing)


def test_a_loss_that_is_not_finite_stops_the_run_and_leaves_the_checkpoint(
    ask, quiet, tmp_path, monkeypatch, reference, step_losses, short
):
    with monkeypatch.context() as patch:
        original = loop.loss_sum
        fail_at(patch, 5, lambda *args: original(*args) * float("nan"))
        with pytest.raises(PlannerError) as caught:
            train(ask(**short, checkpoint_steps=2), quiet)
    assert "step 5, sample mission-train-" in str(caught.value)
    assert "the loss is nan; lower --learning-rate (now 0.0002)" in str(caught.value)
    kept = [path.name for path in checkpoint.checkpoints(tmp_path / "adapter")]
    assert kept == ["step-00000002", "step-00000004"]
    assert (
        "failed"
        in json.loads((tmp_path / "adapter" / "checkpoints" / "run.json").read_text())["status"]
    )
    train(ask(**short, resume=True), quiet)
    assert step_losses(tmp_path / "adapter") == reference[0]


def test_a_gradient_that_is_not_finite_stops_before_the_weights_are_lost(
    ask, quiet, monkeypatch, short
):
    original = torch.nn.utils.clip_grad_norm_
    monkeypatch.setattr(
        torch.nn.utils, "clip_grad_norm_", lambda *args: original(*args) * float("inf")
    )
    with pytest.raises(PlannerError, match=r"step 1, sample .*: the gradient norm is inf"):
        train(ask(**short), quiet)


def test_out_of_memory_names_the_next_lever(ask, quiet, monkeypatch, short):
    def exhausted(*args):
        raise torch.OutOfMemoryError("CUDA out of memory. Tried to allocate 2.00 GiB")

    fail_at(monkeypatch, 2, exhausted)
    with pytest.raises(
        PlannerError,
        match=(
            r"out of memory on cpu; next: --gradient-checkpointing on; then --batch-size 1"
            r" --gradient-accumulation 2"
        ),
    ):
        train(ask(**short, batch_size=2), quiet)


def test_a_full_disk_keeps_the_last_checkpoint(
    ask, quiet, tmp_path, monkeypatch, reference, step_losses, short
):
    original = checkpoint._write

    def full(path, content):
        if "step-00000004" in str(path):
            raise OSError(errno.ENOSPC, "No space left on device")
        original(path, content)

    with monkeypatch.context() as patch:
        patch.setattr(checkpoint, "_write", full)
        with pytest.raises(
            PlannerError,
            match=(
                r"step-00000004: the checkpoint cannot be written \(No space left on device\); free"
                r" some space"
            ),
        ):
            train(ask(**short, checkpoint_steps=2), quiet)
    assert [path.name for path in (tmp_path / "adapter" / "checkpoints").glob("*step*")] == [
        "step-00000002"
    ]
    train(ask(**short, resume=True), quiet)
    assert step_losses(tmp_path / "adapter") == reference[0]


def test_a_corrupt_checkpoint_is_named(ask, quiet, tmp_path, monkeypatch, short, interrupt_at):
    with monkeypatch.context() as patch:
        interrupt_at(patch, 2)
        with pytest.raises(InterruptedRunError):
            train(ask(**short), quiet)
    path = tmp_path / "adapter" / "checkpoints" / "step-00000002" / "tensors.safetensors"
    path.write_bytes(path.read_bytes()[:100])
    with pytest.raises(
        PlannerError,
        match=r"step-00000002: the checkpoint cannot be read .* start again with --overwrite",
    ):
        train(ask(**short, resume=True), quiet)


@pytest.mark.parametrize("damage", ["truncated", "changed", "no state"])
def test_the_checkpoint_before_a_damaged_one_goes_on(
    ask, quiet, tmp_path, monkeypatch, short, interrupt_at, reference, step_losses, damage
):
    with monkeypatch.context() as patch:
        interrupt_at(patch, 5)
        with pytest.raises(InterruptedRunError):
            train(ask(**short, checkpoint_steps=2), quiet)
    newest = tmp_path / "adapter" / "checkpoints" / "step-00000005"
    tensors = newest / "tensors.safetensors"
    content = tensors.read_bytes()
    if damage == "truncated":
        tensors.write_bytes(content[:-100])
    elif damage == "changed":
        tensors.write_bytes(content[:-1] + bytes([content[-1] ^ 1]))
    else:
        (newest / "state.json").unlink()
    train(ask(**short, resume=True), quiet)
    said = quiet.export_text()
    assert "step-00000005 cannot be read" in said and "resuming at step 4" in said
    assert step_losses(tmp_path / "adapter") == reference[0]
    assert (tmp_path / "adapter" / "adapter_model.safetensors").read_bytes() == reference[1]


@pytest.mark.parametrize(
    ("modules", "told"),
    [
        ("query,key", "query,key"),
        ("q_proj,q_projx", "q_proj,q_projx: the model has no module q_projx"),
    ],
)
def test_target_modules_that_fit_nothing_are_an_error(ask, quiet, tmp_path, short, modules, told):
    with pytest.raises(PlannerError, match=f"--target-modules {told}"):
        train(ask(**short, target_modules=modules), quiet)
    assert not (tmp_path / "adapter").exists()
