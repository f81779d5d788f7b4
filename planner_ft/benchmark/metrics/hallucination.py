"""Hallucination: names that are not in the vocabulary."""

from __future__ import annotations

from typing import Any

from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import Level, plan_names

UNPARSED_COUNTS: dict[Level, bool] = {"mission": True, "task": False}
"""Whether the published tables count an answer that does not parse as hallucinated."""


def hallucinated(
    level: Level, plan: dict[str, Any] | None, vocabulary: Vocabulary, *, unparsed: bool
) -> bool:
    """Whether an answer has at least one name that is not in the vocabulary; `unparsed` is the
    verdict on a plan of None.
    """
    return unparsed if plan is None else bool(invented_names(level, plan, vocabulary))


def invented_names(level: Level, plan: dict[str, Any], vocabulary: Vocabulary) -> list[str]:
    """Names of the plan that are not in the vocabulary, in order."""
    known = vocabulary.task if level == "mission" else vocabulary.skill
    return [name for name in plan_names(level, plan) if name not in known]
