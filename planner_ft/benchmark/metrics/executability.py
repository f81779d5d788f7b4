"""Executability: can the vehicle carry a mission plan out, task by task?

The plan is replayed (planner_ft.vocabulary.replay). The replay knows neither command nor expected
plan: a plan that runs to its end can still be another plan than the one that was asked for.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.replay import Stop, on_board, replay


def executable(
    plan: Mapping[str, Any] | None, expected: Mapping[str, Any], vocabulary: Vocabulary
) -> Stop | None:
    """Where a mission answer stops, or None when it runs to its end.

    Data that the expected plan sends or reports without collecting it is on board from before and
    given to the answer, too. An answer that does not parse, and one without tasks where tasks are
    expected, is no plan and stops at once: refusing everything is not executable.
    """
    entries = plan.get("tasks") if plan else None
    if not isinstance(entries, list) or (not entries and expected["tasks"]):
        reason = "the answer does not parse" if plan is None else "nothing is planned"
        return Stop(0, "", "plan given", reason)
    return replay(plan or {}, vocabulary, on_board(expected, vocabulary))
