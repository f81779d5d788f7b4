"""Constrained answers and fast-forward, on a small random model and a toy language."""

from __future__ import annotations

import random
from collections.abc import Sequence
from typing import Any

import numpy as np
import pytest
import torch

from planner_ft.decoding.configurations import Limits
from planner_ft.decoding.constraints import RAN_ON, Mask
from planner_ft.decoding.generate import generate
from planner_ft.decoding.passes import Decoder
from planner_ft.decoding.sequence import Method, Query, SequenceState
from planner_ft.support.errors import PlannerError

VOCABULARY, END = 64, 2
LIMITS = Limits((END, 5), 60)


class Toy:
    """Sentences of the toy language: `rounds` times 10, then 11 or 12, then 20 21 22 or 30 31 32
    after it; then the end.
    """

    def __init__(self, rounds: int) -> None:
        self.notes = ["a note"]
        self.cut = False
        self.left = rounds
        self.waiting = [10]

    @property
    def ended(self) -> bool:
        return self.left == 0

    def allowed(self) -> list[int]:
        """The tokens that may follow."""
        return [END] if self.ended else self.waiting[:1] or [11, 12]

    def mask(self) -> Mask:
        bits = np.zeros(VOCABULARY, dtype=np.uint8)
        bits[self.allowed()] = 1
        return np.packbits(bits, bitorder="little").view(np.int32)

    def expected(self) -> list[int]:
        more = [10] if self.left > 1 and self.waiting[:1] not in ([], [10]) else []
        return [] if self.ended else [*self.waiting, *more]

    def release(self, token: int) -> bool:
        return False

    def ends_text(self) -> None:
        return None

    def accept(self, token: int) -> None:
        if token not in self.allowed():
            raise ValueError(f"{token} is not allowed")
        if self.waiting:
            self.waiting.pop(0)
            if not self.waiting and token != 10:
                self.left -= 1
                self.waiting = [10] if self.left else []
        elif not self.ended:
            self.waiting = [20, 21, 22] if token == 11 else [30, 31, 32]

    def allows(self, token: int) -> bool:
        return token in self.allowed()


class ToyFactory:
    """Starts sentences with as many rounds as the record says."""

    least_tokens = 1

    def start(
        self, record: dict[str, Any], limit: int | None = None, most: int | None = None
    ) -> Toy:
        return Toy(record["rounds"])


def toy_queries(count: int) -> list[Query]:
    """Random prompts of different lengths, for sentences of one to four rounds."""
    rng = random.Random(count)
    return [
        Query(
            "mission",
            {"rounds": 1 + index % 4},
            tuple(rng.randrange(3, VOCABULARY) for _ in range(rng.randrange(3, 60))),
        )
        for index in range(count)
    ]


ENFORCED = Method(ToyFactory(), lookup=None)
STEP_BY_STEP = Method(ToyFactory(), fast_forward=False, lookup=None)
QUERIES = toy_queries(8)
ROUNDS = [query.record["rounds"] for query in QUERIES]


def reference(model: Any, query: Query) -> list[int]:
    """The most probable allowed token, one after the other, all computed anew each time."""
    ids, toy = list(query.prompt), Toy(query.record["rounds"])
    while ids[-1] != END:
        with torch.inference_mode():
            logits = model(input_ids=torch.tensor([ids])).logits[0, -1]
        ids.append(max(toy.allowed(), key=lambda token: float(logits[token])))
        toy.accept(ids[-1])
    return ids[len(query.prompt) :]


def test_answers_are_the_most_probable_that_the_constraint_allows(
    decoder: Decoder, toy_model: Any
) -> None:
    expected = [reference(toy_model, query) for query in QUERIES]
    assert len({tuple(answer) for answer in expected}) > 4
    for method in (ENFORCED, STEP_BY_STEP, Method(ToyFactory())):
        for batch_size in (1, 8):
            answers = generate(decoder, QUERIES, LIMITS, method, batch_size=batch_size)
            assert [list(answer.ids) for answer in answers] == expected
            assert {(answer.finish_reason, answer.notes) for answer in answers} == {
                ("stop", ("a note",))
            }


def test_only_choices_take_a_forward_pass(decoder: Decoder) -> None:
    answers = generate(decoder, QUERIES, LIMITS, ENFORCED, batch_size=1)
    # A round is 10, a choice and three tokens after it; the end follows by itself.
    assert [len(answer.ids) for answer in answers] == [5 * rounds + 1 for rounds in ROUNDS]
    # The tokens behind the last choice are verified in a pass of their own.
    assert [answer.forward_passes for answer in answers] == [rounds + 1 for rounds in ROUNDS]
    for answer in generate(decoder, QUERIES, LIMITS, STEP_BY_STEP, batch_size=1):
        assert answer.forward_passes == len(answer.ids)


