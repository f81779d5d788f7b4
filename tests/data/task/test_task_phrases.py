"""The phrase language and how values are said."""

import random

import pytest
from planner_ft.data.task.phrase import gerund, mark, parse_phrase

from planner_ft.data.numbers import bearing, duration, polygon, position, rotation
from planner_ft.data.templates.render import plain, skeleton
from planner_ft.data.wordlists import made_up_code, made_up_name


def wordings(make, count=400):
    rng = random.Random(0)
    return {make(rng) for _ in range(count)}


def test_optional_parts_stand_exactly_when_their_slot_is_given():
    template = parse_phrase("(~hold|~keep) station[ for {time}]")
    assert (
        template.fits(frozenset())
        and template.fits(frozenset({"time"}))
        and not template.fits(frozenset({"radius"}))
    )
    assert wordings(lambda rng: template.render({"time": "60 s"}, rng)) == {
        "hold station for 60 s",
        "keep station for 60 s",
    }
    assert wordings(lambda rng: template.render({}, rng, ing=True)) == {
        "holding station",
        "keeping station",
    }


def test_a_phrase_for_stated_values_is_not_used_for_a_referred_one():
    template = parse_phrase("~survey it from {radius#} away")
    assert template.fits(frozenset({"radius", "radius full"})) and not template.fits(
        frozenset({"radius"})
    )


@pytest.mark.parametrize(
    "phrase", ["~save the (buffer|last {time})", "~go [to {x}|there]", "~go (there", "~go } there"]
)
def test_phrases_that_could_leave_a_value_unsaid_are_refused(phrase):
    with pytest.raises(ValueError):
        parse_phrase(phrase)


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
    text = f"Hold for {mark('60 s')} near {mark('KX-07')}."
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
    assert len({made_up_code(rng) for _ in range(300)}) > 250
