"""What the prompts of a batch begin with is computed once, and the answers stay what they are."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from planner_ft.decoding.configurations import Limits
from planner_ft.decoding.generate import Generation, generate
from planner_ft.decoding.passes import SHARED, ModelDecoder
from planner_ft.decoding.sequence import Query

LIMITS = Limits((2,), 30)


class Counted:
    """A model that counts the positions it is asked for."""

    def __init__(self, model: Any) -> None:
        self.positions = 0
        self.decoder = ModelDecoder(model)
        model.register_forward_pre_hook(self._count, with_kwargs=True)

    def _count(self, _model: Any, _arguments: Any, named: dict[str, Any]) -> None:
        self.positions += named["input_ids"].numel()


def answers(decoder: ModelDecoder, prompts: list[list[int]], batch_size: int) -> list[Generation]:
    return generate(
        decoder,
        [Query("mission", {}, tuple(prompt)) for prompt in prompts],
        LIMITS,
        batch_size=batch_size,
    )


def beginning(length: int) -> list[int]:
    return [3 + (7 * place) % 60 for place in range(length)]


@pytest.mark.parametrize(
    "rests",
    [[[5], [6, 7, 8], [9, 10], [5, 5, 5, 5, 5, 5, 5]], [[5, 6], [5, 6], [5, 6]], [[], [7], [8, 9]]],
    ids=["different lengths", "equal prompts", "one prompt is the beginning"],
)
def test_answers_are_those_of_prompts_alone(
    make_llama: Callable[..., Any], rests: list[list[int]]
) -> None:
    decoder = ModelDecoder(make_llama())
    prompts = [beginning(150) + rest for rest in rests]
    alone, together = answers(decoder, prompts, 1), answers(decoder, prompts, len(prompts))
    assert [answer.ids for answer in together] == [answer.ids for answer in alone]
    assert (
        len({answer.ids for answer in alone}) > 1 or len({tuple(prompt) for prompt in prompts}) == 1
    )


def test_a_common_beginning_is_computed_once(make_llama: Callable[..., Any]) -> None:
    counted = Counted(make_llama())
    found = answers(counted.decoder, [[*beginning(200), 5 + row] for row in range(8)], 8)
    generated = sum(len(answer.ids) for answer in found)
    assert counted.positions < 200 + 8 + generated + 8 * len(
        max(found, key=lambda answer: len(answer.ids)).ids
    )


def test_a_short_common_beginning_gets_no_pass_of_its_own(make_llama: Callable[..., Any]) -> None:
    counted = Counted(make_llama())
    passes: list[None] = []
    counted.decoder.model.register_forward_hook(lambda *_: passes.append(None))
    found = answers(counted.decoder, [[*beginning(SHARED - 1), 40 + row] for row in range(3)], 3)
    assert len(passes) == max(answer.forward_passes for answer in found)


def test_layers_with_a_window_share_nothing(make_llama: Callable[..., Any]) -> None:
    from transformers import MistralConfig, MistralForCausalLM

    sizes = {
        "vocab_size": 64,
        "hidden_size": 32,
        "intermediate_size": 64,
        "num_hidden_layers": 2,
        "num_attention_heads": 4,
        "num_key_value_heads": 2,
    }
    model = MistralForCausalLM(
        MistralConfig(
            **sizes,
            sliding_window=8,
            pad_token_id=0,
            eos_token_id=2,
            bos_token_id=1,
            initializer_range=0.5,
        )
    ).eval()
    prompts = [[*beginning(40), 5 + row] for row in range(3)]
    decoder = ModelDecoder(model)
    assert [answer.ids for answer in answers(decoder, prompts, 3)] == [
        answer.ids for answer in answers(decoder, prompts, 1)
    ]
