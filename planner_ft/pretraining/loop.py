"""The pretraining loop: packed rows, bf16 autocast, Muon for matrices and AdamW for the rest, resumable."""

from __future__ import annotations

import json
import time
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np
import torch
from torch import Tensor, nn

from planner_ft.pretraining.corpus import IGNORE, Rows, load_shard, pack

SIZE_STEP = 1024


@dataclass(frozen=True)
class PretrainSettings:
    """Everything that the weights depend on besides the corpus."""

    tokens: int = 30_000_000
    """Training budget in tokens, padding not counted."""
    hidden: int = 256
    layers: int = 8
    heads: int = 4
    feed_forward: int = 704
    width: int = 512
    """Row width; samples longer than this go into rows of `wide` tokens."""
    wide: int = 1024
    batch_tokens: int = 8192
    matrix_lr: float = 3e-3
    other_lr: float = 3e-3
    weight_decay: float = 0.05
    warmup: float = 0.01
    decay: float = 0.4
    """Share of the budget over which the learning rate falls linearly to zero, at the end."""
    gradient_clip: float = 1.0
    seed: int = 0
    checkpoint_seconds: float = 240.0
    compile: bool = True


def new_model(settings: PretrainSettings, vocabulary_size: int, special: dict[str, int]) -> Any:
    """A freshly initialised Llama with tied embeddings."""
    from transformers import LlamaConfig, LlamaForCausalLM

    torch.manual_seed(settings.seed)
    config = LlamaConfig(
        vocab_size=vocabulary_size, hidden_size=settings.hidden, intermediate_size=settings.feed_forward, num_hidden_layers=settings.layers,
        num_attention_heads=settings.heads, num_key_value_heads=settings.heads, tie_word_embeddings=True, max_position_embeddings=4096,
        bos_token_id=special["bos"], eos_token_id=special["eos"], pad_token_id=special["pad"],
    )  # fmt: skip
    return LlamaForCausalLM(config)


def learning_rate(settings: PretrainSettings, tokens: int) -> float:
    """Factor of the peak learning rate: linear warm-up, plateau, linear decay to zero."""
    done = tokens / settings.tokens
    return max(0.0, min(1.0, done / settings.warmup, (1.0 - done) / settings.decay))


