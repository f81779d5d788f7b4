"""A training run from request to adapter folder."""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import torch

from planner_ft.candidates.loading import compute_dtype, load_model, load_tokenizer
from planner_ft.candidates.location import weights_sha256
from planner_ft.support.alone import alone
from planner_ft.support.errors import PlannerError
from planner_ft.support.ranks import ALONE, Ranks
from planner_ft.support.terminal import show, terminal
from planner_ft.training.checkpoint import Judging, Run, load_newest_checkpoint
from planner_ft.training.loop import InterruptedRunError, train_loop
from planner_ft.training.model import (
    SMALL_MODEL,
    adapter_parameters,
    attach_adapter,
    cpu_threads,
    memory_levers,
    unpack,
)
from planner_ft.training.output import begin, folder_state, is_unfinished, write_result, write_run
from planner_ft.training.preflight import CHECKS, Finding, Prepared, longest, run_preflight
from planner_ft.training.probe import probe_model
from planner_ft.training.report import Report, Silence
from planner_ft.training.request import TrainRequest, refusal
from planner_ft.training.samples import Sample, read_split

if TYPE_CHECKING:
    from rich.console import Console

    NewJudge = Callable[[TrainRequest, Prepared, Run], Judging]


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
    makes answers validation samples after each epoch. Of several processes the first does so; the
    others add gradients.

    None when --resume finds the run complete, and for the others. Raises PlannerError for anything
    that the user can put right, and InterruptedRunError after Ctrl-C.
    """
    if not ranks.leads:
        console, new_judge = terminal(quiet=True), None
    for text in request.departures():
        _say(console, f"note: {text}")
    with alone(request.output if ranks.leads else None, "--output", "a training"):
        prepared = Prepared()
        with ranks.one_voice():
            _check(request, prepared, console)
        assert prepared.train and request.candidate.folder
        validation = prepared.validation.sha256 if prepared.validation else None
        base = weights_sha256(request.candidate.folder)
        fingerprint = request.fingerprint(prepared.train.sha256, validation, base)
        if request.resume and folder_state(request.output) == "empty":
            _say(console, f"--resume: {request.output} holds no run: starting from the beginning")
            request = replace(request, resume=False)
        if request.resume and not is_unfinished(request.output, fingerprint):
            _say(console, f"{request.output}: this run is complete; nothing to resume")
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
        _say(console, load_newest_checkpoint(run))
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
    _say(console, line, "red" if found else None)
    for note in finding.notes:
        _say(console, f"      note: {note}", "yellow")
    for text in [] if console.quiet else finding.warnings:
        show(f"warning: {text}", error=True)


def _say(console: Console, text: str, style: str | None = None) -> None:
    console.print(text, markup=False, highlight=False, soft_wrap=True, style=style)
