"""Sampled answers: drawn from the right probabilities, and the same ones however they are
computed.
"""

from __future__ import annotations

import random
from collections import Counter
from typing import Any

import numpy as np
import pytest
import torch

from planner_ft.decoding.configurations import Limits
from planner_ft.decoding.constraints import Mask
from planner_ft.decoding.generate import generate
from planner_ft.decoding.lookup import Lookup
from planner_ft.decoding.passes import Decoder
from planner_ft.decoding.sequence import Method, Query, Sampling, SequenceState
from planner_ft.support.errors import PlannerError

VOCABULARY = 64
LIMITS = Limits((2, 5, 9), 40)
RNG = random.Random(0)
QUERIES = [
    Query(
        "mission", {"id": f"m{index}"}, tuple(RNG.randrange(3, VOCABULARY) for _ in range(length))
    )
    for index, length in enumerate((3, 40, 12, 7, 25, 18))
]


def drawn(
    logits: list[float], count: int = 5_000, allowed: Mask | None = None, **settings: float
) -> Counter[int]:
    numbers = np.random.default_rng(0).random(count)
    sampling = Sampling(settings.get("temperature", 1.0), settings.get("top_p", 1.0))
    return Counter(sampling.draw(number, torch.tensor(logits), allowed) for number in numbers)


def mask(*tokens: int) -> Mask:
    bits = np.zeros(32, dtype=np.uint8)
    bits[list(tokens)] = 1
    return np.packbits(bits, bitorder="little").view(np.int32)


def answers(
    decoder: Decoder, sampling: Sampling | None, queries: list[Query] = QUERIES, **settings: Any
) -> list[tuple[int, ...]]:
    lookup = Lookup() if settings.pop("drafting", False) else None
    method = Method(fast_forward=False, lookup=lookup, sampling=sampling)
    return [answer.ids for answer in generate(decoder, queries, LIMITS, method, **settings)]


def test_tokens_are_drawn_with_their_probabilities() -> None:
    counts = drawn(np.log([0.5, 0.3, 0.2]).tolist())
    assert [counts[token] / 5_000 for token in range(3)] == pytest.approx([0.5, 0.3, 0.2], abs=0.02)
    # At temperature 0.5 probabilities are squared: 25 to 9 to 4.
    colder = drawn(np.log([0.5, 0.3, 0.2]).tolist(), temperature=0.5)
    assert [colder[token] / 5_000 for token in range(3)] == pytest.approx(
        [25 / 38, 9 / 38, 4 / 38], abs=0.02
    )


def test_top_p_keeps_the_smallest_set_that_holds_it() -> None:
    logits = np.log([0.2, 0.5, 0.3]).tolist()
    assert set(drawn(logits, top_p=0.4)) == {1}
    assert set(drawn(logits, top_p=0.79)) == {1, 2}
    kept = drawn(logits, top_p=0.79)
    assert kept[1] / 5_000 == pytest.approx(5 / 8, abs=0.03)
    assert set(drawn(logits, top_p=1.0)) == {0, 1, 2}


def test_only_what_a_constraint_allows_is_drawn_whatever_the_logits_are() -> None:
    assert set(drawn([9.0, 1.0, 1.0, 8.0], 500, mask(1, 2))) == {1, 2}
    for value in (torch.nan, -torch.inf, torch.inf):
        assert set(drawn([value] * 4, 500, mask(1, 2))) == {1, 2}
    with pytest.raises(RuntimeError, match="no token"):
        drawn([1.0] * 4, 1, mask())


def test_an_answer_depends_on_seed_repeat_and_sample_alone(decoder: Decoder) -> None:
    sampling = Sampling(1.0, 0.9, seed=3, repeat=2)
    expected = answers(decoder, sampling, batch_size=1)
    assert len(set(expected)) == len(QUERIES) and expected != answers(decoder, None)
    assert answers(decoder, sampling, batch_size=4) == expected
    assert answers(decoder, sampling, batch_size=1, drafting=True) == expected
    assert answers(decoder, sampling, list(reversed(QUERIES)), batch_size=3) == expected[::-1]
    assert answers(decoder, Sampling(1.0, 0.9, seed=3, repeat=1)) != expected
    assert answers(decoder, Sampling(1.0, 0.9, seed=4, repeat=2)) != expected


def test_forced_tokens_do_not_shift_the_random_numbers() -> None:
    class Forcing:
        """Allows 3 or 4 after each forced 7."""

        notes: tuple[str, ...] = ()
        cut = ended = False

        def __init__(self) -> None:
            self.count = 0

        def mask(self) -> Mask:
            return mask(7) if self.count % 2 == 0 else mask(3, 4)

        def expected(self) -> list[int]:
            return [7] if self.count % 2 == 0 else []

        def allows(self, token: int) -> bool:
            return True

        def accept(self, token: int) -> None:
            self.count += 1

    class Factory:
        def start(self, record: dict[str, Any], limit: int, most: int | None) -> Forcing:
            return Forcing()

    def sampled(*, fast_forward: bool) -> list[int]:
        method = Method(Factory(), fast_forward, lookup=None, sampling=Sampling(1.0))  # type: ignore[arg-type]
        row = SequenceState(Query("mission", {"id": "a"}, (1,)), method, LIMITS, 12)
        while not row.finished:
            _fed, wanted = row.feed(wide=True)
            row.choose([0] * wanted, torch.zeros(wanted, 32))
        return row.ids

    assert sampled(fast_forward=True) == sampled(fast_forward=False)
    assert set(sampled(fast_forward=True)[1::2]) == {3, 4}


def test_a_very_low_temperature_is_greedy(decoder: Decoder) -> None:
    assert answers(decoder, Sampling(1e-4)) == answers(decoder, None)


@pytest.mark.parametrize(
    ("settings", "flag"),
    [
        ((0.0,), "--temperature 0"),
        ((11.0,), "--temperature 11"),
        ((1.0, 0.0), "--top-p 0"),
        ((1.0, 1.5), "--top-p 1.5"),
    ],
)
def test_settings_out_of_range_are_one_sentence(settings: tuple[float, ...], flag: str) -> None:
    with pytest.raises(PlannerError, match=flag):
        Sampling(*settings)
