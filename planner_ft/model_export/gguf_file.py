"""Writing a transformers folder as a GGUF file, the format of llama.cpp, for the architectures of
the candidates.

Names and layout follow llama.cpp's convert_hf_to_gguf.py: Llama's query and key rows are reordered,
because llama.cpp rotates neighbouring pairs where transformers rotates halves; Qwen2's are not.
"""

from __future__ import annotations

import math
import os
import secrets
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

from planner_ft.candidates.location import read_config, weight_files
from planner_ft.candidates.registry import Dimensions
from planner_ft.model_export.gguf_tokens import CONVERTER, TokenTable
from planner_ft.model_export.settings import OutType
from planner_ft.support.errors import PlannerError

if TYPE_CHECKING:
    import numpy as np

ARCHITECTURES = {"LlamaForCausalLM": "llama", "Qwen2ForCausalLM": "qwen2"}
OF_MODEL = {"model.embed_tokens": "token_embd", "model.norm": "output_norm", "lm_head": "output"}
OF_LAYER = {
    "input_layernorm": "attn_norm",
    "self_attn.q_proj": "attn_q",
    "self_attn.k_proj": "attn_k",
    "self_attn.v_proj": "attn_v",
    "self_attn.o_proj": "attn_output",
    "post_attention_layernorm": "ffn_norm",
    "mlp.gate_proj": "ffn_gate",
    "mlp.up_proj": "ffn_up",
    "mlp.down_proj": "ffn_down",
}
LAYER = "model.layers."
PLAIN_ROPE = ("default", "llama3")


def check_architecture(folder: Path) -> str:
    """llama.cpp's name of the folder's architecture. Raises PlannerError when it is none that is
    written here.
    """
    config = read_config(folder)
    found = next(
        (
            ARCHITECTURES[name]
            for name in config.get("architectures") or []
            if name in ARCHITECTURES
        ),
        None,
    )
    rope = _rope(config).get("rope_type", "default")
    if (
        found is None
        or rope not in PLAIN_ROPE
        or config.get("hidden_act") != "silu"
        or Dimensions.from_config(config) is None
    ):
        what = f"architecture {config.get('architectures')} with positions of type {rope}"
        raise PlannerError(
            f"{folder}: {what} is not written as GGUF here; leave out --gguf and {CONVERTER}"
        )
    return found


def write_gguf(
    folder: Path,
    path: Path,
    table: TokenTable,
    tokenizer: Any,
    *,
    name: str,
    outtype: OutType = "f32",
) -> None:
    """Write weights and tokenizer of a transformers folder to `path`, atomically. Raises
    PlannerError.
    """
    gguf = import_gguf()
    architecture = check_architecture(folder)
    temporary = path.with_name(f".{path.name}.{os.getpid()}.{secrets.token_hex(3)}.tmp")
    writer = gguf.GGUFWriter(str(temporary), architecture)
    try:
        _write_settings(writer, gguf, read_config(folder), architecture, name, outtype)
        _write_tokenizer(writer, table, tokenizer)
        for tensor_name, tensor in _tensors(folder, architecture):
            halved = outtype == "f16" and tensor.ndim > 1
            writer.add_tensor(tensor_name, tensor.astype("float16" if halved else "float32"))
        writer.write_header_to_file()
        writer.write_kv_data_to_file()
        writer.write_tensors_to_file()
        writer.close()
        temporary.replace(path)
    except OSError as error:
        raise PlannerError(
            f"{path}: cannot be written ({error.strerror or error}); choose another folder or free"
            " some space"
        ) from error
    finally:
        temporary.unlink(missing_ok=True)


def import_gguf() -> Any:
    """The gguf package. Raises PlannerError that says how to install it."""
    try:
        import gguf
    except ImportError:
        raise PlannerError(
            "--gguf needs the package gguf; install it with: pip install 'planner_ft[export]'"
        ) from None
    return gguf


def _write_settings(
    writer: Any, gguf: Any, config: dict[str, Any], architecture: str, name: str, outtype: OutType
) -> None:
    sizes = Dimensions.from_config(config)
    assert sizes is not None  # check_architecture has read them
    writer.add_name(name)
    writer.add_file_type(
        gguf.LlamaFileType.MOSTLY_F16 if outtype == "f16" else gguf.LlamaFileType.ALL_F32
    )
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
    if architecture == "llama":
        writer.add_rope_dimension_count(sizes.head_dim)


