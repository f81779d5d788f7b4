"""A loaded candidate that answers as both agents."""

from __future__ import annotations

import contextlib
import functools
import gc
import itertools
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import torch

from planner_ft.candidates import Candidate
from planner_ft.candidates.loading import load_model, load_tokenizer, require_folder, resolve_device
from planner_ft.candidates.location import read_config
from planner_ft.candidates.registry import Quantization
from planner_ft.candidates.weights import FileTokenizer
from planner_ft.confidence.parts import Choice, Choices
from planner_ft.decoding import generate
from planner_ft.decoding.configurations import MAX_NEW_TOKENS, Configuration, Limits, Strength
from planner_ft.decoding.constraints.answer import Factory, constraint_factory
from planner_ft.decoding.constraints.scripts import STEP, MissionScript, TaskScript
from planner_ft.decoding.forward import SmallModel, read_forms
from planner_ft.decoding.generate import Answers, Generation, Queries
from planner_ft.decoding.lookup import Lookup, usual_plans
from planner_ft.decoding.passes import Decoder, ModelDecoder
from planner_ft.decoding.sequence import Method, Query, Sampling
from planner_ft.prompts import ends_of_answers, render_prompt
from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import Level, without_working


@dataclass
class Engine:
    """Model and tokenizer of a candidate. One base serves both levels and every configuration:
    adapters are switched, none is on for base.

    `lean` holds the lean forms of a small model (see `forward`) by adapter, None for the base;
    where it is empty, `model` decodes, a model of transformers. `adapters` are the levels that have
    one, `threads` the CPU threads that it decodes with; None leaves torch's number. `fast_forward`
    and `drafting` save forward passes, and no answer depends on them (see `sequence.Method`).
    """

    model: Any
    lean: dict[Level | None, SmallModel]
    tokenizer: Any
    vocabulary: Vocabulary
    limits: dict[Level, Limits]
    adapters: frozenset[Level]
    threads: int | None = None
    fast_forward: bool = True
    drafting: bool = True

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
        lean: bool | None = None,
    ) -> Engine:
        """Load a candidate, with the adapters of the levels that are given one.

        `max_new_tokens` limits every answer; None takes the level's default. `lean` asks for the
        lean forward pass; None takes it for small models on a CPU, which are then read without
        transformers where that can be. A model that has no lean form decodes as it is. Raises
        PlannerError when the candidate cannot be loaded.
        """
        target, given = resolve_device(device).type, adapters or {}
        # A stand-in stands for a large candidate and takes its way.
        if lean is None:
            lean = is_small(candidate, target) and not candidate.is_standin
        folder, forms, model = require_folder(candidate), None, None
        settings: Any = {"quantization": quantization, "vocabulary": vocabulary}
        if lean and target == "cpu":
            with limited_threads(threads):
                forms = read_forms(candidate, given, **settings)
        tokenizer: Any = FileTokenizer.read(folder) if forms else None
        tokenizer = tokenizer or load_tokenizer(candidate)
        if not forms:
            model = load_model(candidate, device=device, adapters=given, **settings)
        config, own = read_config(folder), read_config(folder, "generation_config.json")
        named = own.get("eos_token_id", config.get("eos_token_id"))
        ends, most = tuple(ends_of_answers(tokenizer, named)), MAX_NEW_TOKENS.items()
        limits = {level: Limits(ends, max_new_tokens or longest) for level, longest in most}
        how = limits, frozenset(given), threads
        return cls(model, forms or {}, tokenizer, vocabulary, *how)

    def query(
        self, level: Level, record: dict[str, Any], *, with_vocabulary: bool = False
    ) -> Query:
        """A question to a level's agent; a base model is shown the vocabulary."""
        known = self.tokenizer, self.vocabulary
        prompt = render_prompt(level, record, *known, with_vocabulary=with_vocabulary)
        return Query(level, record, tuple(prompt))

    def answer(self, query: Query, configuration: Configuration) -> Generation:
        """The answer to one query."""
        return next(answer for _index, answer in self.answers([query], configuration, batch_size=1))

    def answers(
        self,
        queries: Queries,
        configuration: Configuration,
        *,
        batch_size: int = 16,
        sampling: Sampling | None = None,
    ) -> Answers:
        """The answers as they are completed: greedy ones, or drawn with `sampling`. The queries are
        of one level.

        Raises PlannerError when the level has no adapter that the configuration needs, or the token
        limit is too small for its strength.
        """
        if level := _level(queries):
            method, limits = self.method(level, configuration, sampling), self.limits[level]
            with self.configured(level, configuration) as decoder:
                how = decoder, queries, limits, method
                yield from generate.generate_unordered(*how, batch_size=batch_size)

    def latencies(
        self, queries: Queries, configuration: Configuration, sampling: Sampling | None = None
    ) -> Answers:
        """The answers, one query after the other; `seconds` are those from prompt ids to the
        complete answer.

        A whole query runs first and is not counted: kernels are chosen, 4-bit weights packed and
        grammars compiled then.
        """
        if level := _level(queries):
            method, limits = self.method(level, configuration, sampling), self.limits[level]
            with self.configured(level, configuration) as decoder:
                for place, query in enumerate([queries[0], *queries]):
                    started = time.perf_counter()
                    (answer,) = generate.generate(decoder, [query], limits, method)
                    # The last token has been read from the device: nothing is left running.
                    if place:
                        yield place - 1, replace(answer, seconds=time.perf_counter() - started)

    def method(
        self, level: Level, configuration: Configuration, sampling: Sampling | None = None
    ) -> Method:
        """How the answers of a configuration are generated."""
        opens = MissionScript.opens if level == "mission" else STEP + TaskScript.opens
        return Method(
            self._factory(level, configuration.strength),
            self.fast_forward,
            self._base(level) if self.drafting else None,
            sampling,
            lambda ids: self._decoded(ids).count(opens),
        )

    def text(self, answer: Generation) -> str:
        """The text of an answer without its end token and its working; other specials are shown."""
        return without_working(self._decoded(answer.said))[0]

    def working(self, answer: Generation) -> str:
        """The sums that a model wrote before a skill sequence (planner_ft.data.task.working)."""
        return without_working(self._decoded(answer.said))[1]

    def choices(self, answer: Generation) -> Choices | None:
        """The tokens of `text(answer)` with the model's own odds; None where unknown."""
        ids = answer.said
        text = self._decoded(ids)
        scores = [scored for scored in answer.scores[: len(ids)] if scored is not None]
        if len(scores) < len(ids):
            return None
        ends = list(itertools.accumulate(len(self._piece(token)) for token in ids))
        if ids and ends[-1:] != [len(text)]:
            # Some tokens are parts of a letter, or are written otherwise when they stand alone.
            parts = (self._decoded(ids[: count + 1]) for count in range(len(ids)))
            ends = [len(part.rstrip("\ufffd")) for part in parts]
        hidden = 1, 1 + len(text) - len(without_working(text)[0])
        found = []
        for start, end, scored in zip([0, *ends], ends, scores, strict=False):
            cut = max(0, min(end, hidden[1]) - max(start, hidden[0]))
            others = tuple((self._piece(token), logprob) for token, logprob in scored.others)
            found.append(Choice(end - start - cut, scored.logprob, others))
        return tuple(found)

    def _decoded(self, ids: Sequence[int]) -> str:
        plain = {"skip_special_tokens": False, "clean_up_tokenization_spaces": False}
        return str(self.tokenizer.decode(list(ids), **plain))

    def release(self) -> None:
        """Give the model's memory back."""
        self.model, self.lean = None, {}
        gc.collect()
        if torch.cuda.is_available():
            torch.cuda.empty_cache()

    @contextlib.contextmanager
    def configured(self, level: Level, configuration: Configuration) -> Iterator[Decoder]:
        """The model with the adapter of the level, or none, as the configuration says."""
        if configuration.adapter and level not in self.adapters:
            lack = f"needs an adapter of the {level} level; give --adapter"
            raise PlannerError(f"configuration {configuration.name} {lack}")
        adapter = level if configuration.adapter else None
        with limited_threads(self.threads):
            if self.lean:
                yield self.lean[adapter]
                return
            if adapter:
                self.model.set_adapter(adapter, inference_mode=True)
            plain = self.adapters and not adapter
            with self.model.disable_adapter() if plain else contextlib.nullcontext():
                yield ModelDecoder(self.model)

    @functools.cached_property
    def _factory(self) -> Callable[[Level, Strength], Factory | None]:
        """What enforces a strength at a level."""
        small, model = self.lean.get(None), self.model
        width = small.head.shape[0] if small else model.config.get_text_config().vocab_size

        @functools.cache
        def factory(level: Level, strength: Strength) -> Factory | None:
            limits = self.limits[level]
            how = self.tokenizer, level, self.vocabulary, strength
            return constraint_factory(*how, limits.end_ids, limits.max_new_tokens, width)

        return factory

    @functools.cached_property
    def _base(self) -> Callable[[Level], Lookup]:
        """How plans of a level are put together, to draft from. Tokens are alike that differ in
        case or in the space before them alone.
        """
        likeness = functools.cache(lambda token: self._piece(token).strip().lower() or token)

        @functools.cache
        def base(level: Level) -> Lookup:
            texts, end = usual_plans(level, self.vocabulary), self.limits[level].end_ids[0]
            plans = self.tokenizer(texts, add_special_tokens=False)["input_ids"]
            return Lookup([token for plan in plans for token in (*plan, end)], likeness)

        return base

    @functools.cached_property
    def _piece(self) -> Callable[[int], str]:
        """The text of a token that stands alone."""
        return functools.cache(lambda token: self._decoded([token]))


def _level(queries: Queries) -> Level | None:
    """The level of the queries; None where there are none."""
    levels = {query.level for query in queries}
    if len(levels) > 1:
        raise ValueError("the queries of one call are of one level")
    return levels.pop() if levels else None


def is_small(candidate: Candidate, device: str) -> bool:
    """Whether a token's time on a CPU goes to everything but the multiplications."""
    from planner_ft.training.model import SMALL_MODEL

    return device == "cpu" and (candidate.parameters or SMALL_MODEL) < SMALL_MODEL


def decoding_threads(candidate: Candidate, device: str) -> int | None:
    """CPU threads to decode with: one for small models; a busy core holds up more."""
    return 1 if is_small(candidate, device) else None


@contextlib.contextmanager
def limited_threads(threads: int | None) -> Iterator[None]:
    """In the block, torch computes with this number of CPU threads."""
    before = torch.get_num_threads()
    torch.set_num_threads(threads or before)
    try:
        yield
    finally:
        torch.set_num_threads(before)
