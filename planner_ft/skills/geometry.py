"""Outlines of structures, the five published families and held-out ones; rays, distances and the
hull, for a batch of vehicles each before an outline of its own.

An outline (150, 2) in m has its points counter-clockwise, evenly by arc length (published). Where
the study gives a shape's proportions and no size, its corners lie about the base radius off its
centre.
"""

import math
from collections.abc import Callable

import numpy as np
import shapely
import torch
from shapely import affinity
from torch import Tensor

from planner_ft.simulation.fast import Floats
from planner_ft.skills.dynamics import turned

POINTS = 150
RADIUS = (3.0, 10.0)
Draw = Callable[[np.random.Generator], shapely.Polygon]


def _box(random: np.random.Generator) -> tuple[float, float]:
    aspect = math.sqrt(random.uniform(0.65, 1.45))
    return aspect / math.sqrt(2), 1 / aspect / math.sqrt(2)


def _rectangle(random: np.random.Generator) -> shapely.Polygon:
    wide, high = _box(random)
    return shapely.box(-wide, -high, wide, high)


def _ell(random: np.random.Generator) -> shapely.Polygon:
    wide, high = _box(random)
    cut = random.uniform(0.25, 0.55, 2)
    corner = shapely.box(wide - 2 * wide * cut[0], high - 2 * high * cut[1], 2 * wide, 2 * high)
    return shapely.box(-wide, -high, wide, high).difference(corner)


def _polygon(random: np.random.Generator) -> shapely.Polygon:
    corners = int(random.integers(5, 10))
    angle = 2 * np.pi * np.arange(corners) / corners
    return _polar(angle, random.uniform(0.7, 1.2, corners))


def _abstract(random: np.random.Generator) -> shapely.Polygon:
    angle = np.linspace(0, 2 * np.pi, 240, endpoint=False)
    radius = np.ones_like(angle)
    for order in (2, 3, 5):
        size, phase = random.uniform(-0.3, 0.3), random.uniform(0, 2 * np.pi)
        radius += size * np.cos(order * angle + phase)
    return _polar(angle, np.clip(radius, 0.55, 1.45))


def _star(random: np.random.Generator) -> shapely.Polygon:
    tips = int(random.integers(4, 7))
    radius = np.tile([1.0, random.uniform(0.45, 0.65)], tips)
    return _polar(np.pi * np.arange(2 * tips) / tips, radius)


def _u(random: np.random.Generator) -> shapely.Polygon:
    wide, high = _box(random)
    slot, depth = random.uniform(0.25, 0.5), random.uniform(0.4, 0.7)
    gap = shapely.box(-wide * slot, high - 2 * high * depth, wide * slot, 2 * high)
    return shapely.box(-wide, -high, wide, high).difference(gap)


def _joined(random: np.random.Generator) -> shapely.Polygon:
    first, second = random.uniform(0.45, 0.65, 2)
    apart = random.uniform(0.75, 0.95) * (first + second)
    left = shapely.Point(-apart / 2, 0).buffer(first, quad_segs=24)
    return left.union(shapely.Point(apart / 2, 0).buffer(second, quad_segs=24))


def _polar(angle: Floats, radius: Floats) -> shapely.Polygon:
    corners = np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=1)
    return shapely.Polygon(corners).buffer(0)


PUBLISHED: dict[str, Draw] = {
    "circle": lambda _random: shapely.Point(0, 0).buffer(1.0, quad_segs=40),
    "rectangle": _rectangle,
    "L": _ell,
    "polygon": _polygon,
    "abstract": _abstract,
}
HELD_OUT: dict[str, Draw] = {"star": _star, "U": _u, "two circles": _joined}
FAMILIES = PUBLISHED | HELD_OUT


def draw_outline(
    family: str, random: np.random.Generator, sizes: tuple[float, float] = RADIUS
) -> Floats:
    """An outline (150, 2), base radius in `sizes`, any rotation, its centre up to a metre off."""
    shape = FAMILIES[family](random)
    size, turn = random.uniform(*sizes), random.uniform(0, 360)
    shape = affinity.rotate(affinity.scale(shape, size, size, origin=(0, 0)), turn, origin=(0, 0))
    return outline_of(affinity.translate(shape, *random.uniform(-1, 1, 2)))


def outline_of(shape: shapely.Polygon, points: int = POINTS) -> Floats:
    """Points (n, 2) of a polygon's edge, counter-clockwise, evenly by arc length."""
    edge = shapely.Polygon(shape.exterior).normalize().exterior  # clockwise
    along = np.linspace(edge.length, 0, points, endpoint=False)
    return np.asarray(shapely.get_coordinates(shapely.line_interpolate_point(edge, along)))


