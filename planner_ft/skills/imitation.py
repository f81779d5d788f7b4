"""Imitating a teacher that knows the outline, by a policy that sees rays and what it remembers.

The policy drives, the teacher says what it would have done there (DAgger: Ross, Gordon and Bagnell,
2011); a teacher with knowledge that its pupil lacks is "learning by cheating" (Chen et al., 2019).
"""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import torch
from torch import Tensor
from torch.optim import Adam
from torch.optim.lr_scheduler import CosineAnnealingLR

from planner_ft.skills.dynamics import Tracker
from planner_ft.skills.episodes import oracle
from planner_ft.skills.policies import Checkpoint
from planner_ft.skills.survey import Survey, Task
from planner_ft.skills.surveyor import Memory, Surveyor
from planner_ft.support.terminal import Report

WIDER: dict[str, Any] = {
    "size": (1.5, 10.0),
    "spawn": (2.5, 9.5),
    "standoff": (3.5, 7.5),
    "current": (0.0, 0.16),
}
"""What our training draws beyond the published ranges."""


@dataclass(frozen=True)
class Settings:
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
    lost: float = 0.1  # share of the rays that a scan loses at most
    teacher: int = 8  # iterations that the teacher drives
    rounding: float = 1.5
    """Metres: the margin in hollows of an outline, by the curvature that the vehicle can turn."""


def train(
    settings: Settings, tracker: Tracker, folder: Path, resume: bool, report: Report
) -> dict[str, Any]:
    """Train our policy; it and the losses."""
    torch.manual_seed(settings.seed)
    pupil = Surveyor("ours", 0.3)
    optimizer = Adam(pupil.parameters(), lr=settings.rate)
    schedule = CosineAnnealingLR(optimizer, settings.iterations, settings.rate / 20)
    random = torch.Generator().manual_seed(settings.seed)
    drawn = np.random.default_rng([settings.seed, 11])
    task = Task(rounding=settings.rounding, lost=settings.lost, **WIDER)
    world = Survey(task, settings.environments, tracker, drawn)
    memory = pupil.memory = Memory(settings.environments)
    parts = pupil, optimizer, schedule
    kept = Checkpoint(folder, settings, random, *parts, resume=resume, goto=tracker)
    seen, wanted = torch.zeros(0, 132), torch.zeros(0, 2)
    if kept.done:
        world.restore(kept.more["world"])
        seen, wanted = kept.more["seen"], kept.more["wanted"]
        memory.points, memory.at = kept.more["memory"]

    def more() -> dict[str, Any]:
        kept_memory = memory.points, memory.at
        return {"world": world.snapshot(), "seen": seen, "wanted": wanted, "memory": kept_memory}

    while kept.done < settings.iterations:
        by_teacher = kept.done < settings.teacher
        new, said = _drive(world, pupil, by_teacher, settings, random)
        seen = torch.cat([seen, new])[-settings.kept :]
        wanted = torch.cat([wanted, said])[-settings.kept :]
        total = 0.0
        for _update in range(settings.updates):
            some = torch.randint(len(seen), (settings.minibatch,), generator=random)
            wrong = (pupil(seen[some]) - wanted[some]).square().mean()
            optimizer.zero_grad()
            torch.autograd.backward(wrong)
            optimizer.step()
            total += float(wrong.detach())
        schedule.step()
        loss = total / settings.updates
        kept.advance(f"imitation, loss {loss:.4f}", report, {"loss": loss}, more)
    return {"policy": pupil, "losses": kept.log}


@torch.no_grad()
def _drive(
    world: Survey, pupil: Surveyor, by_teacher: bool, settings: Settings, random: torch.Generator
) -> tuple[Tensor, Tensor]:
    """What the pupil saw (n, 132), and what the teacher would have done there (n, 2)."""
    seen, wanted = [], []
    for _option in range(settings.options):
        seen.append(pupil.observe(world))
        wanted.append(oracle(world))
        action = wanted[-1] if by_teacher else pupil(seen[-1])
        noise = settings.noise * torch.randn(action.shape, generator=random)
        ended = world.step((action + noise).clamp(-1, 1))
        world.reset(torch.nonzero(ended.done)[:, 0].tolist())
    return torch.cat(seen), torch.cat(wanted)
