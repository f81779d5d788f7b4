"""A loaded candidate that answers records of one level."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from planner_ft.candidates import Candidate
from planner_ft.candidates.loading import load_model, load_tokenizer
from planner_ft.candidates.registry import Quantization
from planner_ft.decoding.configurations import Configuration
from planner_ft.decoding.generate import Generation, Limits, generate_unordered
from planner_ft.decoding.latency import Latency, measure_latency
from planner_ft.prompts import end_of_turn_ids, render_prompt
from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import Level


@dataclass
class Engine:
    """Model and tokenizer of a candidate. One model serves all its configurations: the adapter is switched off for base.

    `threads` are the CPU threads that it decodes with; None leaves torch's number.
    """

    model: Any
    tokenizer: Any
    level: Level
    vocabulary: Vocabulary
    limits: Limits
    has_adapter: bool
    threads: int | None = None

    @classmethod
    def load(
        cls,
        candidate: Candidate,
        level: Level,
        vocabulary: Vocabulary,
        *,
        max_new_tokens: int,
        device: str = "auto",
        quantization: Quantization = "nf4",
        adapter: Path | None = None,
        threads: int | None = None,
    ) -> Engine:
        """Load a candidate, with its adapter if one is given. Raises PlannerError when it cannot be loaded."""
        tokenizer = load_tokenizer(candidate)
        model = load_model(candidate, device=device, quantization=quantization, adapter=adapter, level=level, vocabulary=vocabulary)
        limits = Limits(end_ids(tokenizer, model), int(tokenizer.pad_token_id), max_new_tokens)
        return cls(model, tokenizer, level, vocabulary, limits, adapter is not None, threads)

    def prompt(self, record: dict[str, Any], *, with_vocabulary: bool) -> list[int]:
        """Prompt ids of a record."""
        return render_prompt(self.level, record, self.tokenizer, self.vocabulary, with_vocabulary=with_vocabulary)

    def answers(self, prompts: Sequence[list[int]], configuration: Configuration, *, batch_size: int) -> Iterator[tuple[int, Generation]]:
        """Yield (index of the prompt, answer) as answers are completed."""
        with self._configured(configuration):
            yield from generate_unordered(self.model, prompts, self.limits, batch_size=batch_size)

    def latencies(self, prompts: Sequence[list[int]], configuration: Configuration) -> Iterator[tuple[int, Latency]]:
        """Yield (index of the prompt, latency), one query at a time."""
        with self._configured(configuration):
            yield from measure_latency(self.model, prompts, self.limits)

    def text(self, answer: Generation) -> str:
        """The raw text of an answer, without the token that ended it; other special tokens stay visible."""
        ids = answer.ids[:-1] if answer.finish_reason == "stop" else answer.ids
        return str(self.tokenizer.decode(list(ids), skip_special_tokens=False, clean_up_tokenization_spaces=False))

    def release(self) -> None:
        """Give the model's memory back."""
        import gc

        import torch

        self.model = None
        gc.collect()
        if torch.cuda.is_available():
            torch.cuda.empty_cache()

    @contextlib.contextmanager
    def _configured(self, configuration: Configuration) -> Iterator[None]:
        if configuration.adapter and not self.has_adapter:
            raise PlannerError(f"configuration {configuration.name} needs an adapter; give --adapter")
        with limited_threads(self.threads), contextlib.nullcontext() if configuration.adapter or not self.has_adapter else self.model.disable_adapter():
            yield


def decoding_threads(candidate: Candidate, device: str) -> int | None:
    """CPU threads to decode with: one for small models, as in training, where a busy core would hold up every operation."""
    from planner_ft.training.model import SMALL_MODEL

    return 1 if device == "cpu" and (candidate.parameters or SMALL_MODEL) < SMALL_MODEL else None


@contextlib.contextmanager
def limited_threads(threads: int | None) -> Iterator[None]:
    """In the block, torch computes with this number of CPU threads."""
    import torch

    before = torch.get_num_threads()
    torch.set_num_threads(threads or before)
    try:
        yield
    finally:
        torch.set_num_threads(before)


def end_ids(tokenizer: Any, model: Any) -> tuple[int, ...]:
    """Tokens that end an answer: those of the prompt's form, and those that the model's generation settings name."""
    more = getattr(model.generation_config, "eos_token_id", None)
    more = [more] if isinstance(more, int) else list(more or [])
    return tuple(dict.fromkeys([*end_of_turn_ids(tokenizer), *more]))
