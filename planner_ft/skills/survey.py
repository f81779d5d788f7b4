"""The task of SurveyTarget: once round an unknown structure, for a batch of vehicles.

A semi-Markov decision process: an action names a waypoint, the frozen policy of GoToXY drives to it
for at most 15 time steps, and rewards come when such an option ends. Observation, action, rewards,
ends, shapes and spawns are the published ones; what was not published stands in the constants that
are marked as chosen.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
import shapely
import torch
from torch import Tensor

from planner_ft.skills import geometry
from planner_ft.skills.dynamics import CURRENT, Dynamics, turned
from planner_ft.skills.shapes import POINTS, RADIUS, Floats, draw_outline, offset_path
from planner_ft.skills.tracker import Tracker, aimed

OPTION, ARRIVED = 15, 0.25
"""Time steps of an option at most, and metres within which its waypoint is reached."""
AHEAD, ASIDE = (0.5, 4.0), 3.0
"""Chosen: metres of a waypoint ahead (w_min, w_max) and to either side (w_y,max)."""
LONGEST = 150
"""Chosen: options of an episode at most. Its end, as that of a lap, cuts an episode off: what would
have followed counts, or learners that are paid while they go round would put off coming round.
"""
CLEAR = geometry.HULL_RADIUS + geometry.TOUCH
"""Chosen: metres from all of the outline at the start."""
BAND = 0.5
"""Metres about the stand-off in which a waypoint is rewarded."""
WAY = 256
"""Points of the way at the stand-off that a teacher knows."""
NUMBERS = geometry.RAYS + 4


@dataclass(frozen=True)
class Task:
    """What is drawn, and what is rewarded. `standoff`, `size` (base radius)
    and `spawn` (distance at the start) in m, `current` in m/s, `lost` the share of
    rays that a scan loses (in training at most); `rounding` (m) of the teacher's way, if any.
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

    def without(self, term: str | None) -> Task:
        """The task without a term of its reward: standoff, progress or visibility."""
        zero: dict[str, Any] = {f"{term}_weight": 0.0} if term else {}
        return replace(self, **zero)


@dataclass
class Ended:
    """What options came to (B,): `reward`, `terminated`, `truncated`, `steps` of time, and at an
    episode's end what it was: success, collision, lost, late.
    """

    reward: Tensor
    terminated: Tensor
    truncated: Tensor
    steps: Tensor
    outcome: list[str | None] = field(default_factory=list)

    @property
    def done(self) -> Tensor:
        return self.terminated | self.truncated


