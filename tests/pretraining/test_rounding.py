"""Training through 4-bit weights."""

from pathlib import Path
from typing import Any

import pytest
import torch
from torch import nn

from planner_ft.pretraining.loop import PretrainSettings, layer_matrices, new_model, pretrain
from planner_ft.pretraining.model import nf4, rounded

TINY = PretrainSettings(
    hidden=64,
    layers=1,
    heads=2,
    feed_forward=128,
    batch_tokens=2048,
    tokens=6000,
    compile=False,
    four_bit=True,
)
SPECIAL = {"bos": 1, "eos": 2, "pad": 0}


def test_the_round_trip_is_the_one_of_the_loader() -> None:
    from bitsandbytes.nn import Linear4bit, Params4bit

    torch.manual_seed(0)
    plain = nn.Linear(128, 64, bias=False).to(torch.bfloat16)
    layer = Linear4bit(
        128,
        64,
        bias=False,
        compute_dtype=torch.bfloat16,
        quant_type="nf4",
        compress_statistics=True,
    )
    layer.weight = Params4bit(
        plain.weight.detach().clone(),
        requires_grad=False,
        quant_type="nf4",
        compress_statistics=True,
    )
    layer.to("cpu")
    values = torch.randn(5, 128, dtype=torch.bfloat16)
    assert torch.allclose(layer(values).float(), (values @ nf4(plain.weight).T).float(), atol=0.02)
    assert not torch.equal(nf4(plain.weight), plain.weight)
    assert nf4(plain.weight.float()).dtype == torch.float32


def test_the_weights_come_back_and_the_gradients_are_those_of_the_rounded_ones() -> None:
    torch.manual_seed(0)
    layer = nn.Linear(64, 32, bias=False)
    before, values = layer.weight.detach().clone(), torch.randn(4, 64)
    with rounded([layer.weight]):
        assert torch.equal(layer.weight, nf4(before))
        torch.autograd.backward(layer(values).square().sum())
    assert torch.equal(layer.weight, before)
    assert layer.weight.grad is not None
    assert torch.allclose(layer.weight.grad, 2 * (values @ nf4(before).T).T @ values, atol=1e-4)


def test_the_weights_come_back_after_an_error() -> None:
    weights = torch.randn(64, 64)
    before = weights.clone()
    with pytest.raises(ValueError, match="no loss"), rounded([weights]):
        raise ValueError("no loss")
    assert torch.equal(weights, before)


def test_a_stage_learns_through_the_rounding(shard: Path, tokenizer: Any, tmp_path: Path) -> None:
    model: Any = new_model(TINY, len(tokenizer), SPECIAL)
    assert {
        name.split(".")[-2]
        for name, value in model.named_parameters()
        if any(value is matrix for matrix in layer_matrices(model))
    } == {*("q_proj", "k_proj", "v_proj", "o_proj", "gate_proj", "up_proj", "down_proj")}
    first = [value.detach().clone() for value in layer_matrices(model)]
    result = pretrain(model, [shard], TINY, folder=tmp_path)
    assert result["settings"]["four_bit"] is True
    assert all(
        not torch.equal(value, old) and not torch.equal(value, nf4(value))
        for value, old in zip(layer_matrices(model), first, strict=True)
    )
