"""Where the facts of a task can send a vehicle: stated places, points a stated way off, and the paths of grids, squares and rings.

A waypoint is derived, not guessed: from a centre, a size and a spacing follow the lanes of a grid. The model still decides what is
done, where a path begins and which way round it goes; a path that was begun is run to its end. Geometry as in agents' answers
(planner_ft.data.task.geometry): metres, x east, y north, bearings clockwise from north.
"""

from __future__ import annotations

import functools
import itertools
import re
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any, Literal

from planner_ft.data.quantities import ROUNDING, bearings, quantities
from planner_ft.data.stated import stated_numbers
from planner_ft.data.task import geometry as g
from planner_ft.data.task.working import SUM
from planner_ft.decoding.constraints.facts import read
from planner_ft.decoding.constraints.grammar import MOST_STEPS
from planner_ft.decoding.constraints.reading import LONGEST
from planner_ft.decoding.constraints.reading.paths.areas import areas
from planner_ft.decoding.constraints.reading.paths.chains import read_chain
from planner_ft.decoding.constraints.reading.paths.extents import extents
from planner_ft.decoding.constraints.reading.paths.faces import read_faces
from planner_ft.decoding.constraints.reading.paths.halfway import read_halfway, with_own_places
from planner_ft.decoding.constraints.reading.paths.halts import Halts, halts_at, read_halts
from planner_ft.decoding.constraints.reading.paths.itinerary import moves_otherwise, read_itinerary, stays
from planner_ft.decoding.constraints.reading.paths.lanes import without_courses
from planner_ft.decoding.constraints.reading.paths.legs import read_legs
from planner_ft.decoding.constraints.reading.paths.one_shape import one_shape
from planner_ft.decoding.constraints.reading.paths.own_movement import own_movement
from planner_ft.decoding.constraints.reading.paths.parts_of_shapes import read_part
from planner_ft.decoding.constraints.reading.paths.runs import read_runs
from planner_ft.decoding.constraints.reading.paths.squares import read_squares
from planner_ft.decoding.constraints.reading.paths.station_rows import read_station_rows
from planner_ft.decoding.constraints.reading.paths.stations import read_stations
from planner_ft.decoding.constraints.reading.paths.tracks import read_cable
from planner_ft.decoding.constraints.reading.paths.underived import MISREAD, OPEN
from planner_ft.decoding.constraints.reading.paths.written_out import written_out
from planner_ft.vocabulary import Vocabulary

Point = g.Point
Path = tuple[Point, ...]
Ending = Literal["not yet", "may", "must"]

MOST_LENGTHS, MOST_PLACES, MOST_PATHS = 7, 12, 4000
MOST_WAYPOINTS = 64
GRID = re.compile(
    r"\b(?:grid|lawn-?mow\w*|lanes?|lines?|tracks?|legs|runs|swaths?|transects?|strips?|passes|rows?|depths?|box|rectangle|cover|sweep|sound)\b", re.I
)
ROUND = re.compile(r"\b(?:square|round|around|about|circle|ring|circuit|perimeter|survey\w*|inspect\w*|points?|waypoints?|stops?|stand-?off|corners?)\b", re.I)
UNKNOWN = re.compile(r"\b(?:zig-?zag|spiral|triang\w+|hexagon\w*|pentagon\w*|octagon\w*|figure|ellip\w+|oval|diamond|half ?way|midpoint|mirror\w*)\b", re.I)
"""Shapes whose waypoints are not derived here."""
LOOSE = re.compile(
    r"\d ?(?:m|met(?:re|er)s?) beyond (?:it|that)\b|\bdegrees to the (?:left|right) of (?:the|that)\b|\btwo (?:north|south|east|west)[\w-]* lines\b|"
    r"\bway-?points? (?:every|each)\b|\bevery \d+(?:\.\d+)? ?(?:°|deg\w*)|\beach \d+ ?(?:°|deg\w*)|\bpart of (?:a|the) (?:ring|circle|square|round)\b|"
    r"\bo['’]clock of\b|\bhops?\b|\bstairs?\b|"
    r"\bdog[- ]?leg|\bmiddle of the line\b|half of the \d|\breciprocal\b|\b(?:stop\w*|stations?|halt\w*) every\b|\b(?:round|along) the edge\b|"
    r"\bstar (?:on|round|from)\b|\bthe way you came\b|"
    r"\bcorner,? which is\b|\b(?:skip|forget|drop|leave out|no|not|without|never mind) (?:the |a |any |this )?(?:\w+ )?(?:square|grid|lawnmower|ring|lanes)\b",
    re.IGNORECASE,
)
"""Ways that are not derived here where they are not read as a whole."""
FOUR = re.compile(r"\b(?:(?:four|4)\W(?:corner|point|waypoint|mid|side)\w*|corners? (?:only|alone)|only (?:the )?(?:four )?corners)\b", re.I)
HALF = re.compile(r"\bhalf (?:of )?(?:the |its |this )?(?:\w+ )?(?:square|round|ring|way round|side|circuit)\b|\bhalf only\b", re.I)
CLOSED = re.compile(r"\b(?:clos(?:e|es|ed|ing)|(?:back|return\w*) (?:at|to|on) (?:the |its |your )?(?:start|first|same))\b", re.I)
AGAIN = re.compile(r"\b(?:clos\w*|back|return\w*|again|revisit\w*|same|twice|times|repeat\w*|between|patrol\w*|laps?|home|start\w*|once more)\b", re.I)


