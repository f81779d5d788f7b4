"""Slot propagation through the two-agent pipeline: from the command to the skills of the right
task.

The plan is that of `plannerft plan --json`: mission tasks, each with its skill sequence. A slot has
reached the skills when one of the right task's skills has the value as a parameter of the same
unit, or when the waypoints have it as geometry: a position as a waypoint or as their middle, a
length as an extent, half of one, a leg or the distance between lanes, a bearing as the course of a
leg, a number as that of turns.
"""

from __future__ import annotations

import itertools
import math
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from planner_ft.benchmark.metrics.alignment import align, plan_entries
from planner_ft.benchmark.metrics.facts import (
    Given,
    given_values,
    listed,
    slot_kind,
    stated_slots,
    text_said,
)
from planner_ft.benchmark.metrics.values import tolerance, values_agree
from planner_ft.facts import WAYPOINT, is_number, read_input
from planner_ft.vocabulary import Parameter, Task, Vocabulary

Point = Sequence[float]
CLOSE = 0.02
"""Metres by which lengths between waypoints, which have two decimals, can differ from the length
that they were made with.
"""


@dataclass(frozen=True)
class SkillSlots:
    """The slots of a command in a pipeline's plan, per kind.

    `stated`: all; `carried`: those that some skill of their task could carry at all (no skill has a
    speed); `reached`: of these, those that the skills of the right task carry; `waiting`: of these,
    those of tasks that have no skills yet, since their place is open.
    """

    stated: Counter[str]
    carried: Counter[str]
    reached: Counter[str]
    waiting: Counter[str]


def skill_slots(
    record: dict[str, Any], planned: Mapping[str, Any], vocabulary: Vocabulary
) -> SkillSlots:
    """Follow every slot of a mission record ({"prompt", "expected"}) into the skills of `planned`,
    the object of `plannerft plan --json`.
    """
    expected = plan_entries("mission", record["expected"])
    predicted = plan_entries("mission", planned)
    partner = dict(align("mission", expected, predicted, vocabulary).pairs)
    source = read_input({"prompt": record["prompt"]}, vocabulary)
    slots = SkillSlots(Counter(), Counter(), Counter(), Counter())
    for slot in stated_slots("mission", expected, source, vocabulary):
        kind, task = slot_kind(slot.parameter), vocabulary.task[expected[slot.entry].name]
        slots.stated[kind] += 1
        if not _can_carry(task, slot.parameter, vocabulary):
            continue
        slots.carried[kind] += 1
        if slot.entry in partner:
            steps = planned["tasks"][predicted[partner[slot.entry]].step].get("skill_sequence")
            slots.waiting[kind] += steps is None
            slots.reached[kind] += _carried(slot, steps, vocabulary)
    return slots


def _can_carry(task: Task, parameter: Parameter, vocabulary: Vocabulary) -> bool:
    """Whether a skill that fits the task has a parameter of this kind, or moves, where the
    parameter is a place, a length or a bearing.
    """
    skills = [vocabulary.skill[name] for names in task.skills.values() for name in names]
    moves = any(skill.motion == "goto" for skill in skills)
    kind = slot_kind(parameter)
    if kind == "coordinates":
        return moves
    if kind == "numbers" and parameter.unit is None:
        return any(skill.motion in ("turn_to", "turn_by") for skill in skills)
    return (moves and kind in ("lengths", "angles")) or any(
        slot_kind(item) == kind and item.unit == parameter.unit
        for skill in skills
        for item in skill.parameters
    )


def _carried(slot: Given, steps: Any, vocabulary: Vocabulary) -> bool:
    """Whether a task's skill sequence carries a value out."""
    entries = plan_entries("task", {"skill_sequence": steps})
    values = list(given_values("task", entries, vocabulary))
    waypoints = [given.value for given in values if given.parameter is WAYPOINT]
    kind = slot_kind(slot.parameter)
    if kind == "names":
        named = [one for one in values if slot_kind(one.parameter) == "names"]
        texts = [str(text) for one in named for text in listed(one.value)]
        wanted = listed(slot.value)
        return all(any(text_said(text, one) for text in texts) for one in wanted)
    if kind == "coordinates":
        spots = [*waypoints, *_middle(waypoints)]
        if slot.parameter.type != "position":
            spots = [given.value for given in values]
        return any(values_agree(spot, slot.value, slot.parameter, vocabulary) for spot in spots)
    alike = [one.value for one in values if one.parameter.unit == slot.parameter.unit]
    if any(_near(value, slot.value) for value in alike):
        return True
    if kind == "numbers":
        often = Counter(entry.name for entry in entries if entry.role == "navigation")
        return slot.parameter.unit is None and slot.value in often.values()
    geometry = {"lengths": _lengths, "angles": _courses}.get(kind)
    return geometry is not None and any(_near(size, slot.value) for size in geometry(waypoints))


def _lengths(waypoints: Sequence[Point]) -> Iterator[float]:
    """Lengths that waypoints lie apart: extents and their halves, legs, distances between lanes and
    from the middle.
    """
    if len(waypoints) < 2:
        return
    for axis in (0, 1):
        line = sorted({point[axis] for point in waypoints})
        yield from (line[-1] - line[0], (line[-1] - line[0]) / 2)
        yield from (later - earlier for earlier, later in itertools.pairwise(line))
    yield from (math.dist(one, other) for one, other in itertools.pairwise(waypoints))
    yield from (math.dist(middle, point) for middle in _middle(waypoints) for point in waypoints)


def _courses(waypoints: Sequence[Point]) -> Iterator[float]:
    """Bearings of the legs, in degrees clockwise from north."""
    for one, other in itertools.pairwise(waypoints):
        yield math.degrees(math.atan2(other[0] - one[0], other[1] - one[1])) % 360


def _middle(waypoints: Sequence[Point]) -> list[list[float]]:
    """The middle of the area that waypoints span; none for fewer than two."""
    if len(waypoints) < 2:
        return []
    spans = [[point[axis] for point in waypoints] for axis in (0, 1)]
    return [[(min(span) + max(span)) / 2 for span in spans]]


def _near(value: Any, wanted: float) -> bool:
    return is_number(value) and abs(value - wanted) <= max(tolerance(abs(wanted)), CLOSE)
