"""Candidates load in 4 bits on a CPU; one that cannot be loaded says in one sentence what to do."""

from __future__ import annotations

import json
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest
import torch

from planner_ft.candidates import loading, resolve_candidate
from planner_ft.candidates.loading import (
    compute_dtype,
    linear_4bit,
    load_model,
    load_tokenizer,
    resolve_device,
)
from planner_ft.support.errors import PlannerError

SEVEN = [
    "Llama-3.2-1B",
    "Llama-3.2-1B-Instruct",
    "Llama-3.2-3B",
    "Llama-3.2-3B-Instruct",
    "Qwen2.5-3B",
    "Qwen2.5-3B-Instruct",
    "Llama-3.1-8B",
]
CPU = torch.device("cpu")


@pytest.mark.parametrize("name", SEVEN)
def test_every_candidate_loads_in_nf4_with_double_quantisation_and_generates(
    models: Path, name: str
) -> None:
    candidate = resolve_candidate(name)
    tokenizer, model = load_tokenizer(candidate), load_model(candidate, device="cpu")
    layers = dict(linear_4bit(model))
    assert len(layers) == 2 * 7, "the blocks' layers, not the output head"
    assert all(
        layer.weight.quant_state.quant_type == "nf4" and layer.weight.quant_state.nested
        for layer in layers.values()
    )
    head, embeddings = model.get_output_embeddings().weight, model.get_input_embeddings().weight
    assert head.dtype == embeddings.dtype == compute_dtype(CPU)
    assert (head.data_ptr() == embeddings.data_ptr()) == (name != "Llama-3.1-8B"), (
        "tied as the originals"
    )
    ids = tokenizer("go to [10, 20]", return_tensors="pt").input_ids
    output = model.generate(
        ids,
        attention_mask=torch.ones_like(ids),
        max_new_tokens=3,
        do_sample=False,
        pad_token_id=tokenizer.pad_token_id,
    )
    assert ids.shape[1] < output.shape[1] <= ids.shape[1] + 3


def test_sixteen_bit_loading_quantises_nothing(models: Path) -> None:
    model = load_model(resolve_candidate("Qwen2.5-3B"), device="cpu", quantization="none")
    assert not list(linear_4bit(model))
    assert {parameter.dtype for parameter in model.parameters()} == {compute_dtype(CPU)}


def test_every_tokenizer_can_pad_for_generation_without_its_end_of_turn(models: Path) -> None:
    for name in SEVEN:
        tokenizer = load_tokenizer(resolve_candidate(name))
        assert tokenizer.padding_side == "left"
        assert tokenizer.pad_token == (
            "<|finetune_right_pad_id|>" if name.startswith("Llama") else "<|endoftext|>"
        )


def test_the_device_flag() -> None:
    assert resolve_device("cpu") == CPU
    with pytest.raises(PlannerError, match=r"--device tpu: no such device|--device tpu: only"):
        resolve_device("tpu")
    if not torch.cuda.is_available():
        assert resolve_device("auto") == CPU
        with pytest.raises(
            PlannerError, match=r"--device cuda: torch .* finds no CUDA device; use --device cpu"
        ):
            resolve_device("cuda")


def test_a_candidate_that_is_not_here_says_how_to_get_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv("PLANNERFT_MODELS", raising=False)
    monkeypatch.setenv("HF_HUB_CACHE", str(tmp_path))
    with pytest.raises(
        PlannerError,
        match=(
            r"accept its licence at https://huggingface.co/meta-llama/Llama-3.2-1B, run `hf auth"
            r" login`.*`hf download meta-llama"
        ),
    ):
        load_model(resolve_candidate("Llama-3.2-1B"))
    with pytest.raises(
        PlannerError, match=r"not on this machine: run `hf download Qwen/Qwen2.5-3B "
    ):
        load_tokenizer(resolve_candidate("Qwen2.5-3B"))
    with pytest.raises(
        PlannerError, match=r"no folder my/model: run `hf download my/model --revision v2 "
    ):
        load_model(resolve_candidate("my/model@v2"))


def edit_config(folder: Path, **changes: object) -> None:
    config = json.loads((folder / "config.json").read_text())
    (folder / "config.json").write_text(json.dumps({**config, **changes}))


def shard_index(folder: Path) -> None:
    (folder / "model.safetensors.index.json").write_text(
        json.dumps({"weight_map": {"a": "model.safetensors", "b": "model-2.safetensors"}})
    )


