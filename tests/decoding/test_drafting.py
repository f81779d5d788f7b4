"""Drafts: what is proposed, and that no draft changes an answer."""

from __future__ import annotations

import random
from typing import Any

import pytest

from planner_ft.decoding.drafting import LONGEST_DRAFT, START, Drafter, PhraseBook
from planner_ft.decoding.generate import PLAIN, Method, Query, generate
from planner_ft.decoding.limits import Limits
from planner_ft.decoding.passes import Decoder, ModelDecoder


def drafter(prompt: list[int], answer: list[int], **settings: Any) -> Drafter:
    made = Drafter(prompt, **settings)
    for token in answer:
        made.extend(token)
    return made


def test_what_followed_the_last_tokens_is_proposed() -> None:
    assert drafter([1, 2, 3, 4, 5], [2]).propose(2) == [3, 4]
    assert drafter([1, 2, 3], [9, 8, 7, 9]).propose(3) == [8, 7, 9]
    assert drafter([1, 2, 3], [4]).propose(3) == []
    assert drafter([], []).propose(3) == []


def test_the_longest_and_then_the_latest_match_wins() -> None:
    assert drafter([1, 2, 3, 0, 7, 2, 4, 0], [1, 2]).propose(1) == [3]
    assert drafter([1, 2, 3, 0, 7, 2, 4, 0], [2]).propose(1) == [4]


def test_words_match_in_another_case_and_after_a_space() -> None:
    words = {1: "red", 2: "red", 3: "buoy"}
    assert drafter([2, 3], [1], likeness=words.__getitem__).propose(1) == [3]
    assert drafter([2, 3], [1]).propose(1) == []


def test_the_phrase_book_helps_where_the_text_has_nothing() -> None:
    book = PhraseBook([[1, 2, 3], [1, 2, 4], [1, 2, 3]])
    assert drafter([9, 8], [], book=book).propose(5) == [1, 2, 3]
    assert drafter([9, 8], [1], book=book).propose(1) == [2]
    assert drafter([1, 7], [5, 1], book=book).propose(1) == [7], (
        "an equally long match in the text comes first"
    )
    assert drafter([2, 7], [1, 2], book=book).propose(1) == [3], (
        "a longer match in the book comes before a shorter one in the text"
    )
    assert START not in drafter([], [1, 2, 3], book=book).propose(9)


QUERIES = [
    Query("mission", {}, tuple(random.Random(seed).choices(range(3, 64), k=5 + 7 * seed)))
    for seed in range(6)
]
LIMITS = Limits((5, 9), 0, 80)


def test_drafts_save_passes_and_change_nothing(decoder: Decoder) -> None:
    plain = generate(decoder, QUERIES, LIMITS, PLAIN, batch_size=1)
    book = PhraseBook([answer.ids for answer in plain])
    for batch_size in (1, 6):
        drafted = generate(decoder, QUERIES, LIMITS, Method(book=book), batch_size=batch_size)
        assert [answer.ids for answer in drafted] == [answer.ids for answer in plain]
        assert [answer.finish_reason for answer in drafted] == [
            answer.finish_reason for answer in plain
        ]
        if batch_size == 1 or not isinstance(decoder, ModelDecoder):
            # A pass gives the drafts that were right and a choice after them; the last choice may
            # have been drafted, too.
            assert all(
                answer.forward_passes + answer.drafted_tokens - len(answer.ids) in (0, 1)
                for answer in drafted
            )
            assert sum(answer.forward_passes for answer in drafted) < 0.4 * sum(
                len(answer.ids) for answer in drafted
            )


def test_wrong_drafts_change_nothing(decoder: Decoder) -> None:
    plain = generate(decoder, QUERIES, LIMITS, PLAIN, batch_size=1)
    wrong = PhraseBook(
        [[(token + 1) % 64 for token in answer.ids] for answer in plain] + [list(range(64)) * 3]
    )
    for batch_size in (1, 6):
        assert [
            answer.ids
            for answer in generate(
                decoder, QUERIES, LIMITS, Method(book=wrong), batch_size=batch_size
            )
        ] == [answer.ids for answer in plain]


def test_drafts_do_not_reach_beyond_the_limit(decoder: Decoder) -> None:
    book = PhraseBook([[7] * 30])
    fed: list[int] = []
    start = type(decoder).start

    class Recording:
        context = decoder.context

        def start(self, rows: int) -> Any:
            passes = start(decoder, rows)
            run = passes.run
            passes.run = lambda feeds, wanted: fed.append(len(feeds[0])) or run(feeds, wanted)  # type: ignore[method-assign, func-returns-value]
            return passes

    generate(Recording(), QUERIES[:1], Limits((65,), 0, 3), Method(book=book))
    assert fed[0] <= len(QUERIES[0].prompt) + 2
    assert max(fed[1:], default=1) <= 1 + LONGEST_DRAFT


@pytest.mark.parametrize("kind", ["sliding window", "absolute positions"])
def test_other_kinds_of_models_give_the_same_answers(kind: str) -> None:
    import torch
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
    decoder = ModelDecoder(model, 0)
    plain = generate(decoder, QUERIES, LIMITS, PLAIN, batch_size=1)
    drafted = generate(
        decoder,
        QUERIES,
        LIMITS,
        Method(book=PhraseBook([answer.ids for answer in plain])),
        batch_size=1,
    )
    assert [answer.ids for answer in drafted] == [answer.ids for answer in plain]
    # A window that has moved on cannot be taken back, so nothing is drafted.
    assert (sum(answer.drafted_tokens for answer in drafted) == 0) is (kind == "sliding window")
