"""Small models read from their files compute what transformers, PEFT and bitsandbytes compute, and
give each position its numbers whatever is computed beside it.
"""

from __future__ import annotations

import shutil
from collections import Counter
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
import torch
from torch import Tensor

from planner_ft.candidates import Candidate, resolve_candidate
from planner_ft.candidates.adapters import adapter_record
from planner_ft.candidates.loading import compute_dtype, load_model
from planner_ft.candidates.weights import dynamic_values, rounded_to_nf4
from planner_ft.decoding.forward import (
    BLOCK,
    KEYS,
    SmallModel,
    SmallPasses,
    attention,
    read_forms,
    small_model,
)
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_json, write_json
from planner_ft.vocabulary import load_vocabulary
from planner_ft.vocabulary.plans import Level
from tests.candidates.test_loading import SEVEN
from tests.decoding.conftest import small

IDS = [(7 * step * step + 3) % 61 + 3 for step in range(300)]
EMBEDDED = resolve_candidate("embedded")
LLAMA_3 = {
    "rope_type": "llama3",
    "rope_theta": 500000.0,
    "factor": 8.0,
    "low_freq_factor": 1.0,
    "high_freq_factor": 4.0,
    "original_max_position_embeddings": 64,
}
LINEAR_POSITIONS = {"rope_type": "linear", "rope_theta": 10000.0, "factor": 2.0}
MODELS: dict[str, dict[str, Any]] = {
    "one key head": {"num_key_value_heads": 1},
    "all key heads": {"num_key_value_heads": 4},
    "shared embeddings": {"tie_word_embeddings": True},
    "biases": {"attention_bias": True, "mlp_bias": True},
    "heads of another size": {"head_dim": 12},
    "Llama 3 positions": {"rope_parameters": LLAMA_3},
    "linear positions": {"rope_parameters": LINEAR_POSITIONS},
}
BFLOAT16 = compute_dtype(torch.device("cpu")) == torch.bfloat16
CLOSE = {"atol": 0.5, "rtol": 0.1} if BFLOAT16 else {"atol": 5e-3, "rtol": 1e-3}
bits = pytest.mark.skipif(
    not BFLOAT16, reason="bit by bit the same only where the CPU multiplies bfloat16"
)


def read(
    candidate: Candidate = EMBEDDED, adapters: dict[Level, Path] | None = None, **settings: Any
) -> dict[Level | None, SmallModel] | None:
    return read_forms(candidate, adapters or {}, **{"quantization": "nf4", **settings})


def logits(model: SmallModel, ids: list[int], first: int, step: int) -> Tensor:
    """Logits from position `first - 1` on, fed in pieces of `step`."""
    passes = model.start(1)
    parts = [passes.run([ids[:first]], [1])]
    for start in range(first, len(ids), step):
        piece = ids[start : start + step]
        parts.append(passes.run([piece], [len(piece)]))
    return torch.cat(parts)


def save_adapter(candidate: Candidate, folder: Path) -> Path:
    """A mission adapter that changes answers."""
    from peft import LoraConfig, get_peft_model

    torch.manual_seed(0)
    config = LoraConfig(
        r=4,
        lora_alpha=6,
        target_modules=["q_proj", "o_proj", "up_proj", "down_proj"],
        task_type="CAUSAL_LM",
        init_lora_weights=False,
    )
    model = get_peft_model(load_model(candidate, device="cpu", trainable=True), config)
    model.save_pretrained(folder, save_embedding_layers=False)
    write_json(folder / "manifest.json", adapter_record(candidate, "mission", load_vocabulary()))
    return folder


