"""Prompts that first say all movements and then what runs in which of them."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from planner_ft.data.numbers import in_words
from planner_ft.data.task.movements import Movement
from planner_ft.data.task.phrasebook import Call
from planner_ft.data.task.phrasing import Scoped, Script, Speaker, join, pick_weighted, sentence
from planner_ft.data.task.scopes import Scopes, group_of
from planner_ft.data.task.sequences import (
    after_first,
    before_last,
    comma_list,
    first_then,
    followed_by,
    numbered,
    semicolons,
    short_sentences,
    then_chain,
)

Body = Callable[[Speaker, list[Movement]], str]

COUNTED = {"leg": "leg", "hold": "hold", "turn": "turn", "drift": "drift"}


def counted(say: Speaker, movements: list[Movement]) -> str:
    """Three legs: go to A, go to B and go to C."""
    groups = {group_of(movement) for movement in movements}
    noun = (
        COUNTED[groups.pop()]
        if len(groups) == 1 and set(groups) <= set(COUNTED)
        else say.pick("step", "part", "stage", "step")
    )
    opener = f"{in_words(len(movements))} {noun}s"
    if noun == "leg" and (places := [place_of(movement) for movement in movements]) and all(places):
        return sentence(legs(say, opener, places))
    if say.chance(0.5):
        return sentence(
            f"{opener}:"
            f" {join([say.move(movement) for movement in movements], say.pick(', then ', ' and ', ', and then '))}"
        )
    names = [
        "the first is to",
        *(
            [
                "the second is to",
                "the third is to",
                "the fourth is to",
                "the fifth is to",
                "the sixth is to",
            ][: len(movements) - 1]
        ),
    ]
    if say.chance(0.3):
        names[-1] = "the last is to"
    joint = say.pick("; ", ", ", ". ")
    parts = [
        f"{name} {say.move(movement)}" for name, movement in zip(names, movements, strict=False)
    ]
    if joint == ". ":
        return " ".join([sentence(opener), *(sentence(part) for part in parts)])
    return sentence(f"{opener}: {joint.join(parts)}")


def place_of(movement: Movement) -> str:
    """Where a movement to one stated place goes, as it is said; empty for another movement, or one
    with a heading.
    """
    slots = movement.saying.slots if movement.saying else None
    plain = slots is not None and movement.kind == "goto" and not {"yaw", "away"} & slots.given
    return slots.get("xy", "") if plain and slots is not None else ""


def legs(say: Speaker, opener: str, places: list[str]) -> str:
    """Three legs: to A, to B, then to C."""
    if say.chance(0.3):
        return f"{opener}: {join(places, say.pick(', then ', ' and ', ', '))}"
    if say.chance(0.3):
        return say.pick("go to ", "run to ", "head for ", "route: ") + join(
            places, say.pick(", then ", " and then ", " and on to ")
        )
    return (
        f"{opener}: {join([f'to {place}' for place in places], say.pick(', then ', ' and ', ', '))}"
    )


def in_order(say: Speaker, movements: list[Movement]) -> str:
    """In this order: go to A, turn to 090, hold for 60 s."""
    opener = say.pick(
        "in this order: ",
        "do the following in turn: ",
        "the sequence is: ",
        "order of events: ",
        "plan: ",
        "do this in sequence: ",
    )
    return sentence(
        opener
        + say.pick(", ", "; ", ", then ", " - ").join(say.move(movement) for movement in movements)
    )


def dashes(say: Speaker, movements: list[Movement]) -> str:
    """- go to A - turn to 090 - hold for 60 s."""
    mark = say.pick("- ", "* ", "a) ")
    parts = [f"{chr(97 + index)}) " if mark == "a) " else mark for index in range(len(movements))]
    return " ".join(
        f"{part}{say.move(movement)}" for part, movement in zip(parts, movements, strict=True)
    ) + say.pick(".", ";", ".")


BODIES: tuple[tuple[Body, float], ...] = (
    (then_chain, 4),
    (comma_list, 3),
    (first_then, 3),
    (numbered, 2),
    (semicolons, 1.2),
    (after_first, 0.8),
    (before_last, 0.6),
    (short_sentences, 3),
    (followed_by, 1.5),
    (counted, 2.5),
    (in_order, 0.7),
    (dashes, 0.3),
)


def outline(say: Speaker, script: Script) -> str:
    """The movements in one of the bodies, and a sentence for each set of steps in which something
    runs.
    """
    body = pick_weighted(BODIES, say.rng)
    scopes = Scopes(script.movements, say.book, say.rng, numbered=body is numbered)
    front = [scoped for scoped in script.scoped if say.chance(0.15)] if body is not numbered else []
    before = scope_sentences(say, front, scopes)
    text = body(say, script.movements)
    return " ".join(
        [
            *before,
            text,
            *scope_sentences(
                say, [scoped for scoped in script.scoped if scoped not in front], scopes
            ),
        ]
    )


def scope_sentences(say: Speaker, scoped: Sequence[Scoped], scopes: Scopes) -> list[str]:
    """One sentence for each set of steps; skills of the same set share it now and then."""
    sets: dict[frozenset[int], list[Call]] = {}
    for item in scoped:
        sets.setdefault(item.steps, []).append(item.call)
    said = []
    for steps, calls in sets.items():
        groups = [calls] if len(calls) == 1 or say.chance(0.65) else [[call] for call in calls]
        said += [scope_sentence(say, group, scopes.alone(steps)) for group in groups]
    return said


def scope_sentence(say: Speaker, calls: list[Call], where: str) -> str:
    """Log the depth in the second step only; in the second step, the depth is logged; second step:
    depth logging.
    """
    roll = say.rng.random()
    with_words = all(call.with_saying for call in calls)
    if roll < 0.22 and all(call.passive_saying for call in calls):
        text = join([say.passive(call) for call in calls], " and ")
        return (
            sentence(f"{where}, {text}")
            if roll < 0.08 and "," not in where
            else sentence(f"{text} {where}")
        )
    if roll < 0.4 and with_words:
        nouns = say.with_words(calls)
        return sentence(f"{where}: {nouns}") if roll < 0.26 else sentence(f"{nouns} {where}")
    if roll < 0.6 and "," not in where:
        return sentence(f"{where}, {say.calls(calls)}")
    if roll < 0.66:
        return sentence(
            f"{where.replace(' only', '')} {say.pick('you should', 'I want you to', 'please')}"
            f" {say.calls(calls)}"
        )
    return sentence(f"{say.calls(calls)} {where}")
