"""The GGUF file, read back by transformers, which knows the format from llama.cpp: same weights,
same answers, same ids.
"""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
import torch

from planner_ft.candidates import resolve_candidate
from planner_ft.data.missions import sample_missions
from planner_ft.model_export import Exported, ExportSettings, export
from planner_ft.model_export.gguf_file import (
    Kind,
    TokenTable,
    _rope_factors,
    check_architecture,
    check_ids,
    token_table,
)
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import write_json

from .conftest import LLAMA, QWEN

gguf = pytest.importorskip("gguf")
IDS = torch.tensor([[1, 5, 9, 200, 7]])
EMBEDDED = Path(str(resolve_candidate("embedded").folder))


def fields(path: Path) -> dict[str, Any]:
    return {name: field.contents() for name, field in gguf.GGUFReader(str(path)).fields.items()}


@pytest.mark.parametrize("name", [LLAMA, QWEN])
def test_another_reader_finds_the_same_model(exported: Callable[..., Exported], name: str) -> None:
    from transformers import AutoModelForCausalLM

    done = exported(name, gguf=True)
    assert done.gguf is not None and done.gguf.parent == done.folder
    settings = fields(done.gguf)
    ours = AutoModelForCausalLM.from_pretrained(str(done.folder), dtype=torch.float32)
    theirs = AutoModelForCausalLM.from_pretrained(
        str(done.folder), gguf_file=done.gguf.name, dtype=torch.float32
    )
    weights = theirs.state_dict()
    for key, tensor in ours.state_dict().items():
        assert torch.equal(weights[key], tensor), key
    assert settings["general.architecture"] == ("llama" if name == LLAMA else "qwen2")
    assert settings["tokenizer.ggml.pre"] == ("llama-bpe" if name == LLAMA else "qwen2")
    assert "chat_template" in " ".join(settings)


def test_matrices_in_16_bits_are_half_as_large(
    exported: Callable[..., Exported], tmp_path: Path
) -> None:
    small = exported(gguf=True, outtype="f16").gguf
    assert small is not None
    kinds = {
        tensor.name: (tensor.tensor_type.name, len(tensor.shape))
        for tensor in gguf.GGUFReader(str(small)).tensors
    }
    assert {kind for kind, dimensions in kinds.values() if dimensions == 2} == {"F16"}
    assert {kind for kind, dimensions in kinds.values() if dimensions == 1} == {"F32"}


def test_rope_factors_are_those_of_transformers() -> None:
    """Llama 3's scaled positions: frequency / factor is what transformers computes with."""
    from transformers import LlamaConfig
    from transformers.modeling_rope_utils import ROPE_INIT_FUNCTIONS

    from planner_ft.candidates.registry import Dimensions

    scaling = {
        "factor": 32.0,
        "low_freq_factor": 1.0,
        "high_freq_factor": 4.0,
        "original_max_position_embeddings": 8192,
    }
    rope = {"rope_type": "llama3", "rope_theta": 500000.0, **scaling}
    config = LlamaConfig(
        hidden_size=128,
        num_attention_heads=2,
        head_dim=64,
        max_position_embeddings=131072,
        rope_parameters=rope,
    )
    expected, _scale = ROPE_INIT_FUNCTIONS["llama3"](config, torch.device("cpu"))
    sizes = Dimensions.from_config(config.to_dict())
    assert sizes is not None
    plain = 500000.0 ** -(torch.arange(0, 64, 2) / 64)
    found = torch.tensor(_rope_factors({"rope_parameters": rope}, sizes))
    assert len(set(found.tolist())) > 3 and torch.allclose(plain / found, expected, rtol=1e-5)
    assert (
        _rope_factors({"rope_parameters": {"rope_type": "default", "rope_theta": 1e4}}, sizes) == []
    )


def test_the_embedded_candidates_tokens_are_the_same_after_llama_cpps_split() -> None:
    from tokenizers import Tokenizer

    path = EMBEDDED / "tokenizer.json"
    table = token_table(path, json.loads((EMBEDDED / "config.json").read_text())["vocab_size"])
    texts = [record["prompt"] for record in sample_missions(7, 200)] + [
        'Transit\n{"target_position":[-99,-99],"speed":1.25}\nGo 12 m on, 3 times.'
    ]
    assert table.split == "superbpe" and " 7" in table.added.values()
    assert check_ids(path, table, texts) == 201
    kinds = dict(zip(table.tokens, table.kinds, strict=True))
    assert (kinds["<|end|>"], kinds[" 7"]) == (Kind.CONTROL, Kind.USER_DEFINED)
    library = Tokenizer.from_file(str(path))
    pieces = [
        library.decode([number])
        for number in range(library.get_vocab_size(with_added_tokens=False))
    ]
    assert (
        table.long_words
        == sum(
            len(piece.encode()) > 32 and any("a" <= sign <= "z" for sign in piece)
            for piece in pieces
        )
        > 0
    )
    without = TokenTable(table.tokens, table.kinds, table.merges, table.split, {})
    with pytest.raises(
        PlannerError, match=r"no way in which llama.cpp splits text .* convert_hf_to_gguf.py"
    ):
        check_ids(path, without, texts)


def test_what_is_not_written_here_is_one_sentence(tmp_path: Path) -> None:
    write_json(
        tmp_path / "config.json",
        {
            **json.loads((EMBEDDED / "config.json").read_text()),
            "architectures": ["GemmaForCausalLM"],
        },
    )
    with pytest.raises(
        PlannerError, match=r"architecture \['GemmaForCausalLM'\].* convert_hf_to_gguf.py"
    ):
        check_architecture(tmp_path)
    settings = json.loads((EMBEDDED / "tokenizer.json").read_text())
    write_json(
        tmp_path / "tokenizer.json", {**settings, "model": {**settings["model"], "type": "Unigram"}}
    )
    with pytest.raises(PlannerError, match="only byte-level BPE"):
        token_table(tmp_path / "tokenizer.json", 4098)


def test_a_missing_package_is_one_sentence(
    models: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "gguf", None)
    with pytest.raises(PlannerError, match=r"pip install 'planner_ft\[export\]'"):
        export(ExportSettings(LLAMA, tmp_path / "out", gguf=True))


def test_help_names_the_flags() -> None:
    shown = subprocess.run(
        [sys.executable, "-m", "planner_ft", "export", "--help"],
        capture_output=True,
        text=True,
        check=True,
        env={"COLUMNS": "200"},
    ).stdout
    assert all(flag in shown for flag in ("--merge", "--gguf", "--outtype", "--check-data"))
