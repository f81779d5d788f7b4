"""Strength schema: whatever a model writes is strictly valid and ends, and every right plan can be
written.
"""

from __future__ import annotations

import itertools
import json
from pathlib import Path
from typing import Any

import pytest

from planner_ft.data.missions import sample_missions
from planner_ft.data.task.sampler import sample_tasks
from planner_ft.decoding.constraints.answer import constraint_factory
from planner_ft.prompts import answer_text
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_jsonl
from planner_ft.vocabulary import load_vocabulary
from planner_ft.vocabulary.plans import LEVELS, Level, canonical_plan, plan_problems

from .conftest import LIMITS, allowed, answer_ids, decoded, make_factory, random_answer, taken

RECORD = {"prompt": "inspect the red buoy", "task": "Diagnostics", "parameters": {}}
CURATED = Path(__file__).parents[3] / "data" / "mission"


def plans(level: Level, count: int) -> list[dict[str, Any]]:
    if level == "task":
        return list(sample_tasks(load_vocabulary(), 5, count, "train"))
    return [*read_jsonl(CURATED / "validation.jsonl"), *itertools.islice(sample_missions(5), count)]


@pytest.mark.parametrize("vocabulary", ["usv", "inspection_drone"])
@pytest.mark.parametrize("level", LEVELS)
def test_a_random_model_gives_valid_plans_that_end(
    tokenizer: Any, level: Level, vocabulary: str
) -> None:
    known = load_vocabulary(vocabulary)
    factory = make_factory(tokenizer, level, known, "schema")
    names = set()
    for seed in range(6):
        plan = decoded(tokenizer, random_answer(factory.start(RECORD), LIMITS[level], seed))
        assert plan_problems(level, plan, known, strict=True) == []
        assert canonical_plan(level, plan, known) == plan
        names.update(json.dumps(plan))
    assert len(names) > 20


@pytest.mark.parametrize("level", LEVELS)
def test_every_right_plan_can_be_written(tokenizer: Any, level: Level) -> None:
    vocabulary = load_vocabulary()
    factory = make_factory(tokenizer, level, vocabulary, "schema")
    end = allowed_end(tokenizer)
    for record in plans(level, 60):
        ids = answer_ids(tokenizer, answer_text(level, record, vocabulary))
        assert taken(factory.start(record, 4096), [*ids, end]) == len(ids) + 1, record["prompt"]


@pytest.mark.parametrize("level", LEVELS)
def test_expected_tokens_are_those_of_training(tokenizer: Any, level: Level) -> None:
    vocabulary = load_vocabulary()
    factory = make_factory(tokenizer, level, vocabulary, "schema")
    right = count = 0
    for record in plans(level, 15):
        ids = answer_ids(tokenizer, answer_text(level, record, vocabulary))
        constraint = factory.start(record, 4096)
        for place, token in enumerate(ids):
            expected = constraint.expected()
            right += expected == ids[place : place + len(expected)]
            assert token in allowed(constraint.mask())
            constraint.accept(token)
            count += 1
        assert constraint.ended
    assert right > 0.6 * count > 0


def allowed_end(tokenizer: Any) -> int:
    from planner_ft.prompts import end_of_turn_ids

    return end_of_turn_ids(tokenizer)[0]


def test_every_end_token_may_end_an_answer_and_nothing_else(embedded: Any) -> None:
    factory = make_factory(
        embedded, "mission", load_vocabulary(), "schema", end_ids=(2, 0), n_vocab=len(embedded) + 70
    )
    constraint = factory.start(RECORD)
    assert len(constraint.mask()) == -(-(len(embedded) + 70) // 32)
    assert not constraint.ended
    for token in answer_ids(embedded, '{"tasks":[],"assumptions":[],"constraints":[]}'):
        constraint.accept(token)
    assert constraint.ended
    assert not constraint.cut
    assert allowed(constraint.mask()) == [0, 2]
    with pytest.raises(ValueError, match="complete"):
        constraint.accept(7)
    constraint.accept(2)


def test_what_is_not_allowed_is_refused_and_changes_nothing(embedded: Any) -> None:
    factory = make_factory(embedded, "mission", load_vocabulary(), "schema")
    constraint = factory.start(RECORD)
    good = answer_ids(embedded, '{"tasks":[{"title":"Transit')
    bad = answer_ids(embedded, '{"tasks":[{"title":"Berthing"')
    assert taken(constraint, good) == len(good)
    assert taken(factory.start(RECORD), bad) < len(bad)
    wrong = answer_ids(embedded, "s")[0]
    with pytest.raises(ValueError, match="not allowed"):
        constraint.accept(wrong)
    assert constraint.expected()
    expected = constraint.expected()
    assert taken(constraint, expected) == len(expected)


@pytest.mark.parametrize("level", LEVELS)
def test_an_answer_ends_within_the_smallest_limit(embedded: Any, level: Level) -> None:
    vocabulary = load_vocabulary()
    factory = make_factory(embedded, level, vocabulary, "schema")
    cut = 0
    for seed in range(8):
        constraint = factory.start(RECORD, factory.least_tokens)
        ids = random_answer(constraint, factory.least_tokens - 1, seed)
        assert plan_problems(level, decoded(embedded, ids), vocabulary, strict=True) == []
        cut += constraint.cut
    assert cut
    with pytest.raises(PlannerError, match=f"--max-new-tokens {factory.least_tokens - 1}"):
        factory.start(RECORD, factory.least_tokens - 1)


def test_a_cautious_reader_is_told_the_same_near_the_limit(embedded: Any) -> None:
    factory = make_factory(embedded, "mission", load_vocabulary(), "schema")
    constraint = factory.start(RECORD, factory.least_tokens)
    ids = random_answer(factory.start(RECORD, factory.least_tokens), factory.least_tokens, 3)
    for place in range(len(ids)):
        assert constraint.allows(ids[place])
        others = [token for token in range(0, 4000, 97) if token not in allowed(constraint.mask())]
        assert not any(constraint.allows(token) for token in others)
        constraint.accept(ids[place])


def test_strength_free_constrains_nothing(embedded: Any) -> None:
    assert (
        constraint_factory(embedded, "mission", load_vocabulary(), "free", end_ids=(2,), limit=10)
        is None
    )