def _write_tokenizer(writer: Any, table: TokenTable, tokenizer: Any) -> None:
    from planner_ft.prompts import end_of_turn_ids

    writer.add_tokenizer_model("gpt2")
    writer.add_tokenizer_pre(table.split)
    writer.add_token_list(list(table.tokens))
    writer.add_token_types([int(kind) for kind in table.kinds])
    writer.add_token_merges(list(table.merges))
    writer.add_eos_token_id(end_of_turn_ids(tokenizer)[0])
    writer.add_pad_token_id(int(tokenizer.pad_token_id))
    if tokenizer.bos_token_id is not None:
        writer.add_bos_token_id(int(tokenizer.bos_token_id))
    writer.add_add_bos_token(
        tokenizer.bos_token_id is not None and tokenizer.encode("x")[:1] == [tokenizer.bos_token_id]
    )
    if tokenizer.chat_template:
        writer.add_chat_template(tokenizer.chat_template)


def _tensors(folder: Path, architecture: str) -> Iterator[tuple[str, np.ndarray[Any, Any]]]:
    """The tensors under llama.cpp's names, as float32. Raises PlannerError for one that has
    none.
    """
    from safetensors import safe_open

    config = read_config(folder)
    sizes = Dimensions.from_config(config)
    assert sizes is not None
    if factors := _rope_factors(config, sizes):
        import numpy as np

        yield "rope_freqs.weight", np.array(factors, dtype=np.float32)
    for path in weight_files(folder):
        with safe_open(str(path), framework="np") as stored:
            for name in stored.keys():  # noqa: SIM118
                if name == "lm_head.weight" and sizes.tied:
                    continue
                heads = (
                    {"q_proj": sizes.heads, "k_proj": sizes.kv_heads}.get(name.split(".")[-2])
                    if architecture == "llama"
                    else None
                )
                tensor = stored.get_tensor(name)
                yield _gguf_name(folder, name), _interleaved(tensor, heads) if heads else tensor


def _gguf_name(folder: Path, name: str) -> str:
    stem, _, kind = name.rpartition(".")
    if name.startswith(LAYER):
        number, _, part = stem.removeprefix(LAYER).partition(".")
        if part in OF_LAYER:
            return f"blk.{number}.{OF_LAYER[part]}.{kind}"
    elif stem in OF_MODEL:
        return f"{OF_MODEL[stem]}.{kind}"
    raise PlannerError(
        f"{folder}: the tensor {name} has no place in a GGUF file as it is written here; leave out"
        f" --gguf and {CONVERTER}"
    )


def _interleaved(tensor: np.ndarray[Any, Any], heads: int) -> np.ndarray[Any, Any]:
    """Rows of each head from halves (transformers) to neighbouring pairs (llama.cpp)."""
    return (
        tensor.reshape(heads, 2, tensor.shape[0] // heads // 2, *tensor.shape[1:])
        .swapaxes(1, 2)
        .reshape(tensor.shape)
    )


def _rope(config: dict[str, Any]) -> dict[str, Any]:
    """The rotary positions' settings; older files hold them in two places."""
    old = {
        **(config.get("rope_scaling") or {}),
        **({"rope_theta": config["rope_theta"]} if "rope_theta" in config else {}),
    }
    return {**old, **(config.get("rope_parameters") or {})}


def _rope_factors(config: dict[str, Any], sizes: Dimensions) -> list[float]:
    """What llama.cpp divides each rotary frequency by, for Llama 3's scaling (Llama 3.1 model card,
    `transformers` modeling_rope_utils).
    """
    rope = _rope(config)
    if rope.get("rope_type") != "llama3":
        return []
    low, high, factor, before = (
        float(rope[key])
        for key in (
            "low_freq_factor",
            "high_freq_factor",
            "factor",
            "original_max_position_embeddings",
        )
    )
    factors = []
    for place in range(0, sizes.head_dim, 2):
        wavelength = 2 * math.pi * float(rope["rope_theta"]) ** (place / sizes.head_dim)
        smooth = min(1.0, max(0.0, (before / wavelength - low) / (high - low)))
        factors.append(1.0 / ((1.0 - smooth) / factor + smooth))
    return factors
