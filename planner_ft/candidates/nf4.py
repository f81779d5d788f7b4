"""What a weight is after 4-bit storage, computed without bitsandbytes.

Importing bitsandbytes and its first call pull in torch's compiler: two seconds in which a small
model could have planned. The numbers here are those that bitsandbytes computes on a CPU for NF4
with double quantisation (a test compares them bit by bit): blocks of 64 weights share a scale, and
the scales themselves are kept as 8-bit floats of a dynamic kind, blocks of 256 of them with a scale
of their own (QLoRA, Dettmers et al. 2023; 8-bit approximations, Dettmers 2016).
"""

from __future__ import annotations

import functools
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from torch import Tensor

BLOCK, SCALE_BLOCK = 64, 256
LEVELS = (
    -1.0,
    -0.6961928009986877,
    -0.5250730514526367,
    -0.39491748809814453,
    -0.28444138169288635,
    -0.18477343022823334,
    -0.09105003625154495,
    0.0,
    0.07958029955625534,
    0.16093020141124725,
    0.24611230194568634,
    0.33791524171829224,
    0.44070982933044434,
    0.5626170039176941,
    0.7229568362236023,
    1.0,
)
"""The sixteen values of NormalFloat: quantiles of the normal distribution, scaled to [-1, 1]."""
HALF_TABLE = (2**16 - 1) / 2
TINY = 1e-38
"""In place of the scale of a block of zeros."""


def rounded_to_nf4(weight: Tensor) -> Tensor:
    """The weight, of any shape and dtype, as it is unpacked after 4-bit storage. Its size must be a
    multiple of 64.
    """
    import torch

    blocks = weight.float().reshape(-1, BLOCK)
    scales = blocks.abs().amax(1)
    levels = torch.tensor(LEVELS)
    nearest = torch.bucketize(
        (blocks * (1.0 / scales.clamp(min=TINY))[:, None]).clamp(-1, 1),
        (levels[:-1] + levels[1:]) / 2,
    )
    return (
        (levels[nearest] * _rounded_scales(scales)[:, None]).to(weight.dtype).reshape(weight.shape)
    )


def _rounded_scales(scales: Tensor) -> Tensor:
    """The scales as they are read back: mean + 8-bit value times the largest of its block."""
    import torch

    mean = scales.mean()
    shifted = torch.nn.functional.pad(scales - mean, (0, -len(scales) % SCALE_BLOCK)).reshape(
        -1, SCALE_BLOCK
    )
    largest = shifted.abs().amax(1, keepdim=True)
    values = dynamic_values()
    # The CPU kernel looks values up in a table of 2**16 steps from -1 to 1.
    wanted = (
        (shifted * (1.0 / largest.clamp(min=TINY)) + 1) * HALF_TABLE + 0.5
    ).floor() / HALF_TABLE - 1
    nearest = torch.bucketize(wanted, (values[:-1] + values[1:]) / 2)
    return (values[nearest] * largest).reshape(-1)[: len(scales)] + mean


@functools.cache
def dynamic_values() -> Tensor:
    """The 256 values of the signed dynamic 8-bit type, ascending: seven decades, each with twice
    the steps of the one below, zero and one.
    """
    import torch

    positive = []
    for decade in range(7):
        bounds = torch.linspace(0.1, 1, 2**decade + 1)
        positive.append(10.0 ** (decade - 6) * ((bounds[:-1] + bounds[1:]) / 2.0))
    values = torch.cat(positive)
    return torch.cat([-values, values, torch.tensor([0.0, 1.0])]).sort().values
