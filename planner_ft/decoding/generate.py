"""Greedy generation, or sampling where a method asks for it: settings for sampling that the model
brings are ignored.

The loop is our own and not `model.generate`: tokens that need no choice or were drafted rightly
share a forward pass, rows that have ended leave the batch instead of being computed to its end, the
cache is not copied at every token, and every answer is handed over the moment that it is complete.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

import torch

from planner_ft.decoding.constraints import ConstraintFactory
from planner_ft.decoding.drafting import Drafter, Likeness, PhraseBook
from planner_ft.decoding.limits import Limits
from planner_ft.decoding.passes import Decoder
from planner_ft.decoding.row import FinishReason, Row
from planner_ft.decoding.sampling import Sampling
from planner_ft.decoding.second_look import SecondLook
from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary.plans import Level

MOST_BACK = 8
"""Times that an answer goes back to a choice before."""


@dataclass(frozen=True)
class Query:
    """A question to the agent of a level: its record ({"prompt", ...}), and the ids of the prompt
    that it is rendered into.
    """

    level: Level
    record: dict[str, Any]
    prompt: tuple[int, ...]

    @property
    def name(self) -> str:
        """What tells the query from others: the record's id, or the prompt's."""
        return str(self.record.get("id") or self.prompt)


@dataclass(frozen=True)
class Generation:
    """One answer. `ids` are the generated tokens with the one that ended it, `seconds` its share of
    the batch's time.

    `finish_reason`: "stop" (an end-of-turn token), "length" (cut at the limit) or "error" (`error`
    says why). `first_token_s` is the time from the batch's begin until its first tokens were known.
    `forward_passes` are those that the answer took part in, those of a second look and of going
    back included. Of its tokens, `forced_tokens` left no choice and `drafted_tokens` were drafted
    rightly. `notes` and `cut` are the constraint's (see `constraints`), `alternatives` the answers
    that a second look weighed against it.
    """

    ids: tuple[int, ...]
    finish_reason: FinishReason
    seconds: float
    error: str | None = None
    forward_passes: int = 0
    forced_tokens: int = 0
    drafted_tokens: int = 0
    notes: tuple[str, ...] = ()
    cut: bool = False
    first_token_s: float | None = None
    alternatives: int = 0


@dataclass(frozen=True)
class Method:
    """How tokens are chosen, and what saves forward passes; an answer depends on `constraint`,
    `sampling` and `second_look` alone.

    Without `sampling` the most probable token is taken, and `second_look` decides which answers are
    weighed against others. `constraint` is enforced, and with `fast_forward` the tokens that it
    forces are fed together. With `drafting` likely tokens are verified in one pass, from the
    prompt, the answer so far and `book` (see `drafting`). `mend(record, ids)` gives what an answer
    that leaves out something is written again with, or None.
    """

    constraint: ConstraintFactory | None = None
    fast_forward: bool = True
    drafting: bool = True
    likeness: Likeness = lambda token: token
    book: PhraseBook | None = None
    sampling: Sampling | None = None
    second_look: SecondLook | None = None
    mend: Callable[[dict[str, Any], Sequence[int]], ConstraintFactory | None] | None = None

    def row(
        self,
        query: Query,
        limits: Limits,
        longest: int,
        begun: Sequence[int] = (),
        *,
        goes_back: bool = True,
    ) -> Row:
        """The beginning of an answer, its first tokens `begun`; it `goes_back` where a choice
        proves wrong.

        Raises PlannerError when the constraint needs more room than `longest` tokens.
        """
        constraint = self.constraint.start(query.record, longest) if self.constraint else None
        drafter = Drafter(query.prompt, self.likeness, self.book) if self.drafting else None
        sampler = self.sampling.sampler(query.name, longest) if self.sampling else None
        remembers = self.second_look is not None and sampler is None
        return Row(
            query.prompt,
            limits,
            longest,
            constraint,
            drafter,
            fast_forward=self.fast_forward,
            sampler=sampler,
            begun=begun,
            remembers=remembers,
            goes_back=goes_back and sampler is None,
        )


PLAIN = Method(fast_forward=False, drafting=False)
"""Greedy generation, a forward pass per token."""


def generate(
    decoder: Decoder,
    queries: Sequence[Query],
    limits: Limits,
    method: Method = PLAIN,
    *,
    batch_size: int = 16,
) -> list[Generation]:
    """Answers in the order of the queries."""
    answers = dict(generate_unordered(decoder, queries, limits, method, batch_size=batch_size))
    return [answers[index] for index in range(len(queries))]


def generate_unordered(
    decoder: Decoder,
    queries: Sequence[Query],
    limits: Limits,
    method: Method = PLAIN,
    *,
    batch_size: int = 16,
) -> Iterator[tuple[int, Generation]]:
    """Yield (index of the query, answer) as answers are completed, batch by batch, longest prompts
    first.

    Prompts of similar length share a batch, and the largest memory is needed at the start, not
    after an hour. In float32 an answer does not depend on the batch. Raises PlannerError when a
    batch does not fit the memory.
    """
    order = sorted(range(len(queries)), key=lambda index: -len(queries[index].prompt))
    for start in range(0, len(order), batch_size):
        rows: dict[int, Row] = {}
        began = time.perf_counter()
        for index in order[start : start + batch_size]:
            try:
                rows[index] = _begin(decoder, queries[index], limits, method)
            except PlannerError as error:
                yield index, Generation((), "error", 0.0, str(error))
        try:
            for index, answer in _generate_batch(decoder, dict(rows), began):
                row, whole = _gone_back(
                    decoder, queries[index], limits, method, rows[index], answer
                )
                looked = _look_again(decoder, queries[index], limits, method, row, whole)
                yield index, _mended(decoder, queries[index], limits, method, looked)
        except torch.OutOfMemoryError as error:
            raise PlannerError(
                f"the device has too little memory for --batch-size {batch_size}; give a smaller"
                " one (what is done is kept for --resume)"
            ) from error


def _begin(
    decoder: Decoder,
    query: Query,
    limits: Limits,
    method: Method,
    begun: Sequence[int] = (),
    *,
    goes_back: bool = True,
) -> Row:
    room = (
        limits.max_new_tokens
        if decoder.context is None
        else min(limits.max_new_tokens, decoder.context - len(query.prompt))
    )
    if room < 1:
        raise PlannerError(
            f"the prompt of {len(query.prompt)} tokens leaves no room in the model's context of"
            f" {decoder.context}"
        )
    return method.row(query, limits, room, begun, goes_back=goes_back)


def _gone_back(
    decoder: Decoder, query: Query, limits: Limits, method: Method, row: Row, answer: Generation
) -> tuple[Row, Generation]:
    """The whole answer, where one was left in the middle because a choice before proved wrong, and
    its row; with the cost of every beginning.
    """
    for left in range(MOST_BACK - 1, -1, -1):
        if row.back is None:
            break
        row = _begin(decoder, query, limits, method, row.back, goes_back=left > 0)
        ((_index, again),) = _generate_batch(decoder, {0: row}, time.perf_counter())
        passes, seconds = (
            answer.forward_passes + again.forward_passes,
            answer.seconds + again.seconds,
        )
        answer = replace(
            again, seconds=seconds, forward_passes=passes, first_token_s=answer.first_token_s
        )
    return row, answer


def _look_again(
    decoder: Decoder, query: Query, limits: Limits, method: Method, row: Row, answer: Generation
) -> Generation:
    """The answer, or an alternative to it that a second look prefers; with the cost of all that
    were tried.
    """
    look = method.second_look
    if look is None or not row.choices or not look.asked(query.record, row):
        return answer
    began, passes = time.perf_counter(), answer.forward_passes
    rows, chosen = [(row, 0.0)], 0
    for _round in range(look.rounds):
        beginnings = look.beginnings(*rows[chosen])
        others = [
            _begin(decoder, query, limits, method, beginning.ids, goes_back=False)
            for beginning in beginnings
        ]
        for _index, _answer in _generate_batch(
            decoder,
            {index: other for index, other in enumerate(others) if not other.finished},
            began,
        ):
            pass
        passes += max((other.forward_passes for other in others), default=0)
        rows += [
            (other, beginning.logprob) for other, beginning in zip(others, beginnings, strict=True)
        ]
        before, chosen = chosen, look.best(query.record, rows)
        if chosen == before or not look.asked(query.record, rows[chosen][0]):
            break
    seconds = answer.seconds + time.perf_counter() - began
    answer = (
        _generation(rows[chosen][0], seconds, answer.first_token_s or 0.0) if chosen else answer
    )
    return replace(answer, seconds=seconds, forward_passes=passes, alternatives=len(rows) - 1)


def _mended(
    decoder: Decoder, query: Query, limits: Limits, method: Method, answer: Generation
) -> Generation:
    """The answer, or one that was written again because it left something out; with the cost of
    both.
    """
    if method.mend is None or method.sampling is not None or answer.finish_reason != "stop":
        return answer
    constraint = method.mend(query.record, answer.ids)
    if constraint is None:
        return answer
    method = replace(method, constraint=constraint)
    row = _begin(decoder, query, limits, method)
    ((_index, begun),) = _generate_batch(decoder, {0: row}, time.perf_counter())
    _row, again = _gone_back(decoder, query, limits, method, row, begun)
    if again.finish_reason != "stop":
        return answer
    passes, seconds = answer.forward_passes + again.forward_passes, answer.seconds + again.seconds
    return replace(
        again,
        seconds=seconds,
        forward_passes=passes,
        first_token_s=answer.first_token_s,
        alternatives=1,
    )


@torch.inference_mode()
def _generate_batch(
    decoder: Decoder, batch: dict[int, Row], began: float
) -> Iterator[tuple[int, Generation]]:
    """Yield (index, answer) as rows end. `began` is when the work on the batch did."""
    share, rows, first = 0.0, dict(batch), 0.0
    passes = decoder.start(len(rows)) if rows else None
    while passes and rows:
        fed = [row.feed(wide=passes.wide) for row in rows.values()]
        wanted = [count for _ids, count in fed]
        logits = passes.run([ids for ids, _count in fed], wanted)
        # Reading the tokens waits for the device, so the time below is that of the whole step.
        best = logits.argmax(-1).tolist()
        starts = [sum(wanted[:place]) for place in range(len(wanted))]
        wrong = [
            row.choose(best[start : start + count], logits[start : start + count])
            for row, start, count in zip(rows.values(), starts, wanted, strict=True)
        ]
        now = time.perf_counter()
        first = first or now - began
        share, began = share + (now - began) / len(rows), now
        kept = [place for place, row in enumerate(rows.values()) if not row.finished]
        for index, row in list(rows.items()):
            if row.finished:
                yield index, _generation(rows.pop(index), share, first)
        began = time.perf_counter()
        if rows:
            passes.forget(wrong)
            if len(kept) < len(wanted):
                passes.select(kept)


def _generation(row: Row, seconds: float, first: float) -> Generation:
    assert row.finished is not None
    constraint = row.constraint
    notes, cut = (tuple(constraint.notes), constraint.cut) if constraint else ((), False)
    return Generation(
        tuple(row.ids),
        row.finished,
        seconds,
        None,
        row.forward_passes,
        row.forced_tokens,
        row.drafted_tokens,
        notes,
        cut,
        first,
    )
