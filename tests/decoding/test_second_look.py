"""Answers that lack something are weighed against those that their least certain choices could have
led to.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
import torch

from planner_ft.candidates import resolve_candidate
from planner_ft.decoding.configurations import STRENGTHS, Configuration
from planner_ft.decoding.engine import Engine
from planner_ft.decoding.generate import Method, generate
from planner_ft.decoding.passes import Decoder
from planner_ft.decoding.sampling import Sampling
from planner_ft.decoding.second_look import SecondLook
from planner_ft.vocabulary import load_vocabulary
from tests.decoding.test_fast_forward import LIMITS, QUERIES, Toy, ToyFactory


def elevens(record: dict[str, Any], ids: Sequence[int]) -> int:
    """What answers lack in these tests: the other word, wherever 11 stands."""
    return list(ids).count(11)


def gone_on(
    model: Any, prompt: Sequence[int], begun: Sequence[int], rounds: int
) -> tuple[list[int], list[tuple[int, float, int, float, float]]]:
    """The answer behind some first tokens, all computed anew each time, and its choices: place, log
    probability, the other, its own, how far strayed.
    """
    ids, toy, choices = list(begun), Toy(rounds), []
    for token in begun:
        toy.accept(token)
    while not ids or ids[-1] != 2:
        with torch.inference_mode():
            logits = model(input_ids=torch.tensor([[*prompt, *ids]])).logits[0, -1]
        allowed = toy.allowed()
        ranked = sorted(allowed, key=lambda token: -float(logits[token]))
        if len(allowed) > 1:
            logprobs = torch.log_softmax(logits.float(), 0)
            first, second = (float(logprobs[token]) for token in ranked[:2])
            choices.append(
                (len(ids), first, ranked[1], second, -float(logprobs[allowed].logsumexp(0)))
            )
        ids.append(ranked[0])
        toy.accept(ids[-1])
    return ids, choices


def expected(model: Any, query: Any, look: SecondLook) -> list[int]:
    """The answer that is to be given, found by going through all alternatives."""
    rounds = query.record["rounds"]
    answer, choices = gone_on(model, query.prompt, [], rounds)
    whole = sum(item[1] for item in choices)
    rated = [(look.lacks({}, answer) or 0, -whole, answer, choices, 0.0)]
    chosen = 0
    for _round in range(look.rounds):
        lacking, _logprob, answer, choices, began = rated[chosen]
        if not lacking and sum(item[4] for item in choices) <= look.strayed:
            break
        for index in sorted(
            range(len(choices)), key=lambda index: choices[index][1] - choices[index][3]
        )[: look.alternatives]:
            place, logprob, other, its, _strayed = choices[index]
            if logprob - its > look.margin:
                continue
            ids, behind = gone_on(model, query.prompt, [*answer[:place], other], rounds)
            start = began + sum(item[1] for item in choices[:index]) + its
            rated.append(
                (
                    look.lacks({}, ids) or 0,
                    -start - sum(item[1] for item in behind),
                    ids,
                    behind,
                    start,
                )
            )
        fitting = [index for index, item in enumerate(rated) if -item[1] >= whole - look.margin]
        before, chosen = chosen, min(fitting, key=lambda index: (*rated[index][:2], index))
        if chosen == before:
            break
    return rated[chosen][2]


LOOKS = [
    SecondLook(elevens, strayed=math.inf),
    SecondLook(elevens, 2, 1.0, 1, math.inf),
    SecondLook(elevens, 60, math.inf, 1, math.inf),
    SecondLook(elevens, 1, 9.0, 4, 4.0),
    SecondLook(lambda record, ids: 0, strayed=6.0),
]


@pytest.mark.parametrize("look", LOOKS)
@pytest.mark.parametrize("batch_size", [1, 8])
def test_the_answer_that_lacks_least_is_given(
    decoder: Decoder, toy_model: Any, batch_size: int, look: SecondLook
) -> None:
    plain = [
        list(answer.ids) for answer in generate(decoder, QUERIES, LIMITS, Method(ToyFactory()))
    ]
    wanted = [expected(toy_model, query, look) for query in QUERIES]
    assert sum(one != other for one, other in zip(plain, wanted, strict=True)) >= 1
    for method in (
        Method(ToyFactory(), second_look=look),
        Method(ToyFactory(), fast_forward=False, drafting=False, second_look=look),
    ):
        assert [
            list(answer.ids)
            for answer in generate(decoder, QUERIES, LIMITS, method, batch_size=batch_size)
        ] == wanted


def test_what_it_costs_is_counted(decoder: Decoder) -> None:
    plain = generate(decoder, QUERIES, LIMITS, Method(ToyFactory()), batch_size=1)
    looked = generate(
        decoder,
        QUERIES,
        LIMITS,
        Method(ToyFactory(), second_look=SecondLook(elevens, strayed=math.inf)),
        batch_size=1,
    )
    for before, after in zip(plain, looked, strict=True):
        doubted = 11 in before.ids
        assert (after.alternatives > 0) == doubted
        assert (
            after.forward_passes >= before.forward_passes
            if doubted
            else after.forward_passes == before.forward_passes
        )
        assert after.finish_reason == "stop" and after.notes == before.notes
    assert {answer.alternatives > 0 for answer in looked} == {True, False}
    assert sum(answer.forward_passes for answer in looked) > sum(
        answer.forward_passes for answer in plain
    )


@pytest.mark.parametrize(
    "look",
    [
        SecondLook(lambda record, ids: None),
        SecondLook(lambda record, ids: 0, strayed=math.inf),
        SecondLook(elevens, 5, 0.0),
        SecondLook(elevens, 0),
    ],
)
def test_nothing_changes_without_doubt_or_room(decoder: Decoder, look: SecondLook) -> None:
    plain = generate(decoder, QUERIES, LIMITS, Method(ToyFactory()))
    assert [
        answer.ids
        for answer in generate(decoder, QUERIES, LIMITS, Method(ToyFactory(), second_look=look))
    ] == [answer.ids for answer in plain]


def test_sampled_answers_stay_as_they_were_drawn(decoder: Decoder) -> None:
    sampled = Method(ToyFactory(), sampling=Sampling(1.0))
    plain, looked = (
        generate(decoder, QUERIES, LIMITS, method)
        for method in (sampled, replace(sampled, second_look=SecondLook(elevens)))
    )
    assert [answer.ids for answer in looked] == [answer.ids for answer in plain]


def test_logits_that_are_no_numbers_end_in_an_answer(toy_model: Any, decoder: Decoder) -> None:
    class Broken:
        """Passes whose logits are all NaN."""

        context = decoder.context

        def start(self, rows: int) -> Any:
            passes = decoder.start(rows)
            run = passes.run
            passes.run = lambda feeds, wanted: run(feeds, wanted) * math.nan  # type: ignore[method-assign]
            return passes

    for answer in generate(
        Broken(), QUERIES, LIMITS, Method(ToyFactory(), second_look=SecondLook(elevens))
    ):
        assert answer.finish_reason == "stop"


def test_the_engine_looks_again_at_mission_plans_at_strength_grounded_alone(models: Path) -> None:
    engine = Engine.load(resolve_candidate("Qwen2.5-3B"), load_vocabulary(), device="cpu")
    looks = {
        (level, strength)
        for level in ("mission", "task")
        for strength in STRENGTHS
        if engine.method(level, Configuration(False, strength)).second_look
    }
    assert looks == {("mission", "grounded")}
    engine.second_look = False
    assert engine.method("mission", Configuration(False, "grounded")).second_look is None
