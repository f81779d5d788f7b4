"""The model in training: deeper models from shallower ones, dropout, layers rounded to 4 bits.

The candidate runs with its layers' matrices in NF4. In a stage that is trained through the
rounding, the forward pass sees what NF4 leaves of them, and the optimiser moves the weights behind
(the straight-through estimator of Bengio et al., arXiv:1308.3432).
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any

import torch
from torch import Tensor

LAYER = re.compile(r"(model\.layers\.)(\d+)(\..+)")
OUTPUTS = (".self_attn.o_proj.weight", ".mlp.down_proj.weight")
"""A layer adds to the stream through these matrices: with zeros there it adds nothing."""
BLOCK = 64
"""Weights that share a scale, as transformers' NF4 configuration has it."""


def deepened(weights: dict[str, Tensor], layers: int) -> dict[str, Tensor]:
    """The weights of a Llama with `layers` layers that computes the same as one with fewer.

    The new layers stand evenly among the old ones. Each is a copy of the layer before it whose two
    output matrices are zero, so that it passes its input on until training has changed it (block
    expansion, Wu et al. 2024, arXiv:2401.02415). Raises ValueError if `weights` has more layers.
    """
    own = 1 + max(int(found[2]) for found in map(LAYER.fullmatch, weights) if found)
    if own > layers:
        sizes = f"The weights to start from have {own} layers, the model {layers}"
        raise ValueError(f"{sizes}: a stage may add layers, not take them away.")
    grown = {name: value for name, value in weights.items() if not LAYER.fullmatch(name)}
    sources = [place * own // layers for place in range(layers)]
    for place, source in enumerate(sources):
        added = place > 0 and sources[place - 1] == source
        for name, value in weights.items():
            found = LAYER.fullmatch(name)
            if found and int(found[2]) == source:
                empty = added and name.endswith(OUTPUTS)
                own_value = torch.zeros_like(value) if empty else value.clone()
                grown[f"{found[1]}{place}{found[3]}"] = own_value
    return grown


def add_dropout(model: Any, share: float) -> None:
    """Drop this share of what embeddings, attention and feed-forward layers of a Llama give, in
    training mode: transformers' Llama has no such setting.
    """

    def dropped(module: Any, _given: Any, found: Any) -> Any:
        if isinstance(found, tuple):
            return dropped(module, _given, found[0]), *found[1:]
        return torch.nn.functional.dropout(found, share, module.training)

    for layer in model.model.layers:
        layer.self_attn.register_forward_hook(dropped)
        layer.mlp.register_forward_hook(dropped)
    model.model.embed_tokens.register_forward_hook(dropped)


def nf4(weights: Tensor) -> Tensor:
    """A bfloat16 matrix after a round trip through NF4 with double quantisation."""
    from bitsandbytes.functional import dequantize_4bit, quantize_4bit

    matrix = weights.detach().to(torch.bfloat16).contiguous()
    packed = quantize_4bit(matrix, blocksize=BLOCK, compress_statistics=True, quant_type="nf4")
    values: Tensor = dequantize_4bit(*packed)
    return values.to(weights.dtype).view_as(weights)


@contextmanager
def rounded(matrices: Sequence[Tensor]) -> Iterator[None]:
    """In the block the matrices hold their NF4 values; afterwards their own, with new gradients."""
    with torch.no_grad():
        kept = [matrix.clone() for matrix in matrices]
        for matrix in matrices:
            matrix.copy_(nf4(matrix))
    try:
        yield
    finally:
        with torch.no_grad():
            for matrix, own in zip(matrices, kept, strict=True):
                matrix.copy_(own)
