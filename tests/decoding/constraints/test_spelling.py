"""Masks allow the tokens that a tokenizer would write, and not the pieces of them that no model was
trained on.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from planner_ft.data.task.sampler import sample_tasks
from planner_ft.decoding.configurations import Strength
from planner_ft.decoding.constraints.tokens import allows
from planner_ft.prompts.text import answer_text
from planner_ft.vocabulary import load_vocabulary

from .conftest import answer_ids, load, make_factory

TURNS = {
    "task": "HorizontalPanorama",
    "parameters": {},
    "prompt": "Turn to 090, then to 180. Detect buoys on the second bearing only.",
}
JOINED = '}},"filter_skills":[],"perception_skills":['
"""How the embedded candidate's tokens for the end of a movement begin; a list of skills is opened
or not within the token.
"""


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
            if not constraint.forced():
                choices += 1
                assert allows(constraint.mask(), token), (
                    record["prompt"],
                    tokenizer.decode([token]),
                )
            constraint.accept(token)
    assert choices > 250


def test_a_joined_token_is_taken_whole_where_what_the_model_would_write_is_ruled_out(
    embedded: Any,
) -> None:
    """No skill may run beside the first turn: the list is opened and closed by one token, as in
    every text of training.
    """
    spelt = {embedded.decode([token]): token for token in range(len(embedded))}
    opens, closes = spelt[JOINED + '{"name":"'], spelt[JOINED + '],"stop_conditions":["']
    constraint = make_factory(embedded, "task", load_vocabulary(), "grounded").start(TURNS, 2048)
    begun = '{"skill_sequence":[{"navigation_skill":{"name":"RotateToHeading","parameters":{"heading":90'
    for token in embedded.encode(begun, add_special_tokens=False):
        constraint.accept(token)
    assert constraint.admits([opens]) == 0 and constraint.akin(opens) == [closes]
    pieces = [
        token
        for text, token in spelt.items()
        if JOINED.startswith(text) and allows(constraint.mask(), token)
    ]
    assert allows(constraint.mask(), closes) and len(pieces) <= 1


def test_numbers_are_no_kin(embedded: Any) -> None:
    constraint = make_factory(embedded, "task", load_vocabulary(), "grounded").start(TURNS, 2048)
    for token in embedded.encode(
        '{"skill_sequence":[{"navigation_skill":{"name":"RotateToHeading","parameters":{"heading":',
        add_special_tokens=False,
    ):
        constraint.accept(token)
    (seven,) = embedded.encode("7", add_special_tokens=False)
    assert constraint.admits([seven]) == 0 and constraint.akin(seven) == []


CREW = {
    "task": "Transit",
    "parameters": {},
    "prompt": (
        "Crew is on deck. Go to [55, 12], then turn to 090 and to 110. In each of the two turns log"
        " a lidar slice."
    ),
}


def test_a_list_that_was_opened_for_a_skill_which_may_not_stand_in_it_is_closed(
    embedded: Any,
) -> None:
    spelt = {embedded.decode([token]): token for token in range(len(embedded))}
    constraint = make_factory(embedded, "task", load_vocabulary(), "grounded").start(CREW, 2048)
    begun = embedded.encode(
        '{"skill_sequence":[{"navigation_skill":{"name":"GoToXY","parameters":{"x":55,"y":12',
        add_special_tokens=False,
    )
    for token in [*begun, spelt[JOINED + '{"name":"']]:
        constraint.accept(token)
    slices, watch, move = (spelt[name] for name in ("LogLidarSlice", "DetectObjects", "GoToXY"))
    assert (
        constraint.forced() == []
        and constraint.admits([watch]) == 1
        and constraint.admits([slices]) == 0
    )
    assert constraint.declined(slices) == [*begun, spelt[JOINED + '],"stop_conditions":["']]
    assert constraint.declined(move) is None


@pytest.mark.parametrize("name", ["Llama-3.2-1B-Instruct", "Qwen2.5-3B"])
def test_what_a_closed_list_begins_with_may_follow(name: str, standins: Path) -> None:
    tokenizer = load(name, standins)
    factory = make_factory(tokenizer, "task", load_vocabulary(), "grounded")
    constraint, text = (
        factory.start(CREW, 2048),
        '{"skill_sequence":[{"navigation_skill":{"name":"GoToXY","parameters":{"x":55,"y":12}},"filter_skills":[],"perception_skills":[',
    )
    for token in tokenizer.encode(text + '{"name":"', add_special_tokens=False):
        constraint.accept(token)
    first, *_rest = tokenizer.encode("LogLidarSlice", add_special_tokens=False)
    closed = constraint.declined(first)
    assert closed and tokenizer.decode(closed).startswith(text + "]")
    assert factory.start(CREW, 2048).admits(closed) == len(closed)
