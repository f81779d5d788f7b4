"""A run's state, and checkpoints: all that it needs to go on as if it had not been interrupted.

A checkpoint is a folder `step-00000120` with `state.json` (position, history, plain optimizer
values, the digest of the tensors) and `tensors.safetensors` (adapter, best adapter, optimizer
moments, torch and CUDA random states). It is renamed into place when it is complete, and the one
before stays in case it is damaged. No pickle is involved.
"""

import hashlib
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
from planner_ft.support.files import sync_folder, writing
from planner_ft.support.ranks import ALONE, Ranks
from planner_ft.training.model import adapter_tensors, make_optimizer, set_adapter
from planner_ft.training.report import GO_ON, Report
from planner_ft.training.samples import Sample
from planner_ft.training.settings import TrainSettings

CHECKPOINTS = "checkpoints"
KEPT = 2
PREFIX, TENSOR = "step-", "$tensor"
JUDGED = ("f1", "strict_valid", "exact_sequence")
"""Metrics of answers to validation samples."""
Answer = dict[str, Any]
"""Id and family of a validation sample, and the JUDGED metrics of its answer."""


@dataclass
class TrainState:
    """Position of a run. `step` counts optimiser steps, `history` has an entry per validation.

    `loss` is the mean a completion token over the epoch in progress, or the one that just ended;
    `epoch_loss` and `epoch_tokens` are its sum of losses and its completion tokens so far.
    `best_rank` orders adapters (smaller is better), `base_answers` and `best_answers` are those of
    the base and of the best adapter.
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
    best_rank: list[float] | None = None
    base_answers: list[Answer] | None = None
    best_answers: list[Answer] | None = None
    history: list[dict[str, Any]] = field(default_factory=list)


@dataclass
class Run:
    """A model in training; `pad` fills batches, layers compute in `dtype`, `best`: None if last,
    `judge` answers validation samples (planner_ft.benchmark.judge).
    """

    settings: TrainSettings
    model: Any
    train: list[Sample]
    validation: list[Sample]
    pad: int
    device: torch.device
    dtype: torch.dtype
    output: Path
    state: TrainState = field(default_factory=TrainState)
    best: dict[str, Tensor] | None = None
    report: Report = field(init=False)
    judge: Any = None
    ranks: Ranks = ALONE

    def __post_init__(self) -> None:
        self.optimizer = make_optimizer(self.model, self.settings)
        half = self.dtype == torch.float16
        self.scaler = torch.amp.GradScaler(self.device.type, enabled=half)
        size = self.settings.batch_size * self.settings.gradient_accumulation * self.ranks.batches
        self.steps_per_epoch = -(-len(self.train) // size)
        steps = self.settings.epochs * self.steps_per_epoch
        self.total_steps = min(steps, self.settings.max_steps or steps)

    @property
    def epoch(self) -> float:
        """The epochs trained so far."""
        return round(self.state.step / self.steps_per_epoch, 4)


def save_checkpoint(run: Run) -> None:
    """Write a checkpoint, then remove all but the last KEPT; of several processes the first does.
    Raises PlannerError: disk full.
    """
    if not run.ranks.leads:
        return
    folder = run.output / CHECKPOINTS
    target = folder / f"{PREFIX}{run.state.step:08d}"
    temporary = folder / f".{target.name}.{os.getpid()}.tmp"
    cuda = torch.cuda.get_rng_state_all() if torch.cuda.is_available() else []
    random = {"torch": torch.get_rng_state(), **{f"cuda:{i}": s for i, s in enumerate(cuda)}}
    parts = {"adapter": adapter_tensors(run.model), "best": run.best or {}, "rng": random}
    tensors = {f"{part}/{name}": v for part, named in parts.items() for name, v in named.items()}
    # Groups (learning rate, betas) follow from the settings; only the moments are saved.
    moments = _take(run.optimizer.state_dict()["state"], "optimizer", tensors)
    content = save_tensors(tensors)
    values = {"state": asdict(run.state), "scaler": run.scaler.state_dict(), "optimizer": moments}
    values["sha256"] = hashlib.sha256(content).hexdigest()
    try:
        with writing(target, GO_ON, "the checkpoint cannot be written"):
            temporary.mkdir(parents=True)
            _write(temporary / "tensors.safetensors", content)
            _write(temporary / "state.json", json.dumps(values).encode())
            shutil.rmtree(target, ignore_errors=True)
            temporary.rename(target)
            sync_folder(folder)
    finally:
        shutil.rmtree(temporary, ignore_errors=True)
    for older in checkpoints(run.output)[:-KEPT]:
        shutil.rmtree(older, ignore_errors=True)


def load_newest_checkpoint(run: Run) -> str:
    """Go back to the newest whole checkpoint and say so. Raises PlannerError without one."""
    for path in (run.output / CHECKPOINTS).glob(f".{PREFIX}*.tmp"):
        shutil.rmtree(path, ignore_errors=True)
    damaged: dict[Path, Exception] = {}
    for path in reversed(checkpoints(run.output)):
        try:
            load_checkpoint(path, run)
        except Exception as error:  # a damaged file fails in many ways
            damaged[path] = error
            continue
        for other in damaged:
            shutil.rmtree(other, ignore_errors=True)
        notes = [f"{other} cannot be read ({reason})" for other, reason in damaged.items()]
        return "; ".join([*notes, f"resuming at step {run.state.step}"])
    for path, reason in damaged.items():
        raise PlannerError(
            f"{path}: the checkpoint cannot be read ({reason}); start again with --overwrite"
        ) from reason
    return "no checkpoint was written yet: starting from the beginning"


def load_checkpoint(path: Path, run: Run) -> None:
    """Put a checkpoint's adapter, optimizer, random states and position in place."""
    values = json.loads((path / "state.json").read_text(encoding="utf-8"))
    content = (path / "tensors.safetensors").read_bytes()
    digest = hashlib.sha256(content).hexdigest()
    if values.get("sha256", digest) != digest:
        raise ValueError("its tensors are not those that were written")
    tensors = load_tensors(content)
    set_adapter(run.model, _part(tensors, "adapter"))
    moments = {int(key): _put(entry, tensors) for key, entry in values["optimizer"].items()}
    groups = run.optimizer.state_dict()["param_groups"]
    run.optimizer.load_state_dict({"state": moments, "param_groups": groups})
    run.best = _part(tensors, "best") or None
    if values["scaler"]:
        run.scaler.load_state_dict(values["scaler"])
    torch.set_rng_state(tensors["rng/torch"])
    for index in range(torch.cuda.device_count()):
        if f"rng/cuda:{index}" in tensors:
            torch.cuda.set_rng_state(tensors[f"rng/cuda:{index}"], index)
    run.state = TrainState(**values["state"])


def checkpoints(output: Path) -> list[Path]:
    """Complete checkpoints under `output`, oldest first."""
    return sorted(path for path in (output / CHECKPOINTS).glob(f"{PREFIX}*") if path.is_dir())


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
