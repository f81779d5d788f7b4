"""Greedy generation on a small random model in float32."""

from __future__ import annotations

import random
from collections.abc import Iterator, Sequence
from typing import Any

import pytest
import torch

from planner_ft.decoding.configurations import Limits
from planner_ft.decoding.generate import Generation
from planner_ft.decoding.generate import generate as generate_answers
from planner_ft.decoding.generate import generate_unordered as generate_answers_unordered
from planner_ft.decoding.passes import ModelDecoder
from planner_ft.decoding.sequence import Query
from planner_ft.prompts import ends_of_answers
from planner_ft.support.errors import PlannerError

VOCABULARY = 64


@pytest.fixture(scope="module")
def model() -> Any:
    """Wide initial weights, so that the most probable token changes from step to step."""
    from transformers import LlamaConfig, LlamaForCausalLM

    torch.manual_seed(0)
    config = LlamaConfig(
        vocab_size=VOCABULARY,
        hidden_size=32,
        intermediate_size=64,
        num_hidden_layers=2,
        num_attention_heads=4,
        num_key_value_heads=2,
        max_position_embeddings=512,
        initializer_range=0.5,
        bos_token_id=1,
        eos_token_id=2,
        pad_token_id=0,
    )
    return LlamaForCausalLM(config).eval()


def prompts(count: int, longest: int = 60) -> list[list[int]]:
    rng = random.Random(count)
    return [
        [rng.randrange(3, VOCABULARY) for _ in range(rng.randrange(3, longest))]
        for _ in range(count)
    ]


def limits(*ends: int, most: int = 40) -> Limits:
    return Limits(ends or (2,), most)


def asked(queries: Sequence[list[int]]) -> list[Query]:
    return [Query("mission", {}, tuple(query)) for query in queries]


def generate(
    model: Any, queries: Sequence[list[int]], limits: Limits, **settings: Any
) -> list[Generation]:
    return generate_answers(ModelDecoder(model), asked(queries), limits, **settings)


def generate_unordered(
    model: Any, queries: Sequence[list[int]], limits: Limits, **settings: Any
) -> Iterator[tuple[int, Generation]]:
    return generate_answers_unordered(ModelDecoder(model), asked(queries), limits, **settings)


def reference(model: Any, prompt: list[int], limits: Limits) -> list[int]:
    """What plain transformers generates."""
    ids = torch.tensor([prompt])
    settings = {
        "do_sample": False,
        "max_new_tokens": limits.max_new_tokens,
        "eos_token_id": list(limits.end_ids),
        "pad_token_id": 0,
    }
    return model.generate(ids, attention_mask=torch.ones_like(ids), **settings)[
        0, len(prompt) :
    ].tolist()  # type: ignore[no-any-return]


def test_batched_answers_are_those_of_single_queries_and_of_transformers(model: Any) -> None:
    queries, ends = prompts(9), limits(5, 9)
    answers = generate(model, queries, ends, batch_size=4)
    assert len({answer.ids for answer in answers}) > 5
    assert {answer.finish_reason for answer in answers} == {"stop", "length"}
    for query, answer in zip(queries, answers, strict=True):
        assert list(answer.ids) == reference(model, query, ends)
        assert generate(model, [query], ends)[0].ids == answer.ids


def test_models_with_absolute_positions_are_batched_rightly() -> None:
    from transformers import GPT2Config, GPT2LMHeadModel

    torch.manual_seed(0)
    config = GPT2Config(
        vocab_size=VOCABULARY,
        n_embd=32,
        n_layer=2,
        n_head=4,
        n_positions=512,
        initializer_range=0.5,
        bos_token_id=1,
        eos_token_id=2,
    )
    gpt = GPT2LMHeadModel(config).eval()
    queries = prompts(5)
    for query, answer in zip(queries, generate(gpt, queries, limits(5)), strict=True):
        assert list(answer.ids) == reference(gpt, query, limits(5))


def test_settings_for_sampling_are_ignored(model: Any) -> None:
    queries = prompts(3)
    greedy = generate(model, queries, limits())
    saved = model.generation_config.to_dict()
    try:
        model.generation_config.update(do_sample=True, temperature=3.0, repetition_penalty=5.0)
        assert [answer.ids for answer in generate(model, queries, limits())] == [
            answer.ids for answer in greedy
        ]
    finally:
        model.generation_config.update(**saved)


