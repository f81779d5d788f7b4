"""Passes along a face: both ends, where the Task Agent's waypoints are not on them.

A face is on the stated side of its structure, and the pass keeps its distance. Where the place of
the structure is known, the pass has its middle before it; else it begins where the vehicle has gone
to.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

from planner_ft.facts import geometry as g
from planner_ft.facts.places import read_bearings, read_positions
from planner_ft.facts.words import words
from planner_ft.planning.essentials import Added, Completed, Step, TaskEntry
from planner_ft.planning.shapes import PASS, SHARE, SIDE, SLACK, goal_of, placed, run_of
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import is_number
from planner_ft.vocabulary.replay import START, sound

Point = g.Point
NAME = 3  # letters from which on a word that two prompts share is a name, or stands before one
BESIDE = 0.1  # the share of a pass by which its waypoints may lie beside its ends


@dataclass(frozen=True)
class Face:
    """A face of a structure: its ends, the bearing that it looks to, the distance to be kept."""

    ends: tuple[Point, Point]
    side: float
    distance: float

    @property
    def middle(self) -> Point:
        (a, b), (c, d) = self.ends
        return (a + c) / 2, (b + d) / 2


def with_pass(
    task: TaskEntry, steps: Sequence[Step], vocabulary: Vocabulary, before: TaskEntry | None = None
) -> Completed:
    """The steps with both ends of the pass, and what was added; as they are where they make a pass,
    have more waypoints than two, or where its ends do not follow from the task and the one that
    went to where the vehicle is (`before`).
    """
    goals = [goal_of(step, vocabulary) for step in steps]
    made = [goal for goal in goals if goal]
    moving = [at for at, goal in enumerate(goals) if goal]
    ends = _nearest_ends(task, made, vocabulary, before) if len(made) in (1, 2) else None
    if not ends or _is_pass(made, ends):
        return list(steps), Added()
    first, last = moving[0], moving[-1]
    whole = steps if last > first else [*steps[: first + 1], *steps[first:]]
    return placed(whole, zip((first, max(last, first + 1)), ends, strict=True), vocabulary)


def gone_to(tasks: Sequence[TaskEntry], vocabulary: Vocabulary) -> TaskEntry | None:
    """The transit to where the vehicle is behind `tasks`; None where that is not known."""
    progress, last = START, None
    for entry in tasks:
        task = vocabulary.task[entry["title"]]
        progress = progress.after(task, sound(entry["parameters"], task), vocabulary)
        last = entry if _place(entry, vocabulary) else last
    known = last and last["title"] == vocabulary.transit and not progress.moved
    return last if known and progress.here not in (None, vocabulary.unresolved) else None


def face_of(task: TaskEntry, vocabulary: Vocabulary) -> Face | None:
    """The face that a task runs along, where it follows from the task for certain: from the place
    in its prompt, else from its two waypoints.
    """
    measures, places = _measures(task, vocabulary), _places(task)
    if measures is None or len(places) > 1:
        return None
    side, length, distance = measures
    if places:
        return _before(places[0], side, length, distance)
    goals = [goal_of(step, vocabulary) for step in task.get("skill_sequence") or ()]
    ends = [(goal[0], goal[1]) for goal in goals if goal]
    if len(ends) != 2 or not math.isclose(run_of(ends), length, abs_tol=SLACK):
        return None
    first, last = (g.offset(end, side, -distance) for end in ends)
    return Face((first, last), side, distance)


def pass_ends(task: TaskEntry, vocabulary: Vocabulary) -> tuple[Point, Point] | None:
    """Both ends of a pass; None where side, length, distance or place are not known for certain."""
    face = face_of(task, vocabulary) if _places(task) else None
    return _off(face) if face else None


def _nearest_ends(
    task: TaskEntry, made: Sequence[Point], vocabulary: Vocabulary, before: TaskEntry | None
) -> tuple[Point, Point] | None:
    """Both ends of a pass in the order, and in the direction, that is nearer to what was made."""
    ends, measures = pass_ends(task, vocabulary), _measures(task, vocabulary)
    if ends:
        return min((ends, ends[::-1]), key=lambda pair: sum(map(math.dist, made, pair)))
    start = _place(before, vocabulary) if before else None
    if not before or not start or not measures or _places(task):
        return None
    side, length, distance = measures
    if _names_it(before, task):
        both = _off(_before(start, side, length, distance))
        return min((both, both[::-1]), key=lambda pair: sum(map(math.dist, made, pair)))
    course = (side + 90) % 180
    run = [goal - at for goal, at in zip(made[-1], made[0], strict=True)]
    ahead = g.offset((0, 0), course, 1)
    turned = 180 if run[0] * ahead[0] + run[1] * ahead[1] < 0 else 0
    return start, g.offset(start, course + turned, length)


def _names_it(before: TaskEntry, task: TaskEntry) -> bool:
    """Whether the way to a place calls it as the pass calls its structure."""
    said, places = before["task_prompt"], read_positions(before["task_prompt"])
    called = words(said[: places[0].start] if places else said)
    return any(len(word) >= NAME for word in {*called} & {*words(task["task_prompt"])})


def _is_pass(made: Sequence[Point], ends: Sequence[Point]) -> bool:
    """Whether two waypoints pass a whole face, each near one of its ends."""
    length = math.dist(*ends)
    beside = all(
        min(math.dist(point, end) for end in ends) <= BESIDE * length + SLACK for point in made
    )
    return beside and run_of(made) >= length * (1 - SHARE)


def _measures(task: TaskEntry, vocabulary: Vocabulary) -> tuple[float, float, float] | None:
    """Side (a bearing), length and distance of a pass, where all are known."""
    given = task["parameters"]
    bearings = read_bearings(str(given.get(SIDE, "")))
    length, distance = (given.get(name) for name in PASS)
    known = vocabulary.task[task["title"]].pattern == "pass" and len(bearings) == 1
    if not known or not is_number(length) or not is_number(distance):
        return None
    return bearings[0].value, length, distance


def _places(task: TaskEntry) -> list[Point]:
    """The places that a task prompt says for certain."""
    return [(at.x, at.y) for at in read_positions(task["task_prompt"]) if at.certain]


def _place(task: TaskEntry, vocabulary: Vocabulary) -> Point | None:
    """The place that is a parameter of a task."""
    at = task["parameters"].get(vocabulary.task[task["title"]].position_parameter or "")
    return (at[0], at[1]) if at else None


def _before(middle: Point, side: float, length: float, distance: float) -> Face:
    """The face that has its middle at the place of the structure."""
    first, last = (g.offset(middle, side + turn, length / 2) for turn in (-90, 90))
    return Face((first, last), side, distance)


def _off(face: Face) -> tuple[Point, Point]:
    """The ends of the pass before a face."""
    first, last = (g.offset(end, face.side, face.distance) for end in face.ends)
    return first, last
