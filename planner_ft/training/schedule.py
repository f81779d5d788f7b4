"""The learning rate as a function of the step: there is no scheduler state to save or to lose."""

from __future__ import annotations

import math

from planner_ft.training.settings import TrainSettings


def warmup_steps(settings: TrainSettings, total: int) -> int:
    """Steps of linear warm-up."""
    return math.ceil(settings.warmup * total)


def learning_rate(settings: TrainSettings, step: int, total: int) -> float:
    """Learning rate of optimiser step `step` (from 0) of `total`: linear warm-up, then the schedule
    down to zero.
    """
    warm = warmup_steps(settings, total)
    if step < warm:
        return settings.learning_rate * (step + 1) / warm
    if settings.schedule == "constant":
        return settings.learning_rate
    progress = (step - warm) / max(1, total - warm)
    factor = (
        1 - progress if settings.schedule == "linear" else 0.5 * (1 + math.cos(math.pi * progress))
    )
    return settings.learning_rate * factor
