"""What the input of an answer gives: the facts of a command, or of a task prompt with the task's
parameters.

The reading is that of the decoding strength `grounded` (planner_ft.decoding.constraints), so that
an answer that was held to the command's facts is grounded by construction. Where a text cannot be
read with certainty, nothing is said about a value (None).
"""

from __future__ import annotations

import functools
import itertools
import json
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Any

from planner_ft.benchmark.metrics.values import is_number, normalised, positions_agree, tolerance
from planner_ft.data.quantities import bearings, close, positions, quantities
from planner_ft.data.stated import stated_positions
from planner_ft.data.words import says
from planner_ft.decoding.constraints.facts import (
    MEASURES,
    Reading,
    own_numbers,
    own_texts,
    read,
    sector_counts,
    turned,
    without_counts,
    without_pairs,
)
from planner_ft.decoding.constraints.waypoints import Waypoints, read_waypoints
from planner_ft.vocabulary import Parameter, Vocabulary
from planner_ft.vocabulary.plans import Level

WAYPOINT = Parameter("x, y", "position", "m")
"""The two coordinates of a destination, judged together."""

Place = tuple[float, float]


@dataclass(frozen=True, eq=False)
class Source:
    """The facts that an answer can draw on. `record` is a task input, and `own_numbers`,
    `own_places` and `own_texts` are those of its parameters; None for a command.

    The plainest reading is asked first: most values of most answers are there, and only a value
    that is not makes the others worth their time.
    """

    text: str
    vocabulary: Vocabulary
    record: dict[str, Any] | None = None
    own_numbers: tuple[float, ...] = ()
    own_places: tuple[Place, ...] = ()
    own_texts: tuple[str, ...] = ()

    def states(self, value: Any, parameter: Parameter) -> bool | None:
        """Whether the input says the value itself; None where its numbers cannot be read with
        certainty.

        Numbers may differ by what scoring allows (2 %), texts may have their spelling put right.
        """
        kind = parameter.type
        if kind in ("number", "integer"):
            return self._states_number(value, parameter.unit) if is_number(value) else False
        if kind == "position":
            return self._states_place(value)
        if kind == "polygon":
            return (
                _all(self._states_place(corner) for corner in value)
                if isinstance(value, list)
                else False
            )
        if isinstance(value, list):
            return all(self._says(str(text)) for text in value)
        return self._says(str(value))

    def gives(self, value: Any, parameter: Parameter) -> bool | None:
        """Whether the input or the vocabulary gives the value: stated, home, the unresolved
        location, or derived from what is stated.
        """
        if parameter is WAYPOINT:
            return self._leads_to(value)
        if parameter.type == "position" and self._is_named(value):
            return True
        if parameter.type == "polygon" and isinstance(value, list):
            return _all(self._is_corner(corner) for corner in value)
        verdict = self.states(value, parameter)
        if (
            verdict is False
            and self.record is not None
            and parameter.unit == "deg"
            and is_number(value)
        ):
            return self._follows(value)
        return verdict

    def _says(self, text: str) -> bool:
        if normalised(text) in map(normalised, self.own_texts):
            return True
        return not says("\n".join((self.text, *self.own_texts)), text, misspelt=True)

    def _states_number(self, value: float, unit: str | None) -> bool | None:
        if any(_near(value, number) for number in (*self.own_numbers, *self._plain(unit))):
            return True
        said = self.reading.said(unit)
        if any(_near(value, number) for number in said or ()):
            return True
        return None if said is None else unit == "deg" and value % 360 in bearings(self.text)

    def _states_place(self, value: Any) -> bool | None:
        if not _is_place(value):
            return False
        plain = ((x, y) for x, y, _start, _end in positions(self.text))
        if any(
            positions_agree(value, place, self.vocabulary)
            for place in itertools.chain(self.own_places, plain)
        ):
            return True
        if any(
            positions_agree(value, place, self.vocabulary) for place in stated_positions(self.text)
        ):
            return True
        if self.reading.numbers_free:
            return None
        return bool(self.reading.loose) and all(
            any(_near(abs(part), abs(number)) for number in self.reading.loose) for part in value
        )

    def _is_named(self, value: Any) -> bool:
        return isinstance(value, list) and tuple(value) in (
            self.vocabulary.home,
            self.vocabulary.unresolved,
        )

    def _is_corner(self, corner: Any) -> bool | None:
        """Whether a corner's coordinates are those of stated places: "the box from (0, 0) to (40,
        20)".
        """
        if self.reading.numbers_free or self.reading.loose or not _is_place(corner):
            return None if _is_place(corner) else False
        places = (*self.own_places, *self.reading.places)
        return all(any(_near(corner[axis], place[axis]) for place in places) for axis in (0, 1))

    def _follows(self, angle: float) -> bool:
        """Whether an angle follows from those that are stated: a turn to port, headings evenly
        round the compass.
        """
        numbers = [*(self.reading.said("deg") or ()), *self.own_numbers]
        counts = sector_counts(
            [*(quantity.said for quantity in quantities(self.text)), *self.own_numbers]
        )
        return any(close(angle, other) for other in turned(numbers, counts))

    def _leads_to(self, point: Any) -> bool | None:
        if not _is_place(point) or tuple(point) == self.vocabulary.home:
            return _is_place(point)
        # Any waypoint may be meant where the geometry cannot be read, also one that looks like a
        # stated place.
        if not isinstance(self._waypoints, Waypoints):
            return None
        derived = self._waypoints.derived
        return tuple(point) in derived or any(
            positions_agree(point, place, self.vocabulary) for place in derived
        )

    def _plain(self, unit: str | None) -> Iterator[float]:
        """Numbers of the plainest reading, as `Reading.said` has them beside others."""
        text = self._measures if unit in MEASURES else self._bare
        return (quantity.value for quantity in quantities(text) if quantity.unit in (unit, None))

    @functools.cached_property
    def _bare(self) -> str:
        return without_pairs(self.text)

    @functools.cached_property
    def _measures(self) -> str:
        return without_counts(self._bare)

    @functools.cached_property
    def reading(self) -> Reading:
        """What the text states."""
        return read(self.text, self.vocabulary)

    @functools.cached_property
    def _waypoints(self) -> Waypoints | str:
        return read_waypoints(self.record or {}, self.vocabulary)


