"""The corpus in rows of one width, written by several processes: samples and packs stand one behind
the other, kept apart on a GPU by a mask, so that every batch has the same shape and the model is
compiled once, on a processor by the places of their parts.
"""

import dataclasses
import gc
from collections.abc import Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, ProcessPoolExecutor, wait
from dataclasses import dataclass
from multiprocessing import get_context
from pathlib import Path
from random import Random

import numpy as np
import torch
from numpy.typing import NDArray
from torch import Tensor

from planner_ft.pretraining.corpus import Mixture, encode_shard, load_shard
from planner_ft.pretraining.packs import IGNORE, Pack, Part
from planner_ft.support.files import atomic_writer, write_json
from planner_ft.support.manifest import source_commit
from planner_ft.vocabulary import load_vocabulary

Job = tuple[Path, Path, int, int, int, Mixture]
"""Shard, tokenizer, seed, number of samples, tokens of a sample at most, and mixture."""
OPEN = 48
"""Rows that are filled at a time."""
FIELDS = ("input_ids", "labels", "positions", "units", "parts")
Cells = NDArray[np.int32]


@dataclass(frozen=True)
class Grid:
    """Rows of one width: int32 arrays of shape (rows, width).

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


def parts_of(grid: Grid, rank: int = 0, world: int = 1) -> list[NDArray[np.int64]]:
    """A rank's share of the samples and packs of a grid, one behind the other without padding: ids,
    labels and positions, shape (width,), and `parts`, shape (n, 4): where each part begins and
    ends, and where its vocabulary does (empty for a vocabulary itself).

    A rank without a share has the others' without labels: it must have gradients to sum.
    """
    rows = np.arange(len(grid.units))[:, None] * (int(grid.units.max()) + 1)
    own = (grid.units > 0) & ((rows + grid.units) % world == rank)
    kept = own if own.any() else grid.units > 0
    labels = np.where(own, grid.labels, IGNORE)[kept]
    units, parts = (rows + grid.units)[kept], grid.parts[kept]
    changes = np.flatnonzero(np.diff(units, prepend=-1) | np.diff(parts, prepend=-1))
    ends, first = np.append(changes[1:], len(units)), parts[changes] == 0
    shared = np.maximum.accumulate(np.where(first, np.arange(len(changes)), 0))
    shown = (np.where(first, changes, at[shared]) for at in (changes, ends))
    cells = (grid.input_ids[kept], labels, grid.positions[kept])
    table = np.stack([changes, ends, *shown], 1)
    return [values.astype(np.int64) for values in (*cells, table)]


def grid_of(samples: Sequence[Part], packs: Sequence[Pack], width: int, seed: int) -> Grid:
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
    cells = {name: np.zeros((len(done), width), np.int32) for name in FIELDS}
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
        np.savez(stream, **vars(grid))
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


# ---------------------------------------------------------------- drawing by several processes


def make_shard(job: Job) -> dict[str, int]:
    """Write one shard of the corpus (worker process)."""
    from transformers import PreTrainedTokenizerFast

    path, tokenizer, seed, count, longest, mixture = job
    gc.disable()  # Samples have no cycles, and collecting walks thousands of parsed templates.
    own = PreTrainedTokenizerFast.from_pretrained(tokenizer)
    return encode_shard(path, own, load_vocabulary(), seed, count, longest, mixture)


def record(job: Job, counts: dict[str, int], commit: str | None) -> None:
    """Write beside a shard what it holds."""
    mixture = job[-1]
    files = {"folder": str(mixture.folder), "commands": [*map(str, mixture.commands)]}
    shares = {**dataclasses.asdict(mixture), **files}
    write_json(job[0].with_suffix(".json"), {**counts, "mixture": shares, "commit": commit})


def shards_of(jobs: Sequence[Job], workers: int) -> list[Path]:
    """The corpus as shard files, those that are missing written first."""
    missing, commit = [job for job in jobs if not job[0].is_file()], source_commit()["commit"]
    with ProcessPoolExecutor(workers) as pool:
        for job, counts in zip(missing, pool.map(make_shard, missing), strict=True):
            print(f"{job[0].name}: {counts}", flush=True)
            record(job, counts, commit)
    return [job[0] for job in jobs]


def make_grid(job: tuple[Job, int]) -> dict[str, int]:
    """Write one shard of the corpus as a grid (worker process)."""
    (path, _tokenizer, seed, *_), width = job
    counts = make_shard(job[0])
    write_grid(path, width, seed)
    path.unlink()
    return counts


def grids_of(jobs: Sequence[Job], workers: int, width: int, seed: int) -> Iterator[Grid]:
    """The corpus as grids, endless: processes write those that are missing while a model is trained
    on those that are ready, the least used first. A shard that cannot be drawn is told and passed
    over; raises its error where there is no other.
    """
    paths = {job: job[0].with_suffix(".grid.npz") for job in jobs}
    uses = {path: 0 for path in paths.values() if path.is_file()}
    commit, rng = source_commit()["commit"], Random(seed)
    with ProcessPoolExecutor(workers, get_context("spawn")) as pool:
        missing = (job for job, path in paths.items() if path not in uses)
        running = {pool.submit(make_grid, (job, width)): job for job in missing}
        try:
            while True:
                ended, _rest = wait(running, 0 if uses else None, FIRST_COMPLETED)
                for future in ended:
                    job, error = running.pop(future), future.exception()
                    if error:
                        print(f"{job[0].name}: {error!r}", flush=True)
                    if error and not running and not uses:
                        raise error
                    if not error:
                        record(job, future.result(), commit)
                        uses[paths[job]] = 0
                if uses:
                    least = min(uses.values())
                    path = rng.choice([one for one, used in uses.items() if used == least])
                    uses[path] += 1
                    yield read_grid(path)
        finally:
            pool.shutdown(wait=False, cancel_futures=True)
