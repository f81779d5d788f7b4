"""Checks before the model loads: all problems at once, before anything expensive starts."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

from planner_ft.candidates.loading import compute_dtype, load_tokenizer, resolve_device
from planner_ft.candidates.memory import adapter_parameters, training_memory
from planner_ft.prompts import end_of_turn_ids
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import nearest_folder
from planner_ft.support.resources import memory_size
from planner_ft.training.model import LOGIT_VALUES, memory_levers, uses_gradient_checkpointing
from planner_ft.training.output import folder_problems, writable_problem
from planner_ft.training.report import tracker_problems
from planner_ft.training.request import TrainRequest
from planner_ft.training.samples import (
    Sample,
    Split,
    augmented,
    read_split,
    render_split,
    shortened,
    with_corrections,
)

if TYPE_CHECKING:
    import torch
    from transformers import PreTrainedTokenizerBase

CHECKS = 7
"""Six here; the seventh, on gradients, needs the loaded model."""


@dataclass
class Prepared:
    """Results of the checks that training goes on with; None where a check got no result."""

    device: torch.device | None = None
    tokenizer: PreTrainedTokenizerBase | None = None
    train: Split | None = None
    validation: Split | None = None

    @property
    def splits(self) -> list[Split]:
        return [split for split in (self.train, self.validation) if split]

    @property
    def samples(self) -> list[tuple[Split, Sample]]:
        return [(split, sample) for split in self.splits for sample in split.samples]

    @property
    def pad(self) -> int:
        """An id to fill batches with."""
        pad = self.tokenizer.pad_token_id if self.tokenizer else None
        return pad if isinstance(pad, int) else 0


@dataclass
class Finding:
    """The outcome of one check: a line of text, problems, notes. `skipped`: it could not run."""

    title: str
    text: str = ""
    problems: list[str] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    skipped: bool = False


def run_preflight(request: TrainRequest, prepared: Prepared) -> Iterator[Finding]:
    """Yield the outcome of each check and fill `prepared`. Problems of the run raise nothing."""
    checks = (check_candidate, check_data, check_rendering, check_tokens, check_output)
    for check in (*checks, check_memory):
        yield check(request, prepared)


def check_candidate(request: TrainRequest, prepared: Prepared) -> Finding:
    """Is the model here, and can the device and the installed packages do what is asked?"""
    finding, candidate, settings = Finding("candidate"), request.candidate, request.settings
    try:
        prepared.device = resolve_device(settings.device)
    except PlannerError as error:
        finding.problems.append(str(error))
    try:
        prepared.tokenizer = load_tokenizer(candidate)
    except PlannerError as error:
        finding.problems.append(str(error))
    device, optimizer = prepared.device, settings.optimizer
    if optimizer.startswith("paged") and device and device.type != "cuda":
        other = "needs CUDA; take adamw-8bit or adamw"
        finding.problems.append(f"--optimizer {optimizer} {other}")
    finding.problems += tracker_problems(settings)
    if device:
        size = f"{candidate.parameters / 1e6:,.1f} M parameters, " if candidate.parameters else ""
        base = "4-bit base" if settings.quantization == "nf4" else "16-bit base"
        dtype = str(compute_dtype(device)).removeprefix("torch.")
        model = f"{candidate.row_name}: {size}{candidate.source or 'not here'}"
        finding.text = f"{model}; {base}, computing in {dtype} on {device}"
    return finding


def check_data(request: TrainRequest, prepared: Prepared) -> Finding:
    """Do the files hold records of this level and vocabulary?"""
    finding, level, vocabulary = Finding("data"), request.level, request.vocabulary
    settings, problems, added = request.settings, finding.problems, []
    train = read_split(request.train_file, level, vocabulary, problems, settings.max_samples)
    if train and request.corrections:
        own = len(train.records)
        train = with_corrections(train, request.corrections, level, vocabulary, problems)
        count = len(train.records) - own
        added.append(f"{count} of the training samples from {request.corrections}")
    if train and settings.augment:
        train = augmented(train, level, vocabulary, settings.seed, settings.augment)
        added.append(f"{settings.augment} of the training samples synthetic")
    prepared.train = train
    if request.validation_file:
        prepared.validation = read_split(request.validation_file, level, vocabulary, problems)
    else:
        finding.notes.append("no validation split: the last adapter is kept, not the best one")
    counts = [f"{len(split.records)} samples in {split.path}" for split in prepared.splits]
    finding.text = ", ".join([*counts, *added])
    if train and prepared.validation:
        trained, checked = {r["prompt"] for r in train.records}, prepared.validation.records
        shared = [record["id"] for record in checked if record["prompt"] in trained]
        if shared:
            prompts = f"{len(shared)} validation prompts are in the training split, too"
            note = f"{prompts} (first: {shared[0]}); the validation loss will flatter"
            finding.notes.append(note)
    return finding


def check_rendering(request: TrainRequest, prepared: Prepared) -> Finding:
    """Does every sample fit the limit whole, and is something of it trained?"""
    finding, train, validation = Finding("rendering"), prepared.train, prepared.validation
    level, tokenizer, vocabulary = request.level, prepared.tokenizer, request.vocabulary
    if tokenizer is None or not prepared.splits:
        return replace(finding, text="skipped: no tokenizer or no data", skipped=True)
    try:
        prepared.train = train and render_split(train, level, tokenizer, vocabulary)
        prepared.validation = validation and render_split(validation, level, tokenizer, vocabulary)
    except PlannerError as error:
        finding.problems.append(str(error))
        return finding
    context = request.candidate.dimensions.context if request.candidate.dimensions else None
    limit = min(request.settings.max_length, context or request.settings.max_length)
    lever = f"{request.candidate.name} takes no more"
    if limit == request.settings.max_length:
        lever = f"raise --max-length (now {limit})"
    finding.problems += shortened(
        f"{split.path}: sample {sample.id} has {sample.length} tokens and its answer would be cut"
        f" at {limit}; {lever}, or leave the sample out"
        for split, sample in prepared.samples
        if sample.length > limit
    )
    finding.problems += shortened(
        f"{split.path}: sample {sample.id} has no token that is trained"
        for split, sample in prepared.samples
        if not any(sample.rendered.completion_mask)
    )
    if prepared.train and prepared.train.samples:
        tokens, longest = prepared.train.tokens, prepared.train.longest
        share = sum(sample.completion_length for sample in prepared.train.samples) / tokens
        trained = f"{tokens:,} tokens, {share:.0%} of them trained"
        finding.text = f"{trained}; longest sample {longest} of {limit}"
    return finding


def check_tokens(request: TrainRequest, prepared: Prepared) -> Finding:
    """Does every answer end with a trained end-of-turn token, and a text begin with one BOS?"""
    finding, tokenizer = Finding("special tokens"), prepared.tokenizer
    if tokenizer is None or not prepared.samples:
        return replace(finding, text="skipped: nothing rendered", skipped=True)
    end, bos = end_of_turn_ids(tokenizer)[0], tokenizer.bos_token_id
    dimensions = request.candidate.dimensions
    size = dimensions.vocabulary if dimensions else len(tokenizer)
    kinds: dict[str, list[str]] = {}
    for _, sample in prepared.samples:
        for problem in _token_problems(sample, end, bos if isinstance(bos, int) else None, size):
            kinds.setdefault(problem, []).append(sample.id)
    finding.problems = [
        f"{len(ids)} samples {problem} (first: {ids[0]})" for problem, ids in kinds.items()
    ]
    begins = any(bos in sample.rendered.input_ids[:1] for _, sample in prepared.samples)
    begin = (
        f"one {tokenizer.bos_token} at the beginning" if begins else "no beginning-of-text token"
    )
    ends = f"every answer ends with a trained {tokenizer.convert_ids_to_tokens(end)}; {begin}"
    finding.text = "see below" if finding.problems else ends
    return finding


def _token_problems(sample: Sample, end: int, bos: int | None, size: int) -> Iterator[str]:
    ids, mask = sample.rendered.input_ids, sample.rendered.completion_mask
    if ids[-1] != end or not mask[-1]:
        yield "do not train the end-of-turn token: the model would not learn to stop"
    if end in ids[sample.rendered.prompt_length : -1]:
        yield "hold the end-of-turn token inside the answer: the model would learn to stop there"
    # Where one token is both, it stands at the end of the answer as well.
    if bos is not None and bos != end and ids.count(bos) > 1:
        yield "begin with two beginning-of-text tokens, or hold one inside"
    if max(ids) >= size:
        beyond = f"hold token ids beyond the model's {size} embeddings"
        yield f"{beyond}: tokenizer and model do not belong together"


def check_output(request: TrainRequest, prepared: Prepared) -> Finding:
    """May the output folder be used, and is there room for checkpoints?"""
    output, dimensions = request.output, request.candidate.dimensions
    problems = folder_problems(output, overwrite=request.overwrite, resume=request.resume)
    finding = Finding("output", problems=problems)
    if problem := writable_problem(output):
        finding.problems.append(problem)
        return finding
    free = shutil.disk_usage(nearest_folder(output)).free
    # Adapter, best adapter and two moments in float32, twice: the old checkpoint goes last.
    weights = adapter_parameters(dimensions, request.settings.rank) if dimensions else 0
    needed = 2 * 4 * 4 * weights + 2**25
    sizes = memory_size(needed), memory_size(free)
    finding.text = "{}: {} needed for checkpoints, {} free".format(output, *sizes)
    if needed > free:
        text = "--output {}: {} are needed for checkpoints and {} free; choose another disk"
        finding.problems.append(text.format(output, *sizes))
    return finding


def check_memory(request: TrainRequest, prepared: Prepared) -> Finding:
    """Will training fit the device's memory?"""
    finding, settings = Finding("memory"), request.settings
    dimensions, train, device = request.candidate.dimensions, prepared.train, prepared.device
    if dimensions is None or device is None or train is None or not train.samples:
        unknown = "no estimate: dimensions, device or samples are unknown"
        return replace(finding, text=unknown, skipped=True)
    estimate = training_memory(
        dimensions,
        quantization=settings.quantization,
        rank=settings.rank,
        tokens=train.longest,
        batch=settings.batch_size,
        dropout=settings.dropout > 0,
        checkpointing=uses_gradient_checkpointing(settings, dimensions.parameters),
    )
    # The loss runs in chunks: the logits never exist all at once.
    needed = replace(estimate, logits=min(estimate.logits, 12 * LOGIT_VALUES)).total
    free, total = device_memory(device)
    size, advice = (
        memory_size(needed),
        memory_levers(settings, dimensions.parameters, train.longest),
    )
    finding.text = f"about {size} of {memory_size(free)} free on {device}"
    if needed > total:
        has = f"{device} has {memory_size(total)}"
        finding.problems.append(f"training needs about {size} and {has}; {advice}")
    elif needed > free:
        short = f"{memory_size(free)} are free and about {size} needed"
        finding.notes.append(f"{short}; close other programs, or {advice}")
    return finding


def device_memory(device: torch.device) -> tuple[int, int]:
    """Free and total memory of a device in bytes."""
    if device.type == "cuda":
        import torch

        free, total = torch.cuda.mem_get_info(device)
        return free, total
    import psutil

    memory = psutil.virtual_memory()
    return int(memory.available), int(memory.total)
