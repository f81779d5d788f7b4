"""Everything in a plan document that follows from the rest of it."""

from __future__ import annotations

from typing import Any

from planner_ft.document.digest import document_digest
from planner_ft.document.estimate import estimate
from planner_ft.document.files import PlanDocument
from planner_ft.document.ontology import check
from planner_ft.document.places import places_of
from planner_ft.document.sources import sources
from planner_ft.document.warnings import warnings
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.document_schema import TASK_KEYS, document_keys
from planner_ft.vocabulary.plans import canonical_parameters


def revise(document: PlanDocument, vocabulary: Vocabulary) -> PlanDocument:
    """The document with all that derives made anew: open places, sources, estimate, warnings,
    whether it is valid and complete, the digest.
    """
    tasks = [_bare(task, vocabulary) for task in document["tasks"]]
    places = places_of(tasks, vocabulary)
    waiting = {number: place.name for place in places for number in place.tasks}
    for number, task in enumerate(tasks, start=1):
        if number in waiting:
            task["waits_for"] = waiting[number]
    valid = not any("problems" in part for part in (document, *tasks))
    revised = {
        **document,
        "tasks": tasks,
        "valid": valid,
        "complete": valid and all(task["skill_sequence"] is not None for task in tasks),
        "open_places": [{"name": place.name, "tasks": list(place.tasks)} for place in places],
        "ontology": check(document["command"], vocabulary),
    }
    for task, found in zip(tasks, sources(revised, vocabulary), strict=True):
        task["sources"] = found
    revised["estimate"] = estimate(revised, vocabulary)
    revised["warnings"] = warnings(revised, vocabulary)
    ordered = _ordered(revised, document_keys())
    return {
        **ordered,
        "tasks": [_ordered(task, TASK_KEYS) for task in tasks],
        "digest": document_digest({**ordered, "tasks": tasks}),
    }


def _bare(task: dict[str, Any], vocabulary: Vocabulary) -> dict[str, Any]:
    """A task without what derives, its parameters in the order of the definition."""
    kept = {key: value for key, value in task.items() if key not in ("waits_for", "sources")}
    return {
        **kept,
        "parameters": canonical_parameters(task["parameters"], vocabulary.task.get(task["title"])),
    }


def _ordered(value: dict[str, Any], keys: tuple[str, ...]) -> dict[str, Any]:
    return {key: value[key] for key in keys if key in value}
