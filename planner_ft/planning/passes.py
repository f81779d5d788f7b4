"""The ends of a pass along a face, where the Task Agent's waypoints make no pass of its length.

The face is on the stated side of the structure; the pass has its middle before it, runs along it
and keeps its distance, so its ends follow from side, length, distance and the structure's place.
"""

from __future__ import annotations

import copy
import itertools
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from planner_ft.facts.geometry import Point, offset
from planner_ft.facts.places import read_bearings, read_positions
from planner_ft.planning.essentials import VEHICLE, Added, Step
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import canonical_value, is_number

SIDE, LENGTH, DISTANCE = "side_id", "length", "distance"
"""The parameters of a pass."""
SHARE = 0.02
"""The share of its length by which a pass may be shorter."""


def with_pass(
    task: Mapping[str, Any], steps: Sequence[Step], vocabulary: Vocabulary
) -> tuple[list[Step], Added]:
    """The steps with both ends of the pass, and what was added; as they are where they make a pass,
    have more waypoints than one, or where its ends do not follow from the task.
    """
    moving = [at for at, step in enumerate(steps) if _goes(step, vocabulary)]
    ends = pass_ends(task, vocabulary)
    made = [_waypoint(steps[at], vocabulary) for at in moving]
    if not ends or len(moving) not in (1, 2) or _long_enough(made, math.dist(*ends)):
        return list(steps), Added()
    nearer = sorted(ends, key=lambda end: math.dist(end, made[0]))
    first, last = moving[0], moving[-1]
    done = [copy.deepcopy(step) for step in steps]
    done = done if last > first else [*done[: first + 1], *copy.deepcopy(done[first:])]
    marks = Added()
    for at, end in zip((first, max(last, first + 1)), nearer, strict=True):
        skill = done[at]["navigation_skill"]
        names = vocabulary.skill[skill["name"]].coordinates
        for name, value in zip(names, canonical_value(list(end)), strict=True):
            skill["parameters"][name.name] = value
            mark = {"step": at, "role": "navigation", "name": skill["name"], "kind": VEHICLE}
            marks.append({**mark, "parameter": name.name})
    return done, marks


def pass_ends(task: Mapping[str, Any], vocabulary: Vocabulary) -> tuple[Point, Point] | None:
    """Both ends of a pass; None where side, length, distance or place are not known for certain."""
    face = face_of(task, vocabulary)
    if face is None:
        return None
    first, last = (offset(end, face.side, face.distance) for end in face.ends)
    return first, last


def face_of(task: Mapping[str, Any], vocabulary: Vocabulary) -> Face | None:
    """The face that a task runs along, where it follows from the task for certain."""
    given = task["parameters"]
    bearings = read_bearings(str(given.get(SIDE, "")))
    places = [place for place in read_positions(task["task_prompt"]) if place.certain]
    measures = [given.get(name) for name in (LENGTH, DISTANCE)]
    known = vocabulary.task[task["title"]].pattern == "pass" and all(map(is_number, measures))
    if not known or len(bearings) != 1 or len(places) != 1:
        return None
    side, at = bearings[0].value, (places[0].x, places[0].y)
    first, last = (offset(at, side + turn, measures[0] / 2) for turn in (-90, 90))
    return Face((first, last), side, measures[1])


@dataclass(frozen=True)
class Face:
    """A face of a structure: its ends, the bearing that it looks to, the distance to be kept."""

    ends: tuple[Point, Point]
    side: float
    distance: float

    @property
    def middle(self) -> Point:
        """The place of the structure."""
        (a, b), (c, d) = self.ends
        return (a + c) / 2, (b + d) / 2


def _goes(step: Step, vocabulary: Vocabulary) -> bool:
    return bool(vocabulary.skill[step["navigation_skill"]["name"]].coordinates)


def _waypoint(step: Step, vocabulary: Vocabulary) -> Point:
    skill = step["navigation_skill"]
    first, second = (item.name for item in vocabulary.skill[skill["name"]].coordinates[:2])
    return skill["parameters"][first], skill["parameters"][second]


def _long_enough(points: Sequence[Point], length: float) -> bool:
    runs = (math.dist(*pair) for pair in itertools.combinations(points, 2))
    return max(runs, default=0.0) >= length * (1 - SHARE)
