"""Abstention: commands that ask for nothing the vehicle can do, and those that do not.

Such a command is answered by a plan without tasks (and a constraint that says why). A refusal is a
plan without tasks, too: an output that does not parse refuses nothing, so that a model that breaks
down is not praised for its caution.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from planner_ft.vocabulary.plans import Level, list_key


def refuses(level: Level, plan: Mapping[str, Any] | None) -> bool:
    """Whether an answer is a plan without entries."""
    return plan is not None and plan.get(list_key(level)) == []


def right_refusal(
    level: Level, plan: Mapping[str, Any] | None, expected: Mapping[str, Any]
) -> bool | None:
    """Whether an impossible command is refused; None for a possible one."""
    return refuses(level, plan) if refuses(level, expected) else None


def wrong_refusal(
    level: Level, plan: Mapping[str, Any] | None, expected: Mapping[str, Any]
) -> bool | None:
    """Whether a possible command is refused; None for an impossible one."""
    return None if refuses(level, expected) else refuses(level, plan)
