"""Names, folders and hub ids resolve to candidates; what is wrong is said in one sentence."""

from __future__ import annotations

import dataclasses
import json
import shutil
from pathlib import Path

import pytest

from planner_ft.candidates import all_candidates, resolve_candidate
from planner_ft.candidates.registry import Candidate, Dimensions
from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary import load_vocabulary

PUBLISHED_SIZES = {
    "Llama-3.2-1B": 1_235_814_400,
    "Llama-3.2-1B-Instruct": 1_235_814_400,
    "Llama-3.2-3B": 3_212_749_824,
    "Llama-3.2-3B-Instruct": 3_212_749_824,
    "Qwen2.5-3B": 3_085_938_688,
    "Qwen2.5-3B-Instruct": 3_085_938_688,
    "Llama-3.1-8B": 8_030_261_248,
}
"""Numbers of weights on the model cards."""


@pytest.fixture(autouse=True)
def _nothing_here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("HF_HUB_CACHE", str(tmp_path / "hub"))
    monkeypatch.delenv("PLANNERFT_MODELS", raising=False)


def test_the_seven_published_candidates_and_the_embedded_one_are_registered() -> None:
    assert [candidate.name for candidate in all_candidates()] == [
        *PUBLISHED_SIZES,
        "embedded",
        "embedded-reader",
    ]
    assert {
        candidate.name: candidate.parameters
        for candidate in all_candidates()
        if candidate.published
    } == PUBLISHED_SIZES


@pytest.mark.parametrize(
    "name",
    [
        "Llama-3.1-8B",
        "llama-3.1-8b",
        "Llama-3.1-8B (4-bit)",
        "meta-llama/Llama-3.1-8B",
        " Llama-3.1-8B ",
    ],
)
def test_a_candidate_is_found_by_name_published_row_and_hub_id(name: str) -> None:
    candidate = resolve_candidate(name)
    assert (candidate.name, candidate.row_name, candidate.gated, candidate.folder) == (
        "Llama-3.1-8B",
        "Llama-3.1-8B (4-bit)",
        True,
        None,
    )


def test_an_unknown_name_gets_close_matches() -> None:
    with pytest.raises(
        PlannerError,
        match=r"unknown candidate 'Llama-3.2-3B-Instuct': did you mean Llama-3.2-3B-Instruct or .*, or a local folder .* or a hub id\?$",
    ):
        resolve_candidate("Llama-3.2-3B-Instuct")
    with pytest.raises(
        PlannerError,
        match=r"unknown candidate '': there are Llama-3.2-1B, .*embedded-reader; a local",
    ):
        resolve_candidate("")


def test_a_path_that_is_not_there_is_no_hub_id() -> None:
    with pytest.raises(PlannerError, match=r"\./models/mine: no such folder"):
        resolve_candidate("./models/mine")


def test_any_hub_id_resolves_with_its_revision() -> None:
    candidate = resolve_candidate("some-org/some.model@v1.0")
    assert (candidate.name, candidate.repo, candidate.revision, candidate.dimensions) == (
        "some-org/some.model",
        "some-org/some.model",
        "v1.0",
        None,
    )
    assert candidate.slug == "some-org--some.model"


def test_the_models_folder_comes_first_and_its_stand_ins_are_marked(models: Path) -> None:
    candidate = resolve_candidate("Llama-3.1-8B")
    assert (candidate.folder, candidate.source) == (models / "Llama-3.1-8B", "models folder")
    assert candidate.is_standin
    assert candidate.row_name == "Llama-3.1-8B (4-bit) (stand-in)"
    assert candidate.dimensions is not None
    assert candidate.dimensions.hidden == 64, "the sizes are those of the weights that are here"


def test_a_stand_in_given_by_path_is_marked_too(standins: Path) -> None:
    candidate = resolve_candidate(standins / "Qwen2.5-3B")
    assert (candidate.source, candidate.is_standin, candidate.chat) == ("path", True, "chatml")
    assert candidate.row_name == "Qwen2.5-3B (stand-in)"
    assert candidate.reference == str(standins / "Qwen2.5-3B")


def hub_snapshot(hub: Path, repo: str, source: Path, commit: str = "c0ffee") -> Path:
    """Lay a model folder out as the hub's cache does."""
    base = hub / f"models--{repo.replace('/', '--')}"
    (base / "refs").mkdir(parents=True)
    (base / "refs" / "main").write_text(commit)
    shutil.copytree(source, base / "snapshots" / commit)
    return base / "snapshots" / commit


def test_a_downloaded_model_is_found_in_the_hub_cache(tmp_path: Path, standins: Path) -> None:
    snapshot = hub_snapshot(tmp_path / "hub", "meta-llama/Llama-3.2-1B", standins / "Llama-3.2-1B")
    candidate = resolve_candidate("Llama-3.2-1B")
    assert (candidate.folder, candidate.source, candidate.reference) == (
        snapshot,
        "hub cache",
        "meta-llama/Llama-3.2-1B",
    )
    assert resolve_candidate("meta-llama/Llama-3.2-1B@c0ffee").folder == snapshot
    assert resolve_candidate("meta-llama/Llama-3.2-1B@another").folder is None


def test_only_the_very_vocabulary_of_pretraining_is_known() -> None:
    vocabulary = load_vocabulary()
    embedded = next(candidate for candidate in all_candidates() if candidate.name == "embedded")
    assert embedded.knows(vocabulary)
    assert not embedded.knows(dataclasses.replace(vocabulary, name="drone"))
    assert not embedded.knows(dataclasses.replace(vocabulary, sha256="0" * 64)), (
        "another file of the same name"
    )
    assert not Candidate("other").knows(vocabulary)


def test_another_vehicle_is_planned_for_by_the_reader() -> None:
    embedded, drone = resolve_candidate("embedded"), load_vocabulary("inspection_drone")
    assert embedded.serving(load_vocabulary()) is embedded
    reader = embedded.serving(drone)
    assert reader.name == "embedded-reader" and reader.folder is not None
    assert reader.serving(drone) is reader and not reader.knows(drone)
    assert reader.adapter_defaults("mission")["vary"]
    other = Candidate("other")
    assert other.serving(drone) is other


def test_dimensions_of_a_config_without_optional_fields(standins: Path) -> None:
    config = json.loads((standins / "Qwen2.5-3B" / "config.json").read_text())
    dimensions = Dimensions.from_config(config)
    assert dimensions is not None
    assert (
        dimensions.head_dim,
        dimensions.kv_heads,
        dimensions.tied,
        dimensions.attention_bias,
    ) == (16, 2, True, True)
    assert Dimensions.from_config({"model_type": "mamba", "hidden_size": 64}) is None
