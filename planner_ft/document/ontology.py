"""What a command says and what it lacks: objective, target or place, sensors and data, constraints."""

from __future__ import annotations

from typing import Any

from planner_ft.vocabulary import Vocabulary


def check(command: str, vocabulary: Vocabulary) -> dict[str, Any]:
    """{"elements", "missing", "questions"} of a command."""
    return {"elements": [], "missing": [], "questions": []}