@dataclass(frozen=True)
class Ground:
    """The facts that waypoints are derived from. `free`: they cannot be read with certainty, and any waypoint may be meant.
    `itinerary`: they leave no choice, these are the waypoints (or there are none); with `alone` the task asks for no movement beside its waypoints.

    `shaped`: the task is one of the paths, run once; other waypoints are the places `apart` from it.

    `halts`: where on the one path something else is done than to go on.

    `stays` says that the vehicle may come to a place again, or stay where it is. A path counts as begun with `begun` of its waypoints in a row: with
    fewer where the task is about such a path, since two moves can look like the beginning of many. `worked` are coordinates that the answer derives itself.
    """

    places: tuple[Point, ...]
    lengths: tuple[float, ...]
    bearings: tuple[float, ...]
    paths: tuple[Path, ...]
    shaped: bool = False
    apart: tuple[Point, ...] = ()
    free: bool = False
    stays: bool = False
    begun: int = 2
    itinerary: Path | None = None
    alone: bool = False
    halts: Halts | None = None
    worked: tuple[frozenset[float], frozenset[float]] = (frozenset(), frozenset())

    def shown(self, working: str) -> Ground:
        """The ground with the coordinates that a working (see planner_ft.data.task.working) derives from these facts; wrong sums derive nothing."""
        found = tuple({place[axis] for place in self.places} for axis in (0, 1))
        stated, lengths = tuple(map(frozenset, found)), set(self.lengths)
        for axis, base, sign, away, result in SUM.findall(working):
            one, other, value = float(base), float(away), float(result)
            if sign == "/" and one in lengths and other and abs(one / other - value) <= ROUNDING:
                lengths.add(value)
            elif axis and one in found["xy".index(axis)] and other in lengths and abs(one + (other if sign == "+" else -other) - value) <= ROUNDING:
                found["xy".index(axis)].add(g.tidy(value))
        return replace(self, worked=(frozenset(found[0]), frozenset(found[1]))) if found != stated else self

    def following(self, before: Path) -> list[Point]:
        """The waypoints that may follow those `before`: other places, unless the text speaks of coming back."""
        if self.itinerary is not None:
            return list(self.itinerary[len(before) : len(before) + 1])
        begun = self._begun(before)
        onward = dict.fromkeys(path[done] for path, done in begun if done < len(path))
        if onward and begun[0][1] >= self.begun:
            return list(onward)
        if self.shaped:
            starts = () if any(_within(path, before) for path in self.paths) else self._starts
            return [point for point in dict.fromkeys((*starts, *self.apart)) if point not in before]
        bases = dict.fromkeys((*before[-1:], *self.places))
        away = (g.offset(base, bearing, length) for base in bases for length in self.lengths for bearing in self.bearings)
        derived = itertools.product(*self.worked)
        options = dict.fromkeys(itertools.chain(self.places, before, self._starts, onward, away, derived))
        return [point for point in options if self.stays or point not in before]

    def ending(self, before: Path) -> Ending:
        """Whether the answer may, must or may not yet end behind these waypoints: no path is left half-way."""
        if self.itinerary is not None:
            done = len(before) >= len(self.itinerary)
            return "not yet" if not done else "must" if self.alone else "may"
        if self.shaped and any(_within(path, before) for path in self.paths):
            return "must" if self.alone and not self.apart else "may"
        begun = self._begun(before)
        ends = not begun or begun[0][1] < self.begun or any(done == len(path) for path, done in begun)
        return "may" if ends else "not yet"

    def halts_here(self, before: Path) -> bool | None:
        """Whether a step that goes nowhere must (True) or must not (False) stand behind these waypoints; None where the model decides."""
        paths = [self.itinerary] if self.itinerary is not None else [path for path in self.paths if path[: len(before)] == before] if self.shaped else []
        if self.halts is None or not paths or paths[0] is None or len(before) > len(paths[0]):
            return None
        return halts_at(self.halts, paths[0], len(before))

    @property
    def told(self) -> bool:
        """Whether the waypoints are known: nothing is left to work out."""
        return self.itinerary is not None or self.shaped

    @property
    def one_path(self) -> tuple[Path, ...]:
        """The paths of which one has all waypoints of the plan; none where that is not known."""
        return (self.itinerary,) if self.itinerary else self.paths if self.shaped and not self.apart else ()

    @property
    def waypoints_alone(self) -> bool:
        """Whether every step goes to a waypoint."""
        return self.alone and (self.itinerary is not None or self.shaped)

    def _begun(self, before: Path) -> list[tuple[Path, int]]:
        """Paths of which the last waypoints are the beginning, with how many: those with the most."""
        found = [
            (path, place + 1)
            for path, place in self._passing.get(before[-1] if before else (), ())
            if place < len(before) and path[: place + 1] == before[len(before) - place - 1 :]
        ]
        most = max((done for _path, done in found), default=0)
        return [(path, done) for path, done in found if done == most]

    @functools.cached_property
    def _starts(self) -> list[Point]:
        return list(dict.fromkeys(path[0] for path in self.paths))

    @functools.cached_property
    def _passing(self) -> dict[tuple[float, ...], list[tuple[Path, int]]]:
        """The paths by the waypoints that they pass, each with its number on the path."""
        passing: dict[tuple[float, ...], list[tuple[Path, int]]] = {}
        for path in self.paths:
            for place, point in enumerate(path):
                passing.setdefault(point, []).append((path, place))
        return passing


