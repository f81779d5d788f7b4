"""Trying 4-bit layers on a device, rather than believing that they work there."""

from __future__ import annotations

import time
from dataclasses import dataclass
from typing import TYPE_CHECKING

from planner_ft.candidates.libraries import quiet_libraries
from planner_ft.candidates.loading import compute_dtype, resolve_device

if TYPE_CHECKING:
    import torch

SIZE = 256
WEIGHT_ERROR = 0.15
"""NF4 of normal weights is off by 0.09 (relative norm, measured); more means a broken kernel."""
GRADIENT_ERROR = 0.02
"""Against the same layer dequantised; bfloat16 arithmetic accounts for 0.004."""


@dataclass(frozen=True)
class FourBitProbe:
    """Outcome of a 4-bit layer tried on a device. Errors are relative norms; `problem` is None when
    all is well.
    """

    device: str
    dtype: str
    weight_error: float | None = None
    gradient_error: float | None = None
    packs: bool = False
    """Whether layers pack for decoding (AVX512-BF16 CPUs)."""
    seconds: float = 0.0
    problem: str | None = None


def probe_four_bit(device: str = "auto") -> FourBitProbe:
    """Quantise a layer to NF4 with double quantisation, multiply with it and take a gradient
    through it.
    """
    target = resolve_device(device)
    dtype = compute_dtype(target)
    begun = time.perf_counter()
    try:
        quiet_libraries()
        weight_error, gradient_error, packs = _try_layer(target, dtype)
    except Exception as error:  # whatever goes wrong in a native library is the finding
        return FourBitProbe(
            str(target),
            str(dtype).removeprefix("torch."),
            problem=f"{type(error).__name__}: {error}".splitlines()[0][:300],
        )
    problem = None
    if not weight_error < WEIGHT_ERROR or not gradient_error < GRADIENT_ERROR:
        problem = (
            f"wrong results: error {weight_error:.3f} of the product, {gradient_error:.3f} of the"
            " gradient"
        )
    seconds = time.perf_counter() - begun
    return FourBitProbe(
        str(target),
        str(dtype).removeprefix("torch."),
        weight_error,
        gradient_error,
        packs,
        seconds,
        problem,
    )


def _try_layer(device: torch.device, dtype: torch.dtype) -> tuple[float, float, bool]:
    """Relative errors of product and gradient, and whether the layer may pack."""
    import torch
    from bitsandbytes.functional import dequantize_4bit
    from bitsandbytes.nn import Linear4bit

    from planner_ft.candidates.packing import set_packing

    generator = torch.Generator().manual_seed(0)
    weight = torch.randn(SIZE, SIZE, generator=generator) / SIZE**0.5
    layer = Linear4bit(
        SIZE, SIZE, bias=False, compute_dtype=dtype, compress_statistics=True, quant_type="nf4"
    )
    layer.load_state_dict({"weight": weight.to(dtype)})
    layer = layer.to(device)
    packs = set_packing(layer, allowed=True) > 0
    set_packing(layer, allowed=False)
    x = torch.randn(8, SIZE, generator=generator).to(device=device, dtype=dtype).requires_grad_()
    product = layer(x)
    (gradient,) = torch.autograd.grad(product.float().square().sum(), x)
    dense = dequantize_4bit(layer.weight.data, layer.weight.quant_state).to(dtype)
    expected = 2 * product.detach().float() @ dense.float()
    exact = x.detach().float() @ weight.to(device).T
    return _relative(product.detach().float(), exact), _relative(gradient.float(), expected), packs


def _relative(value: torch.Tensor, reference: torch.Tensor) -> float:
    import torch

    return float(torch.linalg.vector_norm(value - reference) / torch.linalg.vector_norm(reference))
