"""Limits: those of the command that a plan has not, and those that its track breaks."""

import functools
import itertools
import math
import re
from collections.abc import Callable, Iterator
from typing import Any

from planner_ft.document.language import Clause, ends_with
from planner_ft.document.structures import MOVING, berth, closed_area, structures, way_off
from planner_ft.document.track import Leg, Point, shown, stated
from planner_ft.document.warnings.case import (
    LONGER,
    Case,
    Warning,
    done_at,
    quoted,
    same_place,
    skills_of,
    warning,
)
from planner_ft.document.warnings.data import asked_skills
from planner_ft.facts import is_place, near
from planner_ft.facts.clock import read_times
from planner_ft.facts.places import BESIDE, read_bearings, rows_of_sizes
from planner_ft.planning.limits import time_left, without_limits
from planner_ft.planning.locations import ARTICLE
from planner_ft.vocabulary import Entry
from planner_ft.vocabulary.limits import load_limits, read_limit

TOLERANCE = 0.5  # metres by which a leg may miss a limit
LONGEST_ARTICLE = 3  # letters of words that name nothing
BEHIND = 3  # characters between "back within" and its number: "a quarter of an hour"
AXIS = re.compile(r"(?<![a-z])[xy]\s?(?:[=:]|equals|is)?\s?$", re.IGNORECASE)
"""Stands before a number that is said as one coordinate: "x = 120"."""
Found = tuple[str, str] | None  # (task, how) of the first thing that breaks a limit


def broken(case: Case) -> Iterator[Warning]:
    """One per limit that is broken."""
    seconds = (case.document.get("estimate") or {}).get("seconds", 0)
    for limit in case.limits:
        values, held = limit["values"], [case.tasks[place - 1] for place in limit["tasks"]]
        most = time_left(values) if limit["kind"] == "return" else values.get("duration")
        about = f"{limit['kind']}:{limit['text'].casefold()}"
        words = {"limit": limit["text"].rstrip("."), "about": about}
        if most is not None and len(held) == len(case.tasks):
            if seconds > most:
                yield warning("limit-broken", "plan", seconds=seconds, **words)
        elif limit["kind"] == "duration":
            yield from _lasting(values["duration"], held, case, words)
        elif found := _how(limit, held, case):
            yield warning("limit-broken", "task", case.by_id[found[0]], how=found[1], **words)


def _lasting(most: float, held: list[Entry], case: Case, words: Entry) -> Iterator[Warning]:
    """Tasks that take longer than a limit of their own."""
    for task in held:
        seconds = sum(leg.seconds or 0 for leg in case.path.of(task["id"]))
        if seconds > most:
            how = f"takes {seconds:.0f} s"
            yield warning("limit-broken", "task", task, how=how, **words)


def unplaced(case: Case) -> Iterator[Warning]:
    """Limits on a thing whose place is not known, where a task goes round it too close, or the
    vehicle comes too close to one that it may be: a thing of the command with a word of its name,
    or what a clause tells of it.
    """
    for limit in case.limits:
        values = limit["values"]
        if "position" in values or not {"object", "distance"} <= values.keys():
            continue
        held = [case.tasks[place - 1] for place in limit["tasks"]]
        legs = [leg for leg in case.path.legs if leg.points and leg.task in {t["id"] for t in held}]
        for task, how in itertools.chain(_rounds(values, held, case), _near(values, legs, case)):
            words = {"limit": limit["text"].rstrip("."), "about": f"{how}:{limit['text']}"}
            yield warning("limit-broken", "task", case.by_id[task], how=how, **words)


def _rounds(values: Entry, tasks: list[dict[str, Any]], case: Case) -> Iterator[tuple[str, str]]:
    """Tasks that go round what a limit names."""
    for task in tasks:
        circle = case.vocabulary.motion.standoff(task["title"])
        radius = task["parameters"].get(circle.radius) if circle else None
        prompt = without_limits(task["task_prompt"], case.vocabulary)
        name = ARTICLE.sub("", values.get("object", ""))
        if name and name in prompt and radius and radius < values["distance"] - TOLERANCE:
            yield task["id"], f"goes round it at {radius:g} m"


def _near(values: Entry, legs: list[Leg], case: Case) -> Iterator[tuple[str, str]]:
    """The first place that a limit may mean and that is come too close to."""
    for place in _meant(values["object"], case):
        if found := _too_close({**values, "position": place}, legs):
            yield found[0], f"{found[1]} of {shown(place)}, where {values['object']} may be"
            return


