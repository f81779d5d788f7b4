"""The values that the facts of an input allow: what nobody said cannot be written.

A number stands in the text, in its unit or another, or follows from what stands there; a place is
stated, or a stated length and bearing away from one that is; a text is a span. A task input's own
parameters are facts like those of its prompt.
"""

from __future__ import annotations

import functools
import itertools
import re
from collections.abc import Iterable, Sequence
from typing import Any

from planner_ft.data.quantities import bearings, quantities
from planner_ft.data.stated import rewritings, stated_numbers
from planner_ft.data.task import geometry as g
from planner_ft.decoding.constraints import patterns
from planner_ft.decoding.constraints.facts import (
    MOST_CROSSED,
    multiples,
    own_numbers,
    own_texts,
    read,
    sector_counts,
    turned,
    usable,
)
from planner_ft.decoding.constraints.grammar import (
    IDENTIFIED,
    LONGEST_PROSE,
    MOST_TEXTS,
    Context,
    Grammar,
    Narrowed,
    Positions,
    SchemaValues,
    corners,
    items,
    written,
    written_number,
)
from planner_ft.decoding.constraints.patterns import literal, regex
from planner_ft.decoding.constraints.spans import Spans
from planner_ft.support.files import compact_json
from planner_ft.vocabulary import Parameter, Skill, Task, Vocabulary
from planner_ft.vocabulary.plans import STEP_KEYS, Level

LONGEST_NUMBER = 16
"""Digits of a number in a sentence: an identity at sea has nine."""
MOST_OFFSETS = 2000
TOO_LONG = "The command is too long to hold texts to its words."