def offset_path(outline: Floats, standoff: float, rounding: float, points: int) -> Floats:
    """The way (points, 2) at a stand-off round an outline. Where the outline is hollow the way is
    rounded to a radius of `rounding` m, which keeps it farther off there.
    """
    around = shapely.Polygon(outline).buffer(standoff + rounding, quad_segs=16)
    way = shapely.Polygon(around.exterior).buffer(-rounding, quad_segs=16)
    return outline_of(way, points)


RAYS, REACH = 64, 10.0
"""LiDAR rays over 360 degrees counter-clockwise from the bow, and their range in m (published)."""
TOUCH = 0.25 + 0.02  # metres between a boundary point and the hull at which they touch (published)
HULL = ((-1.5, -0.7), (0.5, -0.7), (1.5, 0.0), (0.5, 0.7), (-1.5, 0.7))
"""Flat stern and tapered bow, counter-clockwise, in m; where the taper begins is assumed."""
HULL_RADIUS = math.hypot(1.5, 0.7)
CHUNK = 32  # vehicles whose rays are cast at once, so that they fit a processor's cache


def ray_angles() -> Tensor:
    """Angles (64,) from the bow in rad."""
    return torch.arange(RAYS) * (2 * math.pi / RAYS)


def ranges(pose: Tensor, outline: Tensor) -> Tensor:
    """Ranges (B, 64) of vehicles at `pose` (B, 3) to outlines (B, N, 2); 10 m where nothing is."""
    angles = ray_angles()
    ahead = torch.stack([torch.cos(angles), torch.sin(angles)])
    aside = torch.stack([-torch.sin(angles), torch.cos(angles)])
    found = []
    for start in range(0, len(pose), CHUNK):
        some = pose[start : start + CHUNK]
        body = to_body(outline[start : start + CHUNK], some)
        body = torch.cat([body, body[:, :1]], dim=1)
        along, off = body @ ahead, body @ aside
        first, second = off[:, :-1], off[:, 1:]
        part = first / (first - second)
        far = torch.lerp(along[:, :-1], along[:, 1:], part)
        hit = (first * second <= 0) & (far > 0)
        found.append(torch.where(hit, far, REACH).amin(dim=1))
    return torch.cat(found).clamp_max(REACH)


def to_body(points: Tensor, pose: Tensor) -> Tensor:
    """World points (B, N, 2) in the axes of vehicles at `pose` (B, 3)."""
    return turned(points - pose[:, None, :2], -pose[:, 2:3])


def nearest(place: Tensor, outline: Tensor) -> tuple[Tensor, Tensor]:
    """Distance (B,) of places (B, 2) to the nearest boundary point, and its index (B,)."""
    away, index = (outline - place[:, None]).square().sum(dim=-1).min(dim=1)
    return away.sqrt(), index


def inside(place: Tensor, outline: Tensor) -> Tensor:
    """Whether places (B, 2) lie in their outlines (B,), by crossings of a ray."""
    first = outline - place[:, None]
    second = first.roll(-1, dims=1)
    crosses = (first[..., 1] > 0) != (second[..., 1] > 0)
    rise = second[..., 1] - first[..., 1]
    at = first[..., 0] - first[..., 1] * (second[..., 0] - first[..., 0]) / rise
    return (crosses & (at > 0)).sum(dim=1) % 2 == 1


def hull_distance(body: Tensor) -> Tensor:
    """Metres from points (..., 2) in body axes to the hull; 0 inside."""
    corners = body.new_tensor(HULL)
    edges = corners.roll(-1, dims=0) - corners
    to = body[..., None, :] - corners
    part = ((to * edges).sum(-1) / edges.square().sum(-1)).clamp(0, 1)
    away = (to - part[..., None] * edges).norm(dim=-1).amin(dim=-1)
    left = edges[:, 0] * to[..., 1] - edges[:, 1] * to[..., 0]
    return torch.where((left >= 0).all(dim=-1), 0.0, away)


def touching(pose: Tensor, outline: Tensor, away: Tensor) -> Tensor:
    """Whether a boundary point touches the hull (B,); `away` (B,) are distances to the nearest."""
    if torch.compiler.is_compiling():  # no shapes that hang on values
        return hull_distance(to_body(outline, pose)).amin(dim=1) < TOUCH
    close = torch.nonzero(away < HULL_RADIUS + TOUCH)[:, 0]
    touched = torch.zeros(len(pose), dtype=torch.bool)
    if len(close):
        points = to_body(outline[close], pose[close])
        touched[close] = hull_distance(points).amin(dim=1) < TOUCH
    return touched
