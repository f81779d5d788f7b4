"""What a mission plan lacks of its command, counted: for a second look at it (planner_ft.decoding.second_look)."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from planner_ft.document.lost import lost_values
from planner_ft.document.said import read_command
from planner_ft.document.warnings.command import unanswered
from planner_ft.vocabulary import Vocabulary


def count_lacking(command: str, answer: str, vocabulary: Vocabulary) -> int | None:
    """How many stated values and instructions no task of a plan in JSON answers, and how many tasks stand in it for another.

    Task prompts and constraints do not count: what only they say is not carried out. None where there is no task, or where the
    command cannot be read with certainty.
    """
    try:
        tasks = json.loads(answer)["tasks"]
    except ValueError:
        return None
    said = read_command(command, vocabulary)
    if said.unread or not tasks:
        return None
    titles = {task["title"] for task in tasks}
    found = (lost_values(said, tasks, (), vocabulary), unanswered(command, titles, vocabulary), _repeated(tasks, vocabulary))
    return sum(1 for items in found for _item in items)


def _repeated(tasks: Sequence[Mapping[str, Any]], vocabulary: Vocabulary) -> Iterator[str]:
    """The titles of tasks that were done at the same place just so before."""
    place: list[float] | None = None
    searches, seen = 0, set[tuple[str, str, str, int]]()
    for task in tasks:
        parameter = vocabulary.task[task["title"]].position_parameter
        searches += task["title"] == vocabulary.locate
        place = task["parameters"].get(parameter, place) if parameter else place
        key = (task["title"], json.dumps(task["parameters"], sort_keys=True), str(place), searches)
        if key in seen and task["title"] != vocabulary.transit:
            yield task["title"]
        seen.add(key)
