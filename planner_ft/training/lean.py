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
    weights = [pair for layer in layers for joined in layer.joined for pair in joined.adapters()]
    known = layers, _Norm(body.norm), tables, hidden
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
        layers, norm, tables, hidden = known
        states, ctx.known, ctx.kept = states.clone(), known, []
        for layer in layers:
            ctx.kept.append(layer.forward(states, tables, hidden))
        found = torch.empty(states.shape, dtype=torch.bfloat16)
        ctx.last = norm.forward(states, found)
        return found

    @staticmethod
    def backward(ctx: Any, *gradients: Tensor) -> tuple[Tensor | None, ...]:
        layers, norm, tables, _hidden = ctx.known
        gradient, found = torch.zeros(gradients[0].shape), []
        norm.backward(gradients[0], ctx.last, gradient)
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
        inputs = into.room(states)
        kept: list[Any] = [self.norms[0].forward(states, inputs)]
        mixed, own = into.forward(inputs)
        inputs = out.room(states)
        kept += [own, _attention(mixed, tables, hidden, inputs[:, : out.entries])]
        found, own = out.forward(inputs)
        states += found
        inputs = opening.room(states)
        kept += [own, self.norms[1].forward(states, inputs)]
        opened, own = opening.forward(inputs)
        inputs = closing.room(states)
        kept += [own, _gated(opened, inputs[:, : closing.entries])]
        found, own = closing.forward(inputs)
        states += found
        return [*kept, own]

    def backward(
        self, gradient: Tensor, kept: list[Any], tables: tuple[Tensor, Tensor]
    ) -> list[Tensor]:
        """The gradients of the adapters."""
        into, out, opening, closing = self.joined
        first, mixed, attended, found, second, opened, gated, last = kept
        inner, of_closing = closing.backward(gradient.to(torch.bfloat16), last)
        inner, of_opening = opening.backward(_gated_backward(inner, gated), opened)
        self.norms[1].backward(inner, second, gradient)
        inner, of_out = out.backward(gradient.to(torch.bfloat16), found)
        inner, of_into = into.backward(_attention_backward(inner, attended, tables), mixed)
        self.norms[0].backward(inner, first, gradient)
        return [*of_into, *of_out, *of_opening, *of_closing]


class _Joined:
    """Projections of the same input as one: the frozen matrices side by side (in, out), and below
    them B of their adapters, so that one multiplication takes inputs and what A makes of them.
    """

    def __init__(self, modules: Sequence[Any]) -> None:
        frozen = torch.cat([module.get_base_layer().weight.detach() for module in modules]).t()
        self.modules, (self.entries, outputs) = modules, frozen.shape
        ranks = [module.r["default"] for module in modules]
        self.both = frozen.new_zeros(self.entries + sum(ranks), outputs)
        self.both[: self.entries] = frozen
        self.spans = list(self._spans(ranks))
        self.scale = self.share = 0.0

    def _spans(self, ranks: list[int]) -> Iterator[tuple[slice, slice]]:
        """Where each adapter's A ends, and its outputs."""
        row = column = 0
        for module, rank in zip(self.modules, ranks, strict=True):
            width = module.get_base_layer().out_features
            yield slice(row, row + rank), slice(column, column + width)
            row, column = row + rank, column + width

    def adapters(self) -> list[Tensor]:
        """A (rank, in) and B (out, rank) of each projection."""
        pairs = ((m.lora_A["default"].weight, m.lora_B["default"].weight) for m in self.modules)
        return [weight for pair in pairs for weight in pair]

    def room(self, states: Tensor) -> Tensor:
        """Where inputs go, and behind them what A makes of them."""
        return self.both.new_empty(len(states), len(self.both))

    def forward(self, inputs: Tensor) -> tuple[Tensor, Any]:
        """Outputs (n, out) of inputs in `room`. A share of the inputs of the adapters is dropped;
        those of the same input lose the same.
        """
        weights, first = self.adapters(), self.modules[0]
        drop = first.lora_dropout["default"]
        share = drop.p if isinstance(drop, nn.Dropout) and first.training else 0.0
        scale = first.scaling["default"] / (1 - share)
        down = torch.cat([one.detach() for one in weights[::2]]).to(inputs.dtype)
        for up, (rows, columns) in zip(weights[1::2], self.spans, strict=True):
            self.both[self.entries :][rows, columns].copy_(up.detach().t() * scale)
        own, dropped = inputs[:, : self.entries].contiguous(), None
        if share:
            # So many draws with replacement leave each value out with the probability `share`.
            count = round(-math.log1p(-share) * own.numel())
            dropped = torch.randint(own.numel(), (count,))
            own.view(-1).index_fill_(0, dropped, 0)
        inputs[:, self.entries :] = linear(own, down)
        return torch.mm(inputs, self.both), (inputs, own, down, dropped, scale)

    def backward(self, gradient: Tensor, kept: Any) -> tuple[Tensor, list[Tensor]]:
        """The gradients of the inputs (n, in) and of the adapters."""
        inputs, own, down, dropped, scale = kept
        whole = linear(gradient, self.both)
        inner = whole[:, self.entries :].contiguous()
        of_down = torch.mm(inner.t(), own).float()
        of_up = torch.mm(inputs[:, self.entries :].t(), gradient).float().mul_(scale)
        found = torch.mm(inner, down)
        if dropped is not None:
            found.view(-1).index_fill_(0, dropped, 0)
        found += whole[:, : self.entries]
        parts = ((of_down[rows], of_up[rows, columns].t()) for rows, columns in self.spans)
        return found, [one for pair in parts for one in pair]


