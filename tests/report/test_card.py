"""Measured figures in an adapter's model card."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from huggingface_hub import ModelCard

from planner_ft.report.write import write_card
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import sha256_tree
from planner_ft.training.output import model_card

FRONT = (
    "---\nlibrary_name: peft\nlicense: apache-2.0\ntags: [lora]\n---\n\n# An adapter\n\n##"
    " Use\n\nLoad it.\n\n## Training\n\nIt was trained.\n"
)


@pytest.fixture
def adapter(tmp_path: Path) -> Path:
    folder = tmp_path / "adapter"
    folder.mkdir()
    (folder / "adapter_model.safetensors").write_bytes(b"weights")
    (folder / "adapter_config.json").write_text("{}")
    (folder / "README.md").write_text(FRONT)
    (folder / "manifest.json").write_text(
        json.dumps({"base": {"name": "embedded"}, "level": "mission"})
    )
    return folder


def record_adapter(run: Path, adapter: Path, candidate: str) -> None:
    """Let the run say that this candidate was measured with the adapter, as bench records it."""
    path = run / "results.json"
    results = json.loads(path.read_text())
    digest = sha256_tree(adapter, ("adapter_model.safetensors", "adapter_config.json"))
    results["manifest"]["jobs"] = {
        f"{name} base": {
            "candidate": name,
            "configuration": "base",
            "adapter": digest if name == candidate else "0" * 64,
        }
        for name in ("good", "hostile")
    }
    path.write_text(json.dumps(results))


def test_the_hub_reads_the_figures_of_this_adapter_alone(run: Path, adapter: Path) -> None:
    record_adapter(run, adapter, "good")
    count = write_card(adapter, [run])
    card = ModelCard.load(adapter / "README.md")
    measured = {
        row["candidate"]: row["metrics"]
        for row in json.loads((run / "results.json").read_text())["rows"]
    }["good"]
    figures = {result.metric_type: result.metric_value for result in card.data.eval_results}
    assert count == len(figures) == sum(figure["value"] is not None for figure in measured.values())
    assert figures == {
        name: figure["value"] for name, figure in measured.items() if figure["value"] is not None
    }
    assert card.data.model_name == "embedded mission adapter"
    assert card.data.license == "apache-2.0"
    first = card.data.eval_results[0]
    assert first.dataset_name == "test.jsonl"
    assert set(first.metric_args) == {"low", "high", "confidence"}


def test_the_text_keeps_what_was_there_and_has_the_figures_once(run: Path, adapter: Path) -> None:
    record_adapter(run, adapter, "good")
    write_card(adapter, [run])
    once = (adapter / "README.md").read_text()
    write_card(adapter, [run])
    assert (adapter / "README.md").read_text() == once
    assert once.index("Load it.") < once.index("## Measured") < once.index("It was trained.")
    assert "wrong answers by kind: parameter propagation 1" in once
    assert "published" not in once


def test_runs_of_other_weights_are_refused(run: Path, adapter: Path) -> None:
    record_adapter(run, adapter, "good")
    (adapter / "adapter_model.safetensors").write_bytes(b"retrained")
    with pytest.raises(PlannerError, match="no row of these runs was measured with this adapter"):
        write_card(adapter, [run])
    assert (adapter / "README.md").read_text() == FRONT


def test_a_folder_without_a_card_is_refused(run: Path, tmp_path: Path) -> None:
    with pytest.raises(PlannerError, match="no adapter with a model card"):
        write_card(tmp_path, [run])


def test_a_card_names_its_training_data_and_limits() -> None:
    manifest = json.loads(
        (
            Path(__file__).parents[2] / "adapters" / "embedded" / "mission" / "manifest.json"
        ).read_text()
    )
    card = model_card(manifest)
    assert (
        f"| training data | train.jsonl, SHA-256 {manifest['inputs']['training']['sha256'][:12]}"
        in card
    )
    assert "A plan that is valid need not be right" in card


def test_a_card_names_the_command_and_what_was_made_of_the_data() -> None:
    adapter = Path(__file__).parents[2] / "adapters" / "embedded" / "mission"
    manifest = json.loads((adapter / "manifest.json").read_text())
    manifest["configuration"] |= {
        "augment": 20,
        "vary": 2,
        "borrow": 1,
        "max_samples": 50,
        "blend": 0.5,
    }
    card = model_card(manifest)
    assert f"Made by `{manifest['command']}`." in card
    assert "synthetic samples | 50, 2, 1, 20 |" in card
    assert "| the last, 0.5 |" in card
    assert "Made by" not in model_card(manifest | {"command": "launcher.py -f kernel.json"})
