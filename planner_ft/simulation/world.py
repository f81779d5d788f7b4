"""The simulated water: structures, objects, seabed, fences, current and wind, and what fails."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from planner_ft.document.structures import MARGIN, Allowed, Structure
from planner_ft.document.track import Point
from planner_ft.simulation.asked import Faults
from planner_ft.simulation.fast import Floats, Vessel
from planner_ft.support.errors import PlannerError

PILE = 0.5  # metres: radius of a structure, which a plan knows as a point. ASSUMPTION
CURRENT = (0.02, 0.08)  # m/s, drawn for each run with a direction (published)
DEPTH, SLOPE, WAVES = 12.0, 0.02, ((1.5, 45.0), (0.6, 17.0))
"""The seabed: metres below [0, 0], gradient along a drawn bearing, (height, length) of swells."""


@dataclass(frozen=True)
class Fence:
    """A polygon that the vehicle must stay in, or out of."""

    polygon: tuple[Point, ...]
    inside: bool = True

    def outside_by(self, places: Floats) -> Floats:
        """Metres by which places (n, 2) break the fence; negative: how far they keep it."""
        import shapely

        area = shapely.Polygon(self.polygon)
        points = shapely.points(places)
        edge = shapely.distance(area.exterior, points)
        held = shapely.covers(area, points) == self.inside
        return np.asarray(np.where(held, -edge, edge), dtype=float)

    def nearest(self, places: Floats) -> Floats:
        """The nearest points of the edge (n, 2)."""
        import shapely

        edge = shapely.Polygon(self.polygon).exterior
        points = shapely.points(places)
        found = shapely.line_interpolate_point(edge, shapely.line_locate_point(edge, points))
        return np.asarray(shapely.get_coordinates(found), dtype=float)


@dataclass(frozen=True)
class Reach:
    """A distance from a place that the vehicle must stay within; half a metre more is let pass."""

    center: Point
    metres: float

    def outside_by(self, places: Floats) -> Floats:
        """Metres by which places (n, 2) lie farther off; negative: how far they keep it."""
        away = np.linalg.norm(places - np.array(self.center), axis=1)
        return np.asarray(away - self.metres - MARGIN, dtype=float)


@dataclass(eq=False)
class World:
    """What stands in the water and what the water does, for B runs of one seed: `structures` where
    they are, `charted` where the plan has them; `allowed` legs keep the fences.
    """

    vessel: Vessel
    home: Point
    charted: Sequence[Structure]
    structures: Sequence[Structure]
    objects: Mapping[str, Point]
    fences: Sequence[Fence]
    allowed: Allowed
    faults: Faults
    runs: int
    seed: int

    def __post_init__(self) -> None:
        self.generator = np.random.default_rng([self.seed, 1])
        speed = self.generator.uniform(*CURRENT, self.runs)
        self.current = speed[:, None] * _unit(self.generator.uniform(0, 2 * np.pi, self.runs))
        self._directions = self.generator.uniform(0, 2 * np.pi, self.runs)
        swell = np.random.default_rng([self.seed, 2])
        self._bearing, *self._phases = swell.uniform(0, 2 * np.pi, 1 + 2 * len(WAVES))
        self.piles = np.array([one.position for one in self.structures], float).reshape(-1, 2)
        self.outlines: dict[int, Floats] = {}
        """Corners (n, 2) of structures that are more than a pile, by number."""

    def add_outline(self, name: str, corners: Floats) -> None:
        """Give a structure an outline, by corners about its place. Raises PlannerError."""
        for number, one in enumerate(self.structures):
            if one.name.lower() == name.lower():
                self.outlines[number] = corners + self.piles[number]
                return
        known = ", ".join(one.name for one in self.structures) or "none"
        raise PlannerError(f"--outline {name}: is no structure of the plan; there is {known}")

    @property
    def round(self) -> Floats:
        """The places (s, 2) of structures that are piles."""
        kept = [number for number in range(len(self.piles)) if number not in self.outlines]
        return self.piles[kept]

    def currents(self, time: float) -> Floats:
        """The current (B, 2) in m/s: a fault's beside the drawn one."""
        return self.current + self._flow(time, "current")

    def winds(self, time: float) -> Floats:
        """The wind (B, 2) in m/s, where it blows to."""
        return self._flow(time, "wind")

    def _flow(self, time: float, kind: str) -> Floats:
        """Where water or air move to; a fault says where a wind comes from."""
        total = np.zeros((len(self._directions), 2))
        for fault in self.faults.active(kind, time):
            angle = self._directions
            if fault.bearing is not None:
                compass = fault.bearing + (180 if kind == "wind" else 0)
                angle = np.full(len(total), math.radians(90 - compass))
            total += fault.value * _unit(angle)
        return total

    def depth(self, x: float, y: float) -> float:
        """Metres of water: a slope with swells across it, the same for one seed."""
        along = x * math.cos(self._bearing) + y * math.sin(self._bearing)
        depth, phases = DEPTH + SLOPE * along, self._phases
        for (height, length), phase, turn in zip(WAVES, phases[::2], phases[1::2], strict=True):
            across = x * math.cos(turn) + y * math.sin(turn)
            depth += height * math.sin(2 * math.pi * across / length + phase)
        return max(1.0, depth)

    def ranges(self, pose: Floats, time: float) -> Floats:
        """LiDAR ranges (n, rays) of vehicles at `pose` (n, 4): counter-clockwise from the bow,
        infinite where nothing is hit or the ray is lost.
        """
        own = self.vessel
        found = np.full((len(pose), own.rays), np.inf)
        if not own.rays or not len(self.piles):
            return found
        angles = pose[:, 3:4] + self.ray_angles
        ahead = np.stack([np.cos(angles), np.sin(angles)], axis=-1)
        if len(self.round):
            found = _to_circles(pose[:, :2], ahead, self.round)
        for corners in self.outlines.values():
            found = np.minimum(found, _to_edges(pose[:, :2], ahead, corners))
        found[found > own.reach] = np.inf
        for fault in self.faults.active("lidar", time):
            found[self.generator.random(found.shape) < fault.value] = np.inf
        return np.asarray(np.maximum(found, 0.0), dtype=float)

    @property
    def ray_angles(self) -> Floats:
        """Angles of the rays from the bow in rad, counter-clockwise."""
        return np.arange(self.vessel.rays) * 2 * np.pi / max(1, self.vessel.rays)

    def nearest(self, places: Floats) -> Floats:
        """Metres from places (n, 2) to the surface of the nearest structure."""
        found = np.full(len(places), np.inf)
        if len(self.round):
            away = np.linalg.norm(places[:, None] - self.round[None], axis=-1)
            found = np.asarray(away.min(axis=1) - PILE, dtype=float)
        for corners in self.outlines.values():
            edge = Fence(tuple(map(tuple, corners)), inside=False)
            found = np.minimum(found, -edge.outside_by(places))
        return found

    def find(self, name: Any) -> tuple[str, Point] | None:
        """The object of a name: the same, or one name part of the other; None without one."""
        wanted = str(name).strip().lower()
        exact = [key for key in self.objects if key.lower() == wanted]
        part = [key for key in self.objects if key.lower() in wanted or wanted in key.lower()]
        found = next(iter(exact or (part if wanted else [])), None)
        return None if found is None else (found, self.objects[found])


