"""Sampling an answer instead of taking the most probable tokens: for runs that ask the same thing
several times.

Every token of an answer has its own random number, which depends on seed, repeat, sample and place
alone. So an answer depends on none of what the batch holds, how large it is and what was drafted or
forced, as long as the logits do not.
"""

from __future__ import annotations

import hashlib
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from planner_ft.decoding.constraints import Mask
from planner_ft.support.errors import PlannerError

if TYPE_CHECKING:
    from torch import Tensor

HUGE = 1e30
Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Sampling:
    """Tokens are drawn at `temperature` (above 0) from the most probable ones that together hold
    `top_p` of the probability.

    `repeat` counts from 1: each repeat of a sample has its own random numbers. Raises PlannerError
    for settings out of range.
    """

    temperature: float
    top_p: float = 1.0
    seed: int = 0
    repeat: int = 1

    def __post_init__(self) -> None:
        if not 0 < self.temperature <= 10:
            raise PlannerError(
                f"--temperature {self.temperature:g}: must be above 0 and at most 10"
            )
        if not 0 < self.top_p <= 1:
            raise PlannerError(f"--top-p {self.top_p:g}: must be above 0 and at most 1")

    def seed_of(self, name: str) -> int:
        """The seed of one answer, of 128 bits; `name` tells it from those to other samples."""
        digest = hashlib.sha256(f"{self.seed}\0{self.repeat}\0{name}".encode()).digest()
        return int.from_bytes(digest[:16])

    def sampler(self, name: str, longest: int) -> Sampler:
        """The random numbers of one answer of at most `longest` tokens."""
        numbers = np.random.default_rng(self.seed_of(name)).random(longest)
        return Sampler(self.temperature, self.top_p, numbers)


@dataclass(frozen=True)
class Sampler:
    """Draws the tokens of one answer; `numbers` holds one in [0, 1) for every place in it."""

    temperature: float
    top_p: float
    numbers: Floats

    def draw(self, place: int, logits: Tensor, allowed: Mask | None = None) -> int:
        """The token at a place of the answer from its logits, shape (tokens); with `allowed`, one
        of those that a constraint allows.

        By inversion over token ids, in float64: where rounding swaps two tokens of like
        probability, what is drawn stays the same.
        """
        raw = logits.detach().double().cpu().numpy()
        scores = np.nan_to_num(raw, nan=-HUGE, posinf=HUGE, neginf=-HUGE)
        usable = np.full(len(scores), True)
        if allowed is not None:
            usable = np.unpackbits(allowed.view(np.uint8), bitorder="little")[: len(scores)] == 1
        if not usable.any():
            raise RuntimeError("the constraint allows no token")
        below = np.minimum(scores - scores[usable].max(), 0)
        weights = np.where(usable, np.exp(below / self.temperature), 0)
        if self.top_p < 1:
            # The smallest set of tokens that holds `top_p` (Holtzman et al. 2020), the others at 0.
            order = np.argsort(-weights, kind="stable")
            before = weights[order].cumsum() - weights[order]
            weights[order[before >= self.top_p * weights.sum()]] = 0
        cumulative = weights.cumsum()
        drawn = np.searchsorted(cumulative, self.numbers[place] * cumulative[-1], side="right")
        # Rounding may put the number at the very end, where tokens without any weight may stand.
        return min(int(drawn), int(np.flatnonzero(weights)[-1]))
