"""The vessel of `planner_ft.simulation.fast` with its autopilot in torch, batched, differentiable;
and who drives it to a goal: the policies of GoToXY and StationKeep, which make two speeds of six
numbers of the goal, and guidance beside them.

A state (B, 8) is x, y in m, yaw in rad, surge, sway in m/s, yaw rate in rad/s over ground in the
body's axes (REP-103), and the sums of the autopilot's two integrals. Without wind.
"""

import math
from dataclasses import dataclass
from typing import Any

import torch
from torch import Tensor, nn

from planner_ft.simulation.fast import STEP, Vessel, build_vessel
from planner_ft.simulation.guidance import BRAKE, SLOW
from planner_ft.simulation.scene import MOST_YAW
from planner_ft.vocabulary import load_vocabulary
from planner_ft.vocabulary.definition import VEHICLE

CURRENT = (0.02, 0.08)  # m/s (published)
TURN = 0.43  # rad/s (published); the profile of a plan may allow less
LEAK = 0.1  # share of the gradient that passes a limit, so that saturated thrusters still learn


def published_vessel() -> Vessel:
    """The published vehicle, which usv.simulation.toml describes."""
    vocabulary = load_vocabulary("usv")
    profile = {**vocabulary.beside(VEHICLE), "turn_rate": math.degrees(TURN)}
    return build_vessel(vocabulary, profile)


@dataclass(frozen=True)
class Dynamics:
    """One time step of a batch. `leak`: gradients pass limits, for training through it."""

    vessel: Vessel
    leak: bool = False

    def __call__(
        self, state: Tensor, command: Tensor, current: Tensor, limits: Tensor | None = None
    ) -> Tensor:
        """The next state (B, 8) under commanded surge in m/s and yaw rate in rad/s (B, 2), in water
        that moves with `current` (B, 2) in m/s; `limits` (B, 2) are lower speed limits than the
        vessel's own.
        """
        own, dt = self.vessel, STEP
        speed, turn = (own.speed, own.turn) if limits is None else limits.unbind(-1)
        x, y, yaw, surge, sway, rate, sum_surge, sum_rate = state.unbind(-1)
        want_surge = self._clip(command[:, 0], own.speed if limits is None else speed)
        want_rate = self._clip(command[:, 1], turn)
        force, moment, sum_surge, sum_rate = self._autopilot(
            *(want_surge, want_rate, surge, rate, sum_surge, sum_rate)
        )
        cosine, sine = torch.cos(yaw), torch.sin(yaw)
        water_x = cosine * current[:, 0] + sine * current[:, 1]
        water_y = cosine * current[:, 1] - sine * current[:, 0]
        drag = own.drag
        u = (surge + dt * (force / own.mass + sway * rate + drag[0] * water_x)) / (1 + dt * drag[0])
        v = (sway + dt * (drag[1] * water_y - surge * rate)) / (1 + dt * drag[1])
        r = (rate + dt * moment / own.inertia) / (1 + dt * drag[2])
        over = torch.hypot(u - water_x, v - water_y)
        scale = (own.speed / over.clamp_min(1e-9)).clamp_max(1.0)
        u, v = water_x + scale * (u - water_x), water_y + scale * (v - water_y)
        r = self._clip(r, turn)
        middle = yaw + dt / 2 * r
        cosine, sine = torch.cos(middle), torch.sin(middle)
        x, y = x + dt * (cosine * u - sine * v), y + dt * (sine * u + cosine * v)
        return torch.stack([x, y, wrapped(yaw + dt * r), u, v, r, sum_surge, sum_rate], dim=-1)

    def _autopilot(
        self, want: Tensor, turn: Tensor, surge: Tensor, rate: Tensor, first: Tensor, second: Tensor
    ) -> tuple[Tensor, Tensor, Tensor, Tensor]:
        """Force ahead in N, moment in N m and the integrals, as `scene.Autopilot` makes them."""
        own, dt = self.vessel, STEP
        error, spin = want - surge, turn - rate
        first = torch.where(error.abs() < 0.5, (first + 0.3 * dt * error).clamp(-0.5, 0.5), 0.0)
        second = torch.where(spin.abs() < 0.2, (second + dt * spin).clamp(-0.3, 0.3), 0.0)
        ahead = own.mass * (own.drag[0] * want + 1.5 * error + first)
        moment = own.inertia * (own.drag[2] * turn + 3.0 * spin + second)
        steer = self._clip(moment / own.track, MOST_YAW * own.thrust)
        drive = self._clip(ahead / 2, own.thrust - steer.abs())
        return 2 * drive, steer * own.track, first, second

    def _clip(self, value: Tensor, most: Any) -> Tensor:
        """`value` between -most and most, a float or (B,)."""
        clipped = value.clamp(-most, most)
        if not self.leak:
            return clipped
        return clipped + LEAK * ((value - clipped) - (value - clipped).detach())


def wrapped(angle: Tensor) -> Tensor:
    """Angles in rad between -pi and pi."""
    return (angle + math.pi) % (2 * math.pi) - math.pi


def turned(vector: Tensor, angle: Tensor) -> Tensor:
    """Vectors (..., 2) turned counter-clockwise by angles (...) in rad."""
    cosine, sine = torch.cos(angle), torch.sin(angle)
    x, y = vector.unbind(-1)
    return torch.stack([cosine * x - sine * y, sine * x + cosine * y], dim=-1)


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
