"""Waypoints at even distances along a bearing, and a run from where the vehicle lies already, where
a task input leaves no choice about them.
"""

from __future__ import annotations

import re
from typing import Any

from planner_ft.data.quantities import positions
from planner_ft.data.task import geometry as g
from planner_ft.decoding.constraints.reading import LONGEST
from planner_ft.decoding.constraints.reading import wordings as w
from planner_ft.decoding.constraints.reading.paths import face_wordings as f
from planner_ft.decoding.constraints.reading.paths import run_wordings as r
from planner_ft.decoding.constraints.reading.paths import straight_run_wordings as s
from planner_ft.decoding.constraints.reading.paths.itinerary import (
    plain_text,
    reworded,
    without_fences,
)
from planner_ft.decoding.constraints.reading.paths.shapes import Point, stated_lengths, stated_sizes
from planner_ft.decoding.constraints.reading.paths.tracks import evenly, is_step

Path = tuple[Point, ...]

SET_OUT = re.compile(
    r"\b(?:set(?:ting)? (?:out|off)|start\w*|begin\w*|depart\w*|leave|leaving|run|go|from|out"
    r" of)\b[^.;]{0,20}\b(?:from|at|of|leav\w+)?\s*$",
    re.IGNORECASE,
)
"""Before the place that the stations begin at."""
NOT_FIRST = re.compile(
    r"\bfirst (?:one |waypoint |stop |station )?(?:\d|[\w-]+ met|[\w-]+ m\b|after)|\b(?:not|no"
    r" waypoint|none) at the (?:start|beginning)\b",
    re.IGNORECASE,
)
"""The start is no station."""
COUNT = re.compile(
    r"\b(three|four|five|six|seven|eight|\d{1,2})\b(?: \w+)?"
    r" (?:way-?points?|stops?|stations?|points?)\b",
    re.IGNORECASE,
)
LYING = re.compile(
    r"\b(?:we|you|she|it|the (?:boat|vessel|vehicle|craft|usv))(?:['’]re| are| is| lies| lie)(?:"
    r" (?:already|now|currently|lying|stopped|at rest|"
    r"waiting|sitting))*"
    r" (?:at|on)\s+$",
    re.IGNORECASE,
)
"""Before the place where the vehicle lies already."""
BACK_HERE = re.compile(
    r"\b(?:come|go|run|sail|return|and|then|head) (?:straight )?(?:back )?(?:to|at)"
    r" (?:this|that|the same|our|your) (?:very )?(?:spot|place|position|point)\b|"
    r"\bback (?:here|to here|to where (?:we|you) (?:are|lie|started|began)|to (?:this|that|the"
    r" same|our|your) (?:very )?(?:spot|place|position|point))\b",
    re.IGNORECASE,
)
"""Back to where the vehicle lies."""
BACK = re.compile(r"\b(?:back|return\w*|there and|out and)\b", re.IGNORECASE)


def read_stations(record: dict[str, Any]) -> Path | None:
    """Every waypoint of the answer in order, where the input is about one such run; None where it
    is not, or where something is not clear.
    """
    given, prompt = record.get("parameters"), str(record.get("prompt", ""))
    parameters = given if isinstance(given, dict) else {}
    text = reworded(without_fences(plain_text(prompt))) if len(prompt) <= LONGEST else None
    if not text:
        return None
    text = r.QUOTED.sub(lambda quoted: " " * len(quoted[0]), text)
    places = [match for match in r.EXPLICIT.finditer(text) if match["a"] or match["c"]]
    if (
        len(places) != 1
        or f.ELSEWHERE.search(EVERY_LENGTH.sub(" ", text))
        or any(_apart(text, places[0], pair) for pair in positions(text))
    ):
        return None
    point = g.point(
        f.number(places[0]["a"] or places[0]["c"]), f.number(places[0]["b"] or places[0]["d"])
    )
    bearings = {
        float(match["deg"]) if match["deg"] else w.bearing_of(match["way"])
        for match in f.BEARING.finditer(text)
    }
    bearings |= (
        {w.bearing_of(match[1]) for match in COURSE.finditer(text)} if not bearings else set()
    )
    sizes = {start for _value, start, _end in stated_sizes(text, [])}
    said = [
        (value, start)
        for value, start, end in stated_lengths(text, [])
        if start in sizes or is_step(text, start, end)
    ]
    lengths = {value: start for value, start in said if not _of_something_else(text, start)}
    steps = {value for value, start, end in stated_lengths(text, []) if is_step(text, start, end)}
    if len(bearings) != 1:
        return None
    (bearing,) = bearings
    if LYING.search(text[: places[0].start()]):
        return _from_here(text, point, bearing, lengths)
    return _evenly(text, places[0], point, bearing, lengths, parameters, list(steps))


