"""The layers of a small Llama with LoRA on a CPU, in few operations.

At a few hundred tokens a step, most of a small model's time goes to operations that are not its
multiplications: PEFT takes a dozen per layer and projection, transformers two dozen per norm and
rotation, and the CPU's flash attention prepares kernels per shape. Here projections of the same
input are one multiplication, and each step has a backward pass of its own. Numbers differ from
theirs by rounding alone: the multiplications are bfloat16 (or float32), residual sums float32.
"""

from collections.abc import Sequence
from typing import Any

import torch
from torch import Tensor, nn
from torch.nn.functional import linear

LONGEST = 2048
"""Positions in a row at most: weights of attention are kept for the backward pass."""


def lean_states(
    model: Any, input_ids: Tensor, positions: Tensor | None, shared: int = 0
) -> Tensor | None:
    """The decoder's last hidden states (rows, width, hidden) of a PEFT model, as autocast to
    bfloat16 would give them; None where the model is not one that this module computes. `positions`
    and `shared` as in `Batch`: samples that share a row do not see each other.
    """
    base = model.get_base_model()
    if input_ids.shape[1] > LONGEST or not is_lean(model, input_ids.device):
        return None
    body, (rows, width) = base.get_decoder(), input_ids.shape
    where = torch.arange(width).expand(rows, width) if positions is None else positions
    states = body.embed_tokens(input_ids).flatten(0, 1).float()
    cosine, sine = (part[:, :, None] for part in body.rotary_emb(states, where))
    hidden = _hidden(where, shared if positions is not None else 0)
    for layer in body.layers:
        attention, feed = layer.self_attn, layer.mlp
        mixed = _project(_norm(states, layer.input_layernorm), attention, "q_proj k_proj v_proj")
        mixed = mixed.view(rows, width, 3, -1, attention.head_dim)
        found = _applied(_Attention, mixed, cosine, sine, hidden, attention.scaling)
        states = states + _project(found, attention, "o_proj")
        opened = _project(_norm(states, layer.post_attention_layernorm), feed, "gate_proj up_proj")
        states = states + _project(_applied(_Gated, opened), feed, "down_proj")
    return _norm(states, body.norm).view(rows, width, -1)


def is_lean(model: Any, device: torch.device) -> bool:
    """Whether every projection of a Llama has a plain adapter on a dense bfloat16 matrix."""
    if device.type != "cpu":
        return False
    known = getattr(model, "_planner_ft_lean", None)
    if known is None:
        known = model._planner_ft_lean = _is_lean(model.get_base_model())
    return bool(known)


def _is_lean(base: Any) -> bool:
    config = base.config
    if (
        config.model_type != "llama"
        or config.num_attention_heads != config.num_key_value_heads
        or config.hidden_act != "silu"
        or base.dtype != torch.bfloat16
        or getattr(base, "is_gradient_checkpointing", False)
    ):
        return False
    names = ["q_proj", "k_proj", "v_proj", "o_proj"], ["gate_proj", "up_proj", "down_proj"]
    return all(
        set(getattr(module, "lora_A", ())) == {"default"}
        and type(module.get_base_layer()) is nn.Linear
        and module.get_base_layer().bias is None
        and not any(module.use_dora.values())
        for layer in base.get_decoder().layers
        for part, own in zip((layer.self_attn, layer.mlp), names, strict=True)
        for module in (getattr(part, name) for name in own)
    )


def _project(inputs: Tensor, part: nn.Module, names: str) -> Tensor:
    """The projections `names` of a layer's part side by side, adapters included."""
    modules = [getattr(part, name) for name in names.split()]
    weight = _joined(part, names, modules)
    first = modules[0]
    drop = first.lora_dropout["default"]
    share = drop.p if isinstance(drop, nn.Dropout) and first.training else 0.0
    pairs = [one[key].weight for m in modules for one in (m.lora_A, m.lora_B) for key in one]
    return _applied(_Projection, inputs, weight, first.scaling["default"], share, *pairs)


