"""What a reviewer must know before approval: one plain sentence each, the most serious first."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from planner_ft.document.track import Track
from planner_ft.document.warnings.command import command_warnings
from planner_ft.document.warnings.data import data_warnings
from planner_ft.document.warnings.limits import limit_warnings
from planner_ft.document.warnings.performed import performed_warnings
from planner_ft.document.warnings.route import order_warnings, range_warnings, space_warnings
from planner_ft.document.warnings.said import said_warnings
from planner_ft.document.warnings.values import value_warnings, worked_out_warnings
from planner_ft.document.warnings.warning import KINDS, NOTES, SERIOUS, Warning, named, warning
from planner_ft.planning.frame import doubt, origin_of
from planner_ft.vocabulary import Vocabulary

__all__ = ["KINDS", "NOTES", "SERIOUS", "warnings"]


def warnings(document: Mapping[str, Any], vocabulary: Vocabulary, path: Track) -> list[Warning]:
    """The warnings by kind, then in the plan's order; needs sources, estimate and track."""
    tasks = [{**task, "number": number} for number, task in enumerate(document["tasks"], start=1)]
    document = {**document, "tasks": tasks}
    found = [
        *_answer_warnings(document),
        *limit_warnings(document, path, vocabulary),
        *order_warnings(document, vocabulary),
        *space_warnings(document, path, vocabulary),
        *range_warnings(document, path, vocabulary),
        *command_warnings(document, vocabulary),
        *data_warnings(document, vocabulary),
        *performed_warnings(document, vocabulary),
        *said_warnings(document, vocabulary),
        *value_warnings(document, vocabulary),
    ]
    if any(item["kind"] == "value-lost" for item in found):
        found += worked_out_warnings(document, vocabulary)
    # Two of one id say the same: the first stays.
    unique = {item["id"]: item for item in reversed(found)}
    kept = [item for item in found if item is unique[item["id"]]]
    return sorted(kept, key=lambda item: KINDS.index(item["kind"]))


def _answer_warnings(document: Mapping[str, Any]) -> Iterator[Warning]:
    """Invalid answers, a doubtful origin, a plan without tasks, stale or missing skills."""
    if document.get("problems"):
        problem = document["problems"][0]
        yield warning("invalid-answer", f"The Mission Agent's answer is not valid: {problem}.")
    elif not document["tasks"]:
        reason = next(iter(document.get("constraints", ())), "no reason is given")
        yield warning("empty-plan", f"The plan has no tasks ({reason.rstrip('.')}).")
    origin = origin_of(document)
    if origin and (reason := doubt(document["command"], origin)):
        yield warning("doubtful-origin", reason)
    asking = [task for task in document["tasks"] if "asks" in task]
    for task, text in zip(asking, document.get("questions", ()), strict=False):
        yield warning("value-asked", text, task)
    for task in document["tasks"]:
        if task.get("problems"):
            text = f"the Task Agent's answer is not valid: {task['problems'][0]}."
            yield warning("invalid-answer", f"{named(task)}: {text}", task)
        elif task.get("stale"):
            text = "was changed after its skills were planned; plan its skills again."
            yield warning("stale-skills", f"{named(task)} {text}", task)
        elif task.get("skill_sequence") is None and not {"waits_for", "asks"} & task.keys():
            yield warning("no-skills", f"{named(task)} has no skills yet.", task)
