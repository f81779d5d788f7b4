"""The pretraining loop: bf16 autocast, Muon for matrices and AdamW for the rest, resumable.

On a GPU it takes grids (`grids.py`), whose rows have one width. On a processor it takes the samples
of one long row without padding; started by torchrun with several processes, each takes its share of
every batch: the result does not depend on their number, up to rounding, and a run may be resumed
with another number.
"""

import itertools
import json
import os
import time
from collections.abc import Iterator
from contextlib import nullcontext
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np
import torch
from torch import Tensor, nn

from planner_ft.pretraining.corpus import load_shard
from planner_ft.pretraining.grids import Grid, bias_of, grid_batches, grid_of, parts_of
from planner_ft.pretraining.model import (
    CAUSAL,
    add_dropout,
    register_attention,
    rounded,
    summed_cross_entropy,
)
from planner_ft.pretraining.packs import IGNORE


@dataclass(frozen=True)
class PretrainSettings:
    """Everything that the weights depend on besides the corpus.

    `tokens` is the training budget, padding not counted. Samples of more than `longest` tokens are
    left out of the corpus. `decay` is the share of the budget over which the learning rate falls
    linearly to zero, at the end. With `four_bit` the forward pass sees the layers' matrices rounded
    to NF4, as the candidate runs. `seconds`, where not 0, end a run before its tokens do. `width`
    is that of the rows of a grid, where the model is trained on grids. `dropout` is the share of
    what embeddings, attention and feed-forward layers give that is dropped in training.
    """

    tokens: int = 30_000_000
    seconds: float = 0.0
    width: int = 0
    hidden: int = 256
    layers: int = 8
    heads: int = 4
    feed_forward: int = 704
    longest: int = 1024
    batch_tokens: int = 8192
    matrix_lr: float = 3e-3
    other_lr: float = 3e-3
    weight_decay: float = 0.05
    warmup: float = 0.01
    decay: float = 0.4
    gradient_clip: float = 1.0
    dropout: float = 0.0
    four_bit: bool = False
    seed: int = 0
    checkpoint_seconds: float = 240.0
    compile: bool = True


def new_model(settings: PretrainSettings, vocabulary_size: int, special: dict[str, int]) -> Any:
    """A freshly initialised Llama with tied embeddings."""
    from transformers import LlamaConfig, LlamaForCausalLM

    register_attention()
    torch.manual_seed(settings.seed)
    config = LlamaConfig(
        vocab_size=vocabulary_size,
        hidden_size=settings.hidden,
        intermediate_size=settings.feed_forward,
        num_hidden_layers=settings.layers,
        num_attention_heads=settings.heads,
        num_key_value_heads=settings.heads,
        tie_word_embeddings=True,
        max_position_embeddings=4096,
        bos_token_id=special["bos"],
        eos_token_id=special["eos"],
        pad_token_id=special["pad"],
        attn_implementation=CAUSAL,
    )
    return LlamaForCausalLM(config)


class Budget:
    """Tokens and seconds of a training, `earlier` seconds of which are spent. They count from the
    start, but for the first step of a run, which compiles the model.
    """

    def __init__(self, settings: PretrainSettings, earlier: float = 0.0) -> None:
        self.tokens, self.seconds, self.earlier = settings.tokens, settings.seconds, earlier
        self.started, self.compiled = time.monotonic(), float("inf")

    def spent(self, tokens: int) -> float:
        """Share of the budget that is spent behind `tokens` tokens, 0 to 1."""
        share = tokens / self.tokens
        if self.seconds:
            running = time.monotonic() - self.compiled
            whole = self.seconds - (self.compiled - self.started if running >= 0 else 0.0)
            share = max(share, (self.earlier + max(0.0, running)) / max(whole, 1e-9))
        return min(1.0, share)


def learning_rate(settings: PretrainSettings, done: float) -> float:
    """Factor of the peak learning rate when `done` of the budget is spent: linear warm-up, plateau,
    linear decay to zero.
    """
    return max(0.0, min(1.0, done / settings.warmup, (1.0 - done) / settings.decay))


