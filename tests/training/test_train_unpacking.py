"""4-bit bases unpacked once: the same numbers."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import psutil
import pytest
import torch

from planner_ft.candidates import resolve_candidate
from planner_ft.candidates.loading import linear_4bit, load_model
from planner_ft.training.model import attach_adapter, unpack
from planner_ft.training.settings import TrainSettings


def loaded() -> Any:
    return load_model(resolve_candidate("Llama-3.2-1B-Instruct"), device="cpu", trainable=True)


def test_the_model_computes_what_it_computed(models: Path) -> None:
    packed, dense = loaded(), loaded()
    layers = len(list(linear_4bit(packed)))
    assert unpack(dense) == layers == 14
    assert not list(linear_4bit(dense))
    ids = torch.arange(40)[None]
    with torch.no_grad():
        torch.testing.assert_close(dense(ids).logits, packed(ids).logits)


def test_adapters_get_the_gradients_that_they_got(models: Path) -> None:
    gradients = []
    for model in (loaded(), loaded()):
        if gradients:
            unpack(model)
        adapted = attach_adapter(model, TrainSettings(rank=4, dropout=0.0), "base")
        with torch.no_grad():
            for name, value in adapted.named_parameters():
                if "lora_B" in name:
                    value.fill_(0.01)
        with torch.autocast("cpu", dtype=torch.bfloat16):
            ids = torch.arange(40)[None]
            adapted(input_ids=ids, labels=ids).loss.backward()
        gradients.append(
            {name: value.grad for name, value in adapted.named_parameters() if value.requires_grad}
        )
    packed, dense = gradients
    assert packed.keys() == dense.keys() and len(packed) == 28
    for name, gradient in packed.items():
        torch.testing.assert_close(
            dense[name], gradient, rtol=0.05, atol=0.02 * float(gradient.abs().max()), msg=name
        )


def test_without_memory_the_layers_stay(models: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    model = loaded()
    monkeypatch.setattr(psutil, "virtual_memory", lambda: type("Memory", (), {"available": 1000})())
    assert unpack(model) == 0
    assert len(list(linear_4bit(model))) == 14
