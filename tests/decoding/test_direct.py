"""A candidate read straight from its files is the one that transformers, PEFT and bitsandbytes
load.
"""

from __future__ import annotations

import shutil
from dataclasses import fields, replace
from pathlib import Path
from typing import Any

import pytest
import torch

from planner_ft.candidates import Candidate, resolve_candidate
from planner_ft.candidates.adapters import adapter_record
from planner_ft.candidates.loading import load_model
from planner_ft.decoding.direct import Direct, read_directly
from planner_ft.decoding.lean import LeanDecoder
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_json, write_json
from planner_ft.vocabulary import load_vocabulary
from planner_ft.vocabulary.plans import Level

EMBEDDED = resolve_candidate("embedded")


@pytest.fixture(scope="module")
def trained(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A mission adapter of the embedded candidate that changes its answers."""
    from peft import LoraConfig, get_peft_model

    folder = tmp_path_factory.mktemp("mission")
    torch.manual_seed(0)
    config = LoraConfig(
        r=4,
        lora_alpha=6,
        target_modules=["q_proj", "o_proj", "up_proj", "down_proj"],
        task_type="CAUSAL_LM",
        init_lora_weights=False,
    )
    get_peft_model(load_model(EMBEDDED, device="cpu", trainable=True), config).save_pretrained(
        folder, save_embedding_layers=False
    )
    write_json(folder / "manifest.json", adapter_record(EMBEDDED, "mission", load_vocabulary()))
    return folder


@pytest.fixture
def adapter(trained: Path, tmp_path: Path) -> Path:
    """A copy to change."""
    return Path(shutil.copytree(trained, tmp_path / "adapter"))


def read(
    candidate: Candidate = EMBEDDED, adapters: dict[Level, Path] | None = None, **settings: Any
) -> Direct | None:
    return read_directly(candidate, adapters or {}, **{"quantization": "nf4", **settings})


def tensors(decoder: LeanDecoder) -> dict[str, torch.Tensor]:
    """Every tensor of a decoder by name, angles included."""
    found = {name: getattr(decoder, name) for name in ("embeddings", "norm", "head")}
    for index, layer in enumerate(decoder.layers):
        found |= {
            f"{index}.{field.name}": getattr(layer, field.name)
            for field in fields(layer)
            if getattr(layer, field.name) is not None
        }
    return {**found, "cosine": decoder.angles(300)[0], "sine": decoder.angles(300)[1]}


@pytest.mark.parametrize("quantization", ["nf4", "none"])
def test_every_weight_is_the_one_that_the_libraries_load(trained: Path, quantization: Any) -> None:
    direct = read(adapters={"mission": trained}, quantization=quantization)
    assert direct is not None and set(direct.forms) == {None, "mission"}
    model = load_model(
        EMBEDDED, device="cpu", quantization=quantization, adapters={"mission": trained}
    )
    assert direct.tokens == model.config.vocab_size and direct.end_ids == (
        model.generation_config.eos_token_id,
    )
    for name, form in direct.forms.items():
        expected = LeanDecoder.of(model, name)
        assert expected is not None
        sizes = ("heads", "key_heads", "head_size", "epsilon", "context")
        assert [getattr(form, size) for size in sizes] == [
            getattr(expected, size) for size in sizes
        ]
        found = tensors(form)
        for key, tensor in tensors(expected).items():
            assert tensor.dtype == found[key].dtype and torch.equal(tensor, found[key]), (name, key)
    assert not torch.equal(
        tensors(direct.forms["mission"])["0.qkv"], tensors(direct.forms[None])["0.qkv"]
    )


@pytest.mark.parametrize("name", ["Llama-3.2-1B", "Qwen2.5-3B"])
def test_another_kind_of_model_is_left_to_transformers(models: Path, name: str) -> None:
    assert read(resolve_candidate(name)) is None


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
    write_json(
        adapter / "adapter_config.json", {**read_json(adapter / "adapter_config.json"), **change}
    )
    assert read(adapters={"mission": adapter}) is None


@pytest.mark.parametrize(
    "name",
    [
        "base_model.model.lm_head.lora_A.weight",
        "base_model.model.model.layers.0.self_attn.k_proj.lora_A.weight",
    ],
)
def test_an_adapter_with_matrices_that_stand_alone_or_elsewhere_is_left_to_peft(
    adapter: Path, name: str
) -> None:
    from safetensors.torch import load_file, save_file

    save_file(
        {**load_file(adapter / "adapter_model.safetensors"), name: torch.ones(4, 256)},
        adapter / "adapter_model.safetensors",
    )
    assert read(adapters={"mission": adapter}) is None


def test_a_model_whose_tensors_are_not_those_of_its_configuration_is_left_to_transformers(
    tmp_path: Path,
) -> None:
    assert EMBEDDED.folder is not None and EMBEDDED.dimensions is not None
    assert read(replace(EMBEDDED, dimensions=replace(EMBEDDED.dimensions, layers=9))) is None
    folder = Path(shutil.copytree(EMBEDDED.folder, tmp_path / "embedded"))
    write_json(folder / "config.json", {**read_json(folder / "config.json"), "hidden_act": "gelu"})
    assert read(replace(EMBEDDED, folder=folder)) is None


def test_an_adapter_of_the_other_level_is_refused(trained: Path) -> None:
    with pytest.raises(PlannerError, match="adapter of the mission level"):
        read(adapters={"task": trained})
