"""Whether the steps of a task perform it: a grid covers its area, a pass has its length, a line
ends where its course leads, a square keeps its stand-off, a panorama looks in all its directions.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Mapping
from typing import Any

from planner_ft.document.track import Point
from planner_ft.document.warnings.case import Case
from planner_ft.document.warnings.kinds import Warning, warning
from planner_ft.planning.shapes import SHARE, SLACK, shape_problem
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import is_number

LENGTH = "length"
"""The parameter of a pass."""
MEASURES = ("m", "s", "m/s", "count")
"""Units of what cannot be nothing; an angle and a share can."""
TURNS = ("turn-to", "turn-by")


def performed(case: Case) -> Iterator[Warning]:
    """One per task without a step that fits it, or whose waypoints are not those of its values.

    Waypoints that were added for clearance count with neither.
    """
    known = case.vocabulary
    for task in case.tasks:
        definition, steps = known.task[task["title"]], task["skill_sequence"] or []
        for item in definition.parameters:
            if item.unit in MEASURES and task["parameters"].get(item.name) == 0:
                yield warning("not-performed", "nothing", task, item.name, name=item.name)
        # A search may go anywhere.
        if not steps or task.get("stale") or task["title"] == known.locate:
            continue
        names = [step["navigation_skill"]["name"] for step in steps]
        if not {*names} & {*definition.skills.get("navigation", ())}:
            yield warning("not-performed", "else", task)
        elif problem := _problem(task, names, known):
            yield warning("not-performed", "shape", task, problem=problem)


def _problem(task: Mapping[str, Any], names: list[str], known: Vocabulary) -> str | None:
    """How waypoints and turns of a task (`names`: its movements) differ from its values."""
    pattern, points = known.task[task["title"]].pattern, _waypoints(task, known)
    if pattern == "sectors" and is_number(count := task["parameters"].get("sectors")):
        motions = [known.motion.of(name) for name in names]
        turns = sum(motion is not None and motion.kind in TURNS for motion in motions)
        return f"it turns {turns} times for {count:g} sectors" if turns < count - 1 else None
    length = task["parameters"].get(LENGTH)
    if pattern == "pass" and is_number(length) and points:
        pairs = itertools.combinations(points, 2)
        run = max((math.dist(*pair) for pair in pairs), default=0.0)
        if run < length * (1 - SHARE) - SLACK:
            return f"its waypoints are {run:.3g} m apart, and its length is {length:g} m"
    return shape_problem(task, points, known)


def _waypoints(task: Mapping[str, Any], vocabulary: Vocabulary) -> list[Point]:
    clearance = {mark["step"] for mark in task.get("added", ()) if mark["kind"] == "clearance"}
    found = []
    for index, step in enumerate(task["skill_sequence"]):
        skill = step["navigation_skill"]
        names = [parameter.name for parameter in vocabulary.skill[skill["name"]].coordinates]
        if names and index not in clearance:
            found.append((skill["parameters"][names[0]], skill["parameters"][names[1]]))
    return found
