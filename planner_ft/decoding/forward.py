"""Small Llama and Qwen2 models on a CPU, read straight from their files.

Importing what transformers, PEFT and bitsandbytes need for a model takes longer than a small model
needs to plan, and most of a token's time goes to everything but the multiplications. So weights,
adapters and 4-bit rounding are computed here as those libraries compute them, and a pass takes few
operations: queries, keys and values in one multiplication, gate and up in another. Norms, rotary
positions, attention and residual sums are float32, the multiplications are in the model's dtype.

Attention runs over queries and keys in blocks of a fixed size. So a position's logits do not depend
on how many positions share its pass or on the other rows of the batch, even in bfloat16 where the
CPU multiplies it (oneDNN gives a row the same numbers whatever rows stand beside it): drafting,
fast-forward and batches change not one bit.
"""

from __future__ import annotations

import functools
import itertools
import math
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import torch
from safetensors.torch import load_file
from torch import Tensor
from torch.nn.functional import embedding, linear, pad, rms_norm, silu

from planner_ft.candidates import Candidate, Dimensions
from planner_ft.candidates.adapters import CONFIG, WEIGHTS, check_adapter
from planner_ft.candidates.loading import compute_dtype, require_folder
from planner_ft.candidates.location import read_config, weight_files
from planner_ft.candidates.registry import Quantization
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import Level

BLOCK = 8
"""Queries that are multiplied together. A pass over fewer is filled up to it."""
SHARED, LONG = 64, 256
"""Tokens that prompts must have in common to be copied, and of a prompt that is kept for it."""
KEYS = 128
"""Keys that are multiplied together. Memory comes in multiples of it."""
EMBEDDINGS, HEAD, NORM = "model.embed_tokens.weight", "lm_head.weight", "model.norm.weight"
NORMS = ("input_layernorm", "post_attention_layernorm")
PROJECTIONS = (
    *(f"self_attn.{name}_proj" for name in "qkvo"),
    *(f"mlp.{name}_proj" for name in ("gate", "up", "down")),
)
"""In the order of Dimensions.linear_shapes."""
ROPE: dict[str, set[str]] = {
    "default": set(),
    "linear": {"factor"},
    "llama3": {"factor", "low_freq_factor", "high_freq_factor", "original_max_position_embeddings"},
}
"""Rotary positions that do not depend on the length of the text, and their settings."""
LORA = ("base_model.model.", ".lora_A.weight", ".lora_B.weight")
PLAIN_LORA = {
    *("auto_mapping", "base_model_name_or_path", "bias", "inference_mode", "init_lora_weights"),
    *("lora_alpha", "lora_dropout", "megatron_core", "peft_type", "peft_version"),
    *("qalora_group_size", "r", "revision", "target_modules", "task_type"),
}
"""Settings of an adapter that are read here or do not change how it is applied. An adapter with any
other one set is not plain LoRA.
"""
NF4_BLOCK, SCALE_BLOCK = 64, 256
LEVELS = tuple(
    float(level)
    for level in [
        "-1",
        "-0.6961928009986877",
        "-0.5250730514526367",
        "-0.39491748809814453",
        "-0.28444138169288635",
        "-0.18477343022823334",
        "-0.09105003625154495",
        "0",
        "0.07958029955625534",
        "0.16093020141124725",
        "0.24611230194568634",
        "0.33791524171829224",
        "0.44070982933044434",
        "0.5626170039176941",
        "0.7229568362236023",
        "1",
    ]
)
"""The sixteen values of NormalFloat: quantiles of the normal distribution, scaled to [-1, 1]."""
HALF_TABLE = (2**16 - 1) / 2
TINY = 1e-38
"""In place of the scale of a block of zeros."""

Linear = tuple[Tensor, Tensor | None]
"""Weight (outputs, inputs) and bias."""


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
    config, dtype = read_config(folder), compute_dtype(torch.device("cpu"))
    if not _is_supported(config):
        return None
    tensors = {
        name: tensor.to(dtype)
        for path in weight_files(folder)
        for name, tensor in load_file(path).items()
    }
    layers = [name for name in tensors if name.endswith("_proj.weight")]
    if quantization == "nf4":
        tensors |= {name: rounded_to_nf4(tensors[name]) for name in layers}
    forms: dict[Level | None, SmallModel] = {}
    for name in (None, *adapters):
        added = _added(adapters[name], layers) if name else {}
        merged = {key: (tensors[key].float() + new).to(dtype) for key, new in (added or {}).items()}
        form = small_model(config, {**tensors, **merged}) if added is not None else None
        if form is None:
            return None
        forms[name] = form
    return forms


def _is_supported(config: Mapping[str, Any]) -> bool:
    """Whether a config.json asks for nothing that this module does not compute."""
    rope = _rope(config)
    kinds = config.get("layer_types") or ()
    return (
        config.get("model_type") in ("llama", "qwen2")
        and config.get("hidden_act") == "silu"
        and set(rope) == {"rope_type", "rope_theta"} | ROPE.get(rope["rope_type"], {"unknown"})
        and all(kind == "full_attention" for kind in kinds)
        and not config.get("use_sliding_window")
        and not config.get("quantization_config")
    )


