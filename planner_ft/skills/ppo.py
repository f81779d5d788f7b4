"""The published recipe of SurveyTarget: PPO over options. Advantages are torchrl's; the loss is that
of its `ClipPPOLoss` in one function of tensors, which torch compiles.
"""

import copy
import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import torch
from torch import Tensor, nn
from torchrl.objectives.value.functional import generalized_advantage_estimate

from planner_ft.skills.dynamics import Tracker
from planner_ft.skills.option import Compiled
from planner_ft.skills.policies import Checkpoint
from planner_ft.skills.survey import NUMBERS, Survey, Task
from planner_ft.skills.surveyor import Surveyor
from planner_ft.support.errors import PlannerError
from planner_ft.support.terminal import Report

L3 = (1 / 7, 1 / 7, 3 / 7, 1 / 7, 1 / 7)  # the published oversampling: the L in 3 of 7 draws


@dataclass(frozen=True)
class Settings:
    """The published settings. `frames` are options of a batch, over all `environments`."""

    seed: int = 0
    iterations: int = 300
    environments: int = 16
    frames: int = 8000
    minibatch: int = 512
    epochs: int = 20
    clip: float = 0.2
    entropy: float = 5e-4
    gamma: float = 0.99
    lmbda: float = 0.9
    rate: float = 3e-4
    norm: float = 1.0
    patience: int = 20  # iterations without a better mean reward after which training ends
    sampling: str = "uniform"
    without: str | None = None

    def __post_init__(self) -> None:
        """Raise PlannerError for more environments than options of a batch."""
        if self.environments > self.frames:
            most = f"must be at most {self.frames}, the options of an iteration"
            raise PlannerError(f"--environments {self.environments}: {most}")


@dataclass
class Batch:
    """Options (E, T): what was seen (68), the pre-tanh action drawn (2), what was seen after it
    (68), its reward, whether it ended the episode for good, and whether it ended it.
    """

    seen: Tensor
    drawn: Tensor
    after: Tensor
    reward: Tensor
    terminated: Tensor
    done: Tensor


class Learner:
    """Actor, critic, loss and optimizer."""

    def __init__(self, settings: Settings) -> None:
        self.settings, self.surveyor = settings, Surveyor("published")
        self.critic = self.surveyor.critic()
        self.nets = nn.ModuleList([self.surveyor, self.critic])
        self.optimizer = torch.optim.Adam(self.nets.parameters(), lr=settings.rate, fused=True)
        self.draw, self.loss = Compiled(self._draw), Compiled(self._loss)

    def _draw(self, seen: Tensor, noise: Tensor) -> tuple[Tensor, Tensor]:
        """Actions of a TanhNormal (B, 2) before the tanh, and as they are."""
        location, spread = self.surveyor.spread(seen)
        drawn = location + spread * noise
        return drawn, torch.tanh(drawn)

    def _loss(
        self,
        seen: Tensor,
        drawn: Tensor,
        before: Tensor,
        advantage: Tensor,
        value: Tensor,
        noise: Tensor,
    ) -> Tensor:
        """The loss of a minibatch (B, ...): clipped objective, entropy bonus, and the critic's.

        `before` (B,) are log-densities of `drawn` when it was drawn, `value` (B,) is what the
        critic should have said, and `noise` (B, 2) draws the action that estimates the entropy.
        """
        settings = self.settings
        location, spread = self.surveyor.spread(seen)
        ratio = density(drawn, location, spread) - before  # the tanh's slope cancels out
        clipped = ratio.clamp(math.log1p(-settings.clip), math.log1p(settings.clip))
        advantage = (advantage - advantage.mean()) / advantage.std().clamp_min(1e-6)
        gain = torch.minimum(ratio.exp() * advantage, clipped.exp() * advantage)
        other = location + spread * noise
        slope = 2 * (math.log(2) - other - nn.functional.softplus(-2 * other)).sum(dim=-1)
        entropy = slope - density(other, location, spread)
        wrong = nn.functional.smooth_l1_loss(self.critic(seen)[:, 0], value)
        loss: Tensor = wrong - gain.mean() - settings.entropy * entropy.mean()
        return loss

    @torch.no_grad()
    def judge(self, batch: Batch) -> tuple[Tensor, Tensor, Tensor]:
        """Log-densities of what was drawn, advantages and values, for all options (E T,)."""
        settings = self.settings
        before = density(batch.drawn, *self.surveyor.spread(batch.seen))
        found = generalized_advantage_estimate(
            settings.gamma,
            settings.lmbda,
            self.critic(batch.seen),
            self.critic(batch.after),
            *(batch.reward[..., None], batch.done[..., None], batch.terminated[..., None]),
        )
        return before.flatten(), found[0].flatten(), found[1].flatten()

    def learn(self, batch: Batch, random: torch.Generator) -> float:
        """Some epochs over a batch; the mean loss."""
        settings, losses = self.settings, []
        known = batch.seen.flatten(0, 1), batch.drawn.flatten(0, 1), *self.judge(batch)
        for _epoch in range(settings.epochs):
            order = torch.randperm(len(known[0]), generator=random)
            noise = torch.randn(len(order), 2, generator=random)
            for some in torch.split(order, settings.minibatch):
                loss = self.loss(*(one[some] for one in known), noise[some])
                self.optimizer.zero_grad()
                torch.autograd.backward(loss)
                nn.utils.clip_grad_norm_(self.nets.parameters(), settings.norm)
                self.optimizer.step()
                losses.append(loss.detach())
        return float(torch.stack(losses).mean())


