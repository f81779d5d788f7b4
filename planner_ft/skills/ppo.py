"""The published recipe of SurveyTarget: PPO over options, by torchrl."""

from __future__ import annotations

import copy
from collections.abc import Callable
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np
import torch
from tensordict import TensorDict
from tensordict.nn import InteractionType, TensorDictModule
from torchrl.modules import ProbabilisticActor, TanhNormal, ValueOperator
from torchrl.objectives import ClipPPOLoss
from torchrl.objectives.value import GAE

from planner_ft.skills.checkpoint import Checkpoint
from planner_ft.skills.dynamics import Dynamics, published_vessel
from planner_ft.skills.survey import Survey, Task
from planner_ft.skills.surveyor import Surveyor
from planner_ft.skills.tracker import Tracker

Report = Callable[[str, int, int], None]
L3 = (1 / 7, 1 / 7, 3 / 7, 1 / 7, 1 / 7)
"""The published oversampling: the L in 3 of 7 draws."""


@dataclass(frozen=True)
class PpoSettings:
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
    patience: int = 20
    """Iterations without a better mean reward after which training ends."""
    sampling: str = "uniform"
    without: str | None = None

    @property
    def task(self) -> Task:
        weights = L3 if self.sampling == "l3" else None
        return Task(weights=weights).without(self.without)


class Learner:
    """Actor, critic, loss and optimizer."""

    def __init__(self, settings: PpoSettings) -> None:
        self.settings, self.surveyor = settings, Surveyor("published")
        spread = TensorDictModule(
            self.surveyor.spread, in_keys=["observation"], out_keys=["loc", "scale"]
        )
        self.actor = ProbabilisticActor(
            spread,
            in_keys=["loc", "scale"],
            distribution_class=TanhNormal,
            return_log_prob=True,
            default_interaction_type=InteractionType.RANDOM,
        )
        self.critic = ValueOperator(self.surveyor.critic(), in_keys=["observation"])
        self.advantage = GAE(gamma=settings.gamma, lmbda=settings.lmbda, value_network=self.critic)
        self.loss = ClipPPOLoss(
            self.actor,
            self.critic,
            clip_epsilon=settings.clip,
            entropy_coeff=settings.entropy,
            normalize_advantage=True,
        )
        self.optimizer = torch.optim.Adam(self.loss.parameters(), lr=settings.rate)

    def learn(self, batch: TensorDict, random: torch.Generator) -> float:
        """Some epochs over a batch (environments, time); the mean loss."""
        settings = self.settings
        with torch.no_grad():
            self.advantage(batch)
        flat, total, updates = batch.reshape(-1), 0.0, 0
        for _epoch in range(settings.epochs):
            order = torch.randperm(len(flat), generator=random)
            for some in torch.split(order, settings.minibatch):
                parts = self.loss(flat[some])
                loss = sum(value for key, value in parts.items() if key.startswith("loss_"))
                self.optimizer.zero_grad()
                torch.autograd.backward(loss)
                torch.nn.utils.clip_grad_norm_(self.loss.parameters(), settings.norm)
                self.optimizer.step()
                total, updates = total + float(loss.detach()), updates + 1
        return total / updates


def train(
    settings: PpoSettings, tracker: Tracker, folder: Path, resume: bool, report: Report
) -> dict[str, Any]:
    """Train by the published recipe; the best policy, and a log line per iteration."""
    torch.manual_seed(settings.seed)
    learner = Learner(settings)
    drawn = np.random.default_rng([settings.seed, 13])
    dynamics = Dynamics(published_vessel())
    world = Survey(settings.task, settings.environments, dynamics, tracker, drawn)
    random = torch.Generator().manual_seed(settings.seed)
    kept = Checkpoint(folder, asdict(settings), learner.loss, learner.optimizer)
    best: dict[str, Any] = {"reward": -np.inf, "iteration": 0, "weights": {}}
    done = kept.restore(random) if resume else 0
    if done:
        world.restore(kept.more["world"])
        best = kept.more["best"]
    for iteration in range(done, settings.iterations):
        if iteration - best["iteration"] >= settings.patience and iteration:
            break
        batch, ended = collect(world, learner, settings.frames // settings.environments)
        reward = float(batch["next", "reward"].mean())
        if reward > best["reward"]:
            weights = copy.deepcopy(learner.surveyor.state_dict())
            best = {"reward": reward, "iteration": iteration + 1, "weights": weights}
        loss = learner.learn(batch, random)
        share = {name: ended.count(name) for name in sorted(set(ended))}
        kept.add({"iteration": iteration + 1, "reward": reward, "loss": loss, **share})
        report(f"PPO, mean reward {reward:.2f}", iteration + 1, settings.iterations)
        if kept.due(5 * (iteration + 1), 5 * settings.iterations):
            kept.save(iteration + 1, random, {"world": world.snapshot(), "best": best})
    learner.surveyor.load_state_dict(best["weights"])
    return {"policy": learner.surveyor, "losses": kept.log, "best": best["iteration"]}


@torch.no_grad()
def collect(world: Survey, learner: Learner, options: int) -> tuple[TensorDict, list[str]]:
    """A batch (environments, options) under the policy, and how episodes ended."""
    steps, outcomes = [], []
    for _option in range(options):
        step = learner.actor(TensorDict({"observation": world.observe()}, [world.count]))
        ended = world.step(step["action"])
        after = {
            "observation": world.observe(),
            "reward": ended.reward[:, None],
            "terminated": ended.terminated[:, None],
            "done": ended.done[:, None],
        }
        step["next"] = TensorDict(after, [world.count])
        steps.append(step)
        outcomes += [one for one in ended.outcome if one]
        world.reset(torch.nonzero(ended.done)[:, 0].tolist())
    return torch.stack(steps, dim=1), outcomes
