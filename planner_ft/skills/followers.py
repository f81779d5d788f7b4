"""Baselines: a contour follower on the same rays, the oracle's way, and guidance for GoToXY.

An actor is called with a `Survey` and gives actions (B, 2); a tracker has `limits` and `command`,
as the learnt policy has.
"""

from __future__ import annotations

import math

import torch
from torch import Tensor

from planner_ft.simulation.guidance import BRAKE, SLOW
from planner_ft.skills import geometry
from planner_ft.skills.dynamics import turned, wrapped
from planner_ft.skills.survey import Survey, action_of
from planner_ft.skills.tracker import Tracker

LOOK = 2.5
"""Metres ahead on the way to which a waypoint is named."""
PUSHES = 3


class Follower:
    """Keeps the nearest return abeam to port: a waypoint ahead along the wall, pushed off until it
    keeps the stand-off from all returns.
    """

    def __call__(self, survey: Survey) -> Tensor:
        scan, standoff = survey.scan, survey.standoff
        angles = geometry.ray_angles()
        rays = torch.stack([torch.cos(angles), torch.sin(angles)], dim=1)
        hits = scan[..., None] * rays
        seen = scan < geometry.REACH
        away, ray = scan.min(dim=1)
        wall = rays[ray]
        along = torch.stack([wall[:, 1], -wall[:, 0]], dim=1)
        off = (away - standoff).clamp(-LOOK, LOOK)
        place = LOOK * along + off[:, None] * wall
        for _push in range(PUSHES):
            to = hits - place[:, None]
            far = to.norm(dim=2).masked_fill(~seen, math.inf)
            least, which = far.min(dim=1)
            direction = to[torch.arange(len(to)), which] / least.clamp_min(1e-6)[:, None]
            push = torch.where(least.isfinite(), least - standoff, 0.0).clamp_max(0.0)
            place = place + push[:, None] * direction
        pose = survey.pose
        return action_of(pose[:, :2] + turned(place, pose[:, 2]), pose)


class Oracle:
    """Knows the outline: a waypoint `look` m ahead on the way at the stand-off."""

    def __init__(self, look: float = LOOK) -> None:
        self.look = look

    def __call__(self, survey: Survey) -> Tensor:
        place, way = survey.state[:, :2], survey.way
        away = (way - place[:, None]).square().sum(dim=2)
        at = away.argmin(dim=1)
        spacing = (way[:, 1:] - way[:, :-1]).norm(dim=2).mean(dim=1)
        ahead = (self.look / spacing).round().long()
        row = torch.arange(len(way))
        target = way[row, (at + ahead) % way.shape[1]]
        return action_of(target, survey.pose)


class Guidance:
    """Course to the goal by a proportional controller, speed by the distance that is left, as
    `simulation.guidance` steers to the end of a way.
    """

    def __init__(self, tracker: Tracker) -> None:
        self.limits = tracker.limits

    def command(self, state: Tensor, goal: Tensor) -> Tensor:
        """Commanded surge in m/s and yaw rate in rad/s (B, 2)."""
        to = goal[:, :2] - state[:, :2]
        left = to.norm(dim=1)
        slip = torch.atan2(state[:, 4], state[:, 3].clamp_min(0.3)) * (state[:, 3] > 0.3)
        error = wrapped(torch.atan2(to[:, 1], to[:, 0]) - state[:, 2] - slip)
        speed = (SLOW + torch.sqrt(2 * BRAKE * left)).minimum(self.limits[0])
        turn = (0.9 * error).clamp(-self.limits[1], self.limits[1])
        return torch.stack([speed * torch.cos(error).clamp(0, 1) ** 2, turn], dim=1)
