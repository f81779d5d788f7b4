"""Log-probabilities of the tokens of an answer: the model's own, at no pass more."""

from __future__ import annotations

import itertools
from typing import Any

import pytest
import torch

from planner_ft.decoding import generate as generate_module
from planner_ft.decoding.configurations import Limits
from planner_ft.decoding.generate import Generation, generate
from planner_ft.decoding.lookup import Lookup
from planner_ft.decoding.passes import Decoder
from planner_ft.decoding.sequence import LIKELIEST, Method, Query, scores

END = 2
LIMITS = Limits((END,), 24)
QUERIES = [Query("mission", {}, tuple(range(3, 3 + length))) for length in (4, 9, 23)]


def reference(model: Any, query: Query, answer: Generation) -> torch.Tensor:
    """Log-probabilities of the answer's tokens, all computed in one pass."""
    ids = torch.tensor([[*query.prompt, *answer.ids]])
    with torch.inference_mode():
        logits = model(input_ids=ids).logits[0]
    places = torch.arange(len(query.prompt) - 1, ids.shape[1] - 1)
    return torch.log_softmax(logits[places], -1)


@pytest.mark.parametrize("drafting", [False, True])
def test_scores_are_the_log_probabilities_of_the_model(
    decoder: Decoder, toy_model: Any, drafting: bool
) -> None:
    method = Method(lookup=Lookup(range(3, 40)) if drafting else None)
    for query, answer in zip(
        QUERIES, generate(decoder, QUERIES, LIMITS, method, batch_size=2), strict=True
    ):
        expected = reference(toy_model, query, answer)
        assert len(answer.scores) == len(answer.ids) > 0
        for row, token, found in zip(expected, answer.ids, answer.scores, strict=True):
            assert found is not None
            assert found.logprob == pytest.approx(float(row[token]), abs=1e-3)
            assert len(found.others) == LIKELIEST - 1
            for other, logprob in found.others:
                assert other != token
                assert logprob == pytest.approx(float(row[other]), abs=1e-3)
                assert logprob <= found.logprob


def test_a_score_needs_no_pass(decoder: Decoder, monkeypatch: pytest.MonkeyPatch) -> None:
    def passes() -> list[int]:
        answers = generate(decoder, QUERIES, LIMITS, Method())
        return [answer.forward_passes for answer in answers]

    with_scores = passes()
    monkeypatch.setattr(generate_module, "scores", lambda ids, logits: itertools.repeat(None))
    assert passes() == with_scores
    assert generate(decoder, QUERIES, LIMITS)[0].scores[0] is None


def test_what_is_forced_is_not_certain() -> None:
    logits = torch.tensor([0.0, 4.0, 1.0, -torch.inf, 2.0, -3.0])
    whole = torch.log_softmax(logits, -1)
    found, forced = scores([5, 3], logits.expand(2, -1))
    assert found.logprob == pytest.approx(float(whole[5]), abs=1e-5)
    assert [token for token, _logprob in found.others] == [1, 4, 2]
    assert forced.logprob == -float("inf")
