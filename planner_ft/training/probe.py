"""The check on the loaded model: does every adapter weight learn, and does our loss equal the model's own?

A new LoRA adapter has B = 0, so that the gradient of A is zero whatever is wrong. The probe therefore puts small random
numbers into B for one step, and takes everything back: weights, gradients and random state are afterwards as before.
A validation pass goes first, since one is what broke training with 4-bit layers on a CPU.
"""

from __future__ import annotations

import contextlib
import math
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

import torch
from torch import nn

from planner_ft.training.batches import Batch, collate
from planner_ft.training.model import adapter_parameters, evaluating, loss_sum
from planner_ft.training.rng import restore_rng, rng_state

if TYPE_CHECKING:
    from planner_ft.training.samples import Sample

LOSS_TOLERANCE = 0.02
"""Relative difference between our loss and the model's own that rounding in 16 bits explains."""
B_DEVIATION = 0.02


def probe_model(model: Any, samples: Sequence[Sample], pad: int, batch_size: int, device: torch.device, dtype: torch.dtype) -> list[str]:
    """Everything wrong with the model for training; empty when it can learn. Leaves the model as it was.

    The gradient step runs on the `batch_size` longest samples, so that it also shows whether training fits the memory.
    """
    by_length = sorted(samples, key=lambda sample: sample.length)
    shortest = collate(by_length[:1], pad).to(device)
    longest = collate(by_length[-batch_size:], pad).to(device)
    with _restored(model):
        model.train()
        problems = _loss_problems(model, by_length[0], shortest, dtype)
        problems += _trainable_problems(model)
        return problems + _gradient_problems(model, longest, dtype)


@contextlib.contextmanager
def _restored(model: Any) -> Iterator[None]:
    """Put random numbers into every lora_B for the block; afterwards weights, gradients and random state are as before."""
    state = rng_state()
    saved = {name: value.detach().clone() for name, value in adapter_parameters(model).items()}
    generator = torch.Generator().manual_seed(0)
    try:
        with torch.no_grad():
            for name, value in adapter_parameters(model).items():
                if "lora_B" in name:
                    value.copy_(torch.randn(value.shape, generator=generator) * B_DEVIATION)
        yield
    finally:
        with torch.no_grad():
            for name, value in adapter_parameters(model).items():
                value.copy_(saved[name])
                value.grad = None
        restore_rng(state)


def _loss_problems(model: Any, sample: Sample, batch: Batch, dtype: torch.dtype) -> list[str]:
    """Compare with the loss that the model computes itself: an architecture may change logits after the output layer."""
    ids = torch.tensor([sample.rendered.input_ids], device=batch.input_ids.device)
    mask = torch.tensor([sample.rendered.completion_mask], device=ids.device)
    with evaluating(model):
        ours = float(loss_sum(model, batch, dtype)) / len(batch.targets)
        with torch.autocast(ids.device.type, dtype=dtype, enabled=dtype != torch.float32):
            theirs = float(model(input_ids=ids, labels=ids.masked_fill(mask == 0, -100), use_cache=False).loss)
    if not math.isfinite(ours):
        return [f"the loss of sample {sample.id} is {ours} before any training: the base model's weights are broken, or its dtype overflows"]
    if abs(ours - theirs) > LOSS_TOLERANCE * max(1.0, abs(theirs)):
        return [f"the loss of sample {sample.id} is {ours:.4f} where the model itself computes {theirs:.4f}: this architecture is not supported"]
    return []


def _trainable_problems(model: Any) -> list[str]:
    foreign = [name for name in adapter_parameters(model) if "lora_" not in name]
    return [f"{len(foreign)} weights of the base model would be trained (first: {foreign[0]})"] if foreign else []


def _gradient_problems(model: Any, batch: Batch, dtype: torch.dtype) -> list[str]:
    torch.autograd.backward(loss_sum(model, batch, dtype) / len(batch.targets))
    parameters = adapter_parameters(model)
    without = [name for name, value in parameters.items() if not _has_gradient(value)]
    infinite = [name for name, value in parameters.items() if value.grad is not None and not bool(torch.isfinite(value.grad).all())]
    problems = []
    if without:
        problems.append(f"{len(without)} of {len(parameters)} adapter matrices get no gradient (first: {without[0]}); they would stay as they are")
    if infinite:
        problems.append(f"{len(infinite)} of {len(parameters)} adapter matrices get a gradient that is not finite (first: {infinite[0]})")
    return problems


def _has_gradient(value: nn.Parameter) -> bool:
    return value.grad is not None and bool(value.grad.any())