def source_of(level: Level, record: dict[str, Any], vocabulary: Vocabulary) -> Source:
    """The facts that a sample gives to its answer, kept for the next system that answers it."""
    if level == "mission":
        return _mission_source(str(record.get("prompt", "")), vocabulary)
    given = {
        "prompt": str(record.get("prompt", "")),
        "task": record.get("task"),
        "parameters": record.get("parameters"),
    }
    return _task_source(json.dumps(given), vocabulary)


@functools.lru_cache(maxsize=16_384)
def _mission_source(prompt: str, vocabulary: Vocabulary) -> Source:
    return Source(prompt, vocabulary)


@functools.lru_cache(maxsize=16_384)
def _task_source(text: str, vocabulary: Vocabulary) -> Source:
    record = json.loads(text)
    parameters = record["parameters"] if isinstance(record["parameters"], dict) else {}
    places = tuple((value[0], value[1]) for value in parameters.values() if _is_place(value))
    return Source(
        record["prompt"],
        vocabulary,
        record,
        own_numbers=tuple(number for number, _unit in own_numbers(record, vocabulary)),
        own_places=places,
        own_texts=tuple(own_texts(record)),
    )


def _near(value: float, said: float) -> bool:
    return abs(value - said) <= tolerance(abs(said))


def _is_place(value: Any) -> bool:
    return (
        isinstance(value, list | tuple)
        and len(value) == 2
        and all(is_number(part) for part in value)
    )


def _all(verdicts: Iterable[bool | None]) -> bool | None:
    """False where one is, None where one is not known."""
    found = list(verdicts)
    return False if False in found else None if None in found else True
