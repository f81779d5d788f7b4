"""What a reviewer must know about a plan before it is approved: one plain sentence each, the most
serious first.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from planner_ft.document.track import track
from planner_ft.document.warnings.answers import answer_warnings
from planner_ft.document.warnings.command import command_warnings
from planner_ft.document.warnings.endurance import endurance_warnings
from planner_ft.document.warnings.order import order_warnings
from planner_ft.document.warnings.space import space_warnings
from planner_ft.document.warnings.values import value_warnings
from planner_ft.document.warnings.warning import KINDS, NOTES, SERIOUS, Warning
from planner_ft.vocabulary import Vocabulary

__all__ = ["KINDS", "NOTES", "SERIOUS", "warnings"]


def warnings(document: Mapping[str, Any], vocabulary: Vocabulary) -> list[Warning]:
    """The warnings of a document, by kind as in KINDS and in the order of the plan. It needs the
    tasks' sources and the estimate.
    """
    document = {
        **document,
        "tasks": [
            {**task, "number": number} for number, task in enumerate(document["tasks"], start=1)
        ],
    }
    path = track(document, vocabulary)
    found = [
        *answer_warnings(document),
        *order_warnings(document, vocabulary),
        *space_warnings(document, path, vocabulary),
        *endurance_warnings(document, path, vocabulary),
        *command_warnings(document, vocabulary),
        *value_warnings(document, vocabulary),
    ]
    unique: dict[str, Warning] = {}
    for item in found:
        # Two of one id say the same: the first stays.
        unique.setdefault(item["id"], item)
    return sorted(unique.values(), key=lambda item: KINDS.index(item["kind"]))
