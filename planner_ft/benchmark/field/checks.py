"""What a plan document must do and say to pass a field case.

A command that was refused has no document but a sentence; only checks of what is said, and of what
must not be in a plan, can hold for it.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from planner_ft.benchmark.field.cases import Check
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import is_number, is_position, step_skills

Point = tuple[float, float]
PLACED = {"never_at", "clear", "visits", "outcome"}
RELATIVE, LEAST = 0.02, 0.011
"""How far a number may be from the wanted one: a share of it, and at least so much."""
POSITION, VISITED, AT, SLACK = 0.6, 1.5, 1.0, 0.5
"""Metres: between positions, from a place that is visited, from one that is not, off a distance."""


@dataclass(frozen=True)
class Outcome:
    """What a command came to: the plan document ({} for none), and the refusal."""

    document: Mapping[str, Any]
    error: str | None = None

    @property
    def tasks(self) -> list[dict[str, Any]]:
        return list(self.document.get("tasks", ()))

    @property
    def warnings(self) -> list[str]:
        return [warning["text"] for warning in self.document.get("warnings", ())]

    @property
    def silent(self) -> bool:
        """Whether the plan came without a warning."""
        return self.error is None and not self.warnings

    def texts(self) -> list[str]:
        """The refusal, warnings, assumptions, constraints and questions."""
        found = [*([self.error] if self.error else []), *self.warnings]
        for key in ("assumptions", "constraints", "questions"):
            found += self.document.get(key, ())
        return found + list(self.document.get("ontology", {}).get("questions", ()))


def passes(check: Check, outcome: Outcome, vocabulary: Vocabulary) -> bool:
    """Whether a plan, or the refusal to plan, passes a check."""
    if "any" in check:
        return any(passes(one, outcome, vocabulary) for one in check["any"])
    heard = {"says": outcome.texts(), "warns": [outcome.error or "", *outcome.warnings]}
    for key in heard.keys() & check.keys():
        return re.search(check[key], "\n".join(heard[key]), re.IGNORECASE) is not None
    points = waypoints(outcome, vocabulary) if PLACED & check.keys() else []
    if "quiet" in check:
        return outcome.error is None and len(outcome.warnings) <= int(check["quiet"])
    if "never_at" in check:
        return all(math.dist(point, check["never_at"]) > AT for point in points)
    if "clear" in check:
        x, y, away = check["clear"]
        return _distance((x, y), points, vocabulary) >= float(away) - SLACK
    if "lacks" in check:
        return all(task["title"] != check["lacks"] for task in outcome.tasks)
    return outcome.error is None and _does(check, outcome, points, vocabulary)


def _does(check: Check, outcome: Outcome, points: list[Point], vocabulary: Vocabulary) -> bool:
    """Checks of what only a plan can do."""
    if "titles" in check:
        return bool([task["title"] for task in outcome.tasks] == check["titles"])
    if "has" in check:
        named = [task for task in outcome.tasks if task["title"] == check["has"]]
        return any(_fits(task["parameters"], check.get("with", {})) for task in named)
    if "waypoints" in check:
        return len(waypoints(outcome, vocabulary, check["under"])) == int(check["waypoints"])
    if "visits" in check:
        return _visits(check["visits"], iter(points))
    if "outcome" in check:
        return _ends(check["outcome"], outcome, points, vocabulary)
    tasks = (task for task in outcome.tasks if task["title"] == check["under"])
    hits = [_has_skill(step, check) for task in tasks for step in _steps(task)]
    return bool(hits) and (all(hits) if check.get("on") == "all" else any(hits))


def waypoints(outcome: Outcome, vocabulary: Vocabulary, title: str | None = None) -> list[Point]:
    """Where the steps of the tasks (of one title) go, in order."""
    found = []
    for task in (task for task in outcome.tasks if title in (None, task["title"])):
        for skill in (step["navigation_skill"] for step in _steps(task)):
            known = vocabulary.skill[skill["name"]].coordinates
            if names := [parameter.name for parameter in known]:
                x, y = (skill["parameters"][name] for name in names)
                found.append((x, y))
    return found


def _steps(task: Mapping[str, Any]) -> list[Any]:
    return list(task.get("skill_sequence") or ())


def _has_skill(step: Any, check: Check) -> bool:
    return any(
        skill["name"] == check["skill"] and _fits(skill["parameters"], check.get("with", {}))
        for _role, skill in step_skills(step)
    )


def _visits(places: list[Any], points: Iterator[Point]) -> bool:
    """Whether the points come by the places in this order (the iterator goes on behind each)."""
    return all(any(math.dist(point, place) <= VISITED for point in points) for place in places)


def _ends(wanted: Any, outcome: Outcome, points: list[Point], vocabulary: Vocabulary) -> bool:
    if wanted == "dock":
        last = vocabulary.task.get(outcome.tasks[-1]["title"]) if outcome.tasks else None
        visual = last is not None and (last.arrival, last.pattern) == ("none", "visual")
        return visual or (last is not None and last.docks)
    place = vocabulary.home if wanted == "home" else wanted
    return bool(points) and math.dist(points[-1], place) <= AT


def _distance(place: Point, points: list[Point], vocabulary: Vocabulary) -> float:
    """Metres between a place and the straight legs from home through the points."""
    from shapely import LineString
    from shapely import Point as Dot

    legs = [vocabulary.home, *points]
    return float(LineString(legs).distance(Dot(place))) if points else math.inf


def _fits(given: Mapping[str, Any], wanted: Mapping[str, Any]) -> bool:
    return all(key in given and _same(given[key], value) for key, value in wanted.items())


def _same(value: Any, wanted: Any) -> bool:
    """Numbers nearly, positions within POSITION, texts by containment, lists item by item."""
    if isinstance(wanted, str):
        return wanted.casefold() in str(value).casefold()
    if is_position(wanted):
        return is_position(value) and math.dist(value, wanted) <= POSITION
    if isinstance(wanted, list):
        alike = isinstance(value, list) and len(value) == len(wanted)
        return alike and all(map(_same, value, wanted))
    if is_number(wanted):
        return is_number(value) and abs(value - wanted) <= max(RELATIVE * abs(wanted), LEAST)
    return bool(value == wanted)
