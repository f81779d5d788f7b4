"""The model in training: its attention and loss, deeper models from shallower ones, dropout, layers
rounded to 4 bits.

Attention and loss are made in pieces for the cache of a processor core: the compiler's own kernels
for softmax over rows of varying length run several times slower there, so attention is a custom
operator that it passes by.

The candidate runs with its layers' matrices in NF4. In a stage that is trained through the
rounding, the forward pass sees what NF4 leaves of them, and the optimiser moves the weights behind
(the straight-through estimator of Bengio et al., arXiv:1308.3432).
"""

import re
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any

import torch
from torch import Tensor
from torch.nn.functional import scaled_dot_product_attention

CAUSAL = "planner_ft_causal"
"""The name under which a transformers model finds the attention."""
LONGEST = 2048
"""Positions in a part at most."""
ROWS = 256
"""Rows of logits in a piece."""
LAYER = re.compile(r"(model\.layers\.)(\d+)(\..+)")
OUTPUTS = (".self_attn.o_proj.weight", ".mlp.down_proj.weight")
"""A layer adds to the stream through these matrices: with zeros there it adds nothing."""
BLOCK = 64
"""Weights that share a scale, as transformers' NF4 configuration has it."""

_BIAS = torch.full((LONGEST, LONGEST), float("-inf")).triu(1)


@torch.library.custom_op("planner_ft::shared_attention", mutates_args=())
def shared_attention(
    query: Tensor, key: Tensor, value: Tensor, parts: Tensor, scale: float
) -> Tensor:
    """Causal attention within each part of a row and to all of the part that it shares.

    Shapes: (1, heads, length, width) each; `parts` (n, 4) as `grids.parts_of`
    gives them. Gives (heads, length,
    width).
    """
    query, key, value = (part[0] for part in (query, key, value))
    found = torch.empty_like(value)
    for start, end, *shown in parts.tolist():
        weights = _weights(query[:, start:end], key, start, end, shown, scale)
        found[:, start:end] = torch.bmm(weights, _joined(value, start, end, shown))
    return found


@shared_attention.register_fake
def _(query: Tensor, key: Tensor, value: Tensor, parts: Tensor, scale: float) -> Tensor:
    return torch.empty_like(value[0])


@torch.library.custom_op("planner_ft::shared_attention_backward", mutates_args=())
def shared_attention_backward(
    gradient: Tensor, query: Tensor, key: Tensor, value: Tensor, parts: Tensor, scale: float
) -> tuple[Tensor, Tensor, Tensor]:
    """Gradients of query, key and value, each (heads, length, width); weights are made again."""
    query, key, value = (part[0] for part in (query, key, value))
    of_query = torch.empty_like(query)
    of_key, of_value = (torch.zeros_like(part, dtype=torch.float32) for part in (key, value))
    for start, end, *shown in parts.tolist():
        weights = _weights(query[:, start:end], key, start, end, shown, scale)
        own = gradient[:, start:end]
        of_weights = torch.bmm(own, _joined(value, start, end, shown).transpose(1, 2))
        of_scores = torch._softmax_backward_data(of_weights, weights, -1, weights.dtype)
        of_query[:, start:end] = torch.bmm(of_scores, _joined(key, start, end, shown)) * scale
        scaled = query[:, start:end] * scale
        for total, left, right in ((of_key, of_scores, scaled), (of_value, weights, own)):
            found, common = torch.bmm(left.transpose(1, 2), right), shown[1] - shown[0]
            total[:, shown[0] : shown[1]] += found[:, :common]
            total[:, start:end] += found[:, common:]
    return of_query, of_key.to(key.dtype), of_value.to(value.dtype)


@shared_attention_backward.register_fake
def _(
    gradient: Tensor, query: Tensor, key: Tensor, value: Tensor, parts: Tensor, scale: float
) -> tuple[Tensor, Tensor, Tensor]:
    return torch.empty_like(query[0]), torch.empty_like(key[0]), torch.empty_like(value[0])


def _joined(whole: Tensor, start: int, end: int, shown: list[int]) -> Tensor:
    own = whole[:, start:end]
    return torch.cat([whole[:, shown[0] : shown[1]], own], 1) if shown[1] > shown[0] else own


def _weights(
    query: Tensor, key: Tensor, start: int, end: int, shown: list[int], scale: float
) -> Tensor:
    """Attention weights of a part to what it shares and to itself."""
    scores = torch.bmm(query * scale, _joined(key, start, end, shown).transpose(1, 2))
    own = scores[:, :, shown[1] - shown[0] :]
    own.add_(_BIAS[: end - start, : end - start].to(scores.dtype))
    return torch.softmax(scores, -1)


def _remember_parts(ctx: Any, inputs: tuple[Any, ...], output: Tensor) -> None:
    *tensors, ctx.scale = inputs
    ctx.save_for_backward(*tensors)


def _backward_parts(ctx: Any, gradient: Tensor) -> tuple[Tensor | None, ...]:
    found = shared_attention_backward(gradient.contiguous(), *ctx.saved_tensors, ctx.scale)
    return *(part[None] for part in found), None, None


torch.library.register_autograd(
    "planner_ft::shared_attention", _backward_parts, setup_context=_remember_parts
)


