"""Checks before the model loads: all problems at once, before anything expensive starts."""

from __future__ import annotations

import shutil
import tempfile
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

from planner_ft.candidates.costs import adapter_parameters, device_memory, training_memory
from planner_ft.candidates.loading import compute_dtype, load_tokenizer, resolve_device
from planner_ft.prompts import end_of_turn_ids
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import nearest_folder, writing
from planner_ft.support.resources import memory_size
from planner_ft.training.model import LOGIT_VALUES, memory_levers, uses_gradient_checkpointing
from planner_ft.training.output import folder_problem
from planner_ft.training.report import tracker_problems
from planner_ft.training.request import TrainRequest
from planner_ft.training.samples import (
    Sample,
    Split,
    read_split,
    shortened,
    tests_warnings,
    tests_within,
)

if TYPE_CHECKING:
    import torch
    from transformers import PreTrainedTokenizerBase

CHECKS = 7
"""Six here; the seventh, on gradients, needs the loaded model."""
OTHER_FILES = 2**25
"""Bytes for everything in an output folder but weights."""


@dataclass
class Prepared:
    """Results of the checks that training goes on with; None where a check got no result."""

    device: torch.device | None = None
    tokenizer: PreTrainedTokenizerBase | None = None
    train: Split | None = None
    validation: Split | None = None
    tests: dict[str, str] = field(default_factory=dict)
    """Test sets whose inputs are trained on: path, and how many."""

    @property
    def splits(self) -> list[Split]:
        return [split for split in (self.train, self.validation) if split]

    @property
    def pad(self) -> int:
        """An id to fill batches with."""
        pad = self.tokenizer.pad_token_id if self.tokenizer else None
        return pad if isinstance(pad, int) else 0


@dataclass
class Finding:
    """The outcome of one check, or that it was skipped; warnings are for standard error."""

    title: str
    text: str = ""
    problems: list[str] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    warnings: list[str] = field(default_factory=list)
    skipped: bool = False


def run_preflight(request: TrainRequest, prepared: Prepared) -> Iterator[Finding]:
    """Yield the outcome of each check and fill `prepared`. Problems of the run raise nothing."""
    checks = {"candidate": check_candidate, "data": check_data, "rendering": check_rendering}
    checks |= {"special tokens": check_tokens, "output": check_output, "memory": check_memory}
    for title, check in checks.items():
        finding = Finding(title)
        try:
            check(request, prepared, finding)
        except PlannerError as error:
            finding.problems.append(str(error))
        yield finding


def check_candidate(request: TrainRequest, prepared: Prepared, finding: Finding) -> None:
    """Is the model here, and can the device and the installed packages do what is asked?"""
    candidate, settings = request.candidate, request.settings
    finding.problems += tracker_problems(settings)
    try:
        device = prepared.device = resolve_device(settings.device)
        size = f"{candidate.parameters / 1e6:,.1f} M parameters, " if candidate.parameters else ""
        base = "4-bit base" if settings.quantization == "nf4" else "16-bit base"
        dtype = str(compute_dtype(device)).removeprefix("torch.")
        model = f"{candidate.row_name}: {size}{candidate.source or 'not here'}"
        finding.text = f"{model}; {base}, computing in {dtype} on {device}"
        if settings.optimizer.startswith("paged") and device.type != "cuda":
            other = "needs CUDA; take adamw-8bit or adamw"
            finding.problems.append(f"--optimizer {settings.optimizer} {other}")
    except PlannerError as error:
        finding.problems.append(str(error))
    prepared.tokenizer = load_tokenizer(candidate)


def check_data(request: TrainRequest, prepared: Prepared, finding: Finding) -> None:
    """Do the files hold records of this level and vocabulary?"""
    level, vocabulary, settings = request.level, request.vocabulary, request.settings
    problems, added = finding.problems, []
    train = read_split(request.train_file, level, vocabulary, problems, settings.max_samples)
    if train and request.corrections:
        own = len(train.records)
        train = train.corrected(request.corrections, problems)
        count = len(train.records) - own
        added.append(f"{count} of the training samples from {request.corrections}")
    if train:
        problems += shortened(train.contradictions())
    if train:
        train = train.multiplied(settings.seed, settings.vary, settings.borrow, added)
    if train and settings.augment:
        train = train.augmented(settings.seed, settings.augment)
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
    if not problems:
        prepared.tests = tests_within(prepared.splits)
    finding.warnings += tests_warnings(prepared.tests)


