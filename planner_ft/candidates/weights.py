"""The weights of small models as the libraries compute them, read straight from the files: rounded
to 4 bits as bitsandbytes stores them, adapters merged as PEFT does it.
"""

from __future__ import annotations

import functools
from collections.abc import Mapping
from pathlib import Path

import torch
from safetensors.torch import load_file
from torch import Tensor
from torch.nn.functional import pad

from planner_ft.candidates.adapters import CONFIG, WEIGHTS
from planner_ft.candidates.loading import compute_dtype
from planner_ft.candidates.location import read_config, weight_files
from planner_ft.candidates.registry import Quantization

LAYER = "_proj.weight"
LORA = ("base_model.model.", ".lora_A.weight", ".lora_B.weight")
PLAIN_LORA = {
    *("auto_mapping", "base_model_name_or_path", "bias", "inference_mode", "init_lora_weights"),
    *("lora_alpha", "lora_dropout", "megatron_core", "peft_type", "peft_version"),
    *("qalora_group_size", "r", "revision", "target_modules", "task_type"),
}
"""Settings of an adapter that are read here or do not change how it is applied. An adapter with any
other one set is not plain LoRA.
"""
NF4_BLOCK, SCALE_BLOCK = 64, 256
NEGATIVE = (
    "-1 -0.6961928009986877 -0.5250730514526367 -0.39491748809814453 -0.28444138169288635"
    " -0.18477343022823334 -0.09105003625154495 0"
)
POSITIVE = (
    "0.07958029955625534 0.16093020141124725 0.24611230194568634 0.33791524171829224"
    " 0.44070982933044434 0.5626170039176941 0.7229568362236023 1"
)
LEVELS = tuple(map(float, f"{NEGATIVE} {POSITIVE}".split()))
"""The sixteen values of NormalFloat: quantiles of the normal distribution, scaled to [-1, 1]."""
HALF_TABLE = (2**16 - 1) / 2
TINY = 1e-38
"""In place of the scale of a block of zeros."""


def read_weights(folder: Path, quantization: Quantization) -> dict[str, Tensor]:
    """The tensors of a folder by name, in the dtype that the CPU computes in; with "nf4" those of
    the layers rounded.
    """
    dtype = compute_dtype(torch.device("cpu"))
    tensors = {
        name: tensor.to(dtype)
        for path in weight_files(folder)
        for name, tensor in load_file(path).items()
    }
    layers = [name for name in tensors if name.endswith(LAYER) and quantization == "nf4"]
    return tensors | {name: rounded_to_nf4(tensors[name]) for name in layers}


def merge_adapter(tensors: Mapping[str, Tensor], folder: Path) -> dict[str, Tensor] | None:
    """The tensors with an adapter's matrices added; None where it is more than two a layer."""
    config, matrices = read_config(folder, CONFIG), load_file(folder / WEIGHTS)
    prefix, down, up = LORA
    names = {one: prefix + one.removesuffix(".weight") for one in tensors if one.endswith(LAYER)}
    used = {layer: name for layer, name in names.items() if name + down in matrices}
    # An initialisation with a name (PiSSA, LoftQ ...) changes the base, too.
    plain = config.get("bias") == "none" and isinstance(config.get("init_lora_weights", True), bool)
    others = any(value and name not in PLAIN_LORA for name, value in config.items())
    if (
        not plain
        or others
        or set(matrices) != {one + end for one in used.values() for end in LORA[1:]}
    ):
        return None
    scaling, merged = config["lora_alpha"] / config["r"], dict(tensors)
    for layer, name in used.items():
        added = scaling * (matrices[name + up].float() @ matrices[name + down].float())
        merged[layer] = (tensors[layer].float() + added).to(tensors[layer].dtype)
    return merged


def rounded_to_nf4(weight: Tensor) -> Tensor:
    """A weight as bitsandbytes unpacks it on a CPU after 4-bit storage with double quantisation:
    blocks of 64 weights share a scale, and the scales are 8-bit floats, blocks of 256 with a scale
    of their own (Dettmers et al. 2023; 8-bit floats, Dettmers 2016).
    """
    flat = weight.float().flatten()
    blocks = pad(flat, (0, -len(flat) % NF4_BLOCK)).view(-1, NF4_BLOCK)
    scales = blocks.abs().amax(1)
    scaled = (blocks * (1.0 / scales.clamp(min=TINY))[:, None]).clamp(-1, 1)
    levels = torch.tensor(LEVELS)
    places = torch.zeros(scaled.shape, dtype=torch.uint8)
    for middle in (levels[:-1] + levels[1:]) / 2:  # Several times as fast as torch.bucketize.
        places += scaled > middle
    rounded = levels[places.int()] * _rounded_scales(scales)[:, None]
    return rounded.flatten()[: len(flat)].to(weight.dtype).view(weight.shape)


def _rounded_scales(scales: Tensor) -> Tensor:
    """The scales as they are read back: mean + 8-bit value times the largest of its block."""
    mean = scales.mean()
    shifted = pad(scales - mean, (0, -len(scales) % SCALE_BLOCK)).view(-1, SCALE_BLOCK)
    largest = shifted.abs().amax(1, keepdim=True)
    # The CPU kernel looks values up in a table of 2**16 steps from -1 to 1.
    steps = (shifted * (1.0 / largest.clamp(min=TINY)) + 1) * HALF_TABLE + 0.5
    known = dynamic_values()
    nearest = torch.bucketize(steps.floor() / HALF_TABLE - 1, (known[:-1] + known[1:]) / 2)
    return (known[nearest] * largest).flatten()[: len(scales)] + mean


@functools.cache
def dynamic_values() -> Tensor:
    """The 256 values of the signed dynamic 8-bit type: seven decades, each with twice the steps of
    the one below, zero and one.
    """
    positive = []
    for decade in range(7):
        bounds = torch.linspace(0.1, 1, 2**decade + 1)
        positive.append(10.0 ** (decade - 6) * ((bounds[:-1] + bounds[1:]) / 2.0))
    values = torch.cat(positive)
    return torch.cat([-values, values, torch.tensor([0.0, 1.0])]).sort().values
