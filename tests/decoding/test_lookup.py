"""Prompt look-up: what is proposed, and that no draft changes an answer."""

from __future__ import annotations

import random
from typing import Any

import pytest
import torch

from planner_ft.decoding.configurations import Limits
from planner_ft.decoding.generate import PLAIN, generate
from planner_ft.decoding.lookup import LONGEST_DRAFT, LONGEST_SURE, Lookup
from planner_ft.decoding.passes import Decoder, ModelDecoder
from planner_ft.decoding.sequence import Method, Query, SequenceState


def lookup(prompt: list[int], answer: list[int], **settings: Any) -> Lookup:
    made = Lookup(prompt, **settings)
    for token in answer:
        made.extend(token)
    return made


def test_what_followed_the_last_tokens_is_proposed() -> None:
    assert lookup([1, 2, 3, 4, 5], [2]).propose(2) == [3, 4]
    assert lookup([1, 2, 3], [9, 8, 7, 9]).propose(3) == [8, 7, 9]
    assert lookup([1, 2, 3], [4]).propose(3) == []
    assert lookup([], []).propose(3) == []


def test_the_longest_and_then_the_latest_match_wins() -> None:
    assert lookup([1, 2, 3, 0, 7, 2, 4, 0], [1, 2]).propose(1) == [3]
    assert lookup([1, 2, 3, 0, 7, 2, 4, 0], [2]).propose(1) == [4]


def test_a_text_counts_for_more_than_its_base() -> None:
    base = lookup([], [1, 2, 3, 4, 9])
    for own, found in (([0, 3, 4, 7, 1, 2, 3, 4], 9), ([5, 2, 3, 4, 7, 1, 2, 3, 4], 7)):
        made = Lookup(base=base)
        for token in own:
            made.extend(token)
        assert made.propose(1) == [found]


def test_drafts_of_one_answer_grow_while_they_are_right() -> None:
    """Tokens 1 to 9 over and over, said by the prompt, until token 10 stands in between."""
    said = [*range(1, 10)] * 12
    query, answer = Query("mission", {}, tuple(said)), [*said, 10, *said]
    logits = torch.eye(12)
    for alone in (True, False):
        state, fed, at = SequenceState(query, Method(), Limits((11,), 400), 400), list[int](), 0
        while at < len(answer):
            state.feed(wide=True, alone=alone)
            fed.append(len(state.draft))
            chosen = [*answer, *[0] * LONGEST_SURE][at : at + len(state.draft) + 1]
            at += len(state.choose(chosen, logits[chosen]))
        grown = [LONGEST_DRAFT, 2 * LONGEST_DRAFT, LONGEST_SURE, LONGEST_SURE, LONGEST_SURE]
        assert fed[:5] == (grown if alone else [LONGEST_DRAFT] * 5)
        assert fed.count(LONGEST_DRAFT) >= 2


def test_words_match_in_another_case_and_after_a_space() -> None:
    words = {1: "red", 2: "red", 3: "buoy"}
    assert lookup([2, 3], [1], likeness=words.__getitem__).propose(1) == [3]
    assert lookup([2, 3], [1]).propose(1) == []


QUERIES = [
    Query("mission", {}, tuple(random.Random(seed).choices(range(3, 64), k=5 + 7 * seed)))
    for seed in range(6)
]
LIMITS = Limits((5, 9), 80)


@pytest.fixture
def answered(decoder: Decoder) -> tuple[list[Query], list[tuple[int, ...]]]:
    """Queries whose prompts hold much of their answers, and these."""
    queries = [
        Query("mission", {}, query.prompt * 2 + generate(decoder, [query], LIMITS)[0].ids[:-1])
        for query in QUERIES
    ]
    return queries, [answer.ids for answer in generate(decoder, queries, LIMITS, PLAIN)]


@pytest.mark.parametrize("batch_size", [1, 6])
def test_drafts_save_passes_and_change_nothing(
    decoder: Decoder, answered: tuple[list[Query], list[tuple[int, ...]]], batch_size: int
) -> None:
    queries, plain = answered
    drafted = generate(decoder, queries, LIMITS, Method(), batch_size=batch_size)
    assert [answer.ids for answer in drafted] == plain
    if batch_size == 1 or not isinstance(decoder, ModelDecoder):
        # A pass gives the drafts that were right and a choice after them; the last choice may have
        # been drafted, too.
        for answer in drafted:
            assert answer.forward_passes <= len(answer.ids)
        assert any(answer.forward_passes < len(answer.ids) for answer in drafted)


def test_drafts_do_not_reach_beyond_the_limit(decoder: Decoder) -> None:
    fed: list[int] = []
    start = type(decoder).start

    class Recording:
        context = decoder.context

        def start(self, rows: int) -> Any:
            passes = start(decoder, rows)
            run = passes.run
            passes.run = lambda feeds, wanted: fed.append(len(feeds[0])) or run(feeds, wanted)  # type: ignore[method-assign, func-returns-value]
            return passes

    query = Query("mission", {}, (7,) * 30)
    generate(Recording(), [query], Limits((65,), 3), Method())
    assert fed[0] == len(query.prompt) + 2
    assert max(fed[1:], default=1) <= 1 + LONGEST_DRAFT


@pytest.mark.parametrize("kind", ["sliding window", "absolute positions"])
def test_other_kinds_of_models_give_the_same_answers(kind: str) -> None:
    from transformers import GPT2Config, GPT2LMHeadModel, MistralConfig, MistralForCausalLM

    torch.manual_seed(0)
    if kind == "sliding window":
        sizes = {
            "hidden_size": 32,
            "intermediate_size": 64,
            "num_hidden_layers": 2,
            "num_attention_heads": 4,
            "num_key_value_heads": 2,
        }
        model: Any = MistralForCausalLM(
            MistralConfig(vocab_size=64, sliding_window=16, initializer_range=0.5, **sizes)
        ).eval()
    else:
        model = GPT2LMHeadModel(
            GPT2Config(
                vocab_size=64,
                n_embd=32,
                n_layer=2,
                n_head=4,
                n_positions=512,
                initializer_range=0.5,
            )
        ).eval()
    decoder = ModelDecoder(model)
    plain = generate(decoder, QUERIES, LIMITS, PLAIN, batch_size=1)
    drafted = generate(decoder, QUERIES, LIMITS, Method(), batch_size=1)
    assert [answer.ids for answer in drafted] == [answer.ids for answer in plain]
    # A window that has moved on cannot be taken back, so nothing is drafted.
    saved = any(answer.forward_passes < len(answer.ids) for answer in drafted)
    assert saved is (kind != "sliding window")


@pytest.mark.parametrize(
    ("ids", "loops"),
    [
        ([7] * 16 + [7], True),
        ([7, 8] * 8 + [7], True),
        ([1, 2, 3] * 5 + [1, 2], True),
        ([1, 2, 3, 4, 5] * 3 + [1, 2], True),
        ([9, 9, *[1, 2, 3] * 5, 1, 2], True),
        ([1, 2, 3] * 5 + [1, 9], False),
        ([1, 2, 3, 4, 5, 6] * 3, False),
        ([7] * 9, False),
        (list(range(20)), False),
    ],
)
def test_the_same_tokens_over_and_over_are_noticed(ids: list[int], loops: bool) -> None:
    state = SequenceState(Query("mission", {}, (1,)), Method(), Limits((99,), 400), 400)
    state.ids = ids[:-1]
    assert state._loops(ids[-1]) is loops
