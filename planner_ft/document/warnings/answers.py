"""Answers of the agents that cannot be used, and tasks whose skills are missing or out of date."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from planner_ft.document.warnings.warning import Warning, named, warning


def answer_warnings(document: Mapping[str, Any]) -> Iterator[Warning]:
    """Answers that are not valid, a plan without tasks, skills that are stale or missing."""
    if document.get("problems"):
        yield warning(
            "invalid-answer", f"The Mission Agent's answer is not valid: {document['problems'][0]}."
        )
    elif not document["tasks"]:
        reason = next(iter(document.get("constraints", ())), "no reason is given")
        yield warning("empty-plan", f"The plan has no tasks ({reason.rstrip('.')}).")
    for task in document["tasks"]:
        if task.get("problems"):
            yield warning(
                "invalid-answer",
                f"{named(task)}: the Task Agent's answer is not valid: {task['problems'][0]}.",
                task,
            )
        elif task.get("stale"):
            yield warning(
                "stale-skills",
                f"{named(task)} was changed after its skills were planned; plan its skills again.",
                task,
            )
        elif task.get("skill_sequence") is None and "waits_for" not in task:
            yield warning("no-skills", f"{named(task)} has no skills yet.", task)
