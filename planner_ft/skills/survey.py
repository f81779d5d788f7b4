"""The task of SurveyTarget: once round an unknown structure, for a batch of vehicles.

A semi-Markov decision process: an action names a waypoint, the frozen policy of GoToXY drives to it
for at most 15 time steps, and rewards come when such an option ends. Observation, action, rewards,
ends, shapes and spawns are the published ones; what was not published stands in the constants that
are marked as chosen.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import shapely
import torch
from torch import Tensor

from planner_ft.simulation.fast import Floats
from planner_ft.skills import geometry
from planner_ft.skills.dynamics import CURRENT, Dynamics, Tracker, published_vessel, turned
from planner_ft.skills.geometry import POINTS, RADIUS, draw_outline, offset_path
from planner_ft.skills.option import Before, Compiled, Way, advance, judge

OPTION = 15  # time steps of an option at most (published)
AHEAD, ASIDE = (0.5, 4.0), 3.0
"""Chosen: metres of a waypoint ahead (w_min, w_max) and to either side (w_y,max)."""
LONGEST = 150
"""Chosen: options of an episode at most. Its end, as that of a lap, cuts an episode off: what would
have followed counts, or learners that are paid while they go round would put off coming round.
"""
CLEAR = geometry.HULL_RADIUS + geometry.TOUCH  # chosen: metres from all of the outline at the start
WAY = 256  # points of the way at the stand-off that a teacher knows
NUMBERS = geometry.RAYS + 4
NAMES = ("collision", "success", "lost", "late")
Cast = Callable[[Tensor, Tensor], Tensor]


@dataclass(frozen=True)
class Task:
    """What is drawn, and what is rewarded. `standoff`, `size` (base radius) and `spawn` (distance
    at the start) in m, `current` in m/s, `lost` the share of rays that a scan loses (in training at
    most); `rounding` (m) of the teacher's way, if any.
    """

    families: tuple[str, ...] = ("circle", "rectangle", "L", "polygon", "abstract")
    weights: tuple[float, ...] | None = None
    standoff: tuple[float, float] = (4.0, 7.0)
    size: tuple[float, float] = RADIUS
    spawn: tuple[float, float] = (3.0, 7.0)
    current: tuple[float, float] = CURRENT
    lost: float = 0.0
    standoff_weight: float = 3.0
    progress_weight: float = 1.0
    visibility_weight: float = 0.2
    rounding: float | None = None

    @property
    def rewards(self) -> tuple[float, float, float]:
        """Weights of stand-off, progress and visibility."""
        return self.standoff_weight, self.progress_weight, self.visibility_weight

    def without(self, term: str | None) -> Task:
        """The task without a term of its reward: standoff, progress or visibility."""
        zero: dict[str, Any] = {f"{term}_weight": 0.0} if term else {}
        return replace(self, **zero)


@dataclass
class Ended:
    """What options came to (B,): `reward`, whether episodes were `terminated`, whether they are
    over, and what they were then: success, collision, lost, late.
    """

    reward: Tensor
    terminated: Tensor
    done: Tensor
    outcome: list[str | None]


@dataclass(eq=False)
class Survey:
    """B vehicles, each before a structure of its own; `random` draws objects and everything else.

    `given` are the families of the vehicles, else each episode draws one; `compiled` costs a
    minute, and then saves most of a time step of a few vehicles.
    """

    task: Task
    count: int
    tracker: Tracker
    random: np.random.Generator
    given: Sequence[str] | None = None
    compiled: bool = False

    def __post_init__(self) -> None:
        count, self.dynamics = self.count, Dynamics(published_vessel())
        self.family = [""] * count
        self.outline, self.way = torch.zeros(count, POINTS, 2), torch.zeros(count, WAY, 2)
        self.standoff, self.current = torch.zeros(count), torch.zeros(count, 2)
        self.state, self.limits = torch.zeros(count, 8), torch.zeros(count, 2)
        self.limits[:] = self.tracker.limits
        self.scan = torch.full((count, geometry.RAYS), geometry.REACH)
        self.index = torch.zeros(count, dtype=torch.long)
        self.lap, self.left = torch.zeros(count), torch.zeros(count)
        self.options, self.time = torch.zeros(count), torch.zeros(count)
        self.off, self.length = torch.zeros(count), torch.zeros(count)
        wrap: Callable[[Any], Callable[..., Any]] = Compiled if self.compiled else lambda one: one
        self.advance, self.cast, self.judge = wrap(advance), wrap(geometry.ranges), wrap(judge)
        self.reset(range(count))

    @property
    def pose(self) -> Tensor:
        """x, y, yaw (B, 3)."""
        return self.state[:, :3]

    def reset(self, which: Sequence[int] | range) -> None:
        """New episodes of these vehicles."""
        if not len(which):
            return
        for one in which:
            self._draw(one)
        index = torch.as_tensor(list(which))
        for total in (self.lap, self.options, self.time, self.off, self.length):
            total[index] = 0.0
        self.left[index] = OPTION
        self.index[index] = geometry.nearest(self.state[index, :2], self.outline[index])[1]
        self._look(index)

    def _draw(self, one: int) -> None:
        """An outline, a stand-off, and a start on the outward normal of a boundary point."""
        random, task = self.random, self.task
        family = self.given[one] if self.given else random.choice(task.families, p=task.weights)
        outline = draw_outline(str(family), random, task.size)
        standoff = random.uniform(*task.standoff)
        self.family[one], self.standoff[one] = str(family), standoff
        self.outline[one] = torch.as_tensor(outline)
        if task.rounding is not None:
            self.way[one] = torch.as_tensor(offset_path(outline, standoff, task.rounding, WAY))
        place, along = _spawn(outline, standoff, task.spawn, random)
        yaw = along + random.uniform(-math.pi, math.pi)
        self.state[one] = torch.as_tensor([*place, math.remainder(yaw, 2 * math.pi), *[0.0] * 5])
        set_to, speed = random.uniform(-math.pi, math.pi), random.uniform(*task.current)
        self.current[one, 0] = speed * math.cos(set_to)
        self.current[one, 1] = speed * math.sin(set_to)

    def _look(self, which: Tensor, cast: Cast = geometry.ranges) -> None:
        """Scan from where these vehicles are."""
        scan = cast(self.pose[which], self.outline[which])
        if self.task.lost:
            share = self.task.lost * (1.0 if self.given else self.random.random((len(scan), 1)))
            gone = torch.as_tensor(self.random.random(scan.shape) < share)
            scan = torch.where(gone, geometry.REACH, scan)
        self.scan[which] = scan

    def snapshot(self) -> dict[str, Any]:
        """Everything that changes, for a checkpoint."""
        tensors = {k: v.clone() for k, v in vars(self).items() if isinstance(v, Tensor)}
        return {**tensors, "family": list(self.family), "random": self.random.bit_generator.state}

    def restore(self, kept: dict[str, Any]) -> None:
        """Go on from a snapshot."""
        self.random.bit_generator.state = kept["random"]
        vars(self).update({name: one for name, one in kept.items() if name != "random"})

    def observe(self) -> Tensor:
        """The published 68 numbers (B, 68)."""
        return observation(self.scan, self.left, self.state, self.standoff, self.limits)

    @torch.no_grad()
    def step(self, action: Tensor) -> Ended:
        """Drive to the waypoints that actions (B, 2) name; episodes that end stay ended until they
        are `reset`.
        """
        target, before = waypoint(action, self.pose), self.index
        to, none = target - self.state[:, :2], torch.zeros(self.count, dtype=torch.bool)
        goal = torch.cat([target, torch.atan2(to[:, 1], to[:, 0])[:, None]], dim=1)
        fixed = Before(self.outline, self.standoff, self.current, self.limits, target)
        totals = self.lap, self.length, self.off, torch.zeros(self.count)
        now = Way(self.state, goal, before, *totals, hit=none, active=~none)
        for _step in range(OPTION):
            now = self.advance(self.tracker, self.dynamics, now, fixed)
            if not now.active.any():
                break
        self.state, self.index, self.lap = now.state, now.point, now.lap
        self.length, self.off = now.length, now.off
        self.left = OPTION - now.steps
        self.time = self.time + now.steps
        self.options += 1
        self._look(torch.arange(self.count), self.cast)
        reward, lap, lost = self.judge(self.task.rewards, now, fixed, before, self.scan)
        terminated = now.hit | lost
        late = ~terminated & ~lap & (self.options >= LONGEST)
        kinds = torch.stack([now.hit, lap, lost, late], dim=1).tolist()
        outcome = [next((n for n, so in zip(NAMES, k, strict=True) if so), None) for k in kinds]
        return Ended(reward, terminated, terminated | lap | late, outcome)


def _spawn(
    outline: Floats, standoff: float, limits: tuple[float, float], random: np.random.Generator
) -> tuple[Floats, float]:
    """A place (2,) on the outward normal of a boundary point, and the bearing of its tangent. One
    that another part of the outline would touch is drawn anew (chosen).
    """
    while True:
        point = int(random.integers(POINTS))
        tangent = outline[(point + 1) % POINTS] - outline[point - 1]
        along = math.atan2(tangent[1], tangent[0])
        far = float(np.clip(standoff + random.uniform(-3, 3), *limits))
        place = outline[point] + far * np.array([math.sin(along), -math.cos(along)])
        free = np.linalg.norm(outline - place, axis=1).min() > CLEAR
        if free and not shapely.Polygon(outline).contains(shapely.Point(place)):
            return place, along


def waypoint(action: Tensor, pose: Tensor) -> Tensor:
    """Places (B, 2) that actions (B, 2) in [-1, 1] name from poses (B, 3)."""
    ahead = AHEAD[0] + (action[:, 0] + 1) / 2 * (AHEAD[1] - AHEAD[0])
    body = torch.stack([ahead, action[:, 1] * ASIDE], dim=1)
    return pose[:, :2] + turned(body, pose[:, 2])


def action_of(place: Tensor, pose: Tensor) -> Tensor:
    """The actions (B, 2) that name places (B, 2), as near as an action can."""
    body = turned(place - pose[:, :2], -pose[:, 2])
    ahead = 2 * (body[:, 0] - AHEAD[0]) / (AHEAD[1] - AHEAD[0]) - 1
    return torch.stack([ahead, body[:, 1] / ASIDE], dim=1).clamp(-1, 1)


def observation(
    scan: Tensor, left: Tensor, state: Tensor, standoff: Tensor, limits: Tensor
) -> Tensor:
    """The published observation (B, 68): scan (B, 64) in m, time steps that the option had left
    (B,), velocity of states (B, 8), stand-off (B,) in m.
    """
    seen, speed = (scan / geometry.REACH).clamp(0, 1), state[:, 3:5] / limits[:, :1]
    numbers = (left / OPTION)[:, None], speed, (standoff / geometry.REACH)[:, None]
    return torch.cat([seen, *numbers], dim=1)
