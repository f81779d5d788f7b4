"""Batches by length; their size finds itself, doubled until memory runs out, and halved then."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import TypeVar

from planner_ft.support.errors import PlannerError

Answer = TypeVar("Answer")

FIRST, LARGEST = 16, 256
"""The size to begin with, also the largest on a CPU (larger ones gain nothing), and on a GPU."""


@dataclass
class BatchSize:
    """The queries that are generated together, and how many there may be at most."""

    size: int
    largest: int

    def used(self, count: int, *, fitted: bool) -> None:
        """Judge by a batch of `count` queries. Raises PlannerError when a single one did not fit."""
        if fitted:
            self.size = min(2 * count, self.largest) if count == self.size else self.size
        elif count == 1:
            raise PlannerError(
                "the device has too little memory for a single query; give a smaller candidate or"
                " another --device (what is done is kept for --resume)"
            )
        else:
            self.size = self.largest = count // 2


def in_batches(
    ask: Callable[[list[int]], Iterator[tuple[int, Answer]]],
    lengths: Sequence[int],
    batch: BatchSize,
    out_of_memory: Callable[[Exception], bool],
) -> Iterator[tuple[int, Answer, int]]:
    """Yield (index, answer, size of its batch), longest queries first, so that a query that does
    not fit shows at once; those that a full memory left unanswered are asked again.

    `ask` answers the queries of some indices and yields (place among them, answer).
    """
    waiting = sorted(range(len(lengths)), key=lambda index: (-lengths[index], index))
    while waiting:
        asked, done, full = waiting[: batch.size], set(), False
        try:
            for place, answer in ask(asked):
                done.add(asked[place])
                yield asked[place], answer, len(asked)
        except Exception as error:
            if not out_of_memory(error):
                raise
            full = True
        # Out of the handler: the exception held the tensors of the batch.
        batch.used(len(asked), fitted=not full)
        waiting = [index for index in waiting if index not in done]


def is_out_of_memory(error: BaseException) -> bool:
    """Whether the accelerator's memory was too small; its cached memory is given back then."""
    import torch

    found = any(isinstance(one, torch.OutOfMemoryError) for one in (error, error.__cause__))
    if found and torch.cuda.is_available():
        torch.cuda.empty_cache()
    return found


def new_batch_size(asked: int | None, device: str) -> BatchSize:
    """The size that was asked for, or one that finds itself."""
    if asked is not None:
        return BatchSize(asked, asked)
    return BatchSize(FIRST, LARGEST if device.startswith("cuda") else FIRST)
