"""Waypoints on a circle: "eight waypoints evenly round the centre, the first one due north,
clockwise", "at the radius: west of it, north, east, south".

A ring has one centre, one radius, and points that are told either one by one, by their compass
directions, or by how many they are or how far apart, where they begin and which way round they go.
None where one of these is not told or anything else is said that could lead somewhere.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any

from planner_ft.data.numerals import ONES
from planner_ft.data.quantities import positions
from planner_ft.data.task import geometry as g
from planner_ft.decoding.constraints.reading import LONGEST
from planner_ft.decoding.constraints.reading import wordings as w
from planner_ft.decoding.constraints.reading.paths.itinerary import plain_text, without_fences
from planner_ft.decoding.constraints.reading.paths.shapes import Place, Point, stated_sizes

Path = tuple[Point, ...]
MOST_POINTS = 24
_COUNT = rf"\d+|{'|'.join(ONES[2:17])}"
_POINTS = r"(?:way-?points|points|stops|stations|marks|positions|places|legs|corners)"
COUNT = re.compile(
    rf"\b(?P<n>{_COUNT})(?: [a-z-]+){{0,2}}? {_POINTS}\b|\b{_POINTS}:? (?P<m>{_COUNT})\b(?!"
    r" ?(?:m|met|s|sec|min|deg|°)\w*)",
    re.IGNORECASE,
)
EVERY = re.compile(
    r"\b(?:every|each|at steps of|in steps of|spaced|at) (?P<n>\d+(?:\.\d+)?) ?(?:°|deg\w*)(?="
    r" apart| of the circle|[,;.:)]| on | along | round |$)",
    re.IGNORECASE,
)
EVEN = re.compile(r"\b(?:even\w*|equal\w*|regular\w*|same angle)\b", re.IGNORECASE)
ROUNDED = re.compile(
    r"\b(?:circle|ring|circumference|even\w*|equal\w*|points? (?:round|around)|of (?:it|the"
    r" (?:target|mast|pile)))\b",
    re.IGNORECASE,
)
"""Words for points on a circle and not on a survey square."""
RING = re.compile(r"\b(?:circle|ring|round|around|circumference|circuit)\b", re.IGNORECASE)
_WAY = r"(?:north|south)[ -]?(?:east|west)|north|south|east|west"
_SPOT = (
    rf"(?:the )?(?:due |straight |directly |exactly )?(?P<{{0}}>{_WAY})(?:ern)?(?:"
    r" (?:point|side|one|waypoint|end|mark|tip))?"
    r"(?: of (?:it|the (?:cent(?:re|er)|middle|structure|target|thing|mast|pile|tower|wreck)))?"
)
_ONE_SPOT = re.compile(rf"\b{_SPOT.format('way')}\b", re.IGNORECASE)
_JOIN = (
    r"(?:,? (?:and )?(?:then|next|finally|lastly|followed by|and|on to|to)(?: to)? |, |; ?|"
    r" ?(?:->|→|-|–) ?)"
)
_BARE = _SPOT.replace("(?P<{0}>", "(?:")
LIST = re.compile(
    rf"\b{_BARE}(?:{_JOIN}{_BARE}){{2,7}}\b(?! (?:side|sides|face|wind|swell|end of)\b)",
    re.IGNORECASE,
)
FIRST = re.compile(
    rf"\b(?:start\w*|begin\w*|first|number one|no\. ?1|commenc\w*|from)\b(?:"
    rf" (?:one|way-?point|point|stop|mark|of them|off|out))?"
    r"(?: (?:is|being|lies|to"
    r" be|at|on|in|with|from|due|to|the|one|point|straight|directly|exactly|a|bearing|of))*,?"
    rf" (?P<one>{_WAY})\b|"
    rf"\b(?P<two>{_WAY})(?:ern)?(?: (?:point|side|one|waypoint|end|mark))?(?: of (?:it|the"
    r" (?:cent(?:re|er)|middle|structure|target)))? first\b",
    re.IGNORECASE,
)
WAY_ROUND = re.compile(
    r"\b(?P<not>counter[- ]?|anti[- ]?|[ac](?=cw\b))?(?:clock-?wise|cw\b|with the"
    r" (?:clock|sun))|\b(?P<against>against|opposite) (?:to )?the (?:clock|sun)\b",
    re.IGNORECASE,
)
CLOSED = re.compile(
    r"\b(?:clos(?:e|es|ed|ing) (?:it|the (?:ring|circle|loop|circuit|round))|back (?:at|to|on)"
    r" (?:the )?(?:first|start\w*|number one)|"
    r"(?:finish|end)\w* (?:where (?:you|it|we) (?:began|started)|(?:at|on) the"
    r" (?:first|start\w*)))\b",
    re.IGNORECASE,
)
LEFT_OPEN = re.compile(
    r"\b(?:not|never|no|don['’]t|without|need"
    r" not)\b[^.;]{0,30}\b(?:clos\w+|back|return\w*|close)\b|\bopen\b",
    re.IGNORECASE,
)
AFTERWARDS = re.compile(
    r",? ?(?:and )?(?:then |finally |afterwards,? |after that,? )(?:go |head |return |come |back"
    r" )*(?:home|to base)\b",
    re.IGNORECASE,
)
ELSEWHERE = re.compile(
    r"\b(?:home|base|grid|square|lanes?|lawn\w*|arc|half|quarter|twice|again|laps?|rounds|spiral|zig-?zag|sweep\w*|drift\w*|via|instead|rather|sorry|correction|"
    r"ellip\w+|oval|triangle|figure|star|two (?:rings|circles)|inner|outer|smaller|larger|hold\w*"
    r" at \[|mid-?sides?|corners?|reverse\w*|star\w* pattern|"
    r"return\w*|back|transit\w*|follow\w*|tracks?|cable|mov(?:e|ing)|proceed\w*|"
    r"(?:head|run|sail|drive|take|steam|go)(?:ing|s)? (?:the \w+ |her |it |out |over |straight"
    r" )?(?:to|for|in)|"
    r"alternat\w+|opposite|skip\w*|omit\w*|leave out|except(?! (?:for"
    r" )?(?:at|on|while))|unless|if|not the|half ?way|between the)\b",
    re.IGNORECASE,
)
CENTRED = re.compile(
    r"\b(?:round|around|about|circle|ring|of|on|upon|centre|center|middle|is|centred|centered|from)"
    rf"(?: the [\w' -]{{1,30}}?(?: at)?| it at| at| is| on)?:? ?{w.OPENS}$",
    re.IGNORECASE,
)
"""Before the centre of a ring."""


def read_ring(record: dict[str, Any], pattern: str, own: Point | None) -> Path | None:
    """Every waypoint of the answer in order, where they are the points of one circle; a task whose
    `pattern` is a square has to speak of a circle.
    """
    given, prompt = record.get("parameters"), str(record.get("prompt", ""))
    if len(prompt) > LONGEST or not isinstance(given, dict):
        return None
    text = without_fences(plain_text(prompt))
    if (
        AFTERWARDS.search(text)
        or ELSEWHERE.search(LEFT_OPEN.sub(" ", CLOSED.sub(" ", text)))
        or (pattern == "square" and not ROUNDED.search(text))
    ):
        return None
    places = [
        Place(g.point(x, y), start, end)
        for x, y, start, end in positions(text)
        if not w.SIZE.search(text[start:end])
    ]
    if any(not CENTRED.search(text[: place.start]) or _counted(text, place) for place in places):
        return None
    centres: set[Point | None] = {place.point for place in places} or {own}
    radii: set[Any] = {value for value, _start, _end in stated_sizes(text, places)} or {
        given.get("radius")
    }
    centre, radius = centres.pop(), radii.pop()
    if centres or radii or centre is None or not isinstance(radius, int | float):
        return None
    bearings = tuple(_listed(text)) or tuple(_spread(text))
    if len(bearings) < 3:
        return None
    ring = tuple(g.offset(centre, bearing, float(radius)) for bearing in bearings)
    return (*ring, ring[0]) if CLOSED.search(text) and not LEFT_OPEN.search(text) else ring


def _counted(text: str, place: Place) -> bool:
    """Whether what looks like a place runs into a number of points: "158, -150: 8 waypoints"."""
    return any(
        match.start() < place.end and match.end() > place.start for match in COUNT.finditer(text)
    )


def _listed(text: str) -> Iterator[float]:
    """The bearings of the points from the centre, where the text tells them one by one."""
    lists = list(LIST.finditer(text))
    if len(lists) == 1 and not _ONE_SPOT.search(text[: lists[0].start()] + text[lists[0].end() :]):
        found = [w.bearing_of(spot["way"]) for spot in _ONE_SPOT.finditer(lists[0][0])]
        counts = set(_counts(text))
        if len(set(found)) == len(found) and counts <= {len(found)} and not WAY_ROUND.search(text):
            yield from found


def _spread(text: str) -> Iterator[float]:
    """The bearings of points that are evenly spread, where their number, the first one and the way
    round are told.
    """
    steps = {float(match["n"]) for match in EVERY.finditer(text)}
    counts = set(_counts(text)) | {360 / step for step in steps if step and 360 % step == 0}
    first = {(match["one"] or match["two"]).lower() for match in FIRST.finditer(text)}
    rounds = {not (match["not"] or match["against"]) for match in WAY_ROUND.finditer(text)}
    evenly = EVEN.search(text) or steps or RING.search(text)
    if len(counts) != 1 or len(first) != 1 or len(rounds) != 1 or not evenly:
        return
    count, start = counts.pop(), w.bearing_of(first.pop())
    if count == int(count) and 3 <= count <= MOST_POINTS:
        step = 360 / count if rounds.pop() else -360 / count
        yield from ((start + step * index) % 360 for index in range(int(count)))


def _counts(text: str) -> Iterator[float]:
    """The numbers of points that a text speaks of."""
    for match in COUNT.finditer(text):
        said = str(match["n"] or match["m"]).lower()
        yield float(ONES.index(said) if said in ONES else said)
