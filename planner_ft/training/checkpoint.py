"""Checkpoints: everything that a run needs to continue as if it had not been interrupted.

A checkpoint is a folder `step-00000120` with `state.json` (position, history, Python's random
state, plain optimizer values) and `tensors.safetensors` (adapter, best adapter, optimizer moments,
torch and CUDA random states). It is renamed into place when it is complete. No pickle is involved.
"""

from __future__ import annotations

import contextlib
import json
import os
import random
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
from planner_ft.training.output import CHECKPOINTS

PREFIX, TENSOR = "step-", "$tensor"


@dataclass
class TrainState:
    """Position of a run. `step` counts optimiser steps, `history` has an entry per validation.

    `loss` is the mean a completion token over the epoch in progress, or the one that just ended;
    `epoch_loss` and `epoch_tokens` are its sum of losses and its completion tokens so far.
    """

    step: int = 0
    tokens: int = 0
    completion_tokens: int = 0
    seconds: float = 0.0
    loss: float | None = None
    epoch_loss: float = 0.0
    epoch_tokens: int = 0
    best_loss: float | None = None
    best_epoch: float | None = None
    history: list[dict[str, Any]] = field(default_factory=list)


@dataclass
class Trainee:
    """The model with its adapter, optimizer, and the best adapter so far (None: the current)."""

    model: Any
    optimizer: torch.optim.Optimizer
    scaler: torch.amp.GradScaler
    best: dict[str, Tensor] | None = None


def adapter_tensors(model: Any) -> dict[str, Tensor]:
    """A copy of the adapter's weights on the CPU."""
    values = adapter_parameters(model).items()
    return {name: value.detach().to("cpu", copy=True) for name, value in values}


def set_adapter(model: Any, tensors: dict[str, Tensor]) -> None:
    """Put weights from `adapter_tensors` into the model."""
    with torch.no_grad():
        for name, value in adapter_parameters(model).items():
            value.copy_(tensors[name])


def save_checkpoint(output: Path, state: TrainState, trainee: Trainee) -> None:
    """Write a checkpoint under `output`, then remove older ones. Raises PlannerError: disk full."""
    folder = output / CHECKPOINTS
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


def load_checkpoint(path: Path, trainee: Trainee) -> TrainState:
    """Put a checkpoint's adapter, optimizer and random states in place and return its state."""
    try:
        values = json.loads((path / "state.json").read_text(encoding="utf-8"))
        tensors = load_tensors((path / "tensors.safetensors").read_bytes())
        set_adapter(trainee.model, _part(tensors, "adapter"))
        moments = {int(key): _put(entry, tensors) for key, entry in values["optimizer"].items()}
        groups = trainee.optimizer.state_dict()["param_groups"]
        trainee.optimizer.load_state_dict({"state": moments, "param_groups": groups})
    except Exception as error:
        raise PlannerError(
            f"{path}: the checkpoint cannot be read ({error}); start again with --overwrite"
        ) from error
    trainee.best = _part(tensors, "best") or None
    if values["scaler"]:
        trainee.scaler.load_state_dict(values["scaler"])
    restore_rng(values["python"], _part(tensors, "rng"))
    return TrainState(**values["state"])


def checkpoints(output: Path) -> list[Path]:
    """Complete checkpoints under `output`, oldest first."""
    return sorted(path for path in (output / CHECKPOINTS).glob(f"{PREFIX}*") if path.is_dir())


def remove_leftovers(output: Path) -> None:
    """Remove checkpoints that a killed run had not finished writing."""
    for path in (output / CHECKPOINTS).glob(f".{PREFIX}*.tmp"):
        shutil.rmtree(path, ignore_errors=True)


def _collect(state: TrainState, trainee: Trainee) -> tuple[dict[str, Any], dict[str, Tensor]]:
    """The values of state.json and the tensors, named PART/NAME."""
    python, generators = rng_state()
    parts = {"adapter": adapter_tensors(trainee.model), "best": trainee.best or {}}
    tensors = {
        f"{part}/{name}": value
        for part, named in {**parts, "rng": generators}.items()
        for name, value in named.items()
    }
    # Groups (learning rate, betas) follow from the settings; only the moments are saved.
    moments = _take(trainee.optimizer.state_dict()["state"], "optimizer", tensors)
    values = {"state": asdict(state), "scaler": trainee.scaler.state_dict(), "python": python}
    return {**values, "optimizer": moments}, tensors


def _part(tensors: dict[str, Tensor], part: str) -> dict[str, Tensor]:
    named = tensors.items()
    return {name.removeprefix(f"{part}/"): v for name, v in named if name.startswith(f"{part}/")}


def _take(value: Any, name: str, tensors: dict[str, Tensor]) -> Any:
    """`value` for JSON: every tensor moves into `tensors`, its name there takes its place."""
    if isinstance(value, Tensor):
        # A copy: safetensors refuses tensors that share memory, as the tables of 8-bit moments do.
        tensors[name] = value.detach().to("cpu", copy=True).contiguous()
        return {TENSOR: name}
    if isinstance(value, dict):
        return {str(key): _take(item, f"{name}/{key}", tensors) for key, item in value.items()}
    return value


def _put(value: Any, tensors: dict[str, Tensor]) -> Any:
    """The reverse of `_take`."""
    if not isinstance(value, dict):
        return value
    if TENSOR in value:
        return tensors[value[TENSOR]]
    return {key: _put(item, tensors) for key, item in value.items()}


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


def rng_state() -> tuple[list[Any], dict[str, Tensor]]:
    """States of the generators: Python's for JSON, and byte tensors "torch", "cuda:0", ..."""
    version, values, gauss = random.getstate()
    cuda = torch.cuda.get_rng_state_all() if torch.cuda.is_available() else []
    tensors = {f"cuda:{index}": state for index, state in enumerate(cuda)}
    return [version, list(values), gauss], {"torch": torch.get_rng_state(), **tensors}


def restore_rng(python: list[Any], tensors: dict[str, Tensor]) -> None:
    """Set the generators to states from `rng_state`; devices that are not here are skipped."""
    version, values, gauss = python
    random.setstate((version, tuple(values), gauss))
    torch.set_rng_state(tensors["torch"])
    for index in range(torch.cuda.device_count()):
        if f"cuda:{index}" in tensors:
            torch.cuda.set_rng_state(tensors[f"cuda:{index}"], index)


def seed_everything(seed: int) -> None:
    """Seed all generators."""
    random.seed(seed)
    torch.manual_seed(seed)
