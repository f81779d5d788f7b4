"""Rays, distances and the hull, for a batch of vehicles each before an outline of its own."""

from __future__ import annotations

import math

import torch
from torch import Tensor

from planner_ft.skills.dynamics import turned

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
