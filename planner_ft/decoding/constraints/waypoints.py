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
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

from planner_ft.data.task.working import SUM
from planner_ft.facts import geometry as g
from planner_ft.facts import read_input
from planner_ft.facts.geometry import Ground
from planner_ft.facts.inputs import Input
from planner_ft.facts.numbers import read_numbers
from planner_ft.facts.reading import ROUNDING
from planner_ft.vocabulary import Vocabulary

Point = g.Point
Path = tuple[Point, ...]

MOST_PATHS, MOST_LANES = 4000, 32
BEGUN = 3
"""Waypoints in a row that begin a path: two can look like the beginning of many."""
SIZES = ("width", "length", "spacing")
SHAPED = {"lawnmower": "sizes and lane spacing", "square": "radius"}
"""Patterns of tasks that are about one path of a shape, with what it follows from."""
GRID = re.compile(r"\b(?:grid|lawn-?mow|lanes?|lines?|legs|runs|transect|strip|pass|row|box)", re.I)


@dataclass(frozen=True)
class Waypoints:
    """What waypoints are derived from, and the paths that it gives. A path counts as begun with
    `begun` of its waypoints in a row. `whole`: the task is one path of stated size, and is not done
    before its end.
    """

    ground: Ground
    paths: tuple[Path, ...]
    begun: int = BEGUN
    whole: bool = False

    def following(self, before: Path, working: str = "") -> list[Point]:
        """The waypoints that may follow those `before`: the next one of a path that was begun, else
        any that the facts or the sums of a `working` give, but for the one where the vehicle is.
        Behind a path that is all of its task follow only stated places, and a path anew: no further
        lane.
        """
        begun, ground = self._begun(before), self.ground
        onward = dict.fromkeys(path[done] for path, done in begun if done < len(path))
        complete = any(done == len(path) for path, done in begun)
        if onward and not complete and begun[0][1] >= self.begun:
            return list(onward)
        options: Iterable[Point] = (*ground.places, *(path[0] for path in self.paths))
        if not (complete and self.whole):
            away = ground.away(dict.fromkeys((*before[-1:], *ground.places)))
            options = itertools.chain(options, before, onward, away, self._worked(working))
        return [point for point in dict.fromkeys(options) if point not in before[-1:]]

    def unfinished(self, before: Path, more: int = 0) -> bool:
        """Whether a path that must be whole is incomplete after `before` and `more` waypoints."""
        begun = self._begun(before) if self.whole else []
        return bool(begun) and all(self.begun <= done < len(path) - more for path, done in begun)

    def _worked(self, working: str) -> Iterable[Point]:
        """The points that right sums of a working derive (data.task.working)."""
        found = tuple({place[axis] for place in self.ground.places} for axis in (0, 1))
        lengths = set(self.ground.lengths)
        for axis, base, sign, away, result in SUM.findall(working):
            one, other, value = float(base), float(away), float(result)
            known = found["xy".index(axis)] if axis else set()
            moved = one + (other if sign == "+" else -other)
            if sign == "/" and one in lengths and other and abs(one / other - value) <= ROUNDING:
                lengths.add(value)
            elif one in known and other in lengths and abs(moved - value) <= ROUNDING:
                known.add(g.tidy(value))
        xs, ys = found if working else ((), ())
        return itertools.product(xs, ys)

    def _begun(self, before: Path) -> list[tuple[Path, int]]:
        """The paths that begin with the last waypoints, with how many: those with the most."""
        passing = self._passing.get(before[-1], ()) if before else ()
        found = [(path, done) for path, done in passing if path[:done] == before[-done:]]
        most = max((done for _path, done in found), default=0)
        return [(path, done) for path, done in found if done == most]

    @functools.cached_property
    def _passing(self) -> dict[Point, list[tuple[Path, int]]]:
        """The paths by the waypoints that they pass, each with its number (from 1) on the path."""
        passing: dict[Point, list[tuple[Path, int]]] = {}
        for path in self.paths:
            for number, point in enumerate(path, start=1):
                passing.setdefault(point, []).append((path, number))
        return passing


def read_waypoints(record: dict[str, Any], vocabulary: Vocabulary) -> Waypoints | str:
    """The waypoints that a task input gives, or a sentence that says why any may be meant."""
    source = read_input(record, vocabulary)
    title, pattern = str(record.get("task")), source.task.pattern if source.task else ""
    ground = source.ground
    if ground is None:
        return "The geometry of the command is not certain; the waypoints are the model's."
    places = tuple(place for place in ground.places if place != vocabulary.unresolved)
    ground = replace(ground, places=places)
    own = tuple(_own_lanes(source, places)) if pattern == "lawnmower" else ()
    if own:
        return Waypoints(ground, own, begun=1, whole=True)
    grid = pattern == "lawnmower" or GRID.search(source.facts.text)
    lanes = (
        _lanes((x, y), width, length, spacing)
        for x, y, width, length in (ground.areas if grid else ())
        for spacing in ground.spacings(width, length)
    )
    found = itertools.chain(itertools.chain.from_iterable(lanes), _rings(ground))
    paths = tuple(dict.fromkeys(itertools.islice(found, MOST_PATHS)))
    if pattern in SHAPED and not paths:
        lacking = SHAPED[pattern]
        return f"The command states no {lacking} for {title}; its waypoints are the model's."
    return Waypoints(ground, paths, 2 if pattern in SHAPED else BEGUN)


def _own_lanes(source: Input, places: Sequence[Point]) -> Iterator[Path]:
    """Lanes of a task's own area; none where a bare number may be of lanes: "the first three"."""
    assert source.task is not None
    names = (source.task.position_parameter, *SIZES)
    middle, width, length, spacing = (source.parameters.get(str(name)) for name in names)
    known = {number.value for number in source.facts.numbers("m")} | {width, length, spacing}
    known |= {axis for place in places for axis in place}
    bare = {one.said for one in read_numbers(source.facts.text) if not one.unit}
    if middle and width and length and spacing and bare <= known:
        yield from _lanes((middle[0], middle[1]), width, length, spacing)


def _lanes(middle: Point, width: float, length: float, spacing: float) -> Iterator[Path]:
    """The lanes of an area, from any corner and in both directions."""
    axes: tuple[g.Axis, ...] = ("y", "x")
    for axis in axes:
        lanes = g.lane_count(width if axis == "y" else length, spacing) if spacing > 0 else None
        if lanes is not None and 2 <= lanes <= MOST_LANES:
            for corner in g.CORNERS:
                yield tuple(g.lawnmower(middle, width, length, spacing, corner, axis))


def _rings(ground: Ground) -> Iterator[Path]:
    """Squares, or their corners or mid-sides, and points evenly round circles; each also closed."""
    ways, counts = (False, True), [count for count in ground.counts if count >= 3]
    for centre, radius in itertools.product(ground.places, ground.lengths):
        rings = []
        for start, clockwise in itertools.product(g.SQUARE_STARTS, ways):
            square = g.survey_square(centre, radius, start, clockwise=clockwise)
            rings += [square, square[::2]]
        bearings = dict.fromkeys((*ground.bearings, 0, 90))
        for count, clockwise, bearing in itertools.product(counts, ways, bearings):
            rings.append(g.circle(centre, radius, count, bearing, clockwise=clockwise))
        for ring in rings:
            yield tuple(ring)
            yield (*ring, ring[0])
