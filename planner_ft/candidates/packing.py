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

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from planner_ft.support.errors import PlannerError

if TYPE_CHECKING:
    import torch

PACKING_ROWS = 32
"""The packed layout needs output features in multiples of this (bitsandbytes
`_convert_weight_packed_for_cpu`).
"""


def set_packing(model: torch.nn.Module, *, allowed: bool) -> int:
    """Allow or forbid CPU packing of the model's 4-bit layers; return how many layers may pack.

    Layers whose shape the packed layout cannot hold never pack (bitsandbytes would fail on them).
    Raises PlannerError when packing is to be forbidden and a layer is packed already: load the
    model anew with `trainable=True`.
    """
    allowing = 0
    for name, layer in linear_4bit(model):
        if not allowed and is_packed(layer):
            raise PlannerError(
                f"layer {name} is already packed for decoding and would give wrong gradients; load"
                " the model with trainable=True"
            )
        may_pack = allowed and _has_kernel() and _fits(layer)
        layer.support_avx512bf16_for_cpu = may_pack
        allowing += may_pack
    return allowing


def linear_4bit(model: torch.nn.Module) -> Iterator[tuple[str, Any]]:
    """Name and module of every 4-bit linear layer."""
    from bitsandbytes.nn import Linear4bit

    return (
        (name, module) for name, module in model.named_modules() if isinstance(module, Linear4bit)
    )


def is_packed(layer: Any) -> bool:
    """Whether a 4-bit layer's weights are in the layout without a backward pass."""
    return bool(
        getattr(getattr(layer.weight, "quant_state", None), "packing_format_for_cpu", False)
    )


def _has_kernel() -> bool:
    from bitsandbytes.functional import has_avx512bf16

    return bool(has_avx512bf16())


def _fits(layer: Any) -> bool:
    return bool(
        layer.out_features % PACKING_ROWS == 0
        and layer.in_features % layer.weight.quant_state.blocksize == 0
    )
