"""Where the facts of a task can send a vehicle: stated places, points a stated way off, and the
paths of grids, squares and rings.

A waypoint is derived, not guessed. The model still decides what is done, where a path begins and
which way round it goes; a path that was begun is run to its end.
"""

from __future__ import annotations

import functools
import re
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

from planner_ft.data.quantities import bearings, positions, quantities
from planner_ft.data.stated import stated_numbers
from planner_ft.data.task import geometry as g
from planner_ft.decoding.constraints.derived_paths import Path, PathFacts, Point, derived_paths
from planner_ft.decoding.constraints.facts import Reading, read
from planner_ft.decoding.constraints.grammar import MOST_STEPS
from planner_ft.decoding.constraints.ground import Ground
from planner_ft.decoding.constraints.reading import LONGEST
from planner_ft.decoding.constraints.reading.paths.areas import areas
from planner_ft.decoding.constraints.reading.paths.chains import read_chain
from planner_ft.decoding.constraints.reading.paths.extents import extents
from planner_ft.decoding.constraints.reading.paths.faces import read_faces
from planner_ft.decoding.constraints.reading.paths.halfway import read_halfway, with_own_places
from planner_ft.decoding.constraints.reading.paths.halts import read_halts
from planner_ft.decoding.constraints.reading.paths.itinerary import (
    moves_otherwise,
    read_itinerary,
    stays,
)
from planner_ft.decoding.constraints.reading.paths.lanes import without_courses
from planner_ft.decoding.constraints.reading.paths.legs import read_legs
from planner_ft.decoding.constraints.reading.paths.one_shape import one_shape
from planner_ft.decoding.constraints.reading.paths.own_movement import own_movement
from planner_ft.decoding.constraints.reading.paths.parts_of_shapes import read_part
from planner_ft.decoding.constraints.reading.paths.rings import read_ring
from planner_ft.decoding.constraints.reading.paths.runs import read_runs
from planner_ft.decoding.constraints.reading.paths.shapes import Place, named_sizes, stated_sizes
from planner_ft.decoding.constraints.reading.paths.squares import read_squares
from planner_ft.decoding.constraints.reading.paths.station_rows import read_station_rows
from planner_ft.decoding.constraints.reading.paths.stations import read_stations
from planner_ft.decoding.constraints.reading.paths.tracks import read_cable
from planner_ft.decoding.constraints.reading.paths.underived import MISREAD, OPEN
from planner_ft.decoding.constraints.reading.paths.written_out import written_out
from planner_ft.decoding.constraints.reading.wordings import SIZE
from planner_ft.vocabulary import Task, Vocabulary

MOST_LENGTHS, MOST_PLACES = 7, 12
UNKNOWN = re.compile(
    r"\b(?:zig-?zag|spiral|triang\w+|hexagon\w*|pentagon\w*|octagon\w*|figure|ellip\w+|oval|diamond|half"
    r" ?way|midpoint|mirror\w*)\b",
    re.I,
)
"""Shapes whose waypoints are not derived here."""
LOOSE = re.compile(
    r"\d ?(?:m|met(?:re|er)s?) beyond (?:it|that)\b|\bdegrees to the (?:left|right) of"
    r" (?:the|that)\b|\btwo (?:north|south|east|west)[\w-]* lines\b|"
    r"\bway-?points? (?:every|each)\b|\bevery \d+(?:\.\d+)? ?(?:°|deg\w*)|\beach \d+"
    r" ?(?:°|deg\w*)|\bpart of (?:a|the) (?:ring|circle|square|round)\b|"
    r"\bo['’]clock of\b|\bhops?\b|\bstairs?\b|"
    r"\bdog[- ]?leg|\bmiddle of the line\b|half of the"
    r" \d|\breciprocal\b|\b(?:stop\w*|stations?|halt\w*) every\b|\b(?:round|along) the edge\b|"
    r"\bstar (?:on|round|from)\b|\bthe way you came\b|"
    r"\bcorner,? which is\b|\b(?:skip|forget|drop|leave out|no|not|without|never mind) (?:the |a"
    r" |any |this )?(?:\w+ )?(?:square|grid|lawnmower|ring|lanes)\b",
    re.IGNORECASE,
)
"""Ways that are not derived here where they are not read as a whole."""
SHAPED = ("lawnmower", "square")
"""Patterns of tasks that are about one path of a shape."""
AGAIN = re.compile(
    r"\b(?:clos\w*|back|return\w*|again|revisit\w*|same|twice|times|repeat\w*|between|patrol\w*|laps?|home|start\w*|once"
    r" more)\b",
    re.I,
)

LANES = re.compile(r"\b(?:lanes?|lawn-?mow\w*|grid)\b", re.IGNORECASE)
TO_OWN = re.compile(
    r"(?:^|[.;:,] |\b(?:to|into|for|reach\w*|at|via) )(?:the |its |your"
    r" )?(?:(?:task'?s?|given|planned|stated|usual|same|final|ordered) )?"
    r"(?:target|goal|destination|berth)"
    r"(?: position| point|"
    r" place)?(?=\s*(?:[,.;:)]|$|(?:via|and|then|but|by|over|only|with|at|in|while|without)\b))",
    re.IGNORECASE,
)
"""The task's own place as somewhere to go."""


