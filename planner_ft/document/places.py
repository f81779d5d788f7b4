"""Open and located places of a plan document.

A located place stands as `located` beside the parameters of its tasks: {parameter: name}. Its name
stays that under which the plan left it open.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from planner_ft.planning.locations import OpenPlace, open_places
from planner_ft.vocabulary import Vocabulary


def locate_parameters(
    plan: dict[str, Any], filled: Sequence[dict[str, Any]], vocabulary: Vocabulary
) -> dict[int, dict[str, str]]:
    """Per task number (from 1) the parameters that `filled` holds a position for where the plan
    leaves it open, with the place's name.
    """
    located: dict[int, dict[str, str]] = {}
    for place in open_places(plan, vocabulary):
        for number in place.tasks:
            parameter = _position(plan["tasks"][number - 1], vocabulary)
            if filled[number - 1][parameter] != list(vocabulary.unresolved):
                located[number] = {parameter: place.name}
    return located


def places_of(tasks: Sequence[dict[str, Any]], vocabulary: Vocabulary) -> list[OpenPlace]:
    """The places that a document's tasks leave open."""
    return open_places({"tasks": [_known(task, vocabulary) for task in tasks]}, vocabulary)


def tasks_at(
    name: str, tasks: Sequence[dict[str, Any]], vocabulary: Vocabulary
) -> list[tuple[dict[str, Any], str]]:
    """The tasks at a place, open or located already, each with the parameter that holds its
    position.
    """
    waiting = {
        number
        for place in places_of(tasks, vocabulary)
        if place.name == name
        for number in place.tasks
    }
    found = [
        (task, _position(task, vocabulary))
        for number, task in enumerate(tasks, start=1)
        if number in waiting
    ]
    return found + [
        (task, parameter)
        for task in tasks
        for parameter, located in task.get("located", {}).items()
        if located == name
    ]


def _position(task: dict[str, Any], vocabulary: Vocabulary) -> str:
    return vocabulary.task[task["title"]].position_parameter or ""


def _known(task: dict[str, Any], vocabulary: Vocabulary) -> dict[str, Any]:
    return {
        "title": task["title"],
        "parameters": task["parameters"],
        "task_prompt": task["task_prompt"],
    }
