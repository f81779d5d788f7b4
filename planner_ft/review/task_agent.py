"""Asking the Task Agent again during a review: the one that planned, loaded at the first
question.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from planner_ft.document import PlanDocument, read_document
from planner_ft.document.files import vocabulary_of
from planner_ft.planning.agents import Progress, silent
from planner_ft.planning.planner import Planner
from planner_ft.planning.result import Answer
from planner_ft.planning.settings import DEFAULT_CANDIDATE, PlanSettings
from planner_ft.vocabulary import Vocabulary, load_vocabulary
from planner_ft.vocabulary.definition import DEFAULT


def settings_of(
    document: PlanDocument,
    vocabulary: Vocabulary,
    candidate: str | None = None,
    device: str = "auto",
) -> PlanSettings:
    """The settings under which a document was planned; of another candidate, the defaults."""
    agents = {} if candidate else document["manifest"].get("agents", {})
    named: dict[str, Any] = {}
    for level, made in agents.items():
        named[f"{level}_candidate"], named[f"{level}_configuration"] = (
            made["candidate"],
            made.get("configuration"),
        )
        adapter = made.get("adapter")
        # An adapter that lies elsewhere now is looked for as `plannerft plan` does.
        named[f"{level}_adapter"] = adapter if adapter and Path(adapter).is_dir() else None
    return PlanSettings(
        candidate or DEFAULT_CANDIDATE, vocabulary=vocabulary.source, device=device, **named
    )


def planning_of(
    plan: Path | None, vocabulary: str | None, candidate: str | None, device: str
) -> PlanSettings:
    """The settings for planning beside a plan in a file: those under which it was planned; without
    a file the defaults. Raises PlannerError.
    """
    known = load_vocabulary(vocabulary) if vocabulary else None
    if plan is None:
        return PlanSettings(
            candidate or DEFAULT_CANDIDATE, vocabulary=vocabulary or DEFAULT, device=device
        )
    document = read_document(plan, known)
    return settings_of(document, known or vocabulary_of(document, plan), candidate, device)


class TaskAgent:
    """The Task Agent of these settings. Calling it raises PlannerError where the model is not
    there, or the task's place is open.
    """

    def __init__(self, settings: PlanSettings, progress: Progress = silent) -> None:
        self._settings, self._progress = settings, progress
        self._planner: Planner | None = None

    def __call__(self, task: Mapping[str, Any]) -> Answer:
        if self._planner is None:
            self._planner = Planner(self._settings, self._progress)
        return self._planner.skills(task)
