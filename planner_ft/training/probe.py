"""The check on the loaded model: does every adapter weight learn, and is our loss the model's own?

A new LoRA adapter has B = 0, so that the gradient of A is zero whatever is wrong, and A is checked
in a second step with small random numbers in B. B is checked in the first: then gradients reach it
through the frozen weights alone, and a layer that passes none on (as 4-bit layers that a CPU has
packed) is not hidden by the path through other adapters. A validation pass goes first, since one is
what packs them. Afterwards weights, gradients and random state are as before.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import torch
from torch import Tensor

from planner_ft.training.batches import Batch, collate
from planner_ft.training.model import (
    adapter_parameters,
    adapter_tensors,
    autocast,
    evaluating,
    loss_sum,
    set_adapter,
)

if TYPE_CHECKING:
    from planner_ft.training.samples import Sample

LOSS_TOLERANCE = 0.02
"""Relative difference between our loss and the model's own that rounding in 16 bits explains."""
B_DEVIATION = 0.02


def probe_model(
    model: Any, samples: Sequence[Sample], pad: int, batch_size: int, device: Any, dtype: Any
) -> list[str]:
    """Everything wrong with the model for training, which is left as it was. The gradient step runs
    on the `batch_size` longest samples, so that it also shows whether training fits the memory.
    """
    by_length = sorted(samples, key=lambda sample: sample.length)
    longest = collate(by_length[-batch_size:], pad).to(device)
    saved = adapter_tensors(model)
    model.train()
    try:
        with torch.random.fork_rng():
            problems = _loss_problems(model, by_length[0], pad, device, dtype)
            base = [name for name in saved if "lora_" not in name]
            if base:
                count = f"{len(base)} weights of the base model"
                problems.append(f"{count} would be trained (first: {base[0]})")
            gradients = _gradients(model, longest, dtype)
            generator = torch.Generator().manual_seed(0)
            with torch.no_grad():
                for name, value in adapter_parameters(model).items():
                    if "lora_B" in name:
                        value.copy_(torch.randn(value.shape, generator=generator) * B_DEVIATION)
            second = _gradients(model, longest, dtype)
            gradients |= {name: value for name, value in second.items() if "lora_A" in name}
            return problems + _gradient_problems(gradients)
    finally:
        set_adapter(model, saved)
        model.zero_grad(set_to_none=True)


def _loss_problems(
    model: Any, sample: Sample, pad: int, device: torch.device, dtype: torch.dtype
) -> list[str]:
    """Compare with the model's own loss: an architecture may change logits behind the output."""
    batch = collate([sample], pad).to(device)
    ids = torch.tensor([sample.rendered.input_ids], device=device)
    mask = torch.tensor([sample.rendered.completion_mask], device=device)
    with evaluating(model), autocast(device, dtype):
        ours = float(loss_sum(model, batch, dtype)) / len(batch.targets)
        labels = ids.masked_fill(mask == 0, -100)
        theirs = float(model(input_ids=ids, labels=labels, use_cache=False).loss)
    if not math.isfinite(ours):
        broken = "the base model's weights are broken, or its dtype overflows"
        return [f"the loss of sample {sample.id} is {ours} before any training: {broken}"]
    if abs(ours - theirs) > LOSS_TOLERANCE * max(1.0, abs(theirs)):
        other = f"{ours:.4f} where the model itself computes {theirs:.4f}"
        return [f"the loss of sample {sample.id} is {other}: this architecture is not supported"]
    return []


def _gradients(model: Any, batch: Batch, dtype: torch.dtype) -> dict[str, Tensor | None]:
    """The gradient of every adapter weight."""
    model.zero_grad(set_to_none=True)
    torch.autograd.backward(loss_sum(model, batch, dtype) / len(batch.targets))
    return {name: value.grad for name, value in adapter_parameters(model).items()}


def _gradient_problems(gradients: dict[str, Tensor | None]) -> list[str]:
    """Sentences on matrices without a gradient, and on those with one that is not finite."""
    without = [name for name, value in gradients.items() if value is None or not value.any()]
    infinite = [
        name
        for name, value in gradients.items()
        if value is not None and not value.isfinite().all()
    ]
    texts = {
        "get no gradient (first: {}); they would stay as they are": without,
        "get a gradient that is not finite (first: {})": infinite,
    }
    return [
        f"{len(names)} of {len(gradients)} adapter matrices {text.format(names[0])}"
        for text, names in texts.items()
        if names
    ]
