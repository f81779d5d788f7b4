"""The waypoints of straight runs, cable tracks, passes along a face and ways off a place, where a
task input leaves no choice about them.

It reads what `itinerary` is too timid for: a text is searched for the places that it leads to, each
by the words before it, for straight runs ("along 45 degrees for 40 m") and for points some way off
a place. Whatever leads somewhere and is not understood makes the whole unread.
"""

from __future__ import annotations

import itertools
import re
from typing import Any

from planner_ft.data.task import geometry as g
from planner_ft.data.words import edit_distance, words
from planner_ft.decoding.constraints.facts import read
from planner_ft.decoding.constraints.reading import wordings as w
from planner_ft.decoding.constraints.reading.paths import destination_wordings as d
from planner_ft.decoding.constraints.reading.paths import run_wordings as r
from planner_ft.decoding.constraints.reading.paths.destinations import (
    grade_of,
    in_row,
    own_places,
    ways_home,
)
from planner_ft.decoding.constraints.reading.paths.itinerary import (
    plain_text,
    reworded,
    unsettled,
    without_fences,
)
from planner_ft.decoding.constraints.reading.paths.run_parts import (
    Event,
    TaskFacts,
    last_clause,
    unquoted,
    without_places,
)
from planner_ft.decoding.constraints.reading.paths.shapes import Point, Uncertain, stated_sizes
from planner_ft.decoding.constraints.reading.paths.stated_places import stated_places
from planner_ft.decoding.constraints.reading.paths.straight_runs import straight_runs
from planner_ft.decoding.constraints.reading.paths.tracks import read_track
from planner_ft.decoding.constraints.reading.paths.ways_off import ways_off
from planner_ft.vocabulary import Vocabulary

Path = tuple[Point, ...]
SHIFTED = re.compile(
    r"\b(?:shifted|displaced) (?:by )?\d|\bbefore \w+ing (?:to|for|out)\b|\bby way of\b|\bturn and"
    r" run\b|\bat the second end\b|\bchange places\b",
    re.IGNORECASE,
)
"""A line that is moved aside as a whole, and an order that is told otherwise: not read."""


def read_runs(record: dict[str, Any], vocabulary: Vocabulary) -> Path | None:
    """Every waypoint of the answer in order, where the input leaves no choice; None where it
    does.
    """
    given = record.get("parameters")
    parameters = given if isinstance(given, dict) else {}
    if read(str(record.get("prompt", "")), vocabulary).numbers_free:
        return None
    facts = TaskFacts(parameters, _own_place(parameters), g.point(*vocabulary.home))
    fenced = w.LIST_MARK.sub(
        lambda mark: ";" + " " * (len(mark[0]) - 1), plain_text(str(record.get("prompt", "")))
    )
    plain = without_fences(fenced)
    text = reworded(plain)
    if text is None or SHIFTED.search(text):
        return None
    try:
        track = read_track(text, parameters)
        if track is not None:
            return track
        if _told_otherwise(text, fenced, plain):
            return None
        walked = _walked(_events(text, facts), text, facts.home)
    except Uncertain:
        return None
    return (
        tuple(walked) or None
        if _settled(walked, text, facts, g.point(*vocabulary.unresolved))
        else None
    )


def _own_place(parameters: dict[str, Any]) -> Point | None:
    """The one place among the task's parameters."""
    pairs = [value for value in parameters.values() if isinstance(value, list) and len(value) == 2]
    own = [pair for pair in pairs if all(isinstance(item, int | float) for item in pair)]
    return g.point(*own[0]) if len(own) == 1 else None


# ---------------------------------------------------------------- what is not read


def _told_otherwise(text: str, fenced: str, plain: str) -> bool:
    """Whether a text is about other shapes, turns its order round, or may have a place taken for a
    part of a boundary.
    """
    return bool(
        r.STOP.search(unquoted(text))
        or r.ORDER.search(text)
        or _misspelt(text)
        or _led_to(fenced, plain)
        or (w.ROW.search(text) and r.BOUNDS.search(_clipped(text)))
    )


def _settled(walked: list[Point], text: str, facts: TaskFacts, unresolved: Point) -> bool:
    """Whether waypoints are no place twice in a row, none that is not known, and have the task's
    own place where the text leads there.
    """
    if any(one == two for one, two in itertools.pairwise(walked)) or (
        unresolved in walked and facts.own != unresolved
    ):
        return False
    if unsettled(walked, text, facts.home):
        return False
    return facts.own is None or facts.own in walked or not r.OWN_LEADS.search(text)


def _clipped(text: str) -> str:
    """The sentences with a row of places."""
    return " ".join(text[max(0, row.start() - 60) : row.end() + 60] for row in w.ROW.finditer(text))


def _led_to(fenced: str, text: str) -> bool:
    """Whether a row of places that was taken for a boundary stands behind words that lead to a
    place.
    """
    return any(
        d.TO_PLACE.search(fenced[: row.start()]) and not text[row.start() : row.end()].strip()
        for row in w.ROW.finditer(fenced)
    )


