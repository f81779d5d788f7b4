"""Checkpoints: everything that a run needs to continue as if it had not been interrupted.

A checkpoint is a folder `step-00000120` with `state.json` (position, history, Python's random
state, plain optimizer values) and `tensors.safetensors` (adapter, best adapter, optimizer moments,
torch and CUDA random states). It is written beside its final place and renamed, so that one is
complete or does not exist. No pickle is written or read.
"""

from __future__ import annotations

import contextlib
import json
import os
import shutil
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

import torch
from safetensors.torch import load as load_tensors
from safetensors.torch import save as save_tensors
from torch import Tensor

from planner_ft.support.errors import PlannerError
from planner_ft.training.model import adapter_parameters
from planner_ft.training.rng import restore_rng, rng_state

FOLDER = "checkpoints"
PREFIX = "step-"
TENSOR = "$tensor"


@dataclass
class TrainState:
    """Where a run stands. `step` counts optimiser steps; `history` holds one entry per
    validation.
    """

    step: int = 0
    tokens: int = 0
    completion_tokens: int = 0
    seconds: float = 0.0
    loss: float | None = None
    """Mean loss a completion token over the epoch in progress, or the one that just ended."""
    epoch_loss: float = 0.0
    epoch_tokens: int = 0
    """Sum of losses and number of completion tokens of the epoch in progress."""
    best_loss: float | None = None
    best_epoch: float | None = None
    history: list[dict[str, Any]] = field(default_factory=list)


@dataclass
class Trainee:
    """What a checkpoint saves besides the state: the model's adapter, the optimizer, and the best
    adapter so far.

    `best` is None while there is no validation or the current adapter is the best.
    """

    model: Any
    optimizer: torch.optim.Optimizer
    scaler: torch.amp.GradScaler
    best: dict[str, Tensor] | None = None


def adapter_tensors(model: Any) -> dict[str, Tensor]:
    """A copy of the adapter's weights on the CPU."""
    return {
        name: value.detach().to("cpu", copy=True)
        for name, value in adapter_parameters(model).items()
    }


def set_adapter(model: Any, tensors: dict[str, Tensor]) -> None:
    """Put weights from `adapter_tensors` into the model."""
    with torch.no_grad():
        for name, value in adapter_parameters(model).items():
            value.copy_(tensors[name])


def save_checkpoint(output: Path, state: TrainState, trainee: Trainee) -> Path:
    """Write a checkpoint of `state` under `output`, then remove the older ones. Raises PlannerError
    when the disk is full.
    """
    folder = output / FOLDER
    target = folder / f"{PREFIX}{state.step:08d}"
    temporary = folder / f".{target.name}.{os.getpid()}.tmp"
    values, tensors = _collect(state, trainee)
    try:
        temporary.mkdir(parents=True)
        _write(temporary / "tensors.safetensors", save_tensors(tensors))
        _write(temporary / "state.json", json.dumps(values).encode())
        shutil.rmtree(target, ignore_errors=True)
        temporary.rename(target)
        _sync(folder)
    except OSError as error:
        raise PlannerError(
            f"{target}: the checkpoint cannot be written ({error.strerror or error}); free some"
            " space and run the same command with --resume"
        ) from error
    finally:
        shutil.rmtree(temporary, ignore_errors=True)
    for older in checkpoints(output)[:-1]:
        shutil.rmtree(older, ignore_errors=True)
    return target


def load_checkpoint(path: Path, trainee: Trainee) -> TrainState:
    """Put a checkpoint's adapter, optimizer and random states in place and return its state."""
    try:
        values = json.loads((path / "state.json").read_text(encoding="utf-8"))
        tensors = load_tensors((path / "tensors.safetensors").read_bytes())
        parts = {
            part: {
                name.split("/", 1)[1]: value
                for name, value in tensors.items()
                if name.startswith(f"{part}/")
            }
            for part in ("adapter", "best", "rng")
        }
        set_adapter(trainee.model, parts["adapter"])
        _restore_optimizer(trainee.optimizer, values["optimizer"], tensors)
    except Exception as error:
        raise PlannerError(
            f"{path}: the checkpoint cannot be read ({error}); start again with --overwrite"
        ) from error
    trainee.best = parts["best"] or None
    if values["scaler"]:
        trainee.scaler.load_state_dict(values["scaler"])
    restore_rng({"python": values["python"], "tensors": parts["rng"]})
    return TrainState(**values["state"])


def checkpoints(output: Path) -> list[Path]:
    """Complete checkpoints under `output`, oldest first."""
    return sorted(path for path in (output / FOLDER).glob(f"{PREFIX}*") if path.is_dir())


def remove_leftovers(output: Path) -> None:
    """Remove checkpoints that a killed run had not finished writing."""
    for path in (output / FOLDER).glob(f".{PREFIX}*.tmp"):
        shutil.rmtree(path, ignore_errors=True)


def _collect(state: TrainState, trainee: Trainee) -> tuple[dict[str, Any], dict[str, Tensor]]:
    random = rng_state()
    tensors = {f"adapter/{name}": value for name, value in adapter_tensors(trainee.model).items()}
    tensors |= {f"best/{name}": value for name, value in (trainee.best or {}).items()}
    tensors |= {f"rng/{name}": value for name, value in random["tensors"].items()}
    # Groups (learning rate, betas) follow from the settings; only the moments are saved.
    optimizer = _take_tensors(trainee.optimizer.state_dict()["state"], "optimizer", tensors)
    return {
        "state": asdict(state),
        "optimizer": optimizer,
        "scaler": trainee.scaler.state_dict(),
        "python": random["python"],
    }, tensors


def _restore_optimizer(
    optimizer: torch.optim.Optimizer, values: dict[str, Any], tensors: dict[str, Tensor]
) -> None:
    entries = {int(index): _put_tensors(entry, tensors) for index, entry in values.items()}
    optimizer.load_state_dict(
        {"state": entries, "param_groups": optimizer.state_dict()["param_groups"]}
    )


def _take_tensors(value: Any, name: str, tensors: dict[str, Tensor]) -> Any:
    """`value` as JSON can hold it: every tensor goes into `tensors`, and its name there stands in
    its place.
    """
    if isinstance(value, Tensor):
        # A copy: safetensors refuses tensors that share memory, as the tables of 8-bit moments do.
        tensors[name] = value.detach().to("cpu", copy=True).contiguous()
        return {TENSOR: name}
    if isinstance(value, dict):
        return {
            str(key): _take_tensors(item, f"{name}/{key}", tensors) for key, item in value.items()
        }
    return value


def _put_tensors(value: Any, tensors: dict[str, Tensor]) -> Any:
    """The reverse of `_take_tensors`."""
    if not isinstance(value, dict):
        return value
    if TENSOR in value:
        return tensors[value[TENSOR]]
    return {key: _put_tensors(item, tensors) for key, item in value.items()}


def _write(path: Path, content: bytes) -> None:
    with open(path, "wb") as stream:
        stream.write(content)
        stream.flush()
        os.fsync(stream.fileno())


def _sync(folder: Path) -> None:
    """Make a rename in `folder` survive a power cut, where the system can."""
    with contextlib.suppress(OSError):
        descriptor = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(descriptor)
        finally:
            os.close(descriptor)