class _Norm:
    """RMS norm of float32 states (n, hidden)."""

    def __init__(self, norm: Any) -> None:
        self.weight, self.epsilon = norm.weight.detach().float(), norm.variance_epsilon

    def forward(self, states: Tensor, into: Tensor) -> tuple[Tensor, Tensor]:
        """Writes to the first columns of `into`."""
        size = states.shape[1]
        scale = torch.linalg.vector_norm(states, dim=1, keepdim=True)
        scale = scale.square_().div_(size).add_(self.epsilon).rsqrt_()
        even = states * scale
        into[:, :size] = even * self.weight
        return even, scale

    def backward(self, inner: Tensor, kept: tuple[Tensor, Tensor], gradient: Tensor) -> None:
        """Adds the gradient of the states to `gradient`."""
        even, scale = kept
        wide = inner.float().mul_(self.weight)
        along = (wide * even).mean(1, keepdim=True)
        gradient.addcmul_(wide.addcmul_(even, along, value=-1), scale)


def _attention(
    mixed: Tensor, tables: tuple[Tensor, Tensor], hidden: Tensor, into: Tensor
) -> tuple[Tensor, ...]:
    """What every position finds, (rows * width, heads * size), from queries, keys and values."""
    _two, rows, heads, width, size = tables[0].shape
    parts = mixed.view(rows, width, 3, heads, size).permute(2, 0, 3, 1, 4)
    wide = parts[:2].to(torch.float32, memory_format=torch.contiguous_format)
    queries, keys = _turned(wide, *tables).to(mixed.dtype).view(2, -1, width, size)
    values = parts[2].reshape(-1, width, size)
    scores = torch.bmm(queries, keys.transpose(1, 2)).view(rows, heads, width, width)
    weights = torch.softmax(scores.add_(hidden), -1).view(-1, width, width)
    found = torch.bmm(weights, values).view(rows, heads, width, size).transpose(1, 2)
    into.view(rows, width, heads, size).copy_(found)
    return queries, keys, values, weights


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
    found = gradient.new_empty(rows, width, 3, heads, size)
    parts = found.permute(2, 0, 3, 1, 4)
    # The other way round: the transposed rotation.
    parts[:2] = _turned(both.float().view(cosine.shape), cosine, sine, way=-1)
    parts[2] = torch.bmm(weights.transpose(1, 2), inner).view(rows, heads, width, size)
    return found.view(rows * width, -1)


def _turned(values: Tensor, cosine: Tensor, sine: Tensor, way: int = 1) -> Tensor:
    first, second = values.chunk(2, -1)
    return (values * cosine).addcmul_(torch.cat([second, first], -1), sine, value=way)


def _gated(opened: Tensor, into: Tensor) -> tuple[Tensor, Tensor]:
    """silu(gate) * up of (n, 2 * width)."""
    gate, up = opened.chunk(2, 1)
    open_ = silu(gate)
    torch.mul(open_, up, out=into)
    return opened, open_


def _gated_backward(gradient: Tensor, kept: tuple[Tensor, Tensor]) -> Tensor:
    opened, open_ = kept
    found = torch.empty_like(opened)
    (gate, up), (of_gate, of_up) = opened.chunk(2, 1), found.chunk(2, 1)
    torch.mul(gradient, open_, out=of_up)
    of_gate.copy_(torch.ops.aten.silu_backward(gradient.mul_(up), gate))
    return found
