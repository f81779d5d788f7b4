"""An adapter is checked before it is loaded: base, level, vocabulary, safe and whole weights."""

from __future__ import annotations

import dataclasses
import json
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest
import torch
from safetensors.torch import load_file, save_file

from planner_ft.candidates import resolve_candidate
from planner_ft.candidates.adapters import adapter_record, check_adapter
from planner_ft.candidates.loading import load_model
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_json, sha256_file, write_json
from planner_ft.vocabulary import load_vocabulary


@pytest.fixture(scope="module")
def trained(standins: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A mission adapter of Llama-3.2-1B's stand-in, with a manifest."""
    from peft import LoraConfig, get_peft_model

    folder = tmp_path_factory.mktemp("adapter")
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("PLANNERFT_MODELS", str(standins))
        candidate = resolve_candidate("Llama-3.2-1B")
    torch.manual_seed(0)
    model = load_model(candidate, device="cpu", trainable=True)
    adapted = get_peft_model(
        model,
        LoraConfig(
            r=4, target_modules="all-linear", task_type="CAUSAL_LM", init_lora_weights=False
        ),
    )
    adapted.save_pretrained(folder, save_embedding_layers=False)
    write_json(folder / "manifest.json", adapter_record(candidate, "mission", load_vocabulary()))
    return folder


@pytest.fixture
def adapter(trained: Path, tmp_path: Path) -> Path:
    """A copy to damage."""
    return Path(shutil.copytree(trained, tmp_path / "adapter"))


def test_an_adapter_loads_on_its_base_and_changes_the_output(models: Path, adapter: Path) -> None:
    candidate = resolve_candidate("Llama-3.2-1B")
    check_adapter(adapter, candidate, level="mission", vocabulary=load_vocabulary())
    ids = torch.arange(8).reshape(1, 8)
    with torch.no_grad():
        plain = load_model(candidate, device="cpu")(input_ids=ids).logits
        adapted = load_model(candidate, device="cpu", adapters={"mission": adapter})
        assert not torch.allclose(plain, adapted(input_ids=ids).logits)
    assert not any(parameter.requires_grad for parameter in adapted.parameters())


def test_an_adapter_of_another_base_is_refused(models: Path, adapter: Path) -> None:
    with pytest.raises(
        PlannerError,
        match=(
            r"trained on Llama-3.2-1B \(stand-in\) and does not fit Qwen2.5-3B \(stand-in\); give"
            r" --candidate Llama-3.2-1B"
        ),
    ):
        load_model(resolve_candidate("Qwen2.5-3B"), device="cpu", adapters={"mission": adapter})


def test_an_adapter_of_a_stand_in_does_not_fit_the_real_candidate(
    adapter: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("HF_HUB_CACHE", str(tmp_path))
    monkeypatch.delenv("PLANNERFT_MODELS", raising=False)
    with pytest.raises(
        PlannerError, match=r"trained on Llama-3.2-1B \(stand-in\) and does not fit Llama-3.2-1B;"
    ):
        check_adapter(adapter, resolve_candidate("Llama-3.2-1B"))


def test_an_adapter_of_other_weights_of_the_same_name_is_refused(
    adapter: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from scripts.make_standins import make_standin

    make_standin("Llama-3.2-1B", tmp_path, seed=1)
    monkeypatch.setenv("PLANNERFT_MODELS", str(tmp_path))
    with pytest.raises(PlannerError, match="trained on other weights"):
        check_adapter(adapter, resolve_candidate("Llama-3.2-1B"))


def test_an_adapter_serves_the_level_and_vocabulary_that_it_was_trained_for(
    models: Path, adapter: Path
) -> None:
    candidate, vocabulary = resolve_candidate("Llama-3.2-1B"), load_vocabulary()
    with pytest.raises(
        PlannerError,
        match="adapter of the mission level, not of the task level; give --level mission",
    ):
        check_adapter(adapter, candidate, level="task")
    with pytest.raises(PlannerError, match="trained with the vocabulary usv, not drone"):
        check_adapter(
            adapter,
            candidate,
            vocabulary=dataclasses.replace(vocabulary, name="drone", sha256="0" * 64),
        )
    with pytest.raises(PlannerError, match="another version of the vocabulary usv"):
        check_adapter(
            adapter, candidate, vocabulary=dataclasses.replace(vocabulary, sha256="0" * 64)
        )


def plain_peft(adapter: Path, reference: str) -> None:
    """Make it an adapter that another program has saved: no manifest, a base by name."""
    (adapter / "manifest.json").unlink()
    config = json.loads((adapter / "adapter_config.json").read_text())
    (adapter / "adapter_config.json").write_text(
        json.dumps({**config, "base_model_name_or_path": reference})
    )


@pytest.mark.parametrize(
    "reference",
    [
        "meta-llama/Llama-3.2-1B",
        "/elsewhere/Llama-3.2-1B",
        "/cache/models--meta-llama--Llama-3.2-1B/snapshots/abc",
    ],
)
def test_a_plain_peft_adapter_fits_the_base_that_it_names(
    models: Path, adapter: Path, reference: str
) -> None:
    plain_peft(adapter, reference)
    check_adapter(adapter, resolve_candidate("Llama-3.2-1B"), level="task")
    with pytest.raises(
        PlannerError, match=r"was trained on .*Llama-3.2-1B.*, not on Llama-3.2-1B-Instruct"
    ):
        check_adapter(adapter, resolve_candidate("Llama-3.2-1B-Instruct"))


def test_shapes_tell_an_adapter_of_another_base(models: Path, adapter: Path) -> None:
    plain_peft(adapter, "")
    candidate = resolve_candidate("Llama-3.2-1B")
    assert candidate.dimensions is not None
    for change in ({"hidden": 128}, {"layers": 1}):
        with pytest.raises(PlannerError, match="does not fit the base model"):
            check_adapter(
                adapter,
                dataclasses.replace(
                    candidate, dimensions=dataclasses.replace(candidate.dimensions, **change)
                ),
            )


def record_outputs(folder: Path) -> None:
    """Name the files' digests in the manifest, as training does."""
    names = ("adapter_model.safetensors", "adapter_config.json")
    digests = {name: sha256_file(folder / name) for name in names}
    write_json(
        folder / "manifest.json", {**read_json(folder / "manifest.json"), "outputs": digests}
    )


def edit_weights(folder: Path, value: float, dtype: torch.dtype = torch.float32) -> None:
    tensors = load_file(folder / "adapter_model.safetensors")
    tensors = {name: tensor.to(dtype) for name, tensor in tensors.items()}
    next(iter(tensors.values()))[0, 0] = value
    save_file(tensors, folder / "adapter_model.safetensors")


def append(path: Path, text: str) -> None:
    path.write_text(path.read_text() + text)


def test_an_adapter_with_the_files_that_training_wrote_passes(models: Path, adapter: Path) -> None:
    record_outputs(adapter)
    check_adapter(adapter, resolve_candidate("Llama-3.2-1B"))


DAMAGE: dict[str, tuple[Callable[[Path], object], str]] = {
    "gone": (shutil.rmtree, "no such adapter folder; train one with `plannerft train"),
    "no configuration": (
        lambda folder: (folder / "adapter_config.json").unlink(),
        "no adapter_config.json",
    ),
    "configuration is no JSON": (
        lambda folder: (folder / "adapter_config.json").write_text("{"),
        "adapter_config.json:1: not JSON",
    ),
    "no LoRA": (
        lambda folder: (folder / "adapter_config.json").write_text('{"peft_type": "IA3"}'),
        "no LoRA adapter",
    ),
    "no weights": (
        lambda folder: (folder / "adapter_model.safetensors").unlink(),
        "no adapter_model.safetensors",
    ),
    "pickled": (
        lambda folder: (folder / "adapter_model.safetensors").rename(folder / "adapter_model.bin"),
        "pickled weights .* never loaded",
    ),
    "truncated": (
        lambda folder: (folder / "adapter_model.safetensors").write_bytes(b"\x10\0\0\0\0\0\0\0{}"),
        "corrupt or no safetensors",
    ),
    "NaN in the weights": (
        lambda folder: edit_weights(folder, float("nan")),
        "adapter_model.safetensors: base_model.*lora_[AB].* holds NaN or infinity",
    ),
    "infinity in the weights": (
        lambda folder: edit_weights(folder, float("inf"), torch.bfloat16),
        "holds NaN or infinity",
    ),
    "other weights": (
        lambda folder: (record_outputs(folder), edit_weights(folder, 0.5)),
        "adapter_model.safetensors: not the file that training wrote",
    ),
    "another configuration": (
        lambda folder: (record_outputs(folder), append(folder / "adapter_config.json", " ")),
        "adapter_config.json: not the file that training wrote",
    ),
    "manifest is no JSON": (
        lambda folder: (folder / "manifest.json").write_text("{"),
        "manifest.json:1: not JSON",
    ),
    "manifest of another form": (
        lambda folder: (folder / "manifest.json").write_text("[]"),
        "manifest.json",
    ),
}


@pytest.mark.parametrize("damage", DAMAGE)
def test_a_damaged_adapter_is_refused_in_one_sentence(
    models: Path, adapter: Path, damage: str
) -> None:
    damaging, message = DAMAGE[damage]
    damaging(adapter)
    with pytest.raises(PlannerError, match=message) as caught:
        check_adapter(adapter, resolve_candidate("Llama-3.2-1B"))
    assert "\n" not in str(caught.value)
