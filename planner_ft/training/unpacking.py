"""A base in 4 bits, unpacked once instead of in every pass.

bitsandbytes unpacks the weights of a 4-bit layer for the forward pass and again for the backward
pass. On a CPU, where samples come one by one, that takes as long as multiplying. The unpacked
weights are the very numbers that the layer multiplies with, so what is learned stays the same; they
need four times the memory, which a CPU mostly has.
"""

from __future__ import annotations

from typing import Any

from planner_ft.candidates.packing import linear_4bit

SHARE = 4
"""Weights are unpacked where they fit this often into the free memory."""


def unpack(model: Any) -> int:
    """Replace the model's 4-bit layers by dense ones with the same weights if there is memory for
    it; return how many were.
    """
    import psutil

    layers = list(linear_4bit(model))
    needed = sum(2 * layer.in_features * layer.out_features for _name, layer in layers)
    if SHARE * needed > psutil.virtual_memory().available:
        return 0
    for name, layer in layers:
        parent, _, own = name.rpartition(".")
        setattr(model.get_submodule(parent), own, _dense(layer))
    return len(layers)


def _dense(layer: Any) -> Any:
    """A linear layer with the weights that a 4-bit layer computes with."""
    import torch
    from bitsandbytes.functional import dequantize_4bit

    weight = dequantize_4bit(layer.weight.data, layer.weight.quant_state)
    dense = torch.nn.Linear(
        layer.in_features, layer.out_features, bias=layer.bias is not None, device="meta"
    )
    dense.weight = torch.nn.Parameter(weight, requires_grad=False)
    if layer.bias is not None:
        dense.bias = torch.nn.Parameter(layer.bias.data, requires_grad=False)
    return dense
