"""Rows of one width, as a GPU is trained on them."""

from __future__ import annotations

import itertools
import time
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from random import Random
from typing import Any

import numpy as np
import pytest
import torch

from planner_ft.data.missions import sample_missions
from planner_ft.pretraining.corpus import Mixture, load_shard
from planner_ft.pretraining.grids import (
    Grid,
    grid_batches,
    grid_of,
    grids_of,
    read_grid,
    write_grid,
)
from planner_ft.pretraining.loop import Budget, PretrainSettings, grid_loss, new_model, pretrain
from planner_ft.pretraining.packs import IGNORE, Pack, packed
from planner_ft.vocabulary import load_vocabulary

DRONE = load_vocabulary("inspection_drone")
SETTINGS = PretrainSettings(
    *(6000, 0.0, 1024), hidden=32, layers=2, heads=2, feed_forward=64, batch_tokens=4096
)
SPECIAL = {"bos": 1, "eos": 2, "pad": 0}


@pytest.fixture(scope="module")
def pack(tokenizer: Any) -> Pack:
    return packed(DRONE, list(sample_missions(3, 4, DRONE)), [DRONE], tokenizer, Random(1), 1024)


def alone(ids: Any, prompt: int) -> Grid:
    """A sample on its own, by hand."""
    labels = np.full(len(ids), IGNORE)
    labels[prompt - 1 : -1] = ids[prompt:]
    ones = np.ones(len(ids))
    rows = (ids, labels, np.arange(len(ids)), ones, ones)
    return Grid(*(np.asarray(row)[None].astype(np.int16) for row in rows))


def test_the_loss_of_a_grid_is_that_of_its_samples_alone(
    shard: Path, pack: Pack, tokenizer: Any
) -> None:
    samples = load_shard(shard)[0][:12]
    model: Any = new_model(SETTINGS, len(tokenizer), SPECIAL)
    prefix = pack[0][0]
    whole = [(np.concatenate([prefix, ids]), len(prefix) + prompt) for ids, prompt in pack[1:]]
    with torch.no_grad():
        found = grid_loss(model, model.model, grid_of(samples, [pack], 2048, seed=4))
        losses, counts = [], []
        for ids, prompt in [*samples, *whole]:
            losses.append(float(grid_loss(model, model.model, alone(ids, prompt))))
            counts.append(len(ids) - prompt)
    assert float(found) == pytest.approx(np.average(losses, weights=counts), rel=2e-3)


def test_every_sample_stands_once_and_little_is_padding(shard: Path, pack: Pack) -> None:
    samples, _packs = load_shard(shard)
    grid = grid_of(samples, [pack] * 3, 2048, seed=0)
    answers = sum(len(ids) - prompt for ids, prompt in [*samples, *pack[1:] * 3])
    assert int((grid.labels != IGNORE).sum()) == answers
    assert grid.tokens >= sum(len(ids) for ids, _prompt in [*samples, *pack * 3])
    assert grid.tokens > 0.8 * grid.units.size


def test_batches_have_one_shape_and_lose_no_row(shard: Path, tmp_path: Path) -> None:
    copy = tmp_path / "a.npz"
    copy.write_bytes(shard.read_bytes())
    grid = read_grid(write_grid(copy, 1024, 1))
    rows = list(grid_batches(iter([grid] * 3), 5))
    assert {batch.units.shape for batch in rows} == {(5, 1024)}
    assert len(rows) == len(grid.units) * 3 // 5
    taken = np.concatenate([batch.input_ids for batch in rows])
    assert (taken == np.concatenate([grid.input_ids] * 3)[: len(taken)]).all()


def test_a_model_learns_on_grids(shard: Path, tokenizer: Any, tmp_path: Path) -> None:
    grid = grid_of(*load_shard(shard), 1024, seed=0)
    model: Any = new_model(SETTINGS, len(tokenizer), SPECIAL)
    with torch.no_grad():
        before = float(grid_loss(model, model.model, grid))
    settings = replace(SETTINGS, tokens=60_000, compile=False)
    grids: Iterator[Grid] = itertools.repeat(grid)
    pretrain(model, [], settings, folder=tmp_path, grids=grids)
    with torch.no_grad():
        after = float(grid_loss(model, model.model, grid))
    assert after < 0.9 * before


def test_seconds_end_a_training_and_the_first_step_of_a_run_spends_none() -> None:
    settings = replace(SETTINGS, tokens=1000, seconds=1000.0)
    budget, resumed = Budget(settings), Budget(settings, earlier=600.0)
    assert budget.spent(100) == 0.1
    assert resumed.spent(100) == pytest.approx(0.6)
    for one in (budget, resumed):
        one.started, one.compiled = time.monotonic() - 300, time.monotonic() - 200
    assert budget.spent(100) == pytest.approx(200 / 900, abs=0.01)
    assert resumed.spent(100) == pytest.approx(800 / 900, abs=0.01)
    late = Budget(replace(settings, seconds=50.0))
    late.started, late.compiled = time.monotonic() - 90, time.monotonic() - 10
    assert late.spent(0) == 1.0


def test_grids_are_drawn_while_they_are_used_and_found_again(
    tokenizer: Any, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    tokenizer.save_pretrained(tmp_path / "tokenizer")
    job = (tmp_path / "shard-0.npz", tmp_path / "tokenizer", 3, 8, 1024, Mixture(0.5))
    broken = (tmp_path / "shard-1.npz", tmp_path / "none", 3, 8, 1024, Mixture(0.5))
    grids = grids_of([job, broken], workers=1, width=1024, seed=0)
    drawn = [next(grids) for _ in range(2)]
    grids.close()
    assert all(grid.tokens for grid in drawn) and (tmp_path / "shard-0.json").is_file()
    written = (tmp_path / "shard-0.grid.npz").stat().st_mtime_ns
    assert next(grids_of([job], workers=1, width=1024, seed=0)).tokens == drawn[0].tokens
    assert (tmp_path / "shard-0.grid.npz").stat().st_mtime_ns == written
    with pytest.raises(Exception, match="none"):
        next(grids_of([broken], workers=1, width=1024, seed=0))
    assert "shard-1.npz" in capsys.readouterr().out
