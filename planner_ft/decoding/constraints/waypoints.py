"""Waypoints that follow from the facts of a task by arithmetic: stated places, points a stated
length away in a stated direction, and the paths of grids, squares and rings.

The model decides what is done, where a path begins and which way round it goes; a path that was
begun is gone on with. Geometry as in agents' answers (planner_ft.facts.geometry): metres, x
east, y north, bearings clockwise from north.
"""

from __future__ import annotations

import functools
import itertools
import re
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

from planner_ft.data.task.working import SUM
from planner_ft.facts import geometry as g
from planner_ft.facts import read_input
from planner_ft.facts.derived import Ground
from planner_ft.facts.reading import ROUNDING
from planner_ft.vocabulary import Vocabulary

Point = g.Point
Path = tuple[Point, ...]

MOST_PATHS, MOST_WAYPOINTS = 4000, 64
BEGUN = 3
"""Waypoints in a row that begin a path: two can look like the beginning of many."""
SHAPED = {"lawnmower": "sizes and lane spacing", "square": "radius"}
"""Patterns of tasks that are about one path of a shape, with what it follows from."""
LENGTHS = ("radius", "distance", "length", "width", "spacing", "max_dist")
GRID = re.compile(r"\b(?:grid|lawn-?mow|lanes?|lines?|legs|runs|transect|strip|pass|row|box)", re.I)


@dataclass(frozen=True)
class Waypoints:
    """The facts that waypoints are derived from. `worked` are coordinates by axis that the answer's
    scratchpad derives; a path counts as begun with `begun` of its waypoints in a row. `whole`: the
    task is one path of stated size, and is not done before its end.
    """

    places: tuple[Point, ...]
    lengths: tuple[float, ...]
    bearings: tuple[float, ...]
    paths: tuple[Path, ...]
    begun: int = BEGUN
    worked: tuple[frozenset[float], frozenset[float]] = (frozenset(), frozenset())
    whole: bool = False

    def shown(self, working: str) -> Waypoints:
        """These with the coordinates that a scratchpad (planner_ft.data.task.working) derives from
        the facts; wrong sums derive nothing.
        """
        found = tuple({place[axis] for place in self.places} for axis in (0, 1))
        lengths = set(self.lengths)
        for axis, base, sign, away, result in SUM.findall(working):
            one, other, value = float(base), float(away), float(result)
            known = found["xy".index(axis)] if axis else set()
            moved = one + (other if sign == "+" else -other)
            if sign == "/" and one in lengths and other and abs(one / other - value) <= ROUNDING:
                lengths.add(value)
            elif one in known and other in lengths and abs(moved - value) <= ROUNDING:
                known.add(g.tidy(value))
        return replace(self, worked=(frozenset(found[0]), frozenset(found[1]))) if working else self

    def following(self, before: Path) -> list[Point]:
        """The waypoints that may follow those `before`: the next one of a path that was begun, else
        any that the facts give, but for the one where the vehicle is.
        """
        begun = self._begun(before)
        onward = dict.fromkeys(path[done] for path, done in begun if done < len(path))
        complete = any(done == len(path) for path, done in begun)
        if onward and not complete and begun[0][1] >= self.begun:
            return list(onward)
        away = (
            g.offset(base, bearing, length)
            for base in dict.fromkeys((*before[-1:], *self.places))
            for length in self.lengths
            for bearing in self.bearings
        )
        options = itertools.chain(
            self.places, before, self._starts, onward, away, itertools.product(*self.worked)
        )
        return [point for point in dict.fromkeys(options) if point not in before[-1:]]

    def unfinished(self, before: Path, more: int = 0) -> bool:
        """Whether a path that must be whole is incomplete after `before` and `more` waypoints."""
        begun = self._begun(before) if self.whole else []
        return bool(begun) and all(self.begun <= done < len(path) - more for path, done in begun)

    @functools.cached_property
    def derived(self) -> frozenset[Point]:
        """Every waypoint that follows from the facts, whatever stands before it."""
        away = (
            g.offset(*facts)
            for facts in itertools.product(self.places, self.bearings, self.lengths)
        )
        return frozenset(itertools.chain(self.places, away, *self.paths))

    def _begun(self, before: Path) -> list[tuple[Path, int]]:
        """The paths of which the last waypoints are the beginning, with how many: those with the
        most.
        """
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


