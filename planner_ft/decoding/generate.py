"""Greedy generation in batches: the most probable token, nothing enforced, sampling settings of the model ignored.

The loop is our own and not `model.generate`: rows that have ended leave the batch instead of being computed to its
end, the cache is not copied at every token, and every answer is handed over the moment that it is complete.
"""

from __future__ import annotations

import inspect
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any, Literal

import torch

from planner_ft.decoding.cache import new_cache
from planner_ft.decoding.limits import Limits
from planner_ft.support.errors import PlannerError

FinishReason = Literal["stop", "length", "error"]


@dataclass(frozen=True)
class Generation:
    """One answer. `ids` are the generated tokens with the one that ended it, `seconds` its share of the batch's time.

    `finish_reason`: "stop" (an end-of-turn token), "length" (cut at the limit) or "error" (`error` says why).
    """

    ids: tuple[int, ...]
    finish_reason: FinishReason
    seconds: float
    error: str | None = None


def generate(model: Any, prompts: Sequence[list[int]], limits: Limits, *, batch_size: int = 16) -> list[Generation]:
    """Answers to prompts (token ids), in the order of the prompts."""
    answers = dict(generate_unordered(model, prompts, limits, batch_size=batch_size))
    return [answers[index] for index in range(len(prompts))]


def generate_unordered(model: Any, prompts: Sequence[list[int]], limits: Limits, *, batch_size: int = 16) -> Iterator[tuple[int, Generation]]:
    """Yield (index of the prompt, answer) as answers are completed, batch by batch, longest prompts first.

    Prompts of similar length share a batch, and the largest memory is needed at the start, not after an hour. In
    float32 an answer does not depend on the batch. Raises PlannerError when a batch does not fit the memory.
    """
    context = getattr(model.config, "max_position_embeddings", None)
    fitting = []
    for index, prompt in enumerate(prompts):
        if context is not None and len(prompt) >= context:
            yield index, Generation((), "error", 0.0, f"the prompt of {len(prompt)} tokens leaves no room in the model's context of {context}")
        else:
            fitting.append(index)
    fitting.sort(key=lambda index: -len(prompts[index]))
    for start in range(0, len(fitting), batch_size):
        batch = fitting[start : start + batch_size]
        try:
            for row, generation in _generate_batch(model, [prompts[index] for index in batch], limits, context):
                yield batch[row], generation
        except torch.OutOfMemoryError as error:
            raise PlannerError(
                f"the device has too little memory for --batch-size {batch_size}; give a smaller one (what is done is kept for --resume)"
            ) from error


@torch.inference_mode()
def _generate_batch(model: Any, prompts: list[list[int]], limits: Limits, context: int | None) -> Iterator[tuple[int, Generation]]:
    """Yield (row, answer) as rows end."""
    started, share = time.perf_counter(), 0.0
    tokens, mask = _padded(prompts, limits.pad_id, model.device)
    positions = (mask.cumsum(1) - 1).clamp(min=0)
    ends = torch.tensor(limits.end_ids, device=model.device)
    cache, options = new_cache(model.config), _forward_options(model)
    rows = list(range(len(prompts)))
    answers: list[list[int]] = [[] for _ in prompts]
    longest = [min(limits.max_new_tokens, (context or 2**62) - len(prompt)) for prompt in prompts]
    while rows:
        chosen = _next_tokens(model, tokens, mask, positions, cache, options)
        ended = torch.isin(chosen, ends).tolist()
        # Reading the tokens waits for the device, so the time below is that of the whole step.
        for row, token in zip(rows, chosen.tolist(), strict=True):
            answers[row].append(token)
        now = time.perf_counter()
        share, started = share + (now - started) / len(rows), now
        kept = [place for place, row in enumerate(rows) if not ended[place] and len(answers[row]) < longest[row]]
        for place in sorted(set(range(len(rows))) - set(kept)):
            yield rows[place], Generation(tuple(answers[rows[place]]), "stop" if ended[place] else "length", share)
        if len(kept) < len(rows):
            rows = [rows[place] for place in kept]
            index = torch.tensor(kept, dtype=torch.long, device=model.device)
            chosen, mask, positions = chosen[index], mask[index], positions[index]
            cache.batch_select_indices(index)
        tokens = chosen[:, None]
        mask = torch.cat([mask, mask.new_ones(len(rows), 1)], 1)
        positions = positions[:, -1:] + 1


def _next_tokens(model: Any, tokens: torch.Tensor, mask: torch.Tensor, positions: torch.Tensor, cache: Any, options: dict[str, Any]) -> torch.Tensor:
    """One forward pass over (batch, new positions); return the most probable next token of each row, shape (batch,)."""
    output = model(input_ids=tokens, attention_mask=mask, position_ids=positions, past_key_values=cache, use_cache=True, **options)
    chosen: torch.Tensor = output.logits[:, -1].argmax(-1)
    return chosen


def _forward_options(model: Any) -> dict[str, Any]:
    """Compute the last position's logits alone, if the model can: with a vocabulary of 128k that saves gigabytes."""
    base = model.get_base_model() if hasattr(model, "get_base_model") else model
    return {"logits_to_keep": 1} if "logits_to_keep" in inspect.signature(base.forward).parameters else {}


def _padded(prompts: list[list[int]], pad_id: int, device: Any) -> tuple[torch.Tensor, torch.Tensor]:
    """Ids padded on the left, and the attention mask."""
    width = max(len(prompt) for prompt in prompts)
    ids = torch.tensor([[pad_id] * (width - len(prompt)) + prompt for prompt in prompts], device=device)
    mask = torch.tensor([[0] * (width - len(prompt)) + [1] * len(prompt) for prompt in prompts], device=device)
    return ids, mask
