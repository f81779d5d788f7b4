"""The training loop: optimiser steps, validation, the best adapter, checkpoints, interruption."""

import contextlib
import math
import signal
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from types import FrameType

import torch

from planner_ft.support.errors import PlannerError
from planner_ft.support.ranks import ALONE, Ranks
from planner_ft.support.resources import peak_memory
from planner_ft.training.batches import collate, epoch_steps
from planner_ft.training.checkpoint import JUDGED, Answer, Run, save_checkpoint
from planner_ft.training.lean import LONGEST, is_lean
from planner_ft.training.model import (
    adapter_parameters,
    adapter_tensors,
    add_gradients,
    blended,
    loss_sum,
    packs,
    scaled,
    set_adapter,
    validation_loss,
)
from planner_ft.training.samples import Sample
from planner_ft.training.settings import TrainSettings


class InterruptedRunError(Exception):
    """The user stopped the run; a checkpoint holds everything up to `step` of `total`."""

    def __init__(self, step: int, total: int, signal_number: int) -> None:
        super().__init__(f"stopped at step {step} of {total}")
        self.step, self.total, self.signal_number = step, total, signal_number


@contextlib.contextmanager
def stop_signals(note: Callable[[str], None], ranks: Ranks = ALONE) -> Iterator[list[int]]:
    """Ctrl-C and SIGTERM end the run after the step in progress; a second one ends it at once, but
    for processes with a launcher: they have one from the terminal and one from that.
    """
    received: list[int] = []

    def handle(number: int, frame: FrameType | None) -> None:
        if received and ranks.world == 1:
            raise KeyboardInterrupt
        received.append(number)
        again = " (Ctrl-C again: at once, without)" if ranks.world == 1 else ""
        note(f"stopping after this step and saving a checkpoint{again}")

    # Python lets only the main thread set handlers; elsewhere the caller's apply.
    main = threading.current_thread() is threading.main_thread()
    numbers = (signal.SIGINT, signal.SIGTERM) if main else ()
    before = {number: signal.signal(number, handle) for number in numbers}
    try:
        yield received
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


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


def train_loop(run: Run) -> None:
    """Train to the end; then the model holds the best (or last) adapter. Raises InterruptedRunError
    after Ctrl-C, and PlannerError when the loss is not finite or a file cannot be written.
    """
    run.model.train()
    state, settings, saved = run.state, run.settings, time.monotonic()
    with stop_signals(run.report.note, run.ranks) as signals:
        if run.judge and state.base_answers is None:
            state.base_answers = run.judge.answers(adapter=False)
            run.report.note(f"base: {_summary(state.base_answers)}")
        for batches in _remaining_steps(run):
            begun = time.monotonic()
            _step(run, batches)
            epoch_ends = state.step % run.steps_per_epoch == 0 or state.step == run.total_steps
            if epoch_ends:
                _end_epoch(run)
            state.seconds += time.monotonic() - begun
            stop = _signal(run, signals)
            stopped = bool(stop) and state.step < run.total_steps
            due = time.monotonic() - saved > 60 * settings.checkpoint_minutes
            if settings.checkpoint_steps and state.step % settings.checkpoint_steps == 0:
                due = True
            if epoch_ends or stopped or due:
                save_checkpoint(run)
                saved = time.monotonic()
            if stopped:
                run.ranks.wait()  # a launcher ends the others with the first that goes
                raise InterruptedRunError(state.step, run.total_steps, stop)
    kept = run.best or scaled(adapter_tensors(run.model), run.settings.blend)
    set_adapter(run.model, kept)


def _signal(run: Run, signals: list[int]) -> int:
    """The signal that ends the run, which any process may have got; 0 for none."""
    told = run.ranks.add_up(torch.tensor(len(signals)))
    return signals[0] if signals else int(told > 0) * signal.SIGTERM


