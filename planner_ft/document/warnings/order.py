"""Places that are not known, and tasks that cannot be carried out where they stand in the plan."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from planner_ft.data.quantities import positions
from planner_ft.document.said import is_place
from planner_ft.document.warnings.warning import Warning, named, warning
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.replay import START, Condition, stops

KIND_OF: dict[Condition, str] = {
    "target located": "used-before-found",
    "vehicle at the place": "not-at-place",
    "position known": "position-missing",
    "data collected": "data-not-collected",
}


def order_warnings(document: Mapping[str, Any], vocabulary: Vocabulary) -> Iterator[Warning]:
    """One per open place, and what a replay of the plan stops at."""
    tasks = document["tasks"]
    for place in document.get("open_places", ()):
        first = tasks[place["tasks"][0] - 1]
        parameter = vocabulary.task[first["title"]].position_parameter
        needed = (
            f"task{'s' if len(place['tasks']) > 1 else ''} {', '.join(map(str, place['tasks']))}"
        )
        text = (
            f"Where {place['name']} is, is not known; {needed} cannot be carried out before it is"
            " located."
        )
        yield {
            **warning("unresolved-location", text, about=place["name"]),
            "task": first["id"],
            "parameter": parameter,
        }
    yield from _elsewhere(tasks, vocabulary)
    for stop, _missing in stops({"tasks": tasks}, vocabulary):
        kind = KIND_OF.get(stop.condition)
        if kind is not None:
            yield warning(
                kind,
                f"{named(tasks[stop.index])} cannot be carried out there: {stop.reason}.",
                tasks[stop.index],
            )


def _elsewhere(tasks: list[dict[str, Any]], vocabulary: Vocabulary) -> Iterator[Warning]:
    """Tasks that the vehicle must be brought to, at a place that their prompt names and no task
    before goes to.
    """
    progress = START
    for task in tasks:
        known, text = vocabulary.task[task["title"]], task["task_prompt"]
        places = [(x, y) for x, y, start, end in positions(text) if is_place(text, start, end)]
        if known.arrival == "transit" and places and progress.here not in places:
            reason = (
                f"its prompt names [{places[0][0]:g}, {places[0][1]:g}], and no"
                f" {vocabulary.transit} goes there before it"
            )
            yield warning(
                "not-at-place", f"{named(task)} cannot be carried out there: {reason}.", task
            )
        progress = progress.after(known, task["parameters"], vocabulary)
