"""The forward passes of the lean decoder: keys, values, and attention in blocks of a fixed size."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import torch
from torch import Tensor
from torch.nn.functional import embedding, linear, pad, silu

if TYPE_CHECKING:
    from planner_ft.decoding.lean import Layer, LeanDecoder

BLOCK = 8
"""Queries that are multiplied together. A pass over fewer is filled up to it."""
KEYS = 128
"""Keys that are multiplied together. Memory comes in multiples of it."""


class LeanPasses:
    """Forward passes of a batch. Rows have their own positions, so each is fed as many tokens as it
    likes.
    """

    wide = True

    def __init__(self, decoder: LeanDecoder, rows: int) -> None:
        self.decoder = decoder
        self.lengths = [0] * rows
        self.capacity = 0
        self.keys = [
            torch.zeros(rows, 0, decoder.key_heads, decoder.head_size) for _layer in decoder.layers
        ]
        self.values = [keys.clone() for keys in self.keys]

    def run(self, feeds: Sequence[Sequence[int]], wanted: Sequence[int]) -> Tensor:
        counts = [len(feed) for feed in feeds]
        self._make_room(
            max(length + count for length, count in zip(self.lengths, counts, strict=True))
        )
        if len(feeds) > 1 and max(counts) <= BLOCK:
            logits = self._run(_Place.of_rows(self.lengths, counts), feeds, wanted)
        else:  # prompts one after the other, so that none is filled up to the longest
            places = [
                _Place.of_row(row, length, count)
                for row, (length, count) in enumerate(zip(self.lengths, counts, strict=True))
            ]
            logits = torch.cat(
                [
                    self._run(place, [feed], [count])
                    for place, feed, count in zip(places, feeds, wanted, strict=True)
                ]
            )
        self.lengths = [length + count for length, count in zip(self.lengths, counts, strict=True)]
        return logits

    def forget(self, counts: Sequence[int]) -> None:
        self.lengths = [length - count for length, count in zip(self.lengths, counts, strict=True)]

    def select(self, kept: Sequence[int]) -> None:
        self.lengths = [self.lengths[row] for row in kept]
        self.keys = [keys[list(kept)] for keys in self.keys]
        self.values = [values[list(kept)] for values in self.values]

    def _make_room(self, positions: int) -> None:
        """Memory for this many positions, and their angles. What is not written yet is zero:
        hidden, it must still be a number.
        """
        if positions <= self.capacity:
            return
        self.capacity = max(_up(positions), 2 * self.capacity)
        self.keys, self.values = (
            [pad(memory, (0, 0, 0, 0, 0, self.capacity - memory.shape[1])) for memory in kind]
            for kind in (self.keys, self.values)
        )
        self.angles = self.decoder.angles(self.capacity)

    def _run(self, place: _Place, feeds: Sequence[Sequence[int]], wanted: Sequence[int]) -> Tensor:
        """The wanted logits of the rows of a place."""
        decoder = self.decoder
        hidden = place.hidden(decoder.heads // decoder.key_heads)
        angles = [angle[place.positions] for angle in self.angles]
        states = embedding(
            torch.tensor([token for feed in feeds for token in feed]), decoder.embeddings
        ).float()
        for layer, keys, values in zip(decoder.layers, self.keys, self.values, strict=True):
            states = states + self._attend(
                layer, decoder.normalised(states, layer.norm), place, hidden, angles, (keys, values)
            )
            gate, up = linear(
                decoder.normalised(states, layer.feed_norm), layer.gate_up, layer.gate_up_bias
            ).chunk(2, -1)
            states = states + linear(silu(gate) * up, layer.down, layer.down_bias)
        kept = [
            sum(map(len, feeds[: row + 1])) + step
            for row, count in enumerate(wanted)
            for step in range(-count, 0)
        ]
        return linear(decoder.normalised(states[kept], decoder.norm), decoder.head)

    def _attend(
        self,
        layer: Layer,
        states: Tensor,
        place: _Place,
        hidden: Tensor,
        angles: Sequence[Tensor],
        memory: tuple[Tensor, Tensor],
    ) -> Tensor:
        """Write the new keys and values into the memory, and let every position look at those up to
        itself.
        """
        heads, size, both = (
            self.decoder.heads,
            self.decoder.head_size,
            self.decoder.heads + self.decoder.key_heads,
        )
        mixed = (
            linear(states, layer.qkv, layer.qkv_bias)
            .float()
            .view(-1, both + self.decoder.key_heads, size)
        )
        turned = torch.addcmul(
            mixed[:, :both] * angles[0], mixed[:, :both].roll(size // 2, -1), angles[1]
        )
        for kind, new in zip(memory, (turned[:, heads:], mixed[:, both:]), strict=True):
            kind[place.rows, place.positions] = new
        queries = place.blocks(turned[:, :heads], self.decoder.key_heads)
        found = [
            attention(queries[part], place.known(memory, reach), hidden[part, ..., :reach])
            for part, reach in place.parts
        ]
        return linear(
            place.flat(torch.cat(found), heads).to(layer.out.dtype), layer.out, layer.out_bias
        )


@dataclass(frozen=True)
class _Place:
    """Where the tokens of a pass stand: `rows` and `positions` index the memory, `slots` the
    queries in blocks of BLOCK.

    `starts` holds the position of each block's first query. `parts` are blocks that attend
    together, with the number of keys that they look at: all rows of a batch, or one block of a
    single row after the other.
    """

    rows: Any
    positions: Any
    slots: Any
    starts: Tensor
    parts: Sequence[tuple[slice, int]]

    @classmethod
    def of_row(cls, row: int, start: int, count: int) -> _Place:
        """A single row with any number of tokens."""
        starts = range(start, start + count, BLOCK)
        parts = [
            (slice(block, block + 1), _up(min(first + BLOCK, start + count)))
            for block, first in enumerate(starts)
        ]
        return cls(row, slice(start, start + count), slice(count), torch.tensor(starts), parts)

    @classmethod
    def of_rows(cls, starts: Sequence[int], counts: Sequence[int]) -> _Place:
        """All rows, each with at most BLOCK tokens."""
        rows = torch.repeat_interleave(torch.arange(len(starts)), torch.tensor(counts))
        steps = torch.cat([torch.arange(count) for count in counts])
        first, last = (
            torch.tensor(starts),
            max(start + count for start, count in zip(starts, counts, strict=True)),
        )
        return cls(
            rows,
            first[rows] + steps,
            rows * BLOCK + steps,
            first,
            [(slice(len(starts)), _up(last))],
        )

    def hidden(self, group: int) -> Tensor:
        """Minus infinity where a key is later than a query, else 0: (blocks, 1, group * BLOCK,
        keys).
        """
        queries = (self.starts[:, None] + torch.arange(BLOCK)).repeat(1, group)
        later = torch.arange(self.parts[-1][1]) > queries[:, None, :, None]
        return torch.zeros(later.shape).masked_fill_(later, -torch.inf)

    def blocks(self, queries: Tensor, key_heads: int) -> Tensor:
        """Queries (tokens, heads, size) as (blocks, key heads, heads per key head * BLOCK,
        size).
        """
        _tokens, heads, size = queries.shape
        filled = queries.new_zeros(self.starts.numel() * BLOCK, heads, size)
        filled[self.slots] = queries
        return (
            filled.view(-1, BLOCK, key_heads, heads // key_heads, size)
            .permute(0, 2, 3, 1, 4)
            .reshape(-1, key_heads, heads // key_heads * BLOCK, size)
        )

    def flat(self, found: Tensor, heads: int) -> Tensor:
        """The inverse of `blocks`: (tokens, heads * size)."""
        blocks, key_heads, _queries, size = found.shape
        spread = found.view(blocks, key_heads, heads // key_heads, BLOCK, size).permute(
            0, 3, 1, 2, 4
        )
        return spread.reshape(blocks * BLOCK, heads * size)[self.slots]

    def known(self, memory: tuple[Tensor, Tensor], reach: int) -> tuple[Tensor, Tensor]:
        """The first `reach` keys and values of the rows: (rows, key heads, reach, size)."""
        rows = slice(self.rows, self.rows + 1) if isinstance(self.rows, int) else slice(None)
        return memory[0][rows, :reach].transpose(1, 2), memory[1][rows, :reach].transpose(1, 2)


def attention(queries: Tensor, known: tuple[Tensor, Tensor], hidden: Tensor) -> Tensor:
    """Attention whose result does not depend on how many hidden keys stand behind the others:
    values are added up in chunks, in their order.
    """
    keys, values = known
    scores = (
        torch.matmul(queries, keys.transpose(2, 3)).mul_(queries.shape[-1] ** -0.5).add_(hidden)
    )
    weights = torch.softmax(scores, -1)
    found = torch.matmul(weights[..., :KEYS], values[:, :, :KEYS])
    for start in range(KEYS, keys.shape[2], KEYS):
        found += torch.matmul(
            weights[..., start : start + KEYS], values[:, :, start : start + KEYS]
        )
    return found


def _up(number: int) -> int:
    """The next multiple of KEYS."""
    return -(-number // KEYS) * KEYS
