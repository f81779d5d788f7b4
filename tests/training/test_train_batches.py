"""Batches: the order of samples, what is trained, and that padding and splitting change nothing."""

from __future__ import annotations

import pytest
import torch

from planner_ft.prompts import Rendered
from planner_ft.training.batches import (
    VALIDATION_TOKENS,
    WIDTH_MULTIPLE,
    collate,
    epoch_order,
    epoch_steps,
    packed_places,
    validation_batches,
)
from planner_ft.training.samples import Sample


def sample(name: str, prompt: list[int], answer: list[int]) -> Sample:
    return Sample(
        name, Rendered(prompt + answer, [0] * len(prompt) + [1] * len(answer), len(prompt))
    )


def test_the_order_depends_on_seed_and_epoch_alone():
    assert epoch_order(50, 1, 2) == epoch_order(50, 1, 2)
    assert sorted(epoch_order(50, 1, 2)) == list(range(50))
    assert len({tuple(epoch_order(50, seed, epoch)) for seed in (0, 1) for epoch in (0, 1)}) == 4


def test_an_epoch_trains_every_sample_once():
    steps = epoch_steps([5] * 11, batch_size=2, accumulation=2, seed=0, epoch=0)
    assert [len(step) for step in steps] == [2, 2, 2]
    assert sorted(index for step in steps for batch in step for index in batch) == list(range(11))


def test_samples_of_a_step_are_put_together_by_length():
    lengths = [10, 500, 12, 480]
    (step,) = epoch_steps(lengths, batch_size=2, accumulation=2, seed=0, epoch=0)
    assert sorted(sorted(lengths[index] for index in batch) for batch in step) == [
        [10, 12],
        [480, 500],
    ]


def test_validation_batches_hold_every_sample_within_the_limit():
    lengths = [700, 100, 3000, 900, 50, 1200]
    batches = list(validation_batches(lengths))
    assert sorted(index for batch in batches for index in batch) == list(range(6))
    assert all(
        len(batch) == 1 or max(lengths[index] for index in batch) * len(batch) <= VALIDATION_TOKENS
        for batch in batches
    )


def test_completion_tokens_are_predicted_from_the_token_before():
    batch = collate([sample("a", [5, 6, 7], [8, 9]), sample("b", [1], [2])], pad=0)
    assert batch.input_ids.shape == (2, WIDTH_MULTIPLE)
    assert batch.input_ids[0, :4].tolist() == [5, 6, 7, 8]
    assert batch.input_ids[1, :2].tolist() == [1, 0]
    assert list(
        zip(batch.rows.tolist(), batch.columns.tolist(), batch.targets.tolist(), strict=True)
    ) == [(0, 2, 8), (0, 3, 9), (1, 0, 2)]
    assert batch.tokens == 7


@pytest.fixture(scope="module")
def tiny():
    """A two-layer model in float32 with an adapter whose B is not zero."""
    from transformers import LlamaConfig, LlamaForCausalLM

    from planner_ft.training.model import attach_adapter
    from planner_ft.training.settings import TrainSettings

    torch.manual_seed(0)
    config = LlamaConfig(
        vocab_size=97,
        hidden_size=32,
        intermediate_size=64,
        num_hidden_layers=2,
        num_attention_heads=2,
        num_key_value_heads=2,
    )
    model = attach_adapter(LlamaForCausalLM(config), TrainSettings(rank=4, dropout=0.0), "tiny")
    with torch.no_grad():
        for name, value in model.named_parameters():
            if "lora_B" in name:
                value.normal_(std=0.02)
    return model


SAMPLES = [
    sample(str(index), list(range(1, 4 + 3 * index)), list(range(50, 60 + index)))
    for index in range(4)
]


def gradients(model, batches) -> tuple[float, dict[str, torch.Tensor]]:
    from planner_ft.training.model import adapter_parameters, loss_sum

    model.zero_grad()
    total = 0.0
    count = sum(len(batch.targets) for batch in batches)
    for batch in batches:
        loss = loss_sum(model, batch, torch.float32) / count
        loss.backward()
        total += float(loss.detach())
    return total, {name: value.grad.clone() for name, value in adapter_parameters(model).items()}


def assert_same(first, second):
    assert first[0] == pytest.approx(second[0], rel=1e-5)
    for name, value in first[1].items():
        torch.testing.assert_close(value, second[1][name], rtol=1e-4, atol=1e-6)


def test_a_step_is_the_same_in_one_batch_or_in_several(tiny):
    whole = gradients(tiny, [collate(SAMPLES, 0)])
    assert_same(whole, gradients(tiny, [collate([item], 0) for item in SAMPLES]))
    assert_same(whole, gradients(tiny, [collate(SAMPLES[:3], 0), collate(SAMPLES[3:], 0)]))