def unsaid_areas(case: Case) -> Iterator[Warning]:
    """Areas of limits that the command gives in no way: by all corners, by two opposite ones or the
    bounds of both axes (four numbers, one behind the other), or by a middle and two sides.
    """
    numbers = [number.value for number in case.numbers]
    bounds = [sorted(numbers[first : first + 4]) for first in range(len(numbers) - 3)]
    # "From -100 to 100 both ways".
    bounds += [sorted(2 * pair) for pair in itertools.pairwise(numbers)]
    for (width, length, *_), at in itertools.product(rows_of_sizes(case.text), case.positions):
        wide, long = width.value / 2, length.value / 2
        bounds.append(sorted((at.x - wide, at.x + wide, at.y - long, at.y + long)))
    proposed = _is_proposed(case)
    for limit in (one for one in case.limits if proposed(one["text"])):
        corners = limit["values"].get("polygon", ())
        said = [any(same_place(place, corner) for place in case.positions) for corner in corners]
        sides = sorted(end(side) for side in zip(*corners, strict=True) for end in (min, max))
        if not all(said) and not any(all(map(near, sides, four)) for four in bounds):
            text = limit["text"].rstrip(".")
            yield warning("value-not-said", "limit", about=text.casefold(), limit=text)


def unsaid_ways(case: Case) -> Iterator[Warning]:
    """Directions in constraints that are no limits, and in no words of the command."""
    said = {one.value % 360 for one in read_bearings(case.text)}
    known = load_limits(case.vocabulary)
    for text in filter(_is_proposed(case), case.document.get("constraints", ())):
        new = any(one.value % 360 not in said for one in read_bearings(text))
        if new and read_limit(text, known) is None:
            about = text.rstrip(".")
            yield warning("value-not-said", "limit", about=about.casefold(), limit=about)


def _is_proposed(case: Case) -> Callable[[str], bool]:
    """Whether the planner has made a constraint, and no operator."""
    proposed = case.document.get("proposed", {}).get("constraints")
    return lambda text: proposed is None or text in proposed


def of_a_row(case: Case) -> Iterator[Warning]:
    """Limits at one place of a row alone: "moorings at 40,10 and 80,20, keep 15 m off both"; also
    of "the mooring at 40,10 and the one at 80,20", where the plan does nothing at the other.
    """
    values = (limit["values"] for limit in case.limits)
    kept = [one["position"] for one in values if "position" in one]
    held = [one for one in case.positions if any(same_place(one, at) for at in kept)]
    done = done_at(case) if held else {}
    busy = [one for one in case.positions if any(same_place(one, at) for at in done if done[at])]
    for one, other in itertools.pairwise(case.positions):
        if (one in held) == (other in held):
            continue
        between, free = case.text[one.end : other.start], other if one in held else one
        # What also stands alone has its limit, or its task, from there.
        again = [place for place in case.positions if same_place(place, (free.x, free.y))]
        named = one in held and free not in busy and _goes_on(between)
        if len(again) == 1 and (named or BESIDE.fullmatch(between)):
            words = quoted(case.text[one.start : other.end])
            if not case.plan.encloses([one, other]):
                yield warning("limit-lost", "row", about=words.casefold(), words=words)


def _goes_on(words: str) -> bool:
    """Whether words behind a place name another thing: "and the one at"."""
    joined, _and, name = words.lstrip(" ,)]").partition("and ")
    return not joined and bool(ARTICLE.match(name)) and not re.search(r"[\d.:;!?]", name)


def _meant(thing: str, case: Case) -> Iterator[Point]:
    """The places where a thing may be."""
    own = _nouns(thing)
    for one in structures(case.document, case.vocabulary):
        if own & _nouns(one.name):
            yield one.position
    for place in case.positions:
        clause = case.clause_at(place.start)
        before = case.text[clause.start : place.start] if clause else ""
        told = case.words["tells"].search(before)
        if told and own & _nouns(before[: told.start()]):
            yield place.x, place.y


def _nouns(name: str) -> set[str]:
    words = ARTICLE.sub("", name).casefold().split()
    return {word.removesuffix("s") for word in words if len(word) > LONGEST_ARTICLE}


def _how(limit: Entry, held: list[dict[str, Any]], case: Case) -> Found:
    kind, values, names = limit["kind"], limit["values"], {task["id"] for task in held}
    legs = [leg for leg in case.path.legs if leg.points and leg.task in names]
    if kind in ("fence", "keep_out_area"):
        return _area(kind, values["polygon"], legs)
    if kind == "keep_out" and "position" in values:
        found = _too_close(values, legs) or _docks(values, held, case)
        return found or next(_rounds(values, held, case), None)
    if kind == "distance":
        home = case.vocabulary.home
        away = ((math.dist(point, home), leg.task) for leg in legs for point in leg.points)
        # A leg begins where the one before it has gone: the first that is there counts.
        farthest, name = max(away, key=lambda one: round(one[0], 6), default=(0.0, ""))
        too_far = farthest > values["distance"] + TOLERANCE
        return (name, f"goes {farthest:.0f} m away from home") if too_far else None
    if kind == "speed":
        for task in held:
            said = stated(task, "speed", case.vocabulary)
            if said and said[1] > values["speed"]:
                return task["id"], f"goes at {said[1]:g} m/s"
    return _recording(limit, held, case) if kind == "no_recording" else None


