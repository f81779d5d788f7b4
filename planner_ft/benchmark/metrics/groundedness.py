"""Groundedness: values that somebody gave.

A value is grounded when the command states it (at task level the task prompt or the task's
parameters), in any unit and wording, when the vocabulary gives it (home, the unresolved location),
or when it follows from what is stated by arithmetic (points a stated way off; at task level
waypoints of a grid, a square or a ring, angles of equal turns). It need not be the right value: a
value in the wrong place is grounded, too.

Values are judged by `planner_ft.facts`, which the decoding strength `grounded` holds answers to as
well. Decoder and metric share the reader, so that the groundedness of `+grounded` configurations
is 100 % by construction; tables of this metric compare the other strengths.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from planner_ft.benchmark.metrics.entries import Entry
from planner_ft.benchmark.metrics.values import known_parameters
from planner_ft.facts import SCORING, WAYPOINT, Input, is_number, is_place
from planner_ft.vocabulary import Parameter, Vocabulary
from planner_ft.vocabulary.plans import Level


@dataclass(frozen=True)
class Given:
    """A value of an entry (its index) with the parameter that it is for."""

    entry: int
    parameter: Parameter
    value: Any


@dataclass(frozen=True)
class Groundedness:
    """Values of an answer that could be judged, and those of them that nobody gave."""

    judged: int
    ungrounded: tuple[Given, ...]


def groundedness(
    level: Level, entries: Sequence[Entry], source: Input, vocabulary: Vocabulary
) -> Groundedness:
    """Judge every value of a plan's entries; what cannot be judged, since the input cannot be read
    with certainty, is left out.
    """
    verdicts, before = [], list[tuple[float, float]]()
    for given in given_values(level, entries, vocabulary):
        evidence = source.evidence(given.value, given.parameter, SCORING, before)
        verdicts.append((given, evidence.given))
        if given.parameter is WAYPOINT:
            before.append((given.value[0], given.value[1]))
    return Groundedness(
        sum(verdict is not None for _given, verdict in verdicts),
        tuple(given for given, verdict in verdicts if verdict is False),
    )


def given_values(level: Level, entries: Sequence[Entry], vocabulary: Vocabulary) -> Iterator[Given]:
    """Every value of a plan. The coordinates of a destination are one; a parameter that the
    vocabulary does not have is judged by its form.
    """
    for index, entry in enumerate(entries):
        skill = vocabulary.skill.get(entry.name) if level == "task" else None
        pair = [item.name for item in skill.coordinates] if skill else []
        together = len(pair) == 2 and all(is_number(entry.parameters.get(name)) for name in pair)
        if together:
            yield Given(index, WAYPOINT, [entry.parameters[name] for name in pair])
        known = known_parameters(level, entry.name, vocabulary)
        for name, value in entry.parameters.items():
            if not (together and name in pair):
                yield Given(index, known.get(name) or by_form(name, value), value)


def by_form(name: str, value: Any) -> Parameter:
    """A parameter of the type that a value has."""
    if is_number(value):
        return Parameter(name, "number")
    if isinstance(value, list):
        return Parameter(name, "position" if is_place(value) else "texts")
    return Parameter(name, "text")
