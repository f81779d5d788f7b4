"""What a mission plan lacks of its command and what it has too much, counted: for a second look at it (planner_ft.decoding.second_look)."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

from planner_ft.document.language import language
from planner_ft.document.lost import lost_values
from planner_ft.document.said import read_command
from planner_ft.document.warnings.command import unanswered
from planner_ft.vocabulary import Vocabulary


def count_lacking(command: str, answer: str, vocabulary: Vocabulary) -> int | None:
    """How many stated values and instructions no task of a plan in JSON answers, how many tasks stand in it for another, and how many no word asks for.

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
    found = (
        lost_values(said, tasks, (), vocabulary),
        unanswered(command, titles, vocabulary),
        _repeated(tasks, vocabulary),
        _groundless(command, titles, vocabulary),
    )
    return sum(1 for items in found for _item in items)


def _groundless(command: str, titles: Iterable[str], vocabulary: Vocabulary) -> Iterator[str]:
    """The titles of tasks that no word of the command can mean."""
    hints = language(vocabulary).hints
    yield from (title for title in titles if title in hints and not hints[title].search(command))


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
