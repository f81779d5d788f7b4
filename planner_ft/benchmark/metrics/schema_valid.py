"""Schema validity: the structure of a plan, whatever its names."""

from __future__ import annotations

from typing import Any

from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import Level, plan_problems


def schema_valid(level: Level, plan: dict[str, Any] | None, vocabulary: Vocabulary) -> bool:
    """Whether an answer parsed and has the structure of a plan of this level
    (`schemas/LEVEL.schema.json`).

    The published definition: an invented name can be schema-valid.
    """
    return plan is not None and not plan_problems(level, plan, vocabulary, strict=False)