def _rope(config: Mapping[str, Any]) -> dict[str, Any]:
    """Settings of the rotary positions; files of before transformers 5 hold them in two places."""
    rope = {"rope_type": "default", "rope_theta": config.get("rope_theta", 10000.0)}
    return rope | (config.get("rope_scaling") or {}) | (config.get("rope_parameters") or {})


def _added(folder: Path, layers: Collection[str]) -> dict[str, Tensor] | None:
    """What an adapter adds to its layers by name; None where it is more than two matrices each."""
    config, tensors = read_config(folder, CONFIG), load_file(folder / WEIGHTS)
    prefix, down, up = LORA
    names = {layer: prefix + layer.removesuffix(".weight") for layer in layers}
    used = {layer: name for layer, name in names.items() if name + down in tensors}
    # An initialisation with a name (PiSSA, LoftQ ...) changes the base, too.
    plain = config.get("bias") == "none" and isinstance(config.get("init_lora_weights", True), bool)
    others = any(value and name not in PLAIN_LORA for name, value in config.items())
    pairs = {one + end for one in used.values() for end in LORA[1:]}
    if not plain or others or set(tensors) != pairs:
        return None
    scaling = config["lora_alpha"] / config["r"]
    return {
        layer: scaling * (tensors[name + up].float() @ tensors[name + down].float())
        for layer, name in used.items()
    }


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
        head = left.pop(HEAD, None) if sizes.tied else take(HEAD, sizes.vocabulary, hidden)
        layers = tuple(layer(f"model.layers.{index}") for index in range(sizes.layers))
        norm = take(NORM, hidden).float()
    except KeyError:
        return None
    if left:
        return None
    head = embeddings if sizes.tied or head is None else head
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