def _round_own(path: Path, own: list[Point]) -> bool:
    """Whether a path of four waypoints or more has the task's own place in its middle."""
    middle = tuple((min(point[axis] for point in path) + max(point[axis] for point in path)) / 2 for axis in (0, 1)) if len(path) >= 4 else ()
    return len(own) == 1 and bool(middle) and all(abs(one - other) < 0.02 for one, other in zip(middle, own[0], strict=True))


def _within(path: Path, before: Path) -> bool:
    """Whether a path was run."""
    return any(before[place : place + len(path)] == path for place in range(len(before) - len(path) + 1))


def read_ground(record: dict[str, Any], vocabulary: Vocabulary) -> Ground:
    """The facts of a task input. Waypoints are free where its numbers cannot be read with certainty."""
    task = vocabulary.task.get(str(record.get("task")))
    prompt = written_out(str(record.get("prompt", "")), _tidy(vocabulary.home))
    given = record.get("parameters")
    parameters = given if isinstance(given, dict) else {}
    home = _tidy(vocabulary.home)
    prompt = extents(prompt) if task and task.pattern == "lawnmower" else prompt
    record = {**record, "prompt": areas(prompt, task.pattern, parameters, home) if task else prompt}
    reading = read(record["prompt"], vocabulary)
    own = [_tidy(value) for value in parameters.values() if _is_place(value)]
    stated = [_tidy(place) for place in reading.places if place != vocabulary.unresolved]
    places = tuple(dict.fromkeys((*own, *(place for place in stated if place != home), home)))
    said = sorted(value for value in stated_numbers(reading.bare, "m") if value > 0)
    lengths = tuple(sorted({*_numbers(parameters), *said}))
    counts = sorted({int(quantity.said) for quantity in quantities(reading.bare) if quantity.unit is None and quantity.said in range(2, 25)})
    angles = {value % 360 for value in (*bearings(reading.text), *stated_numbers(reading.bare, "deg"), *_angles(parameters))}
    unread = reading.numbers_free or bool(reading.loose) or UNKNOWN.search(reading.text) is not None
    loose = LOOSE.search(reading.text) is not None
    misread = MISREAD.search(reading.text) is not None
    free = unread or loose or len(places) > MOST_PLACES or len(lengths) > MOST_LENGTHS
    paths: Iterator[Path] = iter(())
    if not free:
        centres = tuple(place for place in places if place != home or place in own)
        facts = _Facts(reading.text, parameters, centres or places, lengths, tuple(said), tuple(counts))
        paths = _paths(facts, task.pattern if task else "", sorted(angles))
    whole = None if reading.numbers_free or task is None else own_movement(reading.text, parameters, own[0] if len(own) == 1 else None, task, vocabulary)
    itinerary, run = whole, None
    if whole is None and not reading.numbers_free:
        run = (read_part(record, task, own[0] if len(own) == 1 else None, home) if task else None) or _straight(record, home)
        placed = None if run else with_own_places(record)
        run = (read_halfway(placed) or read_chain(placed, home) or read_station_rows(placed)) if placed else run
        if run is None and task is not None and task.pattern == "square":
            run = read_squares(record, own[0] if len(own) == 1 else None)
        itinerary = run or (None if misread else read_itinerary(record, vocabulary))
    itinerary = itinerary if itinerary is None or len(itinerary) <= MOST_STEPS else None
    found = tuple(dict.fromkeys(itertools.islice(paths, MOST_PATHS)))
    begun = 2 if task and task.pattern in ("lawnmower", "square") else 3
    shape = (
        None
        if unread or loose or misread or task is None or itinerary is not None
        else one_shape(reading.text, parameters, task, own[0] if len(own) == 1 else None)
    )
    if itinerary is None and shape is None and task is not None and not unread and not misread and len(reading.text) <= LONGEST:
        itinerary = () if stays(record) else read_runs(record, vocabulary)
    apart: tuple[Point, ...] = ()
    if shape is not None:
        (found, apart), begun = shape, 1
    free = (free or misread or OPEN.search(reading.text) is not None) and itinerary is None and shape is None
    found = () if free else found
    text = without_courses(reading.text) if run or (task is not None and task.pattern == "lawnmower") else reading.text
    one_path = not apart and (shape is not None or (itinerary is not None and _round_own(itinerary, own)))
    return Ground(
        places,
        lengths,
        tuple(sorted(angles)),
        found,
        shaped=shape is not None,
        apart=apart,
        free=free,
        stays=AGAIN.search(reading.text) is not None,
        begun=begun,
        itinerary=itinerary,
        alone=bool(whole) if whole is not None else itinerary != () and not moves_otherwise(text),
        halts=read_halts(reading.text) if one_path and task is not None and task.pattern in ("lawnmower", "square") else None,
    )


