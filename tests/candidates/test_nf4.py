"""4-bit rounding without bitsandbytes gives the numbers that bitsandbytes gives."""

from __future__ import annotations

import pytest
import torch

from planner_ft.candidates.nf4 import dynamic_values, rounded_to_nf4


def weights() -> list[torch.Tensor]:
    """Of all magnitudes and shapes, with a block of zeros, an outlier, and fewer blocks of scales
    than one.
    """
    generator = torch.Generator().manual_seed(0)
    made = [
        torch.randn(64 * (1 + index % 3), 256, generator=generator) * 10.0 ** (index % 7 - 3)
        for index in range(60)
    ]
    made[1][:2] = 0
    made[2][0, 0] = 1000
    return [*made, torch.ones(8, 64), torch.zeros(64, 64)]


@pytest.mark.parametrize("dtype", [torch.float32, torch.bfloat16, torch.float16])
def test_every_number_is_that_of_bitsandbytes(dtype: torch.dtype) -> None:
    from bitsandbytes.functional import dequantize_4bit, quantize_4bit

    for index, weight in enumerate(weights()):
        stored, state = quantize_4bit(weight.to(dtype), quant_type="nf4", compress_statistics=True)
        expected, found = dequantize_4bit(stored, state), rounded_to_nf4(weight.to(dtype))
        assert found.dtype == dtype and found.shape == weight.shape
        assert torch.equal(found, expected), (
            f"weight {index}: {(found != expected).sum()} of {weight.numel()} differ"
        )


def test_the_dynamic_type_is_that_of_bitsandbytes() -> None:
    from bitsandbytes.functional import create_dynamic_map

    assert torch.equal(dynamic_values(), create_dynamic_map())


def test_what_is_rounded_stays_as_it_is() -> None:
    rounded = rounded_to_nf4(torch.randn(64, 64, generator=torch.Generator().manual_seed(1)))
    assert len(rounded.reshape(-1, 64)[0].unique()) <= 16
    # Scales are rounded too, so a second pass may move them, but hardly.
    assert torch.allclose(rounded_to_nf4(rounded), rounded, atol=0.02)
