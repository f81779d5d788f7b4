"""Episodes of SurveyTarget played to their ends, and the figures of the published protocol."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
import torch
from torch import Tensor

from planner_ft.skills.dynamics import Dynamics, published_vessel
from planner_ft.skills.survey import Survey, Task
from planner_ft.skills.tracker import Tracker

Actor = Callable[[Survey], Tensor]
OUTCOMES = ("success", "collision", "lost", "late")


@dataclass(frozen=True)
class Episode:
    """One episode: `error` is the mean distance from the stand-off in m over all its time steps,
    `steps` are time steps, `length` in m.
    """

    family: str
    outcome: str
    error: float
    steps: int
    length: float


@torch.no_grad()
def play(
    actor: Actor, tracker: Tracker, task: Task, families: Sequence[str], seed: int
) -> list[Episode]:
    """An episode for each of `families`, all at once, with new objects of a seed."""
    random = np.random.default_rng([seed, 7])
    world = Survey(task, len(families), Dynamics(published_vessel()), tracker, random, families)
    found: list[Episode | None] = [None] * len(families)
    while any(one is None for one in found):
        ended = world.step(actor(world))
        for one, outcome in enumerate(ended.outcome):
            if outcome and found[one] is None:
                error = float(world.off[one] / world.time[one].clamp_min(1))
                figures = error, int(world.time[one]), float(world.length[one])
                found[one] = Episode(families[one], outcome, *figures)
    return [one for one in found if one is not None]
