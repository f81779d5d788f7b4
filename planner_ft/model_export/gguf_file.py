"""Writing a transformers folder as a GGUF file, the format of llama.cpp.

Names are those of the gguf library, the layout is that of llama.cpp's convert_hf_to_gguf.py:
Llama's query and key rows are reordered, because llama.cpp rotates neighbouring pairs where
transformers rotates halves; Qwen2's are not.

A byte-level BPE tokenizer is written as llama.cpp takes it: tokens, types, merges, and how to split
text. llama.cpp knows a fixed list of ways to split text before merging ("pre-tokenizers",
`llama-vocab.cpp`). Two of them are those of Llama 3 and Qwen2. Any other tokenizer is given the one
that splits least, "superbpe" (runs of digits are cut off from the rest and into threes), since
merges of text that was learned in pieces seldom cross their borders; tokens that hold digits and
something else, which it would tear apart, become user-defined tokens: those are found in the text
before it is split. Whether the ids are the same is then tried out on commands, and a tokenizer for
which they are not is refused.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from enum import IntEnum
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

from planner_ft.candidates.location import read_config, weight_files
from planner_ft.candidates.registry import Dimensions
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_json

if TYPE_CHECKING:
    import numpy as np

    Array = np.ndarray[Any, Any]

LLAMA_3 = (
    r"(?i:'s|'t|'re|'ve|'m|'ll|'d)|[^\r\n\p{L}\p{N}]?\p{L}+|\p{N}{1,3}|"
    r" ?[^\s\p{L}\p{N}]+[\r\n]*|\s*[\r\n]+|\s+(?!\S)|\s+"
)
QWEN_2 = LLAMA_3.replace(r"\p{N}{1,3}", r"\p{N}")
KNOWN = {LLAMA_3: "llama-bpe", QWEN_2: "qwen2"}  # names of llama.cpp's splits by their pattern
LEAST = "superbpe"
LEAST_PATTERNS = (r"\p{N}+", r"(?=(\d{3})+(?!\d))")
CONVERTER = "convert it with llama.cpp's convert_hf_to_gguf.py"
SHORT = 32  # bytes: llama-cpp-python drops longer tokens from an answer's text (its issue 2362)


class Kind(IntEnum):
    """Types of tokens in a GGUF file (gguf.TokenType)."""

    NORMAL = 1
    CONTROL = 3
    USER_DEFINED = 4
    UNUSED = 5


@dataclass(frozen=True)
class TokenTable:
    """`tokens` and `kinds` by id, `merges` as "LEFT RIGHT", and `split` for tokenizer.ggml.pre;
    `added` are the texts, by id, that became user-defined tokens beyond the tokenizer's own.
    """

    tokens: tuple[str, ...]
    kinds: tuple[Kind, ...]
    merges: tuple[str, ...]
    split: str
    added: Mapping[int, str]

    @property
    def long_words(self) -> int:
        """Tokens with letters that are longer than SHORT: a character stands for a byte."""
        pairs = zip(self.tokens, self.kinds, strict=True)
        long = [token for token, kind in pairs if kind == Kind.NORMAL and len(token) > SHORT]
        return sum(any("a" <= sign <= "z" for sign in token) for token in long)


def token_table(path: Path, size: int) -> TokenTable:
    """The table for a model of `size` tokens. Raises PlannerError for no byte-level BPE."""
    settings = read_json(path)
    model, step = settings.get("model", {}), settings.get("pre_tokenizer") or {}
    steps = list(step["pretokenizers"]) if step.get("type") == "Sequence" else [step]
    bytewise = [step for step in steps if step.get("type") == "ByteLevel"]
    plain = model.get("type") == "BPE" and not model.get("byte_fallback")
    plain = plain and settings.get("normalizer") in (None, {"type": "NFC"})
    if not plain or all(step.get("add_prefix_space") for step in bytewise):
        what = "only byte-level BPE tokenizers are written as GGUF here"
        raise PlannerError(f"{path}: {what}; {CONVERTER}")
    patterns = [step["pattern"].get("Regex") for step in steps if step.get("type") == "Split"]
    split = KNOWN.get(patterns[0] or "", LEAST) if len(patterns) == 1 else LEAST
    added = _torn_apart(path, settings) if split == LEAST else {}
    tokens, kinds = [f"[PAD{number}]" for number in range(size)], [Kind.UNUSED] * size
    entries = [(number, text, Kind.NORMAL) for text, number in model["vocab"].items()]
    entries += [
        (one["id"], one["content"], Kind.CONTROL if one["special"] else Kind.USER_DEFINED)
        for one in settings["added_tokens"]
    ]
    entries += [(number, text, Kind.USER_DEFINED) for number, text in added.items()]
    for number, text, kind in entries:
        tokens[number], kinds[number] = text, kind
    merges = [merge if isinstance(merge, str) else " ".join(merge) for merge in model["merges"]]
    return TokenTable(tuple(tokens), tuple(kinds), tuple(merges), split, added)


def check_ids(path: Path, table: TokenTable, texts: Iterable[str]) -> int:
    """The number of texts, all with the same ids in both tokenizers. Raises PlannerError, with the
    first text that differs. llama.cpp's way is computed with the tokenizers library: the same
    merges after the other split.
    """
    from tokenizers import AddedToken, Regex, Tokenizer
    from tokenizers.pre_tokenizers import ByteLevel, Sequence, Split

    ours, theirs = Tokenizer.from_file(str(path)), Tokenizer.from_file(str(path))
    if table.split == LEAST:
        splits = [Split(Regex(pattern), "isolated") for pattern in LEAST_PATTERNS]
        bytewise = ByteLevel(add_prefix_space=False, use_regex=False)
        theirs.pre_tokenizer = Sequence([*splits, bytewise])
        theirs.add_tokens([AddedToken(text, normalized=False) for text in table.added.values()])
    # The library gives the added texts new ids.
    back = {theirs.token_to_id(text): number for number, text in table.added.items()}
    count = 0
    for count, text in enumerate(texts, 1):  # noqa: B007
        found = theirs.encode(text, add_special_tokens=False).ids
        expected = ours.encode(text, add_special_tokens=False).ids
        if expected != [back.get(number, number) for number in found]:
            why = "no way in which llama.cpp splits text gives this tokenizer's ids for"
            raise PlannerError(f"{path}: {why} {text[:80]!r}; {CONVERTER}, if it knows one")
    return count


def _torn_apart(path: Path, settings: dict[str, Any]) -> dict[int, str]:
    """The tokens with digits and other characters that a tokenizer itself can produce, by id."""
    from tokenizers import Tokenizer

    tokenizer = Tokenizer.from_file(str(path))
    own = {entry["content"] for entry in settings["added_tokens"]}
    found = {}
    for token, number in settings["model"]["vocab"].items():
        text = tokenizer.decode([number], skip_special_tokens=False)
        mixed = any(sign.isnumeric() for sign in text) and not text.isnumeric()
        if not mixed or "�" in text or token in own:
            continue
        if tokenizer.encode(text, add_special_tokens=False).ids == [number]:
            found[number] = text
    return found


OutType = Literal["f32", "f16"]
ARCHITECTURES = {"LlamaForCausalLM": "llama", "Qwen2ForCausalLM": "qwen2"}
NOT_HERE = f"is not written as GGUF here; leave out --gguf and {CONVERTER}"
PLAIN_ROPE = ("default", "llama3")
LLAMA_3_ROPE = "low_freq_factor high_freq_factor factor original_max_position_embeddings"


def check_architecture(folder: Path) -> tuple[str, dict[str, Any], Dimensions]:
    """llama.cpp's name of the folder's architecture, its config and its sizes. Raises PlannerError
    when it has none here.
    """
    config = read_config(folder)
    names, sizes = config.get("architectures") or [], Dimensions.from_config(config)
    found = next((ARCHITECTURES[name] for name in names if name in ARCHITECTURES), None)
    rope = _rope(config).get("rope_type", "default")
    plain = rope in PLAIN_ROPE and config.get("hidden_act") == "silu"
    if found is None or not plain or sizes is None:
        what = f"architecture {config.get('architectures')} with positions of type {rope}"
        raise PlannerError(f"{folder}: {what} {NOT_HERE}")
    return found, config, sizes


def write_gguf(
    folder: Path, path: Path, table: TokenTable, tokenizer: Any, name: str, outtype: OutType
) -> None:
    """Write weights and tokenizer of a transformers folder to `path`. Raises PlannerError."""
    gguf = import_gguf()
    architecture, config, sizes = check_architecture(folder)
    half, types = outtype == "f16", gguf.LlamaFileType
    writer = gguf.GGUFWriter(str(path), architecture)
    writer.add_name(name)
    writer.add_file_type(types.MOSTLY_F16 if half else types.ALL_F32)
    _write_settings(writer, config, sizes)
    if architecture == "llama":
        writer.add_rope_dimension_count(sizes.head_dim)
    _write_tokenizer(writer, table, tokenizer)
    for tensor_name, tensor in _tensors(gguf, folder):
        dtype = "float16" if half and tensor.ndim > 1 else "float32"
        writer.add_tensor(tensor_name, tensor.astype(dtype))
    writer.write_header_to_file()
    writer.write_kv_data_to_file()
    writer.write_tensors_to_file()
    writer.close()


def import_gguf() -> Any:
    """The gguf package. Raises PlannerError that says how to install it."""
    try:
        import gguf
    except ImportError:
        way = "install it with: pip install 'planner_ft[export]'"
        raise PlannerError(f"--gguf needs the package gguf; {way}") from None
    return gguf


def _write_settings(writer: Any, config: dict[str, Any], sizes: Dimensions) -> None:
    writer.add_vocab_size(sizes.vocabulary)
    writer.add_block_count(sizes.layers)
    writer.add_context_length(sizes.context)
    writer.add_embedding_length(sizes.hidden)
    writer.add_feed_forward_length(sizes.intermediate)
    writer.add_head_count(sizes.heads)
    writer.add_head_count_kv(sizes.kv_heads)
    writer.add_key_length(sizes.head_dim)
    writer.add_value_length(sizes.head_dim)
    writer.add_layer_norm_rms_eps(float(config["rms_norm_eps"]))
    writer.add_rope_freq_base(float(_rope(config).get("rope_theta", 10000.0)))


def _write_tokenizer(writer: Any, table: TokenTable, tokenizer: Any) -> None:
    from planner_ft.prompts import end_of_turn_ids

    first = tokenizer.bos_token_id
    writer.add_tokenizer_model("gpt2")
    writer.add_tokenizer_pre(table.split)
    writer.add_token_list(list(table.tokens))
    writer.add_token_types([int(kind) for kind in table.kinds])
    writer.add_token_merges(list(table.merges))
    writer.add_eos_token_id(end_of_turn_ids(tokenizer)[0])
    writer.add_pad_token_id(int(tokenizer.pad_token_id))
    if first is not None:
        writer.add_bos_token_id(int(first))
    writer.add_add_bos_token(first is not None and tokenizer.encode("x")[:1] == [first])
    if tokenizer.chat_template:
        writer.add_chat_template(tokenizer.chat_template)


def _tensors(gguf: Any, folder: Path) -> Iterator[tuple[str, Array]]:
    """The tensors under llama.cpp's names, as float32. Raises PlannerError where one has none."""
    import numpy as np
    from safetensors import safe_open

    architecture, config, sizes = check_architecture(folder)
    heads = {"q_proj": sizes.heads, "k_proj": sizes.kv_heads} if architecture == "llama" else {}
    names = gguf.get_tensor_name_map(gguf.MODEL_ARCH[architecture.upper()], sizes.layers)
    if factors := _rope_factors(config, sizes):
        yield "rope_freqs.weight", np.array(factors, dtype=np.float32)
    for path in weight_files(folder):
        with safe_open(str(path), framework="np") as stored:
            for name in stored.keys():  # noqa: SIM118
                if name == "lm_head.weight" and sizes.tied:
                    continue
                known = names.get_name(name, try_suffixes=(".weight", ".bias"))
                if known is None:
                    raise PlannerError(f"{folder}: the tensor {name} {NOT_HERE}")
                tensor, count = stored.get_tensor(name), heads.get(name.split(".")[-2])
                yield known, _interleaved(tensor, count) if count else tensor


