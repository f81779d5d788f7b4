"""Memory estimates agree with what loaded models and a training step take."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
import torch

from planner_ft.candidates import all_candidates, resolve_candidate
from planner_ft.candidates.costs import (
    GIB,
    adapter_parameters,
    block_activations,
    inference_memory,
    stored_weights,
    training_memory,
)
from planner_ft.candidates.loading import load_model

PUBLISHED = [candidate for candidate in all_candidates() if candidate.published]


@pytest.mark.parametrize("name", ["Llama-3.2-3B", "Qwen2.5-3B-Instruct", "Llama-3.1-8B"])
def test_parameters_and_stored_bytes_are_those_of_the_loaded_model(models: Path, name: str) -> None:
    candidate = resolve_candidate(name)
    assert candidate.dimensions is not None
    dense = load_model(candidate, device="cpu", quantization="none")
    assert candidate.parameters == sum(parameter.numel() for parameter in dense.parameters())
    packed = load_model(candidate, device="cpu")
    stored = sum(
        parameter.numel() * (1 if parameter.dtype == torch.uint8 else 2)
        for parameter in packed.parameters()
    )
    assert stored_weights(candidate.dimensions, "none") == 2 * candidate.parameters
    constants = candidate.dimensions.linear_parameters * (8 / 64 + 32 / (64 * 256)) / 8
    assert stored_weights(candidate.dimensions) == pytest.approx(stored + constants, abs=1)


def saved_bytes_per_token(model: Any, tokens: int) -> float:
    """Bytes that autograd keeps for the backward pass, without parameters and each storage once."""
    parameters = {parameter.untyped_storage().data_ptr() for parameter in model.parameters()}
    seen: dict[int, int] = {}
    kept = []

    def keep(tensor: torch.Tensor) -> torch.Tensor:
        if tensor.untyped_storage().data_ptr() not in parameters:
            seen[tensor.untyped_storage().data_ptr()] = tensor.untyped_storage().nbytes()
        kept.append(tensor)
        return tensor

    ids = torch.randint(0, 500, (1, tokens), generator=torch.Generator().manual_seed(0))
    with torch.autograd.graph.saved_tensors_hooks(keep, lambda tensor: tensor):
        model(input_ids=ids, labels=ids)
    return sum(seen.values()) / tokens


@pytest.mark.parametrize("name", ["Llama-3.2-3B", "Qwen2.5-3B"])
def test_a_blocks_activations_are_what_autograd_keeps(models: Path, name: str) -> None:
    from peft import LoraConfig, get_peft_model

    candidate = resolve_candidate(name)
    assert candidate.dimensions is not None
    model = load_model(candidate, device="cpu", trainable=True)
    adapted = get_peft_model(
        model, LoraConfig(r=8, target_modules="all-linear", task_type="CAUSAL_LM")
    ).train()
    assert adapter_parameters(candidate.dimensions, 8) == sum(
        parameter.numel() for parameter in adapted.parameters() if parameter.requires_grad
    )
    both = saved_bytes_per_token(adapted, 96)
    del model.model.layers[1]
    one = saved_bytes_per_token(adapted, 96)
    if next(model.parameters()).dtype == torch.bfloat16:
        assert both - one == pytest.approx(block_activations(candidate.dimensions, 8), rel=0.05)


def test_the_published_choices_fit_the_published_hardware() -> None:
    """Llama-3.2-1B-Instruct and 3B-Instruct were trained on 12 GB and run on 6 GB."""
    for candidate in PUBLISHED:
        if candidate.name in ("Llama-3.2-1B-Instruct", "Llama-3.2-3B-Instruct"):
            assert candidate.dimensions is not None
            assert training_memory(candidate.dimensions).fits(12)
            assert inference_memory(candidate.dimensions).fits(6)


def test_memory_grows_with_what_takes_it() -> None:
    dimensions = PUBLISHED[2].dimensions
    assert dimensions is not None
    base = training_memory(dimensions)
    assert (
        training_memory(dimensions, checkpointing=True).total
        < base.total
        < training_memory(dimensions, tokens=2048).total
    )
    assert training_memory(dimensions, dropout=True).activations > base.activations
    assert training_memory(dimensions, quantization="none").weights == 2 * dimensions.parameters
    assert base.fits(base.total / GIB)
    assert not base.fits(base.total / GIB - 0.01)
    batch = inference_memory(dimensions, batch=8)
    assert batch.cache == 8 * inference_memory(dimensions).cache == 8 * 2048 * 114_688, (
        "Llama-3.2-3B: 112 KiB a token"
    )
