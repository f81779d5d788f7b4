"""A training run from request to adapter folder."""

import contextlib
import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from typing import Any

import torch
from rich.console import Console
from torch import Tensor

from planner_ft.candidates.loading import compute_dtype, load_model, load_tokenizer
from planner_ft.candidates.location import weights_sha256
from planner_ft.support.alone import alone
from planner_ft.support.errors import PlannerError
from planner_ft.support.ranks import ALONE, Ranks
from planner_ft.support.terminal import show, terminal
from planner_ft.training.batches import Batch, collate
from planner_ft.training.checkpoint import Run, load_newest_checkpoint
from planner_ft.training.loop import InterruptedRunError, train_loop
from planner_ft.training.model import (
    SMALL_MODEL,
    adapter_parameters,
    adapter_tensors,
    attach_adapter,
    autocast,
    cpu_threads,
    evaluating,
    loss_sum,
    memory_levers,
    set_adapter,
    unpack,
)
from planner_ft.training.output import begin, folder_state, is_unfinished, write_result, write_run
from planner_ft.training.preflight import CHECKS, Finding, Prepared, longest, run_preflight
from planner_ft.training.report import Report, Silence
from planner_ft.training.request import TrainRequest, refusal
from planner_ft.training.samples import Sample, read_split

NewJudge = Callable[[TrainRequest, Prepared, Run], Any]
"""Makes what answers validation samples (planner_ft.benchmark.judge)."""
LOSS_TOLERANCE = 0.02
"""Relative difference between our loss and the model's own that rounding in 16 bits explains."""
B_DEVIATION = 0.02


def preview_sample(request: TrainRequest, sample_id: str | None) -> tuple[Sample, Any]:
    """The sample of that id (or the first one) rendered as for training, and the tokenizer."""
    problems: list[str] = []
    split = read_split(request.train_file, request.level, request.vocabulary, problems)
    if split is None or problems:
        raise refusal("the data has", problems)
    found = [record for record in split.records if sample_id in (None, record["id"])][:1]
    if not found:
        file = request.train_file
        raise PlannerError(f"--preview-id {sample_id}: {file} holds no record of that id")
    tokenizer = load_tokenizer(request.candidate)
    shown = {"with_vocabulary": request.settings.vocabulary_in_prompt}
    return replace(split, records=found).rendered(tokenizer, **shown).samples[0], tokenizer


def train(
    request: TrainRequest, console: Console, new_judge: NewJudge | None = None, ranks: Ranks = ALONE
) -> dict[str, Any] | None:
    """Run the checks, train, write the adapter folder and return its manifest. What `new_judge`
    makes answers validation samples after each epoch. Several processes share all work; the first
    writes.

    None when --resume finds the run complete, and for the others. Raises PlannerError for anything
    that the user can put right, and InterruptedRunError after Ctrl-C.
    """
    if not ranks.leads:
        console = terminal(quiet=True)
    helped = ["a second process does half of every batch (--threads 1: none)"] * ranks.divided
    for text in [*request.departures(), *helped]:
        console.print(f"note: {text}")
    with alone(request.output if ranks.leads else None, "--output", "a training"):
        prepared = Prepared()
        with ranks.one_voice():
            _check(request, prepared, console)
        assert prepared.train and request.candidate.folder
        validation = prepared.validation.sha256 if prepared.validation else None
        base = weights_sha256(request.candidate.folder)
        fingerprint = request.fingerprint(prepared.train.sha256, validation, base)
        if request.resume and folder_state(request.output) == "empty":
            console.print(f"--resume: {request.output} holds no run: starting from the beginning")
            request = replace(request, resume=False)
        if request.resume and not is_unfinished(request.output, fingerprint):
            console.print(f"{request.output}: this run is complete; nothing to resume")
            return None
        ranks.wait()  # everybody has seen the folder as it was
        with _limits(request, prepared):
            manifest = _train(request, prepared, console, fingerprint, new_judge, ranks)
        ranks.wait()
        return manifest