def batches(
    shards: list[Path], settings: PretrainSettings, skip: int, grids: Iterator[Grid] | None = None
) -> Iterator[Grid]:
    """Endless batches, of `grids` where these are given, else over the shards, in order, each one
    row; there the first `skip` are passed over.
    """
    if grids is not None:
        return grid_batches(grids, settings.batch_tokens // settings.width)
    width = max(settings.batch_tokens, settings.longest)
    drawn = (
        grid_of(*load_shard(shard), width, settings.seed + 7919 * epoch + index)
        for epoch in itertools.count()
        for index, shard in enumerate(shards)
    )
    return itertools.islice(grid_batches(drawn, 1), skip, None)


def completion_loss(model: Any, body: Any, grid: Grid, rank: int = 0, world: int = 1) -> Tensor:
    """Mean cross-entropy over the answer tokens of a grid, of this rank's samples where several
    processes run. The sum over the ranks is the loss of the grid.
    """
    answers = int((grid.labels != IGNORE).sum())
    ids, labels, positions, parts = map(torch.from_numpy, parts_of(grid, rank, world))
    places = (labels != IGNORE).nonzero().squeeze(1)
    with torch.autocast("cpu", dtype=torch.bfloat16):
        row = {"input_ids": ids[None], "position_ids": positions[None], "parts": parts}
        hidden = body(**row, use_cache=False)[0][0]
    found = summed_cross_entropy(hidden[places], model.lm_head.weight, labels[places])
    return found / max(1, answers)


def grid_loss(model: Any, body: Any, grid: Grid) -> Tensor:
    """Mean cross-entropy over the answer tokens of a grid, on the device of the model."""
    device = model.device
    found = np.flatnonzero(grid.labels != IGNORE)
    ids, positions, units, parts, targets, places = (
        torch.from_numpy(values.astype(np.int64)).to(device)
        for values in (
            *(grid.input_ids, grid.positions, grid.units, grid.parts),
            *(grid.labels.ravel()[found], found),
        )
    )
    with torch.autocast(device.type, dtype=torch.bfloat16):
        bias = bias_of(units, parts)
        hidden = body(input_ids=ids, position_ids=positions, bias=bias, use_cache=False)[0]
        logits = model.lm_head(hidden.flatten(0, 1)[places])
    return torch.nn.functional.cross_entropy(logits.float(), targets)


def layer_matrices(model: nn.Module) -> list[nn.Parameter]:
    """The layers' matrices, which 4-bit storage rounds: no embeddings, output or norms."""
    return [value for name, value in model.named_parameters() if _in_layer(name, value)]


def _in_layer(name: str, value: Tensor) -> bool:
    return value.ndim == 2 and "embed" not in name and "lm_head" not in name


def optimizers(model: nn.Module, settings: PretrainSettings) -> list[torch.optim.Optimizer]:
    """Muon for the layers' matrices, AdamW for embeddings and norms."""
    others = [value for name, value in model.named_parameters() if not _in_layer(name, value)]
    muon = torch.optim.Muon(
        layer_matrices(model),
        lr=settings.matrix_lr,
        weight_decay=settings.weight_decay,
        momentum=0.95,
        adjust_lr_fn="match_rms_adamw",
    )
    adamw = torch.optim.AdamW(others, lr=settings.other_lr, weight_decay=0.0, betas=(0.9, 0.98))
    return [muon, adamw]


def pretrain(
    model: Any,
    shards: list[Path],
    settings: PretrainSettings,
    *,
    folder: Path,
    grids: Iterator[Grid] | None = None,
) -> dict[str, Any]:
    """Train until the budget is spent; return tokens, steps, seconds and loss. `grids` are trained
    on instead of the shards.

    Resumes from `folder`/checkpoint.pt. Logs a JSON line per 20 steps to
    `folder`/log.jsonl and to the terminal.
    """
    rank, world = _join()
    if settings.dropout:
        add_dropout(model, settings.dropout)
    optims = optimizers(model, settings)
    matrices = layer_matrices(model)
    state = _restore(folder, model, optims)
    body, drawn = model.model, batches(shards, settings, state["step"], grids)
    if settings.compile:
        body = torch.compile(body, dynamic=grids is None)
    budget, saved = Budget(settings, state["seconds"]), time.monotonic()
    begin_tokens, losses = state["tokens"], list[Tensor]()
    for rows in drawn:
        factor = learning_rate(settings, budget.spent(state["tokens"]))
        for optim, peak in zip(optims, (settings.matrix_lr, settings.other_lr), strict=True):
            for group in optim.param_groups:
                group["lr"] = factor * peak
        with rounded(matrices) if settings.four_bit else nullcontext():
            if grids is None:
                loss = completion_loss(model, body, rows, rank, world)
            else:
                loss = grid_loss(model, body, rows)
            torch.autograd.backward(loss)
        losses.append(_summed(model, loss.detach(), world))
        torch.nn.utils.clip_grad_norm_(model.parameters(), settings.gradient_clip)
        for optim in optims:
            optim.step()
            optim.zero_grad(set_to_none=True)
        state["step"] += 1
        state["tokens"] += rows.tokens
        if len(losses) == 1:
            budget.compiled = time.monotonic()
        share = budget.spent(state["tokens"])
        done = share >= 1.0
        if rank == 0 and (state["step"] % 20 == 0 or done):
            seconds = time.monotonic() - budget.started
            rate = (state["tokens"] - begin_tokens) / seconds
            _log(folder, state, _mean(losses[-20:]), rate, seconds * (1 - share) / share)
        if done or time.monotonic() - saved > settings.checkpoint_seconds:
            state["seconds"] += time.monotonic() - saved
            saved = time.monotonic()
            if rank == 0:
                _save(folder, model, optims, state)
        if done:
            break
    return {**state, "loss": _mean(losses[-50:]), "settings": asdict(settings)}


def _mean(losses: list[Tensor]) -> float:
    return float(torch.stack(losses).mean())


def _join() -> tuple[int, int]:
    """This process's rank and the number of processes, joined when torchrun started several."""
    world = int(os.environ.get("WORLD_SIZE", "1"))
    if world > 1 and not torch.distributed.is_initialized():
        torch.distributed.init_process_group("gloo")
    return int(os.environ.get("RANK", "0")), world


def _summed(model: nn.Module, loss: Tensor, world: int) -> Tensor:
    """The loss of the whole batch; gradients are summed over the processes, in one message."""
    if world > 1:
        gradients = [value.grad for value in model.parameters() if value.grad is not None]
        message = torch.cat([gradient.flatten() for gradient in gradients] + [loss.reshape(1)])
        torch.distributed.all_reduce(message)
        parts = torch.split(message[:-1], [gradient.numel() for gradient in gradients])
        for gradient, part in zip(gradients, parts, strict=True):
            gradient.copy_(part.view_as(gradient))
        loss = message[-1]
    return loss


def _log(folder: Path, state: dict[str, Any], loss: float, rate: float, left: float) -> None:
    line = {"step": state["step"], "tokens": state["tokens"], "loss": round(loss, 4)}
    line["tokens_per_s"] = round(rate)
    done = f"{line['step']:6d}  {line['tokens'] / 1e6:6.2f} M tokens  loss {line['loss']:.4f}"
    print(f"{done}  {rate:6.0f} tok/s  {left / 60:5.1f} min left", flush=True)
    with open(folder / "log.jsonl", "a", encoding="utf-8") as stream:
        stream.write(json.dumps(line) + "\n")


def _save(
    folder: Path, model: nn.Module, optims: list[torch.optim.Optimizer], state: dict[str, Any]
) -> None:
    values = {"model": model.state_dict(), "optimizers": [one.state_dict() for one in optims]}
    torch.save({**values, "state": state}, folder / "checkpoint.tmp")
    (folder / "checkpoint.tmp").replace(folder / "checkpoint.pt")


def _restore(folder: Path, model: nn.Module, optims: list[torch.optim.Optimizer]) -> dict[str, Any]:
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / "checkpoint.pt"
    if not path.is_file():
        return {"step": 0, "tokens": 0, "seconds": 0.0}
    saved = torch.load(path, weights_only=True, map_location=getattr(model, "device", None))
    model.load_state_dict(saved["model"])
    for optim, values in zip(optims, saved["optimizers"], strict=True):
        optim.load_state_dict(values)
    state: dict[str, Any] = saved["state"]
    return state