def _joined(part: Any, names: str, modules: Sequence[Any]) -> Tensor:
    """The frozen matrices of the projections as one, which is made once."""
    kept = part.__dict__.setdefault("_planner_ft_joined", {})
    if names not in kept:
        kept[names] = torch.cat([module.get_base_layer().weight.detach() for module in modules])
    return kept[names]  # type: ignore[no-any-return]


def _hidden(positions: Tensor, shared: int) -> Tensor:
    """Minus infinity where a key is later than a query or of another sample, (rows, 1, w, w)."""
    width, sample = positions.shape[1], (positions == shared).cumsum(1)
    later = torch.ones(width, width, dtype=torch.bool).triu(1)
    of_all = sample[:, None] == 0
    closed = later | (sample[:, :, None] != sample[:, None]) & ~of_all
    return torch.zeros(closed.shape, dtype=torch.bfloat16).masked_fill_(closed, -torch.inf)[:, None]


def _norm(states: Tensor, norm: Any) -> Tensor:
    return _applied(_Norm, states, norm.weight.detach(), norm.variance_epsilon)


def _applied(function: Any, *values: Any) -> Tensor:
    """`function.apply`, which torch gives no type."""
    found: Tensor = function.apply(*values)
    return found


class _Norm(torch.autograd.Function):
    """RMS norm of float32 states (n, hidden), given in bfloat16."""

    @staticmethod
    def forward(ctx: Any, states: Tensor, weight: Tensor, epsilon: float) -> Tensor:
        scale = states.square().mean(1, keepdim=True).add_(epsilon).rsqrt_()
        weight = weight.float()
        ctx.save_for_backward(states, scale, weight)
        return (states * scale).mul_(weight).to(torch.bfloat16)

    @staticmethod
    def backward(ctx: Any, *gradients: Tensor) -> tuple[Tensor, None, None]:
        states, scale, weight = ctx.saved_tensors
        inner = gradients[0] * weight
        along = (inner * states).mean(1, keepdim=True).mul_(scale.square())
        return inner.sub_(states * along).mul_(scale), None, None


class _Projection(torch.autograd.Function):
    """Inputs (n, in) through a frozen matrix (out, in) and LoRA pairs A (rank, in), B (part of out,
    rank) for its parts; each adapter drops a share of its inputs, as PEFT's does.
    """

    @staticmethod
    def forward(
        ctx: Any, inputs: Tensor, weight: Tensor, scaling: float, share: float, *pairs: Tensor
    ) -> Tensor:
        down = [pair.to(inputs.dtype) for pair in pairs[::2]]
        up = torch.block_diag(*pairs[1::2]).to(inputs.dtype)  # type: ignore[no-untyped-call]
        kept = [torch.empty_like(inputs).bernoulli_(1 - share) for _ in down] if share else []
        for mask in kept:
            mask.div_(1 - share)
        if kept:
            both = zip(down, kept, strict=True)
            inner = torch.cat([linear(inputs * mask, one) for one, mask in both], 1)
        else:
            inner = linear(inputs, torch.cat(down))
        ctx.save_for_backward(inputs, weight, up, inner, *down, *kept)
        ctx.scaling, ctx.count = scaling, len(down)
        ctx.shapes = [tuple(pair.shape) for pair in pairs[1::2]]
        return torch.addmm(linear(inputs, weight), inner, up.t(), alpha=scaling)

    @staticmethod
    def backward(ctx: Any, *gradients: Tensor) -> tuple[Tensor | None, ...]:
        gradient, (inputs, weight, up, inner, *rest) = gradients[0], ctx.saved_tensors
        down, kept = rest[: ctx.count], rest[ctx.count :]
        of_inner = torch.mm(gradient, up).mul_(ctx.scaling)
        of_inputs = torch.mm(gradient, weight)
        of_up = torch.mm(gradient.t(), inner).mul_(ctx.scaling).float()
        found: list[Tensor] = []
        row = column = 0
        if not kept:
            of_down = torch.mm(of_inner.t(), inputs).float()
            of_inputs.addmm_(of_inner, torch.cat(down))
        for place, (outputs, rank) in enumerate(ctx.shapes):
            own = slice(column, column + rank)
            if kept:
                part = of_inner[:, own]
                of_one = torch.mm(part.t(), inputs * kept[place]).float()
                of_inputs.addcmul_(torch.mm(part, down[place]), kept[place])
            else:
                of_one = of_down[own]
            found += [of_one, of_up[row : row + outputs, own]]
            row, column = row + outputs, column + rank
        return of_inputs, None, None, None, *found


