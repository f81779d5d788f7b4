"""Skill sequences made as they grow."""

from __future__ import annotations

import itertools
from typing import Any

import pytest

from planner_ft.candidates import resolve_candidate
from planner_ft.candidates.loading import load_tokenizer
from planner_ft.data.task.sampler import sample_tasks
from planner_ft.decoding.constraints.answer import Answer
from planner_ft.decoding.constraints.companions import Companions
from planner_ft.decoding.constraints.grammar import SchemaValues
from planner_ft.decoding.constraints.reading.rows.sequence import read_sequence
from planner_ft.decoding.constraints.routes import TaskScript
from planner_ft.decoding.constraints.tokens import allows, tokens_of
from planner_ft.decoding.constraints.waypoints import read_ground
from planner_ft.prompts.text import completion_text
from planner_ft.vocabulary import load_vocabulary

VOCABULARY = load_vocabulary()


@pytest.fixture(scope="module")
def tokenizer() -> Any:
    return load_tokenizer(resolve_candidate("embedded"))


def start(tokenizer: Any, record: dict[str, Any]) -> Answer:
    tokens = tokens_of(tokenizer, (tokenizer.eos_token_id,), None)
    return Answer(
        tokens,
        TaskScript(VOCABULARY, SchemaValues(), read_ground(record, VOCABULARY), record["prompt"]),
        2048,
        300,
    )


def ids(tokenizer: Any, text: str) -> list[int]:
    return list(tokenizer.encode(text, add_special_tokens=False))


def test_the_answers_of_sampled_tasks_are_admitted(tokenizer: Any) -> None:
    """Nearly all; of 700 other samples 20 of the 669 whose places are read are kept out."""
    kept_out = []
    for record in itertools.islice(sample_tasks(VOCABULARY, 91, None, "train"), 120):
        if read_ground(record, VOCABULARY).free:
            continue
        answer, tokens = (
            start(tokenizer, record),
            ids(tokenizer, completion_text("task", record["expected"], VOCABULARY)),
        )
        if answer.admits(tokens) < len(tokens):
            kept_out.append(record["prompt"])
            continue
        for token in tokens:
            answer.accept(token)
        assert answer.ended, record["prompt"]
    assert len(kept_out) <= 4, kept_out


def test_no_step_repeats_the_place_before_it_and_no_grid_is_left_half_way(tokenizer: Any) -> None:
    record = {
        "task": "BathymetryGridSurvey",
        "parameters": {"center": [0, 0], "width": 20, "length": 40, "spacing": 20},
        "prompt": "Run the grid.",
    }
    step = '{"navigation_skill":{"name":"GoToXY","parameters":{"x":%d,"y":%d}},"filter_skills":[],"perception_skills":[],"stop_conditions":[],'
    step += '"failure_modes":[],"expected_outputs":[]}'
    answer = start(tokenizer, record)
    for token in ids(tokenizer, '{"skill_sequence":[' + step % (-10, -20) + "," + step % (-10, 20)):
        answer.accept(token)
    closing, onward = ids(tokenizer, "]}")[0], ids(tokenizer, ',{"navigation_skill":{"name":"')[0]
    assert not allows(answer.mask(), closing) and allows(answer.mask(), onward)
    rest = "," + step % (10, 20) + "," + step % (10, -20) + "]}"
    assert answer.admits(ids(tokenizer, rest)) == len(ids(tokenizer, rest))
    again = ids(tokenizer, "," + step % (-10, 20))
    assert answer.admits(again) < len(again)


def test_a_step_that_may_not_follow_gives_way_to_the_end(tokenizer: Any) -> None:
    record = {
        "task": "BathymetryGridSurvey",
        "parameters": {"center": [0, 0], "width": 20, "length": 40, "spacing": 20},
    }
    record["prompt"] = "Run the grid with a hold of 20 s somewhere."
    step = '{"navigation_skill":{"name":"GoToXY","parameters":{"x":%d,"y":%d}},"filter_skills":[],"perception_skills":[],"stop_conditions":[],'
    step += '"failure_modes":[],"expected_outputs":[]}'
    places = [step % place for place in ((-10, -20), (-10, 20), (10, 20), (10, -20))]
    other = ids(tokenizer, "GoToXY")[0]
    for count in (3, 4):
        answer = start(tokenizer, record)
        for token in ids(
            tokenizer,
            '{"skill_sequence":[' + ",".join(places[:count]) + ',{"navigation_skill":{"name":"',
        ):
            answer.accept(token)
        assert (answer.instead(other) is None) == (count == 3)
    # The model is asked, even if a single name may follow.
    assert answer.forced() == [] and not allows(answer.mask(), other)
    ended = answer.instead(other)
    assert ended is not None and ended[-1] == tokenizer.eos_token_id
    assert tokenizer.decode(ended[:-1]) == '{"skill_sequence":[' + ",".join(places) + "]}"
    assert answer.instead(ids(tokenizer, "sail")[0]) is None


