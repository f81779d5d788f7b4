"""Cable tracks run another way than once from start to end, and passes that keep some way off a face that the text describes.

Both are read from a whole task input; None where it is about neither, Uncertain where something in it is not clear.
"""

from __future__ import annotations

import itertools
import math
import re
from collections.abc import Iterator
from typing import Any

from planner_ft.data.quantities import positions
from planner_ft.data.task import geometry as g
from planner_ft.decoding.constraints.reading import run_wordings as r
from planner_ft.decoding.constraints.reading import wordings as w
from planner_ft.decoding.constraints.reading.shapes import Place, Point, Uncertain, stated_lengths, stated_sizes

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

DESCRIBED = re.compile(
    r"\b(?:face|wall|edge|quay|jetty|pier|breakwater|side|hull|structure|berth|bulkhead|dolphins?|caisson|platform|boom|barge|"
    r"front)\b[^.;:\[(]{0,40}?\b"
    r"(?:runs|is|lies|goes|stretches|extends|reaches|stands)\b[^.;:\[(]{0,40}?\bfrom\s*$",
    re.IGNORECASE,
)
"""A face is described, not run along: "the jetty's north face runs from"."""
ON_AXIS = re.compile(
    r"\b(?:on|along|"
    r"at)\s+(?P<axis>[xy])\s*=?\s*(?P<at>-?\d+(?:\.\d+)?),?\s*from\s+"
    r"(?!(?P=axis))[xy]\s*=?\s*(?P<one>-?\d+(?:\.\d+)?)\s+to\s+(?:[xy]\s*=?\s*)?(?P<two>-?\d+(?:\.\d+)?)",
    re.IGNORECASE,
)
"""A face along an axis: "on x = -200, from y = 0 to y = 90"."""
PASS = re.compile(r"\b(?:pass(?!es\b)|run|runs|runnning|along|parallel|go|sail|drive|traverse|transect|leg)\b", re.IGNORECASE)
SIDE = re.compile(
    r"\b(north|south|east|west)[ -]?(east|west)?(?:ern)?\W{0,2} (?:side|face)|\b(?:to|on) (?:the |its )?(north|south|east|west)[ -]?(east|"
    r"west)?(?:ern)? (?:of|side)",
    re.IGNORECASE,
)
DIRECTION = re.compile(
    r"\b(?P<from>north|south|east|west)[ -]?(?P<from2>east|west)?\w*[ -]to[ -](?P<to>north|south|east|west)[ -]?(?P<to2>east|west)?\w*"
    r"|\b(?P<way>north|south|east|west)[ -]?(?P<way2>east|west)?[ -]?(?:bound|wards?)\b|\b(?:heading|going|running|run|to the|due) (?P<go>north|"
    r"south|east|west)\b",
    re.IGNORECASE,
)
BACKWARDS = re.compile(r"\b(?:back|return\w*|reverse\w*|opposite|other (?:way|direction))\b", re.IGNORECASE)
ONWARDS = re.compile(r"\b(?:in that (?:direction|order)|the same (?:way|direction)|from the first)\b", re.IGNORECASE)


def read_track(text: str, parameters: dict[str, Any]) -> Path | None:
    """The waypoints of a text that is about one track, or about passes along a described face, and about no other movement."""
    return _passes(text, parameters) or _cable(text, parameters)


def _cable(text: str, parameters: dict[str, Any]) -> Path | None:
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
        return _stations(first, heading, length, every[0])
    if far:
        return (last, first) if FIRST_FAR.search(text) and TO_START.search(text) and not BOTH_WAYS.search(text) else None
    return (first, last, first)


def _stations(start: Point, heading: float, length: float, step: float) -> Path | None:
    """Waypoints along a track, both ends included, where the step divides it."""
    lanes = g.lane_count(length, step)
    return tuple(g.offset(start, heading, step * index) for index in range(lanes)) if lanes else None


# ---------------------------------------------------------------- passes along a face


