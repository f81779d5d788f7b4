"""Training through 4-bit weights.

The candidate runs with its layers' matrices in NF4. In a stage that is trained through the
rounding, the forward pass sees what NF4 leaves of them, and the optimiser moves the weights behind
(the straight-through estimator of Bengio et al., arXiv:1308.3432).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager

import torch
from torch import Tensor

BLOCK = 64
"""Weights that share a scale, as transformers' NF4 configuration has it."""


def nf4(weights: Tensor) -> Tensor:
    """What a round trip through NF4, with double quantisation, makes of a matrix stored in
    bfloat16; same shape and dtype.
    """
    from bitsandbytes.functional import dequantize_4bit, quantize_4bit

    packed, state = quantize_4bit(
        weights.detach().to(torch.bfloat16).contiguous(),
        blocksize=BLOCK,
        compress_statistics=True,
        quant_type="nf4",
    )
    values: Tensor = dequantize_4bit(packed, state)
    return values.to(weights.dtype).view_as(weights)


@contextmanager
def rounded(matrices: Sequence[Tensor]) -> Iterator[None]:
    """Within, the matrices hold their NF4 values; afterwards their own again, with the gradients
    that were found meanwhile.
    """
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
