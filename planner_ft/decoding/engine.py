"""A loaded candidate that answers as both agents."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from planner_ft.candidates import Candidate
from planner_ft.candidates.loading import load_model, load_tokenizer
from planner_ft.candidates.registry import Quantization
from planner_ft.decoding.configurations import Configuration
from planner_ft.decoding.generate import Generation, generate_unordered
from planner_ft.decoding.latency import Latency, measure_latency
from planner_ft.decoding.limits import MAX_NEW_TOKENS, Limits
from planner_ft.prompts import end_of_turn_ids, render_prompt
from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import Level


@dataclass(frozen=True)
class Query:
    """A question to the agent of a level: its record ({"prompt", ...}), and the ids of the prompt that it is rendered into."""

    level: Level
    record: dict[str, Any]
    prompt: tuple[int, ...]


@dataclass
class Engine:
    """Model and tokenizer of a candidate. One base serves both levels and every configuration: adapters are switched, none is on for base.

    `adapters` are the levels that have one, `threads` the CPU threads that it decodes with; None leaves torch's number.
    """

    model: Any
    tokenizer: Any
    vocabulary: Vocabulary
    limits: dict[Level, Limits]
    adapters: frozenset[Level]
    threads: int | None = None

    @classmethod
    def load(
        cls,
        candidate: Candidate,
        vocabulary: Vocabulary,
        *,
        adapters: Mapping[Level, Path] | None = None,
        max_new_tokens: int | None = None,
        device: str = "auto",
        quantization: Quantization = "nf4",
        threads: int | None = None,
    ) -> Engine:
        """Load a candidate, with the adapters of the levels that are given one.

        `max_new_tokens` limits every answer; None takes the level's default. Raises PlannerError when it cannot be loaded.
        """
        tokenizer = load_tokenizer(candidate)
        model = load_model(candidate, device=device, quantization=quantization, adapters=adapters, vocabulary=vocabulary)
        ends, pad = end_ids(tokenizer, model), int(tokenizer.pad_token_id)
        limits = {level: Limits(ends, pad, max_new_tokens or default) for level, default in MAX_NEW_TOKENS.items()}
        return cls(model, tokenizer, vocabulary, limits, frozenset(adapters or ()), threads)

    def query(self, level: Level, record: dict[str, Any], *, with_vocabulary: bool = False) -> Query:
        """A question to the agent of a level. `with_vocabulary` is for base models, which have not learned it."""
        return Query(level, record, tuple(render_prompt(level, record, self.tokenizer, self.vocabulary, with_vocabulary=with_vocabulary)))

    def answer(self, query: Query, configuration: Configuration) -> Generation:
        """The answer to one query."""
        return next(answer for _index, answer in self.answers([query], configuration, batch_size=1))

    def answers(self, queries: Sequence[Query], configuration: Configuration, *, batch_size: int = 16) -> Iterator[tuple[int, Generation]]:
        """Yield (index of the query, answer) as answers are completed. The queries are of one level."""
        if not queries:
            return
        level = _only_level(queries)
        with self._configured(level, configuration):
            yield from generate_unordered(self.model, [list(query.prompt) for query in queries], self.limits[level], batch_size=batch_size)

    def latencies(self, queries: Sequence[Query], configuration: Configuration) -> Iterator[tuple[int, Latency]]:
        """Yield (index of the query, latency), one query at a time. The queries are of one level."""
        if not queries:
            return
        level = _only_level(queries)
        with self._configured(level, configuration):
            yield from measure_latency(self.model, [list(query.prompt) for query in queries], self.limits[level])

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
    def _configured(self, level: Level, configuration: Configuration) -> Iterator[None]:
        """In the block the model has the adapter of the level, or none, as the configuration says."""
        if configuration.adapter and level not in self.adapters:
            raise PlannerError(f"configuration {configuration.name} needs an adapter of the {level} level; give --adapter")
        if configuration.adapter:
            self.model.set_adapter(level, inference_mode=True)
        with limited_threads(self.threads), contextlib.nullcontext() if configuration.adapter or not self.adapters else self.model.disable_adapter():
            yield


def _only_level(queries: Sequence[Query]) -> Level:
    levels = {query.level for query in queries}
    if len(levels) > 1:
        raise ValueError("the queries of one call are of one level")
    return levels.pop()


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
