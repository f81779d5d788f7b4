"""The lean layers give what PEFT and transformers give, up to rounding."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
import torch

from planner_ft.candidates import resolve_candidate
from planner_ft.candidates.loading import load_model, load_tokenizer
from planner_ft.prompts import render_sample
from planner_ft.training import model as in_training
from planner_ft.training.batches import collate
from planner_ft.training.lean import lean_states
from planner_ft.training.samples import Sample
from planner_ft.training.settings import TrainSettings
from planner_ft.vocabulary import load_vocabulary

DRONE = Path("data/inspection_drone/mission/train.jsonl")


@pytest.fixture(scope="module")
def trained():
    """The embedded candidate with an adapter of small random weights, and its tokenizer."""
    candidate = resolve_candidate("embedded")
    base = load_model(candidate, device="cpu", quantization="none", trainable=True)
    settings = TrainSettings(rank=4, dropout=0.0)
    model = in_training.attach_adapter(base, settings, "embedded")
    generator = torch.Generator().manual_seed(0)
    with torch.no_grad():
        for name, value in in_training.adapter_parameters(model).items():
            if "lora_B" in name:
                value.copy_(torch.randn(value.shape, generator=generator) * 0.02)
    return model, load_tokenizer(candidate)


@pytest.mark.parametrize("packed", [False, True])
def test_loss_and_gradients_are_those_of_peft(trained, curated, monkeypatch, packed: bool) -> None:
    model, tokenizer = trained
    if model.dtype != torch.bfloat16:
        pytest.skip("the lean layers compute in bfloat16, which this CPU does not multiply")
    vocabulary = load_vocabulary()
    samples = [
        Sample(record["id"], render_sample("mission", record, tokenizer, vocabulary))
        for record in curated(3, skip=20)
    ]
    batch = collate(samples, 0, packed=packed)

    def run():
        model.zero_grad()
        loss = in_training.loss_sum(model, batch, torch.bfloat16)
        loss.backward()
        gradients = in_training.adapter_parameters(model).values()
        return float(loss.detach()), torch.cat([value.grad.flatten() for value in gradients])

    assert lean_states(model, batch.input_ids, batch.positions) is not None
    loss, gradient = run()
    monkeypatch.setattr(in_training, "lean_states", lambda *_: None)
    slow_loss, slow_gradient = run()
    assert loss == pytest.approx(slow_loss, rel=0.02)
    alike = torch.nn.functional.cosine_similarity(gradient, slow_gradient, dim=0)
    assert float(alike) > 0.99
    assert float(gradient.norm() / slow_gradient.norm()) == pytest.approx(1, rel=0.03)


def test_samples_of_one_row_do_not_see_each_other(trained) -> None:
    model, _tokenizer = trained
    if model.dtype != torch.bfloat16:
        pytest.skip("the lean layers compute in bfloat16, which this CPU does not multiply")
    ids = torch.tensor([[5, 6, 7, 8, 9, 10]])
    places = torch.tensor([[0, 1, 2, 0, 1, 2]])
    other = torch.tensor([[11, 12, 13, 8, 9, 10]])
    with torch.no_grad(), torch.autocast("cpu", dtype=torch.bfloat16):
        one, two = (lean_states(model, rows, places) for rows in (ids, other))
    assert torch.equal(one[:, 3:], two[:, 3:])
    assert not torch.equal(one[:, :3], two[:, :3])


def test_samples_that_begin_alike_share_the_beginning_and_learn_the_same(trained, curated) -> None:
    model, tokenizer = trained
    if model.dtype != torch.bfloat16:
        pytest.skip("the lean layers compute in bfloat16, which this CPU does not multiply")
    drone = load_vocabulary("inspection_drone")
    samples = [
        Sample(record["id"], render_sample(*known, tokenizer, drone, with_vocabulary=True))
        for record in map(json.loads, DRONE.read_text().splitlines()[:4])
        for known in [("mission", record)]
    ]
    apart, together = collate(samples, 0), collate(samples, 0, together=2048)
    assert together.input_ids.shape[0] == 1 and together.shared > 300
    assert together.tokens < apart.tokens / 2
    assert sorted(together.targets.tolist()) == sorted(apart.targets.tolist())
    found = []
    for batch in (apart, together):
        model.zero_grad()
        loss = in_training.loss_sum(model, batch, torch.bfloat16)
        loss.backward()
        values = in_training.adapter_parameters(model).values()
        found.append((float(loss.detach()), torch.cat([one.grad.flatten() for one in values])))
    (loss, gradient), (shared_loss, shared_gradient) = found
    assert shared_loss == pytest.approx(loss, rel=0.01)
    assert float(torch.nn.functional.cosine_similarity(gradient, shared_gradient, dim=0)) > 0.99


def test_dropout_of_the_adapters_input_changes_nothing_on_average(trained, curated) -> None:
    model, tokenizer = trained
    if model.dtype != torch.bfloat16:
        pytest.skip("the lean layers compute in bfloat16, which this CPU does not multiply")
    record = next(iter(curated(1, skip=20)))
    sample = Sample(record["id"], render_sample("mission", record, tokenizer, load_vocabulary()))
    batch = collate([sample], 0)

    def gradient(seed: int) -> torch.Tensor:
        torch.manual_seed(seed)
        model.zero_grad()
        in_training.loss_sum(model, batch, torch.bfloat16).backward()
        values = in_training.adapter_parameters(model).values()
        return torch.cat([value.grad.flatten() for value in values])

    whole = gradient(0)
    layers = [one for one in model.modules() if hasattr(one, "lora_dropout")]
    before = [one.lora_dropout["default"] for one in layers]
    try:
        for one in layers:
            one.lora_dropout["default"] = torch.nn.Dropout(0.2)
        dropped = [gradient(seed) for seed in range(12)]
        assert torch.equal(dropped[0], gradient(0))
        model.eval()
        assert torch.equal(gradient(1), gradient(2))
    finally:
        model.train()
        for one, layer in zip(before, layers, strict=True):
            layer.lora_dropout["default"] = one
    alike = torch.nn.functional.cosine_similarity
    single = float(alike(dropped[0], whole, dim=0))
    mean = torch.stack(dropped).mean(0)
    assert single < 0.97 and float(alike(mean, whole, dim=0)) > (1 + single) / 2
    assert float(mean.norm() / whole.norm()) == pytest.approx(1, rel=0.1)
