"""The state of the random number generators that training draws from: Python, torch, CUDA."""

from __future__ import annotations

import random
from typing import Any

import torch
from torch import Tensor


def rng_state() -> dict[str, Any]:
    """All generator states: `python` as nested lists (JSON), `torch` and `cuda:N` as byte
    tensors.
    """
    version, values, gauss = random.getstate()
    tensors: dict[str, Tensor] = {"torch": torch.get_rng_state()}
    if torch.cuda.is_available():
        tensors |= {
            f"cuda:{index}": state for index, state in enumerate(torch.cuda.get_rng_state_all())
        }
    return {"python": [version, list(values), gauss], "tensors": tensors}


def restore_rng(state: dict[str, Any]) -> None:
    """Set the generators to a state from `rng_state`. States of CUDA devices that are not here are
    passed over.
    """
    version, values, gauss = state["python"]
    random.setstate((version, tuple(values), gauss))
    for name, tensor in state["tensors"].items():
        if name == "torch":
            torch.set_rng_state(tensor)
        elif torch.cuda.is_available() and int(name.split(":")[1]) < torch.cuda.device_count():
            torch.cuda.set_rng_state(tensor, int(name.split(":")[1]))


def seed_everything(seed: int) -> None:
    """Seed all generators."""
    random.seed(seed)
    torch.manual_seed(seed)