def _check(request: TrainRequest, prepared: Prepared, console: Console) -> None:
    problems = []
    with console.status("checking ..."):
        for number, finding in enumerate(run_preflight(request, prepared), 1):
            problems += finding.problems
            _show(console, number, finding)
    if problems:
        raise refusal("the preflight found", problems)


def _train(
    request: TrainRequest,
    prepared: Prepared,
    console: Console,
    fingerprint: dict[str, Any],
    new_judge: NewJudge | None,
    ranks: Ranks,
) -> dict[str, Any] | None:
    settings, output = request.settings, request.output
    with console.status("loading the model ..."):
        model, finding = ready_model(request, prepared)
    _show(console, CHECKS, finding)
    if finding.problems:
        raise refusal("the preflight found", finding.problems)
    device, train, validation = prepared.device, prepared.train, prepared.validation
    assert device and train
    torch.manual_seed(settings.seed)
    samples = train.samples, validation.samples if validation else []
    dtype = compute_dtype(device)
    run = Run(settings, model, *samples, prepared.pad, device, dtype, output, ranks=ranks)
    if new_judge and validation and settings.validation_answers:
        run.judge = new_judge(request, prepared, run)
    if request.resume:
        console.print(load_newest_checkpoint(run))
    run.report = Silence()
    if not ranks.leads:
        train_loop(run)
        return None
    if request.resume:
        write_run(output, fingerprint, "running")
    else:
        begin(output, fingerprint)
    name = f"{request.candidate.slug}-{request.level}"
    run.report = Report(console, output, settings, name, run.state.step)
    try:
        train_loop(run)
        return write_result(request, prepared, run, fingerprint)
    except (Exception, KeyboardInterrupt) as error:
        stopped = isinstance(error, InterruptedRunError)
        with contextlib.suppress(PlannerError):
            write_run(output, fingerprint, "interrupted" if stopped else f"failed: {error!r}")
        raise
    finally:
        run.report.close()


def ready_model(request: TrainRequest, prepared: Prepared) -> tuple[Any, Finding]:
    """The base model with a new adapter, and whether every adapter weight learns."""
    settings, device = request.settings, prepared.device
    assert device and prepared.train
    base = load_model(
        request.candidate, device=str(device), quantization=settings.quantization, trainable=True
    )
    if device.type == "cpu":
        unpack(base)
    model = attach_adapter(base, settings, request.candidate.reference)
    samples, dtype = prepared.train.samples, compute_dtype(device)
    problems = probe_model(model, samples, prepared.pad, settings.batch_size, device, dtype)
    sizes = [value.numel() for value in adapter_parameters(model).values()]
    learn = f"all {len(sizes)} adapter matrices learn ({sum(sizes):,} weights)"
    text = "" if problems else f"{learn}, also after a validation pass"
    return model, Finding("gradients", text, problems)


@contextlib.contextmanager
def _limits(request: TrainRequest, prepared: Prepared) -> Iterator[None]:
    """The CPU threads of the settings; out of memory becomes a sentence with the next lever."""
    settings, parameters = request.settings, request.candidate.parameters
    before = torch.get_num_threads()
    if prepared.device and prepared.device.type == "cpu":
        torch.set_num_threads(cpu_threads(settings, parameters or SMALL_MODEL))
    try:
        yield
    except (torch.OutOfMemoryError, MemoryError, RuntimeError) as error:
        if type(error) is RuntimeError and "allocate memory" not in str(error):
            raise
        advice = memory_levers(
            settings, parameters or 0, longest(prepared.train.samples if prepared.train else ())
        )
        raise PlannerError(
            f"out of memory on {prepared.device}; {advice}. The checkpoints so far are kept: see"
            f" {request.output}"
        ) from error
    finally:
        torch.set_num_threads(before)


def _show(console: Console, number: int, finding: Finding) -> None:
    """One line on a check, and a line for each note."""
    found = len(finding.problems)
    count = f"{found} problem{'s' if found > 1 else ''}" if found else ""
    text = "; ".join(part for part in (count, finding.text) if part)
    mark = "✗" if found else "-" if finding.skipped else "✓"
    line = f"[{number}/{CHECKS}] {mark} {finding.title}: {text}"
    console.print(line, style="red" if found else None)
    for note in finding.notes:
        console.print(f"      note: {note}", style="yellow")
    for text in [] if console.quiet else finding.warnings:
        show(f"warning: {text}", error=True)