@pytest.mark.parametrize(
    ("classes", "whole"),
    [
        (["seals"], True),
        (["seals", "pots", "rafts"], True),
        (["seals", "pots", "seals"], False),
        (["pots", "Pots"], False),
    ],
)
def test_no_text_stands_twice_in_a_list(tokenizer: Any, classes: list[str], whole: bool) -> None:
    record = {
        "task": "Transit",
        "parameters": {"target_position": [30, 40]},
        "prompt": "Go to [30, 40] and detect seals, pots and rafts.",
    }
    step: dict[str, Any] = {
        "navigation_skill": {"name": "GoToXY", "parameters": {"x": 30, "y": 40}},
        "filter_skills": [],
    }
    step["perception_skills"] = [{"name": "DetectObjects", "parameters": {"class_list": classes}}]
    step |= {"stop_conditions": [], "failure_modes": [], "expected_outputs": []}
    tokens = ids(tokenizer, completion_text("task", {"skill_sequence": [step]}, VOCABULARY))
    assert (start(tokenizer, record).admits(tokens) == len(tokens)) is whole


STEP = '{"navigation_skill":{"name":"%s","parameters":%s},"filter_skills":[],"perception_skills":[],"stop_conditions":[],'
STEP += '"failure_modes":[],"expected_outputs":[]}'


def test_a_movement_that_is_asked_for_is_not_left_out(tokenizer: Any) -> None:
    record = {
        "task": "Transit",
        "parameters": {"target_position": [30, 40]},
        "prompt": "Go to [30, 40] and hold there for 20 s, then face 90.",
    }
    companions = Companions(asked=frozenset(("StationKeep",)))
    script = TaskScript(
        VOCABULARY,
        SchemaValues(),
        read_ground(record, VOCABULARY),
        str(record["prompt"]),
        companions=companions,
    )
    answer = Answer(tokens_of(tokenizer, (tokenizer.eos_token_id,), None), script, 2048, 300)
    whole = '{"skill_sequence":[' + STEP % ("GoToXY", '{"x":30,"y":40}')
    tokens = ids(tokenizer, whole + "]}")
    kept = answer.admits(tokens)
    assert kept < len(tokens)
    for token in tokens[:kept]:
        answer.accept(token)
    # The next step must come, but the model is asked whether it would end here.
    assert answer.forced() == [] and answer.instead(tokens[kept]) is None
    written = tokenizer.decode(tokens[:kept])
    while not written.endswith('"name":"'):
        further = ids(tokenizer, (whole + "," + STEP)[len(written) : len(whole) + 30])[0]
        answer.accept(further)
        written += tokenizer.decode([further])
    assert tokenizer.decode(answer.forced()).startswith("StationKeep")


def test_a_movement_that_is_asked_for_may_come_where_the_model_wants_it(tokenizer: Any) -> None:
    record = {
        "task": "Transit",
        "parameters": {"target_position": [30, 40]},
        "prompt": "Face 90, hold for 20 s, face 180.",
    }
    companions = Companions(asked=frozenset(("StationKeep",)))
    steps = [
        STEP % ("RotateToHeading", '{"heading":90}'),
        STEP % ("StationKeep", '{"time":20}'),
        STEP % ("RotateToHeading", '{"heading":180}'),
    ]
    for kept, admitted in ((steps, True), (steps[::2], False), (steps[1:], True)):
        script = TaskScript(
            VOCABULARY,
            SchemaValues(),
            read_ground(record, VOCABULARY),
            str(record["prompt"]),
            companions=companions,
        )
        answer = Answer(tokens_of(tokenizer, (tokenizer.eos_token_id,), None), script, 2048, 300)
        tokens = ids(tokenizer, '{"skill_sequence":[' + ",".join(kept) + "]}")
        assert (answer.admits(tokens) == len(tokens)) == admitted


def test_a_row_of_movements_that_is_known_is_written_as_it_stands(tokenizer: Any) -> None:
    record = {
        "task": "Transit",
        "parameters": {},
        "prompt": "Hold for 20 s within 3 m, face 180, wait until steady, go to [30, 40].",
    }
    sequence = read_sequence(record, VOCABULARY)
    steps = [
        STEP % ("StationKeep", '{"radius":3,"time":20}'),
        STEP % ("RotateToHeading", '{"heading":180}'),
        STEP % ("WaitForStability", "{}"),
        STEP % ("GoToXY", '{"x":30,"y":40}'),
    ]
    other = [STEP % ("StationKeep", '{"time":20}'), *steps[1:]]
    for kept, admitted in (
        (steps, True),
        (steps[:3], False),
        (steps[::-1], False),
        (other, False),
        ([*steps, steps[0]], False),
    ):
        script = TaskScript(
            VOCABULARY,
            SchemaValues(),
            read_ground(record, VOCABULARY),
            record["prompt"],
            sequence=sequence,
        )
        answer = Answer(tokens_of(tokenizer, (tokenizer.eos_token_id,), None), script, 2048, 300)
        tokens = ids(tokenizer, '{"skill_sequence":[' + ",".join(kept) + "]}")
        assert (answer.admits(tokens) == len(tokens)) == admitted


def test_what_the_model_means_need_not_be_a_step(tokenizer: Any) -> None:
    record = {
        "task": "Transit",
        "parameters": {"target_position": [30, 40]},
        "prompt": "Go to [30, 40] and hold there for 20 s.",
    }
    script = TaskScript(
        VOCABULARY,
        SchemaValues(),
        read_ground(record, VOCABULARY),
        str(record["prompt"]),
        companions=Companions(asked=frozenset(("StationKeep",))),
    )
    opened = script.following('{"skill_sequence":[{"navigation_skill":{"name":"')
    assert opened is not None
    named = opened[1].following("GoToXY")
    assert named is not None
    for text in ('"}}', '","parameters":{}', '","parameters":{"x":30}}}]}', "}]"):
        assert named[1].pressed(text) is None or "parameters" in text
        assert named[1].asks(text) is None or "parameters" in text
