"""Sentence frames: how the movements, filters and perception skills of a sample are put together in
one prompt.

A frame says everything in the script once and notes in which order it mentions the skills. Frames
for one movement and for several are apart; those in UNSEEN_* appear in no split but test_unseen.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any

from planner_ft.data.task.movements import Movement
from planner_ft.data.task.phrasebook import Call, Phrasebook
from planner_ft.data.task.template import Form, compile_template


@dataclass(frozen=True)
class Scoped:
    """A skill that runs in some of the movements, given by their places."""

    call: Call
    role: str
    steps: frozenset[int]


@dataclass
class Script:
    """What a prompt has to say: movements in order, what runs in every step, and what runs in some
    of them.
    """

    movements: list[Movement]
    filters: list[Call] = field(default_factory=list)
    perceptions: list[Call] = field(default_factory=list)
    scoped: list[Scoped] = field(default_factory=list)


class Speaker:
    """Words for parts of a script; notes the order of mention."""

    def __init__(self, rng: random.Random, book: Phrasebook) -> None:
        self.rng, self.book, self.mentioned = rng, book, 0

    def pick(self, *options: str) -> str:
        """One of the options."""
        return options[int(self.rng.random() * len(options))]

    def chance(self, share: float) -> bool:
        """True in `share` of the cases."""
        return self.rng.random() < share

    def move(self, movement: Movement, form: Form = "base") -> str:
        """The movement in words."""
        assert movement.saying is not None
        return movement.saying.render(self.rng, form)

    def call(self, call: Call, form: Form = "base") -> str:
        """The skill in words."""
        self._mention(call)
        return call.saying.render(self.rng, form)

    def passive(self, call: Call) -> str:
        """A clause that says that the skill runs: "the depth is logged"."""
        self._mention(call)
        assert call.passive_saying is not None
        return call.passive_saying.render(self.rng)

    def calls(self, calls: list[Call], form: Form = "base") -> str:
        """Several skills, joined: "record the sonar, log the depth and take a fix"."""
        return join(self.parts(calls, form), self.pick(" and ", " and ", ", and "))

    def parts(self, calls: list[Call], form: Form = "base") -> list[str]:
        """Each skill in words, those that can be logged now and then together: "log the depth and
        the position".
        """
        logged = [call for call in calls if call.noun_saying is not None]
        verbs = self.book.sentences.get("log")
        if len(logged) < 2 or not verbs or self.chance(0.55):
            return [self.call(call, form) for call in calls]
        words = []
        for call in logged:
            self._mention(call)
            assert call.noun_saying is not None
            words.append(call.noun_saying.render(self.rng))
        verb = compile_template(self.pick(*verbs)).render({}, self.rng, form)
        rest = [self.call(call, form) for call in calls if call.noun_saying is None]
        return (
            [f"{verb} {join(words, ' and ')}", *rest]
            if self.chance(0.5) or not rest
            else [*rest, f"{verb} {join(words, ' and ')}"]
        )

    def with_words(self, calls: list[Call]) -> str:
        """What stands after "with"; every call must have such words."""
        words = []
        for call in calls:
            self._mention(call)
            assert call.with_saying is not None
            words.append(call.with_saying.render(self.rng))
        return join(words, " and ")

    def _mention(self, call: Call) -> None:
        self.mentioned += 1
        call.order = self.mentioned


def join(parts: list[str], last: str) -> str:
    """Parts with commas between and `last` before the last one."""
    if len(parts) < 2:
        return "".join(parts)
    return ", ".join(parts[:-1]) + last + parts[-1]


def sentence(text: str) -> str:
    """The text with a capital and a full stop; a value at its beginning keeps its case."""
    if text[:1].isalpha():
        text = text[0].upper() + text[1:]
    elif text[1:].startswith(("the ", "a ", "an ")):
        text = text[0] + text[1].upper() + text[2:]
    return text if text[-1] in ".!?" else f"{text}."


def pick_weighted(items: Sequence[tuple[Any, float]], rng: random.Random) -> Any:
    """One of the items, in proportion to its weight."""
    roll = rng.random() * sum(weight for _item, weight in items)
    for item, weight in items:
        if roll < weight:
            return item
        roll -= weight
    return items[-1][0]


def can_with(calls: list[Call]) -> bool:
    """Whether all of the skills have words that stand after "with"."""
    return bool(calls) and all(call.with_saying is not None for call in calls)


Single = Callable[[Speaker, Movement, list[Call], list[Call]], str]

# ---------------------------------------------------------------- one movement


def _tail(say: Speaker, filters: list[Call]) -> str:
    """Filters behind a clause: ", with the bow locked", ", keeping a margin of 5 m", or as a
    sentence of their own.
    """
    if not filters:
        return ""
    roll = say.rng.random()
    if can_with(filters) and roll < 0.4:
        return f"{say.pick(', with ', ' with ', ', all with ')}{say.with_words(filters)}"
    if roll < 0.65:
        return f", {say.calls(filters, 'ing')}"
    return f". {sentence(say.calls(filters))}"


def _head(say: Speaker, filters: list[Call]) -> str:
    """Filters before a clause: "With a margin of 5 m, ", "Keeping a margin of 5 m, "."""
    if not filters:
        return ""
    if can_with(filters) and say.chance(0.7):
        return f"with {say.with_words(filters)}, "
    return (
        f"{say.calls(filters, 'ing')}, " if say.chance(0.4) else f"{sentence(say.calls(filters))} "
    )


def _finish(head: str, text: str, tail: str = "") -> str:
    if head.endswith(". "):
        return head + sentence(text + tail)
    return sentence(head + text + tail)


def move_while(
    say: Speaker, movement: Movement, filters: list[Call], perceptions: list[Call]
) -> str:
    """Hold for 60 s while recording the sonar."""
    head = _head(say, filters) if say.chance(0.3) else ""
    text = say.move(movement) + (f" while {say.calls(perceptions, 'ing')}" if perceptions else "")
    return _finish(head, text, "" if head else _tail(say, filters))


def move_and(say: Speaker, movement: Movement, filters: list[Call], perceptions: list[Call]) -> str:
    """Hold for 60 s and record the sonar."""
    head = _head(say, filters) if say.chance(0.4) else ""
    parts = [say.move(movement), *say.parts(perceptions)]
    return _finish(
        head, join(parts, say.pick(" and ", " and ", ", and ")), "" if head else _tail(say, filters)
    )


def move_comma(
    say: Speaker, movement: Movement, filters: list[Call], perceptions: list[Call]
) -> str:
    """Hold for 60 s, recording the sonar and keeping a margin of 5 m."""
    text = say.move(movement)
    mixed = filters + perceptions if say.chance(0.5) else perceptions + filters
    return sentence(text + (f", {say.calls(mixed, 'ing')}" if mixed else ""))


def do_while_moving(
    say: Speaker, movement: Movement, filters: list[Call], perceptions: list[Call]
) -> str:
    """Record the sonar while holding for 60 s."""
    if not perceptions:
        return move_while(say, movement, filters, perceptions)
    return sentence(
        f"{say.calls(perceptions)} while {say.move(movement, 'ing')}{_tail(say, filters)}"
    )


def while_moving_do(
    say: Speaker, movement: Movement, filters: list[Call], perceptions: list[Call]
) -> str:
    """While holding for 60 s, record the sonar."""
    if not perceptions:
        return move_while(say, movement, filters, perceptions)
    return sentence(
        f"while {say.move(movement, 'ing')}, {say.calls(perceptions)}{_tail(say, filters)}"
    )


def sentences(
    say: Speaker, movement: Movement, filters: list[Call], perceptions: list[Call]
) -> str:
    """Hold for 60 s. Keep a margin of 5 m. Record the sonar."""
    parts = [sentence(say.move(movement))]
    parts += (
        [sentence(say.calls(perceptions))]
        if say.chance(0.6) and perceptions
        else [sentence(say.call(call)) for call in perceptions]
    )
    parts.insert(
        int(say.rng.random() * (len(parts) + 1)), sentence(say.calls(filters)) if filters else ""
    )
    return " ".join(part for part in parts if part)


def telegram(say: Speaker, movement: Movement, filters: list[Call], perceptions: list[Call]) -> str:
    """hold for 60 s; record the sonar; margin of 5 m."""
    parts = [say.move(movement), *(say.call(call) for call in perceptions)]
    if filters:
        parts.append(
            say.with_words(filters) if can_with(filters) and say.chance(0.6) else say.calls(filters)
        )
    return sentence(say.pick("; ", ", ", "; ", " - ").join(parts))


def move_with(
    say: Speaker, movement: Movement, filters: list[Call], perceptions: list[Call]
) -> str:
    """Hold for 60 s with the sonar recording and a margin of 5 m."""
    calls = perceptions + filters if say.chance(0.5) else filters + perceptions
    if not can_with(calls):
        return move_comma(say, movement, filters, perceptions)
    return sentence(f"{say.move(movement)} with {say.with_words(calls)}")


def meanwhile(
    say: Speaker, movement: Movement, filters: list[Call], perceptions: list[Call]
) -> str:
    """Hold for 60 s. Meanwhile, record the sonar."""
    if not perceptions:
        return move_while(say, movement, filters, perceptions)
    text = sentence(say.move(movement) + _tail(say, filters))
    opener = say.pick(
        "meanwhile, ",
        "at the same time, ",
        "while doing so, ",
        "throughout, ",
        "all the while, ",
        "meanwhile ",
        "during this, ",
    )
    return f"{text} {sentence(opener + say.calls(perceptions))}"


def purpose(say: Speaker, movement: Movement, filters: list[Call], perceptions: list[Call]) -> str:
    """Hold for 60 s to record the sonar."""
    if not perceptions:
        return move_and(say, movement, filters, perceptions)
    head = _head(say, filters) if say.chance(0.3) else ""
    return _finish(
        head,
        f"{say.move(movement)} {say.pick('to', 'so as to', 'in order to')}"
        f" {say.calls(perceptions)}",
        "" if head else _tail(say, filters),
    )


def labelled(say: Speaker, movement: Movement, filters: list[Call], perceptions: list[Call]) -> str:
    """Movement: hold for 60 s. Sensors: record the sonar. Limits: keep a margin of 5 m."""
    parts = [f"{say.pick('Movement', 'Manoeuvre', 'Motion')}: {say.move(movement)}."]
    if perceptions:
        parts.append(f"{say.pick('Sensors', 'Data', 'Meanwhile')}: {say.calls(perceptions)}.")
    if filters:
        parts.append(f"{say.pick('Limits', 'Safety', 'Constraints')}: {say.calls(filters)}.")
    return " ".join(parts)


def throughout_as(
    say: Speaker, movement: Movement, filters: list[Call], perceptions: list[Call]
) -> str:
    """Unseen: see to it that you record the sonar the whole time you hold for 60 s."""
    if not perceptions:
        return sentence(f"your assignment is to {say.move(movement)}{_tail(say, filters)}")
    return sentence(
        f"see to it that you {say.calls(perceptions)} the whole time you"
        f" {say.move(movement)}{_tail(say, filters)}"
    )


def two_things(
    say: Speaker, movement: Movement, filters: list[Call], perceptions: list[Call]
) -> str:
    """Unseen: I need two things at once: hold for 60 s, and record the sonar."""
    parts = (
        [say.move(movement)]
        + ([say.calls(perceptions)] if perceptions else [])
        + ([say.calls(filters)] if filters else [])
    )
    opener = {1: "just one thing", 2: "two things at once"}.get(len(parts), "three things at once")
    return sentence(f"I need {opener}: {join(parts, ', and ')}")


def inverted(say: Speaker, movement: Movement, filters: list[Call], perceptions: list[Call]) -> str:
    """Unseen: What I am after is to record the sonar; for that, hold for 60 s."""
    if not perceptions:
        return sentence(f"what is wanted here is to {say.move(movement)}{_tail(say, filters)}")
    return sentence(
        f"what I am after is to {say.calls(perceptions)}; for that,"
        f" {say.move(movement)}{_tail(say, filters)}"
    )


SINGLE: tuple[tuple[Single, float], ...] = (
    (move_while, 3),
    (move_and, 4),
    (move_comma, 3),
    (do_while_moving, 2),
    (while_moving_do, 1.5),
    (sentences, 3),
    (telegram, 1),
    (move_with, 1.5),
    (meanwhile, 1),
    (purpose, 0.6),
    (labelled, 0.4),
)
UNSEEN_SINGLE: tuple[tuple[Single, float], ...] = (
    (throughout_as, 1),
    (two_things, 1),
    (inverted, 1),
)


def no_movement(say: Speaker, filters: list[Call], perceptions: list[Call]) -> str:
    """A prompt that asks for no movement: record the sonar and log the depth."""
    roll = say.rng.random()
    if roll < 0.6 or len(perceptions) < 2:
        text = (
            sentence(say.calls(perceptions))
            if roll < 0.4 or not filters
            else _finish(_head(say, filters), say.calls(perceptions))
        )
        rest = [call for call in filters if not call.order]
        return f"{text} {sentence(say.calls(rest))}" if rest else text
    if roll < 0.85:
        parts = [sentence(say.calls(perceptions[:1])), sentence(say.calls(perceptions[1:]))]
    else:
        parts = [
            sentence(say.pick("; ", ", then ", ", ").join(say.call(call) for call in perceptions))
        ]
    return " ".join(parts + ([sentence(say.calls(filters))] if filters else []))