def check_rendering(request: TrainRequest, prepared: Prepared, finding: Finding) -> None:
    """Does every sample fit the limit whole, and is something of it trained?"""
    tokenizer = prepared.tokenizer
    if tokenizer is None or not prepared.splits:
        finding.text, finding.skipped = "skipped: no tokenizer or no data", True
        return
    shown = {"with_vocabulary": request.settings.vocabulary_in_prompt}
    if prepared.train:
        prepared.train = prepared.train.rendered(tokenizer, **shown)
    if prepared.validation:
        prepared.validation = prepared.validation.rendered(tokenizer, **shown)
    most, dimensions = request.settings.max_length, request.candidate.dimensions
    limit = min(most, dimensions.context) if dimensions else most
    holds = f"{request.candidate.name} takes no more"
    lever = f"raise --max-length (now {most})" if limit == most else holds
    samples = [(split.path, sample) for split in prepared.splits for sample in split.samples]
    finding.problems += shortened(
        f"{path}: sample {sample.id} has {sample.length} tokens and its answer would be cut at"
        f" {limit}; {lever}, or leave the sample out"
        for path, sample in samples
        if sample.length > limit
    )
    finding.problems += shortened(
        f"{path}: sample {sample.id} has no token that is trained"
        for path, sample in samples
        if not any(sample.rendered.completion_mask)
    )
    if prepared.train and (trained := prepared.train.samples):
        tokens = sum(sample.length for sample in trained)
        share = sum(sample.completion_length for sample in trained) / tokens
        counts = f"{tokens:,} tokens, {share:.0%} of them trained"
        finding.text = f"{counts}; longest sample {longest(trained)} of {limit}"


def check_tokens(request: TrainRequest, prepared: Prepared, finding: Finding) -> None:
    """Does every answer end with a trained end-of-turn token, and a text begin with one BOS?"""
    tokenizer = prepared.tokenizer
    samples = [sample for split in prepared.splits for sample in split.samples]
    if tokenizer is None or not samples:
        finding.text, finding.skipped = "skipped: nothing rendered", True
        return
    end, bos = end_of_turn_ids(tokenizer)[0], tokenizer.bos_token_id
    dimensions = request.candidate.dimensions
    size = dimensions.vocabulary if dimensions else len(tokenizer)
    kinds: dict[str, list[str]] = {}
    for sample in samples:
        for problem in token_problems(sample, end, bos if isinstance(bos, int) else None, size):
            kinds.setdefault(problem, []).append(sample.id)
    finding.problems = [
        f"{len(ids)} samples {problem} (first: {ids[0]})" for problem, ids in kinds.items()
    ]
    begins = any(bos in sample.rendered.input_ids[:1] for sample in samples)
    one = f"one {tokenizer.bos_token} at the beginning"
    begin = one if begins else "no beginning-of-text token"
    ends = f"every answer ends with a trained {tokenizer.convert_ids_to_tokens(end)}; {begin}"
    finding.text = "see below" if finding.problems else ends


def token_problems(sample: Sample, end: int, bos: int | None, size: int) -> Iterator[str]:
    """The sample's special tokens in wrong places; `size` is the number of embeddings."""
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


def check_output(request: TrainRequest, prepared: Prepared, finding: Finding) -> None:
    """May the output folder be used, and is there room for checkpoints?"""
    output, dimensions = request.output, request.candidate.dimensions
    if problem := folder_problem(output, overwrite=request.overwrite, resume=request.resume):
        finding.problems.append(problem)
    existing = nearest_folder(output)
    usable = writing(f"--output {output}", "choose another folder")
    with usable, tempfile.TemporaryFile(dir=existing):
        free = shutil.disk_usage(existing).free
    # Adapter, best adapter and two moments in float32, three times: the oldest goes last.
    weights = adapter_parameters(dimensions, request.settings.rank) if dimensions else 0
    needed = 3 * 4 * 4 * weights + OTHER_FILES
    room = f"{memory_size(needed)} needed for checkpoints"
    finding.text = f"{output}: {room}, {memory_size(free)} free"
    if needed > free:
        short = f"{room} and {memory_size(free)} free; choose another disk"
        finding.problems.append(f"--output {output}: {short}")


def check_memory(request: TrainRequest, prepared: Prepared, finding: Finding) -> None:
    """Will training fit the device's memory?"""
    settings, dimensions = request.settings, request.candidate.dimensions
    train, device = prepared.train, prepared.device
    if dimensions is None or device is None or train is None or not train.samples:
        finding.text = "no estimate: dimensions, device or samples are unknown"
        finding.skipped = True
        return
    tokens = longest(train.samples)
    estimate = training_memory(
        dimensions,
        quantization=settings.quantization,
        rank=settings.rank,
        tokens=tokens,
        batch=settings.batch_size,
        dropout=settings.dropout > 0,
        checkpointing=uses_gradient_checkpointing(settings, dimensions.parameters),
    )
    # The loss runs in chunks: the logits never exist all at once.
    needed = replace(estimate, logits=min(estimate.logits, 12 * LOGIT_VALUES)).total
    free, total = device_memory(device)
    advice = memory_levers(settings, dimensions.parameters, tokens)
    finding.text = f"about {memory_size(needed)} of {memory_size(free)} free on {device}"
    if needed > total:
        has = f"{device} has {memory_size(total)}"
        finding.problems.append(f"training needs about {memory_size(needed)} and {has}; {advice}")
    elif needed > free:
        short = f"{memory_size(free)} are free and about {memory_size(needed)} needed"
        finding.notes.append(f"{short}; close other programs, or {advice}")


def longest(samples: Sequence[Sample]) -> int:
    """Tokens of the longest sample."""
    return max((sample.length for sample in samples), default=0)
