"""Abstention: commands that the vehicle cannot carry out are answered by a plan without tasks.

An output that does not parse refuses nothing: a model that breaks down is not praised for caution.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from planner_ft.vocabulary.plans import Level, list_key

Plan = Mapping[str, Any]


def refuses(level: Level, plan: Plan | None) -> bool:
    """Whether an answer is a plan without entries."""
    return plan is not None and plan.get(list_key(level)) == []


def right_refusal(level: Level, plan: Plan | None, expected: Plan) -> bool | None:
    """Whether an impossible command is refused; None for a possible one."""
    return refuses(level, plan) if refuses(level, expected) else None


def wrong_refusal(level: Level, plan: Plan | None, expected: Plan) -> bool | None:
    """Whether a possible command is refused; None for an impossible one."""
    return None if refuses(level, expected) else refuses(level, plan)