class _Attention(torch.autograd.Function):
    """Queries, keys and values (rows, width, 3, heads, size) to what every position finds,
    (rows * width, heads * size). Queries and keys are turned by their rotary positions first.
    """

    @staticmethod
    def forward(
        ctx: Any, mixed: Tensor, cosine: Tensor, sine: Tensor, hidden: Tensor, scale: float
    ) -> Tensor:
        rows, width, _three, heads, size = mixed.shape
        turned = _turned(mixed[:, :, :2].float(), cosine[:, :, None], sine[:, :, None])
        turned[:, :, 0] *= scale
        parts = turned.to(mixed.dtype).permute(2, 0, 3, 1, 4).reshape(2, -1, width, size)
        values = mixed[:, :, 2].transpose(1, 2).reshape(-1, width, size)
        scores = torch.bmm(parts[0], parts[1].transpose(1, 2)).view(rows, heads, width, width)
        weights = torch.softmax(scores.add_(hidden), -1).view(-1, width, width)
        ctx.save_for_backward(parts, values, weights, cosine, sine)
        ctx.scale, ctx.shape = scale, mixed.shape
        found = torch.bmm(weights, values).view(rows, heads, width, size)
        return found.transpose(1, 2).reshape(rows * width, heads * size)

    @staticmethod
    def backward(ctx: Any, *gradients: Tensor) -> tuple[Tensor | None, ...]:
        parts, values, weights, cosine, sine = ctx.saved_tensors
        rows, width, _three, heads, size = ctx.shape
        gradient = gradients[0].view(rows, width, heads, size).transpose(1, 2)
        gradient = gradient.reshape(-1, width, size)
        of_weights = torch.bmm(gradient, values.transpose(1, 2))
        of_scores = torch._softmax_backward_data(of_weights, weights, -1, weights.dtype)
        both = torch.stack(
            [torch.bmm(of_scores, parts[1]), torch.bmm(of_scores.transpose(1, 2), parts[0])]
        )
        both = both.view(2, rows, heads, width, size).permute(1, 3, 0, 2, 4).float()
        both[:, :, 0] *= ctx.scale
        # The other way round: the transposed rotation.
        of_mixed = torch.empty(ctx.shape, dtype=gradient.dtype)
        of_mixed[:, :, :2] = _turned(both, cosine[:, :, None], -sine[:, :, None])
        of_values = torch.bmm(weights.transpose(1, 2), gradient)
        of_mixed[:, :, 2] = of_values.view(rows, heads, width, size).transpose(1, 2)
        return of_mixed, None, None, None, None


def _turned(values: Tensor, cosine: Tensor, sine: Tensor) -> Tensor:
    first, second = values.chunk(2, -1)
    return (values * cosine).add_(torch.cat([-second, first], -1).mul_(sine))


class _Gated(torch.autograd.Function):
    """silu(gate) * up of (n, 2 * width)."""

    @staticmethod
    def forward(ctx: Any, opened: Tensor) -> Tensor:
        ctx.save_for_backward(opened)
        gate, up = opened.chunk(2, 1)
        return nn.functional.silu(gate).mul_(up)

    @staticmethod
    def backward(ctx: Any, *gradients: Tensor) -> Tensor:
        (opened,) = ctx.saved_tensors
        gate, up = opened.chunk(2, 1)
        of_opened = torch.empty_like(opened)
        of_gate, of_up = of_opened.chunk(2, 1)
        of_gate.copy_(torch.ops.aten.silu_backward(gradients[0] * up, gate))
        torch.mul(gradients[0], nn.functional.silu(gate), out=of_up)
        return of_opened