def _remaining_steps(run: Run) -> Iterator[list[list[int]]]:
    """The batches of every optimiser step from the state's on."""
    lengths, state, s = [sample.length for sample in run.train], run.state, run.settings
    for epoch in range(state.step // run.steps_per_epoch, s.epochs):
        count = s.gradient_accumulation * run.ranks.batches
        steps = epoch_steps(lengths, s.batch_size, count, s.seed, epoch)
        for step in steps[state.step % run.steps_per_epoch :]:
            if state.step >= run.total_steps:
                return
            yield step


def _step(run: Run, indices: list[list[int]]) -> None:
    """One optimiser step; the gradient is the mean over all completion tokens of its batches."""
    state, begun, packed = run.state, time.monotonic(), packs(run.model)
    rate = learning_rate(run.settings, state.step, run.total_steps)
    for group in run.optimizer.param_groups:
        group["lr"] = rate
    step = [[run.train[index] for index in batch] for batch in indices]
    samples = [sample for batch in step for sample in batch]
    count = sum(sample.completion_length for sample in samples)
    together = LONGEST if is_lean(run.model, run.device) else 0
    batches = [
        collate(batch, run.pad, packed=packed, together=together) for batch in run.ranks.parts(step)
    ]
    if run.ranks.world > 1:  # dropout of its own for each, whatever a resumed run drew before
        torch.manual_seed(hash((run.settings.seed, state.step, run.ranks.rank)))
    parts = [torch.zeros((), device=run.device)]  # the last step may have nothing for this process
    for batch in batches:
        part = loss_sum(run.model, batch.to(run.device), run.dtype) / count
        torch.autograd.backward(run.scaler.scale(part))
        parts.append(part.detach())
    # Read after the backward pass was queued: waiting for a GPU in between would leave it idle.
    own = [float(torch.stack(parts).sum()), sum(batch.tokens for batch in batches)]
    loss, tokens = run.ranks.add_up(torch.tensor(own, dtype=torch.float64)).tolist()
    if not math.isfinite(loss):
        bad = (one for part, one in zip(parts[1:], batches, strict=True) if not part.isfinite())
        raise _not_finite(run, f"loss is {loss}", [one for batch in bad for one in batch.ids])
    norm = _update(run, samples)
    trained = int(tokens)
    state.step += 1
    state.tokens += trained
    state.completion_tokens += count
    state.epoch_loss += loss * count
    state.epoch_tokens += count
    state.loss = state.epoch_loss / state.epoch_tokens
    seconds = time.monotonic() - begun
    whole = state.seconds + seconds
    record = {"step": state.step, "epoch": run.epoch, "loss": loss, "lr": rate}
    record |= {"grad_norm": norm, "tokens": state.tokens, "step_tokens": trained}
    record |= {"seconds": round(whole, 3), "tokens_per_s": round(trained / seconds, 1)}
    left = (run.total_steps - state.step) * whole / state.step
    run.report.step(record, run.total_steps, left, peak_memory(run.device))


def _update(run: Run, samples: list[Sample]) -> float:
    """Clip the gradient, step the optimizer, and return the gradient's norm before clipping."""
    if run.ranks.world > 1:
        add_gradients(run.model, run.ranks)
    run.scaler.unscale_(run.optimizer)
    weights = adapter_parameters(run.model).values()
    norm = float(torch.nn.utils.clip_grad_norm_(weights, run.settings.gradient_clip))
    # In float16 an overflow is ordinary: the scaler skips the step and scales the next loss less.
    if not math.isfinite(norm) and not run.scaler.is_enabled():
        raise _not_finite(run, f"gradient norm is {norm}", [sample.id for sample in samples])
    run.scaler.step(run.optimizer)
    run.scaler.update()
    run.optimizer.zero_grad(set_to_none=True)
    return norm if math.isfinite(norm) else -1.0


def _not_finite(run: Run, finding: str, samples: list[str]) -> PlannerError:
    """`samples` is empty where another process has the sample."""
    of = f", sample {', '.join(samples)}" if samples else ""
    return PlannerError(
        f"step {run.state.step + 1}{of}: the {finding}; lower"
        f" --learning-rate (now {run.settings.learning_rate:g}) or --gradient-clip (now"
        f" {run.settings.gradient_clip:g}), or look at that sample with --preview-id; the"
        f" checkpoints in {run.output} are from before"
    )


def _end_epoch(run: Run) -> None:
    """Validate, and keep the adapter if it is the best so far."""
    state, epoch, begun = run.state, run.epoch, time.monotonic()
    text = f"epoch {epoch:g}: training loss {state.loss:.4f}"
    state.epoch_loss, state.epoch_tokens = 0.0, 0
    if run.validation:
        with blended(run.model, run.settings.blend):
            text += _validate(run, epoch, begun)
    run.report.note(text)


def _validate(run: Run, epoch: float, begun: float) -> str:
    """The loss and answers of the validation split; the adapter is kept if it is the best."""
    state = run.state
    known = run.model, run.validation, run.pad, run.device, run.dtype
    loss = validation_loss(*known, run.ranks)
    if not math.isfinite(loss):
        rate = f"lower --learning-rate (now {run.settings.learning_rate:g})"
        raise PlannerError(f"epoch {epoch:g}: the validation loss is {loss}; {rate}")
    answers = run.judge.answers(adapter=True) if run.judge else None
    rank = [loss]
    if answers and run.settings.select == "f1":
        found = means(answers)
        rank = [-found["f1"], -found["exact_sequence"], loss]
    last = run.settings.select == "last"
    best = last or state.best_rank is None or rank < state.best_rank
    if best:
        state.best_loss, state.best_epoch, state.best_rank = loss, epoch, rank
        state.best_answers = answers
        run.best = adapter_tensors(run.model)
    record = {"step": state.step, "epoch": epoch, "train_loss": state.loss}
    record |= {"validation_loss": loss, "best": best, **means(answers or [])}
    record["seconds"] = round(time.monotonic() - begun, 3)
    state.history.append(record)
    run.report.record(record)
    text = f", validation loss {loss:.4f}{' (best)' if best and not last else ''}"
    return text + (f"; {_summary(answers)}" if answers else "")


def means(answers: Sequence[Answer]) -> dict[str, float]:
    """The mean of each metric; empty without answers."""
    return {name: sum(a[name] for a in answers) / len(answers) for name in JUDGED if answers}


def _summary(answers: Sequence[Answer]) -> str:
    found = means(answers)
    shares = f"valid {found['strict_valid']:.0%}, exact {found['exact_sequence']:.0%}"
    return f"F1 {found['f1']:.2f}, {shares} of {len(answers)} answers"
