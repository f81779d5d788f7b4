"""Small models read straight from their files: importing transformers takes longer than they need.

The weights are as the libraries compute them: rounded to 4 bits as bitsandbytes stores them,
adapters merged as PEFT does it.
"""

from __future__ import annotations

import functools
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import torch
from jinja2.sandbox import ImmutableSandboxedEnvironment
from safetensors.torch import load_file
from tokenizers import Tokenizer
from torch import Tensor
from torch.nn.functional import pad

from planner_ft.candidates.adapters import CONFIG, WEIGHTS
from planner_ft.candidates.loading import compute_dtype
from planner_ft.candidates.location import read_config, weight_files
from planner_ft.candidates.registry import Quantization
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_text

NAMED = ("bos_token", "eos_token", "pad_token")
LAYER = "_proj.weight"
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
NEGATIVE = (
    "-1 -0.6961928009986877 -0.5250730514526367 -0.39491748809814453 -0.28444138169288635"
    " -0.18477343022823334 -0.09105003625154495 0"
)
POSITIVE = (
    "0.07958029955625534 0.16093020141124725 0.24611230194568634 0.33791524171829224"
    " 0.44070982933044434 0.5626170039176941 0.7229568362236023 1"
)
LEVELS = tuple(map(float, f"{NEGATIVE} {POSITIVE}".split()))
"""The sixteen values of NormalFloat: quantiles of the normal distribution, scaled to [-1, 1]."""
HALF_TABLE = (2**16 - 1) / 2
TINY = 1e-38
"""In place of the scale of a block of zeros."""


def read_weights(folder: Path, quantization: Quantization) -> dict[str, Tensor]:
    """The tensors of a folder by name, in the dtype that the CPU computes in; with "nf4" those of
    the layers rounded.
    """
    dtype = compute_dtype(torch.device("cpu"))
    read = (load_file(path).items() for path in weight_files(folder))
    tensors = {name: tensor.to(dtype) for some in read for name, tensor in some}
    layers = [name for name in tensors if name.endswith(LAYER) and quantization == "nf4"]
    return tensors | {name: rounded_to_nf4(tensors[name]) for name in layers}


def merge_adapter(tensors: Mapping[str, Tensor], folder: Path) -> dict[str, Tensor] | None:
    """The tensors with an adapter's matrices added; None where it is more than two a layer."""
    config, matrices = read_config(folder, CONFIG), load_file(folder / WEIGHTS)
    prefix, down, up = LORA
    names = {one: prefix + one.removesuffix(".weight") for one in tensors if one.endswith(LAYER)}
    used = {layer: name for layer, name in names.items() if name + down in matrices}
    # An initialisation with a name (PiSSA, LoftQ ...) changes the base, too.
    plain = config.get("bias") == "none" and isinstance(config.get("init_lora_weights", True), bool)
    others = any(value and name not in PLAIN_LORA for name, value in config.items())
    if (
        not plain
        or others
        or set(matrices) != {one + end for one in used.values() for end in LORA[1:]}
    ):
        return None
    scaling, merged = config["lora_alpha"] / config["r"], dict(tensors)
    for layer, name in used.items():
        added = scaling * (matrices[name + up].float() @ matrices[name + down].float())
        merged[layer] = (tensors[layer].float() + added).to(tensors[layer].dtype)
    return merged


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


class FileTokenizer:
    """The tokenizer of a folder with tokenizer.json: what rendering and decoding use of those of
    transformers, under the same names and with the same results.
    """

    def __init__(self, backend: Any, settings: dict[str, Any], chat_template: str | None) -> None:
        self.backend_tokenizer, self.chat_template = backend, chat_template
        named = [settings.get(name) for name in NAMED]
        self.bos_token, self.eos_token, self.pad_token = named
        ids = (backend.token_to_id(token) if token else None for token in named)
        self.bos_token_id, self.eos_token_id, self.pad_token_id = ids
        self.added_tokens_decoder = backend.get_added_tokens_decoder()
        special = (index for index, token in self.added_tokens_decoder.items() if token.special)
        self.all_special_ids = list(special)

    @classmethod
    def read(cls, folder: Path) -> FileTokenizer | None:
        """A folder's tokenizer, None where transformers must load it. Raises PlannerError."""
        settings = read_config(folder, "tokenizer_config.json")
        if settings.get("tokenizer_class") != "TokenizersBackend":
            return None
        try:
            backend = Tokenizer.from_file(str(folder / "tokenizer.json"))
        except Exception as error:  # the library raises bare Exception
            why = f"the tokenizer cannot be loaded ({error}); download its files again"
            raise PlannerError(f"{folder}: {why}") from error
        named = [settings.get(name) for name in NAMED]
        more = settings.get("extra_special_tokens") or []
        known = {token.content for token in backend.get_added_tokens_decoder().values()}
        plain = all(isinstance(token, str) and token in known for token in (*named, *more))
        if not plain or settings.get("added_tokens_decoder"):
            return None
        template = folder / "chat_template.jinja"
        text = read_text(template) if template.is_file() else settings.get("chat_template")
        return cls(backend, settings, text)

    def __len__(self) -> int:
        return int(self.backend_tokenizer.get_vocab_size())

    def __call__(
        self, texts: Sequence[str], *, add_special_tokens: bool = True
    ) -> dict[str, list[list[int]]]:
        return {"input_ids": [self.encode(text, add_special_tokens) for text in texts]}

    def encode(
        self, text: str, add_special_tokens: bool = True, split_special_tokens: bool = False
    ) -> list[int]:
        """Ids of a text. With `split_special_tokens`, special tokens in it are text."""
        self.backend_tokenizer.encode_special_tokens = split_special_tokens
        encoded = self.backend_tokenizer.encode(text, add_special_tokens=add_special_tokens)
        return list(encoded.ids)

    def decode(
        self,
        ids: Sequence[int],
        *,
        skip_special_tokens: bool = False,
        clean_up_tokenization_spaces: bool = False,
    ) -> str:
        """The text of ids; spaces are never cleaned up."""
        text = self.backend_tokenizer.decode(list(ids), skip_special_tokens=skip_special_tokens)
        return str(text)

    def apply_chat_template(self, messages: Sequence[dict[str, str]], **values: Any) -> str:
        """The messages as the chat template writes them."""
        tokens = {name: getattr(self, name) for name in NAMED}
        return str(self._template.render(messages=messages, **{**tokens, **values}))

    @functools.cached_property
    def _template(self) -> Any:
        blocks = {"trim_blocks": True, "lstrip_blocks": True}
        made = ImmutableSandboxedEnvironment(extensions=["jinja2.ext.loopcontrols"], **blocks)
        return made.from_string(self.chat_template or "")