@dataclass(frozen=True)
class _Facts:
    """What paths are made of; `said` are the lengths of the prompt, `lengths` those and the task's own."""

    text: str
    parameters: dict[str, Any]
    centres: tuple[Point, ...]
    lengths: tuple[float, ...]
    said: tuple[float, ...]
    counts: tuple[int, ...]


def _paths(facts: _Facts, pattern: str, angles: list[float]) -> Iterator[Path]:
    if pattern == "lawnmower" or GRID.search(facts.text):
        for centre, (width, length, spacing) in itertools.product(facts.centres, dict.fromkeys(_sizes(facts))):
            for middle in (centre, *_middles(centre, width, length, facts.text)):
                yield from _grids(middle, width, length, spacing)
        yield from _between_corners(facts)
    if pattern == "square" or ROUND.search(facts.text):
        for centre, radius in itertools.product(facts.centres, facts.lengths):
            for start, clockwise in itertools.product(g.SQUARE_STARTS, (False, True)):
                square = tuple(g.survey_square(centre, radius, start, clockwise=clockwise))
                yield from _rings(square, facts.text)
            for count, bearing, clockwise in itertools.product(facts.counts, dict.fromkeys((*angles, 0, 90)), (False, True)):
                if count >= 3:
                    yield from _closed(tuple(g.circle(centre, radius, count, bearing, clockwise=clockwise)), facts.text)


