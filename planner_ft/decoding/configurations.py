"""Configurations: with or without adapter, how strongly constrained; what ends an answer."""

from dataclasses import dataclass
from typing import Literal, get_args

from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary.plans import Level

Strength = Literal["free", "schema", "state", "grounded"]
STRENGTHS: tuple[Strength, ...] = get_args(Strength)
"""From weak to strong, each with what the ones before it enforce. free: greedy generation, nothing
enforced, the published protocol; schema: the strict schema; state: the logic of the plan; grounded:
the facts of the command.
"""
WEIGHTS = ("base", "lora")
MAX_NEW_TOKENS: dict[Level, int] = {"mission": 2048, "task": 2048}
"""Default limits per answer; a mission of 18 tasks that all hold a limit takes 1,500 tokens."""


@dataclass(frozen=True)
class Limits:
    """Ends of an answer."""

    end_ids: tuple[int, ...]
    max_new_tokens: int


@dataclass(frozen=True)
class Configuration:
    """`adapter`: whether the fine-tuned one is used; `strength`: what decoding enforces."""

    adapter: bool
    strength: Strength = "free"

    @property
    def name(self) -> str:
        """As it is written in --configurations and in results: "base", "lora", "lora+STRENGTH"."""
        weights = WEIGHTS[self.adapter]
        return weights if self.strength == "free" else f"{weights}+{self.strength}"


def parse_configuration(text: str) -> Configuration:
    """Read "base", "lora+STRENGTH" ... Raises PlannerError that names what there is."""
    every = [Configuration(adapter, one) for one in STRENGTHS for adapter in (False, True)]
    known = {one.name: one for one in every}
    spelt = {f"{one.name}+free": one for one in every[:2]} | known
    if (name := text.strip()) not in spelt:
        raise PlannerError(f"--configurations {name}: unknown; there are {', '.join(known)}")
    return spelt[name]
