"""Whether the steps of a task perform it: a grid covers its area, a pass has its length, a line
ends where its course leads, a square keeps its stand-off, a panorama looks in all its directions.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from planner_ft.document.warnings.case import Case
from planner_ft.document.warnings.kinds import Warning, warning
from planner_ft.planning.shapes import goal_of, shape_problem
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import is_number

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
    if known.task[task["title"]].pattern == "sectors":
        count, motions = task["parameters"].get("sectors"), map(known.motion.of, names)
        turns = sum(motion is not None and motion.kind in TURNS for motion in motions)
        few = is_number(count) and turns < count - 1
        return f"it turns {turns} times for {count:g} sectors" if few else None
    clearance = {mark["step"] for mark in task.get("added", ()) if mark["kind"] == "clearance"}
    goals = [goal_of(step, known) for step in task["skill_sequence"]]
    points = [goal for at, goal in enumerate(goals) if goal and at not in clearance]
    return shape_problem(task, points, known)
