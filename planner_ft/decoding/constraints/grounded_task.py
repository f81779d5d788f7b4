"""The values that a task input's facts allow in its skill sequence: those of the prompt and of the task's own parameters."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Sequence
from typing import Any

from planner_ft.data.quantities import quantities
from planner_ft.decoding.constraints.facts import number_words, usable
from planner_ft.decoding.constraints.grammar import MOST_TEXTS, Grammar, Narrowed, Positions, SchemaValues, items, written, written_number
from planner_ft.decoding.constraints.grounded import GroundedValues, one_of
from planner_ft.decoding.constraints.spans import Spans
from planner_ft.support.files import compact_json
from planner_ft.vocabulary import Parameter, Vocabulary
from planner_ft.vocabulary.plans import STEP_KEYS

MOST_SECTORS = 36
MOST_CROSSED = 8
"""Stated places whose coordinates are crossed into corners: "the box from (0, 0) to (40, 20)"."""


class GroundedTaskValues(GroundedValues):
    """The values of a skill sequence that its input states. Waypoints are left to routes."""

    def __init__(self, record: dict[str, Any], vocabulary: Vocabulary) -> None:
        prompt = str(record.get("prompt", ""))
        super().__init__(prompt, vocabulary)
        given = record.get("parameters")
        self._own = list(number_words(record))
        self._texts = list(_texts(given if isinstance(given, dict) else {}))
        self._spans = Spans([prompt, *self._texts])
        self._counts = {int(quantity.said) for quantity in quantities(prompt) if quantity.said in range(2, MOST_SECTORS + 1)}
        self._counts |= {int(value) for value in self._own if value in range(2, MOST_SECTORS + 1)}

    def number(self, grammar: Grammar, parameter: Parameter, without: Sequence[float]) -> str | None:
        said = self._reading.numbers(parameter)
        if said is None:
            return super().number(grammar, parameter, without)
        values = usable([*said, *self._own, *self._turned(parameter, [*said, *self._own])], parameter)
        return one_of(grammar, (written_number(value) for value in values if value not in without))

    def _turned(self, parameter: Parameter, said: list[float]) -> Iterator[float]:
        """Angles that follow from stated ones: turns to port, headings evenly round the compass."""
        if parameter.unit != "deg":
            return
        steps = [360 / count for count in sorted(self._counts)]
        yield from steps
        for value in (*said, *steps):
            yield -value
        starts = {0.0, *(value % 360 for value in said)} if len(said) <= MOST_CROSSED else {0.0}
        for start, step in itertools.product(starts, steps):
            yield from ((start + number * step) % 360 for number in range(round(360 / step)))

    def position(self, grammar: Grammar, without: Positions) -> str | None:
        reading = self._reading
        if reading.numbers_free or reading.loose:
            return super().position(grammar, without)
        places = [place for place in reading.places if place != self._vocabulary.unresolved]
        crossed = itertools.product(*zip(*places, strict=True)) if len(places) <= MOST_CROSSED else iter(places)
        return one_of(grammar, (written(place) for place in crossed if tuple(place) not in {tuple(other) for other in without}))

    def step_texts(self, grammar: Grammar, key: str) -> str:
        # What a step reports is the vocabulary's own wording.
        field = {STEP_KEYS[3]: "stop", STEP_KEYS[4]: "failure", STEP_KEYS[5]: "output"}[key]
        known = sorted({text for skill in self._vocabulary.skills if (text := getattr(skill, field))})
        return items(grammar, one_of(grammar, (compact_json(text) for text in known)), MOST_TEXTS) if known else super().step_texts(grammar, key)


class FreeWaypoints(Narrowed):
    """The values of another strength, with any number for a coordinate of a destination: for inputs whose geometry cannot be read."""

    def number(self, grammar: Grammar, parameter: Parameter, without: Sequence[float]) -> str | None:
        if parameter.unit == "m" and parameter.required:
            return SchemaValues().number(grammar, parameter, without)
        return super().number(grammar, parameter, without)


def _texts(parameters: dict[str, Any]) -> Iterator[str]:
    """Every text among a task's parameters."""
    for value in parameters.values():
        for item in value if isinstance(value, list) else [value]:
            if isinstance(item, str):
                yield item
