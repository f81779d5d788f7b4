"""Strict validity: a plan that the vehicle's definition allows."""

from __future__ import annotations

from typing import Any

from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import Level, plan_problems


def strict_valid(level: Level, plan: dict[str, Any] | None, vocabulary: Vocabulary) -> bool:
    """Whether an answer is schema-valid and every name, role, parameter name, type and range is of
    the vocabulary.

    `schemas/LEVEL.strict.schema.json` states the same rules.
    """
    return plan is not None and not plan_problems(level, plan, vocabulary, strict=True)
