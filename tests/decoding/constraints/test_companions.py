"""Skills beside a movement, held to what the input says of them."""

from __future__ import annotations

from typing import Any

import pytest

from planner_ft.candidates import resolve_candidate
from planner_ft.candidates.loading import load_tokenizer
from planner_ft.data.task.steps import plan_step
from planner_ft.decoding.constraints.companions import Companions, read_companions, to_insist_on
from planner_ft.prompts.text import completion_text
from planner_ft.vocabulary import load_vocabulary

from .conftest import make_factory

VOCABULARY = load_vocabulary()
LEGS: dict[str, Any] = {
    "task": "Transit",
    "parameters": {"target_position": [20, 50]},
    "prompt": (
        "Go to (20, 0), then to (20, 50). Bow locked on the second leg only. Take a GPS fix on both"
        " legs."
    ),
}


@pytest.fixture(scope="module")
def tokenizer() -> Any:
    return load_tokenizer(resolve_candidate("embedded"))


def admitted(
    tokenizer: Any, record: dict[str, Any], *steps: tuple[str, dict[str, Any], list[str], list[str]]
) -> bool:
    """Whether a plan of these steps, (movement, its parameters, filters, perception skills) each,
    can be written.
    """
    plan = [
        plan_step(
            name,
            values,
            *([{"name": one, "parameters": {}} for one in names] for names in beside),
            VOCABULARY,
        )
        for name, values, *beside in steps
    ]
    ids = tokenizer.encode(
        completion_text("task", {"skill_sequence": plan}, VOCABULARY), add_special_tokens=False
    )
    return make_factory(tokenizer, "task", VOCABULARY, "grounded").start(record, 2000).admits(
        ids
    ) == len(ids)


def test_a_skill_runs_in_the_steps_that_the_text_says(tokenizer: Any) -> None:
    first, second = {"x": 20, "y": 0}, {"x": 20, "y": 50}
    assert admitted(
        tokenizer,
        LEGS,
        ("GoToXY", first, [], ["GetGPSLocation"]),
        ("GoToXY", second, ["LockHeading"], ["GetGPSLocation"]),
    )
    assert not admitted(
        tokenizer,
        LEGS,
        ("GoToXY", first, ["LockHeading"], ["GetGPSLocation"]),
        ("GoToXY", second, [], ["GetGPSLocation"]),
    )
    assert not admitted(
        tokenizer,
        LEGS,
        ("GoToXY", first, [], []),
        ("GoToXY", second, ["LockHeading"], ["GetGPSLocation"]),
    )


def test_a_skill_of_which_no_word_speaks_cannot_be_written(tokenizer: Any) -> None:
    record = {
        "task": "KeepStation",
        "parameters": {},
        "prompt": "Hold position and log the environment.",
    }
    assert admitted(tokenizer, record, ("StationKeep", {}, [], ["LogEnvironmentState"]))
    assert not admitted(
        tokenizer, record, ("StationKeep", {}, ["BoundaryEnforcement"], ["LogEnvironmentState"])
    )
    assert not admitted(
        tokenizer, record, ("StationKeep", {}, [], ["LogEnvironmentState", "LogEnvironmentState"])
    )


def test_rotations_that_leave_no_choice_are_run_in_their_order_and_no_others(
    tokenizer: Any,
) -> None:
    record = {
        "task": "HorizontalPanorama",
        "parameters": {"sectors": 3},
        "prompt": "Turn to north, east and south.",
    }
    turns = [("RotateToHeading", {"heading": heading}, [], []) for heading in (0, 90, 180)]
    assert admitted(tokenizer, record, *turns)
    assert not admitted(tokenizer, record, turns[0], turns[2], turns[1]) and not admitted(
        tokenizer, record, *turns[:2]
    )
    assert not admitted(tokenizer, record, *turns, ("RotateToHeading", {"heading": 270}, [], []))


FIXES: dict[str, Any] = {
    "task": "Transit",
    "parameters": {"target_position": [20, 50]},
    "prompt": "Go to (20, 0), then to (20, 50). Take a GPS fix.",
}


def test_an_answer_that_leaves_out_what_is_asked_for_is_written_again_with_it(
    tokenizer: Any,
) -> None:
    factory = make_factory(tokenizer, "task", VOCABULARY, "grounded")
    movements = [("GoToXY", {"x": 20, "y": 0}), ("GoToXY", {"x": 20, "y": 50})]
    answers = {}
    for count in range(3):
        skills = [[{"name": "GetGPSLocation", "parameters": {}}]] * count + [[]] * (2 - count)
        steps = [
            plan_step(name, values, [], beside, VOCABULARY)
            for (name, values), beside in zip(movements, skills, strict=True)
        ]
        answers[count] = completion_text("task", {"skill_sequence": steps}, VOCABULARY)
    assert [factory.mending(FIXES, answers[count]) is not None for count in range(3)] == [
        True,
        False,
        False,
    ]
    again = factory.mending(FIXES, answers[0])
    assert again is not None and again.mending(FIXES, answers[0]) is None
    ids = {
        count: tokenizer.encode(answer, add_special_tokens=False)
        for count, answer in answers.items()
    }
    assert [
        again.start(FIXES, 2000).admits(ids[count]) == len(ids[count]) for count in range(3)
    ] == [False, False, True]
    assert all(
        make_factory(tokenizer, "task", VOCABULARY, strength).mending(FIXES, answers[0]) is None
        for strength in ("schema", "state")
    )
    assert to_insist_on(FIXES, '{"skill_sequence":[', VOCABULARY) == frozenset()


def test_an_input_that_cannot_be_read_leaves_every_choice() -> None:
    nothing = read_companions(
        {"prompt": "Mantenga la posición y tome la temperatura del agua."}, VOCABULARY
    )
    assert nothing.spoken is None and nothing.runs("GetGPSLocation", "StationKeep", []) is None
    assert Companions().runs("LockHeading", "GoToXY", ["GoToXY"]) is None


@pytest.mark.parametrize(
    "text", ["7" * 2_000, "inspect the red buoy at [12, -40] from 15 metres " * 205, "x" * 10_000]
)
def test_what_is_no_order_to_a_task_agent_is_not_read(text: str) -> None:
    assert read_companions({"prompt": text}, VOCABULARY) == Companions()
