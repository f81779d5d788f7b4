"""TRL's SFTTrainer on the chat form of our data: the losses of our own training."""

from __future__ import annotations

import json

import pytest

pytest.importorskip("trl")
pytestmark = pytest.mark.peers

import torch  # noqa: E402
from datasets import load_dataset  # noqa: E402
from trl import SFTConfig, SFTTrainer  # noqa: E402

from planner_ft.candidates.loading import load_model, load_tokenizer  # noqa: E402
from planner_ft.data.generate import GenerationSettings, generate  # noqa: E402
from planner_ft.prompts import chat_messages, with_fixed_date  # noqa: E402
from planner_ft.training.model import attach_adapter  # noqa: E402
from planner_ft.training.run import train  # noqa: E402

COUNT, STEPS = 4, 3
"""Every step sees all samples, whatever their order."""


@pytest.mark.parametrize("level", ["mission", "task"])
def test_sft_trainer_trains_to_our_loss(level, ask, quiet, tmp_path, models, monkeypatch):
    # In bfloat16 two programs round differently.
    for place in ("planner_ft.candidates.loading", "planner_ft.training.run"):
        monkeypatch.setattr(f"{place}.compute_dtype", lambda _device: torch.float32)
    sizes = {"train": COUNT, "validation": 1, "test": 1}
    generate(GenerationSettings(level, tmp_path, chat=True, **sizes), messages=chat_messages)
    folder = tmp_path / level
    run = {"learning_rate": 1e-2, "batch_size": COUNT, "epochs": STEPS, "dropout": 0.0, "rank": 4}
    run |= {"schedule": "constant", "warmup": 0.0, "quantization": "none", "log_every": 1}
    request = ask(level=level, data_dir=str(folder), **run)
    train(request, quiet)

    base = load_model(request.candidate, device="cpu", quantization="none", trainable=True)
    model = attach_adapter(base, request.settings, request.candidate.reference)
    settings = SFTConfig(
        str(tmp_path / "trl"),
        per_device_train_batch_size=COUNT,
        num_train_epochs=STEPS,
        learning_rate=1e-2,
        lr_scheduler_type="constant",
        logging_steps=1,
        max_length=4096,
        report_to="none",
        save_strategy="no",
        use_cpu=True,
        gradient_checkpointing=False,
        bf16=False,
    )
    data = load_dataset("json", data_files=str(folder / "chat/train.jsonl"), split="train")
    tokenizer = load_tokenizer(request.candidate)
    # Llama's template would write today's date.
    tokenizer.chat_template = with_fixed_date(tokenizer.chat_template)
    trainer = SFTTrainer(model, settings, train_dataset=data, processing_class=tokenizer)
    trainer.train()
    theirs = [line for line in trainer.state.log_history if "loss" in line]
    log = (tmp_path / "adapter" / "train_log.jsonl").read_text().splitlines()
    ours = [line for line in map(json.loads, log) if "loss" in line]
    assert len(ours) == len(theirs) == STEPS
    # Trained on the prompt as well, the second gradient would be 14 % shorter.
    for one, other in zip(ours, theirs, strict=True):
        for name in ("loss", "grad_norm"):
            assert other[name] == pytest.approx(one[name], rel=1e-4)
