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

from planner_ft.decoding.constraints import TOO_LONG, UNPAIRED, patterns
from planner_ft.decoding.constraints import grammar as lark
from planner_ft.decoding.constraints.grammar import Context, Grammar, Options, Positions, Values
from planner_ft.decoding.constraints.patterns import regex
from planner_ft.decoding.constraints.spans import Spans
from planner_ft.facts import read_input
from planner_ft.support.files import compact_json
from planner_ft.vocabulary import Parameter, Vocabulary
from planner_ft.vocabulary.plans import STEP_KEYS, Level

LONGEST_NUMBER = 16
"""Digits of a number in a sentence: an identity at sea has nine."""
MOST_OFFSETS, MOST_CROSSED = 2000, 8
LARGEST = 10**patterns.WHOLE_DIGITS
REPORTS = dict(zip(STEP_KEYS[3:], ("stop", "failure", "output"), strict=True))
"""Fields of a skill with the wording of a step's reports."""


class GroundedValues(Values):
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
        self._vocabulary, self._level = vocabulary, level
        known = record if level == "task" else {"prompt": record.get("prompt")}
        self._source = source = read_input(known, vocabulary)
        self._facts = facts = source.facts
        self._spans = Spans([facts.text, *source.texts])
        coordinates = [item for skill in vocabulary.skills for item in skill.coordinates]
        self._numbers: dict[Parameter, list[str] | None] = (
            dict.fromkeys(coordinates) if free_waypoints else {}
        )
        stated = [(round(place.x, 2), round(place.y, 2)) for place in facts.positions]
        stated = [place for place in stated if max(map(abs, place)) < LARGEST]
        self._places = list(dict.fromkeys([vocabulary.home, vocabulary.unresolved, *stated]))
        if level == "mission" and source.ground:
            away = source.ground.away((vocabulary.home, *stated))
            self._places += itertools.islice(away, MOST_OFFSETS)
        too_long = [TOO_LONG] if self._spans.too_long else []
        self.notes = [*facts.unread, *([UNPAIRED] if facts.loose else []), *too_long]

    def parameter(self, grammar: Grammar, parameter: Parameter, context: Context) -> Options:
        found = super().parameter(grammar, parameter, context)
        # Without evidence of its kind, a value that must be written is the model's.
        return found or (Values().parameter(grammar, parameter, context) * parameter.required)

    def number(
        self, grammar: Grammar, parameter: Parameter, without: Sequence[float] = ()
    ) -> str | None:
        numbers = self._written_numbers(parameter)
        if numbers is None:
            return super().number(grammar, parameter, without)
        barred = {lark.written_number(number) for number in without}
        return lark.one_of(grammar, (number for number in numbers if number not in barred))

    def has_number(self, parameter: Parameter, value: float) -> bool:
        numbers = self._written_numbers(parameter)
        if numbers is None:
            return super().has_number(parameter, value)
        return lark.written_number(value) in numbers

    def position(self, grammar: Grammar, without: Positions = ()) -> str | None:
        barred = {tuple(other) for other in without}
        if self._facts.unread or self._facts.loose:
            return super().position(grammar, without)
        places: Iterable[tuple[float, ...]] = self._places
        if self._level == "task":
            known = [place for place in self._places if place != self._vocabulary.unresolved]
            # "The box from (0, 0) to (40, 20)" has the corners in between.
            crossed = len(known) <= MOST_CROSSED
            places = itertools.product(*zip(*known, strict=True)) if crossed else known
        allowed = (place for place in places if tuple(place) not in barred)
        return lark.one_of(grammar, map(lark.written, allowed))

    def text(self, grammar: Grammar, without: Sequence[str] = ()) -> str | None:
        if self._spans.too_long:
            return super().text(grammar, without)
        return self._spans.terminal(grammar, without)

    def identity(self, grammar: Grammar) -> str | None:
        return self.text(grammar)

    def prose(self, grammar: Grammar) -> str:
        if self._facts.unread or self._facts.loose:
            return super().prose(grammar)
        return grammar.terminal(self._prose)

    def step_texts(self, grammar: Grammar, key: str) -> str:
        # Reports of a step are the vocabulary's own wording.
        known = {getattr(skill, REPORTS[key]) for skill in self._vocabulary.skills} - {None}
        if not known:
            return super().step_texts(grammar, key)
        reports = lark.one_of(grammar, map(compact_json, sorted(known)))
        return lark.items(grammar, reports, lark.MOST_TEXTS)

    def _written_numbers(self, parameter: Parameter) -> list[str] | None:
        """Texts of a parameter's number, smallest first; None where any number can be meant."""
        if parameter not in self._numbers and self._facts.unread:
            self._numbers[parameter] = None
        elif parameter not in self._numbers:
            low, high, whole = parameter.minimum, parameter.maximum, parameter.type == "integer"
            values = (one for one in self._source.values(parameter) if abs(one) < LARGEST)
            found = sorted({round(value, digits) for value in values for digits in (2, 4)})
            within = (one for one in found if low is None or high is None or low <= one <= high)
            usable = (one for one in within if not whole or one == int(one))
            self._numbers[parameter] = list(map(lark.written_number, usable))
        return self._numbers[parameter]

    @functools.cached_property
    def _prose(self) -> str:
        """Sentences, with the numbers of the command and those of every value."""
        known = set(re.findall(r"\d+(?:\.\d+)?", self._facts.text))
        numbers = [item for task in self._vocabulary.tasks for item in task.parameters]
        for parameter in numbers:
            if parameter.type in ("number", "integer"):
                known |= {text.lstrip("-") for text in self._written_numbers(parameter) or ()}
                said = (abs(number.said) for number in self._facts.numbers(parameter.unit))
                known |= {lark.written_number(value) for value in said}
        known |= {lark.written_number(abs(value)) for place in self._places for value in place}
        return prose(number for number in known if len(number) <= LONGEST_NUMBER)


def prose(numbers: Iterable[str]) -> str:
    """A JSON string as sentences have it, with no other numbers than these."""
    other = r'([^"\\0-9\x00-\x1f\x7f]|\\["\\bfnrt])'
    known = "|".join(sorted(patterns.escaped(number) for number in numbers))
    number = f"({known})?" if known else ""
    return regex(f'"({number}{other}){{0,{lark.LONGEST_PROSE}}}{number}"')
