"""Small random models in float32, decoded in both ways."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest
import torch

from planner_ft.decoding.forward import SmallModel, small_model
from planner_ft.decoding.passes import Decoder, ModelDecoder


def llama(**changes: Any) -> Any:
    """A Llama of 64 tokens, of which 2 ends an answer. Wide initial weights, so that the most
    probable token changes from step to step.
    """
    from transformers import LlamaConfig, LlamaForCausalLM

    torch.manual_seed(0)
    sizes = {
        "vocab_size": 64,
        "hidden_size": 32,
        "intermediate_size": 64,
        "num_hidden_layers": 2,
        "num_attention_heads": 4,
        "num_key_value_heads": 2,
        "max_position_embeddings": 512,
        "initializer_range": 0.5,
        "bos_token_id": 1,
        "eos_token_id": 2,
        "pad_token_id": 0,
    }
    return LlamaForCausalLM(LlamaConfig(**{**sizes, **changes})).eval()


def small(model: Any) -> SmallModel:
    """A model of transformers as `forward` computes it."""
    found = small_model(model.config.to_dict(), model.state_dict())
    assert found is not None
    return found


@pytest.fixture(scope="session")
def make_llama() -> Callable[..., Any]:
    """Builds the model with other settings."""
    return llama


@pytest.fixture(scope="session")
def toy_model() -> Any:
    return llama()


@pytest.fixture(params=["transformers", "small"])
def decoder(request: pytest.FixtureRequest, toy_model: Any) -> Decoder:
    """The same model, as transformers computes it and as `forward` does."""
    return small(toy_model) if request.param == "small" else ModelDecoder(toy_model)
