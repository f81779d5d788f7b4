"""Whether the steps of a task perform it: a grid covers its area, a pass has its length, a line
ends where its course leads, a square keeps its stand-off, a panorama looks in all its directions.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Mapping
from typing import Any

from planner_ft.document.warnings.warning import Warning, named, warning
from planner_ft.planning.shapes import SHARE, SLACK, shape_problem
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import is_number

Point = tuple[float, float]
LENGTH = "length"
"""The parameter of a pass."""
MEASURES = ("m", "s", "m/s", "count")
"""Units of what cannot be nothing; an angle and a share can."""
TURNS = ("turn-to", "turn-by")


def performed_warnings(document: Mapping[str, Any], vocabulary: Vocabulary) -> Iterator[Warning]:
    """One per task without a step that fits it, or whose waypoints are not those of its values.

    Waypoints that were added for clearance count with neither.
    """
    for task in document["tasks"]:
        yield from _nothing(task, vocabulary)
        steps = task["skill_sequence"] or []
        # A search may go anywhere.
        if not steps or task.get("stale") or task["title"] == vocabulary.locate:
            continue
        fitting = vocabulary.task[task["title"]].skills.get("navigation", ())
        if not any(step["navigation_skill"]["name"] in fitting for step in steps):
            text = f"{named(task)}: no step performs it; its steps do something else."
            yield warning("not-performed", text, task)
        elif problem := _geometry_problem(task, _waypoints(task, vocabulary), vocabulary):
            yield warning("not-performed", f"{named(task)}: {problem}.", task)


def _nothing(task: Mapping[str, Any], vocabulary: Vocabulary) -> Iterator[Warning]:
    """A size, distance, time or count of a task that is nothing."""
    for item in vocabulary.task[task["title"]].parameters:
        if item.unit in MEASURES and task["parameters"].get(item.name) == 0:
            text = f"{named(task)}: {item.name} is 0, with which nothing can be done."
            yield warning("not-performed", text, task, item.name)


def _waypoints(task: Mapping[str, Any], vocabulary: Vocabulary) -> list[Point]:
    clearance = {mark["step"] for mark in task.get("added", ()) if mark["kind"] == "clearance"}
    found = []
    for index, step in enumerate(task["skill_sequence"]):
        skill = step["navigation_skill"]
        names = [parameter.name for parameter in vocabulary.skill[skill["name"]].coordinates]
        if names and index not in clearance:
            found.append((skill["parameters"][names[0]], skill["parameters"][names[1]]))
    return found


def _geometry_problem(
    task: Mapping[str, Any], points: list[Point], vocabulary: Vocabulary
) -> str | None:
    known, given = vocabulary.task[task["title"]], task["parameters"]
    if known.pattern == "sectors" and is_number(count := given.get("sectors")):
        names = [step["navigation_skill"]["name"] for step in task["skill_sequence"]]
        motions = [vocabulary.motion.of(name) for name in names]
        turns = sum(motion is not None and motion.kind in TURNS for motion in motions)
        return f"it turns {turns} times for {count:g} sectors" if turns < count - 1 else None
    length = given.get(LENGTH)
    if known.pattern == "pass" and is_number(length) and points:
        pairs = itertools.combinations(points, 2)
        run = max((math.dist(*pair) for pair in pairs), default=0.0)
        if run < length * (1 - SHARE) - SLACK:
            return f"its waypoints are {run:.3g} m apart, and its length is {length:g} m"
    return shape_problem(task, points, vocabulary)
