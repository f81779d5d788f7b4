"""Opening a run: the model with its adapter, probed; the output folder; the state to go on from."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import torch

from planner_ft.candidates.loading import compute_dtype, load_model
from planner_ft.support.errors import PlannerError
from planner_ft.training.checkpoint import (
    Trainee,
    TrainState,
    checkpoints,
    load_checkpoint,
    remove_leftovers,
    seed_everything,
)
from planner_ft.training.loop import Run, total_steps
from planner_ft.training.model import (
    SMALL_MODEL,
    adapter_parameters,
    attach_adapter,
    cpu_threads,
    make_optimizer,
    memory_levers,
    unpack,
    uses_gradient_checkpointing,
)
from planner_ft.training.output import clear, write_run
from planner_ft.training.preflight import Finding, Prepared
from planner_ft.training.probe import probe_model
from planner_ft.training.report import Trackers, TrainLog, make_display
from planner_ft.training.request import TrainRequest

if TYPE_CHECKING:
    from rich.console import Console


def ready_model(request: TrainRequest, prepared: Prepared) -> tuple[Any, Finding]:
    """The base model with a new adapter, and whether every adapter weight learns."""
    settings = request.settings
    assert prepared.device and prepared.train
    base = load_model(
        request.candidate,
        device=str(prepared.device),
        quantization=settings.quantization,
        trainable=True,
    )
    if prepared.device.type == "cpu":
        unpack(base)
    model = attach_adapter(base, settings, request.candidate.reference)
    samples, device = prepared.train.samples, prepared.device
    dtype = compute_dtype(device)
    problems = probe_model(model, samples, pad_id(prepared), settings.batch_size, device, dtype)
    sizes = [value.numel() for value in adapter_parameters(model).values()]
    text = (
        f"all {len(sizes)} adapter matrices learn ({sum(sizes):,} weights), also after a"
        " validation pass"
    )
    return model, Finding("gradients", "" if problems else text, problems)


@contextlib.contextmanager
def open_run(
    request: TrainRequest,
    prepared: Prepared,
    model: Any,
    console: Console,
    fingerprint: dict[str, Any],
) -> Iterator[tuple[Run, TrainState]]:
    """Prepare the output folder, load the newest checkpoint to resume, open log and display."""
    assert prepared.device and prepared.train
    settings, output, samples = request.settings, request.output, prepared.train.samples
    dtype = compute_dtype(prepared.device)
    scaler = torch.amp.GradScaler(prepared.device.type, enabled=dtype == torch.float16)
    trainee = Trainee(model, make_optimizer(model, settings), scaler)
    if not request.resume:
        clear(output)
    write_run(output, fingerprint, "running")
    seed_everything(settings.seed)
    state = _resumed(request, trainee, console) if request.resume else TrainState()
    log = TrainLog(output, state.step)
    trackers = Trackers(settings, output, f"{request.candidate.slug}-{request.level}")
    total = total_steps(settings, len(samples))
    display = make_display(console, total, state.step, settings.log_every)
    run = Run(
        settings,
        trainee,
        samples,
        prepared.validation.samples if prepared.validation else [],
        pad_id(prepared),
        prepared.device,
        dtype,
        output,
        log,
        trackers,
        display,
    )
    try:
        yield run, state
    finally:
        display.close()
        trackers.close()
        log.close()


def _resumed(request: TrainRequest, trainee: Trainee, console: Console) -> TrainState:
    remove_leftovers(request.output)
    found = checkpoints(request.output)
    if not found:
        console.print("no checkpoint was written yet: starting from the beginning", highlight=False)
        return TrainState()
    state = load_checkpoint(found[-1], trainee)
    console.print(f"resuming at step {state.step}", highlight=False)
    return state


@contextlib.contextmanager
def limited_threads(request: TrainRequest, prepared: Prepared) -> Iterator[None]:
    """In the block, a run on the CPU has the threads that its settings say."""
    before = torch.get_num_threads()
    if prepared.device and prepared.device.type == "cpu":
        parameters = request.candidate.parameters or SMALL_MODEL
        torch.set_num_threads(cpu_threads(request.settings, parameters))
    try:
        yield
    finally:
        torch.set_num_threads(before)


@contextlib.contextmanager
def memory_errors(request: TrainRequest, prepared: Prepared) -> Iterator[None]:
    """Turn running out of memory into a sentence that names the next lever."""
    try:
        yield
    except (torch.OutOfMemoryError, MemoryError, RuntimeError) as error:
        if type(error) is RuntimeError and "allocate memory" not in str(error):
            raise
        longest, size = (
            prepared.train.longest if prepared.train else 0,
            request.candidate.parameters,
        )
        checkpointing = uses_gradient_checkpointing(request.settings, size or 0)
        advice = memory_levers(request.settings, checkpointing, longest)
        raise PlannerError(
            f"out of memory on {prepared.device}; {advice}. The checkpoints so far are kept: see"
            f" {request.output}"
        ) from error


def pad_id(prepared: Prepared) -> int:
    """An id to fill batches with."""
    pad = prepared.tokenizer.pad_token_id if prepared.tokenizer else None
    return pad if isinstance(pad, int) else 0
