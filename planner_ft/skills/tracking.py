"""Training GoToXY and StationKeep: gradients flow through the batched dynamics.

No critic and no samples of actions: the cost of a whole episode is differentiated by the weights
(backpropagation through time, as in Xu et al., Accelerated Policy Learning with Parallel
Differentiable Simulation, 2022, without its critic), which takes minutes on one core. The published
policies were actor-critics; task, inputs and outputs are theirs.
"""

import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import torch
from torch import Generator, Tensor
from torch.optim import Adam
from torch.optim.lr_scheduler import CosineAnnealingLR

from planner_ft.skills.dynamics import Dynamics, Tracker, aimed, published_vessel, relative, wrapped
from planner_ft.skills.policies import Checkpoint
from planner_ft.support.terminal import Report


@dataclass(frozen=True)
class Settings:
    """Episodes (`batch`) of `steps` time steps an iteration; `current` in m/s at most."""

    skill: str = "goto"
    seed: int = 0
    iterations: int = 160
    batch: int = 192
    steps: int = 120
    window: int = 60  # time steps through which gradients flow
    rate: float = 3e-3
    norm: float = 1.0
    current: float = 0.2
    noise: float = 0.05  # metres by which the believed position is off, slowly changing


HOLD = {"skill": "hold", "iterations": 300, "noise": 0.1}
"""What StationKeep's training has otherwise: it stays, so that errors of the position tell."""


def draw(
    skill: str, count: int, most: float, random: Generator, turn: float
) -> tuple[Tensor, Tensor, Tensor, Tensor]:
    """Starts of episodes of a skill: states (B, 8), goals (B, 3), currents and limits (B, 2). A
    hold starts at its place, the goal's heading against the current, and a way begins up to 25 m
    off in any direction, its goal's heading along it.
    """

    def uniform(low: float, high: float) -> Tensor:
        return low + (high - low) * torch.rand(count, generator=random)

    angle, speed = uniform(-math.pi, math.pi), uniform(0.0, most)
    current = torch.stack([speed * torch.cos(angle), speed * torch.sin(angle)], dim=1)
    bearing, yaw = uniform(-math.pi, math.pi), uniform(-math.pi, math.pi)
    hold = skill == "hold"
    away = uniform(0.0, 1.2) if hold else 0.5 + 24.5 * uniform(0.0, 1.0) ** 1.5
    heading = angle + math.pi + uniform(-0.4, 0.4) if hold else bearing
    place = -away[:, None] * torch.stack([torch.cos(bearing), torch.sin(bearing)], dim=1)
    state = torch.zeros(count, 8)
    state[:, :2], state[:, 2] = place, yaw
    state[:, 3] = uniform(0.0, 1.2 if hold else 2.0)
    state[:, 5] = uniform(-0.3, 0.3)
    goal = torch.stack([torch.zeros(count), torch.zeros(count), wrapped(heading)], dim=1)
    limits = torch.stack([uniform(0.8, 2.3), uniform(0.8 * turn, turn)], dim=1)
    return state, goal, current, limits


def cost(skill: str, state: Tensor, goal: Tensor, made: Tensor, before: Tensor) -> Tensor:
    """What a time step costs (B,): distance, going where the goal is not, and jerks."""
    away = (state[:, :2] - goal[:, :2]).square().sum(dim=1)
    off = 1 - torch.cos(state[:, 2] - goal[:, 2])
    jerk = (made - before).square().sum(dim=1)
    if skill == "hold":
        return torch.sqrt(away + 0.02**2) + 0.05 * off + 0.02 * jerk
    far, speed = torch.sqrt(away + 0.1**2), state[:, 3].square()
    astray, fast = 0.3 * off * speed, 0.3 * speed * torch.exp(-away)
    return far / 5 + far / (1 + far) + 0.03 * off + astray + fast + 0.005 * jerk


def train(settings: Settings, folder: Path, resume: bool, report: Report) -> dict[str, Any]:
    """Train a policy and keep checkpoints in `folder`; the state of the policy and its losses."""
    torch.manual_seed(settings.seed)
    vessel = published_vessel()
    policy = Tracker((vessel.speed, vessel.turn))
    optimizer = Adam(policy.parameters(), lr=settings.rate)
    schedule = CosineAnnealingLR(optimizer, settings.iterations, settings.rate / 30)
    random = Generator().manual_seed(settings.seed)
    kept = Checkpoint(folder, settings, random, policy, optimizer, schedule, resume=resume)
    dynamics = Dynamics(vessel, leak=True)
    while kept.done < settings.iterations:
        loss = _iterate(settings, policy, optimizer, dynamics, random)
        schedule.step()
        kept.advance(f"{settings.skill}, loss {loss:.3f}", report, {"loss": loss})
    return {"policy": policy, "losses": kept.log}


def _iterate(
    settings: Settings, policy: Tracker, optimizer: Adam, dynamics: Dynamics, random: Generator
) -> float:
    """One batch of episodes, a step of the optimizer for every window; the mean cost."""
    skill, turn = settings.skill, dynamics.vessel.turn
    state, goal, current, limits = draw(skill, settings.batch, settings.current, random, turn)
    before, total = torch.zeros(settings.batch, 2), 0.0
    off = torch.randn(settings.batch, 2, generator=random) * settings.noise
    for _window in range(settings.steps // settings.window):
        state, before, loss = state.detach(), before.detach(), torch.zeros(())
        for _step in range(settings.window):
            drift = torch.randn(off.shape, generator=random) * settings.noise
            off = 0.98 * off + 0.2 * drift
            believed = torch.cat([state[:, :2] + off, state[:, 2:]], dim=1)
            if skill == "goto":
                goal = aimed(believed, goal)
            made = policy(relative(believed, goal))
            state = dynamics(state, made * policy.limits, current, limits)
            loss = loss + cost(skill, state, goal, made, before).mean()
            before = made
        optimizer.zero_grad()
        torch.autograd.backward(loss / settings.window)
        torch.nn.utils.clip_grad_norm_(policy.parameters(), settings.norm)
        optimizer.step()
        total += float(loss.detach())
    return total / settings.steps
