"""How often a plan may say the same: a skill twice in a step, a turn or a hold again and again.

A skill stands in a step once, or again with another value. A step comes again as often as the text
says its value or asks for repetition; no turn goes to the heading that the vehicle has. Models that
have lost the thread repeat steps without end otherwise.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

from planner_ft.data.quantities import COMPASS, SHORT, close, quantities
from planner_ft.data.stated import radio_digits
from planner_ft.decoding.constraints.grammar import (
    Context,
    Grammar,
    Narrowed,
    Values,
    written_number,
)
from planner_ft.decoding.constraints.patterns import literal
from planner_ft.vocabulary import Parameter, Skill, Task

Step = tuple[Skill, Mapping[str, Any]]
"""A movement and its parameters."""

OPEN_ENDED = re.compile(
    r"\b(?:at a time|each"
    r" time|every|steps?|sectors?|segments?|stops|per|until|till|evenly|equal\w*|apart|all (?:the"
    r" way )?round|full (?:circle|turn|round)|"
    r"laps?|rounds?|repeat\w*|through|over and over|continu\w+|keep (?:on"
    r" )?(?:turning|panning)|stages|increments?)\b",
    re.IGNORECASE,
)
"""Words for a movement in as many steps as it takes."""
SHARED = re.compile(
    r"\b(?:each|every|any)\b(?! ?(?:other"
    r" )?(?:\d|few|second|minute|metre|meter|half|quarter|two|three|four|five|six|eight|ten|twelve|fifteen|twenty|"
    r"thirty|fifty))|"
    r"\b(?:both|all|times|times|per|corners|ends|stops|points|waypoints|between|in"
    r" between|either|places|stations|holds|headings|bearings|whenever|always|"
    r"same|likewise|again)\b",
    re.IGNORECASE,
)
"""Words for a step that comes at several places."""
STANDING = re.compile(
    r"(?<!that )(?<!the )(?<!this )(?<!these )(?<!each )(?<!every"
    r" )\b(?:hold|wait|stay|remain|drift|float|keep station)(?:s|ing)?\b",
    re.IGNORECASE,
)
"""Verbs for a step that goes nowhere."""
AGAIN = re.compile(
    r"\b(?:(?<!say )again|once more|another|a"
    r" (?:second|third|further)|back|return\w*|same|likewise|ditto|each|twice|as"
    r" before|between|either)\b",
    re.IGNORECASE,
)
"""Words that can ask for a step a second time."""
TIMES = re.compile(
    r"\s?(?:\w+"
    r" )?(?:times|x|turns?|circles?|pans?|nudges?|holds?|arcs?|steps?|stops?|sweeps?|waits?|drifts?|legs?|passes|bearings?|headings?)\b",
    re.IGNORECASE,
)
"""What stands behind a number that says how often."""
UNBOUNDED = 64
MOST_ALIKE = 4
"""Uses of a skill in one step: models that have lost the thread name one part of the text after the
other.
"""
ROTATING = ("turn_to", "turn_by")
TURNING = (*ROTATING, "arc")
_POINT = re.compile(
    r"\b(?:north|south|east|west)(?:["
    r" -]?(?:north|south|east|west)){0,2}(?:ern|wards?|erly)?\b|\b[NSEW]{1,3}\b",
    re.IGNORECASE,
)
_POINTS = {
    name.lower().replace("-", ""): 22.5 * index
    for names in (COMPASS, SHORT)
    for index, name in enumerate(names)
}


def most_often(text: str, value: Any, *, counted_only: bool = False) -> int:
    """How often a step with this value may come: as often as the text says it, or as it asks for
    repetition; with `counted_only`, so many times at most.
    """
    plain = radio_digits(text)
    open_ended = OPEN_ENDED.search(plain) is not None
    if open_ended and not counted_only:
        return UNBOUNDED
    counted = [
        int(found.said)
        for found in quantities(plain)
        if found.unit is None and found.said in range(2, 37) and TIMES.match(plain[found.end :])
    ]
    said = 0
    if isinstance(value, int | float) and not isinstance(value, bool):
        said = sum(
            close(found.value, abs(value)) or close(found.said, abs(value))
            for found in quantities(plain)
        )
        said = max(said, sum(bearing == value % 360 for bearing in _compass(plain)))
    return max(
        1,
        said,
        2 if AGAIN.search(plain) else 1,
        len(STANDING.findall(plain)) if open_ended else 1,
        *counted,
    )


def _compass(text: str) -> Iterator[float]:
    """The bearings of the compass points that a text names, each time that it does."""
    for match in _POINT.finditer(text):
        point = re.sub(r"[\s-]|ern$|wards?$|erly$", "", match[0].lower())
        yield _POINTS.get(point, -1.0)


class UnlikeValues(Narrowed):
    """The values of another strength; a skill that was used says another value than before, for the
    parameter that told its uses apart.
    """

    def __init__(self, values: Values, skill: Skill, used: Sequence[Mapping[str, Any]]) -> None:
        super().__init__(values)
        self._skill = skill
        self._told = next(
            (item for item in _telling(skill) if any(item.name in one for one in used)), None
        )
        self._barred = [
            one[self._told.name] for one in used if self._told and self._told.name in one
        ]

    def parameter(
        self, grammar: Grammar, parameter: Parameter, owner: Task | Skill, context: Context
    ) -> list[tuple[str, Context]]:
        if not self._tells(parameter, owner):
            return super().parameter(grammar, parameter, owner, context)
        symbol: str | None = None
        if parameter.type in ("number", "integer"):
            symbol = self.number(grammar, parameter, self._barred)
        elif parameter.type in ("text", "id"):
            symbol = self.text(grammar, [str(value) for value in self._barred])
        else:
            return super().parameter(grammar, parameter, owner, context)
        return [(symbol, context)] if symbol else []

    def needs(self, parameter: Parameter, owner: Task | Skill) -> bool:
        return super().needs(parameter, owner) or self._tells(parameter, owner)

    def _tells(self, parameter: Parameter, owner: Task | Skill) -> bool:
        return owner == self._skill and parameter == self._told


def repeatable(skill: Skill, used: Iterable[Mapping[str, Any]]) -> bool:
    """Whether a skill that was used in a step can stand in it again: each use had a parameter that
    another use can have otherwise.
    """
    uses = list(used)
    return not uses or (bool(skill.parameters) and all(uses) and len(uses) < MOST_ALIKE)


def spent(skill: Skill, steps: Sequence[Step], text: str) -> list[Mapping[str, Any]]:
    """The parameters with which a movement cannot come again: they came as often as they may, or
    turn to where the vehicle points.
    """
    if skill.motion == "goto":
        return []
    # A hold comes again behind every turn; a turn does not.
    recent = (
        steps
        if skill.motion in TURNING
        else list(itertools.takewhile(lambda step: step[0] == skill, reversed(steps)))
    )
    uses = [parameters for used, parameters in recent if used == skill]
    # What follows itself without a movement between is no step on the way round: words like "every"
    # do not ask for it.
    standing = skill.motion not in TURNING
    found = [
        one
        for number, one in enumerate(uses)
        if one not in uses[:number]
        and uses.count(one) >= most_often(text, _value(skill, one), counted_only=standing)
    ]
    if standing and not SHARED.search(text):
        everywhere = [parameters for used, parameters in steps if used == skill and parameters]
        most = (
            max(2, *(most_often(text, _value(skill, one), counted_only=True) for one in everywhere))
            if everywhere
            else 2
        )
        found += [
            one
            for number, one in enumerate(everywhere)
            if one not in [*found, *everywhere[:number]] and everywhere.count(one) >= most
        ]
    ahead = facing(steps) if skill.motion == "turn_to" else None
    return found if ahead is None else [*found, {skill.parameters[0].name: ahead}]


def facing(steps: Sequence[Step]) -> float | None:
    """Where a vehicle points after its steps, in degrees clockwise from north; None where that is
    not certain.
    """
    heading: float | None = None
    for skill, parameters in steps:
        if skill.motion in ("hold", "wait"):
            continue
        value = _value(skill, parameters)
        if skill.motion == "turn_to":
            heading = value
        else:
            heading = (
                (heading + value) % 360
                if skill.motion == "turn_by" and heading is not None and value is not None
                else None
            )
    return heading


def _value(skill: Skill, parameters: Mapping[str, Any]) -> Any:
    """The value that tells a use of a skill from another."""
    return next(
        (parameters[item.name] for item in _telling(skill) if item.name in parameters), None
    )


def _telling(skill: Skill) -> list[Parameter]:
    """The parameters of a skill, those first whose values tell its uses apart: two arcs share a
    radius sooner than an angle, two holds sooner than a time.
    """
    return sorted(skill.parameters, key=lambda item: item.unit not in ("deg", "s"))


class TurnValues(Narrowed):
    """The values of another strength, with this one value for the first parameter of a skill, as of
    one that turns the vehicle.
    """

    def __init__(self, values: Values, skill: Skill, value: float) -> None:
        super().__init__(values)
        self._skill, self._value = skill, value

    def parameter(
        self, grammar: Grammar, parameter: Parameter, owner: Task | Skill, context: Context
    ) -> list[tuple[str, Context]]:
        if owner == self._skill and parameter == self._skill.parameters[0]:
            return [(literal(written_number(self._value)), context)]
        return super().parameter(grammar, parameter, owner, context)

    def needs(self, parameter: Parameter, owner: Task | Skill) -> bool:
        return super().needs(parameter, owner) or (
            owner == self._skill and parameter == self._skill.parameters[0]
        )


class MovementValues(Narrowed):
    """The values of another strength, with these and no others for the parameters of a movement."""

    def __init__(self, values: Values, skill: Skill, told: Mapping[str, float]) -> None:
        super().__init__(values)
        self._skill, self._told = skill, told

    def parameter(
        self, grammar: Grammar, parameter: Parameter, owner: Task | Skill, context: Context
    ) -> list[tuple[str, Context]]:
        if owner != self._skill:
            return super().parameter(grammar, parameter, owner, context)
        return (
            [(literal(written_number(self._told[parameter.name])), context)]
            if parameter.name in self._told
            else []
        )

    def needs(self, parameter: Parameter, owner: Task | Skill) -> bool:
        return (
            parameter.name in self._told
            if owner == self._skill
            else super().needs(parameter, owner)
        )
