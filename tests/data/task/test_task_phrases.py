"""The phrase language and how values are said."""

import random
import re

import pytest

from planner_ft.data.numbers import bearing, duration, polygon, position, rotation
from planner_ft.data.task.compose import skill_clause
from planner_ft.data.task.draw import Context, Drawing
from planner_ft.data.task.phrasebook import gerund, phrasebook
from planner_ft.data.templates.render import joined, plain, skeleton
from planner_ft.data.values import WordLists, made_up_name
from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary import load_vocabulary

USV = load_vocabulary()
BOOK = phrasebook(USV, unseen=False)


def wordings(make, count=400):
    rng = random.Random(0)
    return {make(rng) for _ in range(count)}


def clause(phrase, *, ing=False, skill="StationKeep"):
    """(prompt, parameters) of the phrase, drawn for a task of that skill."""
    for seed in range(200):
        context = Context(BOOK, USV.task["KeepStation"], random.Random(seed))
        drawing = Drawing(skill_clause(BOOK, skill, phrase, ing), context)
        given = drawing.plan.steps()[0]["navigation_skill"]["parameters"]
        yield plain(joined(drawing.pieces(), small=True)), given, context


def test_optional_parts_stand_exactly_when_their_slot_is_given():
    seen = set()
    for text, given, _context in clause("(~hold|~keep) station[ for {time}]"):
        assert ("time" in given) == (" for " in text)
        seen.add((text.split()[0], "time" in given))
    assert seen == {(verb, given) for verb in ("hold", "keep") for given in (True, False)}
    assert {text.split()[0] for text, *_rest in clause("(~hold|~keep) station", ing=True)} == {
        "holding",
        "keeping",
    }


def test_a_marked_slot_is_stated_and_another_may_be_referred_to():
    referred = {
        phrase: [
            text
            for text, *_rest in clause(phrase)
            if not re.search(r"\d| an? |half|hour|minu|seco|oupl", text)
        ]
        for phrase in ("~hold for {time#}", "~hold for {time}")
    }
    assert not referred["~hold for {time#}"]
    assert len(referred["~hold for {time}"]) > 20
    for text, given, context in clause("~hold for {time}"):
        if text in referred["~hold for {time}"]:
            assert given["time"] == context.parameters()["duration"]


def test_gerund():
    verbs = ["hold", "take", "run", "swing", "nudge", "log"]
    assert [gerund(verb) for verb in verbs] == [
        "holding",
        "taking",
        "running",
        "swinging",
        "nudging",
        "logging",
    ]


def test_skeleton_masks_values():
    text = "Hold for \x0260 s\x03 near \x02KX-07\x03."
    assert plain(text) == "Hold for 60 s near KX-07." and skeleton(text) == "Hold for _ near _."


def test_rotations_say_their_sign():
    said = wordings(lambda rng: rotation(-15, rng).text)
    assert {"15 degrees to the left", "15 degrees to port", "15 degrees anticlockwise"} <= said
    assert all(
        any(
            word in text
            for word in ("left", "port", "anticlockwise", "counter-clockwise", "minus", "-15")
        )
        for text in said
    )


def test_bearings_durations_and_positions_in_many_forms():
    assert {"045", "north-east", "45 degrees"} <= wordings(lambda rng: bearing(45, rng).text)
    assert {"150 s", "two and a half minutes", "2.5 minutes"} <= wordings(
        lambda rng: duration(150, rng).text, 2000
    )
    positions = wordings(lambda rng: position((-62, 18), rng).text, 4000)
    assert {
        "[-62, 18]",
        "(-62, 18)",
        "x=-62, y=18",
        "x -62 y 18",
        "minus 62, 18",
        "62 west 18 north",
    } <= positions


def test_a_square_fence_may_be_said_by_its_half_side():
    said = wordings(lambda rng: polygon([(-10, -10), (10, -10), (10, 10), (-10, 10)], rng).noun)
    assert (
        "a 10-metre square around [0, 0]" in said and "the box from [-10, -10] to [10, 10]" in said
    )


def test_made_up_names_differ():
    rng = random.Random(1)
    assert len({made_up_name(rng) for _ in range(300)}) > 280
    assert len({WordLists().entry("code", rng) for _ in range(300)}) > 250


@pytest.mark.parametrize(
    ("lists", "problem"),
    [
        ({"gate": ["the {nam} gate"]}, "gate: there is no word list 'nam'"),
        ({"a": ["a {b}", "c"], "b": ["the {a}"]}, "names"),
    ],
)
def test_word_lists_that_cannot_be_filled_are_named(
    lists: dict[str, list[str]], problem: str
) -> None:
    with pytest.raises(PlannerError, match=problem):
        WordLists(lists)
