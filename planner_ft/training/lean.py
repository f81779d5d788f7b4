"""The layers of a small Llama with LoRA on a CPU, in few operations.

At a few hundred tokens a step, most of a small model's time goes to operations that are not its
multiplications: PEFT takes a dozen per layer and projection, transformers two dozen per norm and
rotation, dropout draws a number per value, and the CPU's flash attention prepares kernels per
shape. Here projections of the same input are one multiplication with their adapters, dropout draws
the places that it drops, and all layers have one backward pass, written out. Numbers differ from
theirs by rounding alone: the multiplications are bfloat16, residual sums float32.
"""

import math
from collections.abc import Iterator, Sequence
from typing import Any

import torch
from torch import Tensor, nn
from torch.nn.functional import linear, silu

LONGEST = 2048
"""Positions in a row at most: weights of attention are kept for the backward pass."""
GROUPS = ("q_proj", "k_proj", "v_proj"), ("o_proj",), ("gate_proj", "up_proj"), ("down_proj",)
"""The projections of a layer that have the same input."""


def lean_states(
    model: Any, input_ids: Tensor, positions: Tensor | None, shared: int = 0
) -> Tensor | None:
    """The decoder's last hidden states (rows, width, hidden) of a PEFT model, as autocast to
    bfloat16 would give them; None where the model is not one that this module computes. `positions`
    and `shared` as in `Batch`: samples that share a row do not see each other.
    """
    if input_ids.shape[1] > LONGEST or not is_lean(model, input_ids.device):
        return None
    body, (rows, width) = model.get_base_model().get_decoder(), input_ids.shape
    layers = _layers(model)
    where = torch.arange(width).expand(rows, width) if positions is None else positions
    states = body.embed_tokens(input_ids).flatten(0, 1).float()
    tables = _tables(body, states, where)
    hidden = _hidden(where, shared if positions is not None else 0)
    weights = [pair for layer in layers for joined in layer.joined for pair in joined.adapters]
    known = layers, _Norm(body.norm), tables, hidden, torch.is_grad_enabled()
    found: Tensor = _Decoder.apply(states, known, *weights)  # type: ignore[no-untyped-call]
    return found.view(rows, width, -1)


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
    return all(
        set(getattr(module, "lora_A", ())) == {"default"}
        and type(module.get_base_layer()) is nn.Linear
        and module.get_base_layer().bias is None
        and not any(module.use_dora.values())
        for layer in base.get_decoder().layers
        for group in _groups(layer)
        for module in group
    )


def _groups(layer: Any) -> Iterator[list[Any]]:
    parts = (layer.self_attn, layer.self_attn, layer.mlp, layer.mlp)
    for part, names in zip(parts, GROUPS, strict=True):
        yield [getattr(part, name) for name in names]


def _layers(model: Any) -> list["_Layer"]:
    """The layers, which are put together once."""
    known = model.__dict__.get("_planner_ft_layers")
    if known is None:
        layers = model.get_base_model().get_decoder().layers
        known = model.__dict__["_planner_ft_layers"] = [_Layer(layer) for layer in layers]
    return known  # type: ignore[no-any-return]


def _tables(body: Any, states: Tensor, positions: Tensor) -> tuple[Tensor, Tensor]:
    """Cosines and signed sines (2, rows, heads, width, size) that turn queries and keys by their
    positions; those of queries are scaled as attention asks for.
    """
    attention = body.layers[0].self_attn
    heads, (rows, width) = body.config.num_attention_heads, positions.shape
    cosine, sine = body.rotary_emb(states, positions)
    first, second = sine.chunk(2, -1)
    tables = []
    for table in (cosine, torch.cat([-first, second], -1)):
        whole = table[None, :, None].expand(2, rows, heads, width, -1).contiguous()
        whole[0] *= attention.scaling
        tables.append(whole)
    return tables[0], tables[1]


def _hidden(positions: Tensor, shared: int) -> Tensor:
    """Minus infinity where a key is later than a query or of another sample, (rows, 1, w, w)."""
    width, sample = positions.shape[1], (positions == shared).cumsum(1)
    later = torch.ones(width, width, dtype=torch.bool).triu(1)
    of_all = sample[:, None] == 0
    closed = later | (sample[:, :, None] != sample[:, None]) & ~of_all
    return torch.zeros(closed.shape, dtype=torch.bfloat16).masked_fill_(closed, -torch.inf)[:, None]