def read_ground(record: dict[str, Any], vocabulary: Vocabulary) -> Ground:
    """The facts of a task input. Waypoints are free where its numbers cannot be read with
    certainty.
    """
    given = _read_input(record, vocabulary)
    told, facts = _told(given), _path_facts(given)
    told = _Told(None) if _leaves_out_own(given, told.itinerary) else told
    underived = (
        given.unread
        or given.loose
        or len(given.places) > MOST_PLACES
        or len(facts.lengths) > MOST_LENGTHS
    )
    known = told.itinerary is not None or told.shape is not None
    free = not known and (underived or given.misread or OPEN.search(given.text) is not None)
    paths, apart = told.shape or (
        () if free or underived else derived_paths(facts, given.pattern),
        (),
    )
    one_path = not apart and (
        told.shape is not None
        or (told.itinerary is not None and _round_own(told.itinerary, given.own))
    )
    return Ground(
        given.places,
        facts.lengths,
        facts.bearings,
        paths,
        shaped=told.shape is not None,
        apart=apart,
        free=free,
        stays=AGAIN.search(given.text) is not None,
        begun=1 if told.shape is not None else 2 if given.pattern in SHAPED else 3,
        itinerary=told.itinerary,
        alone=_alone(given, told),
        halts=read_halts(given.text) if one_path and given.pattern in SHAPED else None,
    )


# ---------------------------------------------------------------- what the input states


@dataclass(frozen=True)
class _Input:
    """A task input with its shapes written out, what its text states, and the places `own` to its
    task.
    """

    record: dict[str, Any]
    task: Task | None
    vocabulary: Vocabulary
    parameters: dict[str, Any]
    home: Point
    reading: Reading
    own: list[Point]

    @property
    def text(self) -> str:
        return self.reading.text

    @property
    def pattern(self) -> str:
        return self.task.pattern if self.task else ""

    @property
    def place(self) -> Point | None:
        """The one place of the task."""
        return self.own[0] if len(self.own) == 1 else None

    @functools.cached_property
    def places(self) -> tuple[Point, ...]:
        """The task's own places, those that the text states, and home."""
        stated = (
            _tidy(place) for place in self.reading.places if place != self.vocabulary.unresolved
        )
        return tuple(
            dict.fromkeys(
                (*self.own, *(place for place in stated if place != self.home), self.home)
            )
        )

    @functools.cached_property
    def unread(self) -> bool:
        """Whether numbers or a shape of the text cannot be read."""
        return (
            self.reading.numbers_free
            or bool(self.reading.loose)
            or UNKNOWN.search(self.text) is not None
        )

    @functools.cached_property
    def loose(self) -> bool:
        return LOOSE.search(self.text) is not None

    @functools.cached_property
    def misread(self) -> bool:
        return MISREAD.search(self.text) is not None


def _read_input(record: dict[str, Any], vocabulary: Vocabulary) -> _Input:
    home, given = _tidy(vocabulary.home), record.get("parameters")
    parameters = given if isinstance(given, dict) else {}
    prompt = written_out(str(record.get("prompt", "")), home)
    task = _shaped_as(prompt, vocabulary.task.get(str(record.get("task"))), vocabulary)
    prompt = extents(prompt) if task and task.pattern == "lawnmower" else prompt
    prompt = areas(prompt, task.pattern, parameters, home) if task else prompt
    own = [_tidy(value) for value in parameters.values() if _is_place(value)]
    return _Input(
        {**record, "prompt": prompt},
        task,
        vocabulary,
        parameters,
        home,
        read(prompt, vocabulary),
        own,
    )


def _shaped_as(prompt: str, task: Task | None, vocabulary: Vocabulary) -> Task | None:
    """The task, or one that is a grid where a task without a shape of its own is to run lanes over
    an area whose sizes are stated.
    """
    if task is None or task.pattern in SHAPED or not LANES.search(prompt):
        return task
    places = [
        Place(g.point(x, y), start, end)
        for x, y, start, end in positions(prompt)
        if not SIZE.search(prompt[start:end])
    ]
    sizes = {name for name, _value, _used in named_sizes(prompt, stated_sizes(prompt, places))}
    return (
        next((other for other in vocabulary.tasks if other.pattern == "lawnmower"), task)
        if {"width", "length"} <= sizes
        else task
    )


