"""Where a vehicle can go next, and where its way may end: stated places, points a stated way off,
and paths that are run to their end.
"""

from __future__ import annotations

import functools
import itertools
from dataclasses import dataclass, replace
from typing import Literal

from planner_ft.data.quantities import ROUNDING
from planner_ft.data.task import geometry as g
from planner_ft.data.task.working import SUM
from planner_ft.decoding.constraints.derived_paths import Path, Point
from planner_ft.decoding.constraints.reading.paths.halts import Halts, halts_at

Ending = Literal["not yet", "may", "must"]


@dataclass(frozen=True)
class Ground:
    """The facts that waypoints are derived from. `free`: they cannot be read with certainty, and
    any waypoint may be meant. `itinerary`: they leave no choice, these are the waypoints (or there
    are none); with `alone` the task asks for no movement beside its waypoints.

    `shaped`: the task is one of the paths, run once; other waypoints are the places `apart` from
    it.

    `halts`: where on the one path something else is done than to go on.

    `stays` says that the vehicle may come to a place again, or stay where it is. A path counts as
    begun with `begun` of its waypoints in a row: with fewer where the task is about such a path,
    since two moves can look like the beginning of many. `worked` are coordinates that the answer
    derives itself.
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
        """The ground with the coordinates that a working (see planner_ft.data.task.working) derives
        from these facts; wrong sums derive nothing.
        """
        found = tuple({place[axis] for place in self.places} for axis in (0, 1))
        stated, lengths = tuple(map(frozenset, found)), set(self.lengths)
        for axis, base, sign, away, result in SUM.findall(working):
            one, other, value = float(base), float(away), float(result)
            if sign == "/" and one in lengths and other and abs(one / other - value) <= ROUNDING:
                lengths.add(value)
            elif (
                axis
                and one in found["xy".index(axis)]
                and other in lengths
                and abs(one + (other if sign == "+" else -other) - value) <= ROUNDING
            ):
                found["xy".index(axis)].add(g.tidy(value))
        return (
            replace(self, worked=(frozenset(found[0]), frozenset(found[1])))
            if found != stated
            else self
        )

    def following(self, before: Path) -> list[Point]:
        """The waypoints that may follow those `before`: other places, unless the text speaks of
        coming back.
        """
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
        away = (
            g.offset(base, bearing, length)
            for base in bases
            for length in self.lengths
            for bearing in self.bearings
        )
        derived = itertools.product(*self.worked)
        options = dict.fromkeys(
            itertools.chain(self.places, before, self._starts, onward, away, derived)
        )
        return [point for point in options if self.stays or point not in before]

    def ending(self, before: Path) -> Ending:
        """Whether the answer may, must or may not yet end behind these waypoints: no path is left
        half-way.
        """
        if self.itinerary is not None:
            done = len(before) >= len(self.itinerary)
            return "not yet" if not done else "must" if self.alone else "may"
        if self.shaped and any(_within(path, before) for path in self.paths):
            return "must" if self.alone and not self.apart else "may"
        begun = self._begun(before)
        ends = (
            not begun or begun[0][1] < self.begun or any(done == len(path) for path, done in begun)
        )
        return "may" if ends else "not yet"

    def halts_here(self, before: Path) -> bool | None:
        """Whether a step that goes nowhere must (True) or must not (False) stand behind these
        waypoints; None where the model decides.
        """
        paths = (
            [self.itinerary]
            if self.itinerary is not None
            else (
                [path for path in self.paths if path[: len(before)] == before]
                if self.shaped
                else []
            )
        )
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
        return (
            (self.itinerary,)
            if self.itinerary
            else self.paths
            if self.shaped and not self.apart
            else ()
        )

    @property
    def waypoints_alone(self) -> bool:
        """Whether every step goes to a waypoint."""
        return self.alone and (self.itinerary is not None or self.shaped)

    def _begun(self, before: Path) -> list[tuple[Path, int]]:
        """Paths of which the last waypoints are the beginning, with how many: those with the
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


def _within(path: Path, before: Path) -> bool:
    """Whether a path was run."""
    return any(
        before[place : place + len(path)] == path for place in range(len(before) - len(path) + 1)
    )