def test_rows_that_have_ended_are_not_computed_on(
    model: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    rows: list[int] = []
    forward = model.forward

    def counting(*args: Any, **kwargs: Any) -> Any:
        rows.append(len(kwargs["input_ids"]))
        return forward(*args, **kwargs)

    counting.__signature__ = __import__("inspect").signature(forward)  # type: ignore[attr-defined]
    monkeypatch.setattr(model, "forward", counting)
    answers = generate(model, prompts(8), limits(5, 9), batch_size=8)
    assert sum(rows) == sum(len(answer.ids) for answer in answers)
    assert len(rows) == max(len(answer.ids) for answer in answers)


def test_answers_come_as_they_are_completed_longest_prompts_first(model: Any) -> None:
    queries = prompts(6)
    order = [index for index, _answer in generate_unordered(model, queries, limits(), batch_size=2)]
    by_length = sorted(range(6), key=lambda index: -len(queries[index]))
    assert [set(order[start : start + 2]) for start in (0, 2, 4)] == [
        set(by_length[start : start + 2]) for start in (0, 2, 4)
    ]
    lengths = {
        index: len(answer.ids)
        for index, answer in generate_unordered(model, queries, limits(5, 9), batch_size=6)
    }
    assert list(lengths.values()) == sorted(lengths.values())


def test_shares_of_time_add_up_to_the_time_of_the_batch(model: Any) -> None:
    answers = generate(model, prompts(4), limits(5, 9), batch_size=4)
    assert all(answer.seconds > 0 for answer in answers)
    longest, shortest = (
        max(answers, key=lambda answer: len(answer.ids)),
        min(answers, key=lambda answer: len(answer.ids)),
    )
    assert longest.seconds > shortest.seconds


def test_the_token_limit_and_the_context_cut_answers(model: Any) -> None:
    assert [
        len(answer.ids) for answer in generate(model, prompts(3), limits(VOCABULARY + 1, most=7))
    ] == [7, 7, 7]
    near = generate(model, [[5] * 508], limits(VOCABULARY + 1))[0]
    assert (near.finish_reason, len(near.ids)) == ("length", 4)
    over = generate(model, [[5] * 512, [5, 6]], limits(VOCABULARY + 1))
    assert over[0].finish_reason == "error"
    assert "512" in str(over[0].error)
    assert over[1].finish_reason == "length"


def test_too_little_memory_names_the_flag(model: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(*_args: Any, **_kwargs: Any) -> Any:
        raise torch.OutOfMemoryError

    monkeypatch.setattr(model, "forward", full)
    with pytest.raises(PlannerError, match="--batch-size 4"):
        generate(model, prompts(4), limits(), batch_size=4)


def test_every_end_token_of_the_published_candidates_ends_an_answer(models: Any) -> None:
    from planner_ft.candidates import resolve_candidate
    from planner_ft.candidates.loading import load_model, load_tokenizer

    wanted = {
        "Llama-3.2-1B": {"<|end_of_text|>"},
        "Llama-3.2-1B-Instruct": {"<|eot_id|>", "<|eom_id|>", "<|end_of_text|>"},
        "Qwen2.5-3B": {"<|im_end|>", "<|endoftext|>"},
        "Qwen2.5-3B-Instruct": {"<|im_end|>", "<|endoftext|>"},
    }
    for name, tokens in wanted.items():
        candidate = resolve_candidate(name)
        tokenizer = load_tokenizer(candidate)
        assert {
            tokenizer.decode([token])
            for token in ends_of_answers(
                tokenizer, load_model(candidate, device="cpu").generation_config.eos_token_id
            )
        } == tokens


def test_small_models_decode_with_one_cpu_thread(models: Any) -> None:
    from planner_ft.candidates import Candidate, resolve_candidate
    from planner_ft.decoding.engine import decoding_threads, limited_threads

    small = resolve_candidate("Qwen2.5-3B")
    assert decoding_threads(small, "cpu") == 1
    assert decoding_threads(small, "cuda") is None
    assert decoding_threads(Candidate("of unknown size"), "cpu") is None
    before = torch.get_num_threads()
    with limited_threads(before + 1):
        assert torch.get_num_threads() == before + 1
    assert torch.get_num_threads() == before
