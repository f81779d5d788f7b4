"""Episodes of SurveyTarget played to their ends with the figures of the published protocol, and the
baselines: a contour follower on the same rays, and the oracle's way. An actor is called with a
`Survey` and gives actions (B, 2).
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
import torch
from torch import Tensor

from planner_ft.skills import geometry
from planner_ft.skills.dynamics import Tracker, turned
from planner_ft.skills.survey import Survey, Task, action_of

Actor = Callable[[Survey], Tensor]
LOOK = 2.5  # metres ahead on the way to which a waypoint is named
PUSHES = 3


@dataclass(frozen=True)
class Episode:
    """One episode: `error` is the mean distance from the stand-off in m over all its time steps,
    `steps` are time steps, `length` in m, `number` which object of its condition it had.
    """

    family: str
    outcome: str
    error: float
    steps: int
    length: float
    number: int


@torch.no_grad()
def play(
    actor: Actor, tracker: Tracker, task: Task, families: Sequence[str], seed: int
) -> list[Episode]:
    """An episode for each of `families`, all at once, with new objects of a seed."""
    random = np.random.default_rng([seed, 7])
    world = Survey(task, len(families), tracker, random, families)
    found: list[Episode | None] = [None] * len(families)
    while any(one is None for one in found):
        ended = world.step(actor(world))
        for one, outcome in enumerate(ended.outcome):
            if outcome and found[one] is None:
                error = float(world.off[one] / world.time[one].clamp_min(1))
                figures = error, int(world.time[one]), float(world.length[one])
                found[one] = Episode(families[one], outcome, *figures, one)
    return [one for one in found if one is not None]


def contour_follower(survey: Survey) -> Tensor:
    """Keeps the nearest return abeam to port: a waypoint ahead along the wall, pushed off until it
    keeps the stand-off from all returns.
    """
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


def oracle(survey: Survey) -> Tensor:
    """Knows the outline: a waypoint LOOK m ahead on the way at the stand-off."""
    place, way = survey.state[:, :2], survey.way
    away = (way - place[:, None]).square().sum(dim=2)
    at = away.argmin(dim=1)
    spacing = (way[:, 1:] - way[:, :-1]).norm(dim=2).mean(dim=1)
    ahead = (LOOK / spacing).round().long()
    row = torch.arange(len(way))
    target = way[row, (at + ahead) % way.shape[1]]
    return action_of(target, survey.pose)