class _Decoder(torch.autograd.Function):
    """Float32 states (n, hidden) through all layers and the last norm, given in bfloat16."""

    @staticmethod
    def forward(ctx: Any, states: Tensor, known: Any, *weights: Tensor) -> Tensor:
        layers, norm, tables, hidden, learns = known
        states, ctx.known, ctx.kept = states.clone(), known, []
        for layer in layers:
            kept = layer.forward(states, tables, hidden)
            ctx.kept += [kept] if learns else []
        found: Tensor
        found, ctx.last = norm.forward(states)
        return found.to(torch.bfloat16)

    @staticmethod
    def backward(ctx: Any, *gradients: Tensor) -> tuple[Tensor | None, ...]:
        layers, norm, tables, *_ = ctx.known
        gradient, found = torch.zeros(gradients[0].shape), list[list[Tensor]]()
        norm.backward(gradients[0].float(), ctx.last, gradient)
        for layer, kept in zip(reversed(layers), reversed(ctx.kept), strict=True):
            found.append(layer.backward(gradient, kept, tables))
        return None, None, *(one for layer in reversed(found) for one in layer)


class _Layer:
    """A layer of the decoder; both passes change the residual sum, or its gradient, in place."""

    def __init__(self, layer: Any) -> None:
        self.joined = [_Joined(group) for group in _groups(layer)]
        self.norms = [_Norm(layer.input_layernorm), _Norm(layer.post_attention_layernorm)]

    def forward(self, states: Tensor, tables: tuple[Tensor, Tensor], hidden: Tensor) -> list[Any]:
        into, out, opening, closing = self.joined
        inputs, first = self.norms[0].forward(states)
        mixed, entered = into.forward(inputs)
        inputs, attended = _attention(mixed, tables, hidden)
        found, left = out.forward(inputs)
        inputs, second = self.norms[1].forward(states.add_(found))
        opened, widened = opening.forward(inputs)
        inputs, gated = _gated(opened)
        found, closed = closing.forward(inputs)
        states += found
        return [first, entered, attended, left, second, widened, gated, closed]

    def backward(
        self, gradient: Tensor, kept: list[Any], tables: tuple[Tensor, Tensor]
    ) -> list[Tensor]:
        """The gradients of the adapters."""
        into, out, opening, closing = self.joined
        first, entered, attended, left, second, widened, gated, closed = kept
        inner, of_closing = closing.backward(gradient.to(torch.bfloat16), closed)
        inner, of_opening = opening.backward(_gated_backward(inner, gated), widened)
        self.norms[1].backward(inner, second, gradient)
        inner, of_out = out.backward(gradient.to(torch.bfloat16), left)
        inner, of_into = into.backward(_attention_backward(inner, attended, tables), entered)
        self.norms[0].backward(inner, first, gradient)
        return [*of_into, *of_out, *of_opening, *of_closing]


class _Joined:
    """Projections of the same input as one: the frozen matrices side by side (in, out), and below
    them B of their adapters, so that one multiplication takes inputs and what A makes of them. B is
    that of the last forward pass: the backward pass comes before the adapters change.
    """

    def __init__(self, modules: Sequence[Any]) -> None:
        frozen = torch.cat([module.get_base_layer().weight.detach() for module in modules]).t()
        self.first, (self.entries, outputs) = modules[0], frozen.shape
        pairs = [(m.lora_A["default"].weight, m.lora_B["default"].weight) for m in modules]
        self.adapters = [weight for pair in pairs for weight in pair]
        self.both = frozen.new_zeros(self.entries + sum(len(down) for down, _up in pairs), outputs)
        self.both[: self.entries] = frozen
        self.spans: list[tuple[slice, slice]] = []
        row = column = 0
        for down, up in pairs:
            self.spans.append((slice(row, row + len(down)), slice(column, column + len(up))))
            row, column = row + len(down), column + len(up)
        own = self.both[self.entries :]
        self.ups = [
            (own[at], up.detach().t()) for at, (_down, up) in zip(self.spans, pairs, strict=True)
        ]

    def forward(self, inputs: Tensor) -> tuple[Tensor, Any]:
        """Outputs (n, out) of inputs (n, in), which are kept. A of the adapters multiplies in their
        type: float32, where they have it, begins sooner than bfloat16. A share of what the adapters
        get is dropped; those of the same input lose the same.
        """
        drop = self.first.lora_dropout["default"]
        share = drop.p if isinstance(drop, nn.Dropout) and self.first.training else 0.0
        scale = self.first.scaling["default"] / (1 - share)
        down = torch.cat([one.detach() for one in self.adapters[::2]]).mul_(scale)
        down = down.to(inputs.dtype)
        for place, up in self.ups:
            place.copy_(up)
        whole = self.both.new_empty(len(inputs), len(self.both))
        whole[:, : self.entries] = inputs
        dropped = None
        if share:
            # So many draws with replacement leave each value out with the probability `share`.
            count = round(-math.log1p(-share) * inputs.numel())
            dropped = torch.randint(inputs.numel(), (count,))
            inputs.view(-1).index_fill_(0, dropped, 0)
        inner = torch.mm(inputs, down.t())
        whole[:, self.entries :] = inner
        return torch.mm(whole, self.both), (inputs, inner, down, dropped, scale)

    def backward(self, gradient: Tensor, kept: Any) -> tuple[Tensor, list[Tensor]]:
        """The gradients of the inputs, in their type, and of the adapters."""
        inputs, inner, down, dropped, scale = kept
        whole = linear(gradient, self.both)
        of_inner = whole[:, self.entries :].to(inputs.dtype)
        of_down = torch.mm(of_inner.t(), inputs).float().mul_(scale)
        of_up = torch.mm(inner.to(gradient.dtype).t(), gradient).float()
        found = torch.mm(of_inner, down)
        if dropped is not None:
            found.view(-1).index_fill_(0, dropped, 0)
        found += whole[:, : self.entries]
        parts = ((of_down[rows], of_up[rows, columns].t()) for rows, columns in self.spans)
        return found, [one for pair in parts for one in pair]


