"""Imitating a teacher that knows the outline, by a policy that sees rays and what it remembers.

The policy drives, the teacher says what it would have done there (DAgger: Ross, Gordon and Bagnell,
2011); a teacher with knowledge that its pupil lacks is "learning by cheating" (Chen et al., 2019).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np
import torch
from torch import Tensor

from planner_ft.skills.checkpoint import Checkpoint
from planner_ft.skills.dynamics import Dynamics, published_vessel
from planner_ft.skills.followers import Oracle
from planner_ft.skills.survey import Survey, Task
from planner_ft.skills.surveyor import Memory, Surveyor
from planner_ft.skills.tracker import Tracker

Report = Callable[[str, int, int], None]


WIDER: dict[str, Any] = {
    "size": (1.5, 10.0),
    "spawn": (2.5, 9.5),
    "standoff": (3.5, 7.5),
    "current": (0.0, 0.16),
}
"""What our training draws beyond the published ranges."""


@dataclass(frozen=True)
class ImitationSettings:
    """`environments` drive `options` an iteration; then `updates` of `minibatch` samples of the
    last `kept` ones.
    """

    seed: int = 0
    iterations: int = 200
    environments: int = 256
    options: int = 12
    updates: int = 40
    minibatch: int = 512
    kept: int = 200_000
    rate: float = 1e-3
    noise: float = 0.3
    """Spread of what is added to actions, so that the teacher is asked beside its way."""
    lost: float = 0.1
    """Share of the rays that a scan loses at most."""
    teacher: int = 8
    """Iterations that the teacher drives."""
    rounding: float = 1.5
    """Metres: the margin in hollows of an outline, by the curvature that the vehicle can turn."""


def train(
    settings: ImitationSettings, tracker: Tracker, folder: Path, resume: bool, report: Report
) -> dict[str, Any]:
    """Train our policy; it and the losses."""
    torch.manual_seed(settings.seed)
    pupil, teacher = Surveyor("ours", 0.3), Oracle()
    optimizer = torch.optim.Adam(pupil.parameters(), lr=settings.rate)
    schedule = torch.optim.lr_scheduler.CosineAnnealingLR(
        optimizer, settings.iterations, settings.rate / 20
    )
    random = torch.Generator().manual_seed(settings.seed)
    drawn = np.random.default_rng([settings.seed, 11])
    task = Task(rounding=settings.rounding, lost=settings.lost, **WIDER)
    world = Survey(task, settings.environments, Dynamics(published_vessel()), tracker, drawn)
    pupil.memory = Memory(settings.environments)
    kept = Checkpoint(folder, asdict(settings), pupil, optimizer, schedule)
    seen, wanted = torch.zeros(0, 132), torch.zeros(0, 2)
    done = kept.restore(random) if resume else 0
    if done:
        world.restore(kept.more["world"])
        seen, wanted = kept.more["seen"], kept.more["wanted"]
        pupil.memory.points, pupil.memory.at = kept.more["memory"]
    for iteration in range(done, settings.iterations):
        by_teacher = iteration < settings.teacher
        new, said = _drive(world, pupil, teacher, by_teacher, settings, random)
        seen = torch.cat([seen, new])[-settings.kept :]
        wanted = torch.cat([wanted, said])[-settings.kept :]
        loss = _learn(pupil, optimizer, seen, wanted, settings, random)
        schedule.step()
        kept.add({"iteration": iteration + 1, "loss": loss})
        report(f"imitation, loss {loss:.4f}", iteration + 1, settings.iterations)
        if kept.due(iteration + 1, settings.iterations):
            memory = pupil.memory.points, pupil.memory.at
            more = {"world": world.snapshot(), "seen": seen, "wanted": wanted, "memory": memory}
            kept.save(iteration + 1, random, more)
    return {"policy": pupil, "losses": kept.log}


@torch.no_grad()
def _drive(
    world: Survey,
    pupil: Surveyor,
    teacher: Oracle,
    by_teacher: bool,
    settings: ImitationSettings,
    random: torch.Generator,
) -> tuple[Tensor, Tensor]:
    """What the pupil saw (n, 132), and what the teacher would have done there (n, 2)."""
    seen, wanted = [], []
    for _option in range(settings.options):
        seen.append(pupil.observe(world))
        wanted.append(teacher(world))
        action = wanted[-1] if by_teacher else pupil(seen[-1])
        noise = settings.noise * torch.randn(action.shape, generator=random)
        ended = world.step((action + noise).clamp(-1, 1))
        world.reset(torch.nonzero(ended.done)[:, 0].tolist())
    return torch.cat(seen), torch.cat(wanted)


def _learn(
    pupil: Surveyor,
    optimizer: torch.optim.Optimizer,
    seen: Tensor,
    wanted: Tensor,
    settings: ImitationSettings,
    random: torch.Generator,
) -> float:
    """The mean squared error of the actions over some minibatches."""
    total = 0.0
    for _update in range(settings.updates):
        some = torch.randint(len(seen), (settings.minibatch,), generator=random)
        loss = (pupil(seen[some]) - wanted[some]).square().mean()
        optimizer.zero_grad()
        torch.autograd.backward(loss)
        optimizer.step()
        total += float(loss.detach())
    return total / settings.updates
