"""What an answer can draw on: a command with its vehicle, or a task prompt with its parameters."""

import functools
import itertools
import json
import math
import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from typing import Any

from planner_ft.facts import places, reading
from planner_ft.facts.geometry import CLOSE, Area, Ground, Point, rectangle, sector_counts, turned
from planner_ft.facts.numbers import read_numbers
from planner_ft.facts.places import Position, read_positions, rows_of_sizes
from planner_ft.facts.reading import NOBODY, UNREAD, WAYPOINT, Evidence, is_number, is_place, near
from planner_ft.facts.spelling import fluent
from planner_ft.facts.together import Number
from planner_ft.facts.units import base_of, converted, named
from planner_ft.facts.words import MULTIPLES, UNITS, WORDS, missing_words, normalised, words
from planner_ft.vocabulary import Parameter, Task, Vocabulary

MOST_LENGTHS, MOST_PLACES = 9, 12
"""Stated lengths and places up to which waypoints are derived."""
MOST_WORKED = 2000  # places that are worked out from those of a command
ANEW = 20  # characters between a position and one of its coordinates that is told anew
SIDES = ("width", "length")  # parameters that an area between two places has
_UNREAD_SHAPES = re.compile(rf"\b(?:{'|'.join(WORDS['unread_shapes'])})s?\b", re.IGNORECASE)


