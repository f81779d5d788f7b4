"""Rays, distances and the hull against shapely; outlines."""

from __future__ import annotations

import math

import numpy as np
import pytest
import shapely
import torch

from planner_ft.skills import geometry
from planner_ft.skills.geometry import FAMILIES, draw_outline, offset_path

RANDOM = np.random.default_rng(3)
OUTLINES = [draw_outline(family, RANDOM) for family in FAMILIES]
POSES = np.stack(
    [RANDOM.uniform(-14, 14, 40), RANDOM.uniform(-14, 14, 40), RANDOM.uniform(-3, 3, 40)], axis=1
)


@pytest.mark.parametrize("outline", OUTLINES, ids=list(FAMILIES))
def test_rays_as_shapely_casts_them(outline: np.ndarray) -> None:
    ring = shapely.Polygon(outline).exterior
    poses = torch.tensor(POSES, dtype=torch.float32)
    seen = geometry.ranges(poses, torch.tensor(outline, dtype=torch.float32).expand(40, -1, -1))
    for pose, ranges in zip(POSES[:8], seen, strict=False):
        here = shapely.Point(pose[:2])
        for ray in range(0, 64, 5):
            angle = pose[2] + ray * 2 * math.pi / 64
            end = pose[:2] + 10 * np.array([math.cos(angle), math.sin(angle)])
            hit = shapely.LineString([pose[:2], end]).intersection(ring)
            far = 10.0 if hit.is_empty else here.distance(hit)
            assert float(ranges[ray]) == pytest.approx(far, abs=1e-3)


@pytest.mark.parametrize("outline", OUTLINES, ids=list(FAMILIES))
def test_inside_as_shapely_says(outline: np.ndarray) -> None:
    shape = shapely.Polygon(outline)
    places = torch.tensor(POSES[:, :2], dtype=torch.float32)
    found = geometry.inside(places, torch.tensor(outline, dtype=torch.float32).expand(40, -1, -1))
    assert found.tolist() == [shape.contains(shapely.Point(place)) for place in POSES[:, :2]]


def test_the_hull_is_touched_at_its_bow_and_not_beside_it() -> None:
    outline = torch.tensor([[[1.7, 0.0], [9.0, 9.0]], [[1.4, 0.6], [9.0, 9.0]]])
    poses = torch.zeros(2, 3)
    away = geometry.nearest(poses[:, :2], outline)[0]
    assert geometry.touching(poses, outline, away).tolist() == [True, False]
    hull = shapely.Polygon(geometry.HULL)
    body = torch.tensor(POSES[:, :2] / 6, dtype=torch.float32)
    far = [hull.distance(shapely.Point(place)) for place in body.tolist()]
    assert geometry.hull_distance(body).tolist() == pytest.approx(far, abs=1e-5)


@pytest.mark.parametrize("outline", OUTLINES, ids=list(FAMILIES))
def test_outlines_are_counter_clockwise_and_even(outline: np.ndarray) -> None:
    shape = shapely.Polygon(outline)
    assert shape.is_valid and shape.exterior.is_ccw and len(outline) == 150
    sides = np.linalg.norm(np.roll(outline, -1, axis=0) - outline, axis=1)
    assert np.median(sides) == pytest.approx(sides.max(), rel=0.02)


@pytest.mark.parametrize("outline", OUTLINES, ids=list(FAMILIES))
def test_the_way_keeps_the_stand_off_and_more_in_hollows(outline: np.ndarray) -> None:
    shape = shapely.Polygon(outline)
    way = shapely.distance(shape, shapely.points(offset_path(outline, 5.0, 1.5, 256)))
    assert way.min() > 4.9 and np.median(way) == pytest.approx(5, abs=0.05)
    sharp = shapely.distance(shape, shapely.points(offset_path(outline, 5.0, 0.0, 256)))
    assert way.max() >= sharp.max() - 0.01