class SmallPasses:
    """Forward passes of a batch (see passes.Passes); each row has positions of its own."""

    wide = True

    def __init__(self, model: SmallModel, rows: int) -> None:
        self.model = model
        self.lengths = [0] * rows
        self.capacity = 0
        empty = torch.zeros(2, rows, 0, model.sizes.kv_heads, model.sizes.head_dim)
        self.memory = [empty for _layer in model.layers]

    def run(self, feeds: Sequence[Sequence[int]], wanted: Sequence[int]) -> Tensor:
        counts = [len(feed) for feed in feeds]
        starts = self.lengths
        ends = [start + count for start, count in zip(starts, counts, strict=True)]
        self._make_room(max(ends) + BLOCK)
        if len(feeds) > 1 and max(counts) <= BLOCK:
            logits = self._run(_Grid.of_rows(starts, max(counts)), feeds, wanted)
        else:  # prompts one after the other, so that none is filled up to the longest
            parts = zip(range(len(feeds)), starts, feeds, wanted, strict=True)
            logits = torch.cat([self._run_row(*part) for part in parts])
        self.lengths = ends
        return logits

    def _run_row(self, row: int, start: int, feed: Sequence[int], wanted: int) -> Tensor:
        """The wanted logits of one row. What a long prompt has in common with the one before it
        (the vocabulary, most of it) is not computed again.
        """
        known, kept = 0, self.model.last_prompt
        if not start and kept:
            same = zip(kept[0][0], feed[:-wanted], strict=False)
            known = sum(1 for _ in itertools.takewhile(lambda pair: pair[0] == pair[1], same))
            known *= known >= SHARED
            for memory, old in zip(self.memory, kept[0][1], strict=True):
                memory[:, row, :known] = old[:, :known]
        grid = _Grid.of_row(row, start + known, len(feed) - known)
        logits = self._run(grid, [feed[known:]], [wanted])
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
        if positions > self.capacity:
            more = max(_up(positions), 2 * self.capacity) - self.capacity
            self.memory = [pad(memory, (0, 0, 0, 0, 0, more)) for memory in self.memory]
            self.capacity += more
            self.angles = self.model.angles(self.capacity)

    def _run(self, grid: _Grid, feeds: Sequence[Sequence[int]], wanted: Sequence[int]) -> Tensor:
        """The wanted logits of the rows of a grid."""
        model, slots = self.model, len(grid.starts) * grid.width // len(feeds)
        ids = [token for feed in feeds for token in (*feed, *[0] * (slots - len(feed)))]
        hidden = grid.hidden(model.sizes.heads // model.sizes.kv_heads)
        angles = [angle[grid.where[1]] for angle in self.angles]
        states = embedding(torch.tensor(ids), model.embeddings).float()
        for layer, memory in zip(model.layers, self.memory, strict=True):
            queries = model.normalised(states, layer.norm)
            states = states + self._attend(layer, queries, grid, hidden, angles, memory)
            fed = linear(model.normalised(states, layer.feed_norm), *layer.gate_up)
            gate, up = fed.chunk(2, -1)
            states = states + linear(silu(gate) * up, *layer.down)
        kept = [
            slots * row + len(feed) - step
            for row, (feed, count) in enumerate(zip(feeds, wanted, strict=True))
            for step in range(count, 0, -1)
        ]
        return linear(model.normalised(states[kept], model.norm), model.head)

    def _attend(
        self,
        layer: Layer,
        states: Tensor,
        grid: _Grid,
        hidden: Tensor,
        angles: Sequence[Tensor],
        memory: Tensor,
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
            attention(queries[part], memory[:, rows, :reach], hidden[part, ..., :reach])
            for part, rows, reach in grid.parts
        ]
        spread = torch.cat(found).view(len(queries), key_heads, -1, BLOCK, size)
        spread = spread[..., : grid.width, :]
        flat = spread.permute(0, 3, 1, 2, 4).reshape(len(states), heads * size)
        return linear(flat.to(states.dtype), *layer.out)


@dataclass(frozen=True)
class _Grid:
    """Where the tokens of a pass stand: blocks of `width` neighbours from the positions `starts`
    on, filled up with tokens that count for nothing. `where` are the row and positions of all
    tokens in the memory, `parts` the blocks that attend together, their rows, and their keys.
    """

    starts: Tensor
    width: int
    where: tuple[Any, Any]
    parts: Sequence[tuple[slice, slice, int]]

    @classmethod
    def of_row(cls, row: int, start: int, count: int) -> _Grid:
        """A single row with any number of tokens; its blocks attend one after the other."""
        width = min(count, BLOCK)
        starts = range(start, start + count, width)
        parts = [
            (slice(block, block + 1), slice(row, row + 1), _up(first + width))
            for block, first in enumerate(starts)
        ]
        positions = slice(start, start + len(starts) * width)
        return cls(torch.tensor(starts), width, (row, positions), parts)

    @classmethod
    def of_rows(cls, starts: Sequence[int], width: int) -> _Grid:
        """All rows, each with at most `width` tokens."""
        rows, first = torch.arange(len(starts)).repeat_interleave(width), torch.tensor(starts)
        positions = (first[:, None] + torch.arange(width)).flatten()
        parts = [(slice(None), slice(None), _up(max(starts) + width))]
        return cls(first, width, (rows, positions), parts)

    def hidden(self, group: int) -> Tensor:
        """Minus infinity for later keys, else 0: (blocks, 1, group * BLOCK, keys)."""
        queries = (self.starts[:, None] + torch.arange(BLOCK)).repeat(1, group)
        later = torch.arange(self.parts[-1][2]) > queries[:, None, :, None]
        return torch.zeros(later.shape).masked_fill_(later, -torch.inf)


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


def _up(number: int) -> int:
    """The next multiple of KEYS."""
    return -(-number // KEYS) * KEYS


def rounded_to_nf4(weight: Tensor) -> Tensor:
    """A weight as bitsandbytes unpacks it on a CPU after 4-bit storage with double quantisation:
    blocks of 64 weights share a scale, and the scales are 8-bit floats, blocks of 256 with a scale
    of their own (Dettmers et al. 2023; 8-bit floats, Dettmers 2016).
    """
    flat = weight.float().flatten()
    blocks = pad(flat, (0, -len(flat) % NF4_BLOCK)).view(-1, NF4_BLOCK)
    scales = blocks.abs().amax(1)
    scaled = (blocks * (1.0 / scales.clamp(min=TINY))[:, None]).clamp(-1, 1)
    levels = torch.tensor(LEVELS)
    places = torch.zeros(scaled.shape, dtype=torch.uint8)
    for middle in (levels[:-1] + levels[1:]) / 2:  # Several times as fast as torch.bucketize.
        places += scaled > middle
    rounded = levels[places.int()] * _rounded_scales(scales)[:, None]
    return rounded.flatten()[: len(flat)].to(weight.dtype).view(weight.shape)


def _rounded_scales(scales: Tensor) -> Tensor:
    """The scales as they are read back: mean + 8-bit value times the largest of its block."""
    mean = scales.mean()
    shifted = pad(scales - mean, (0, -len(scales) % SCALE_BLOCK)).view(-1, SCALE_BLOCK)
    largest = shifted.abs().amax(1, keepdim=True)
    # The CPU kernel looks values up in a table of 2**16 steps from -1 to 1.
    steps = (shifted * (1.0 / largest.clamp(min=TINY)) + 1) * HALF_TABLE + 0.5
    known = dynamic_values()
    nearest = torch.bucketize(steps.floor() / HALF_TABLE - 1, (known[:-1] + known[1:]) / 2)
    return (known[nearest] * largest).flatten()[: len(scales)] + mean


@functools.cache
def dynamic_values() -> Tensor:
    """The 256 values of the signed dynamic 8-bit type: seven decades, each with twice the steps of
    the one below, zero and one.
    """
    positive = []
    for decade in range(7):
        bounds = torch.linspace(0.1, 1, 2**decade + 1)
        positive.append(10.0 ** (decade - 6) * ((bounds[:-1] + bounds[1:]) / 2.0))
    values = torch.cat(positive)
    return torch.cat([-values, values, torch.tensor([0.0, 1.0])]).sort().values
