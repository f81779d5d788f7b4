"""Answers end within their limit, whatever a model prefers."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from planner_ft.decoding.configurations import Strength
from planner_ft.decoding.constraints.answer import Answer
from planner_ft.vocabulary import load_vocabulary
from planner_ft.vocabulary.plans import LEVELS, Level, plan_problems

from .conftest import allowed, answer_ids, decoded, make_factory, token_texts

GRID = {
    "task": "BathymetryGridSurvey",
    "parameters": {"center": [10, 20], "width": 120, "length": 200, "spacing": 4},
    "prompt": (
        "Run a depth grid of 120 by 200 metres with lanes 4 m apart round the red buoy and the"
        " green one with the antenna."
    ),
}


def stubborn_answer(constraint: Answer, limit: int, seed: int, texts: list[str]) -> list[int]:
    """An answer of a model that writes the shortest tokens and closes nothing that it need not."""
    rng, ids = np.random.default_rng(seed), []
    while not constraint.ended:
        assert len(ids) < limit - 1, "the answer does not end"
        choice = allowed(constraint.mask())
        least = min(len(texts[token]) for token in choice)
        open_ended = [
            token
            for token in choice
            if len(texts[token]) == least and texts[token][:1] not in '"]}'
        ]
        ids.append(int(rng.choice(open_ended if open_ended and rng.random() < 0.9 else choice)))
        constraint.accept(ids[-1])
    return ids


@pytest.mark.parametrize("strength", ["schema", "state", "grounded"])
@pytest.mark.parametrize("level", LEVELS)
def test_a_model_that_does_not_want_to_end_is_led_to_the_end(
    tokenizer: Any, level: Level, strength: Strength
) -> None:
    vocabulary = load_vocabulary()
    factory = make_factory(tokenizer, level, vocabulary, strength)
    texts, cut = token_texts(tokenizer), 0
    for seed in range(5):
        limit = factory.least_tokens + 37 * seed
        constraint = factory.start(GRID, limit)
        ids = stubborn_answer(constraint, limit, seed, texts)
        assert plan_problems(level, decoded(tokenizer, ids), vocabulary, strict=True) == []
        cut += constraint.cut
    assert cut


def test_a_path_that_was_begun_is_left_when_the_limit_comes_near(embedded: Any) -> None:
    factory = make_factory(embedded, "task", load_vocabulary(), "grounded")
    limit, texts = factory.least_tokens + 250, token_texts(embedded)
    waypoint = '{"navigation_skill":{"name":"GoToXY","parameters":{"x":-50,"y":%d}},"filter_skills":[],"perception_skills":[]'
    tail = ',"stop_conditions":[],"failure_modes":[],"expected_outputs":[]}'
    constraint = factory.start(GRID, limit)
    ids = answer_ids(
        embedded, '{"skill_sequence":[' + ",".join(waypoint % y + tail for y in (-80, 120)) + ","
    )
    for token in ids:
        constraint.accept(token)
    while not constraint.ended:
        assert len(ids) < limit - 1, "the answer does not end"
        choice = allowed(constraint.mask())
        ids.append(next((token for token in choice if texts[token].startswith("GoTo")), choice[-1]))
        constraint.accept(ids[-1])
    assert constraint.cut
    assert 3 <= len(decoded(embedded, ids)["skill_sequence"]) < 62
