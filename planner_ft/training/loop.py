"""The training loop: optimiser steps, validation, the best adapter, checkpoints, interruption."""

from __future__ import annotations

import contextlib
import math
import signal
import threading
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from types import FrameType
from typing import Any

import torch

from planner_ft.support.errors import PlannerError
from planner_ft.support.resources import peak_memory
from planner_ft.training.batches import Batch, collate, epoch_steps
from planner_ft.training.checkpoint import (
    Trainee,
    TrainState,
    adapter_tensors,
    save_checkpoint,
    set_adapter,
)
from planner_ft.training.model import adapter_parameters, loss_sum, packs, validation_loss
from planner_ft.training.report import Display, Trackers, TrainLog
from planner_ft.training.samples import Sample
from planner_ft.training.settings import TrainSettings


class InterruptedRunError(Exception):
    """The user stopped the run; a checkpoint holds everything up to `step` of `total`."""

    def __init__(self, step: int, total: int, signal_number: int) -> None:
        super().__init__(f"stopped at step {step} of {total}")
        self.step, self.total, self.signal_number = step, total, signal_number


@contextlib.contextmanager
def stop_signals(note: Callable[[str], None]) -> Iterator[list[int]]:
    """Ctrl-C and SIGTERM end the run after the step in progress; a second one ends it at once."""
    received: list[int] = []

    def handle(number: int, frame: FrameType | None) -> None:
        if received:
            raise KeyboardInterrupt
        received.append(number)
        note("stopping after this step and saving a checkpoint (Ctrl-C again: at once, without)")

    # Python lets only the main thread set handlers; elsewhere the caller's apply.
    main = threading.current_thread() is threading.main_thread()
    numbers = (signal.SIGINT, signal.SIGTERM) if main else ()
    before = {number: signal.signal(number, handle) for number in numbers}
    try:
        yield received
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


@dataclass
class Run:
    """Inputs of the loop. `pad` is the id that fills batches; layers compute in `dtype`."""

    settings: TrainSettings
    trainee: Trainee
    train: list[Sample]
    validation: list[Sample]
    pad: int
    device: torch.device
    dtype: torch.dtype
    output: Path
    log: TrainLog
    trackers: Trackers
    display: Display = field(init=False)

    @property
    def steps_per_epoch(self) -> int:
        """Optimiser steps of an epoch; the last one may be smaller."""
        size = self.settings.batch_size * self.settings.gradient_accumulation
        return math.ceil(len(self.train) / size)

    @property
    def total_steps(self) -> int:
        steps = self.settings.epochs * self.steps_per_epoch
        return min(steps, self.settings.max_steps or steps)

    def record(self, values: dict[str, Any]) -> None:
        """Write a line of the log and tell the trackers."""
        self.log.write(values)
        self.trackers.log(values)

    def epoch(self, step: int) -> float:
        """The epochs that `step` optimiser steps make."""
        return round(step / self.steps_per_epoch, 4)


def learning_rate(settings: TrainSettings, step: int, total: int) -> float:
    """Learning rate of step `step` (from 0) of `total`: linear warm-up, then the schedule."""
    warm = math.ceil(settings.warmup * total)
    if step < warm:
        return settings.learning_rate * (step + 1) / warm
    if settings.schedule == "constant":
        return settings.learning_rate
    progress = (step - warm) / max(1, total - warm)
    cosine = 0.5 * (1 + math.cos(math.pi * progress))
    return settings.learning_rate * (1 - progress if settings.schedule == "linear" else cosine)


def train_loop(run: Run, state: TrainState) -> None:
    """Train from `state` to the end; then the model holds the best (or last) adapter.

    Raises InterruptedRunError after Ctrl-C, and PlannerError when the loss is not finite or a file
    cannot be written.
    """
    run.trainee.model.train()
    saved = time.monotonic()
    with stop_signals(run.display.note) as signals:
        for batches in _remaining_steps(run, state):
            begun = time.monotonic()
            _step(run, state, batches)
            epoch_ends = state.step % run.steps_per_epoch == 0 or state.step == run.total_steps
            if epoch_ends:
                _end_epoch(run, state)
            state.seconds += time.monotonic() - begun
            stopped = bool(signals) and state.step < run.total_steps
            if epoch_ends or stopped or _checkpoint_due(run.settings, state.step, saved):
                save_checkpoint(run.output, state, run.trainee)
                saved = time.monotonic()
            if stopped:
                raise InterruptedRunError(state.step, run.total_steps, signals[0])
    if run.trainee.best is not None:
        set_adapter(run.trainee.model, run.trainee.best)