def _interleaved(tensor: Array, heads: int) -> Array:
    """Rows of each head from halves (transformers) to neighbouring pairs (llama.cpp)."""
    halves = tensor.reshape(heads, 2, tensor.shape[0] // heads // 2, *tensor.shape[1:])
    return halves.swapaxes(1, 2).reshape(tensor.shape)


def _rope(config: dict[str, Any]) -> dict[str, Any]:
    """The rotary positions' settings; older files hold them in two places."""
    theta = {"rope_theta": config["rope_theta"]} if "rope_theta" in config else {}
    old = {**(config.get("rope_scaling") or {}), **theta}
    return {**old, **(config.get("rope_parameters") or {})}


def _rope_factors(config: dict[str, Any], sizes: Dimensions) -> list[float]:
    """Divisors of rotary frequencies for Llama 3 (transformers' modeling_rope_utils)."""
    rope = _rope(config)
    if rope.get("rope_type") != "llama3":
        return []
    low, high, factor, before = (float(rope[key]) for key in LLAMA_3_ROPE.split())
    factors = []
    for place in range(0, sizes.head_dim, 2):
        wavelength = 2 * math.pi * float(rope["rope_theta"]) ** (place / sizes.head_dim)
        smooth = min(1.0, max(0.0, (before / wavelength - low) / (high - low)))
        factors.append(1.0 / ((1.0 - smooth) / factor + smooth))
    return factors