def register_attention() -> None:
    """Name the attention CAUSAL for transformers' models. With `parts`, samples share a row; `bias`
    says what each position of a grid sees; without both, each sees itself and those before it.
    """
    from transformers.modeling_utils import ALL_ATTENTION_FUNCTIONS

    def attend(
        _module: Any,
        query: Tensor,
        key: Tensor,
        value: Tensor,
        _mask: Any,
        scaling: float,
        parts: Tensor | None = None,
        bias: Tensor | None = None,
        **_: Any,
    ) -> tuple[Tensor, None]:
        # Rotary positions leave queries and keys in float32, also where values are bfloat16.
        same = (query.to(value.dtype), key.to(value.dtype), value)
        if parts is not None:
            return shared_attention(*same, parts, scaling)[None].transpose(1, 2), None
        alone = bias is None
        found = scaled_dot_product_attention(*same, bias, is_causal=alone, scale=scaling)
        return found.transpose(1, 2), None

    ALL_ATTENTION_FUNCTIONS.register(CAUSAL, attend)


def summed_cross_entropy(hidden: Tensor, weight: Tensor, targets: Tensor) -> Tensor:
    """Cross-entropies of `hidden` (n, width) through `weight` (vocabulary, width) at `targets`
    (n,).

    Products in bfloat16, the rest in float32. The logits never exist as a whole.
    """
    total: Tensor = _SummedCrossEntropy.apply(hidden, weight, targets)  # type: ignore[no-untyped-call]
    return total


class _SummedCrossEntropy(torch.autograd.Function):
    """The gradients are made in the forward pass, piece by piece."""

    @staticmethod
    def forward(ctx: Any, hidden: Tensor, weight: Tensor, targets: Tensor) -> Tensor:
        inner, outer = hidden.to(torch.bfloat16), weight.to(torch.bfloat16)
        of_hidden, of_weight = torch.empty_like(inner), torch.zeros_like(weight)
        total = hidden.new_zeros((), dtype=torch.float32)
        for start in range(0, len(targets), ROWS):
            piece, wanted = inner[start : start + ROWS], targets[start : start + ROWS, None]
            logits = torch.mm(piece, outer.t()).float()
            norm = torch.logsumexp(logits, -1, keepdim=True)
            total += (norm - logits.gather(1, wanted)).sum()
            shares = logits.sub_(norm).exp_()
            share = shares.scatter_add_(1, wanted, torch.full_like(norm, -1.0)).to(torch.bfloat16)
            torch.mm(share, outer, out=of_hidden[start : start + ROWS])
            of_weight += torch.mm(share.t(), piece)
        ctx.save_for_backward(of_hidden.to(hidden.dtype), of_weight)
        return total

    @staticmethod
    def backward(ctx: Any, *gradients: Tensor) -> tuple[Tensor, Tensor, None]:
        of_hidden, of_weight = ctx.saved_tensors
        return of_hidden * gradients[0].to(of_hidden.dtype), of_weight * gradients[0], None


def deepened(weights: dict[str, Tensor], layers: int) -> dict[str, Tensor]:
    """The weights of a Llama with `layers` layers that computes the same as one with fewer.

    The new layers stand evenly among the old ones. Each is a copy of the layer before it whose two
    output matrices are zero, so that it passes its input on until training has changed it (block
    expansion, Wu et al. 2024, arXiv:2401.02415). Raises ValueError if `weights` has more layers.
    """
    own = 1 + max(int(found[2]) for found in map(LAYER.fullmatch, weights) if found)
    if own > layers:
        sizes = f"The weights to start from have {own} layers, the model {layers}"
        raise ValueError(f"{sizes}: a stage may add layers, not take them away.")
    grown = {name: value for name, value in weights.items() if not LAYER.fullmatch(name)}
    sources = [place * own // layers for place in range(layers)]
    for place, source in enumerate(sources):
        added = place > 0 and sources[place - 1] == source
        for name, value in weights.items():
            found = LAYER.fullmatch(name)
            if found and int(found[2]) == source:
                empty = added and name.endswith(OUTPUTS)
                own_value = torch.zeros_like(value) if empty else value.clone()
                grown[f"{found[1]}{place}{found[3]}"] = own_value
    return grown


def add_dropout(model: Any, share: float) -> None:
    """Drop this share of what embeddings, attention and feed-forward layers of a Llama give, in
    training mode: transformers' Llama has no such setting.
    """

    def dropped(module: Any, _given: Any, found: Any) -> Any:
        if isinstance(found, tuple):
            return dropped(module, _given, found[0]), *found[1:]
        return torch.nn.functional.dropout(found, share, module.training)

    for layer in model.model.layers:
        layer.self_attn.register_forward_hook(dropped)
        layer.mlp.register_forward_hook(dropped)
    model.model.embed_tokens.register_forward_hook(dropped)


def nf4(weights: Tensor) -> Tensor:
    """A bfloat16 matrix after a round trip through NF4 with double quantisation."""
    from bitsandbytes.functional import dequantize_4bit, quantize_4bit

    matrix = weights.detach().to(torch.bfloat16).contiguous()
    packed = quantize_4bit(matrix, blocksize=BLOCK, compress_statistics=True, quant_type="nf4")
    values: Tensor = dequantize_4bit(*packed)
    return values.to(weights.dtype).view_as(weights)


@contextmanager
def rounded(matrices: Sequence[Tensor]) -> Iterator[None]:
    """In the block the matrices hold their NF4 values; afterwards their own, with new gradients."""
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
