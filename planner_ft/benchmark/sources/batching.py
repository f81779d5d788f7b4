"""Batches by length, with a size that finds itself: it is halved when memory runs out, and doubled
while there is room.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import TypeVar

from planner_ft.support.errors import PlannerError

Answer = TypeVar("Answer")

FIRST = 16
"""The size to begin with: on a CPU larger ones gain nothing, and a killed process would be the only
sign of too large ones.
"""
LARGEST = 256
MARGIN = 0.7
"""Share of the free memory that a batch may be expected to take."""


@dataclass
class BatchSize:
    """The queries that are generated together. `room` says whether a batch of some size would fit,
    before the size is doubled; None keeps it from growing.
    """

    size: int = FIRST
    room: Callable[[int], bool] | None = None
    largest: int = LARGEST

    def fitted(self, used: int) -> None:
        """A batch of `used` queries had enough memory."""
        twice = 2 * used
        if self.room and used == self.size and twice <= self.largest and self.room(twice):
            self.size = twice

    def overflowed(self, used: int) -> None:
        """A batch of `used` queries did not have enough. Raises PlannerError when it was a single
        one.
        """
        if used == 1:
            raise PlannerError(
                "the device has too little memory for a single query; give a smaller candidate or"
                " another --device (what is done is kept for --resume)"
            )
        self.size = self.largest = used // 2


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
        if full:
            batch.overflowed(len(asked))
        else:
            batch.fitted(len(asked))
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
        return BatchSize(asked)
    return BatchSize(room=_cuda_room(device) if device.startswith("cuda") else None)


def _cuda_room(name: str) -> Callable[[int], bool]:
    """Judges by the memory that batches took at their peak beyond the model's own; called after a
    batch of half the size, the largest so far.
    """
    import torch

    device = torch.device(name)
    model = torch.cuda.memory_allocated(device)
    torch.cuda.reset_peak_memory_stats(device)

    def room(_size: int) -> bool:
        taken = torch.cuda.max_memory_allocated(device) - model
        free, _total = torch.cuda.mem_get_info(device)
        spare = torch.cuda.memory_reserved(device) - torch.cuda.memory_allocated(device)
        return 2 * taken < MARGIN * (free + spare)

    return room