def drop_tensor(folder: Path) -> None:
    from safetensors.torch import load_file, save_file

    tensors = load_file(folder / "model.safetensors")
    del tensors["model.layers.1.mlp.up_proj.weight"]
    save_file(tensors, folder / "model.safetensors", {"format": "pt"})


def truncate(path: Path, share: float = 0.5) -> None:
    path.write_bytes(path.read_bytes()[: int(path.stat().st_size * share)])


DAMAGE: dict[str, tuple[Callable[[Path], object], str]] = {
    "no config": (lambda folder: (folder / "config.json").unlink(), "no config.json"),
    "config is no JSON": (
        lambda folder: (folder / "config.json").write_text("{"),
        r"config.json:1: not JSON",
    ),
    "not a causal model": (
        lambda folder: edit_config(folder, architectures=["BertModel"]),
        "causal language model",
    ),
    "unknown model type": (
        lambda folder: edit_config(
            folder, model_type="mine", auto_map={"AutoModelForCausalLM": "mine.M"}
        ),
        "code that comes with",
    ),
    "config of wrong types": (
        lambda folder: edit_config(folder, hidden_size="a"),
        "cannot be loaded .*hidden_size",
    ),
    "another quantisation": (
        lambda folder: edit_config(folder, quantization_config={"quant_method": "gptq", "bits": 4}),
        "cannot be loaded",
    ),
    "no tokenizer": (lambda folder: (folder / "tokenizer.json").unlink(), "no tokenizer.json"),
    "no weights": (
        lambda folder: (folder / "model.safetensors").unlink(),
        "no model.safetensors; finish the download",
    ),
    "pickled weights": (
        lambda folder: (folder / "model.safetensors").rename(folder / "pytorch_model.bin"),
        "only pickled weights .* never loaded",
    ),
    "truncated weights": (
        lambda folder: truncate(folder / "model.safetensors"),
        "corrupt or no safetensors file",
    ),
    "weights are no safetensors": (
        lambda folder: (folder / "model.safetensors").write_bytes(b"\x80\x04K\x01."),
        "corrupt or no safetensors file",
    ),
    "missing shard": (shard_index, "1 of 2 weight files are missing"),
    "missing tensor": (drop_tensor, "lack 1 tensors .model.layers.1.mlp.up_proj.weight"),
    "other sizes": (
        lambda folder: edit_config(folder, intermediate_size=256),
        "but config.json says",
    ),
    "other vocabulary size": (
        lambda folder: edit_config(folder, vocab_size=2000),
        "cannot be loaded",
    ),
}


@pytest.mark.parametrize("damage", DAMAGE)
def test_a_damaged_model_is_refused_in_one_sentence(
    standins: Path, tmp_path: Path, damage: str
) -> None:
    folder = tmp_path / "model"
    shutil.copytree(standins / "Llama-3.2-1B", folder)
    damaging, message = DAMAGE[damage]
    damaging(folder)
    with pytest.raises(PlannerError, match=message) as caught:
        load_model(resolve_candidate(folder), device="cpu")
    assert "\n" not in str(caught.value)
    assert str(folder) in str(caught.value)


def test_a_corrupt_tokenizer_is_refused(standins: Path, tmp_path: Path) -> None:
    folder = tmp_path / "model"
    shutil.copytree(standins / "Llama-3.2-1B", folder)
    truncate(folder / "tokenizer.json")
    with pytest.raises(PlannerError, match="the tokenizer cannot be loaded"):
        load_tokenizer(resolve_candidate(folder))


@pytest.mark.parametrize(
    "error",
    [
        torch.cuda.OutOfMemoryError("CUDA out of memory"),
        RuntimeError("DefaultCPUAllocator: can't allocate memory"),
        MemoryError(),
    ],
)
def test_too_little_memory_names_the_way_out(
    models: Path, monkeypatch: pytest.MonkeyPatch, error: Exception
) -> None:
    def fail(*_: object) -> None:
        raise error

    monkeypatch.setattr(loading, "_load_base", fail)
    with pytest.raises(
        PlannerError, match=r"Llama-3.2-1B does not fit the memory of cpu; .* smaller candidate"
    ):
        load_model(resolve_candidate("Llama-3.2-1B"), device="cpu")


def test_loading_writes_nothing_to_the_terminal(
    models: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    load_model(resolve_candidate("Llama-3.2-1B"), device="cpu")
    assert capfd.readouterr() == ("", "")
