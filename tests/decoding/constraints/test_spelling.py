"""Masks allow the tokens that a tokenizer would write, and not the pieces of them that no model was
trained on.
"""

from __future__ import annotations

from typing import Any

import pytest

from planner_ft.data.task.sampler import sample_tasks
from planner_ft.decoding.configurations import Strength
from planner_ft.decoding.constraints.tokens import allows
from planner_ft.prompts.text import answer_text
from planner_ft.vocabulary import load_vocabulary

from .conftest import answer_ids, make_factory


@pytest.mark.parametrize("strength", ["schema", "grounded"])
def test_the_token_of_training_is_allowed_wherever_there_is_a_choice(
    tokenizer: Any, strength: Strength
) -> None:
    vocabulary = load_vocabulary()
    factory = make_factory(tokenizer, "task", vocabulary, strength)
    choices = 0
    for record in sample_tasks(vocabulary, 7, 12, "train"):
        ids = answer_ids(tokenizer, answer_text("task", record, vocabulary))
        constraint = factory.start(record, 4096)
        if constraint.admits(ids) < len(ids):
            continue
        for token in ids:
            if not constraint.expected():
                choices += 1
                assert allows(constraint.mask(), token), (
                    record["prompt"],
                    tokenizer.decode([token]),
                )
            constraint.accept(token)
    assert choices > 250
