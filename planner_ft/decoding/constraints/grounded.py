"""The values that the facts of an input allow: what nobody said cannot be written.

A number stands in the text, in its unit or another, or follows from what stands there; a place is
stated, or a stated length and bearing away from one that is; a text is a span. A task input's own
parameters are facts like those of its prompt.
"""

from __future__ import annotations

import functools
import itertools
import re
from collections.abc import Iterable, Iterator, Sequence
from typing import Any

from planner_ft.decoding.constraints import TOO_LONG, UNPAIRED, patterns
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
from planner_ft.facts import is_number, read_input
from planner_ft.facts.derived import sector_counts, turned
from planner_ft.facts.geometry import offset
from planner_ft.facts.lists import MULTIPLES
from planner_ft.facts.words import words
from planner_ft.support.files import compact_json
from planner_ft.vocabulary import Parameter, Skill, Task, Vocabulary
from planner_ft.vocabulary.plans import STEP_KEYS, Level

LONGEST_NUMBER = 16
"""Digits of a number in a sentence: an identity at sea has nine."""
MOST_OFFSETS, MOST_CROSSED = 2000, 8
LARGEST = 10**patterns.WHOLE_DIGITS


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
        self._vocabulary, self._level = vocabulary, level
        source = read_input(record, vocabulary)
        self._facts = facts = source.facts
        self._own = list(_own_values(source.parameters)) if level == "task" else []
        own_texts = [value for value, _name in self._own if isinstance(value, str)]
        self._units = {
            item.name: item.unit for item in (source.task.parameters if source.task else ())
        }
        self._spans = Spans([facts.text, *own_texts])
        said = set(words(facts.text))
        self._multiples = {factor for word, factor in MULTIPLES.items() if word in said}
        coordinates = [item for skill in vocabulary.skills for item in skill.coordinates]
        self._numbers: dict[Parameter, list[str] | None] = (
            dict.fromkeys(coordinates) if free_waypoints else {}
        )
        stated = [(round(place.x, 2), round(place.y, 2)) for place in facts.positions]
        stated = [place for place in stated if max(map(abs, place)) < LARGEST]
        self._places = list(dict.fromkeys([vocabulary.home, vocabulary.unresolved, *stated]))
        if level == "mission" and source.ground:
            ways = (self._places[:1] + stated, source.ground.bearings, source.ground.lengths)
            away = itertools.islice(itertools.product(*ways), MOST_OFFSETS)
            self._places += [offset(*one) for one in away]
        too_long = [TOO_LONG] if self._spans.too_long else []
        loose = [UNPAIRED] if facts.loose else []
        self.notes = [*facts.unread, *loose, *too_long]

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
        barred = {tuple(other) for other in without}
        if self._facts.unread or self._facts.loose:
            return super().position(grammar, without)
        places: Iterable[tuple[float, ...]] = self._places
        if self._level == "task":
            known = [place for place in self._places if place != self._vocabulary.unresolved]
            # "The box from (0, 0) to (40, 20)" has the corners in between.
            crossed = len(known) <= MOST_CROSSED
            places = itertools.product(*zip(*known, strict=True)) if crossed else known
        return one_of(grammar, (written(place) for place in places if tuple(place) not in barred))

    def text(self, grammar: Grammar, without: Sequence[str]) -> str | None:
        if self._spans.too_long:
            return super().text(grammar, without)
        return self._spans.terminal(grammar, without)

    def prose(self, grammar: Grammar) -> str:
        if self._facts.unread or self._facts.loose:
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
        unit = parameter.unit
        if self._facts.unread:
            return None
        values = [number.value for number in self._facts.numbers(unit)]
        for value, name in self._own:
            known = self._units.get(name)
            if is_number(value) and (known is None or unit in (None, known)):
                values.append(value)
        if unit in ("s", "m"):
            values += [value * factor for factor in self._multiples for value in values]
        if unit == "deg":
            values += [angle.value for angle in (*self._facts.bearings, *self._facts.turns)]
            values += list(turned(values, self._counts)) if self._level == "task" else []
        return _usable(values, parameter)

    @functools.cached_property
    def _counts(self) -> frozenset[int]:
        own = [value for value, _name in self._own if is_number(value)]
        return sector_counts([*self._facts.counts, *own])

    @functools.cached_property
    def _prose(self) -> str:
        """Sentences, with the numbers of the command and those of every value."""
        known = set(re.findall(r"\d+(?:\.\d+)?", self._facts.text))
        numbers = [item for task in self._vocabulary.tasks for item in task.parameters]
        for parameter in numbers:
            if parameter.type in ("number", "integer"):
                known |= {text.lstrip("-") for text in self._written_numbers(parameter) or ()}
                said = (abs(number.said) for number in self._facts.numbers(parameter.unit))
                known |= {written_number(value) for value in said}
        known |= {written_number(abs(value)) for place in self._places for value in place}
        return prose(number for number in known if len(number) <= LONGEST_NUMBER)


def _own_values(parameters: dict[str, Any]) -> Iterator[tuple[Any, str]]:
    """Every value of a task's parameters, those of lists one by one, with the parameter's name."""
    for name, value in parameters.items():
        for item in value if isinstance(value, list) else [value]:
            yield item, name


def _usable(values: Iterable[float], parameter: Parameter) -> list[float]:
    """The values that a parameter can have, as they are written, smallest first."""
    low, high = parameter.minimum, parameter.maximum
    found = {round(value, digits) for value in values if abs(value) < LARGEST for digits in (2, 4)}
    within = (value for value in found if low is None or high is None or low <= value <= high)
    return sorted(value for value in within if parameter.type != "integer" or value == int(value))


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