def _path_facts(given: _Input) -> PathFacts:
    """What paths can be made of."""
    bare = given.reading.bare
    said = sorted(value for value in stated_numbers(bare, "m") if value > 0)
    counts = sorted(
        {
            int(quantity.said)
            for quantity in quantities(bare)
            if quantity.unit is None and quantity.said in range(2, 25)
        }
    )
    angles = {
        value % 360
        for value in (
            *bearings(given.text),
            *stated_numbers(bare, "deg"),
            *_heading(given.parameters),
        )
    }
    centres = tuple(place for place in given.places if place != given.home or place in given.own)
    lengths = tuple(sorted({*_lengths(given.parameters), *said}))
    return PathFacts(
        given.text,
        given.parameters,
        centres or given.places,
        lengths,
        tuple(said),
        tuple(counts),
        tuple(sorted(angles)),
    )


# ---------------------------------------------------------------- what leaves no choice


@dataclass(frozen=True)
class _Told:
    """What a text leaves no choice about: the waypoints, by the task's own movement as a `whole` or
    by a `run`, or the `shape` with places apart from it.
    """

    itinerary: Path | None
    whole: Path | None = None
    run: Path | None = None
    shape: tuple[tuple[Path, ...], tuple[Point, ...]] | None = None


def _told(given: _Input) -> _Told:
    told = _told_waypoints(given)
    if told.itinerary is not None or given.task is None or given.unread or given.misread:
        return told
    shape = (
        None if given.loose else one_shape(given.text, given.parameters, given.task, given.place)
    )
    if shape is not None:
        return replace(told, shape=shape)
    if len(given.text) > LONGEST:
        return told
    return replace(
        told, itinerary=() if stays(given.record) else read_runs(given.record, given.vocabulary)
    )


def _told_waypoints(given: _Input) -> _Told:
    """The waypoints of the task's own movement, of a run, or those that the text goes through one
    by one.
    """
    if given.reading.numbers_free:
        return _Told(None)
    whole = (
        own_movement(given.text, given.parameters, given.place, given.task, given.vocabulary)
        if given.task
        else None
    )
    if whole is not None:
        return _Told(whole if len(whole) <= MOST_STEPS else None, whole)
    run = _run(given)
    itinerary = run or (None if given.misread else read_itinerary(given.record, given.vocabulary))
    return _Told(
        itinerary if itinerary is None or len(itinerary) <= MOST_STEPS else None, None, run
    )


def _leaves_out_own(given: _Input, itinerary: Path | None) -> bool:
    """Whether waypoints leave out the task's own place although the text goes there: then they are
    not all.
    """
    return (
        bool(itinerary)
        and given.place is not None
        and given.place not in (itinerary or ())
        and TO_OWN.search(str(given.record["prompt"])) is not None
    )


def _run(given: _Input) -> Path | None:
    """Every waypoint of an input that is about a part of a shape, a ring, a straight way, or a
    square of its own.
    """
    record, home = given.record, given.home
    run = (
        (read_part(record, given.task, given.place, home) if given.task else None)
        or read_ring(record, given.pattern, given.place)
        or _straight(record, home)
    )
    placed = None if run else with_own_places(record)
    run = (
        (read_halfway(placed) or read_chain(placed, home) or read_station_rows(placed))
        if placed
        else run
    )
    return read_squares(record, given.place) if run is None and given.pattern == "square" else run


def _straight(record: dict[str, Any], home: Point) -> Path | None:
    """Every waypoint of an input that is about a straight way: a chain of legs, a row of stations,
    passes beside a face, a cable track.
    """
    return (
        read_halfway(record)
        or read_chain(record, home)
        or read_station_rows(record)
        or read_legs(record, home)
        or read_faces(record)
        or read_stations(record)
        or read_cable(record)
    )


def _alone(given: _Input, told: _Told) -> bool:
    """Whether the text asks for no movement beside its waypoints."""
    if told.whole is not None:
        return bool(told.whole)
    text = without_courses(given.text) if told.run or given.pattern == "lawnmower" else given.text
    return told.itinerary != () and not moves_otherwise(text)


# ---------------------------------------------------------------- numbers and places


def _heading(parameters: dict[str, Any]) -> Iterator[float]:
    """The heading among a task's parameters."""
    value = parameters.get("heading")
    if isinstance(value, int | float):
        yield value


def _lengths(parameters: dict[str, Any]) -> Iterator[float]:
    """The lengths among a task's parameters."""
    for name, value in parameters.items():
        if (
            name in ("radius", "distance", "length", "width", "spacing", "max_dist")
            and isinstance(value, int | float)
            and value > 0
        ):
            yield value


def _is_place(value: Any) -> bool:
    return (
        isinstance(value, list)
        and len(value) == 2
        and all(isinstance(item, int | float) for item in value)
    )


def _tidy(place: Any) -> Point:
    return g.point(float(place[0]), float(place[1]))


def _round_own(path: Path, own: list[Point]) -> bool:
    """Whether a path of four waypoints or more has the task's own place in its middle."""
    middle = (
        tuple(
            (min(point[axis] for point in path) + max(point[axis] for point in path)) / 2
            for axis in (0, 1)
        )
        if len(path) >= 4
        else ()
    )
    return (
        len(own) == 1
        and bool(middle)
        and all(abs(one - other) < 0.02 for one, other in zip(middle, own[0], strict=True))
    )
