"""What a reviewer must know about a plan."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from planner_ft.vocabulary import Vocabulary


def warnings(document: Mapping[str, Any], vocabulary: Vocabulary) -> list[dict[str, Any]]:
    """Warnings, most serious first."""
    return []