@pytest.fixture(scope="module")
def trained(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return save_adapter(EMBEDDED, tmp_path_factory.mktemp("mission"))


@pytest.fixture
def adapter(trained: Path, tmp_path: Path) -> Path:
    """A copy to change."""
    return Path(shutil.copytree(trained, tmp_path / "adapter"))


@pytest.mark.parametrize("name", [*SEVEN, "embedded"])
@pytest.mark.parametrize("quantization", ["nf4", "none"])
@torch.inference_mode()
def test_every_candidate_computes_what_the_libraries_compute(
    models: Path, tmp_path: Path, name: str, quantization: Any
) -> None:
    candidate = resolve_candidate(name)
    adapters: dict[Level, Path] = {"mission": save_adapter(candidate, tmp_path)}
    forms = read(candidate, adapters, quantization=quantization)
    assert forms is not None and set(forms) == {None, "mission"}
    settings: Any = {"quantization": quantization, "adapters": adapters, "trainable": True}
    model: Any = load_model(candidate, device="cpu", **settings)
    ids = torch.tensor([IDS])
    adapted = model(input_ids=ids).logits[0]
    with model.disable_adapter():
        base = model(input_ids=ids).logits[0]
    assert torch.allclose(forms["mission"].start(1).run([IDS], [300]), adapted, **CLOSE)
    assert torch.allclose(forms[None].start(1).run([IDS], [300]), base, **CLOSE)
    assert torch.allclose(logits(forms[None], IDS, 37, 5), base[36:], **CLOSE)
    assert not torch.allclose(adapted, base, **CLOSE)


def randomise(model: Any) -> Any:
    """Biases and norms that are not zero and one."""
    with torch.no_grad():
        for name, value in model.named_parameters():
            if name.endswith("bias") or "norm" in name:
                value.uniform_(0.5, 1.5)
    return model


@pytest.mark.parametrize("name", MODELS)
@torch.inference_mode()
def test_logits_of_other_settings_are_those_of_transformers(
    make_llama: Callable[..., Any], name: str
) -> None:
    model = randomise(make_llama(**MODELS[name]))
    expected = model(input_ids=torch.tensor([IDS])).logits[0]
    found = small(model).start(1).run([IDS], [len(IDS)])
    assert torch.allclose(found, expected, atol=2e-3, rtol=1e-3)
    assert torch.allclose(logits(small(model), IDS, 37, 5), expected[36:], atol=2e-3, rtol=1e-3)


@torch.inference_mode()
def test_rows_of_a_batch_have_their_own_positions(toy_model: Any) -> None:
    model = small(toy_model)
    rows = [IDS[:90], IDS[40:47], IDS[100:240]]
    alone = [logits(model, row, 3, 1) for row in rows]
    passes = model.start(3)
    together = passes.run([row[:3] for row in rows], [1, 1, 1])
    assert torch.allclose(together, torch.cat([part[:1] for part in alone]), atol=1e-4)
    passes.run([row[3:5] for row in rows], [1, 1, 1])
    passes.forget([2, 1, 0])
    fed = passes.run([rows[0][3:7], rows[1][4:7], rows[2][5:12]], [4, 3, 7])
    passes.select([0, 2])
    fed = torch.cat([fed, passes.run([rows[0][7:40], rows[2][12:14]], [33, 2])])
    expected = [alone[0][1:5], alone[1][2:5], alone[2][3:10], alone[0][5:38], alone[2][10:12]]
    assert torch.allclose(fed, torch.cat(expected), atol=1e-4)


@bits
@torch.inference_mode()
def test_in_bfloat16_a_position_has_the_same_bits_in_every_pass(
    make_llama: Callable[..., Any],
) -> None:
    model = small(
        make_llama(hidden_size=128, intermediate_size=352, initializer_range=0.1).bfloat16()
    )
    one_by_one = logits(model, IDS, 30, 1)
    assert one_by_one.dtype == torch.bfloat16
    for first, step in ((30, 2), (30, 5), (30, 8), (30, 13), (30, 90)):
        assert torch.equal(logits(model, IDS, first, step), one_by_one)
    assert torch.equal(model.start(1).run([IDS[:70]], [41]), one_by_one[:41])
    passes = model.start(4)
    passes.run([IDS[:200], IDS[:30], IDS[:130], IDS[:31]], [1] * 4)
    fed = passes.run([IDS[200:204], IDS[30:37], IDS[130:131], IDS[31:33]], [4, 7, 1, 2])
    expected = [one_by_one[171:175], one_by_one[1:8], one_by_one[101:102], one_by_one[2:4]]
    assert torch.equal(fed, torch.cat(expected))


def test_what_long_prompts_have_in_common_is_computed_once(
    toy_model: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    model, alone = small(toy_model), small(toy_model)
    computed = Counter[str]()
    run = SmallPasses._run

    def counted(self: SmallPasses, rows: Any, starts: Any, feeds: Any, wanted: Any) -> Tensor:
        computed["kept" if self.model is model else "alone"] += sum(map(len, feeds))
        return run(self, rows, starts, feeds, wanted)

    monkeypatch.setattr(SmallPasses, "_run", counted)
    prompts = [IDS, [*IDS[:280], 5, 6, 7], [*IDS[:280], 9, 9], [8, *IDS[:200]]]
    for prompt in prompts:
        expected = alone.start(1).run([prompt], [2])
        alone.last_prompt.clear()
        passes = model.start(1)
        assert torch.allclose(passes.run([prompt], [2]), expected, atol=1e-4)
        assert torch.equal(passes.run([[3]], [1]).argmax(-1), _next(alone, prompt))
        alone.last_prompt.clear()
    whole = sum(map(len, prompts))
    assert computed["kept"] == whole - 2 * 280 + len(prompts)


def _next(model: SmallModel, prompt: list[int]) -> Tensor:
    """The choice behind a prompt and the token 3."""
    return model.start(1).run([[*prompt, 3]], [1]).argmax(-1)


@bits
@torch.inference_mode()
def test_hidden_keys_do_not_change_a_bit_of_attention() -> None:
    torch.manual_seed(0)
    memory = torch.randn(2, 1, 8 * KEYS, 4, 64)
    for count in range(60, 1000, 47):
        queries = torch.randn(1, 4, BLOCK, 64)
        later = torch.arange(8 * KEYS) >= count
        hidden = torch.zeros(1, 1, BLOCK, 8 * KEYS).masked_fill_(later, -torch.inf)
        found = [
            attention(queries, memory[:, :, :reach], hidden[..., :reach])
            for reach in range(-(-count // KEYS) * KEYS, 8 * KEYS + 1, KEYS)
        ]
        assert all(torch.equal(one, found[0]) for one in found)


def test_other_kinds_of_models_are_left_to_transformers(make_llama: Callable[..., Any]) -> None:
    tensors, config = make_llama().state_dict(), make_llama().config.to_dict()
    assert small_model(config, tensors) is not None
    dynamic = {"rope_type": "dynamic", "rope_theta": 10000.0, "factor": 2.0}
    for change in (
        {"model_type": "mistral"},
        {"hidden_act": "gelu"},
        {"rope_parameters": dynamic},
        {"use_sliding_window": True},
        {"layer_types": ["full_attention", "sliding_attention"]},
        {"num_hidden_layers": 3},
        {"num_hidden_layers": 1},
        {"intermediate_size": 65},
    ):
        assert small_model({**config, **change}, tensors) is None, change


@pytest.mark.parametrize(
    "change",
    [
        {"use_rslora": True},
        {"use_dora": True},
        {"bias": "all"},
        {"alpha_pattern": {"q_proj": 2}},
        {"modules_to_save": ["lm_head"]},
        {"new_kind": 3},
        {"init_lora_weights": "pissa"},
    ],
)
def test_an_adapter_that_is_more_than_plain_lora_is_left_to_peft(
    adapter: Path, change: dict[str, Any]
) -> None:
    assert read(adapters={"mission": adapter}) is not None
    path = adapter / "adapter_config.json"
    write_json(path, {**read_json(path), **change})
    assert read(adapters={"mission": adapter}) is None


@pytest.mark.parametrize("layer", ["lm_head", "model.layers.0.self_attn.k_proj"])
def test_an_adapter_with_matrices_that_stand_alone_or_elsewhere_is_left_to_peft(
    adapter: Path, layer: str
) -> None:
    from safetensors.torch import load_file, save_file

    path = adapter / "adapter_model.safetensors"
    matrix = {f"base_model.model.{layer}.lora_A.weight": torch.ones(4, 256)}
    save_file({**load_file(path), **matrix}, path)
    assert read(adapters={"mission": adapter}) is None


def test_a_folder_with_another_configuration_is_left_to_transformers(tmp_path: Path) -> None:
    assert EMBEDDED.folder is not None
    folder = Path(shutil.copytree(EMBEDDED.folder, tmp_path / "embedded"))
    write_json(folder / "config.json", {**read_json(folder / "config.json"), "hidden_act": "gelu"})
    assert read(replace(EMBEDDED, folder=folder)) is None


def test_an_adapter_of_the_other_level_is_refused(trained: Path) -> None:
    with pytest.raises(PlannerError, match="adapter of the mission level"):
        read(adapters={"task": trained})


def weights() -> list[Tensor]:
    """Of all magnitudes and shapes, with a block of zeros, an outlier, fewer blocks of scales than
    one, and a part of a block.
    """
    generator = torch.Generator().manual_seed(0)
    made = [
        torch.randn(64 * (1 + index % 3), 256, generator=generator) * 10.0 ** (index % 7 - 3)
        for index in range(60)
    ]
    made[1][:2] = 0
    made[2][0, 0] = 1000
    return [*made, torch.ones(8, 64), torch.zeros(64, 64), torch.randn(3, 50, generator=generator)]


@pytest.mark.parametrize("dtype", [torch.float32, torch.bfloat16, torch.float16])
def test_every_4_bit_number_is_that_of_bitsandbytes(dtype: torch.dtype) -> None:
    from bitsandbytes.functional import dequantize_4bit, quantize_4bit

    for index, weight in enumerate(weights()):
        stored, state = quantize_4bit(weight.to(dtype), quant_type="nf4", compress_statistics=True)
        expected, found = dequantize_4bit(stored, state), rounded_to_nf4(weight.to(dtype))
        assert found.dtype == dtype and found.shape == weight.shape
        assert torch.equal(found, expected), (
            f"weight {index}: {(found != expected).sum()} of {weight.numel()} differ"
        )


def test_the_dynamic_type_is_that_of_bitsandbytes() -> None:
    from bitsandbytes.functional import create_dynamic_map

    assert torch.equal(dynamic_values(), create_dynamic_map())
