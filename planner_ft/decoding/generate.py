"""Greedy generation, or sampling where a method asks for it: settings for sampling that the model
brings are ignored.

The loop is our own and not `model.generate`: drafts share a forward pass, sequences that have ended
leave the batch, and every answer is handed over the moment that it is complete.
"""

import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import islice
from typing import Any

import torch

from planner_ft.decoding.configurations import Limits
from planner_ft.decoding.constraints import RAN_ON
from planner_ft.decoding.passes import Decoder
from planner_ft.decoding.sequence import FinishReason, Method, Query, Score, SequenceState, scores
from planner_ft.support.errors import PlannerError


@dataclass(frozen=True)
class Generation:
    """One answer. `ids` are the generated tokens with the one that ended it, `seconds` its share of
    the batch's time.

    `finish_reason`: "stop" (an end-of-turn token), "length" (cut at the limit) or "error" (`error`
    says why). `first_token_s` is the time from the batch's begin until its first tokens were known.
    `forward_passes` are those that the answer took part in, those of answers that it was compared
    with included; `alternatives` counts these. `notes` and `cut` are the constraint's. `scores` are
    those of `ids`, None where no pass has decided a token.
    """

    ids: tuple[int, ...]
    finish_reason: FinishReason
    seconds: float
    error: str | None = None
    forward_passes: int = 0
    first_token_s: float | None = None
    scores: tuple[Score | None, ...] = ()
    notes: tuple[str, ...] = ()
    cut: bool = False
    alternatives: int = 0

    @property
    def said(self) -> tuple[int, ...]:
        """The tokens without the one that ended the answer."""
        return self.ids[:-1] if self.finish_reason == "stop" else self.ids


PLAIN = Method(fast_forward=False, lookup=None)
"""Greedy generation, a forward pass per token."""
Queries = Sequence[Query]
Answers = Iterator[tuple[int, Generation]]
"""Answers as they are completed, each with the index of its query."""


def generate(
    decoder: Decoder, queries: Queries, limits: Limits, method: Method = PLAIN, batch_size: int = 16
) -> list[Generation]:
    """Answers in the order of the queries."""
    answers = dict(generate_unordered(decoder, queries, limits, method, batch_size=batch_size))
    return [answers[index] for index in range(len(queries))]


def generate_unordered(
    decoder: Decoder, queries: Queries, limits: Limits, method: Method = PLAIN, batch_size: int = 16
) -> Answers:
    """The answers as they are completed, batch by batch, longest prompts first: the largest memory
    is needed at the start.

    In float32 an answer does not depend on the batch. Raises PlannerError when a batch does not fit
    the memory.
    """
    order = sorted(range(len(queries)), key=lambda index: -len(queries[index].prompt))
    for start in range(0, len(order), batch_size):
        states: dict[int, SequenceState] = {}
        began = time.perf_counter()
        for index in order[start : start + batch_size]:
            query = queries[index]
            try:
                states[index] = SequenceState(query, method, limits, _room(decoder, query, limits))
            except PlannerError as error:
                yield index, Generation((), "error", 0.0, str(error))
        try:
            for index, answer in _run(decoder, dict(states), began):
                yield index, _bounded(decoder, states[index], answer)
        except torch.OutOfMemoryError as error:
            lack = f"the device has too little memory for --batch-size {batch_size}"
            way = "give a smaller one (what is done is kept for --resume)"
            raise PlannerError(f"{lack}; {way}") from error


def _room(decoder: Decoder, query: Query, limits: Limits) -> int:
    """Tokens that an answer may have."""
    context, taken = decoder.context, len(query.prompt)
    if context is not None and taken >= context:
        full = f"leaves no room in the model's context of {context}"
        raise PlannerError(f"the prompt of {taken} tokens {full}")
    return min(limits.max_new_tokens, context - taken if context else limits.max_new_tokens)


def _bounded(decoder: Decoder, state: SequenceState, answer: Generation) -> Generation:
    """The answer, or where it ran on beyond the free one, an answer of bounded length that is held
    to the schema alone; with the cost of all. The free answer begins as this one does up to where
    they diverged, and is only generated until it is long enough.
    """
    method, diverged, entries = state.method, state.diverged, state.method.entries
    if entries is None or diverged is None:
        return answer
    made = entries(answer.ids)
    if made <= 2 * entries(answer.ids[:diverged]) + 2 and not answer.cut:
        return answer

    def enough(ids: Sequence[int]) -> bool:
        return not answer.cut and made <= 2 * entries(ids) + 2

    def run(way: Method, **settings: Any) -> Generation:
        other = SequenceState(state.query, way, state.limits, state.longest, **settings)
        return next(found for _index, found in _run(decoder, {0: other}, time.perf_counter()))

    free = run(replace(method, constraint=None), begun=answer.ids[:diverged], enough=enough)
    count, others = entries(free.ids), [free]
    kept = answer
    if made > 2 * count + 2 or (answer.cut and free.finish_reason == "stop"):
        kept = run(method, most=2 * count + 2)
        kept = replace(kept, notes=(*kept.notes, RAN_ON), first_token_s=answer.first_token_s)
        others.append(answer)
    return replace(
        kept,
        seconds=kept.seconds + sum(other.seconds for other in others),
        forward_passes=kept.forward_passes + sum(other.forward_passes for other in others),
        alternatives=len(others),
    )


@torch.inference_mode()
def _run(decoder: Decoder, states: dict[int, SequenceState], began: float) -> Answers:
    """The answers as sequences end. `began` is when the work on the batch did."""
    share, first = 0.0, 0.0
    passes = decoder.start(len(states))
    while states:
        alone = len(states) == 1
        fed = [state.feed(wide=passes.wide, alone=alone) for state in states.values()]
        wanted = [count for _ids, count in fed]
        logits = passes.run([ids for ids, _count in fed], wanted).float()
        # Reading the tokens waits for the device, so the time below is that of the whole step.
        best, rows = iter(logits.argmax(-1).tolist()), torch.split(logits, wanted)
        decided = [
            state.choose(list(islice(best, len(own))), own)
            for state, own in zip(states.values(), rows, strict=True)
        ]
        # What stood behind a wrong draft has no scores.
        right = torch.cat([own[: len(ids)] for own, ids in zip(rows, decided, strict=True)])
        scored = scores([token for ids in decided for token in ids], right)
        for state, ids in zip(states.values(), decided, strict=True):
            state.rate(islice(scored, len(ids)))
        now = time.perf_counter()
        first = first or now - began
        share, began = share + (now - began) / len(states), now
        kept = [place for place, state in enumerate(states.values()) if not state.finished]
        for index, state in list(states.items()):
            if state.finished:
                yield index, _generation(states.pop(index), share, first)
        began = time.perf_counter()
        if states:
            passes.forget([count - len(ids) for count, ids in zip(wanted, decided, strict=True)])
            if len(kept) < len(wanted):
                passes.select(kept)


def _generation(state: SequenceState, seconds: float, first: float) -> Generation:
    assert state.finished is not None
    known, passes, scored = state.constraint, state.forward_passes, tuple(state.scores)
    made = Generation(tuple(state.ids), state.finished, seconds, None, passes, first, scored)
    return replace(made, notes=tuple(known.notes), cut=known.cut) if known else made