def _to_circles(places: Floats, ahead: Floats, centers: Floats) -> Floats:
    """Ranges (n, rays) from places (n, 2) along unit vectors (n, rays, 2) to piles."""
    to = centers[None] - places[:, None]
    along = np.einsum("nrk,nsk->nrs", ahead, to)
    off = (to**2).sum(-1)[:, None] - along**2
    chord = PILE**2 - off
    hit = np.where((chord > 0) & (along > 0), along - np.sqrt(np.maximum(chord, 0)), np.inf)
    return np.asarray(hit.min(axis=-1), dtype=float)


def _to_edges(places: Floats, ahead: Floats, corners: Floats) -> Floats:
    """Ranges (n, rays) from places (n, 2) along unit vectors (n, rays, 2) to a polygon's edges."""
    first = corners[None] - places[:, None]
    aside = np.stack([-ahead[..., 1], ahead[..., 0]], axis=-1)
    along = np.einsum("nrk,nsk->nrs", ahead, first)
    off = np.einsum("nrk,nsk->nrs", aside, first)
    next_along, next_off = np.roll(along, -1, axis=-1), np.roll(off, -1, axis=-1)
    crosses = (off > 0) != (next_off > 0)
    part = off / np.where(crosses, off - next_off, 1.0)
    far = along + part * (next_along - along)
    return np.asarray(np.where(crosses & (far > 0), far, np.inf).min(axis=-1), dtype=float)


def _unit(angle: Floats) -> Floats:
    return np.stack([np.cos(angle), np.sin(angle)], axis=1)
