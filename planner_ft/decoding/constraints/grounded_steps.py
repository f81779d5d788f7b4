"""The values that a task's prompt and parameters allow in its skill sequence."""

from __future__ import annotations

import functools
import itertools
from collections.abc import Iterator
from typing import Any

from planner_ft.data.quantities import quantities
from planner_ft.data.stated import rewritings, stated_numbers
from planner_ft.decoding.constraints import patterns
from planner_ft.decoding.constraints.facts import usable
from planner_ft.decoding.constraints.grammar import MOST_TEXTS, Grammar, Positions, items, written, written_number
from planner_ft.decoding.constraints.grounded import GroundedValues, one_of
from planner_ft.decoding.constraints.patterns import literal, regex
from planner_ft.decoding.constraints.state import coordinates
from planner_ft.vocabulary import Parameter, Skill, Vocabulary

TURNING = ("turn_to", "turn_by", "arc")
MOST_STEPS_OF_A_TURN = 72
MOST_POINTS, MOST_LENGTHS = 24, 12
"""Positions and lengths that the corners of a boundary are made of."""


class GroundedSteps(GroundedValues):
    """Values that the prompt of a task states, that its parameters hold, or that follow from them.

    Waypoints follow by geometry, so that they are bounded numbers where the task has a length, and the coordinates of
    its positions where it has none. A turn in steps is divided; corners of a boundary lie at, or off, stated positions.
    """

    def __init__(self, record: dict[str, Any], vocabulary: Vocabulary) -> None:
        task, given = vocabulary.task.get(str(record.get("task"))), record.get("parameters")
        self._given: dict[str, Any] = given if isinstance(given, dict) else {}
        self._units = {name: parameter.unit for name, parameter in task.by_name.items()} if task else {}
        texts = [text for value in self._given.values() for text in (value if isinstance(value, list) else [value]) if isinstance(text, str)]
        super().__init__(str(record.get("prompt", "")), vocabulary, texts)
        self._axis = {parameter: axis for skill in vocabulary.skills for axis, parameter in enumerate(coordinates(skill))}
        self._turning = {item: skill for skill in vocabulary.skills if skill.motion in TURNING for item in skill.parameters if item.unit == "deg"}

    def position(self, grammar: Grammar, without: Positions) -> str | None:
        if self._reading.numbers_free:
            return super().position(grammar, without)
        x, y = ("|".join(patterns.escaped(written_number(value)) for value in self._corners(axis)) for axis in (0, 1))
        barred = "".join(f" & ~{literal(written(place))}" for place in without)
        return grammar.terminal(regex(rf"\[({x}),({y})\]") + barred)

    def step_texts(self, grammar: Grammar, key: str) -> str:
        names = {"stop_conditions": "stop", "failure_modes": "failure", "expected_outputs": "output"}
        known = [getattr(skill, names[key]) for skill in self._vocabulary.skills if key in names]
        texts = [f'"{patterns.quoted(text)}"' for text in known if text]
        return items(grammar, one_of(grammar, texts), MOST_TEXTS) if texts else super().step_texts(grammar, key)

    def _values_of(self, parameter: Parameter) -> list[float] | None:
        if self._reading.numbers_free:
            return None
        if parameter in self._axis:
            return None if self._lengths else usable(self._coordinates(self._axis[parameter]), parameter)
        found = {*stated_numbers(self._reading.bare, parameter.unit), *self._given_numbers(parameter.unit)}
        if parameter in self._turning:
            found.update(self._turns(self._turning[parameter]))
        if parameter.minimum is None or parameter.minimum < 0:
            found.update([-value for value in found])
        return usable(found, parameter)

    def _given_numbers(self, unit: str | None) -> Iterator[float]:
        """Numbers of the task's parameters in a unit."""
        for name, value in self._given.items():
            if _is_number(value) and self._units.get(name) in (unit, None):
                yield value

    @functools.cached_property
    def _lengths(self) -> list[float]:
        """Lengths that waypoints can follow from: those of the prompt, numbers without a unit included, and of the parameters."""
        return [value for value in dict.fromkeys([*stated_numbers(self._reading.bare, "m"), *self._given_numbers("m")]) if value]

    @functools.cached_property
    def _points(self) -> list[tuple[float, float]]:
        """Positions of the prompt and of the task's parameters."""
        given = [(value[0], value[1]) for value in self._given.values() if isinstance(value, list) and len(value) == 2 and all(map(_is_number, value))]
        return list(dict.fromkeys([*given, *self._reading.places]))

    def _coordinates(self, axis: int) -> list[float]:
        loose = [sign * value for value in self._reading.loose for sign in (1, -1)]
        return [*(point[axis] for point in self._points), *loose]

    def _corners(self, axis: int) -> list[float]:
        """Coordinates that a corner can have: those of the positions, and off them by a length or half of one."""
        found = self._coordinates(axis)
        for point, length in itertools.product(self._points[:MOST_POINTS], self._lengths[:MOST_LENGTHS]):
            found += [point[axis] + sign * part * length for part in (1, 0.5) for sign in (1, -1)]
        return list(dict.fromkeys(round(value, 2) for value in found))

    def _turns(self, skill: Skill) -> Iterator[float]:
        """Angles of a turn in equal steps, and the headings at them."""
        said = stated_numbers(self._reading.bare, "deg")
        angles = {360.0, *(value for value in said if value)}
        counts = {int(value) for value in self._counts() if 2 <= value <= MOST_STEPS_OF_A_TURN and value == int(value)}
        for angle, count in itertools.product(angles, counts):
            if skill.motion == "turn_to":
                yield from (start + step * angle / count - turn for start in {0.0, *said} for step in range(count + 1) for turn in (0, 360))
            else:
                yield angle / count

    def _counts(self) -> Iterator[float]:
        yield from (quantity.value for reading in rewritings(self._reading.text) for quantity in quantities(reading) if quantity.unit is None)
        yield from (value for value in self._given.values() if _is_number(value))


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)