COURSE = re.compile(
    r"\b(?:course|heading|bearing|steer\w*|going|runs?|running|direction)\s+(?:of |is |due |to the"
    r" |towards? (?:the )?)?(north[ -]?(?:east|west)|"
    r"south[ -]?(?:east|west)|north|south|east|west)"
    r"(?:wards?)?\b(?![ -](?:north|south|east|west|side|face|end))",
    re.IGNORECASE,
)
"""The course of a run by its compass word."""
EVERY_LENGTH = re.compile(r"\b(?:way-?points? |stop\w* )?(?:every|each) (?=\d)", re.IGNORECASE)


def _apart(text: str, place: re.Match[str], pair: tuple[float, float, int, int]) -> bool:
    """Whether two numbers may be another place."""
    said = text[pair[2] : pair[3]]
    return (
        not (place.start() < pair[3] and pair[2] < place.end())
        and re.search(r"[,;/=xy]", said) is not None
        and not w.SIZE.search(said)
    )


def _of_something_else(text: str, at: int) -> bool:
    """Whether a length is none of the run: a margin, an accuracy."""
    clause = re.split(r"[,.;]\s", text[:at])[-1] + re.split(r"[,.;](?:\s|$)", text[at:])[0]
    return w.OTHER_LENGTH.search(re.sub(r"\b(?:every|each|apart)\b", "", clause)) is not None


def _from_here(text: str, here: Point, bearing: float, lengths: dict[float, int]) -> Path | None:
    """A run from where the vehicle lies, and back there."""
    back = BACK_HERE.search(text)
    if len(lengths) != 1 or EVERY_LENGTH.search(text) or (BACK.search(text) and not back):
        return None
    end = g.offset(here, bearing, *lengths)
    return (end, here) if back else (end,)


def _evenly(
    text: str,
    place: re.Match[str],
    start: Point,
    bearing: float,
    lengths: dict[float, int],
    parameters: dict[str, Any],
    every: list[float],
) -> Path | None:
    """Stations from a start on, as far as the text or the task says."""
    if (
        len(every) != 1
        or not SET_OUT.search(text[: place.start()])
        or NOT_FIRST.search(text)
        or BACK.search(text)
    ):
        return None
    rest, counts = set(lengths) - set(every), list(COUNT.finditer(text))
    own = next(
        (
            value
            for name in ("max_dist", "length")
            if isinstance(value := parameters.get(name), int | float)
        ),
        None,
    )
    if len(rest) > 1:
        return None
    if counts and not rest:
        number = _count(counts[0])
        return (
            evenly(start, bearing, every[0] * (number - 1), every[0])
            if len(counts) == 1 and number > 1
            else None
        )
    if counts and {_count(count) for count in counts} != {round(next(iter(rest)) / every[0]) + 1}:
        return None
    length = rest.pop() if rest else own if s.OWN_LENGTH.search(text) else None
    return evenly(start, bearing, length, every[0]) if length else None


def _count(said: re.Match[str]) -> int:
    return f.COUNTED.get(said[1].lower()) or (int(said[1]) if said[1].isdigit() else 0)
