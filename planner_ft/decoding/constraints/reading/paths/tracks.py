"""Cable tracks run another way than once from start to end; None where a task input is about none
of them.
"""

from __future__ import annotations

import re
from typing import Any

from planner_ft.data.quantities import positions
from planner_ft.data.task import geometry as g
from planner_ft.decoding.constraints.reading import LONGEST
from planner_ft.decoding.constraints.reading import wordings as w
from planner_ft.decoding.constraints.reading.paths import run_wordings as r
from planner_ft.decoding.constraints.reading.paths.itinerary import (
    plain_text,
    reworded,
    without_fences,
)
from planner_ft.decoding.constraints.reading.paths.shapes import Point, stated_lengths, stated_sizes

Path = tuple[Point, ...]

TRACK = re.compile(r"\b(?:cable|track|line|pipe\w*|heading)\b", re.IGNORECASE)
EVERY = re.compile(
    r"\b(?:way-?points?|points?|stops?|stopping|positions?)\b[^.;]{0,25}?\b(?:every|each|at"
    r" intervals of|spaced)\s*$",
    re.IGNORECASE,
)
APART = re.compile(
    r"^[ -]?(?:apart|intervals?|spacing|steps|(?:from|between) (?:each"
    r" other|them|way-?points?|points|stops))\b",
    re.IGNORECASE,
)
STOPS = re.compile(
    r"\b(?:way-?points?|points?|stops?|stations?|positions?|soundings?)\b", re.IGNORECASE
)
EVERY_STOP = re.compile(r"\b(?:every|each)\s*$", re.IGNORECASE)
STOP_BEHIND = re.compile(
    r"^(?:,| of (?:it|the \w+)| along (?:it|the \w+)| there is| you)* (?:an? |one"
    r" )?(?:way-?point|point|stop|station|waypoint)\b",
    re.IGNORECASE,
)
FAR_END = re.compile(
    r"\b(?:(?:other|wrong|opposite) way (?:a?round|about)|in (?:reverse|the"
    r" (?:opposite|reverse|other) (?:direction|sense|order))|reversed|backwards|"
    r"(?:from|at|to|for|with) (?:the|its) (?:far |other )end|(?:begin|start)\w* (?:at|from|with)"
    r" (?:the|its) end|from (?:the |"
    r"its )?end (?:back )?to (?:the |its )?(?:start|beginning))\b",
    re.IGNORECASE,
)
FIRST_FAR = re.compile(
    r"\b(?:(?:begin|start)\w* (?:at|from|with) (?:the|its) (?:far |other )?end|from (?:the|its)"
    r" (?:far |other )?end|(?:go|head|"
    r"proceed)\w* (?:first )?to (?:the|its) (?:far|other) end)\b|\bfrom (?:the |its )?end (?:back"
    r" )?to (?:the |its )?(?:start|beginning)\b",
    re.IGNORECASE,
)
"""The track begins at its far end."""
TO_START = re.compile(
    r"\b(?:to|at|towards) (?:the |its |what \w+ \w+ \w+ the )?(?:\w+ )?(?:start|beginning)\b",
    re.IGNORECASE,
)
BOTH_WAYS = re.compile(
    r"\b(?:both ways|there and back|out and back|and back(?: again)?(?= to the start|"
    r" along|[.,;]|$))",
    re.IGNORECASE,
)
BACK = re.compile(
    r"\b(?:back|return(?:ing)?) (?:again )?(?:along it |along the (?:cable|pipe\w*|track) |the same"
    r" way |along the same line )?to (?:the |its )?start",
    re.IGNORECASE,
)
BACK_AGAIN = re.compile(
    r"\b(?:back (?:to the start )?again|back to (?:the |its )?start again|wrong way|, but(?= \w+"
    r" \w+ \w+ \w+ you do it| backwards| the other way|"
    r" in reverse| from))",
    re.IGNORECASE,
)
ALONG = re.compile(
    r"\b(?:course|start\w*|begin\w*|follow|(?<!the )track|trac(?!k)|down|along|both ways|there and"
    r" back|cable run|run the|full|whole)\w*\b",
    re.IGNORECASE,
)
CORRECTED = re.compile(
    r"\b(?:if|unless|instead|rather|sorry|scrap|no, |drift\w*|square|grid|arcs?|circle)\b",
    re.IGNORECASE,
)
ELSEWHERE = re.compile(
    r"\b(?:home|base|berth|dock|before|half|twice|times|laps?|again|but|if|instead|rather|sorry|later)\b",
    re.IGNORECASE,
)


def read_cable(record: dict[str, Any]) -> Path | None:
    """Every waypoint of the answer in order, where the input is about the task's own track and
    about no other movement; None where it may be.
    """
    given, prompt = record.get("parameters"), str(record.get("prompt", ""))
    text = reworded(without_fences(plain_text(prompt))) if len(prompt) <= LONGEST else None
    if not text or not isinstance(given, dict) or CORRECTED.search(text):
        return None
    return read_track(r.QUOTED.sub(lambda quoted: " " * len(quoted[0]), text), given)


def is_step(text: str, start: int, end: int) -> bool:
    """Whether a length is how far apart the waypoints of a run are."""
    before, behind = text[:start], text[end:]
    if EVERY.search(before):
        return True
    clause = re.split(r"[.;]\s", before)[-1]
    return bool(
        (APART.match(behind) and STOPS.search(clause))
        or (EVERY_STOP.search(before) and (STOP_BEHIND.match(behind) or STOPS.search(clause)))
    )


def read_track(text: str, parameters: dict[str, Any]) -> Path | None:
    """The waypoints of a text that is about the task's own track and about no other movement."""
    start, heading, length = (parameters.get(name) for name in ("start", "heading", "max_dist"))
    if (
        not isinstance(start, list)
        or not isinstance(heading, int | float)
        or not isinstance(length, int | float)
        or not TRACK.search(text)
    ):
        return None
    first, last = g.straight_line(g.point(*start), heading, length)
    every = [value for value, at, end in stated_lengths(text, []) if is_step(text, at, end)]
    far, back = FAR_END.search(text), BOTH_WAYS.search(text) or BACK.search(text)
    if (not every and not far and not back) or not ALONG.search(text):
        return None
    stated = [
        g.point(x, y) for x, y, begin, end in positions(text) if not w.SIZE.search(text[begin:end])
    ]
    elsewhere = [place for place in stated if place not in (first, last)]
    lengths = {value for value, _start, _end in stated_sizes(text, [])} - {length, *every}
    if (
        elsewhere
        or lengths
        or ELSEWHERE.search(BACK_AGAIN.sub(" ", text))
        or len(set(every)) > 1
        or bool(every) + bool(far) + bool(back and not far) > 1
    ):
        return None
    if every:
        return evenly(first, heading, length, every[0])
    if far:
        return (
            (last, first)
            if FIRST_FAR.search(text) and TO_START.search(text) and not BOTH_WAYS.search(text)
            else None
        )
    return (first, last, first)


def evenly(start: Point, heading: float, length: float, step: float) -> Path | None:
    """Waypoints along a track, both ends included, where the step divides it."""
    lanes = g.lane_count(length, step)
    return (
        tuple(g.offset(start, heading, step * index) for index in range(lanes)) if lanes else None
    )