def test_the_loss_is_the_models_own_on_completion_tokens(tiny):
    from planner_ft.training.model import loss_sum

    item = SAMPLES[2]
    ids = torch.tensor([item.rendered.input_ids])
    labels = ids.masked_fill(torch.tensor([item.rendered.completion_mask]) == 0, -100)
    ours = loss_sum(tiny, collate([item], 0), torch.float32) / item.completion_length
    assert float(ours.detach()) == pytest.approx(
        float(tiny(input_ids=ids, labels=labels).loss.detach()), rel=1e-5
    )


def test_logits_exist_for_completion_tokens_alone(tiny):
    from planner_ft.training.model import loss_sum

    seen = []
    handle = (
        tiny.get_base_model()
        .get_output_embeddings()
        .register_forward_hook(lambda module, args, output: seen.append(output.shape))
    )
    loss_sum(tiny, collate(SAMPLES, 0), torch.float32)
    handle.remove()
    assert seen == [(sum(item.completion_length for item in SAMPLES), 97)]


def test_logits_in_chunks_give_the_same_step(tiny, monkeypatch):
    whole = gradients(tiny, [collate(SAMPLES, 0)])
    monkeypatch.setattr("planner_ft.training.model.LOGIT_VALUES", 97 * 7)
    assert_same(whole, gradients(tiny, [collate(SAMPLES, 0)]))


def test_the_learning_rate_warms_up_and_falls_to_zero():
    from planner_ft.training.loop import learning_rate
    from planner_ft.training.settings import TrainSettings

    for schedule in ("cosine", "linear"):
        settings = TrainSettings(learning_rate=1.0, warmup=0.1, schedule=schedule)
        rates = [learning_rate(settings, step, 100) for step in range(100)]
        assert rates[0] == pytest.approx(0.1)
        assert max(rates) == rates[9] == rates[10] == 1.0
        assert rates[10:] == sorted(rates[10:], reverse=True)
        assert 0 < rates[-1] < 0.02
    assert (
        learning_rate(TrainSettings(learning_rate=1.0, warmup=0.0, schedule="constant"), 99, 100)
        == 1.0
    )


def test_short_samples_share_rows_as_wide_as_the_longest():
    places = packed_places([30, 10, 16, 8, 5], 32)
    assert places == [(0, 0), (1, 16), (1, 0), (2, 0), (1, 26)]
    batch = collate(
        [sample(str(length), [3] * (length - 4), [9] * 5) for length in (30, 10, 16, 8, 5)],
        0,
        packed=True,
    )
    assert batch.input_ids.shape == (3, 32)
    assert batch.positions is not None and batch.positions[1].tolist() == [
        *range(16),
        *range(10),
        *range(6),
    ]
    assert (batch.input_ids[batch.rows, batch.columns] != 0).all()


def test_samples_that_share_a_row_do_not_see_each_other(tiny):
    from planner_ft.training.model import packs

    assert packs(tiny)
    batch = collate(SAMPLES, 0, packed=True)
    assert len(batch.input_ids) < len(SAMPLES)
    assert_same(gradients(tiny, [collate(SAMPLES, 0)]), gradients(tiny, [batch]))


@pytest.mark.parametrize("name", ["Llama-3.2-1B-Instruct", "Qwen2.5-3B-Instruct"])
def test_the_candidates_keep_samples_of_a_row_apart(name, models):
    from planner_ft.candidates import resolve_candidate
    from planner_ft.candidates.loading import load_model
    from planner_ft.training.model import attach_adapter, packs
    from planner_ft.training.settings import TrainSettings

    base = load_model(
        resolve_candidate(name), device="cpu", quantization="none", trainable=True
    ).float()
    model = attach_adapter(base, TrainSettings(rank=4, dropout=0.0), name)
    assert packs(model)
    assert_same(
        gradients(model, [collate(SAMPLES, 0)]),
        gradients(model, [collate(SAMPLES, 0, packed=True)]),
    )


def test_models_with_other_layers_keep_a_row_for_each_sample(tiny, monkeypatch):
    from planner_ft.training.model import packs

    monkeypatch.setattr(tiny.get_base_model().config, "model_type", "mamba")
    assert not packs(tiny)


def test_a_common_beginning_stands_once_in_rows_of_bounded_width():
    begin = list(range(3, 103))
    samples = [sample(str(n), [*begin, 200 + n, 7], [9] * 20) for n in range(5)]
    batch = collate(samples, 0, together=192)
    assert batch.shared == 100
    assert batch.input_ids.shape[1] <= 192
    assert len(batch.input_ids) == 2
    assert batch.tokens == 2 * 100 + 5 * 22
    for row, column, target in zip(batch.rows, batch.columns, batch.targets, strict=True):
        assert target == 9
        assert batch.positions[row, column] >= 101
    assert collate(samples[:1], 0, together=192).shared == 0
    few = [sample(str(n), [3, 4, 5, 200 + n, 7], [9, 9]) for n in range(5)]
    assert collate(few, 0, together=192).shared == 0
