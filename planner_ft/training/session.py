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
)
from planner_ft.training.loop import Run, total_steps
from planner_ft.training.model import (
    SMALL_MODEL,
    adapter_parameters,
    attach_adapter,
    cpu_threads,
    make_optimizer,
    memory_levers,
    uses_gradient_checkpointing,
)
from planner_ft.training.output import clear, write_run
from planner_ft.training.preflight import Finding, Prepared
from planner_ft.training.probe import probe_model
from planner_ft.training.report import Trackers, TrainLog, make_display
from planner_ft.training.request import TrainRequest
from planner_ft.training.rng import seed_everything
from planner_ft.training.unpacking import unpack

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
    problems = probe_model(
        model,
        prepared.train.samples,
        pad_id(prepared),
        settings.batch_size,
        prepared.device,
        compute_dtype(prepared.device),
    )
    parameters = adapter_parameters(model)
    text = (
        f"all {len(parameters)} adapter matrices learn"
        f" ({sum(value.numel() for value in parameters.values()):,} weights), also after a"
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
    """Make the output folder ready, go to the newest checkpoint where the run is resumed, and open
    log and display.
    """
    assert prepared.device and prepared.train
    settings, output = request.settings, request.output
    dtype = compute_dtype(prepared.device)
    trainee = Trainee(
        model,
        make_optimizer(model, settings),
        torch.amp.GradScaler(prepared.device.type, enabled=dtype == torch.float16),
    )
    if not request.resume:
        clear(output)
    write_run(output, fingerprint, "running")
    seed_everything(settings.seed)
    state = _resumed(request, trainee, console) if request.resume else TrainState()
    log = TrainLog(output, state.step)
    trackers = Trackers(settings, output, f"{request.candidate.slug}-{request.level}")
    display = make_display(
        console, total_steps(settings, len(prepared.train.samples)), state.step, settings.log_every
    )
    validation = prepared.validation.samples if prepared.validation else []
    try:
        yield (
            Run(
                settings,
                trainee,
                prepared.train.samples,
                validation,
                pad_id(prepared),
                prepared.device,
                dtype,
                output,
                log,
                trackers,
                display,
            ),
            state,
        )
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
        torch.set_num_threads(
            cpu_threads(request.settings, request.candidate.parameters or SMALL_MODEL)
        )
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
        if not isinstance(
            error, torch.OutOfMemoryError | MemoryError
        ) and "allocate memory" not in str(error):
            raise
        longest = prepared.train.longest if prepared.train else 0
        checkpointing = uses_gradient_checkpointing(
            request.settings, request.candidate.parameters or 0
        )
        advice = memory_levers(request.settings, checkpointing, longest)
        raise PlannerError(
            f"out of memory on {prepared.device}; {advice}. The checkpoints so far are kept: see"
            f" {request.output}"
        ) from error


def pad_id(prepared: Prepared) -> int:
    """An id to fill batches with."""
    pad = prepared.tokenizer.pad_token_id if prepared.tokenizer else None
    return pad if isinstance(pad, int) else 0
