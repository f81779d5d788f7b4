"""How the embedded candidate is made: tokenizer, packed corpus, resumable loop."""

import itertools
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import torch

from planner_ft.pretraining.corpus import load_shard, tokenizer_texts
from planner_ft.pretraining.grids import grid_of, parts_of
from planner_ft.pretraining.loop import (
    PretrainSettings,
    batches,
    completion_loss,
    grid_loss,
    learning_rate,
    new_model,
    pretrain,
)
from planner_ft.pretraining.tokenizer import train_tokenizer
from planner_ft.prompts import system_text
from planner_ft.vocabulary import load_vocabulary

VOCABULARY = load_vocabulary()
TINY = PretrainSettings(
    hidden=32, layers=1, heads=2, feed_forward=64, batch_tokens=2048, tokens=6000, compile=False
)
SPECIAL = {"bos": 1, "eos": 2, "pad": 0}


def test_any_text_survives_the_tokenizer(tokenizer: Any) -> None:
    text = 'Größe 12.5 m, "20 20" → {"x":-99,"unknown_key":[1,2]} \u2028 naïve 🚤\n\n'
    assert tokenizer.decode(tokenizer.encode(text, add_special_tokens=False)) == text


def test_digits_stand_apart_and_instructions_are_one_token(tokenizer: Any) -> None:
    pieces = [
        tokenizer.decode([token])
        for token in tokenizer.encode("at [120, -45]", add_special_tokens=False)
    ]
    assert [piece.strip() for piece in pieces if piece.strip().isdigit()] == [
        "1",
        "2",
        "0",
        "4",
        "5",
    ]
    assert (
        len(
            tokenizer.encode(
                system_text("mission", VOCABULARY, with_vocabulary=False), add_special_tokens=False
            )
        )
        == 1
    )


def test_the_tokenizer_is_the_same_for_the_same_texts(tokenizer: Any) -> None:
    again = train_tokenizer(tokenizer_texts(VOCABULARY, 0, 300, 0.5), VOCABULARY, size=1200)
    assert again.get_vocab() == tokenizer.get_vocab()


def test_batches_hold_every_sample_once_and_little_padding(shard: Path) -> None:
    samples = load_shard(shard)[0]
    tokens = sum(len(ids) for ids, _prompt in samples)
    drawn = list(itertools.islice(batches([shard], TINY, 0), -(-tokens // 2048) + 2))
    grid = grid_of(samples, [], 2048, seed=TINY.seed)
    for row, batch in zip(range(len(grid.units)), drawn, strict=False):
        assert np.array_equal(batch.input_ids, grid.input_ids[row : row + 1])
    cells = [parts_of(batch) for batch in drawn[: len(grid.units)]]
    found = [tuple(ids[a:b]) for ids, *_, parts in cells for a, b, *_shown in parts]
    assert sorted(found) == sorted(tuple(ids) for ids, _prompt in samples)
    assert sum(len(ids) for ids, *_ in cells) == tokens > 0.8 * grid.units.size
    assert [*batches([shard], TINY, 2).__next__().labels[0]] == [*drawn[2].labels[0]]


def test_other_samples_and_padding_do_not_change_the_loss(shard: Path, tokenizer: Any) -> None:
    samples = sorted(load_shard(shard)[0], key=lambda sample: len(sample[0]))[:4]
    model: Any = new_model(TINY, len(tokenizer), SPECIAL)
    weights = [len(ids) - prompt for ids, prompt in samples]
    apart = [
        completion_loss(model, model.model, grid_of([one], [], len(one[0]), 0)).item()
        for one in samples
    ]
    together = completion_loss(model, model.model, grid_of(samples, [], 2048, 0))
    assert together.item() == pytest.approx(np.average(apart, weights=weights), rel=2e-3)
    with torch.no_grad():
        masked = grid_loss(model, model.model, grid_of(samples, [], 2048, 0))
    assert together.item() == pytest.approx(masked.item(), rel=2e-3)


@pytest.mark.parametrize("count", [1, 2, 5])
def test_shares_of_a_batch_add_up_to_it(shard: Path, tokenizer: Any, count: int) -> None:
    model: Any = new_model(TINY, len(tokenizer), SPECIAL)
    rows = grid_of(load_shard(shard)[0][:count], [], 1024, 0)

    def gradients(rank: int, world: int) -> list[torch.Tensor]:
        model.zero_grad()
        completion_loss(model, model.model, rows, rank, world).backward()
        return [value.grad.clone() for value in model.parameters()]

    shares, whole = [gradients(rank, 2) for rank in range(2)], gradients(0, 1)
    for first, second, wanted in zip(*shares, whole, strict=True):
        assert torch.allclose(first + second, wanted, rtol=0.05, atol=2e-3)
    losses = [completion_loss(model, model.model, rows, rank, 2).item() for rank in range(2)]
    assert sum(losses) == pytest.approx(completion_loss(model, model.model, rows).item(), rel=2e-3)


def test_the_loss_falls_and_an_interrupted_run_continues(
    shard: Path, tokenizer: Any, tmp_path: Path
) -> None:
    def run(folder: str, tokens: int) -> tuple[dict[str, Any], Any]:
        model: Any = new_model(TINY, len(tokenizer), SPECIAL)
        # The plateau of the learning rate is the same for both budgets, so that only the
        # interruption differs.
        settings = replace(TINY, tokens=tokens, warmup=1e-9, decay=1e-9)
        return pretrain(model, [shard], settings, folder=tmp_path / folder), model

    whole, first = run("whole", 30_000)
    run("parts", 12_000)
    resumed, second = run("parts", 30_000)
    assert resumed["step"] == whole["step"] and resumed["tokens"] == whole["tokens"]
    assert all(
        torch.equal(a, b)
        for a, b in zip(first.state_dict().values(), second.state_dict().values(), strict=True)
    )
    fresh: Any = new_model(TINY, len(tokenizer), SPECIAL)
    rows = grid_of(load_shard(shard)[0][:8], [], 1024, 0)
    assert completion_loss(first, first.model, rows) < 0.9 * completion_loss(
        fresh, fresh.model, rows
    )


def test_the_learning_rate_rises_stays_and_falls_to_zero() -> None:
    settings = replace(TINY, tokens=1000, warmup=0.1, decay=0.5)
    assert [round(learning_rate(settings, done), 2) for done in (0, 0.05, 0.1, 0.5, 0.75, 1)] == [
        0,
        0.5,
        1,
        1,
        0.5,
        0,
    ]