class Input:
    """The facts of a text, the vehicle's own places and the parameters of a task."""

    def __init__(
        self, text: str, vocabulary: Vocabulary, task: str = "", parameters: Any = None
    ) -> None:
        self.facts = reading.read(text)
        self.vocabulary = vocabulary
        self.task: Task | None = vocabulary.task.get(task)
        self.parameters: dict[str, Any] = parameters if isinstance(parameters, dict) else {}
        self.is_task = parameters is not None

    def stated(
        self, value: Any, parameter: Parameter, tolerance: float = reading.EXACT
    ) -> Evidence:
        """Evidence of the text and the task's parameters, without vehicle and geometry."""
        if self._is_own(value, parameter, tolerance):
            return Evidence("stated")
        found = self.facts.evidence(value, parameter, tolerance)
        texts = parameter.type in ("text", "id", "texts")
        if found.kind == "nobody" and texts and self.texts:
            said = "\n".join((self.facts.text, *self.texts))
            items = value if isinstance(value, list) else [value]
            missing = any(missing_words(said, str(item), misspelt=True) for item in items)
            return NOBODY if missing else Evidence("stated")
        return found

    def evidence(
        self,
        value: Any,
        parameter: Parameter,
        tolerance: float = reading.EXACT,
        before: Iterable[Point] = (),
    ) -> Evidence:
        """Where a value is from; a waypoint (WAYPOINT) may follow from those `before` it."""
        if parameter is WAYPOINT:
            return self._place(value, tolerance, before)
        place = is_place(value) and parameter.type == "position"
        if place and tuple(value) in (self.vocabulary.home, self.vocabulary.unresolved):
            return Evidence("vehicle")
        if parameter.type == "polygon" and isinstance(value, list):
            return reading.together(self._place(corner, tolerance, None) for corner in value)
        found = self.stated(value, parameter, tolerance)
        if found.kind != "nobody":
            return found
        if parameter.type == "position":
            ground = self.ground if place else None
            away = (ground.is_way_off(_point(value), at) for at in ground.places) if ground else ()
            middles = (middle for middle, _width, _length in self.rectangles)
            worked = itertools.chain(self.worked_places, middles)
            follows = place and (any(away) or any(math.dist(value, at) <= CLOSE for at in worked))
        else:
            follows = is_number(value) and any(near(value, one) for one in self.values(parameter))
        return Evidence("derived") if follows else found

    @functools.cached_property
    def ground(self) -> Ground | None:
        """What waypoints are derived from; None where the text cannot be read with certainty."""
        return None if self.facts.loose else self._loose_ground

    @functools.cached_property
    def _loose_ground(self) -> Ground | None:
        """The same, also where a coordinate may have no partner: "200 m north"."""
        facts, home = self.facts, _point(self.vocabulary.home)
        lengths = {number.value for number in facts.numbers("m") if number.value > 0}
        lengths |= {value for value in self._own("m") if value > 0}
        lengths |= {length * factor for length in set(lengths) for factor in self._factors}
        stated = [_point((place.x, place.y)) for place in facts.positions]
        places = dict.fromkeys((*self._places, *stated, home))
        unread = facts.unread or _UNREAD_SHAPES.search(facts.text)
        if unread or len(lengths) > MOST_LENGTHS or len(places) > MOST_PLACES:
            return None
        angles = (*facts.bearings, *facts.numbers("deg"))
        bearings = {number.value % 360 for number in angles} | set(self._own("deg"))
        meant = self._places if self.is_task else (*self._places, *stated)
        centres = tuple(place for place in places if place != home or place in meant)
        # An area is the task's own where no other lengths are stated.
        own = self.parameters if lengths <= set(self._own("m")) else {}
        width, length, spacing = (
            value if is_number(value := own.get(name)) else None
            for name in ("width", "length", "spacing")
        )
        sizes = ((width, length),) if width and length else ()
        return Ground(
            tuple(places),
            centres or (home,),
            tuple(sorted(lengths)),
            tuple(sorted(bearings)),
            tuple(sorted(sector_counts((*facts.counts, *self._own(None))))),
            sizes or tuple(itertools.product(sorted(lengths), sorted(lengths))),
            "corner" in facts.text.lower(),
            spacing if sizes else None,
        )

    @functools.cached_property
    def plain_ground(self) -> Ground | None:
        """What places are derived from in the plain reading of the text: positions that share no
        number, lengths that are no coordinates, directions that are said. "0 and 100,200" is no
        100200.
        """
        known, text, plain = self._loose_ground, self.facts.text, read_numbers(self.facts.text)
        if known is None:
            return None
        apart = _apart(read_positions(text))
        metres = [one for one in plain if one.unit in ("m", None)]
        said = {one.value for one in metres}
        bare = [one for one in metres if one.unit is None]
        inside = {one for one in bare if any(at.start <= one.start < at.end for at in apart)}
        ways = {one.value for one in metres if one not in inside}
        courses = (*self.facts.bearings, *(one for one in plain if _is_course(text, one)))
        alone = {_point((place.x, place.y)) for place in apart}
        alone |= {*self._places, _point(self.vocabulary.home)}
        return replace(
            known,
            places=tuple(place for place in known.places if place in alone),
            centres=tuple(place for place in known.centres if place in alone),
            lengths=tuple(length for length in known.lengths if length in ways),
            sizes=tuple(size for size in known.sizes if said >= {*size}),
            bearings=tuple(sorted({one.value % 360 for one in courses})),
        )

    @functools.cached_property
    def worked_places(self) -> tuple[Point, ...]:
        """Places in metres that follow from those of a mission's command, at most MOST_WORKED: one
        or two stated ways off them, the middles of areas between two of them or at a corner, and
        those with one coordinate told anew ("40, 20, no, minus 30").
        """
        known = None if self.is_task else self.plain_ground
        if known is None:
            return ()
        off = tuple(itertools.islice(known.away(known.places), MOST_WORKED))
        middles = ((x, y) for x, y, _width, _length in reversed(known.areas))
        found = itertools.chain(self._corrected(), off, middles, known.away(off))
        return tuple(itertools.islice(dict.fromkeys(found), MOST_WORKED))

    @functools.cached_property
    def rectangles(self) -> tuple[Area, ...]:
        """The areas that a command says by four corners in a row, and by no other sizes; what is
        done at "each" of four places is in no area.
        """
        text, found = self.facts.text, list[Area]()
        if "each" in words(text):
            return ()
        rows = places.rows_of(text, places.written_positions(text))
        together = {one.start for row in rows_of_sizes(text) for one in row}
        lengths = [one for one in read_numbers(text) if one.unit == "m" or one.start in together]
        for row in rows if not self.is_task else ():
            area = rectangle([(at.x, at.y) for at in row])
            others = {one.value for one in lengths} - {*(area or ())[1:]}
            found += [area] if area and len(others) <= 1 else []
        return tuple(found)

    def _corrected(self) -> Iterator[Point]:
        """Positions with one coordinate told anew behind them."""
        text, apart = self.facts.text, _apart(read_positions(self.facts.text))
        sizes = {one for row in rows_of_sizes(text) for one in row}
        numbers = [one for one in read_numbers(text) if one not in sizes]
        for place, after in itertools.zip_longest(apart, apart[1:]):
            behind = (one for one in numbers if one.start >= place.end)
            told = next(behind, None)
            if (
                told
                and told.unit is None
                and not told.counts
                and not (after and after.start <= told.start)
            ):
                between = text[place.end : told.start]
                if len(between) <= ANEW and any(map(str.isalpha, between)):
                    yield from ((place.x, told.value), (told.value, place.y))

    def _place(self, value: Any, tolerance: float, before: Iterable[Point] | None) -> Evidence:
        """Where a waypoint behind those `before` is from; None for a corner of an area."""
        if not is_place(value):
            return NOBODY
        point = _point(value)
        if before is not None and point == _point(self.vocabulary.home):
            return Evidence("vehicle")
        found = self.stated(value, WAYPOINT, tolerance)
        if found.kind != "nobody":
            return found
        if self.ground and self.ground.leads_to(point, before or ()):
            return Evidence("derived")
        # Any waypoint may be meant where the geometry cannot be read.
        return UNREAD if (self.facts.loose if before is None else not self.ground) else found

    def _is_own(self, value: Any, parameter: Parameter, tolerance: float) -> bool:
        if parameter.type in ("number", "integer"):
            own = filter(is_number, self._values)
            return is_number(value) and any(near(value, number, tolerance) for number in own)
        if parameter.type == "position":
            same = (reading.same_place(value, at, tolerance) for at in self._places)
            return is_place(value) and any(same)
        own_texts = set(map(normalised, self.texts))
        items = value if isinstance(value, list) else [value]
        return bool(own_texts) and all(normalised(str(item)) in own_texts for item in items)

    def values(self, parameter: Parameter) -> list[float]:
        """The numbers that a parameter can have: stated ones in its unit, those of the task, their
        multiples and parts ("twice as long", "half the distance"), for angles directions and turns,
        at task level with what follows from them.
        """
        unit, known = parameter.unit, self.task.by_name if self.task else {}
        base = base_of(unit)
        found = [number.value for number in self.facts.numbers(unit)]
        for name, value in self.parameters.items():
            own_unit = (known[name].unit if name in known else None) or unit
            items = filter(is_number, value if isinstance(value, list) else [value])
            given = (item if base is None else converted(item, own_unit, unit) for item in items)
            found += [item for item in given if item is not None]
        if parameter.name in SIDES and base == "m" and not self.is_task:
            found += self.ground.sides if self.ground else ()
            found += [side for _middle, *sides in self.rectangles for side in sides]
        if base in ("s", "m"):
            found += [value * factor for factor in self._factors for value in found]
        if named(unit) == UNITS["deg"]:
            found += [angle.value for angle in (*self.facts.bearings, *self.facts.turns)]
            counts = sector_counts((*self.facts.counts, *filter(is_number, self._values)))
            found += turned(found, counts) if self.is_task else []
        return found

    @functools.cached_property
    def _factors(self) -> tuple[float, ...]:
        """What the text multiplies by: "twice", "half"."""
        said = set(words(self.facts.text))
        return tuple({factor for word, factor in MULTIPLES.items() if word in said})

    def _own(self, unit: str | None) -> Iterator[float]:
        """The numbers in a base unit among the task's parameters."""
        known = self.task.by_name if self.task else {}
        for name, value in self.parameters.items():
            if is_number(value) and name in known and base_of(own := known[name].unit) == unit:
                yield value if unit is None else converted(value, own, unit) or value

    @functools.cached_property
    def _values(self) -> list[Any]:
        """Every value of the task's parameters, those of lists one by one."""
        values = self.parameters.values()
        return [one for value in values for one in (value if isinstance(value, list) else [value])]

    @functools.cached_property
    def texts(self) -> tuple[str, ...]:
        """The texts of the task's parameters."""
        return tuple(value for value in self._values if isinstance(value, str))

    @functools.cached_property
    def _places(self) -> tuple[Point, ...]:
        return tuple(_point(value) for value in self.parameters.values() if is_place(value))


