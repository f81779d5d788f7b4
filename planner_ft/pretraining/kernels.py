"""Attention and loss of the pretraining loop, for one processor core, in pieces for its cache.

The compiler's own kernels for softmax over rows of varying length run several times slower there,
so both are custom operators that it passes by. `CAUSAL` is the name under which a transformers
model finds the attention.
"""

from __future__ import annotations

from typing import Any

import torch
from torch import Tensor
from torch.nn.functional import scaled_dot_product_attention

CAUSAL = "planner_ft_causal"
LONGEST = 2048
"""Positions in a row at most."""
ROWS = 256
"""Rows of logits in a piece."""

_BIAS = torch.full((LONGEST, LONGEST), float("-inf")).triu(1)


@torch.library.custom_op("planner_ft::causal_attention", mutates_args=())
def causal_attention(
    query: Tensor, key: Tensor, value: Tensor, scale: float
) -> tuple[Tensor, Tensor]:
    """Attention of each position to itself and those before it, and its weights.

    Shapes: (batch, heads, length, width) each; weights (batch * heads, length, length).
    """
    query, key, value = _flat(query * scale), _flat(key), _flat(value)
    length = query.shape[1]
    scores = torch.bmm(query, key.transpose(1, 2)).add_(_BIAS[:length, :length].to(query.dtype))
    weights = torch.softmax(scores, -1)
    return torch.bmm(weights, value), weights


@causal_attention.register_fake
def _(query: Tensor, key: Tensor, value: Tensor, scale: float) -> tuple[Tensor, Tensor]:
    batch, heads, length, width = query.shape
    rows = batch * heads
    return query.new_empty((rows, length, width)), query.new_empty((rows, length, length))


@torch.library.custom_op("planner_ft::causal_attention_backward", mutates_args=())
def causal_attention_backward(
    gradient: Tensor, query: Tensor, key: Tensor, value: Tensor, weights: Tensor, scale: float
) -> tuple[Tensor, Tensor, Tensor]:
    """Gradients of query, key and value, each (batch * heads, length, width)."""
    query, key, value = _flat(query), _flat(key), _flat(value)
    of_weights = torch.bmm(gradient, value.transpose(1, 2))
    of_scores = torch._softmax_backward_data(of_weights, weights, -1, weights.dtype)
    return (
        torch.bmm(of_scores, key) * scale,
        torch.bmm(of_scores.transpose(1, 2), query) * scale,
        torch.bmm(weights.transpose(1, 2), gradient),
    )


@causal_attention_backward.register_fake
def _(
    gradient: Tensor, query: Tensor, key: Tensor, value: Tensor, weights: Tensor, scale: float
) -> tuple[Tensor, Tensor, Tensor]:
    return torch.empty_like(gradient), torch.empty_like(gradient), torch.empty_like(gradient)


def _remember(ctx: Any, inputs: tuple[Any, ...], output: tuple[Tensor, Tensor]) -> None:
    query, key, value, ctx.scale = inputs
    ctx.save_for_backward(query, key, value, output[1])


def _backward(
    ctx: Any, gradient: Tensor, _of_weights: Tensor | None
) -> tuple[Tensor, Tensor, Tensor, None]:
    query, key, value, weights = ctx.saved_tensors
    found = causal_attention_backward(gradient.contiguous(), query, key, value, weights, ctx.scale)
    of_query, of_key, of_value = (part.view(query.shape) for part in found)
    return of_query, of_key, of_value, None


torch.library.register_autograd("planner_ft::causal_attention", _backward, setup_context=_remember)


@torch.library.custom_op("planner_ft::shared_attention", mutates_args=())
def shared_attention(
    query: Tensor, key: Tensor, value: Tensor, parts: Tensor, scale: float
) -> Tensor:
    """Causal attention within each part of a row and to all of the part that it shares.

    Shapes: (1, heads, length, width) each; `parts` (n, 4) as in `packs.Row`. Gives (heads, length,
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
        for total, left, right in (
            (of_key, of_scores, query[:, start:end] * scale),
            (of_value, weights, own),
        ):
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
    """Name the attention CAUSAL for transformers' models; padding must stand on the right. With
    `parts`, samples share a row (`packs.Row`); `bias` says what each position of a grid sees.
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
        if bias is not None:
            found = scaled_dot_product_attention(*same, attn_mask=bias, scale=scaling)
            return found.transpose(1, 2), None
        if parts is not None:
            return shared_attention(*same, parts, scaling)[None].transpose(1, 2), None
        attended, _weights = causal_attention(*same, scaling)
        return attended.view(query.shape).transpose(1, 2), None

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


def _flat(part: Tensor) -> Tensor:
    """(batch, heads, length, width) → (batch * heads, length, width)."""
    return part.reshape(-1, *part.shape[2:])