def _passes(text: str, parameters: dict[str, Any]) -> Path | None:
    face = _face(text)
    if face is None:
        return None
    one, two, end = face
    rest = text[end:]
    if ELSEWHERE.search(rest) or any(not w.SIZE.search(rest[place[2] : place[3]]) for place in positions(rest)):
        raise Uncertain
    walked: list[Point] = []
    ends = (one, two)
    parts = [part for part in re.split(r"[.;]\s|\bthen\b", rest) if PASS.search(r.NO_MOVE.sub(" ", part)) and _is_run(part)]
    for part in parts:
        ends = _towards(part, (one, two), ends, sure=len(parts) == 1)
        walked += _beside(ends, _side(part, rest, parameters), _distance(part, parameters))
    if not walked or any(first == second for first, second in itertools.pairwise(walked)):
        raise Uncertain
    return tuple(walked)


def _is_run(part: str) -> bool:
    return DIRECTION.search(part) is not None or re.search(r"\b(?:parallel|pass|run|along)\b", part, re.IGNORECASE) is not None


def _face(text: str) -> tuple[Point, Point, int] | None:
    """Both ends of the face that the text describes, and where the description ends."""
    axis = ON_AXIS.search(text)
    if axis:
        at, one, two = float(axis["at"]), float(axis["one"]), float(axis["two"])
        return (g.point(at, one), g.point(at, two), axis.end()) if axis["axis"].lower() == "x" else (g.point(one, at), g.point(two, at), axis.end())
    places = [Place(g.point(float(m["a"]), float(m["b"])), m.start(), m.end()) for m in r.EXPLICIT.finditer(text) if m["a"]]
    for first, second in itertools.pairwise(places):
        if DESCRIBED.search(text[: first.start]):
            if not re.fullmatch(r"\s*(?:to|as far as|up to)\s*", text[first.end : second.start], re.IGNORECASE):
                raise Uncertain
            return first.point, second.point, second.end
    return None


def _vector(bearing: float) -> tuple[float, float]:
    return math.sin(math.radians(bearing)), math.cos(math.radians(bearing))


def _towards(part: str, face: tuple[Point, Point], before: tuple[Point, Point], *, sure: bool) -> tuple[Point, Point]:
    """The ends of the face in the order in which a part of the text passes them."""
    match = DIRECTION.search(part)
    if match:
        way = (match["to"] or match["way"] or match["go"]) + (match["to2"] or match["way2"] or "")
        x, y = _vector(w.bearing_of(way))
        along = (face[1][0] - face[0][0]) * x + (face[1][1] - face[0][1]) * y
        if abs(along) < 1e-6:
            raise Uncertain
        return face if along > 0 else (face[1], face[0])
    if BACKWARDS.search(part):
        return before[1], before[0]
    if not sure and not ONWARDS.search(part):
        raise Uncertain
    return face


def _side(part: str, rest: str, parameters: dict[str, Any]) -> float:
    """Bearing of the side on which a pass is made: the one named in its part, else in the whole, else the task's own."""
    for text in (part, rest):
        named = {(match[1] or match[3]) + (match[2] or match[4] or "") for match in SIDE.finditer(text)}
        if len(named) > 1:
            raise Uncertain
        if named:
            return w.bearing_of(named.pop())
    own = str(parameters.get("side_id", "")).lower()
    if not r.WAY.fullmatch(own):
        raise Uncertain
    return w.bearing_of(own)


def _distance(part: str, parameters: dict[str, Any]) -> float:
    said = [
        value
        for value, start, end in stated_lengths(part, [])
        if not re.search(r"\b(?:margin|clear\w*|keep\w*)\b", part[max(0, start - 30) : end + 25], re.IGNORECASE)
    ]
    own = parameters.get("distance")
    if len(set(said)) > 1 or (not said and not isinstance(own, int | float)):
        raise Uncertain
    return said[0] if said else float(own)  # type: ignore[arg-type]


def _beside(ends: tuple[Point, Point], side: float, distance: float) -> Iterator[Point]:
    """Both ends moved off at right angles to the face, to the side named."""
    (one_x, one_y), (two_x, two_y) = ends
    length = math.hypot(two_x - one_x, two_y - one_y)
    if length == 0:
        raise Uncertain
    x, y = (two_y - one_y) / length, (one_x - two_x) / length
    towards = x * _vector(side)[0] + y * _vector(side)[1]
    if abs(towards) < 0.3:
        raise Uncertain
    sign = math.copysign(distance, towards)
    for point in ends:
        yield g.point(point[0] + sign * x, point[1] + sign * y)
