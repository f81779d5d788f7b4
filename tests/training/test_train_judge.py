"""Validation samples are answered while a model is in training."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from rich.console import Console
from safetensors.torch import load_file

from planner_ft.benchmark.contrasts import sentences
from planner_ft.benchmark.judge import Judge, small_form
from planner_ft.benchmark.paired import Comparison
from planner_ft.benchmark.statistics import Estimate
from planner_ft.decoding.forward import read_forms
from planner_ft.training import model as in_training
from planner_ft.training.loop import InterruptedRunError
from planner_ft.training.run import train
from planner_ft.training.settings import TrainSettings


class Scripted(Judge):
    """Its F1 by epoch is written down here, the base's first."""

    f1 = (0.0, 0.9, 0.5)

    def answers(self, *, adapter: bool) -> list[dict[str, Any]]:
        epoch = round(self.run.epoch) if adapter else 0
        names = {"strict_valid": 1.0, "exact_sequence": self.f1[epoch], "f1": self.f1[epoch]}
        return [{"id": r["id"], "family": r["id"], **names} for r in self.records]


def text_of(quiet: Console) -> str:
    return quiet.export_text()


def test_answers_are_scored_after_every_epoch_and_the_change_is_said(
    ask: Callable[..., Any], quiet: Console, short: dict[str, Any]
) -> None:
    manifest = train(ask(**short, validation_answers=2), quiet, Judge)
    result = manifest["result"]
    assert [set(entry) >= {"f1", "strict_valid", "exact_sequence"} for entry in result["history"]]
    assert result["validation_answers"]["n"] == 2
    # A random model answers nothing that can be read.
    assert result["change"].startswith("no better than the base on 2 validation samples: F1 0.00")
    assert "next: more validation samples, 2 can hardly tell the two apart" in result["change"]
    assert "next: " in result["change"]
    text = text_of(quiet)
    assert "base: F1 0.00, valid 0%, exact 0% of 2 answers" in text
    assert "validation loss" in text


@pytest.mark.parametrize(
    ("first", "second", "bounds", "said"),
    [
        (0.5, 0.9, (0.2, 0.6), "better than the base on 20 validation samples: F1 0.50 to 0.90"),
        (0.79, 1.0, (0.0, 0.43), "not told apart from the base on 20 validation samples: F1 0.79"),
        (0.79, 0.79, (-0.05, 0.05), "no better than the base on 20 validation samples: F1 0.79"),
        (0.79, 0.7, (-0.2, 0.02), "no better than the base on 20 validation samples: F1 0.79"),
        (0.9, 0.5, (-0.6, -0.2), "worse than the base on 20 validation samples: F1 0.90 to 0.50"),
    ],
)
def test_a_gain_that_may_be_chance_is_not_told_apart(
    first: float, second: float, bounds: tuple[float, float], said: str
) -> None:
    found = Comparison("", "", "f1", first, second, 20, 20, Estimate(second - first, *bounds))
    known = {"f1": found, "exact": found, "n": 20, "settings": TrainSettings()}
    (text,) = sentences("judge", **known, falling=True, more="--vary 3")
    assert text.startswith(said)
    assert ("next: more passes" in text) == (not said.startswith("better"))


@pytest.mark.parametrize(("select", "kept"), [("f1", 1), ("loss", 2)])
def test_the_best_adapter_is_kept_by_what_was_asked_for(
    ask: Callable[..., Any], quiet: Console, short: dict[str, Any], select: str, kept: int
) -> None:
    result = train(ask(**short, select=select), quiet, Scripted)["result"]
    losses = [entry["validation_loss"] for entry in result["history"]]
    assert losses[1] < losses[0], "the test wants a loss that falls"
    assert result["best_epoch"] == kept
    assert result["validation_loss"] == losses[kept - 1]
    assert result["change"].startswith("better than the base on 3 validation samples: F1 0.00 to")


@pytest.mark.parametrize(("select", "kept"), [("loss", 1), ("last", 2)])
def test_the_last_adapter_can_be_kept_whatever_its_loss(
    ask: Callable[..., Any],
    quiet: Console,
    short: dict[str, Any],
    monkeypatch: pytest.MonkeyPatch,
    select: str,
    kept: int,
) -> None:
    rising = iter([1.0, 2.0])
    monkeypatch.setattr("planner_ft.training.loop.validation_loss", lambda *_known: next(rising))
    result = train(ask(**short, select=select), quiet, Scripted)["result"]
    assert (result["best_epoch"], result["validation_loss"]) == (kept, float(kept))


def test_a_blended_adapter_changes_the_base_by_its_share(
    ask: Callable[..., Any], quiet: Console, short: dict[str, Any], tmp_path: Path
) -> None:
    learnt, losses = list[dict[str, Any]](), list[list[float]]()
    for blend in (1.0, 0.25):
        output = tmp_path / f"blend-{blend}"
        wanted = {**short, "blend": blend, "select": "last", "output": str(output)}
        result = train(ask(**wanted), quiet, Scripted)["result"]
        losses.append([entry["train_loss"] for entry in result["history"]])
        learnt.append(load_file(output / "adapter_model.safetensors"))
    whole, part = learnt
    assert losses[0] == losses[1], "training itself is the same"
    for name, value in whole.items():
        share = 0.25 if "lora_B" in name else 1.0
        assert value.any() and part[name].allclose(value * share), name


def test_a_resumed_run_keeps_the_answers_and_the_losses(
    ask: Callable[..., Any],
    quiet: Console,
    short: dict[str, Any],
    interrupt_at: Callable[..., None],
    step_losses: Callable[[Path], list[float]],
    tmp_path: Path,
) -> None:
    whole = train(ask(**short, select="f1", output=str(tmp_path / "whole")), quiet, Scripted)
    with pytest.MonkeyPatch.context() as patch:
        interrupt_at(patch, 10)
        with pytest.raises(InterruptedRunError):
            train(ask(**short, select="f1"), quiet, Scripted)
    resumed = train(ask(**short, select="f1", resume=True), quiet, Scripted)
    assert step_losses(tmp_path / "adapter") == step_losses(tmp_path / "whole")
    for name in ("validation_answers", "change", "best_epoch"):
        assert resumed["result"][name] == whole["result"][name]


def test_nothing_is_answered_where_nothing_is_asked(
    ask: Callable[..., Any], quiet: Console, short: dict[str, Any]
) -> None:
    result = train(ask(**short, validation_answers=0), quiet, Scripted)["result"]
    assert "change" not in result
    assert "f1" not in result["history"][0]


def test_a_small_model_in_training_answers_as_the_adapter_folder_will(tmp_path: Path) -> None:
    import torch

    from planner_ft.candidates import resolve_candidate
    from planner_ft.candidates.loading import load_model

    candidate = resolve_candidate("embedded")
    base = load_model(candidate, device="cpu", quantization="nf4", trainable=True)
    assert in_training.unpack(base)
    model = in_training.attach_adapter(base, TrainSettings(rank=2), candidate.reference)
    with torch.no_grad():
        for name, value in in_training.adapter_parameters(model).items():
            if "lora_B" in name:
                value.fill_(0.01)
    model.save_pretrained(tmp_path)
    (tmp_path / "manifest.json").write_text(json.dumps({"kind": "train"}))
    stored = read_forms(candidate, {"mission": tmp_path}, quantization="nf4")
    for adapter, level in ((True, "mission"), (False, None)):
        form = small_form(model, adapter=adapter)
        assert torch.equal(form.layers[0].qkv[0], stored[level].layers[0].qkv[0])
        assert torch.equal(form.layers[-1].down[0], stored[level].layers[-1].down[0])
