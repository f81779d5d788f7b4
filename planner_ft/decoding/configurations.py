"""Configurations: with or without the adapter, and how strongly decoding is constrained."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, get_args

from planner_ft.support.errors import PlannerError

Strength = Literal["free", "schema", "state", "grounded"]
STRENGTHS: tuple[Strength, ...] = get_args(Strength)
"""From weak to strong, each with what the ones before it enforce. free: greedy generation, nothing
enforced, the published protocol; schema: the strict schema; state: the logic of the plan; grounded:
the facts of the command.
"""
WEIGHTS = ("base", "lora")


@dataclass(frozen=True)
class Configuration:
    """How a candidate is used: `adapter` says whether the fine-tuned one is, `strength` what
    decoding enforces.
    """

    adapter: bool
    strength: Strength = "free"

    @property
    def name(self) -> str:
        """As it is written in --configurations and in results: "base", "lora", "lora+STRENGTH"."""
        weights = WEIGHTS[self.adapter]
        return weights if self.strength == "free" else f"{weights}+{self.strength}"


def parse_configuration(text: str) -> Configuration:
    """Read "base", "lora", "base+STRENGTH" or "lora+STRENGTH". Raises PlannerError that names what
    there is.
    """
    weights, _, wanted = text.strip().partition("+")
    strength = next((known for known in STRENGTHS if known == (wanted or "free")), None)
    if weights not in WEIGHTS or strength is None or text.strip().endswith("+"):
        raise PlannerError(
            f"--configurations {text.strip()}: unknown; there are"
            f" {', '.join(known_configurations())}"
        )
    return Configuration(weights == "lora", strength)


def known_configurations() -> list[str]:
    """Every configuration's name."""
    return [
        Configuration(adapter, strength).name for strength in STRENGTHS for adapter in (False, True)
    ]
