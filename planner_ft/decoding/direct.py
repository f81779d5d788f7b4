"""Lean decoders read straight from a candidate's files.

Importing what transformers, PEFT and bitsandbytes need for a model takes longer than a small model
needs to plan. What they would load is computed here from the files: the weights, 4-bit rounding
(`nf4`), the adapters. A candidate, adapter or setting that this module does not know is left to
them.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from planner_ft.candidates import Candidate, Dimensions
from planner_ft.candidates.adapters import CONFIG, WEIGHTS, check_adapter
from planner_ft.candidates.loading import compute_dtype, require_folder, resolve_device
from planner_ft.candidates.location import check_safetensors, read_config, weight_files
from planner_ft.candidates.nf4 import BLOCK, rounded_to_nf4
from planner_ft.candidates.registry import Quantization
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import Level

if TYPE_CHECKING:
    from torch import Tensor

    from planner_ft.decoding.lean import Layer, LeanDecoder

LAYER = "model.layers"
QUERY, KEY, VALUE, OUT = (f"self_attn.{name}_proj" for name in "qkvo")
GATE, UP, DOWN = (f"mlp.{name}_proj" for name in ("gate", "up", "down"))
NORMS = ("input_layernorm", "post_attention_layernorm")
PREFIX, DOWNWARD, UPWARD = "base_model.model.", ".lora_A.weight", ".lora_B.weight"
PLAIN_ADAPTER = {
    "auto_mapping",
    "base_model_name_or_path",
    "inference_mode",
    "init_lora_weights",
    "lora_alpha",
    "lora_dropout",
    "megatron_core",
    "peft_type",
    "peft_version",
    "qalora_group_size",
    "r",
    "revision",
    "target_modules",
    "task_type",
}
"""Settings of an adapter that do not change how its matrices are applied, or that are read here.
Any other that is on is not plain LoRA.
"""


@dataclass(frozen=True)
class Direct:
    """A candidate's lean decoders by adapter (None: the base alone), its end tokens and the size of
    its token vocabulary.
    """

    forms: dict[Level | None, LeanDecoder]
    end_ids: tuple[int, ...]
    tokens: int


def read_directly(
    candidate: Candidate,
    adapters: Mapping[Level, Path],
    *,
    quantization: Quantization,
    vocabulary: Vocabulary | None = None,
) -> Direct | None:
    """The candidate on a CPU with its adapters, or None where transformers has to load it. Raises
    PlannerError for an adapter that does not fit.
    """
    folder = require_folder(candidate)
    for level, path in adapters.items():
        check_adapter(path, candidate, level=level, vocabulary=vocabulary)
    config, sizes = read_config(folder), candidate.dimensions
    if (
        sizes is None
        or not _is_plain(config)
        or not all(_is_plain_adapter(path, sizes) for path in adapters.values())
    ):
        return None
    base = _Base.read(folder, sizes, config, quantization)
    if base is None:
        return None
    forms: dict[Level | None, LeanDecoder] = {None: base.decoder({})}
    forms.update({level: base.decoder(_corrections(path)) for level, path in adapters.items()})
    return Direct(forms, _end_ids(folder, config), sizes.vocabulary)


def _is_plain(config: Mapping[str, Any]) -> bool:
    """Whether a config.json is of a model that is computed here: Llama without biases, plain rotary
    positions.
    """
    rope = config.get("rope_parameters") or {}
    wanted = {
        "model_type": "llama",
        "hidden_act": "silu",
        "attention_bias": False,
        "mlp_bias": False,
        "tie_word_embeddings": True,
    }
    return (
        all(config.get(name) == value for name, value in wanted.items())
        and set(rope) == {"rope_type", "rope_theta"}
        and rope["rope_type"] == "default"
    )


def _is_plain_adapter(folder: Path, sizes: Dimensions) -> bool:
    """Whether an adapter is a pair of matrices for some of the linear layers and nothing else."""
    config, names = read_config(folder, CONFIG), set(check_safetensors(folder / WEIGHTS))
    known = {
        f"{PREFIX}{name.removesuffix('.weight')}{end}"
        for name in _shapes(sizes)
        if "_proj" in name
        for end in (DOWNWARD, UPWARD)
    }
    pairs = all(
        name.replace(DOWNWARD, UPWARD) in names and name.replace(UPWARD, DOWNWARD) in names
        for name in names
    )
    # An initialisation with a name (PiSSA, LoftQ ...) changes the base, too.
    plain = config.get("bias") == "none" and isinstance(config.get("init_lora_weights", True), bool)
    others = [
        name for name, value in config.items() if value and name not in PLAIN_ADAPTER | {"bias"}
    ]
    return plain and not others and pairs and names <= known


@dataclass(frozen=True)
class _Base:
    """The tensors of a base by name, linear layers as they compute."""

    tensors: dict[str, Tensor]
    sizes: Dimensions
    rotary: Rotary
    epsilon: float

    @classmethod
    def read(
        cls, folder: Path, sizes: Dimensions, config: Mapping[str, Any], quantization: Quantization
    ) -> _Base | None:
        """The base in a folder, None where its tensors are not those that the configuration
        says.
        """
        from safetensors.torch import load_file

        dtype = compute_dtype(resolve_device("cpu"))
        tensors: dict[str, Tensor] = {}
        for path in weight_files(folder):
            tensors |= {name: tensor.to(dtype) for name, tensor in load_file(path).items()}
        expected = _shapes(sizes)
        if {name: tuple(tensor.shape) for name, tensor in tensors.items()} != expected:
            return None
        if quantization == "nf4":
            linear = [name for name in expected if "_proj" in name]
            if any(tensors[name].numel() % BLOCK for name in linear):
                return None
            tensors |= {name: rounded_to_nf4(tensors[name]) for name in linear}
        return cls(
            tensors,
            sizes,
            Rotary(float(config["rope_parameters"]["rope_theta"]), sizes.head_dim),
            float(config["rms_norm_eps"]),
        )

    def decoder(self, corrections: Mapping[str, Tensor]) -> LeanDecoder:
        """The decoder with what an adapter adds to the linear layers, by name."""
        from planner_ft.decoding.lean import LeanDecoder

        sizes, embeddings = self.sizes, self.tensors["model.embed_tokens.weight"]
        return LeanDecoder(
            tuple(self._layer(f"{LAYER}.{index}", corrections) for index in range(sizes.layers)),
            embeddings,
            self.tensors["model.norm.weight"].float(),
            embeddings,
            self.rotary,
            sizes.heads,
            sizes.kv_heads,
            sizes.head_dim,
            self.epsilon,
            sizes.context,
        )

    def _layer(self, name: str, corrections: Mapping[str, Tensor]) -> Layer:
        import torch

        from planner_ft.decoding.lean import Layer

        def weight(*parts: str) -> Tensor:
            return torch.cat([self._weight(f"{name}.{part}", corrections) for part in parts])

        norm, feed_norm = (self.tensors[f"{name}.{part}.weight"].float() for part in NORMS)
        return Layer(
            norm,
            weight(QUERY, KEY, VALUE),
            None,
            weight(OUT),
            None,
            feed_norm,
            weight(GATE, UP),
            None,
            weight(DOWN),
            None,
        )

    def _weight(self, name: str, corrections: Mapping[str, Tensor]) -> Tensor:
        weight = self.tensors[f"{name}.weight"]
        return (
            (weight.float() + corrections[name]).to(weight.dtype) if name in corrections else weight
        )


def _shapes(sizes: Dimensions) -> dict[str, tuple[int, ...]]:
    """Shapes of all tensors of a base by name."""
    linear = dict(zip((QUERY, KEY, VALUE, OUT, GATE, UP, DOWN), sizes.linear_shapes, strict=True))
    shapes: dict[str, tuple[int, ...]] = {
        "model.embed_tokens.weight": (sizes.vocabulary, sizes.hidden),
        "model.norm.weight": (sizes.hidden,),
    }
    for index in range(sizes.layers):
        shapes |= {
            f"{LAYER}.{index}.{part}.weight": (columns, rows)
            for part, (rows, columns) in linear.items()
        }
        shapes |= {f"{LAYER}.{index}.{part}.weight": (sizes.hidden,) for part in NORMS}
    return shapes


def _corrections(folder: Path) -> dict[str, Tensor]:
    """What an adapter adds to each linear layer, by the layer's name."""
    from safetensors.torch import load_file

    config, tensors = read_config(folder, CONFIG), load_file(folder / WEIGHTS)
    scaling = config["lora_alpha"] / config["r"]
    names = [name.removesuffix(DOWNWARD) for name in tensors if name.endswith(DOWNWARD)]
    return {
        name.removeprefix(PREFIX): (
            scaling * (tensors[name + UPWARD].float() @ tensors[name + DOWNWARD].float())
        )
        for name in names
    }


@dataclass(frozen=True)
class Rotary:
    """Rotary positions, called as transformers' module is."""

    theta: float
    size: int

    def __call__(self, states: Tensor, positions: Tensor) -> tuple[Tensor, Tensor]:
        """Cosine and sine, (1, positions, size), in the dtype of `states`."""
        import torch

        frequencies = 1.0 / self.theta ** (torch.arange(0, self.size, 2).float() / self.size)
        angles = (positions[:, :, None].float() * frequencies).repeat(1, 1, 2)
        return angles.cos().to(states.dtype), angles.sin().to(states.dtype)


def _end_ids(folder: Path, config: Mapping[str, Any]) -> tuple[int, ...]:
    """End tokens that the generation settings name."""
    named = read_config(folder, "generation_config.json").get(
        "eos_token_id", config.get("eos_token_id")
    )
    return (named,) if isinstance(named, int) else tuple(named or ())
