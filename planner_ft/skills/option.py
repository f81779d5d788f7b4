"""One time step of an option, its scan and its reward: functions of tensors that torch compiles."""

from collections.abc import Callable
from typing import Any, NamedTuple

import torch
from torch import Tensor

from planner_ft.skills import geometry
from planner_ft.skills.dynamics import Dynamics, Tracker, aimed
from planner_ft.skills.geometry import POINTS

ARRIVED = 0.25  # metres within which an option's waypoint is reached (published)
BAND = 0.5  # metres about the stand-off in which a waypoint is rewarded (published)


class Before(NamedTuple):
    """What stays during an option of B vehicles: outlines (B, 150, 2), stand-offs (B,) in m,
    currents (B, 2), speed limits (B, 2), waypoints (B, 2).
    """

    outline: Tensor
    standoff: Tensor
    current: Tensor
    limits: Tensor
    target: Tensor


class Way(NamedTuple):
    """What a time step changes: states (B, 8), goals (B, 3), nearest boundary points and signed
    sums of their steps, metres gone, metres off the stand-off in all, time steps, whether a
    boundary point was touched, whether the option goes on (B,).
    """

    state: Tensor
    goal: Tensor
    point: Tensor
    lap: Tensor
    length: Tensor
    off: Tensor
    steps: Tensor
    hit: Tensor
    active: Tensor


def advance(tracker: Tracker, dynamics: Dynamics, now: Way, fixed: Before) -> Way:
    """A time step of the vehicles whose options go on."""
    active = now.active
    goal = aimed(now.state, now.goal)
    made = dynamics(now.state, tracker.command(now.state, goal), fixed.current, fixed.limits)
    moved = (made[:, :2] - now.state[:, :2]).norm(dim=1)
    state = torch.where(active[:, None], made, now.state)
    place = state[:, :2]
    away, index = geometry.nearest(place, fixed.outline)
    lap = now.lap + steps_between(index, now.point) * active
    hit = now.hit | (active & geometry.touching(state[:, :3], fixed.outline, away))
    there = (place - fixed.target).norm(dim=1) < ARRIVED
    return Way(
        state,
        goal,
        torch.where(active, index, now.point),
        lap,
        now.length + moved * active,
        now.off + (away - fixed.standoff).abs() * active,
        now.steps + active,
        hit,
        active & ~(hit | there | (lap.abs() >= POINTS)),
    )


def judge(
    weights: tuple[float, float, float], now: Way, fixed: Before, before: Tensor, scan: Tensor
) -> tuple[Tensor, Tensor, Tensor]:
    """Rewards of options that ended, which laps are whole, and which vehicles see nothing (B,).

    `weights` are those of stand-off, progress and visibility; `before` (B,) are the nearest
    boundary points when the options began; `scan` (B, 64) is seen now.
    """
    standoff, progress, visibility = weights
    lap = (now.lap.abs() >= POINTS) & ~now.hit
    seen = (scan < geometry.REACH).float().mean(dim=1)
    lost = (seen == 0) & ~now.hit & ~lap
    away = geometry.nearest(fixed.target, fixed.outline)[0]
    wrong = geometry.inside(fixed.target, fixed.outline)
    reward = standoff * (((away - fixed.standoff).abs() <= BAND) & ~wrong)
    reward = reward + progress * (steps_between(now.point, before) / 4).clamp(-1, 1)
    reward = reward + visibility * (2 * seen - 1)
    wrong = wrong | geometry.inside(now.state[:, :2], fixed.outline)
    return reward - 10.0 * now.hit - 5.0 * wrong - 3.0 * lost, lap, lost


def steps_between(index: Tensor, before: Tensor) -> Tensor:
    """How many boundary points an index moved on, the short way round."""
    return ((index - before + POINTS // 2) % POINTS - POINTS // 2).float()


class Compiled:
    """A function that torch compiles, or itself where it cannot (without a C++ compiler)."""

    def __init__(self, function: Callable[..., Any]) -> None:
        from torch._dynamo.exc import TorchDynamoException

        self.plain, self.fast = function, torch.compile(function, dynamic=False)
        self.works, self.trouble = True, TorchDynamoException

    def __call__(self, *given: Any) -> Any:
        if self.works:
            try:
                return self.fast(*given)
            except self.trouble:
                self.works = False
        return self.plain(*given)
