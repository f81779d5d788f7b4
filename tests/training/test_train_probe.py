"""The check on the loaded model: what it finds, and that it leaves no trace."""

from __future__ import annotations

import pytest
import torch

from planner_ft.training.model import adapter_parameters, validation_loss
from planner_ft.training.preflight import Prepared, run_preflight
from planner_ft.training.run import probe_model, ready_model

FLOAT = torch.bfloat16
CPU = torch.device("cpu")


@pytest.fixture
def prepared(ask):
    request = ask(dropout=0.1)
    result = Prepared()
    problems = [
        problem for finding in run_preflight(request, result) for problem in finding.problems
    ]
    assert problems == []
    return request, result


def probe(model, prepared):
    return probe_model(model, prepared.train.samples, 0, 1, CPU, FLOAT)


def test_a_sound_model_passes_and_is_left_as_it_was(prepared):
    request, found = prepared
    model, finding = ready_model(request, found)
    assert finding.problems == []
    assert finding.text.startswith("all 28 adapter matrices learn")
    before = {name: value.detach().clone() for name, value in model.named_parameters()}
    torch.manual_seed(5)
    expected = torch.rand(3)
    torch.manual_seed(5)
    assert probe(model, found) == []
    assert torch.equal(torch.rand(3), expected)
    assert all(
        torch.equal(value, before[name]) and value.grad is None
        for name, value in model.named_parameters()
    )
    assert all(
        not value.any() for name, value in adapter_parameters(model).items() if "lora_B" in name
    )


def test_an_adapter_that_learns_nothing_is_counted(prepared, monkeypatch):
    request, found = prepared
    model, _ = ready_model(request, found)
    layer = model.get_base_model().model.layers[0].mlp
    forward = layer.forward
    monkeypatch.setattr(layer, "forward", lambda hidden: forward(hidden).detach())
    (problem,) = probe(model, found)
    assert problem.startswith(
        "6 of 28 adapter matrices get no gradient (first: base_model.model.model.layers.0.mlp."
    )


@pytest.mark.filterwarnings("ignore:bitsandbytes")
def test_weights_packed_by_evaluation_are_found(prepared):
    """The failure of bitsandbytes 0.50 on CPUs with AVX512-BF16: its layers pack in the first
    evaluation.
    """
    from planner_ft.candidates.loading import set_packing

    request, found = prepared
    model, _ = ready_model(request, found)
    if set_packing(model, allowed=True) == 0:
        pytest.skip("this processor packs no weights")
    problems = probe(model, found)
    assert any("adapter matrices get no gradient" in problem for problem in problems)


def test_gradients_stay_whole_after_a_validation_pass(prepared):
    from planner_ft.training.batches import collate
    from planner_ft.training.model import loss_sum

    request, found = prepared
    model, _ = ready_model(request, found)
    with torch.no_grad():
        for value in adapter_parameters(model).values():
            value.normal_(std=0.02)
    model.train()
    validation_loss(model, found.validation.samples, 0, CPU, FLOAT)
    assert model.training
    loss_sum(model, collate(found.train.samples[:1], 0), FLOAT).backward()
    assert all(
        value.grad is not None and value.grad.any() for value in adapter_parameters(model).values()
    )


def test_trainable_base_weights_are_found(prepared):
    request, found = prepared
    model, _ = ready_model(request, found)
    next(value for name, value in model.named_parameters() if "norm" in name).requires_grad_(True)
    assert any(
        "weights of the base model would be trained" in problem for problem in probe(model, found)
    )


def test_an_architecture_with_other_logits_is_refused(prepared, monkeypatch):
    request, found = prepared
    model, _ = ready_model(request, found)
    base = model.get_base_model()
    forward = base.forward

    def capped(*args, **kwargs):
        result = forward(*args, **kwargs)
        result.loss = result.loss * 0.5
        return result

    monkeypatch.setattr(base, "forward", capped)
    assert any("this architecture is not supported" in problem for problem in probe(model, found))


def test_broken_base_weights_are_named(prepared):
    request, found = prepared
    model, _ = ready_model(request, found)
    with torch.no_grad():
        model.get_base_model().model.norm.weight.fill_(float("nan"))
    assert any("before any training" in problem for problem in probe(model, found))
