"""The values that a task input's facts allow in its skill sequence: those of the prompt and of the
task's own parameters.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Collection, Sequence
from typing import Any

from planner_ft.data.quantities import quantities
from planner_ft.decoding.constraints.facts import (
    MOST_CROSSED,
    multiples,
    own_numbers,
    own_texts,
    sector_counts,
    turned,
    usable,
)
from planner_ft.decoding.constraints.grammar import (
    IDENTIFIED,
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
from planner_ft.decoding.constraints.grounded import GroundedValues, one_of
from planner_ft.decoding.constraints.reading.values.clearances import margins_only
from planner_ft.decoding.constraints.reading.values.told_values import read_told_values
from planner_ft.decoding.constraints.spans import Spans
from planner_ft.support.files import compact_json
from planner_ft.vocabulary import Parameter, Skill, Task, Vocabulary
from planner_ft.vocabulary.plans import STEP_KEYS

DIVIDED = re.compile(
    r"\b(?:sectors?|segments?|slices?|directions?|even\w*|equal\w*|each|every|apart|spread|round|around|full|whole|complete|circle|compass|points?|bearings|headings|"
    r"times|steps?|stops?|looks?|views?|pano\w*|shots?|stills|frames|turns?|parts)\b",
    re.IGNORECASE,
)
"""Words for a turn that is divided into parts."""
RECIPROCAL = re.compile(
    r"\breciprocal\b|\bopposite (?:heading|bearing|course|direction|way)\b|\bback bearing\b",
    re.IGNORECASE,
)


class GroundedTaskValues(GroundedValues):
    """The values of a skill sequence that its input states; of the skills `mentioned` in it some
    are told beyond doubt. Routes have the waypoints.
    """

    def __init__(
        self, record: dict[str, Any], vocabulary: Vocabulary, mentioned: Collection[str] = ()
    ) -> None:
        prompt = str(record.get("prompt", ""))
        super().__init__(prompt, vocabulary)
        self._told = read_told_values(self._reading, mentioned, vocabulary)
        self._own = list(own_numbers(record, vocabulary))
        own = {number for number, _unit in self._own}
        self._margins = sorted(value for value in margins_only(prompt) if value not in own)
        self._texts = list(own_texts(record))
        self._spans = Spans([prompt, *self._texts], named=True)
        self._reciprocal = RECIPROCAL.search(prompt) is not None
        self._multiples = multiples(prompt)
        self._divided = DIVIDED.search(prompt) is not None
        self._counts = sector_counts(
            [
                *(quantity.said for quantity in quantities(prompt)),
                *(number for number, _unit in self._own),
            ]
        )

    def parameter(
        self, grammar: Grammar, parameter: Parameter, owner: Task | Skill, context: Context
    ) -> list[tuple[str, Context]]:
        symbol = (
            one_of(grammar, sorted(self._told.values.get((owner.name, parameter.name), ())))
            if isinstance(owner, Skill)
            else None
        )
        if symbol:
            return [(symbol, context | IDENTIFIED)]
        if (
            isinstance(owner, Skill)
            and owner.role == "navigation"
            and parameter.name == "radius"
            and self._margins
        ):
            symbol = self.number(grammar, parameter, self._margins)
            return (
                [(symbol, context)]
                if symbol
                else super().parameter(grammar, parameter, owner, context)
            )
        if parameter.type == "polygon":
            position = self.position(grammar, ())
            return [(corners(grammar, position), context)] if position else []
        return super().parameter(grammar, parameter, owner, context)

    def needs(self, parameter: Parameter, owner: Task | Skill) -> bool:
        return super().needs(parameter, owner) or (
            isinstance(owner, Skill) and (owner.name, parameter.name) in self._told.needed
        )

    def number(
        self, grammar: Grammar, parameter: Parameter, without: Sequence[float]
    ) -> str | None:
        said = self._reading.numbers(parameter)
        if said is None:
            return super().number(grammar, parameter, without)
        facts = [
            *said,
            *(
                number
                for number, unit in self._own
                if None in (unit, parameter.unit) or unit == parameter.unit
            ),
        ]
        if parameter.unit in ("s", "m"):
            facts += [value * factor for factor in self._multiples for value in facts]
        if parameter.unit == "deg" and self._reciprocal:
            facts += [(value + 180) % 360 for value in facts]
        values = usable(
            [
                *facts,
                *(
                    turned(facts, self._counts if self._divided else ())
                    if parameter.unit == "deg"
                    else ()
                ),
            ],
            parameter,
        )
        return one_of(grammar, (written_number(value) for value in values if value not in without))

    def position(self, grammar: Grammar, without: Positions) -> str | None:
        reading = self._reading
        if reading.numbers_free or reading.loose:
            return super().position(grammar, without)
        places = [place for place in reading.places if place != self._vocabulary.unresolved]
        crossed = (
            itertools.product(*zip(*places, strict=True))
            if len(places) <= MOST_CROSSED
            else iter(places)
        )
        return one_of(
            grammar,
            (
                written(place)
                for place in crossed
                if tuple(place) not in {tuple(other) for other in without}
            ),
        )

    def step_texts(self, grammar: Grammar, key: str) -> str:
        # What a step reports is the vocabulary's own wording.
        field = {STEP_KEYS[3]: "stop", STEP_KEYS[4]: "failure", STEP_KEYS[5]: "output"}[key]
        known = sorted(
            {text for skill in self._vocabulary.skills if (text := getattr(skill, field))}
        )
        return (
            items(grammar, one_of(grammar, (compact_json(text) for text in known)), MOST_TEXTS)
            if known
            else super().step_texts(grammar, key)
        )


class FreeWaypoints(Narrowed):
    """The values of another strength, with any number for a coordinate of a destination: for inputs
    whose geometry cannot be read.
    """

    def number(
        self, grammar: Grammar, parameter: Parameter, without: Sequence[float]
    ) -> str | None:
        if parameter.unit == "m" and parameter.required:
            return SchemaValues().number(grammar, parameter, without)
        return super().number(grammar, parameter, without)