def probe_model(
    model: Any, samples: Sequence[Sample], pad: int, batch_size: int, device: Any, dtype: Any
) -> list[str]:
    """Everything wrong with the model for training: weights that do not learn, a loss that is not
    the model's own. Weights, gradients and random state are left as they were. The gradient step
    runs on the `batch_size` longest samples: it also shows whether training fits the memory.

    A new LoRA adapter has B = 0, so that the gradient of A is zero whatever is wrong, and A is
    checked in a second step with small random numbers in B. B is checked in the first: then
    gradients reach it through the frozen weights alone, and a layer that passes none on (as 4-bit
    layers that a CPU has packed) is not hidden by the path through other adapters. A validation
    pass goes first, since one is what packs them.
    """
    by_length = sorted(samples, key=lambda sample: sample.length)
    batch = collate(by_length[-batch_size:], pad).to(device)
    saved = adapter_tensors(model)
    model.train()
    try:
        with torch.random.fork_rng():
            problems = _loss_problems(model, by_length[0], pad, device, dtype)
            base = [name for name in saved if "lora_" not in name]
            if base:
                count = f"{len(base)} weights of the base model"
                problems.append(f"{count} would be trained (first: {base[0]})")
            gradients = _gradients(model, batch, dtype)
            generator = torch.Generator().manual_seed(0)
            with torch.no_grad():
                for name, value in adapter_parameters(model).items():
                    if "lora_B" in name:
                        value.copy_(torch.randn(value.shape, generator=generator) * B_DEVIATION)
            second = _gradients(model, batch, dtype)
            gradients |= {name: value for name, value in second.items() if "lora_A" in name}
            return problems + _gradient_problems(gradients)
    finally:
        set_adapter(model, saved)
        model.zero_grad(set_to_none=True)


def _loss_problems(
    model: Any, sample: Sample, pad: int, device: torch.device, dtype: torch.dtype
) -> list[str]:
    """Compare with the model's own loss: an architecture may change logits behind the output."""
    batch = collate([sample], pad).to(device)
    ids = torch.tensor([sample.rendered.input_ids], device=device)
    mask = torch.tensor([sample.rendered.completion_mask], device=device)
    with evaluating(model), autocast(device, dtype):
        ours = float(loss_sum(model, batch, dtype)) / len(batch.targets)
        labels = ids.masked_fill(mask == 0, -100)
        theirs = float(model(input_ids=ids, labels=labels, use_cache=False).loss)
    if not math.isfinite(ours):
        broken = "the base model's weights are broken, or its dtype overflows"
        return [f"the loss of sample {sample.id} is {ours} before any training: {broken}"]
    if abs(ours - theirs) > LOSS_TOLERANCE * max(1.0, abs(theirs)):
        other = f"{ours:.4f} where the model itself computes {theirs:.4f}"
        return [f"the loss of sample {sample.id} is {other}: this architecture is not supported"]
    return []


def _gradients(model: Any, batch: Batch, dtype: torch.dtype) -> dict[str, Tensor | None]:
    """The gradient of every adapter weight."""
    model.zero_grad(set_to_none=True)
    torch.autograd.backward(loss_sum(model, batch, dtype) / len(batch.targets))
    return {name: value.grad for name, value in adapter_parameters(model).items()}


def _gradient_problems(gradients: dict[str, Tensor | None]) -> list[str]:
    """Sentences on matrices without a gradient, and on those with one that is not finite."""
    without = [name for name, value in gradients.items() if value is None or not value.any()]
    infinite = [
        name
        for name, value in gradients.items()
        if value is not None and not value.isfinite().all()
    ]
    texts = {
        "get no gradient (first: {}); they would stay as they are": without,
        "get a gradient that is not finite (first: {})": infinite,
    }
    return [
        f"{len(names)} of {len(gradients)} adapter matrices {text.format(names[0])}"
        for text, names in texts.items()
        if names
    ]
