"""Deeper models that begin as shallower ones."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from types import ModuleType

import pytest
import torch

from planner_ft.pretraining.loop import PretrainSettings, new_model
from planner_ft.pretraining.model import add_dropout, deepened

SETTINGS = PretrainSettings(hidden=32, layers=4, heads=2, feed_forward=48)
SPECIAL = {"bos": 1, "eos": 2, "pad": 0}
TOKENS = torch.arange(24).reshape(2, 12) + 3


@pytest.mark.parametrize("layers", [4, 5, 6, 8, 13])
def test_a_deeper_model_begins_as_the_one_it_comes_from(layers: int) -> None:
    small = new_model(SETTINGS, 64, SPECIAL).eval()
    deep = new_model(replace(SETTINGS, layers=layers, seed=1), 64, SPECIAL).eval()
    deep.load_state_dict(deepened(small.state_dict(), layers))
    assert len(deep.model.layers) == layers
    with torch.inference_mode():
        torch.testing.assert_close(deep(TOKENS).logits, small(TOKENS).logits)


def test_added_layers_can_learn() -> None:
    deep = new_model(replace(SETTINGS, layers=6), 64, SPECIAL)
    deep.load_state_dict(deepened(new_model(SETTINGS, 64, SPECIAL).state_dict(), 6))
    deep(TOKENS, labels=TOKENS).loss.backward()
    empty = [layer for layer in deep.model.layers if not layer.mlp.down_proj.weight.any()]
    assert len(empty) == 2
    assert all(
        bool(layer.mlp.down_proj.weight.grad.any())
        and bool(layer.self_attn.o_proj.weight.grad.any())
        for layer in empty
    )


def test_layers_are_not_taken_away(script: ModuleType, tmp_path: Path) -> None:
    small = new_model(SETTINGS, 64, SPECIAL)
    with pytest.raises(ValueError, match="have 4 layers, the model 2"):
        deepened(small.state_dict(), 2)
    small.save_pretrained(tmp_path / "init")
    with pytest.raises(SystemExit, match="--layers: The weights to start from have 4 layers"):
        script.initialise(new_model(replace(SETTINGS, layers=2), 64, SPECIAL), tmp_path / "init")


def test_dropout_is_for_training_alone() -> None:
    plain, model = (new_model(SETTINGS, 64, SPECIAL) for _ in range(2))
    add_dropout(model, 0.2)
    with torch.no_grad():
        first, second = (model.train()(TOKENS).logits for _ in range(2))
        torch.testing.assert_close(model.eval()(TOKENS).logits, plain.eval()(TOKENS).logits)
    assert not torch.allclose(first, second)
