"""Who drives to a goal: the policies of GoToXY and StationKeep, which make two speeds of six
numbers of the goal, and guidance beside them.
"""

from __future__ import annotations

import torch
from torch import Tensor, nn

from planner_ft.simulation.guidance import BRAKE, SLOW
from planner_ft.skills.dynamics import turned, wrapped

HIDDEN = 64
FAR, NEAR = 10.0, 0.3  # metres at which a position is clipped, and that tell near goals apart
CLOSE = 1.5  # metres within which the way to a goal says no heading any more


def relative(state: Tensor, goal: Tensor) -> Tensor:
    """The published six numbers (B, 6) of states (B, 8) and goals (B, 3: x, y, heading): position
    and velocity relative to the goal in the goal's frame, wrapped heading error, yaw rate.
    """
    heading = goal[:, 2]
    place = turned(state[:, :2] - goal[:, :2], -heading)
    velocity = turned(state[:, 3:5], state[:, 2] - heading)
    error = wrapped(state[:, 2] - heading)
    return torch.cat([place, velocity, error[:, None], state[:, 5:6]], dim=1)


def aimed(state: Tensor, goal: Tensor) -> Tensor:
    """Goals (B, 3) whose heading is the way to them, for who only wants to get there; within
    `CLOSE` the heading is kept.
    """
    to = goal[:, :2] - state[:, :2].detach()
    bearing = torch.atan2(to[:, 1], to[:, 0])
    heading = torch.where(to.norm(dim=1) > CLOSE, bearing, goal[:, 2])
    return torch.cat([goal[:, :2], heading[:, None]], dim=1)


class Tracker(nn.Module):
    """Speeds in shares of the limits (B, 2: surge, yaw rate), from six numbers (B, 6)."""

    limits: Tensor

    def __init__(self, limits: tuple[float, float]) -> None:
        super().__init__()
        self.register_buffer("limits", torch.tensor(limits))
        layers = [nn.Linear(9, HIDDEN), nn.Tanh(), nn.Linear(HIDDEN, HIDDEN), nn.Tanh()]
        self.layers = nn.Sequential(*layers, nn.Linear(HIDDEN, 2), nn.Tanh())

    def forward(self, seen: Tensor) -> Tensor:
        place, velocity, error, rate = torch.split(seen, [2, 2, 1, 1], dim=1)
        away = place.norm(dim=1, keepdim=True)
        far = place / away.clamp_min(FAR)
        near = place / (away + NEAR)
        scaled = velocity / self.limits[0]
        turn = rate / self.limits[1]
        features = [far, near, scaled, torch.sin(error), torch.cos(error), turn]
        made: Tensor = self.layers(torch.cat(features, dim=1))
        return made

    def command(self, state: Tensor, goal: Tensor) -> Tensor:
        """Commanded surge in m/s and yaw rate in rad/s (B, 2)."""
        made: Tensor = self(relative(state, goal)) * self.limits
        return made


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