class GroundedValues(Narrowed):
    """The values of a plan that its input states or gives by arithmetic. With `free_waypoints`, a
    coordinate of a destination can be any number.
    """

    def __init__(
        self,
        level: Level,
        record: dict[str, Any],
        vocabulary: Vocabulary,
        *,
        free_waypoints: bool = False,
    ) -> None:
        super().__init__(SchemaValues())
        prompt, self._vocabulary, self._level = str(record.get("prompt", "")), vocabulary, level
        self._facts = facts = read(prompt, vocabulary)
        self._own = list(own_numbers(record, vocabulary)) if level == "task" else []
        texts = list(own_texts(record)) if level == "task" else []
        self._spans = Spans([prompt, *texts], named=level == "task")
        self._multiples = multiples(prompt)
        coordinates = [item for skill in vocabulary.skills for item in skill.coordinates]
        self._numbers: dict[Parameter, list[str] | None] = (
            dict.fromkeys(coordinates) if free_waypoints else {}
        )
        self._places = list(facts.places)
        if level == "mission":
            away = itertools.product(
                [place for place in facts.places if place != vocabulary.unresolved],
                sorted(bearings(prompt)),
                sorted(stated_numbers(facts.bare, "m")),
            )
            self._places += [g.offset(*one) for one in itertools.islice(away, MOST_OFFSETS)]
        self.notes = [*facts.notes, *([TOO_LONG] if self._spans.too_long else [])]

    def parameter(
        self, grammar: Grammar, parameter: Parameter, owner: Task | Skill, context: Context
    ) -> list[tuple[str, Context]]:
        symbol: str | None
        if parameter.type in ("number", "integer"):
            symbol = self.number(grammar, parameter, ())
        elif parameter.type == "position":
            symbol = self.position(grammar, ())
        elif parameter.type == "polygon":
            corner = self.position(grammar, ())
            symbol = corners(grammar, corner) if corner else None
        else:
            symbol = self.text(grammar, ())
            if parameter.type == "texts" and symbol:
                symbol = items(grammar, symbol, MOST_TEXTS)
        if symbol:
            return [(symbol, context | IDENTIFIED if parameter.type == "id" else context)]
        # Without evidence of its kind, a value that must be written is the model's.
        return super().parameter(grammar, parameter, owner, context) if parameter.required else []

    def number(
        self, grammar: Grammar, parameter: Parameter, without: Sequence[float]
    ) -> str | None:
        numbers = self._written_numbers(parameter)
        if numbers is None:
            return super().number(grammar, parameter, without)
        barred = {written_number(number) for number in without}
        return one_of(grammar, (number for number in numbers if number not in barred))

    def has_number(self, parameter: Parameter, value: float) -> bool:
        numbers = self._written_numbers(parameter)
        if numbers is None:
            return super().has_number(parameter, value)
        return written_number(value) in numbers

    def position(self, grammar: Grammar, without: Positions) -> str | None:
        facts, barred = self._facts, {tuple(other) for other in without}
        if facts.numbers_free or facts.loose:
            return super().position(grammar, without)
        places: Iterable[tuple[float, ...]] = self._places
        if self._level == "task":
            known = [place for place in facts.places if place != self._vocabulary.unresolved]
            # "The box from (0, 0) to (40, 20)" has the corners in between.
            crossed = len(known) <= MOST_CROSSED
            places = itertools.product(*zip(*known, strict=True)) if crossed else known
        return one_of(grammar, (written(place) for place in places if tuple(place) not in barred))

    def text(self, grammar: Grammar, without: Sequence[str]) -> str | None:
        if self._spans.too_long:
            return super().text(grammar, without)
        return self._spans.terminal(grammar, without)

    def prose(self, grammar: Grammar) -> str:
        if self._facts.numbers_free or self._facts.loose:
            return super().prose(grammar)
        return grammar.terminal(self._prose)

    def step_texts(self, grammar: Grammar, key: str) -> str:
        # Reports of a step are the vocabulary's own wording.
        field = {STEP_KEYS[3]: "stop", STEP_KEYS[4]: "failure", STEP_KEYS[5]: "output"}[key]
        known = {getattr(skill, field) for skill in self._vocabulary.skills} - {None}
        if not known:
            return super().step_texts(grammar, key)
        return items(grammar, one_of(grammar, map(compact_json, sorted(known))), MOST_TEXTS)

    def _written_numbers(self, parameter: Parameter) -> list[str] | None:
        """Texts of a parameter's number; None where any number can be meant."""
        if parameter not in self._numbers:
            values = self._values_of(parameter)
            self._numbers[parameter] = (
                None if values is None else [written_number(value) for value in values]
            )
        return self._numbers[parameter]

    def _values_of(self, parameter: Parameter) -> list[float] | None:
        stated = self._facts.said(parameter.unit)
        if stated is None:
            return None
        facts = [*stated]
        units = (None, parameter.unit)
        facts += [number for number, unit in self._own if unit in units or parameter.unit is None]
        if parameter.unit in ("s", "m"):
            facts += [value * factor for factor in self._multiples for value in facts]
        if parameter.unit == "deg" and self._level == "task":
            facts += [(value + 180) % 360 for value in facts]
            facts += turned(facts, self._counts)
        return usable(facts, parameter)

    @functools.cached_property
    def _counts(self) -> frozenset[int]:
        said = (quantity.said for quantity in quantities(self._facts.text))
        return sector_counts([*said, *(number for number, _unit in self._own)])

    @functools.cached_property
    def _prose(self) -> str:
        """Sentences, with the numbers of the command and those of every value."""
        known = {
            digits
            for reading in rewritings(self._facts.text)
            for digits in re.findall(r"\d+(?:\.\d+)?", reading)
        }
        for task in self._vocabulary.tasks:
            for parameter in task.parameters:
                if parameter.type in ("number", "integer"):
                    numbers = self._written_numbers(parameter) or ()
                    known.update(number.lstrip("-") for number in numbers)
        known.update(written_number(abs(value)) for place in self._places for value in place)
        return prose(number for number in known if len(number) <= LONGEST_NUMBER)


def one_of(grammar: Grammar, texts: Iterable[str]) -> str | None:
    """The terminal that matches one of the texts; None where there is none."""
    options = list(dict.fromkeys(texts))
    return grammar.terminal(" | ".join(map(literal, options))) if options else None


def prose(numbers: Iterable[str]) -> str:
    """A JSON string as sentences have it, with no other numbers than these."""
    other = r'([^"\\0-9\x00-\x1f\x7f]|\\["\\bfnrt])'
    known = "|".join(sorted(patterns.escaped(number) for number in numbers))
    return regex(
        f'"(({known})?{other}){{0,{LONGEST_PROSE}}}({known})?"'
        if known
        else f'"{other}{{0,{LONGEST_PROSE}}}"'
    )