def read_waypoints(record: dict[str, Any], vocabulary: Vocabulary) -> Waypoints | str:
    """The waypoints that a task input gives, or a sentence that says why any may be meant."""
    source = read_input(record, vocabulary)
    title, pattern = str(record.get("task")), source.task.pattern if source.task else ""
    ground = source.ground
    if ground is None:
        return "The geometry of the command is not certain; the waypoints are the model's."
    said = {number.value for number in source.facts.numbers("m")}
    shapes = _Shapes(ground, source.facts.text, source.parameters, said)
    paths = tuple(dict.fromkeys(itertools.islice(shapes.paths(pattern), MOST_PATHS)))
    if pattern in SHAPED and not paths:
        return (
            f"The command states no {SHAPED[pattern]} for {title}; its waypoints are the model's."
        )
    places = tuple(place for place in ground.places if place != vocabulary.unresolved)
    begun = 2 if pattern in SHAPED else BEGUN
    sizes = {source.parameters.get(name) for name in ("width", "length", "spacing")}
    # A bare number may say how many lanes are meant: "the first three".
    bare = set(source.facts.counts) - said - sizes - {axis for place in places for axis in place}
    whole = pattern == "lawnmower" and None not in sizes and not bare
    return Waypoints(places, ground.lengths, ground.bearings, paths, begun, whole=whole)


@dataclass(frozen=True)
class _Shapes:
    """What paths are made of; `said` are the lengths of the prompt."""

    ground: Ground
    text: str
    parameters: dict[str, Any]
    said: set[float]

    def paths(self, pattern: str) -> Iterator[Path]:
        """Every path that the facts can mean in a task of this pattern."""
        if pattern == "lawnmower" or GRID.search(self.text):
            yield from self._grids()
        for centre, radius in itertools.product(self.ground.places, self.ground.lengths):
            yield from self._rings(centre, radius)

    def _grids(self) -> Iterator[Path]:
        for centre, sizes in itertools.product(self.ground.places, dict.fromkeys(self._sizes())):
            yield from _lanes(centre, *sizes)
            if "corner" in self.text.lower():
                for x, y in itertools.product((1, -1), repeat=2):
                    width, length, _spacing = sizes
                    middle = g.point(centre[0] + x * width / 2, centre[1] + y * length / 2)
                    yield from _lanes(middle, *sizes)
        for one, other in itertools.combinations(self.ground.centres, 2):
            width, length = abs(one[0] - other[0]), abs(one[1] - other[1])
            middle = g.point((one[0] + other[0]) / 2, (one[1] + other[1]) / 2)
            spacings = [
                size / (count - 1) for count in self.ground.counts for size in (width, length)
            ]
            for spacing in (*spacings, *self.ground.lengths) if width and length else ():
                yield from _lanes(middle, width, length, spacing)

    def _sizes(self) -> Iterator[tuple[float, float, float]]:
        """Width, length and lane spacing: the task's own; else any three lengths, or two and a
        number of lanes.
        """
        given = [self.parameters.get(name) for name in ("width", "length", "spacing")]
        own = [value for value in given if isinstance(value, int | float)]
        if len(own) == len(given):
            yield own[0], own[1], own[2]
            if not self.said - set(own):
                return
        for width, length in itertools.product(self.ground.lengths, repeat=2):
            shares = [
                size / (count - 1) for count in self.ground.counts for size in (width, length)
            ]
            for spacing in (*self.ground.lengths, *shares):
                if spacing <= max(width, length):
                    yield width, length, spacing

    def _rings(self, centre: Point, radius: float) -> Iterator[Path]:
        """Squares, their corners or mid-sides alone, and points evenly round a circle; each also
        closed.
        """
        rings = []
        for start, clockwise in itertools.product(g.SQUARE_STARTS, (False, True)):
            square = g.survey_square(centre, radius, start, clockwise=clockwise)
            rings += [square, square[::2]]
        for count, clockwise in itertools.product(self.ground.counts, (False, True)):
            for bearing in dict.fromkeys((*self.ground.bearings, 0, 90)) if count >= 3 else ():
                rings.append(g.circle(centre, radius, count, bearing, clockwise=clockwise))
        for ring in rings:
            yield tuple(ring)
            yield (*ring, ring[0])


def _lanes(centre: Point, width: float, length: float, spacing: float) -> Iterator[Path]:
    axes: tuple[g.Axis, ...] = ("y", "x")
    for axis in axes:
        across = width if axis == "y" else length
        lanes = g.lane_count(across, spacing) if spacing > 0 else None
        if lanes is None or not 2 <= lanes <= MOST_WAYPOINTS // 2:
            continue
        for corner in g.CORNERS:
            yield tuple(g.lawnmower(centre, width, length, spacing, corner, axis))