def _area(kind: str, corners: Any, legs: list[Leg]) -> Found:
    from shapely import LineString, Point, Polygon, make_valid

    inside = kind == "fence"
    area = make_valid(Polygon(corners)).buffer(TOLERANCE) if inside else closed_area(corners)
    for leg in legs:
        line = LineString(leg.points) if len(leg.points) > 1 else Point(leg.points[0])
        if inside and not area.covers(line):
            ends = (point for point in leg.points if not area.covers(Point(point)))
            at = next(ends, None)
            where = f"goes to {shown(at)}, outside of it" if at else "leaves it on the way"
            return leg.task, where
        if not inside and area.intersects(line):
            return leg.task, f"enters it on the way to {shown(leg.points[-1])}"
    return None


def _too_close(values: Entry, legs: list[Leg]) -> Found:
    place, found = (values["position"][0], values["position"][1]), []
    for leg in legs:
        pairs = itertools.pairwise(leg.points) if leg.kind in MOVING else [(leg.points[0],) * 2]
        found.append((min(way_off(place, *pair) for pair in pairs), leg.task))
    nearest, task = min(found, default=(math.inf, ""))
    slack = max(TOLERANCE, 0.005 * values["distance"])
    return (task, f"comes within {nearest:.0f} m") if nearest < values["distance"] - slack else None


def _docks(values: Entry, tasks: list[dict[str, Any]], case: Case) -> Found:
    """A berth that the limit keeps the vehicle from: its way ends short of it."""
    for task in tasks:
        place = berth(task, case.vocabulary)
        metres = math.dist(place, values["position"]) if place else math.inf
        if metres < values["distance"] - TOLERANCE:
            return task["id"], f"is to dock {metres:.0f} m from there"
    return None


def _recording(limit: Entry, tasks: list[dict[str, Any]], case: Case) -> Found:
    """A step that records: anywhere, or where the task prompt names the place."""
    known = load_limits(case.vocabulary)["no_recording"].forbids
    forbidden = {*known} - asked_skills(case)
    thing = limit["values"].get("object", "")
    for task in tasks:
        prompt = without_limits(task["task_prompt"], case.vocabulary)
        if not thing or thing.casefold() in prompt.casefold():
            for _role, skill in skills_of(task):
                if skill["name"] in forbidden:
                    return task["id"], f"records ({skill['name']})"
    return None


def lost_limits(case: Case) -> Iterator[Warning]:
    """Clauses that limit with a number or a position that no limit and no task has."""
    for clause in filter(functools.partial(is_lost, case=case), case.clauses):
        # A time of day goes on behind its colon.
        clock = re.compile(r":\d\d").match(case.text, clause.end)
        words = case.text[clause.start : clock.end() if clock else clause.end].strip(" ,;")
        yield warning("limit-lost", "limit", about=words.casefold(), words=quoted(words))


def is_lost(clause: Clause, case: Case) -> bool:
    """Whether a clause limits, and no limit and no task of the plan has that."""
    in_row = any(clause.start <= row[0].start < clause.end for row in case.rows)
    limiting = not in_row and not clause.corrected and case.words["limit"].search(clause.text)
    return bool(limiting) and not _is_kept(clause, case)


def _is_kept(clause: Clause, case: Case) -> bool:
    plan, text = case.plan, case.text
    inside = [one for one in case.positions if clause.start <= one.start < clause.end]
    numbers = [one for one in case.numbers if clause.start <= one.start < clause.end]
    apart = [n for n in numbers if not any(one.start <= n.start < one.end for one in inside)]
    than = case.words["measured"]
    said = [
        one
        for one in apart
        if one.unit in ("m", "s", "m/s")
        or AXIS.search(text[: one.start])
        or (one.unit is None and ends_with(than, text[clause.start : one.start]))
    ]
    by_time = case.words["by_time"].search(clause.text)
    behind = clause.start + by_time.end() if by_time else len(text)
    if any(0 <= one.start - behind <= BEHIND for one in (*numbers, *read_times(text))):
        return plan.timed
    away = case.words["away"].search(clause.text)
    if not said and away:
        limited = [value for value in plan.limits if is_place(value)]
        limited += itertools.chain.from_iterable(plan.polygons)
        if not inside:
            # "Keep clear of it" names nothing: some text must keep the vehicle away.
            thing = case.words["boundary"].sub("", clause.text[away.end() :])
            told = plan.polygons or case.words["away"].search(plan.texts)
            return plan.speaks_of(thing) if LONGER.search(thing) else bool(told)
        return all(any(same_place(place, at) for at in limited) for place in inside)
    strict = case.words["strict"].search(clause.text)
    if strict and not (numbers or inside or away):
        return plan.speaks_of(case.words["boundary"].sub("", clause.text[strict.end() :]))
    whole = case.words["whole_limit"].search(clause.text)
    last = clause.start + whole.start() if whole else len(text)
    # In "circle it at 10 m, never nearer than 40 m to the reef" one is the task's.
    last = last if any(one.start >= last for one in said) else 0 if whole else last
    known = [*plan.limited, *plan.numbers]
    return all(
        any(near(one.value, other) for other in (known if one.start < last else plan.limited))
        for one in said
    )
