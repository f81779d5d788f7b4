"""How much of a command is not in a mission plan: planning chooses between plans by it."""

from collections.abc import Mapping
from typing import Any

from planner_ft.document.build import build
from planner_ft.planning.essentials import with_defaults
from planner_ft.planning.result import Answer, Planned, PlannedTask
from planner_ft.vocabulary import Vocabulary

LOSSES = frozenset(
    {
        *("not-planned", "value-lost", "repeat-lost", "limit-lost", "condition-lost"),
        *("data-not-planned", "thing-not-mentioned", "value-not-said", "contradiction"),
        *("used-before-found", "unresolved-location", "value-asked", "empty-plan"),
    }
)
"""Kinds of warnings on what the command says and the plan has not, or has and nobody says."""


def lost(command: str, plan: Mapping[str, Any], vocabulary: Vocabulary) -> int:
    """The warnings of these kinds on a mission plan, before any skills are planned."""
    tasks = tuple(PlannedTask(**with_defaults(task, vocabulary)) for task in plan["tasks"])
    answer = Answer("", dict(plan), (), (), 0, 0, 0, 0.0)
    document = build(Planned(command, answer, tasks, ()), vocabulary)
    return sum(one["kind"] in LOSSES for one in document["warnings"])
