"""Directions of the command that the plan has not: where a survey begins, how its lines lie."""

import itertools
import math
import re
from collections.abc import Iterator, Sequence
from typing import Any

from planner_ft.document.clearance import KEEPS_CLEAR
from planner_ft.document.language import ends_with
from planner_ft.document.structures import ROUND
from planner_ft.document.track import Leg, Point, bearing, place_of
from planner_ft.document.warnings.case import FULL, Case, Warning, lost, quoted, skills_of, warning
from planner_ft.document.warnings.route import own_waypoints
from planner_ft.document.warnings.said import CORRECTED, NO
from planner_ft.facts import Number, is_number, near
from planner_ft.facts.places import read_bearings
from planner_ft.vocabulary import Entry

ON_SIDE = re.compile(r"(?:ern)? (?:side|face|wall)\b", re.IGNORECASE)
TURNED = 28  # characters before a direction in which the command says what is turned there
DIGIT = re.compile(r"\d")
COURSE = re.compile(r"[0-3]\d\d")  # "turn to 225"
SENSES = "clockwise", "anticlockwise"
CORNER = "corner"
LANE = 2  # waypoints of a lane
SLIGHT = 0.01
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
    for one in (one for one in case.numbers if COURSE.fullmatch(case.text, one.start, one.end)):
        before = case.text[max(0, one.start - TURNED) : one.start]
        turned_to = ends_with(case.words["faced"], before) and case.wants(one.start)
        if turned_to and not any(near(one.value, angle) for angle in _angles(case)):
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
    """A corner or a direction of the lines of a survey that neither a task prompt nor the lines of
    a task have.
    """
    over = [one for one in case.tasks if case.vocabulary.task[one["title"]].pattern == "lawnmower"]
    if any(read_bearings(task["task_prompt"]) for task in over):
        return
    for clause in case.clauses if over else ():
        ways = [one.value for one in read_bearings(clause.text)]
        laid = case.words["laid" if ways else "across"].search(clause.text)
        if laid and case.wants(clause.start + laid.start()):
            corner = laid[0].casefold() == CORNER
            if not ways or not any(_lie_so(one, ways, corner, case) for one in over):
                yield lost(clause.text.strip(" ,;."))


def _lie_so(task: Entry, ways: Sequence[float], corner: bool, case: Case) -> bool:
    """Whether the first lane of a task lies in all these directions, or begins on their side."""
    points, middle = own_waypoints(task, case.vocabulary), place_of(task, case.vocabulary)
    if len(points) < LANE or middle is None:
        return False
    if corner:
        off = points[0][0] - middle[0], points[0][1] - middle[1]
        return all(
            one * way > -SLIGHT for at in ways for one, way in zip(off, _ahead(at), strict=True)
        )
    lane = bearing(*points[:LANE])
    return all(abs(_ahead(way - lane)[0]) < SLIGHT for way in ways)


def _ahead(way: float) -> Point:
    return math.sin(math.radians(way)), math.cos(math.radians(way))


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
        named = [one.value for one in read_bearings(behind) if _is_side(one, behind, case)]
        turns = [abs((one - side + 180) % 360 - 180) for one in named for side in sides]
        if turns and min(turns) > HALF_SIDE and not clause.corrected:
            yield lost(clause.text.strip(" ,;."))


def _is_side(direction: Number, said: str, case: Case) -> bool:
    """Whether a direction is a side: "south", "the south face", "south of it", but no "buoy south
    of the pier" and no "north buoy".
    """
    rest = said[direction.end :].strip()
    of_it = rest.startswith("of ") and not said[: direction.start].strip()
    return of_it or bool(case.words["side"].fullmatch(rest or "side"))


def turned_by_bearing(case: Case) -> Iterator[Warning]:
    """An angle round something for which a single direction of the command is all evidence: "east"
    is no arc of 90 degrees.
    """
    found = read_bearings(case.text)
    for task in case.tasks if len(found) == 1 else ():
        known = case.vocabulary.task[task["title"]]
        for one in known.parameters if known.pattern in ROUND else ():
            name, value = one.name, task["parameters"].get(one.name)
            turn = one.unit == "deg" and is_number(value) and near(value, found[0].value)
            if turn and not case.source.evidence(value, one).mentions:
                about: Any = {"task": task, "parameter": name, "name": name}
                yield warning("value-not-said", "unsaid", **about, value=f"{value:g} deg")


def turned_otherwise(case: Case) -> Iterator[Warning]:
    """A sense of rotation in which no task of the plan turns or goes round."""
    # "Counter-clockwise" has both words.
    spans = {
        one.end(): (*one.span(), sense)
        for sense in SENSES
        for one in case.words[sense].finditer(case.text)
    }
    said = sorted(spans.values())
    for (start, end, sense), after in itertools.zip_longest(said, said[1:]):
        between = case.text[end : after[0]] if after else ""
        corrected = case.words["correction"].search(between) or NO.match(between)
        gone = corrected and len(between) <= CORRECTED
        had = gone or any(sense in _senses(task, case) for task in case.tasks)
        if not had and case.wants(start):
            yield case.lost(start, end)


def turned_unsaid(case: Case) -> Iterator[Warning]:
    """A sense of rotation that the prompt of a round has, and the command in other words at most:
    "contrary to the clock" may have been taken for its opposite. "Keep it to port" says a sense.
    """
    for task in case.tasks if not case.words["beam"].search(case.text) else ():
        prompt = task["task_prompt"]
        found = [sense for sense in SENSES if case.words[sense].search(prompt)]
        is_round = case.vocabulary.task[task["title"]].pattern in ROUND
        if is_round and found and not any(case.words[one].search(case.text) for one in SENSES):
            about: Any = {"task": task, "about": found[-1]}
            yield warning("value-not-said", "word", **about, words=quoted(found[-1]))


def _senses(task: Entry, case: Case) -> set[str]:
    """The senses in which a task turns on the spot or goes round; of one without steps, those that
    its prompt says.
    """
    if task["skill_sequence"] is None:
        return {one for one in SENSES if case.words[one].search(task["task_prompt"])}
    turns, faced = list[float](), list[float]()
    if case.vocabulary.task[task["title"]].pattern in ROUND:
        turns.append(-_area(own_waypoints(task, case.vocabulary)))
    for _role, skill in skills_of(task):
        motion, given = case.vocabulary.motion.of(skill["name"]), skill["parameters"]
        if motion and motion.kind == "turn-to":
            faced.append(float(motion.value("heading", given) or 0))
        elif motion and motion.kind in ("arc", "turn-by"):
            angle = motion.value("angle", given)
            turns.append(FULL if angle is None else float(angle))
    turns += [math.remainder(two - one, FULL) for one, two in itertools.pairwise(faced)]
    return {SENSES[turn < 0] for turn in turns if turn}


def _area(points: Sequence[Point]) -> float:
    """Twice the area that points go round, positive anticlockwise."""
    following = [*points[1:], *points[:1]]
    return sum(x * v - y * u for (x, y), (u, v) in zip(points, following, strict=True))
