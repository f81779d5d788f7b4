"""Small Llama and Qwen2 models on a CPU, read straight from their files.

Importing what transformers, PEFT and bitsandbytes need for a model takes longer than a small model
needs to plan, and most of a token's time goes to everything but the multiplications. So weights,
adapters and 4-bit rounding are computed here as those libraries compute them, and a pass takes few
operations: queries, keys and values in one multiplication, gate and up in another. Norms, rotary
positions, attention and residual sums are float32, the multiplications are in the model's dtype.

A position's logits do not depend on how many positions share its pass or on the other rows of the
batch, even in bfloat16 where the CPU multiplies it (oneDNN gives a row the same numbers whatever
rows stand beside it): queries and keys are multiplied in blocks of a fixed size. So drafting,
fast-forward and batches change not one bit.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import torch
from torch import Tensor
from torch.nn.functional import embedding, linear, pad, rms_norm, silu

from planner_ft.candidates import Candidate, Dimensions
from planner_ft.candidates.adapters import check_adapter
from planner_ft.candidates.loading import require_folder
from planner_ft.candidates.location import read_config
from planner_ft.candidates.registry import Quantization
from planner_ft.candidates.weights import merge_adapter, read_weights
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import Level

BLOCK = 8
"""Queries that are multiplied together. A pass over fewer is filled up to it."""
KEYS = 128
"""Keys that are multiplied together. Memory comes in multiples of it."""
SHARED, LONG = 64, 256
"""Tokens that prompts must have in common to be copied, and of a prompt that is kept for it."""
EMBEDDINGS, HEAD, NORM = "model.embed_tokens.weight", "lm_head.weight", "model.norm.weight"
NORMS = ("input_layernorm", "post_attention_layernorm")
PROJECTIONS = tuple(f"self_attn.{name}_proj" for name in "qkvo")
PROJECTIONS += tuple(f"mlp.{name}_proj" for name in ("gate", "up", "down"))
"""In the order of Dimensions.linear_shapes."""
ROPE: dict[str, set[str]] = {
    "default": set(),
    "linear": {"factor"},
    "llama3": {"factor", "low_freq_factor", "high_freq_factor", "original_max_position_embeddings"},
}
"""Rotary positions that do not depend on the length of the text, and their settings."""
Linear = tuple[Tensor, Tensor | None]
"""Weight (outputs, inputs) and bias."""
Feeds = Sequence[Sequence[int]]
"""The next tokens of each row of a batch."""


def read_forms(
    candidate: Candidate,
    adapters: Mapping[Level, Path],
    *,
    quantization: Quantization,
    vocabulary: Vocabulary | None = None,
) -> dict[Level | None, SmallModel] | None:
    """The candidate with each adapter merged, and alone (None); None where transformers has to load
    it. Raises PlannerError for an adapter that does not fit.
    """
    folder = require_folder(candidate)
    for level, path in adapters.items():
        check_adapter(path, candidate, level=level, vocabulary=vocabulary)
    config = read_config(folder)
    if not _is_supported(config):
        return None
    tensors = read_weights(folder, quantization)
    forms: dict[Level | None, SmallModel] = {}
    for name in (None, *adapters):
        merged = merge_adapter(tensors, adapters[name]) if name else tensors
        if not merged or not (form := small_model(config, merged)):
            return None
        forms[name] = form
    return forms


def _is_supported(config: Mapping[str, Any]) -> bool:
    """Whether a config.json asks for nothing that this module does not compute."""
    rope = _rope(config)
    return (
        config.get("model_type") in ("llama", "qwen2")
        and config.get("hidden_act") == "silu"
        and set(rope) == {"rope_type", "rope_theta"} | ROPE.get(rope["rope_type"], {"unknown"})
        and all(kind == "full_attention" for kind in config.get("layer_types") or ())
        and not config.get("use_sliding_window")
        and not config.get("quantization_config")
    )


def _rope(config: Mapping[str, Any]) -> dict[str, Any]:
    """Settings of the rotary positions; files of before transformers 5 hold them in two places."""
    rope = {"rope_type": "default", "rope_theta": config.get("rope_theta", 10000.0)}
    return rope | (config.get("rope_scaling") or {}) | (config.get("rope_parameters") or {})


@dataclass(frozen=True)
class Layer:
    """A layer: rows of `qkv` are query, key, value heads; of `gate_up` the two halves."""

    norm: Tensor
    qkv: Linear
    out: Linear
    feed_norm: Tensor
    gate_up: Linear
    down: Linear


@dataclass(frozen=True)
class SmallModel:
    """A Llama or Qwen2 model; `frequencies` of its rotary positions, (head size / 2)."""

    layers: tuple[Layer, ...]
    embeddings: Tensor
    norm: Tensor
    head: Tensor
    frequencies: Tensor
    sizes: Dimensions
    epsilon: float
    last_prompt: list[tuple[Sequence[int], list[Tensor]]] = field(default_factory=list)
    """At most one: the ids of a long prompt, and keys and values of each layer for it."""

    @property
    def context(self) -> int:
        return self.sizes.context

    def start(self, rows: int) -> SmallPasses:
        return SmallPasses(self, rows)

    def normalised(self, states: Tensor, weight: Tensor) -> Tensor:
        """Normalised states in the dtype of the multiplications."""
        return rms_norm(states, weight.shape, weight, self.epsilon).to(self.head.dtype)

    def angles(self, positions: int) -> tuple[Tensor, Tensor]:
        """Cosine and sine of rotary positions, (positions, 1, head size), for `roll`."""
        angles = torch.arange(positions).float()[:, None] * self.frequencies
        sine = angles.sin()
        return angles.cos().repeat(1, 2)[:, None], torch.cat([-sine, sine], 1)[:, None]


def small_model(config: Mapping[str, Any], tensors: Mapping[str, Tensor]) -> SmallModel | None:
    """The model of a config.json and tensors; None where they are of another kind."""
    sizes = Dimensions.from_config(dict(config))
    if sizes is None or not _is_supported(config):
        return None
    left, hidden = dict(tensors), sizes.hidden
    shapes = dict(zip(PROJECTIONS, sizes.linear_shapes, strict=True))

    def take(name: str, *shape: int) -> Tensor:
        found = left.pop(name)
        if tuple(found.shape) != shape:
            raise KeyError(name)
        return found

    def joined(prefix: str, *names: str) -> Linear:
        """Several linear layers on the same input as one."""
        weights, biases = [], []
        for name in names:
            inputs, outputs = shapes[name]
            weights.append(take(f"{prefix}.{name}.weight", outputs, inputs))
            biases.append(left.pop(f"{prefix}.{name}.bias", weights[-1].new_zeros(outputs)))
        return torch.cat(weights), torch.cat(biases) if any(map(torch.any, biases)) else None

    def layer(prefix: str) -> Layer:
        norm, feed_norm = (take(f"{prefix}.{name}.weight", hidden).float() for name in NORMS)
        qkv, out = joined(prefix, *PROJECTIONS[:3]), joined(prefix, PROJECTIONS[3])
        gate_up, down = joined(prefix, *PROJECTIONS[4:6]), joined(prefix, PROJECTIONS[6])
        return Layer(norm, qkv, out, feed_norm, gate_up, down)

    try:
        embeddings = take(EMBEDDINGS, sizes.vocabulary, hidden)
        head = embeddings if sizes.tied else take(HEAD, sizes.vocabulary, hidden)
        layers = tuple(layer(f"model.layers.{index}") for index in range(sizes.layers))
        norm = take(NORM, hidden).float()
    except KeyError:
        return None
    if left.keys() - ({HEAD} if sizes.tied else set()):
        return None
    frequencies = _frequencies(_rope(config), sizes.head_dim)
    return SmallModel(layers, embeddings, norm, head, frequencies, sizes, config["rms_norm_eps"])


def _frequencies(rope: Mapping[str, Any], size: int) -> Tensor:
    plain: Tensor = 1.0 / rope["rope_theta"] ** (torch.arange(0, size, 2).float() / size)
    if rope["rope_type"] == "linear":
        plain /= rope["factor"]
    if rope["rope_type"] != "llama3":
        return plain
    low, high = rope["low_freq_factor"], rope["high_freq_factor"]
    turns = rope["original_max_position_embeddings"] * plain / (2 * math.pi)
    kept = ((turns - low) / (high - low)).clamp(0, 1)
    plain *= kept + (1 - kept) / rope["factor"]
    return plain


class Grid:
    """Where the tokens of a pass stand: blocks of `width` neighbours from position `starts` of some
    rows on, filled up with tokens that count for nothing. One row has any number of blocks, which
    attend one after the other; several have one each.

    `where` are the row and positions of all tokens in the memory, `parts` the blocks that attend
    together, their rows, and their keys. `hidden` is minus infinity for later keys, else 0:
    (blocks, 1, group * BLOCK, keys).
    """

    def __init__(self, rows: slice, starts: Sequence[int], count: int, group: int) -> None:
        self.width = width = min(count, BLOCK)
        blocks = [first for start in starts for first in range(start, start + count, width)]
        first, reach = torch.tensor(blocks)[:, None], [rounded_up(one + width) for one in blocks]
        self.where: tuple[Any, Any] = rows.start, slice(starts[0], starts[0] + len(blocks) * width)
        self.parts = [(slice(at, at + 1), rows, keys) for at, keys in enumerate(reach)]
        if len(starts) > 1:
            places = (first + torch.arange(width)).flatten()
            self.where = torch.arange(len(starts)).repeat_interleave(width), places
            self.parts = [(slice(None), rows, max(reach))]
        queries = (first + torch.arange(BLOCK)).repeat(1, group)
        later = torch.arange(max(reach)) > queries[:, None, :, None]
        self.hidden = torch.zeros(later.shape).masked_fill_(later, -torch.inf)


def attention(queries: Tensor, memory: Tensor, hidden: Tensor) -> Tensor:
    """Attention of queries (blocks, key heads, queries, size) over keys and values (2, blocks,
    positions, key heads, size).

    The result does not depend on how many hidden keys stand behind the others: values are added up
    in chunks, in their order.
    """
    keys, values = memory.transpose(2, 3)
    scores = torch.matmul(queries, keys.transpose(2, 3))
    weights = torch.softmax(scores.mul_(queries.shape[-1] ** -0.5).add_(hidden), -1)
    found = torch.matmul(weights[..., :KEYS], values[:, :, :KEYS])
    for start in range(KEYS, keys.shape[2], KEYS):
        chunk = slice(start, start + KEYS)
        found += torch.matmul(weights[..., chunk], values[:, :, chunk])
    return found


def rounded_up(number: int) -> int:
    """The next multiple of KEYS."""
    return -(-number // KEYS) * KEYS


def begin_alike(one: Sequence[int], other: Sequence[int]) -> int:
    """The number of tokens that two texts begin with alike."""
    pairs = itertools.takewhile(lambda pair: pair[0] == pair[1], zip(one, other, strict=False))
    return sum(1 for _ in pairs)


class SmallPasses:
    """Forward passes of a batch (see passes.Passes); each row has positions of its own."""

    wide = True

    def __init__(self, model: SmallModel, rows: int) -> None:
        self.model, self.lengths = model, [0] * rows
        empty = torch.zeros(2, rows, 0, model.sizes.kv_heads, model.sizes.head_dim)
        self.memory = [empty for _layer in model.layers]

    def run(self, feeds: Feeds, wanted: Sequence[int]) -> Tensor:
        ends = [start + len(feed) for start, feed in zip(self.lengths, feeds, strict=True)]
        self._make_room(max(ends) + BLOCK)
        if len(feeds) > 1 and max(map(len, feeds)) <= BLOCK:
            logits = self._run(slice(None), self.lengths, feeds, wanted)
        else:  # prompts one after the other, so that none is filled up to the longest
            parts = enumerate(zip(feeds, wanted, strict=True))
            logits = torch.cat([self._run_row(row, *part) for row, part in parts])
        self.lengths = ends
        return logits

    def _run_row(self, row: int, feed: Sequence[int], wanted: int) -> Tensor:
        """The wanted logits of one row. What a long prompt has in common with the one before it
        (the vocabulary, most of it) is not computed again.
        """
        start, known, kept = self.lengths[row], 0, self.model.last_prompt
        if not start and kept:
            known = begin_alike(kept[0][0], feed[:-wanted])
            known *= known >= SHARED
            for memory, old in zip(self.memory, kept[0][1], strict=True):
                memory[:, row, :known] = old[:, :known]
        logits = self._run(slice(row, row + 1), [start + known], [feed[known:]], [wanted])
        if not start and len(feed) > LONG and 2 * known < len(feed):
            kept[:] = [(feed, [memory[:, row, : len(feed)].clone() for memory in self.memory])]
        return logits

    def forget(self, counts: Sequence[int]) -> None:
        self.lengths = [length - count for length, count in zip(self.lengths, counts, strict=True)]

    def select(self, kept: Sequence[int]) -> None:
        self.lengths = [self.lengths[row] for row in kept]
        self.memory = [memory[:, list(kept)] for memory in self.memory]

    def _make_room(self, positions: int) -> None:
        """Memory for this many positions; what is not written yet is hidden, and still a number."""
        if positions > (known := self.memory[0].shape[2]):
            room = max(rounded_up(positions), 2 * known)
            self.memory = [pad(one, (0, 0, 0, 0, 0, room - known)) for one in self.memory]
            self.angles = self.model.angles(room)

    def _run(
        self, rows: slice, starts: Sequence[int], feeds: Feeds, wanted: Sequence[int]
    ) -> Tensor:
        """The wanted logits of one row, or of all with at most BLOCK tokens each."""
        model = self.model
        grid = Grid(rows, starts, max(map(len, feeds)), model.sizes.heads // model.sizes.kv_heads)
        slots = len(grid.hidden) * grid.width // len(feeds)
        ids = [token for feed in feeds for token in (*feed, *[0] * (slots - len(feed)))]
        angles = [angle[grid.where[1]] for angle in self.angles]
        states = embedding(torch.tensor(ids), model.embeddings).float()
        for layer, memory in zip(model.layers, self.memory, strict=True):
            queries = model.normalised(states, layer.norm)
            states = states + self._attend(layer, queries, grid, angles, memory)
            fed = linear(model.normalised(states, layer.feed_norm), *layer.gate_up)
            gate, up = fed.chunk(2, -1)
            states = states + linear(silu(gate) * up, *layer.down)
        ends = (slots * row + len(feed) for row, feed in enumerate(feeds))
        last = zip(ends, wanted, strict=True)
        kept = [place for end, count in last for place in range(end - count, end)]
        return linear(model.normalised(states[kept], model.norm), model.head)

    def _attend(
        self, layer: Layer, states: Tensor, grid: Grid, angles: Sequence[Tensor], memory: Tensor
    ) -> Tensor:
        """Remember the new keys and values, and let every position look at those up to itself."""
        sizes = self.model.sizes
        heads, key_heads, size = sizes.heads, sizes.kv_heads, sizes.head_dim
        both = heads + key_heads
        mixed = linear(states, *layer.qkv).float().view(-1, both + key_heads, size)
        rotated = mixed[:, :both]
        turned = torch.addcmul(rotated * angles[0], rotated.roll(size // 2, -1), angles[1])
        for kind, new in zip(memory, (turned[:, heads:], mixed[:, both:]), strict=True):
            kind[grid.where] = new
        queries = turned[:, :heads].reshape(-1, grid.width, key_heads, heads // key_heads, size)
        queries = pad(queries.permute(0, 2, 3, 1, 4), (0, 0, 0, BLOCK - grid.width))
        queries = queries.reshape(len(queries), key_heads, -1, size)
        found = [
            attention(queries[part], memory[:, rows, :keys], grid.hidden[part, ..., :keys])
            for part, rows, keys in grid.parts
        ]
        spread = torch.cat(found).view(len(queries), key_heads, -1, BLOCK, size)
        flat = spread.permute(0, 3, 1, 2, 4)[:, : grid.width].reshape(len(states), heads * size)
        return linear(flat.to(states.dtype), *layer.out)
