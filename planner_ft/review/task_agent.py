"""Asking the Task Agent again during a review: the one that planned, loaded at the first question."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from planner_ft.document import PlanDocument
from planner_ft.planning.agents import Progress, silent
from planner_ft.planning.planner import Planner
from planner_ft.planning.result import Answer
from planner_ft.planning.settings import DEFAULT_CANDIDATE, PlanSettings
from planner_ft.vocabulary import Vocabulary


def settings_of(document: PlanDocument, vocabulary: Vocabulary, candidate: str | None = None, device: str = "auto") -> PlanSettings:
    """The settings under which the skills of a document were planned; of another candidate, the defaults."""
    made = document["manifest"].get("agents", {}).get("task", {})
    if candidate or not made:
        return PlanSettings(candidate or DEFAULT_CANDIDATE, vocabulary=vocabulary.source, device=device)
    adapter = made.get("adapter")
    return PlanSettings(
        made["candidate"], task_configuration=made.get("configuration"), quantization=made.get("quantization"),
        task_adapter=adapter if adapter and Path(adapter).is_dir() else None, vocabulary=vocabulary.source, device=device,
    )  # fmt: skip


class TaskAgent:
    """The Task Agent of these settings. Calling it raises PlannerError where the model is not there, or the task's place is open."""

    def __init__(self, settings: PlanSettings, progress: Progress = silent) -> None:
        self._settings, self._progress = settings, progress
        self._planner: Planner | None = None

    def __call__(self, task: Mapping[str, Any]) -> Answer:
        if self._planner is None:
            self._planner = Planner(self._settings, self._progress)
        return self._planner.skills(task)
