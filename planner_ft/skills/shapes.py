"""Outlines of structures: the five published families and held-out ones.

An outline (150, 2) in m has its points counter-clockwise, evenly by arc length (published). Where
the study gives a shape's proportions and no size, its corners lie about the base radius off its
centre.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import shapely
from shapely import affinity

from planner_ft.simulation.fast import Floats

POINTS = 150
RADIUS = (3.0, 10.0)
Draw = Callable[[np.random.Generator], shapely.Polygon]


def _circle(random: np.random.Generator) -> shapely.Polygon:
    return shapely.Point(0, 0).buffer(1.0, quad_segs=40)


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
    return shapely.Polygon(
        np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=1)
    ).buffer(0)


PUBLISHED: dict[str, Draw] = {
    "circle": _circle,
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
    """An outline (150, 2) with a base radius in `sizes`, of any rotation, its centre up to a metre
    off.
    """
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
