"""The corpus, drawn by several processes: shards before a training, or grids while it runs."""

from __future__ import annotations

import dataclasses
import gc
from collections.abc import Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, ProcessPoolExecutor, wait
from multiprocessing import get_context
from pathlib import Path
from random import Random

from planner_ft.pretraining.corpus import Mixture, encode_shard
from planner_ft.pretraining.grids import Grid, read_grid, write_grid
from planner_ft.support.files import write_json
from planner_ft.support.manifest import source_commit
from planner_ft.vocabulary import load_vocabulary

Job = tuple[Path, Path, int, int, int, Mixture]
"""Shard, tokenizer, seed, number of samples, tokens of a sample at most, and mixture."""


def make_shard(job: Job) -> dict[str, int]:
    """Write one shard of the corpus (worker process)."""
    from transformers import PreTrainedTokenizerFast

    path, tokenizer, seed, count, longest, mixture = job
    gc.disable()  # Samples have no cycles, and collecting walks thousands of parsed templates.
    return encode_shard(
        path,
        PreTrainedTokenizerFast.from_pretrained(tokenizer),
        load_vocabulary(),
        seed=seed,
        count=count,
        mixture=mixture,
        longest=longest,
    )


def record(job: Job, counts: dict[str, int], commit: str | None) -> None:
    """Write beside a shard what it holds."""
    mixture = job[-1]
    shares = {**dataclasses.asdict(mixture), "folder": str(mixture.folder)}
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