def _remaining_steps(run: Run, state: TrainState) -> Iterator[list[list[int]]]:
    """The batches of every optimiser step from the state's on."""
    lengths, s = [sample.length for sample in run.train], run.settings
    for epoch in range(state.step // run.steps_per_epoch, s.epochs):
        steps = epoch_steps(lengths, s.batch_size, s.gradient_accumulation, s.seed, epoch)
        for step in steps[state.step % run.steps_per_epoch :]:
            if state.step >= run.total_steps:
                return
            yield step


def _step(run: Run, state: TrainState, indices: list[list[int]]) -> None:
    """One optimiser step; the gradient is the mean over all completion tokens of its batches."""
    trainee, begun, packed = run.trainee, time.monotonic(), packs(run.trainee.model)
    rate = learning_rate(run.settings, state.step, run.total_steps)
    for group in trainee.optimizer.param_groups:
        group["lr"] = rate
    batches = [
        collate([run.train[index] for index in batch], run.pad, packed=packed) for batch in indices
    ]
    count = sum(len(batch.targets) for batch in batches)
    parts = []
    for batch in batches:
        part = loss_sum(trainee.model, batch.to(run.device), run.dtype) / count
        torch.autograd.backward(trainee.scaler.scale(part))
        parts.append(part.detach())
    # Read after the backward pass was queued: waiting for a GPU in between would leave it idle.
    losses = torch.stack(parts).tolist()
    for value, batch in zip(losses, batches, strict=True):
        if not math.isfinite(value):
            raise _not_finite(run, state, f"loss is {value}", batch)
    norm = _update(run, state, batches)
    loss, trained = sum(losses), sum(batch.tokens for batch in batches)
    state.step += 1
    state.tokens += trained
    state.completion_tokens += count
    state.epoch_loss += loss * count
    state.epoch_tokens += count
    state.loss = state.epoch_loss / state.epoch_tokens
    seconds = time.monotonic() - begun
    whole = state.seconds + seconds
    record = {"step": state.step, "epoch": run.epoch(state.step), "loss": loss, "lr": rate}
    record |= {"grad_norm": norm, "tokens": state.tokens, "step_tokens": trained}
    record |= {"seconds": round(whole, 3), "tokens_per_s": round(trained / seconds, 1)}
    run.record(record)
    remaining = (run.total_steps - state.step) * whole / state.step
    run.display.step(record, remaining, peak_memory(run.device))


def _update(run: Run, state: TrainState, batches: list[Batch]) -> float:
    """Clip the gradient, step the optimizer, and return the gradient's norm before clipping."""
    trainee = run.trainee
    trainee.scaler.unscale_(trainee.optimizer)
    weights = adapter_parameters(trainee.model).values()
    norm = float(torch.nn.utils.clip_grad_norm_(weights, run.settings.gradient_clip))
    # In float16 an overflow is ordinary: the scaler skips the step and scales the next loss less.
    if not math.isfinite(norm) and not trainee.scaler.is_enabled():
        raise _not_finite(run, state, f"gradient norm is {norm}", batches[0])
    trainee.scaler.step(trainee.optimizer)
    trainee.scaler.update()
    trainee.optimizer.zero_grad(set_to_none=True)
    return norm if math.isfinite(norm) else -1.0


def _not_finite(run: Run, state: TrainState, finding: str, batch: Batch) -> PlannerError:
    return PlannerError(
        f"step {state.step + 1}, sample {', '.join(batch.ids)}: the {finding}; lower"
        f" --learning-rate (now {run.settings.learning_rate:g}) or --gradient-clip (now"
        f" {run.settings.gradient_clip:g}), or look at that sample with --preview-id; the"
        f" checkpoints in {run.output} are from before"
    )


def _end_epoch(run: Run, state: TrainState) -> None:
    """Validate, and keep the adapter if it is the best so far."""
    epoch, begun = run.epoch(state.step), time.monotonic()
    text = f"epoch {epoch:g}: training loss {state.loss:.4f}"
    state.epoch_loss, state.epoch_tokens = 0.0, 0
    if run.validation:
        loss = validation_loss(run.trainee.model, run.validation, run.pad, run.device, run.dtype)
        if not math.isfinite(loss):
            rate = f"lower --learning-rate (now {run.settings.learning_rate:g})"
            raise PlannerError(f"epoch {epoch:g}: the validation loss is {loss}; {rate}")
        best = state.best_loss is None or loss < state.best_loss
        if best:
            state.best_loss, state.best_epoch = loss, epoch
            run.trainee.best = adapter_tensors(run.trainee.model)
        record = {"step": state.step, "epoch": epoch, "train_loss": state.loss}
        record |= {"validation_loss": loss, "best": best}
        record["seconds"] = round(time.monotonic() - begun, 3)
        state.history.append(record)
        run.record(record)
        text += f", validation loss {loss:.4f}{' (best)' if best else ''}"
    run.display.note(text)


def _checkpoint_due(settings: TrainSettings, step: int, saved: float) -> bool:
    by_step = settings.checkpoint_steps is not None and step % settings.checkpoint_steps == 0
    return by_step or time.monotonic() - saved > 60 * settings.checkpoint_minutes
