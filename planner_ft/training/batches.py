"""From samples to tensors: the order of an epoch, optimiser steps, batches without needless padding."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    import torch

    from planner_ft.training.samples import Sample

VALIDATION_TOKENS = 2048
"""Tokens, padding included, that go through the model together in a validation pass."""


WIDTH_MULTIPLE = 16
"""Batches are padded to a multiple of this: matrix kernels are prepared per shape (on a CPU at 50 ms a new width for a
7-million-weight model), and GPUs multiply multiples of 8 fastest."""


@dataclass(frozen=True)
class Batch:
    """Samples side by side, padded on the right, without their last token, which predicts nothing.

    `input_ids` has the shape (samples, width). There is no attention mask: attention is causal, so that padding on the
    right reaches no token before it. `rows` and `columns` say where the model predicts completion tokens and `targets`
    which: three vectors of one length, over all samples. So the output layer runs there alone.
    """

    ids: tuple[str, ...]
    input_ids: torch.Tensor
    rows: torch.Tensor
    columns: torch.Tensor
    targets: torch.Tensor
    tokens: int
    """Tokens of the samples, padding not counted."""

    def to(self, device: torch.device) -> Batch:
        """The batch on `device`; copied from pinned memory in the background where that is CUDA."""
        if device.type == "cpu":
            return self
        names = ("input_ids", "rows", "columns", "targets")
        moved = {name: getattr(self, name).pin_memory().to(device, non_blocking=True) for name in names}
        return replace(self, **moved)


def epoch_order(count: int, seed: int, epoch: int) -> list[int]:
    """The order of `count` samples in an epoch: the same for the same seed and epoch, whatever ran before."""
    return [int(index) for index in np.random.default_rng([seed, epoch]).permutation(count)]


def epoch_steps(lengths: Sequence[int], batch_size: int, accumulation: int, seed: int, epoch: int) -> list[list[list[int]]]:
    """The optimiser steps of an epoch, each a list of batches of sample indices. The last step may be smaller.

    Samples of one step are sorted by length before they are put into batches: less padding, and the step's gradient,
    a mean over its tokens, stays what it is.
    """
    order = epoch_order(len(lengths), seed, epoch)
    size = batch_size * accumulation
    steps = [sorted(order[start : start + size], key=lambda index: -lengths[index]) for start in range(0, len(order), size)]
    return [[step[start : start + batch_size] for start in range(0, len(step), batch_size)] for step in steps]


def validation_batches(lengths: Sequence[int]) -> Iterator[list[int]]:
    """Indices sorted by length, in batches of at most VALIDATION_TOKENS (a longer sample goes alone)."""
    batch: list[int] = []
    for index in sorted(range(len(lengths)), key=lambda index: -lengths[index]):
        # Longest first, so that a batch that does not fit the memory shows at once; the first of a batch is its width.
        if batch and lengths[batch[0]] * (len(batch) + 1) > VALIDATION_TOKENS:
            yield batch
            batch = []
        batch.append(index)
    if batch:
        yield batch


def collate(samples: Sequence[Sample], pad: int) -> Batch:
    """A batch of rendered samples. `pad` is any valid token id: nothing attends to padding."""
    import torch

    longest = max(sample.length for sample in samples) - 1
    width = -(-longest // WIDTH_MULTIPLE) * WIDTH_MULTIPLE
    input_ids = torch.full((len(samples), width), pad, dtype=torch.long)
    rows: list[int] = []
    columns: list[int] = []
    targets: list[int] = []
    for row, sample in enumerate(samples):
        ids = sample.rendered.input_ids
        input_ids[row, : len(ids) - 1] = torch.tensor(ids[:-1])
        trained = [position for position, kept in enumerate(sample.rendered.completion_mask) if kept]
        rows.extend([row] * len(trained))
        columns.extend(position - 1 for position in trained)
        targets.extend(ids[position] for position in trained)
    return Batch(
        ids=tuple(sample.id for sample in samples),
        input_ids=input_ids,
        rows=torch.tensor(rows),
        columns=torch.tensor(columns),
        targets=torch.tensor(targets),
        tokens=sum(sample.length for sample in samples),
    )
