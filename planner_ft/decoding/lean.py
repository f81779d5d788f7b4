"""A lean forward pass for small models on a CPU.

A model of a few million weights spends most of a token's time between the multiplications: in
wrappers, masks and hundreds of small operations. This decoder computes what transformers' Llama and
Qwen2 compute, on dense weights (see `dense`), with the fewest operations: queries, keys and values
in one multiplication, gate and up in another. Norms, rotary positions, attention and the sums
between layers are computed in float32, the multiplications in the model's dtype.

Attention runs over queries and keys in blocks of a fixed size. So a position's logits do not depend
on how many positions share its pass or on the other rows of the batch, even in bfloat16 where the
CPU multiplies it (oneDNN's kernels give a row the same numbers whatever rows stand beside it):
drafting, fast-forward and batches then change not one bit.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import torch
from torch import Tensor
from torch.nn.functional import rms_norm

from planner_ft.decoding.dense import NotDense, dense_weight
from planner_ft.decoding.lean_passes import LeanPasses
from planner_ft.vocabulary.plans import Level

MODEL_TYPES = ("llama", "qwen2")
ROPE_TYPES = ("default", "linear", "llama3")
"""Rotary positions that do not depend on the length of the text."""


@dataclass(frozen=True)
class Layer:
    """Weights of one layer: rows of `qkv` are query, key and value heads, those of `gate_up` the
    two halves of the feed-forward part.
    """

    norm: Tensor
    qkv: Tensor
    qkv_bias: Tensor | None
    out: Tensor
    out_bias: Tensor | None
    feed_norm: Tensor
    gate_up: Tensor
    gate_up_bias: Tensor | None
    down: Tensor
    down_bias: Tensor | None


@dataclass(frozen=True)
class LeanDecoder:
    """A small Llama or Qwen2 model with at most one adapter folded in."""

    layers: tuple[Layer, ...]
    embeddings: Tensor
    norm: Tensor
    head: Tensor
    rotary: Any
    heads: int
    key_heads: int
    head_size: int
    epsilon: float
    context: int | None

    @classmethod
    def of(cls, model: Any, adapter: Level | None = None) -> LeanDecoder | None:
        """The lean form of a model of transformers, as it is without an adapter or with one of
        those that it holds; None where there is no such form.
        """
        base = model.get_base_model() if hasattr(model, "get_base_model") else model
        config = base.config
        if not _is_plain(config):
            return None
        try:
            layers = tuple(_layer(layer, adapter) for layer in base.model.layers)
            head, bias = dense_weight(base.lm_head, adapter)
        except NotDense:
            return None
        if bias is not None or type(base.model.embed_tokens) is not torch.nn.Embedding:
            return None
        return cls(
            layers,
            base.model.embed_tokens.weight.detach(),
            base.model.norm.weight.float(),
            head,
            base.model.rotary_emb,
            config.num_attention_heads,
            config.num_key_value_heads,
            layers[0].out.shape[1] // config.num_attention_heads,
            config.rms_norm_eps,
            config.max_position_embeddings,
        )

    def start(self, rows: int) -> LeanPasses:
        return LeanPasses(self, rows)

    def normalised(self, states: Tensor, weight: Tensor) -> Tensor:
        """Normalised states in the dtype of the multiplications."""
        return rms_norm(states, weight.shape, weight, self.epsilon).to(self.head.dtype)

    def angles(self, positions: int) -> tuple[Tensor, Tensor]:
        """Cosine and sine of the rotary positions, (positions, 1, head size); the first half of the
        sine is negative, as rotation by `roll` wants it.
        """
        cosine, sine = self.rotary(self.norm, torch.arange(positions)[None])
        sine[..., : self.head_size // 2] *= -1
        return cosine[0, :, None], sine[0, :, None]


def _is_plain(config: Any) -> bool:
    """Whether a configuration asks for nothing that this module does not compute."""
    rope = (getattr(config, "rope_parameters", None) or {}).get("rope_type", "default")
    full = all(kind == "full_attention" for kind in getattr(config, "layer_types", None) or ())
    return (
        config.model_type in MODEL_TYPES
        and config.hidden_act == "silu"
        and rope in ROPE_TYPES
        and full
        and not getattr(config, "use_sliding_window", False)
    )


def _layer(layer: Any, adapter: Level | None) -> Layer:
    attention, feed = layer.self_attn, layer.mlp
    qkv, qkv_bias = _joined([attention.q_proj, attention.k_proj, attention.v_proj], adapter)
    gate_up, gate_up_bias = _joined([feed.gate_proj, feed.up_proj], adapter)
    out, down = dense_weight(attention.o_proj, adapter), dense_weight(feed.down_proj, adapter)
    return Layer(
        layer.input_layernorm.weight.float(),
        qkv,
        qkv_bias,
        *out,
        layer.post_attention_layernorm.weight.float(),
        gate_up,
        gate_up_bias,
        *down,
    )


def _joined(layers: Sequence[Any], adapter: Level | None) -> tuple[Tensor, Tensor | None]:
    """Several linear layers on the same input as one."""
    weights, biases = zip(*(dense_weight(layer, adapter) for layer in layers), strict=True)
    if all(bias is None for bias in biases):
        return torch.cat(weights), None
    return torch.cat(weights), torch.cat(
        [
            weight.new_zeros(len(weight)) if bias is None else bias
            for weight, bias in zip(weights, biases, strict=True)
        ]
    )
