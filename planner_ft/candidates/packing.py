"""The CPU weight packing of bitsandbytes, which training must not meet.

bitsandbytes (0.50, `nn.Linear4bit.forward`) rewrites the weights of a 4-bit layer into a layout for
AVX512-BF16 kernels the first time that the layer runs on a CPU in eval mode on an input that needs
no gradient. The packed kernel has no backward pass: an adapter below such a layer gets a gradient
that lacks the path through the frozen weights, often zero, without an error. Unpacking again is
lossy (the block constants were rounded to bfloat16). So a model that is trained never packs, not
even while it is evaluated.

For decoding, packing is worth having: on one AVX512-BF16 core a 2048 x 8192 layer takes 0.8 ms a
token packed and 17.6 ms unpacked (2.1 ms in bfloat16).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from planner_ft.support.errors import PlannerError

if TYPE_CHECKING:
    import torch

PACKING_ROWS = 32
"""Output features come in multiples of this in bitsandbytes' `_convert_weight_packed_for_cpu`."""


def set_packing(model: torch.nn.Module, *, allowed: bool) -> int:
    """Allow or forbid CPU packing of the model's 4-bit layers; return how many layers may pack.
    Layers whose shape the packed layout cannot hold never pack (bitsandbytes would fail on them).
    Raises PlannerError when packing is to be forbidden and a layer is packed already: load the
    model anew with `trainable=True`.
    """
    from bitsandbytes.functional import has_avx512bf16

    allowing = 0
    for name, layer in linear_4bit(model):
        if not allowed and is_packed(layer):
            why = "is already packed for decoding and would give wrong gradients"
            raise PlannerError(f"layer {name} {why}; load the model with trainable=True")
        whole = allowed and has_avx512bf16() and layer.out_features % PACKING_ROWS == 0
        fits = whole and layer.in_features % layer.weight.quant_state.blocksize == 0
        layer.support_avx512bf16_for_cpu = bool(fits)
        allowing += layer.support_avx512bf16_for_cpu
    return allowing


def linear_4bit(model: torch.nn.Module) -> list[tuple[str, Any]]:
    """Name and module of every 4-bit linear layer."""
    from bitsandbytes.nn import Linear4bit

    named = model.named_modules()
    return [(name, module) for name, module in named if isinstance(module, Linear4bit)]


def is_packed(layer: Any) -> bool:
    """Whether a 4-bit layer's weights are in the layout without a backward pass."""
    state = getattr(layer.weight, "quant_state", None)
    return bool(getattr(state, "packing_format_for_cpu", False))
