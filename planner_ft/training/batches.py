"""From samples to tensors: the order of an epoch, optimiser steps, batches with little padding."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import takewhile
from typing import Any

import numpy as np
import torch

from planner_ft.training.samples import Sample

VALIDATION_TOKENS = 2048
"""Tokens, padding included, that go through the model together in a validation pass."""
SHARED = 64
"""Tokens that prompts must have in common to be computed once."""
WIDTH_MULTIPLE = 16
"""Batches are padded to a multiple of this: kernels are prepared per shape (50 ms on a CPU)."""


@dataclass(frozen=True)
class Batch:
    """Samples without their last token, which predicts nothing, in rows padded on the right.

    `input_ids` has the shape (rows, width). There is no attention mask: attention is causal, so
    that padding on the right reaches no token before it. Where samples share a row, `positions`
    (the shape of `input_ids`) begins at zero with each of them, and models let none look at
    another; only the first `shared` tokens of a row, which they have in common, are seen by all,
    and positions go on there with each. `rows` and `columns` say where the model predicts
    completion tokens and `targets` which: three vectors of one length, over all samples. So the
    output layer runs there alone. `tokens` counts the samples' tokens without padding.
    """

    ids: tuple[str, ...]
    input_ids: torch.Tensor
    rows: torch.Tensor
    columns: torch.Tensor
    targets: torch.Tensor
    tokens: int
    positions: torch.Tensor | None = None
    shared: int = 0

    def to(self, device: torch.device) -> Batch:
        """The batch on `device`; copied from pinned memory in the background where that is CUDA."""
        if device.type == "cpu":
            return self
        moved: dict[str, Any] = {
            name: getattr(self, name).pin_memory().to(device, non_blocking=True)
            for name in ("input_ids", "rows", "columns", "targets", "positions")
            if getattr(self, name) is not None
        }
        return replace(self, **moved)


def epoch_order(count: int, seed: int, epoch: int) -> list[int]:
    """The order of `count` samples in an epoch; it depends on seed and epoch alone."""
    return [int(index) for index in np.random.default_rng([seed, epoch]).permutation(count)]


def epoch_steps(
    lengths: Sequence[int], batch_size: int, accumulation: int, seed: int, epoch: int
) -> list[list[list[int]]]:
    """The optimiser steps of an epoch, each a list of batches of sample indices. Samples of one
    step are sorted by length before they are put into batches: less padding, and the same gradient,
    a mean over the step's tokens. The last step may be smaller.
    """
    order = epoch_order(len(lengths), seed, epoch)
    steps = [
        sorted(step, key=lambda index: -lengths[index])
        for step in _chunks(order, batch_size * accumulation)
    ]
    return [_chunks(step, batch_size) for step in steps]


def _chunks(values: list[int], size: int) -> list[list[int]]:
    return [values[start : start + size] for start in range(0, len(values), size)]


def validation_batches(lengths: Sequence[int]) -> Iterator[list[int]]:
    """Indices by length in batches of at most VALIDATION_TOKENS; a longer sample goes alone."""
    batch: list[int] = []
    for index in sorted(range(len(lengths)), key=lambda index: -lengths[index]):
        # Longest first: a batch that does not fit the memory shows at once.
        if batch and lengths[batch[0]] * (len(batch) + 1) > VALIDATION_TOKENS:
            yield batch
            batch = []
        batch.append(index)
    if batch:
        yield batch


def collate(
    samples: Sequence[Sample], pad: int, *, packed: bool = False, together: int = 0
) -> Batch:
    """A batch of rendered samples. `pad` is any valid token id: nothing attends to padding. A
    sample has a row of its own, or, with `packed`, short ones share a row as wide as the longest.
    Samples that begin alike share rows of up to `together` positions, their beginning stands once.
    """
    shared = _shared(samples) if together else 0
    lengths = [sample.length - 1 - shared for sample in samples]
    room = max(lengths)
    if shared:
        room = max(room, min(sum(lengths), together - shared - WIDTH_MULTIPLE))
    width = -(-(shared + room) // WIDTH_MULTIPLE) * WIDTH_MULTIPLE
    places = [(row, 0) for row in range(len(samples))]
    if packed or shared:
        places = packed_places(lengths, width - shared)
    height = max(row for row, _start in places) + 1
    input_ids = torch.full((height, width), pad, dtype=torch.long)
    input_ids[:, :shared] = torch.tensor(samples[0].rendered.input_ids[:shared])
    positions = torch.arange(width).repeat(height, 1)
    trained: list[tuple[int, int, int]] = []
    for sample, (row, start) in sorted(zip(samples, places, strict=True), key=lambda pair: pair[1]):
        row_ids, first = sample.rendered.input_ids, shared + start
        own = torch.tensor(row_ids[shared:-1])
        input_ids[row, first : first + len(own)] = own
        positions[row, first:] = shared + torch.arange(width - first)
        marked = enumerate(zip(row_ids, sample.rendered.completion_mask, strict=True), start - 1)
        trained += [(row, column, target) for column, (target, kept) in marked if kept]
    rows, columns, targets = torch.tensor(trained, dtype=torch.long).reshape(-1, 3).T.contiguous()
    ids = tuple(sample.id for sample in samples)
    tokens = sum(lengths) + len(samples) + height * shared
    packed = any(start for _row, start in places)
    return Batch(
        ids, input_ids, rows, columns, targets, tokens, positions if packed else None, shared
    )


def _shared(samples: Sequence[Sample]) -> int:
    """Tokens that all prompts begin with, none where they are few; each keeps one of its own."""
    prompts = [one.rendered.input_ids[: one.rendered.prompt_length - 1] for one in samples]
    columns = zip(*prompts, strict=False) if len(prompts) > 1 else ()
    count = sum(1 for _ in takewhile(lambda ids: len(set(ids)) == 1, columns))
    return count if count >= SHARED else 0


def packed_places(lengths: Sequence[int], width: int) -> list[tuple[int, int]]:
    """(row, first column) of each sample in rows of `width`, longest first, first row with room."""
    used: list[int] = []
    places: dict[int, tuple[int, int]] = {}
    for index in sorted(range(len(lengths)), key=lambda index: -lengths[index]):
        fitting = (row for row, filled in enumerate(used) if filled + lengths[index] <= width)
        row = next(fitting, len(used))
        used += [0] if row == len(used) else []
        places[index] = row, used[row]
        used[row] += lengths[index]
    return [places[index] for index in range(len(lengths))]