class Survey:
    """B vehicles, each before a structure of its own; `random` draws objects and everything else.

    `fixed` (per vehicle an outline and a stand-off) makes episodes of these, in turn.
    """

    def __init__(
        self,
        task: Task,
        count: int,
        dynamics: Dynamics,
        tracker: Tracker,
        random: np.random.Generator,
        families: Sequence[str] | None = None,
    ) -> None:
        self.task, self.count, self.dynamics, self.tracker = task, count, dynamics, tracker
        self.random, self.given = random, families
        self.family = [""] * count
        self.outline, self.way = torch.zeros(count, POINTS, 2), torch.zeros(count, WAY, 2)
        self.standoff, self.current = torch.zeros(count), torch.zeros(count, 2)
        self.state, self.limits = torch.zeros(count, 8), torch.zeros(count, 2)
        self.limits[:] = self.tracker.limits
        self.scan = torch.full((count, geometry.RAYS), geometry.REACH)
        self.index = torch.zeros(count, dtype=torch.long)
        self.lap, self.left = torch.zeros(count), torch.zeros(count)
        self.options, self.time = torch.zeros(count), torch.zeros(count)
        self.off, self.off_steps = torch.zeros(count), torch.zeros(count)
        self.length = torch.zeros(count)
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
        for total in (self.lap, self.options, self.time, self.off, self.off_steps, self.length):
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
            way = offset_path(outline, standoff, task.rounding, WAY)
            self.way[one] = torch.as_tensor(way)
        place, along = _spawn(outline, standoff, task.spawn, random)
        yaw = along + random.uniform(-math.pi, math.pi)
        self.state[one] = torch.as_tensor([*place, math.remainder(yaw, 2 * math.pi), *[0.0] * 5])
        set_to, speed = random.uniform(-math.pi, math.pi), random.uniform(*task.current)
        self.current[one, 0] = speed * math.cos(set_to)
        self.current[one, 1] = speed * math.sin(set_to)

    def _look(self, which: Tensor) -> None:
        """Scan from where these vehicles are."""
        scan = geometry.ranges(self.pose[which], self.outline[which])
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
        for name, value in kept.items():
            if name == "random":
                self.random.bit_generator.state = value
            else:
                setattr(self, name, value)

    def observe(self) -> Tensor:
        """The published 68 numbers (B, 68)."""
        return observation(self.scan, self.left, self.state, self.standoff, self.limits)

    @torch.no_grad()
    def step(self, action: Tensor) -> Ended:
        """Drive to the waypoints that actions (B, 2) name; episodes that end stay ended until they
        are `reset`.
        """
        target = waypoint(action, self.pose)
        before, place = self.index.clone(), self.state[:, :2]
        to = target - place
        goal = torch.cat([target, torch.atan2(to[:, 1], to[:, 0])[:, None]], dim=1)
        active = torch.ones(self.count, dtype=torch.bool)
        hit, steps = ~active, torch.zeros(self.count)
        for _step in range(OPTION):
            goal = aimed(self.state, goal)
            self._advance(goal, active)
            steps += active
            away = self._follow(active)
            hit |= active & geometry.touching(self.pose, self.outline, away)
            there = (self.state[:, :2] - target).norm(dim=1) < ARRIVED
            active &= ~(hit | there | (self.lap.abs() >= POINTS))
            if not active.any():
                break
        self.left = OPTION - steps
        self.time += steps
        self.options += 1
        self._look(torch.arange(self.count))
        return self._judge(target, before, hit, steps)

    def _advance(self, goal: Tensor, active: Tensor) -> None:
        command = self.tracker.command(self.state, goal)
        made = self.dynamics(self.state, command, self.current, self.limits)
        moved = (made[:, :2] - self.state[:, :2]).norm(dim=1)
        self.length += moved * active
        self.state = torch.where(active[:, None], made, self.state)

    def _follow(self, active: Tensor) -> Tensor:
        """Distances to the nearest boundary points (B,); counts laps and errors."""
        away, index = geometry.nearest(self.state[:, :2], self.outline)
        self.lap += _advance(index, self.index) * active
        self.index = torch.where(active, index, self.index)
        self.off += (away - self.standoff).abs() * active
        self.off_steps += active
        return away

    def _judge(self, target: Tensor, before: Tensor, hit: Tensor, steps: Tensor) -> Ended:
        task = self.task
        lap = (self.lap.abs() >= POINTS) & ~hit
        seen = (self.scan < geometry.REACH).float().mean(dim=1)
        lost = (seen == 0) & ~hit & ~lap
        away = geometry.nearest(target, self.outline)[0]
        wrong = geometry.inside(target, self.outline)
        good = ((away - self.standoff).abs() <= BAND) & ~wrong
        reward = task.standoff_weight * good
        reward = reward + task.progress_weight * (_advance(self.index, before) / 4).clamp(-1, 1)
        reward = reward + task.visibility_weight * (2 * seen - 1)
        wrong |= geometry.inside(self.state[:, :2], self.outline)
        reward = reward - 10.0 * hit - 5.0 * wrong - 3.0 * lost
        terminated = hit | lost
        late = ~terminated & ~lap & (self.options >= LONGEST)
        truncated = lap | late
        kinds = zip(*(one.tolist() for one in (hit, lap, lost, late)), strict=True)
        names = ("collision", "success", "lost", "late")
        outcome = [
            next((n for n, is_so in zip(names, k, strict=True) if is_so), None) for k in kinds
        ]
        return Ended(reward, terminated, truncated, steps, outcome)


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


def _advance(index: Tensor, before: Tensor) -> Tensor:
    """How many boundary points an index moved on, the short way round."""
    return ((index - before + POINTS // 2) % POINTS - POINTS // 2).float()


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
    reach = geometry.REACH
    return torch.cat(
        [
            (scan / reach).clamp(0, 1),
            (left / OPTION)[:, None],
            state[:, 3:5] / limits[:, :1],
            (standoff / reach)[:, None],
        ],
        dim=1,
    )
