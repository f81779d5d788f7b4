"""Weights as they compute: 4-bit layers unpacked, an adapter folded in.

Unpacking a small model once costs little memory and saves the unpacking at every token; folding
saves the adapter's two multiplications per layer. The numbers are those of the layers, up to
rounding: unpacking is exact, and base + adapter is added up in float32 before it is rounded to the
compute dtype.
"""

from __future__ import annotations

from typing import Any

import torch
from torch import Tensor

from planner_ft.candidates.packing import is_packed
from planner_ft.vocabulary.plans import Level


class NotDense(Exception):
    """A layer's weights cannot be had as one matrix."""


def dense_weight(layer: Any, adapter: Level | None) -> tuple[Tensor, Tensor | None]:
    """Weight (outputs, inputs) and bias of a linear layer, with an adapter folded in or, with None,
    exactly the base's.

    Raises NotDense for a layer that is no plain, 4-bit or LoRA layer, and for one that is packed
    for decoding already (unpacking that is not exact).
    """
    base = getattr(layer, "base_layer", layer)
    weight = _unpacked(base)
    if base is layer or adapter is None or adapter not in layer.lora_A:
        return weight, base.bias
    if getattr(layer, "lora_variant", {}).get(adapter) is not None or layer.lora_bias.get(
        adapter, False
    ):
        raise NotDense(f"{type(layer).__name__} with a variant of LoRA")
    down, up = layer.lora_A[adapter].weight, layer.lora_B[adapter].weight
    return (weight.float() + layer.scaling[adapter] * (up.float() @ down.float())).to(
        weight.dtype
    ), base.bias


def _unpacked(layer: Any) -> Tensor:
    from bitsandbytes.functional import dequantize_4bit
    from bitsandbytes.nn import Linear4bit

    if type(layer) is torch.nn.Linear:
        weight: Tensor = layer.weight.detach()
        return weight
    if not isinstance(layer, Linear4bit) or is_packed(layer):
        raise NotDense(
            f"{type(layer).__name__}, packed for decoding"
            if isinstance(layer, Linear4bit)
            else type(layer).__name__
        )
    unpacked: Tensor = dequantize_4bit(layer.weight.data, layer.weight.quant_state)
    return unpacked