def batches(shards: list[Path], settings: PretrainSettings, pad: int, skip: int) -> Iterator[Rows]:
    """Endless batches over the shards, in order; the first `skip` batches are passed over."""
    number, epoch = 0, 0
    while True:
        for index, shard in enumerate(shards):
            samples = load_shard(shard)
            narrow = [sample for sample in samples if len(sample[0]) <= settings.width]
            wide = [sample for sample in samples if settings.width < len(sample[0]) <= settings.wide]
            seed = settings.seed + 7919 * epoch + index
            groups = [
                (pack(part, width, pad, seed), settings.batch_tokens // width) for part, width in ((narrow, settings.width), (wide, settings.wide)) if part
            ]
            chunks = [(rows, start, size) for rows, size in groups for start in range(0, len(rows.input_ids) - size + 1, size)]
            for choice in np.random.default_rng(seed).permutation(len(chunks)):
                number += 1
                if number > skip:
                    rows, start, size = chunks[choice]
                    part = slice(start, start + size)
                    yield Rows(rows.input_ids[part], rows.labels[part], rows.positions[part], rows.documents[part])
        epoch += 1


def completion_loss(model: Any, body: Any, rows: Rows) -> tuple[Tensor, int]:
    """Mean cross-entropy over the answer tokens of a batch, and the number of tokens that are no padding."""
    documents = torch.from_numpy(rows.documents)
    width = documents.shape[1]
    causal = torch.ones(width, width, dtype=torch.bool).tril()
    # Padding attends to itself, so that no row of the softmax is empty.
    mask = (documents[:, None, :, None] == documents[:, None, None, :]) & causal
    labels = torch.from_numpy(rows.labels)
    places = (labels != IGNORE).flatten().nonzero().squeeze(1)
    # The output layer sees few different sizes only: each keeps a kernel with its memory in oneDNN's cache.
    padded = nn.functional.pad(places, (0, -len(places) % SIZE_STEP))
    targets = nn.functional.pad(labels.flatten()[places], (0, -len(places) % SIZE_STEP), value=IGNORE)
    with torch.autocast("cpu", dtype=torch.bfloat16):
        hidden = body(input_ids=torch.from_numpy(rows.input_ids), position_ids=torch.from_numpy(rows.positions), attention_mask=mask, use_cache=False)[0]
        logits = model.lm_head(hidden.flatten(0, 1)[padded])
    return nn.functional.cross_entropy(logits.float(), targets, ignore_index=IGNORE), int((documents >= 0).sum())


def optimizers(model: nn.Module, settings: PretrainSettings) -> list[torch.optim.Optimizer]:
    """Muon for the layers' matrices, AdamW for embeddings and norms."""
    matrices = [value for name, value in model.named_parameters() if value.ndim == 2 and "embed" not in name and "lm_head" not in name]
    others = [value for name, value in model.named_parameters() if value.ndim != 2 or "embed" in name or "lm_head" in name]
    return [
        torch.optim.Muon(matrices, lr=settings.matrix_lr, weight_decay=settings.weight_decay, momentum=0.95, adjust_lr_fn="match_rms_adamw"),
        torch.optim.AdamW(others, lr=settings.other_lr, weight_decay=0.0, betas=(0.9, 0.98)),
    ]


def pretrain(model: Any, shards: list[Path], settings: PretrainSettings, *, pad: int, folder: Path) -> dict[str, Any]:
    """Train until the token budget is spent, resuming from `folder`/checkpoint.pt; return tokens, steps, seconds and loss.

    Logs one JSON line per 20 steps to `folder`/log.jsonl and to the terminal.
    """
    optims = optimizers(model, settings)
    state = _restore(folder, model, optims)
    body = torch.compile(model.model) if settings.compile else model.model
    started = saved = time.monotonic()
    begin_tokens, losses = state["tokens"], []
    for rows in batches(shards, settings, pad, state["step"]):
        factor = learning_rate(settings, state["tokens"])
        for optim, peak in zip(optims, (settings.matrix_lr, settings.other_lr), strict=True):
            for group in optim.param_groups:
                group["lr"] = factor * peak
        loss, tokens = completion_loss(model, body, rows)
        torch.autograd.backward(loss)
        torch.nn.utils.clip_grad_norm_(model.parameters(), settings.gradient_clip)
        for optim in optims:
            optim.step()
            optim.zero_grad(set_to_none=True)
        state["step"] += 1
        state["tokens"] += tokens
        losses.append(loss.item())
        done = state["tokens"] >= settings.tokens
        if state["step"] % 20 == 0 or done:
            seconds = time.monotonic() - started
            _log(folder, state, losses[-20:], settings, (state["tokens"] - begin_tokens) / seconds)
        if done or time.monotonic() - saved > settings.checkpoint_seconds:
            _save(folder, model, optims, {**state, "seconds": state["seconds"] + time.monotonic() - saved})
            state["seconds"] += time.monotonic() - saved
            saved = time.monotonic()
        if done:
            break
    return {**state, "loss": float(np.mean(losses[-50:])), "settings": asdict(settings)}


def _log(folder: Path, state: dict[str, Any], losses: list[float], settings: PretrainSettings, rate: float) -> None:
    line = {"step": state["step"], "tokens": state["tokens"], "loss": round(float(np.mean(losses)), 4), "tokens_per_s": round(rate)}
    eta = (settings.tokens - state["tokens"]) / rate / 60
    print(f"{line['step']:6d}  {line['tokens'] / 1e6:6.2f} M tokens  loss {line['loss']:.4f}  {rate:6.0f} tok/s  {eta:5.1f} min left", flush=True)
    with open(folder / "log.jsonl", "a", encoding="utf-8") as stream:
        stream.write(json.dumps(line) + "\n")


def _save(folder: Path, model: nn.Module, optims: list[torch.optim.Optimizer], state: dict[str, Any]) -> None:
    temporary = folder / "checkpoint.tmp"
    torch.save({"model": model.state_dict(), "optimizers": [optim.state_dict() for optim in optims], "state": state}, temporary)
    temporary.replace(folder / "checkpoint.pt")


def _restore(folder: Path, model: nn.Module, optims: list[torch.optim.Optimizer]) -> dict[str, Any]:
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / "checkpoint.pt"
    if not path.is_file():
        return {"step": 0, "tokens": 0, "seconds": 0.0}
    saved = torch.load(path, weights_only=True)
    model.load_state_dict(saved["model"])
    for optim, values in zip(optims, saved["optimizers"], strict=True):
        optim.load_state_dict(values)
    state: dict[str, Any] = saved["state"]
    return state
