"""A deeper model that begins as the shallower one: for stages of pretraining whose model has
outgrown its layers.
"""

from __future__ import annotations

import re

import torch
from torch import Tensor

LAYER = re.compile(r"(model\.layers\.)(\d+)(\..+)")
OUTPUTS = (".self_attn.o_proj.weight", ".mlp.down_proj.weight")
"""What a layer adds to the stream goes through these matrices: with zeros there it adds nothing."""


def deepened(weights: dict[str, Tensor], layers: int) -> dict[str, Tensor]:
    """The weights of a Llama with `layers` layers that computes what the one with fewer layers
    computed.

    The new layers stand evenly among the old ones. Each is a copy of the layer before it whose two
    output matrices are zero, so that it passes its input on until training has changed it (block
    expansion, Wu et al. 2024, arXiv:2401.02415).

    Raises ValueError if `weights` has more layers than that.
    """
    own = 1 + max(int(found[2]) for found in map(LAYER.fullmatch, weights) if found)
    if own > layers:
        raise ValueError(
            f"The weights to start from have {own} layers, the model {layers}: a stage may add"
            " layers, not take them away."
        )
    grown = {name: value for name, value in weights.items() if not LAYER.fullmatch(name)}
    sources = [place * own // layers for place in range(layers)]
    for place, source in enumerate(sources):
        added = place > 0 and sources[place - 1] == source
        for name, value in weights.items():
            found = LAYER.fullmatch(name)
            if found and int(found[2]) == source:
                empty = added and name.endswith(OUTPUTS)
                grown[f"{found[1]}{place}{found[3]}"] = (
                    torch.zeros_like(value) if empty else value.clone()
                )
    return grown
