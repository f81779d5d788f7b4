"""Directions of the command that the plan has not: where a survey begins, how its lines lie."""

import itertools
import re
from collections.abc import Iterator

from planner_ft.document.clearance import KEEPS_CLEAR
from planner_ft.document.structures import ROUND
from planner_ft.document.track import Leg, bearing, place_of
from planner_ft.document.warnings.case import Case, Warning, lost, skills_of
from planner_ft.document.warnings.said import CORRECTED
from planner_ft.facts import Number, is_number, near
from planner_ft.facts.places import read_bearings
from planner_ft.vocabulary import Entry

ON_SIDE = re.compile(r"(?:ern)? (?:side|face|wall)\b", re.IGNORECASE)
TURNED = 28  # characters before a direction in which the command says what is turned there
DIGIT = re.compile(r"\d")
HALF_SIDE = 30.0  # degrees by which the first waypoint of a ring may lie off the side that is said


def sides(case: Case) -> Iterator[Warning]:
    """Directions of which the plan has nothing: one that takes the place of another ("the south
    face, sorry, NORTH face"), one to be faced, and a side that is said last where the plan goes
    along another.
    """
    found = read_bearings(case.text)
    for one, other in itertools.pairwise(found):
        between = case.text[one.end : other.start]
        corrected = case.words["correction"].search(between) and len(between) <= CORRECTED
        if corrected and not near(one.value, other.value) and not _has(other, case):
            yield case.lost(other.start, other.end)
    along = any(case.vocabulary.task[one["title"]].pattern == "pass" for one in case.tasks)
    for one in found:
        before = case.text[max(0, one.start - TURNED) : one.start]
        faced = case.words["faced"].search(before)
        # "Bow to 270, then 200 m due north" is another direction.
        turned = faced and not (
            DIGIT.search(before, faced.end()) or ON_SIDE.match(case.text, one.end)
        )
        if turned and case.wants(one.start) and not _has(one, case):
            yield case.lost(one.start, one.end)
    last = [one for one in found if along and ON_SIDE.match(case.text, one.end)]
    while last and case.wants(last[-1].start) and not _has(last[-1], case):
        one = last.pop()
        yield case.lost(one.start, one.end)


def _has(direction: Number, case: Case) -> bool:
    """Whether a direction is a value of the plan, or a word of it."""
    words = case.text[direction.start : direction.end].casefold()
    return words in case.plan.words or any(near(direction.value, one) for one in _angles(case))


def _angles(case: Case) -> Iterator[float]:
    """The angles among the values of tasks and skills, in degrees: 90 s are no heading east."""
    known = case.vocabulary
    owners = [(task["parameters"], known.task[task["title"]].by_name) for task in case.tasks]
    skills = (skill for task in case.tasks for _role, skill in skills_of(task))
    owners += [(skill["parameters"], known.skill[skill["name"]].by_name) for skill in skills]
    for values, by_name in owners:
        angles = (name for name in values if by_name[name].unit == "deg")
        yield from (values[name] for name in angles if is_number(values[name]))


def laid_otherwise(case: Case) -> Iterator[Warning]:
    """A corner or a direction of the lines of a survey that no task prompt has."""
    over = [one for one in case.tasks if case.vocabulary.task[one["title"]].pattern == "lawnmower"]
    if any(read_bearings(task["task_prompt"]) for task in over):
        return
    for clause in case.clauses if over else ():
        words = "laid" if read_bearings(clause.text) else "across"
        laid = case.words[words].search(clause.text)
        if laid and case.wants(clause.start + laid.start()):
            yield lost(clause.text.strip(" ,;."))


def _first_leg(task: Entry, case: Case) -> Leg | None:
    """The leg to the first waypoint of a task's own."""
    added = {mark["step"] for mark in task.get("added", ()) if mark.get("note") == KEEPS_CLEAR}
    legs = case.path.of(task["id"])
    return next((leg for leg in legs if leg.step not in added and leg.points), None)


def begun_otherwise(case: Case) -> Iterator[Warning]:
    """A side on which a ring of waypoints is to begin, and a plan of which none does."""
    rings = [one for one in case.tasks if case.vocabulary.task[one["title"]].pattern in ROUND]
    firsts = [(place_of(one, case.vocabulary), _first_leg(one, case)) for one in rings]
    sides = [bearing(at, leg.points[-1]) for at, leg in firsts if at and leg]
    for clause in case.clauses if sides else ():
        begun = case.words["begins"].search(clause.text)
        behind = clause.text[begun.end() :].rstrip(" ,;.") if begun else ""
        # "Start at the north buoy" names no side.
        named = [
            one.value
            for one in read_bearings(behind)
            if case.words["side"].fullmatch(behind[one.end :].strip() or "side")
        ]
        turns = [abs((one - side + 180) % 360 - 180) for one in named for side in sides]
        if turns and min(turns) > HALF_SIDE and not clause.corrected:
            yield lost(clause.text.strip(" ,;."))