def density(drawn: Tensor, location: Tensor, spread: Tensor) -> Tensor:
    """Log-density (...) of `drawn` (..., 2) under a normal distribution."""
    apart = (drawn - location) / spread
    each = -apart.square() / 2 - spread.log() - math.log(2 * math.pi) / 2
    return each.sum(dim=-1)


def train(
    settings: Settings, tracker: Tracker, folder: Path, resume: bool, report: Report
) -> dict[str, Any]:
    """Train by the published recipe; the best policy, and a log line per iteration."""
    torch.manual_seed(settings.seed)
    learner = Learner(settings)
    drawn = np.random.default_rng([settings.seed, 13])
    task = Task(weights=L3 if settings.sampling == "l3" else None).without(settings.without)
    world = Survey(task, settings.environments, tracker, drawn, compiled=True)
    random = torch.Generator().manual_seed(settings.seed)
    parts = learner.nets, learner.optimizer
    kept = Checkpoint(folder, settings, random, *parts, resume=resume, goto=tracker)
    best: dict[str, Any] = {"reward": -math.inf, "iteration": 0, "weights": {}}
    if kept.done:
        world.restore(kept.more["world"])
        best = kept.more["best"]

    def more() -> dict[str, Any]:
        return {"world": world.snapshot(), "best": best}

    while kept.done < settings.iterations and kept.done - best["iteration"] < settings.patience:
        batch, ended = collect(world, learner, settings.frames // world.count, random)
        reward = float(batch.reward.mean())
        if reward > best["reward"]:
            weights = copy.deepcopy(learner.surveyor.state_dict())
            best = {"reward": reward, "iteration": kept.done + 1, "weights": weights}
        loss = learner.learn(batch, random)
        share = {name: ended.count(name) for name in sorted(set(ended))}
        line = {"reward": reward, "loss": loss, **share}
        last = kept.done + 1 - best["iteration"] >= settings.patience
        label = f"PPO, mean reward {reward:.2f}"
        kept.advance(label, report, line, more, every=5, last=last)
    learner.surveyor.load_state_dict(best["weights"])
    result = {"best": best["iteration"], "reward": best["reward"]}
    return {"policy": learner.surveyor, "losses": kept.log, "result": result}


@torch.no_grad()
def collect(
    world: Survey, learner: Learner, options: int, random: torch.Generator
) -> tuple[Batch, list[str]]:
    """A batch (environments, options) under the policy, and how episodes ended."""
    shape, outcomes = (world.count, options), list[str]()
    seen, after = torch.zeros(2, *shape, NUMBERS)
    terminated, done = torch.zeros(2, *shape, dtype=torch.bool)
    made = torch.zeros(*shape, 2), after, torch.zeros(shape), terminated, done
    batch = Batch(seen, *made)
    noise = torch.randn(options, world.count, 2, generator=random)
    for at in range(options):
        batch.seen[:, at] = seen = world.observe()
        batch.drawn[:, at], action = learner.draw(seen, noise[at])
        ended = world.step(action)
        batch.after[:, at], batch.reward[:, at] = world.observe(), ended.reward
        batch.terminated[:, at], batch.done[:, at] = ended.terminated, ended.done
        outcomes += [one for one in ended.outcome if one]
        world.reset(torch.nonzero(ended.done)[:, 0].tolist())
    return batch, outcomes
