"""Rows of one width for a GPU: samples and packs stand one behind the other, and a mask keeps them
apart. Every batch has the same shape, so the model is compiled once.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import torch
from numpy.typing import NDArray
from torch import Tensor

from planner_ft.pretraining.corpus import Sample, load_shard
from planner_ft.pretraining.packs import IGNORE, Pack
from planner_ft.support.files import atomic_writer

OPEN = 48
"""Rows that are filled at a time."""
FIELDS = ("input_ids", "labels", "positions", "units", "parts")
Cells = NDArray[np.int16]


@dataclass(frozen=True)
class Grid:
    """Rows of one width: int16 arrays of shape (rows, width).

    `labels` are IGNORE outside answers. `units` number the samples and packs of a row, 0 where
    nothing stands; `parts` number the samples of a pack, 0 for the vocabulary that they share.
    """

    input_ids: Cells
    labels: Cells
    positions: Cells
    units: Cells
    parts: Cells

    @property
    def tokens(self) -> int:
        """The number of tokens, without padding."""
        return int((self.units > 0).sum())


def bias_of(units: Tensor, parts: Tensor) -> Tensor:
    """What each position sees, as a bfloat16 bias of shape (rows, 1, width, width): those before it
    in its own sample and in the vocabulary of its pack. Padding sees padding.
    """
    width = units.shape[1]
    same = units[:, :, None] == units[:, None, :]
    same &= (parts[:, :, None] == parts[:, None, :]) | (parts[:, None, :] == 0)
    same &= torch.ones(width, width, dtype=torch.bool, device=units.device).tril()
    bias = torch.zeros(same.shape, dtype=torch.bfloat16, device=units.device)
    return bias.masked_fill_(~same, float("-inf"))[:, None]


def grid_of(samples: Sequence[Sample], packs: Sequence[Pack], width: int, seed: int) -> Grid:
    """All samples and packs in rows of `width`; a pack that does not fit becomes several."""
    rng = np.random.default_rng(seed)
    units: list[Pack] = [[part] for part in samples if len(part[0]) <= width]
    for pack in packs:
        units += _pieces(pack, width)
    rows, spaces = list[list[Pack]](), list[int]()
    done = list[list[Pack]]()
    for index in map(int, rng.permutation(len(units))):
        unit, size = units[index], sum(len(ids) for ids, _prompt in units[index])
        fits = [at for at, space in enumerate(spaces) if space >= size]
        if not fits:
            if len(rows) == OPEN:
                fullest = min(range(OPEN), key=spaces.__getitem__)
                done.append(rows.pop(fullest))
                spaces.pop(fullest)
            rows.append([])
            spaces.append(width)
            fits = [len(rows) - 1]
        at = min(fits, key=spaces.__getitem__)
        rows[at].append(unit)
        spaces[at] -= size
    done += rows
    cells = {name: np.zeros((len(done), width), np.int16) for name in FIELDS}
    cells["labels"][:] = IGNORE
    for row, at in enumerate(map(int, rng.permutation(len(done)))):
        _fill({name: values[row] for name, values in cells.items()}, done[at])
    return Grid(**cells)


def _pieces(pack: Pack, width: int) -> Iterator[Pack]:
    """A pack as packs of at most `width` tokens; what does not fit behind its vocabulary is left
    out.
    """
    vocabulary, *samples = pack
    piece, used = [vocabulary], len(vocabulary[0])
    for sample in samples:
        size = len(sample[0])
        if used + size > width and len(piece) > 1:
            yield piece
            piece, used = [vocabulary], len(vocabulary[0])
        if used + size <= width:
            piece.append(sample)
            used += size
    if len(piece) > 1:
        yield piece


def _fill(row: dict[str, Cells], units: Sequence[Pack]) -> None:
    at = 0
    for number, unit in enumerate(units, 1):
        shown = len(unit[0][0]) if len(unit) > 1 else 0
        for part, (ids, prompt) in enumerate(unit):
            end, answers = at + len(ids), len(ids) - prompt
            row["input_ids"][at:end] = ids
            if answers:
                row["labels"][at + prompt - 1 : end - 1] = ids[prompt:]
            begin = shown if part else 0
            row["positions"][at:end] = np.arange(begin, begin + len(ids))
            row["units"][at:end] = number
            row["parts"][at:end] = part
            at = end


def write_grid(shard: Path, width: int, seed: int) -> Path:
    """Write a shard's samples and packs as a grid beside it; return the file."""
    grid = grid_of(*load_shard(shard), width, seed)
    path = shard.with_suffix(".grid.npz")
    with atomic_writer(path, "wb") as stream:
        held: dict[str, Any] = {name: getattr(grid, name) for name in FIELDS}
        np.savez(stream, **held)
    return path


def read_grid(path: Path) -> Grid:
    """A grid that `write_grid` wrote."""
    with np.load(path) as data:
        return Grid(**{name: data[name] for name in FIELDS})


def grid_batches(grids: Iterator[Grid], rows: int) -> Iterator[Grid]:
    """Batches of `rows` rows; what is left of a grid goes into the next batch."""
    kept: list[Grid] = []
    for grid in grids:
        kept.append(grid)
        while sum(len(one.units) for one in kept) >= rows:
            whole = {name: np.concatenate([getattr(one, name) for one in kept]) for name in FIELDS}
            yield Grid(**{name: values[:rows] for name, values in whole.items()})
            kept = [Grid(**{name: values[rows:] for name, values in whole.items()})]