def test_small_rows_of_a_batch_skip_ahead_on_their_own(decoder: Decoder) -> None:
    passes = [
        answer.forward_passes
        for answer in generate(decoder, QUERIES, LIMITS, ENFORCED, batch_size=8)
    ]
    # In a batch of transformers, rows move on together: a token at a time once the prompts are fed.
    assert passes == (
        [rounds + 1 for rounds in ROUNDS]
        if type(decoder).__name__ == "SmallModel"
        else [5 * rounds for rounds in ROUNDS]
    )


def test_the_limit_cuts_in_the_middle_of_what_is_forced(decoder: Decoder, toy_model: Any) -> None:
    expected = [reference(toy_model, query)[:8] for query in QUERIES]
    answers = generate(decoder, QUERIES, Limits((END,), 8), ENFORCED, batch_size=4)
    assert [list(answer.ids) for answer in answers] == expected
    assert [answer.finish_reason for answer in answers] == [
        "stop" if rounds == 1 else "length" for rounds in ROUNDS
    ]


def test_a_token_is_allowed_whatever_the_logits_are() -> None:
    for logits in (
        torch.full((1, VOCABULARY), torch.nan),
        torch.full((1, VOCABULARY), -torch.inf),
        torch.full((1, VOCABULARY), torch.inf),
    ):
        query = Query("mission", {"rounds": 1}, (3,))
        row = SequenceState(query, Method(ToyFactory(), lookup=None), LIMITS, 9)
        _fed, wanted = row.feed(wide=True)
        rows = logits.expand(wanted, -1)
        row.choose(rows.argmax(-1).tolist(), rows.half())
        assert row.ids[:2] in ([10, 11], [10, 12])


def test_a_constraint_that_needs_more_room_than_there_is_says_so(decoder: Decoder) -> None:
    class Large(ToyFactory):
        def start(
            self, record: dict[str, Any], limit: int | None = None, most: int | None = None
        ) -> Toy:
            if limit is not None and limit < 30:
                raise PlannerError(f"needs room for 30 tokens, not {limit}")
            return super().start(record, limit)

    near = Query("mission", {"rounds": 1}, (7,) * 490)
    answers = generate(decoder, [near, QUERIES[0]], LIMITS, Method(Large()))
    assert [(answer.finish_reason, answer.error) for answer in answers] == [
        ("error", "needs room for 30 tokens, not 22"),
        ("stop", None),
    ]


@pytest.mark.parametrize("ends", [(END, 5), (5, END)])
def test_what_forced_the_end_is_the_token_that_is_trained(
    decoder: Decoder, ends: tuple[int, ...]
) -> None:
    class Two(Toy):
        def allowed(self) -> list[int]:
            return [END, 5] if self.ended else super().allowed()

    class Factory(ToyFactory):
        def start(
            self, record: dict[str, Any], limit: int | None = None, most: int | None = None
        ) -> Toy:
            return Two(record["rounds"])

    (answer,) = generate(decoder, QUERIES[:1], Limits(ends, 60), Method(Factory()))
    assert answer.ids[-1] == ends[0]


class Long:
    """Sentences of 9 rounds; with `most`, of so many."""

    least_tokens = 1

    def start(
        self, record: dict[str, Any], limit: int | None = None, most: int | None = None
    ) -> Toy:
        return Toy(9 if most is None else most)


@pytest.mark.parametrize("free", [0, 1, 3, 4, 9])
@pytest.mark.parametrize("batch_size", [1, 8])
def test_an_answer_that_runs_on_beyond_the_free_one_is_bounded(
    decoder: Decoder, free: int, batch_size: int
) -> None:
    """Rounds are counted as tens; the model without constraint is taken to write `free`."""

    def entries(ids: Sequence[int]) -> int:
        constrained = list(ids[:2]) in ([10, 11], [10, 12])
        return list(ids).count(10) if constrained and len(ids) > 9 else free

    method = Method(Long(), entries=entries)
    for answer in generate(decoder, QUERIES, LIMITS, method, batch_size=batch_size):
        rounds = 9 if free >= 4 else 2 * free + 2
        assert len(answer.ids) == 5 * rounds + 1
        assert (RAN_ON in answer.notes) is (free < 4)
        # With four, the bound may hold for the beginning before they diverged already.
        if free < 4:
            assert answer.alternatives == 2
