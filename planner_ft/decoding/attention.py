"""Attention of the small models, over queries and keys in blocks of a fixed size.

A position's logits do not depend on how many positions share its pass or on the other rows of the
batch, even in bfloat16 where the CPU multiplies it (oneDNN gives a row the same numbers whatever
rows stand beside it): drafting, fast-forward and batches change not one bit.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import torch
from torch import Tensor

BLOCK = 8
"""Queries that are multiplied together. A pass over fewer is filled up to it."""
KEYS = 128
"""Keys that are multiplied together. Memory comes in multiples of it."""


@dataclass(frozen=True)
class Grid:
    """Where the tokens of a pass stand: blocks of `width` neighbours from the positions `starts`
    on, filled up with tokens that count for nothing. `where` are the row and positions of all
    tokens in the memory, `parts` the blocks that attend together, their rows, and their keys.
    """

    starts: Tensor
    width: int
    where: tuple[Any, Any]
    parts: Sequence[tuple[slice, slice, int]]

    @classmethod
    def of_row(cls, row: int, start: int, count: int) -> Grid:
        """A single row with any number of tokens; its blocks attend one after the other."""
        width = min(count, BLOCK)
        starts, own = range(start, start + count, width), slice(row, row + 1)
        reach = [rounded_up(first + width) for first in starts]
        parts = [(slice(block, block + 1), own, keys) for block, keys in enumerate(reach)]
        positions = slice(start, start + len(starts) * width)
        return cls(torch.tensor(starts), width, (row, positions), parts)

    @classmethod
    def of_rows(cls, starts: Sequence[int], width: int) -> Grid:
        """All rows, each with at most `width` tokens."""
        rows, first = torch.arange(len(starts)).repeat_interleave(width), torch.tensor(starts)
        positions = (first[:, None] + torch.arange(width)).flatten()
        parts = [(slice(None), slice(None), rounded_up(max(starts) + width))]
        return cls(first, width, (rows, positions), parts)

    def hidden(self, group: int) -> Tensor:
        """Minus infinity for later keys, else 0: (blocks, 1, group * BLOCK, keys)."""
        queries = (self.starts[:, None] + torch.arange(BLOCK)).repeat(1, group)
        later = torch.arange(self.parts[-1][2]) > queries[:, None, :, None]
        return torch.zeros(later.shape).masked_fill_(later, -torch.inf)


def attention(queries: Tensor, memory: Tensor, hidden: Tensor) -> Tensor:
    """Attention of queries (blocks, key heads, queries, size) over keys and values (2, blocks,
    positions, key heads, size).

    The result does not depend on how many hidden keys stand behind the others: values are added up
    in chunks, in their order.
    """
    keys, values = memory.transpose(2, 3)
    scores = torch.matmul(queries, keys.transpose(2, 3))
    weights = torch.softmax(scores.mul_(queries.shape[-1] ** -0.5).add_(hidden), -1)
    found = torch.matmul(weights[..., :KEYS], values[:, :, :KEYS])
    for start in range(KEYS, keys.shape[2], KEYS):
        chunk = slice(start, start + KEYS)
        found += torch.matmul(weights[..., chunk], values[:, :, chunk])
    return found


def rounded_up(number: int) -> int:
    """The next multiple of KEYS."""
    return -(-number // KEYS) * KEYS