def _misspelt(text: str) -> bool:
    """Whether a word may be the name of a shape with a letter wrong."""
    return any(
        edit_distance(word, shape, 1) == 1
        for word in words(text)
        if len(word) > 4
        for shape in r.SHAPE_NAMES
        if word not in r.SHAPE_NAMES
    )


# ---------------------------------------------------------------- what leads where


def _events(text: str, facts: TaskFacts) -> list[Event]:
    """Everything that leads somewhere or names a place, in the order of the text."""
    places = list(stated_places(text))
    bare = unquoted(without_places(text, places))
    if r.UNPLACED.search(bare) or r.UNPLACED_NEXT.search(re.sub("§+", "§", bare)):
        raise Uncertain
    own, homes = list(own_places(bare, facts)), list(ways_home(bare, facts))
    idle = {start for start, _end, _point, leads in own if not leads}
    mentioned = sorted(
        [
            *((place.start, place.end, place.point) for place in places),
            *(found[:3] for found in own),
            *homes,
        ]
    )
    events: list[Event] = []
    homes_meant = [
        (match.start("home"), match.end("home"), facts.home)
        for match in r.OF_OWN_HOME.finditer(bare)
    ]
    ways = list(ways_off(bare, sorted([*mentioned, *homes_meant])))
    used = {anchor for _event, anchor in ways if anchor is not None}
    events += [event for event, _anchor in ways]
    explicit, home = {place.start for place in places}, {found[0] for found in homes}
    for start, end, point in mentioned:
        if start in used:
            continue
        last = max(
            (event for event in events if event.end <= start),
            key=lambda event: event.end,
            default=None,
        )
        grade = grade_of(text[:start], last, explicit=start in explicit, home=start in home)
        grade = "mention" if start in idle or r.IS_BEHIND.match(text[end:]) else grade
        if grade == "maybe" and in_row(text, start, end, places):
            raise Uncertain
        events.append(Event(start, end, point, grade=grade))
    for event, _anchor in ways:
        bare = bare[: event.start] + " " * (event.end - event.start) + bare[event.end :]
    events += straight_runs(bare, events, facts)
    return sorted(events, key=lambda event: event.start)


# ---------------------------------------------------------------- the whole way


def _walked(events: list[Event], text: str, home: Point) -> list[Point]:
    """The waypoints, where all that leads somewhere is understood."""
    events = _once(events)
    if not any(event.grade != "mention" for event in events):
        raise Uncertain
    _check_rest(events, text)
    walked: list[Point] = []
    for event in events:
        if event.grade == "mention":
            continue
        if event.point is not None:
            walked.append(event.point)
        elif event.way is not None and (walked or r.STARTS_HOME.search(text)):
            walked.append(g.offset(walked[-1] if walked else home, *event.way))
        else:
            raise Uncertain
    if len(walked) > 1 and (
        r.BEFORE_FIRST.search(text) or r.FIRST_LAST.search(text) or _turned_round(text, events)
    ):
        raise Uncertain
    return walked


def _once(events: list[Event]) -> list[Event]:
    """The events without those that name a place again beside something else."""
    sure = {event.point for event in events if event.grade == "sure" and event.point is not None}
    seen: set[Point] = set()
    kept = []
    for event in events:
        if (
            event.grade == "mention"
            and event.point not in sure
            and event.point is not None
            and not any(event.point == one.point for one in events if one.grade == "maybe")
        ):
            raise Uncertain
        if event.grade == "maybe" and event.point is not None:
            if event.point in sure or event.point in seen:
                continue
            seen.add(event.point)
        kept.append(event)
    return kept


def _turned_round(text: str, events: list[Event]) -> bool:
    """Whether a clause speaks of a place after one that comes later: "Go to B after the run to
    A".
    """
    starts = [event.start for event in events if event.grade != "mention"]
    return any(r.AFTER_INSIDE.search(re.split(r"[.;]\s", text[:start])[-1]) for start in starts[1:])


def _check_rest(events: list[Event], text: str) -> None:
    """Whatever leads somewhere must be part of what was understood."""
    rest = text
    for event in events:
        clause = last_clause(text[: event.start])
        begin = event.start - min(len(re.split(r",|\bthen\b|\band\b", clause)[-1]), 70)
        begin = begin if event.since is None else min(begin, event.since)
        rest = rest[:begin] + " " * (event.end - begin) + rest[event.end :]
    rest = r.NO_MOVE.sub(" ", unquoted(rest))
    if r.MOVE.search(rest):
        raise Uncertain
    walked = {event.way[1] for event in events if event.way}
    for value, start, _end in stated_sizes(text, list(stated_places(text))):
        said = value in walked or any(event.start <= start < event.end for event in events)
        if not said and not w.OTHER_LENGTH.search(
            re.split(r"[.;]\s", text[:start])[-1] + re.split(r"[.;](?:\s|$)", text[start:])[0]
        ):
            raise Uncertain
