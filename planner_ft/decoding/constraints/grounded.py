"""The values that a command's facts allow: what nobody said cannot be written."""

from __future__ import annotations

import functools
import re
from collections.abc import Iterable, Sequence
from dataclasses import replace

from planner_ft.data.stated import rewritings
from planner_ft.decoding.constraints import patterns
from planner_ft.decoding.constraints.facts import read
from planner_ft.decoding.constraints.grammar import (
    IDENTIFIED,
    LONGEST_PROSE,
    MOST_TEXTS,
    Context,
    Grammar,
    Narrowed,
    Positions,
    SchemaValues,
    items,
    written,
    written_number,
)
from planner_ft.decoding.constraints.patterns import literal, regex
from planner_ft.decoding.constraints.reading.paths.written_out import places_off_home
from planner_ft.decoding.constraints.spans import Spans
from planner_ft.vocabulary import Parameter, Skill, Task, Vocabulary

LONGEST_NUMBER = 16
"""Digits of a number in a sentence: an identity at sea has nine."""
TOO_LONG = "The command is too long to hold texts to its words."


class GroundedValues(Narrowed):
    """The values of a mission plan that its command states. `texts` are what text values may be
    spans of beside the command.
    """

    def __init__(self, prompt: str, vocabulary: Vocabulary, texts: Sequence[str] = ()) -> None:
        super().__init__(SchemaValues())
        self._vocabulary = vocabulary
        reading = read(prompt, vocabulary)
        off_home = places_off_home(prompt, (float(vocabulary.home[0]), float(vocabulary.home[1])))
        self._reading = replace(reading, places=tuple(dict.fromkeys([*reading.places, *off_home])))
        self._spans = Spans([prompt, *texts])
        self._numbers: dict[Parameter, list[str] | None] = {}
        self.notes = [*self._reading.notes, *([TOO_LONG] if self._spans.too_long else [])]

    def parameter(
        self, grammar: Grammar, parameter: Parameter, owner: Task | Skill, context: Context
    ) -> list[tuple[str, Context]]:
        symbol: str | None
        if parameter.type in ("number", "integer"):
            symbol = self.number(grammar, parameter, ())
        elif parameter.type == "position":
            symbol = self.position(grammar, ())
        elif parameter.type in ("text", "id"):
            symbol = self.text(grammar, ())
        elif parameter.type == "texts":
            text = self.text(grammar, ())
            symbol = items(grammar, text, MOST_TEXTS) if text else None
        else:
            return super().parameter(grammar, parameter, owner, context)
        return (
            [(symbol, context | IDENTIFIED if parameter.type == "id" else context)]
            if symbol
            else []
        )

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
        return (
            super().has_number(parameter, value)
            if numbers is None
            else written_number(value) in numbers
        )

    def position(self, grammar: Grammar, without: Positions) -> str | None:
        reading = self._reading
        if reading.numbers_free:
            return super().position(grammar, without)
        places = [
            place
            for place in reading.places
            if tuple(place) not in {tuple(other) for other in without}
        ]
        if not reading.loose:
            return one_of(grammar, map(written, places))
        number = "|".join(
            dict.fromkeys(
                patterns.escaped(written_number(sign * value))
                for value in reading.loose
                for sign in (1, -1)
            )
        )
        barred = "".join(f" & ~{literal(written(place))}" for place in without)
        pair = grammar.terminal(regex(rf"\[({number}),({number})\]") + barred)
        listed = one_of(grammar, map(written, places))
        return grammar.rule(f"{pair} | {listed}") if listed else pair

    def text(self, grammar: Grammar, without: Sequence[str]) -> str | None:
        if self._spans.too_long:
            return super().text(grammar, without)
        return self._spans.terminal(grammar, without)

    def item(self, grammar: Grammar, without: Sequence[str]) -> str | None:
        if self._spans.too_long:
            return super().item(grammar, without)
        return self._spans.terminal(grammar, without, opened=True)

    def prose(self, grammar: Grammar) -> str:
        if self._reading.numbers_free:
            return super().prose(grammar)
        return grammar.terminal(self._prose)

    def _written_numbers(self, parameter: Parameter) -> list[str] | None:
        """What can be written as a parameter's number; None where anything can."""
        if parameter not in self._numbers:
            numbers = self._values_of(parameter)
            self._numbers[parameter] = (
                None if numbers is None else [written_number(number) for number in numbers]
            )
        return self._numbers[parameter]

    def _values_of(self, parameter: Parameter) -> list[float] | None:
        return self._reading.numbers(parameter)

    @functools.cached_property
    def _prose(self) -> str:
        """Sentences, with the numbers of the command and those of every value."""
        said = {
            digits
            for reading in rewritings(self._reading.text)
            for digits in re.findall(r"\d+(?:\.\d+)?", reading)
        }
        for task in self._vocabulary.tasks:
            for parameter in task.parameters:
                if parameter.type in ("number", "integer"):
                    said.update(
                        number.lstrip("-") for number in self._written_numbers(parameter) or ()
                    )
        said.update(written_number(abs(value)) for place in self._reading.places for value in place)
        return prose(number for number in said if len(number) <= LONGEST_NUMBER)


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
