"""Cable tracks run another way than once from start to end; None where a task input is about none of them."""

from __future__ import annotations

import re
from typing import Any

from planner_ft.data.quantities import positions
from planner_ft.data.task import geometry as g
from planner_ft.decoding.constraints.reading import wordings as w
from planner_ft.decoding.constraints.reading.shapes import Point, stated_lengths, stated_sizes

Path = tuple[Point, ...]

TRACK = re.compile(r"\b(?:cable|track|line|pipe\w*|heading)\b", re.IGNORECASE)
EVERY = re.compile(r"\b(?:way-?points?|points?|stops?|stopping|positions?)\b[^.;]{0,25}?\b(?:every|each|at intervals of|spaced)\s*$", re.IGNORECASE)
FAR_END = re.compile(
    r"\b(?:other way (?:a?round|about)|in reverse|reversed|backwards|"
    r"from the (?:far |other )?end|(?:at|to|for) the (?:far|other) end)\b",
    re.IGNORECASE,
)
FIRST_FAR = re.compile(
    r"\b(?:(?:begin|start)\w* (?:at|from|with) the (?:far |other )?end|from the (?:far |other )end|(?:go|head|"
    r"proceed)\w* (?:first )?to the (?:far|other) end)\b",
    re.IGNORECASE,
)
"""The track begins at its far end."""
TO_START = re.compile(r"\b(?:to|at|towards) (?:the |its |what \w+ \w+ \w+ the )?(?:\w+ )?(?:start|beginning)\b", re.IGNORECASE)
BOTH_WAYS = re.compile(r"\b(?:both ways|there and back|out and back|and back(?: again)?(?= to the start| along|[.,;]|$))", re.IGNORECASE)
BACK = re.compile(r"\bback (?:again )?(?:along it |along the cable |the same way )?to (?:the |its )?start", re.IGNORECASE)
ALONG = re.compile(r"\b(?:follow|(?<!the )track|trac(?!k)|down|along|both ways|there and back|cable run|run the|full|whole)\w*\b", re.IGNORECASE)
ELSEWHERE = re.compile(r"\b(?:home|base|berth|dock|before|half|twice|times|laps?|again|but|if|instead|rather|sorry|later)\b", re.IGNORECASE)


def read_track(text: str, parameters: dict[str, Any]) -> Path | None:
    """The waypoints of a text that is about the task's own track and about no other movement."""
    start, heading, length = (parameters.get(name) for name in ("start", "heading", "max_dist"))
    if not isinstance(start, list) or not isinstance(heading, int | float) or not isinstance(length, int | float) or not TRACK.search(text):
        return None
    first, last = g.straight_line(g.point(*start), heading, length)
    every = [value for value, at, _end in stated_lengths(text, []) if EVERY.search(text[:at])]
    far, back = FAR_END.search(text), BOTH_WAYS.search(text) or BACK.search(text)
    if (not every and not far and not back) or not ALONG.search(text):
        return None
    stated = [g.point(x, y) for x, y, begin, end in positions(text) if not w.SIZE.search(text[begin:end])]
    elsewhere = [place for place in stated if place not in (first, last)]
    lengths = {value for value, _start, _end in stated_sizes(text, [])} - {length, *every}
    if elsewhere or lengths or ELSEWHERE.search(text) or len(set(every)) > 1 or bool(every) + bool(far) + bool(back and not far) > 1:
        return None
    if every:
        return evenly(first, heading, length, every[0])
    if far:
        return (last, first) if FIRST_FAR.search(text) and TO_START.search(text) and not BOTH_WAYS.search(text) else None
    return (first, last, first)


def evenly(start: Point, heading: float, length: float, step: float) -> Path | None:
    """Waypoints along a track, both ends included, where the step divides it."""
    lanes = g.lane_count(length, step)
    return tuple(g.offset(start, heading, step * index) for index in range(lanes)) if lanes else None