def read_input(record: dict[str, Any], vocabulary: Vocabulary) -> Input:
    """The input of an answer, kept for the next one to it: {"prompt"} of a mission, or {"prompt",
    "task", "parameters"} of a task.
    """
    keys = ("prompt", "task", "parameters")
    return _read_input(json.dumps([record.get(key) for key in keys]), vocabulary)


@functools.lru_cache(maxsize=4096)
def _read_input(text: str, vocabulary: Vocabulary) -> Input:
    prompt, task, parameters = json.loads(text)
    parameters = (parameters or {}) if task is not None else None
    return Input(fluent(str(prompt or "")), vocabulary, str(task), parameters)


def _point(place: Sequence[float]) -> Point:
    return float(place[0]), float(place[1])


def _is_course(text: str, number: Number) -> bool:
    """Whether a number is said as a direction: in degrees, as "045", or behind "heading"."""
    if number.unit is not None:
        return number.unit == "deg"
    written = re.fullmatch(r"0\d\d", text[number.start : number.end])
    return bool(written or places.is_course(text, number.start))


def _apart(found: Sequence[Position]) -> list[Position]:
    """The positions without those that share a number with another one: the certain ones stand."""
    kept: list[Position] = []
    for place in sorted(found, key=lambda one: (not one.certain, one.start)):
        same = (one for one in kept if one.start < place.end and place.start < one.end)
        if all((one.start, one.end) == (place.start, place.end) for one in same):
            kept.append(place)
    return kept
