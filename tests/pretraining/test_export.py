"""What scripts/pretrain_embedded.py writes as a model folder."""

from __future__ import annotations

import argparse
import json
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import Any

import pytest
import torch
from safetensors.torch import load_file

from planner_ft.pretraining.loop import PretrainSettings, new_model

SETTINGS = PretrainSettings(hidden=32, layers=1, heads=2, feed_forward=48)
SPECIAL = {"bos": 1, "eos": 2, "pad": 0}


def arguments(folder: Path, **given: Any) -> argparse.Namespace:
    return argparse.Namespace(
        work=folder / "work",
        export=folder / "out",
        **{"init": None, "init_share": 0.0, "average_with": None} | given,
    )


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A work folder whose checkpoint's weights are all 2, and a model folder whose weights are all
    4.
    """
    (tmp_path / "work" / "corpus").mkdir(parents=True)
    model = new_model(SETTINGS, 64, SPECIAL)
    weights = {name: torch.full_like(value, 2.0) for name, value in model.state_dict().items()}
    torch.save({"model": weights, "state": {"step": 7}}, tmp_path / "work" / "checkpoint.pt")
    model.load_state_dict({name: torch.full_like(value, 4.0) for name, value in weights.items()})
    model.save_pretrained(tmp_path / "before")
    (tmp_path / "before" / "pretraining.json").write_text('{"state": {"step": 3}}')
    return tmp_path


@pytest.mark.parametrize(
    ("given", "weight"), [({}, 2.0), ({"init_share": 0.25}, 2.5), ({"init_share": 1.0}, 4.0)]
)
def test_a_checkpoint_is_written_alone_or_averaged_with_what_it_started_from(
    script: ModuleType, folder: Path, given: dict[str, Any], weight: float
) -> None:
    tokenizer = SimpleNamespace(save_pretrained=lambda path: None)
    script.export(
        new_model(SETTINGS, 64, SPECIAL),
        tokenizer,
        SETTINGS,
        arguments(folder, init=folder / "before", **given),
    )
    written = load_file(folder / "out" / "model.safetensors")
    assert written and all(bool((value.float() == weight).all()) for value in written.values())
    record = json.loads((folder / "out" / "pretraining.json").read_text())
    assert record["init_share"] == given.get("init_share", 0.0) and [
        stage["state"]["step"] for stage in record["earlier_stages"]
    ] == [3]


def test_an_average_needs_something_to_average_with(script: ModuleType, folder: Path) -> None:
    with pytest.raises(SystemExit, match="--init-share needs --init"):
        script.export(
            new_model(SETTINGS, 64, SPECIAL), None, SETTINGS, arguments(folder, init_share=0.5)
        )
    assert not (folder / "out").exists()


def test_the_average_may_be_with_an_earlier_stage(script: ModuleType, folder: Path) -> None:
    model = new_model(SETTINGS, 64, SPECIAL)
    model.load_state_dict(
        {name: torch.full_like(value, 8.0) for name, value in model.state_dict().items()}
    )
    model.save_pretrained(folder / "first")
    (folder / "first" / "pretraining.json").write_text('{"state": {"step": 1}}')
    tokenizer = SimpleNamespace(save_pretrained=lambda path: None)
    given = arguments(folder, init=folder / "before", average_with=folder / "first", init_share=0.5)
    script.export(new_model(SETTINGS, 64, SPECIAL), tokenizer, SETTINGS, given)
    written = load_file(folder / "out" / "model.safetensors")
    assert all(bool((value.float() == 5.0).all()) for value in written.values())
    record = json.loads((folder / "out" / "pretraining.json").read_text())
    assert record["averaged_with_stage"] == 1 and [
        stage["state"]["step"] for stage in record["earlier_stages"]
    ] == [3]
