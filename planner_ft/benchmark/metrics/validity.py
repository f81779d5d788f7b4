"""Validity of an answer in two strengths."""

from __future__ import annotations

from typing import Any

from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import Level, plan_problems


def schema_valid(level: Level, plan: dict[str, Any] | None, vocabulary: Vocabulary) -> bool:
    """Whether an answer parsed and has the structure of a plan of this level
    (`schemas/LEVEL.schema.json`). The published definition: an invented name can be schema-valid.
    """
    return plan is not None and not plan_problems(level, plan, vocabulary, strict=False)


def strict_valid(level: Level, plan: dict[str, Any] | None, vocabulary: Vocabulary) -> bool:
    """Whether an answer is schema-valid and every name, role, parameter name, type and range is of
    the vocabulary (`schemas/LEVEL.strict.schema.json`).
    """
    return plan is not None and not plan_problems(level, plan, vocabulary, strict=True)