def _rings(square: Path, text: str) -> Iterator[Path]:
    """A survey square, or its corners or mid-sides alone."""
    yield from _closed(square, text)
    if FOUR.search(text):
        yield from _closed(square[::2], text)
    if HALF.search(text):
        yield square[: len(square) // 2 + 1]


def _closed(ring: Path, text: str) -> Iterator[Path]:
    """The ring, and also with its first waypoint at the end where the text speaks of closing it."""
    yield ring
    if CLOSED.search(text):
        yield (*ring, ring[0])


def _sizes(facts: _Facts) -> Iterator[tuple[float, float, float]]:
    """Width, length and lane spacing: the task's own; else any three stated lengths, or two and a number of lanes."""
    given = tuple(facts.parameters.get(name) for name in ("width", "length", "spacing"))
    if all(isinstance(value, int | float) for value in given):
        yield given  # type: ignore[misc]
        if not set(facts.said) - set(given):
            return
    for width, length in itertools.product(facts.lengths, repeat=2):
        for spacing in facts.lengths:
            if spacing <= max(width, length):
                yield width, length, spacing
        for lanes in facts.counts:
            yield width, length, width / (lanes - 1)
            yield width, length, length / (lanes - 1)


def _middles(corner: Point, width: float, length: float, prompt: str) -> list[Point]:
    """The centres of areas that have a corner at a stated place."""
    if "corner" not in prompt.lower():
        return []
    return [g.point(corner[0] + x * width / 2, corner[1] + y * length / 2) for x, y in itertools.product((1, -1), repeat=2)]


def _between_corners(facts: _Facts) -> Iterator[Path]:
    """The lanes of areas that two stated places are opposite corners of."""
    for one, other in itertools.combinations(facts.centres, 2):
        width, length = abs(one[0] - other[0]), abs(one[1] - other[1])
        for lanes in (lanes for lanes in facts.counts if width and length):
            yield from _grids(_middle(one, other), width, length, width / (lanes - 1))
            yield from _grids(_middle(one, other), width, length, length / (lanes - 1))
        for spacing in facts.lengths if width and length else ():
            yield from _grids(_middle(one, other), width, length, spacing)


def _middle(one: Point, other: Point) -> Point:
    return g.point((one[0] + other[0]) / 2, (one[1] + other[1]) / 2)


def _grids(centre: Point, width: float, length: float, spacing: float) -> Iterator[Path]:
    axes: tuple[g.Axis, ...] = ("y", "x")
    for axis in axes:
        across = width if axis == "y" else length
        lanes = g.lane_count(across, spacing) if spacing > 0 else None
        if lanes is None or not 2 <= lanes <= MOST_WAYPOINTS // 2:
            continue
        for corner in g.CORNERS:
            yield tuple(g.lawnmower(centre, width, length, spacing, corner, axis))


def _angles(parameters: dict[str, Any]) -> Iterator[float]:
    value = parameters.get("heading")
    if isinstance(value, int | float):
        yield value


def _numbers(parameters: dict[str, Any]) -> Iterator[float]:
    """The lengths among a task's parameters."""
    for name, value in parameters.items():
        if name in ("radius", "distance", "length", "width", "spacing", "max_dist") and isinstance(value, int | float) and value > 0:
            yield value


def _is_place(value: Any) -> bool:
    return isinstance(value, list) and len(value) == 2 and all(isinstance(item, int | float) for item in value)


def _straight(record: dict[str, Any], home: Point) -> Path | None:
    """Every waypoint of an input that is about a straight way: a chain of legs, a row of stations, passes beside a face, a cable track."""
    return (
        read_halfway(record)
        or read_chain(record, home)
        or read_station_rows(record)
        or read_legs(record, home)
        or read_faces(record)
        or read_stations(record)
        or read_cable(record)
    )


def _tidy(place: Any) -> Point:
    return g.point(float(place[0]), float(place[1]))