class _Norm:
    """RMS norm of float32 states (n, hidden)."""

    def __init__(self, norm: Any) -> None:
        self.weight, self.epsilon = norm.weight.detach().float(), norm.variance_epsilon

    def forward(self, states: Tensor) -> tuple[Tensor, tuple[Tensor, Tensor]]:
        """The norm, and what its backward pass needs."""
        size = states.shape[1]
        scale = torch.linalg.vector_norm(states, dim=1, keepdim=True)
        scale = scale.square_().div_(size).add_(self.epsilon).rsqrt_()
        even = states * scale
        return even * self.weight, (even, scale)

    def backward(self, inner: Tensor, kept: tuple[Tensor, Tensor], gradient: Tensor) -> None:
        """Adds the gradient of the states to `gradient`."""
        even, scale = kept
        wide = inner * self.weight
        along = (wide * even).mean(1, keepdim=True)
        gradient.addcmul_(wide.addcmul_(even, along, value=-1), scale)


def _attention(
    mixed: Tensor, tables: tuple[Tensor, Tensor], hidden: Tensor
) -> tuple[Tensor, tuple[Tensor, ...]]:
    """What every position finds, (rows * width, heads * size), from queries, keys and values side
    by side, and what its backward pass needs.
    """
    _two, rows, heads, width, size = tables[0].shape
    parts = mixed.view(rows, width, 3, heads, size).permute(2, 0, 3, 1, 4)
    wide = parts[:2].to(torch.float32, memory_format=torch.contiguous_format)
    queries, keys = _turned(wide, *tables).to(mixed.dtype).view(2, -1, width, size)
    values = parts[2].reshape(-1, width, size)
    scores = torch.bmm(queries, keys.transpose(1, 2)).view(rows, heads, width, width)
    weights = torch.softmax(scores.add_(hidden), -1).view(-1, width, width)
    found = torch.bmm(weights, values).view(rows, heads, width, size).transpose(1, 2)
    return found.reshape(rows * width, -1), (queries, keys, values, weights)


def _attention_backward(
    gradient: Tensor, kept: tuple[Tensor, ...], tables: tuple[Tensor, Tensor]
) -> Tensor:
    cosine, sine = tables
    _two, rows, heads, width, size = cosine.shape
    queries, keys, values, weights = kept
    inner = gradient.view(rows, width, heads, size).transpose(1, 2).reshape(-1, width, size)
    of_weights = torch.bmm(inner, values.transpose(1, 2))
    of_scores = torch._softmax_backward_data(of_weights, weights, -1, weights.dtype)
    both = torch.stack([torch.bmm(of_scores, keys), torch.bmm(of_scores.transpose(1, 2), queries)])
    found = values.new_empty(rows, width, 3, heads, size)
    parts = found.permute(2, 0, 3, 1, 4)
    # The other way round: the transposed rotation.
    parts[:2] = _turned(both.float().view(cosine.shape), cosine, sine, way=-1)
    parts[2] = torch.bmm(weights.transpose(1, 2), inner).view(rows, heads, width, size)
    return found.view(rows * width, -1)


def _turned(values: Tensor, cosine: Tensor, sine: Tensor, way: int = 1) -> Tensor:
    first, second = values.chunk(2, -1)
    return (values * cosine).addcmul_(torch.cat([second, first], -1), sine, value=way)


def _gated(opened: Tensor) -> tuple[Tensor, tuple[Tensor, Tensor]]:
    """silu(gate) * up of (n, 2 * width), and what its backward pass needs."""
    gate, up = opened.chunk(2, 1)
    open_ = silu(gate)
    return open_ * up, (opened, open_)


def _gated_backward(gradient: Tensor, kept: tuple[Tensor, Tensor]) -> Tensor:
    opened, open_ = kept
    found = torch.empty_like(opened)
    (gate, up), (of_gate, of_up) = opened.chunk(2, 1), found.chunk(2, 1)
    torch.mul(gradient, open_, out=of_up)
    of_gate.copy_(torch.ops.aten.silu_backward(gradient.mul_(up), gate))
    return found
