"""What a record of the curated mission set must also hold: texts, and nothing said that is lost,
nothing written that was not said.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from typing import Any

from planner_ft.facts import near
from planner_ft.facts.numbers import read_numbers
from planner_ft.facts.places import read_positions
from planner_ft.support.files import compact_json
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import MISSION_KEYS, Level

UNUSED = frozenset({"rule.correction", "rule.exclusion", "rule.search-on-request"})
"""Tags of commands that say values which the plan does not take over."""


def completeness_problems(
    level: Level, record: dict[str, Any], vocabulary: Vocabulary
) -> Iterator[str]:
    """What is missing in a record whose plan is strictly valid; at task level nothing more is
    asked.
    """
    if level == "task":
        return
    expected = record["expected"]
    tasks = expected["tasks"]
    yield from (
        f"expected: tasks[{index}] {task['title']}: task_prompt is empty"
        for index, task in enumerate(tasks)
        if not task["task_prompt"].strip()
    )
    if not tasks and not expected["constraints"]:
        yield "expected: an empty task list needs a constraint that says why"
    if (
        any(
            value == list(vocabulary.unresolved)
            for task in tasks
            for value in task["parameters"].values()
        )
        and not expected["assumptions"]
    ):
        yield "expected: a plan with an unresolved place needs an assumption about it"
    for index, (task, following) in enumerate(itertools.pairwise(tasks)):
        if (task["title"], task["parameters"]) == (following["title"], following["parameters"]):
            yield f"expected: tasks[{index + 1}] {task['title']}: the same task again"
    yield from _invented_numbers(record, vocabulary)
    tags = record.get("tags")
    if isinstance(tags, list) and tasks and not UNUSED & set(map(str, tags)):
        yield from _lost_values(record)


def _invented_numbers(record: dict[str, Any], vocabulary: Vocabulary) -> Iterator[str]:
    """Numbers in the plan's texts that neither the command nor a parameter has."""
    expected, tasks = record["expected"], record["expected"]["tasks"]
    texts = {f"tasks[{index}].task_prompt": task["task_prompt"] for index, task in enumerate(tasks)}
    for key in MISSION_KEYS[1:]:
        texts |= {f"{key}[{index}]": text for index, text in enumerate(expected[key])}
    given = [task["parameters"] for task in tasks]
    said = compact_json([given, vocabulary.home, vocabulary.unresolved])
    numbers = (*read_numbers(record["prompt"]), *read_numbers(said))
    known = {abs(number) for found in numbers for number in (found.value, found.said)}
    for where, text in texts.items():
        for found in read_numbers(text):
            in_figures = text[found.start : found.end].lstrip("-−–")[:1].isdigit()
            if in_figures and not {abs(found.said), abs(found.value)} & known:
                yield (
                    f"expected: {where}: {found.said:g} is neither in the command nor in a parameter"
                )


def _lost_values(record: dict[str, Any]) -> Iterator[str]:
    """Quantities with a unit, and coordinates in brackets, that the command states and neither a
    parameter nor a constraint has.
    """
    expected, prompt = record["expected"], record["prompt"]
    values = [value for task in expected["tasks"] for value in task["parameters"].values()]
    flat = [one for value in values for one in (value if isinstance(value, list) else [value])]
    numbers = [number for number in flat if isinstance(number, int | float)]
    for text in (*expected["assumptions"], *expected["constraints"]):
        numbers += [found.value for found in read_numbers(text)]
    lost = [
        f"{prompt[found.start : found.end]!r} of the command stands"
        for found in read_numbers(prompt)
        if found.unit and not any(near(number, found.value) for number in numbers)
    ]
    lost += [
        f"the coordinates {prompt[place.start : place.end]!r} of the command stand"
        for place in read_positions(prompt)
        if prompt[place.start - 1 : place.start] in ("[", "(")
        and not ([place.x, place.y] in values or {place.x, place.y} <= set(numbers))
    ]
    yield from (f"expected: {text} in no parameter and no constraint" for text in lost)
