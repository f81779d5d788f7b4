"""A part of the task's own grid or square, or the whole of it and the way home: "only the first
three lanes, then head home", "the corners alone: NE, NW, SW".

The lanes or the square are those of `one_shape`, which has to leave one path; None where nothing of
the kind is said or something is not clear.
"""

from __future__ import annotations

import re
from typing import Any

from planner_ft.data.quantities import positions
from planner_ft.data.task import geometry as g
from planner_ft.decoding.constraints.reading import LONGEST
from planner_ft.decoding.constraints.reading import wordings as w
from planner_ft.decoding.constraints.reading.paths.cues import read_cues
from planner_ft.decoding.constraints.reading.paths.itinerary import plain_text, without_fences
from planner_ft.decoding.constraints.reading.paths.one_shape import CIRCLE, one_shape
from planner_ft.decoding.constraints.reading.paths.shapes import (
    Place,
    Point,
    named_corner,
    stated_sizes,
)
from planner_ft.vocabulary import Task

Path = tuple[Point, ...]
_GO = (
    r"(?:head|come|go|return|run|sail|steam|make for|make your way|drive|transit|proceed|be|bring"
    r" her|motor|straight|back|directly|on|then|it['’]s|heading|"
    r"going)"
)

HOME_LAST = re.compile(
    r"(?:,? ?(?:and )?(?:then |finally |afterwards,? |after that,? )?|(?P<stop>[.;])"
    r" (?:(?:and|then|finally|after that|afterwards|that done|when (?:that is "
    r")?(?:done|finished)|"
    rf"once (?:that is )?(?:done|finished)),? )*)(?:(?<![a-z])(?:{_GO} )+(?:home|to base|to"
    r" home)|(?<=then )home)\b(?! (?:port|berth|side))",
    re.IGNORECASE,
)
WAY_HOME = re.compile(
    r"\b(?:(?:nothing|none|not|no \w+|but not|and not) )?(?:on|during|for|in) (?:the |that"
    r" )?(?:(?:way|run|leg|trip|passage|transit|return) )(?:back "
    r")?(?:home|to base|back)\b",
    re.IGNORECASE,
)
"""Where something is done or not done."""
HOME = re.compile(r"\b(?:home|base)\b", re.IGNORECASE)
_LANES = r"(?:lanes?|lines?|legs?|tracks?|strips?|runs?|transects?|rows?|swaths?)"
_N = r"(?P<{0}>two|three|four|five|six|[2-9])"
_NUMBERS = {
    "two": 2,
    "three": 3,
    "four": 4,
    "five": 5,
    "six": 6,
    "second": 2,
    "third": 3,
    "fourth": 4,
    "fifth": 5,
    "one": 1,
    "first": 1,
}
_DO = (
    r"(?:do|run|sail|drive|cover|survey|mow|complete|follow|steam|sound|work|take|fly|make|want|need|we"
    r" want|we need|execute|go for)"
)
_OF_IT = r"(?: of (?:it|the (?:\w+ )?(?:grid|area|pattern|survey|lawn-?mower|plan)))?"
FIRST = re.compile(
    rf"(?P<before>^|[.;:,] |\b{_DO} |\b(?:so|and|but|today) |\bonly |\bjust )(?:(?:of|from) the"
    r" (?:(?:normal|usual|planned|given|whole|full) )*(?:grid|area|"
    rf"survey|pattern),? )?(?:please )?(?:{_DO} )?"
    rf"(?P<only>only |just )?(?:{_DO} )?(?P<only2>only |just )?the first {_N.format('n')}"
    rf" {_LANES}{_OF_IT}(?P<alone> only| alone|,? and no more|,? no more| "
    r"today)?(?: of the \w+)?",
    re.IGNORECASE,
)
LED = re.compile(
    r"\b(?:on|for|during|in|along|over|at|of|to|after|from|until|by|with)(?: (?:only|just))? $",
    re.IGNORECASE,
)
"""Before lanes on which something is done."""
STOP_AFTER = re.compile(
    r",? ?(?:and |but )?(?:stop|break off|break it off|end|finish|quit|leave it|call it a"
    r" day|abandon it|cut it short)(?: it| the (?:grid|survey))?(?: "
    r"there)? (?:after|at the end of|behind|on completing|when you have done|with) "
    r"(?:the )?(?:(?P<nth>second|third|fourth|fifth)"
    rf" (?:lane|line|leg|track|strip|run|transect)|(?:first )?{_N.format('n')} {_LANES})\b",
    re.IGNORECASE,
)
WITHOUT_LAST = re.compile(
    r",? ?(?:and |but )?(?:please )?(?:(?:leave out|leave off|skip|omit|drop|without|except(?:"
    r" for)?|miss out|cut|all (?:the |of the )?lanes (?:but|"
    rf"except)|all but)) the last (?:{_N.format('n')} )?{_LANES}\b",
    re.IGNORECASE,
)
_CORNER = (
    r"(?:north|south)[ -]?(?:east|west)(?:ern)?(?: corner| one)?|(?-i:NE|NW|SE|SW)(?: corner)?"
)
_MIDDLE = (
    r"(?:the )?(?:mid-?point|middle|centre) of the (?:north|south|east|west)(?:ern)?"
    r" (?:side|edge)|(?:north|south|east|west)(?:ern)? (?:mid-?side|side|middle)"
)
_SPOT = rf"(?:the )?(?:{_MIDDLE}|{_CORNER})"
_NEXT = (
    r"(?:,? ?(?:and )?(?:then|finally|lastly|next|to|on to|and|after that)(?: (?:to|on"
    r" to|the))?|,|;| ->| -) "
)
SPOTS = re.compile(
    rf"\b{_SPOT}(?: first)?(?:{_NEXT}{_SPOT}){{1,7}}(?! (?:side|sides|corners|to)\b)", re.IGNORECASE
)
_ONE_SPOT = re.compile(_SPOT, re.IGNORECASE)
ROUTE = re.compile(
    r"\b(?:only|just|visit|no mid-?sides?|without (?:the )?mid-?sides?|corners (?:only|alone)|in"
    r" (?:this|the following|that) order|order|call at|stop at|go "
    r"to|points?|corners)\b[^.;]{0,60}$",
    re.IGNORECASE,
)
DONE_AT = re.compile(
    r"\b(?:at|on|in|between|from|off|for) (?:only |just )?(?:the )?$", re.IGNORECASE
)
STOPS_AT = re.compile(
    r"\b(?:stop|stops|stopping|go|call|hold) (?:only |just )?(?:at|to) (?:only |just )?(?:the )?$",
    re.IGNORECASE,
)
CORNERS = re.compile(
    r"(?:^|[.;:!] )(?:please )?(?:(?:go to|run|do|visit|survey|take|call at) )?(?:only |just"
    r" )(?:(?:go to|run|do|visit|take) )?the (?:four )?corners\b|"
    r"(?:^|[.;:!] |\b(?:run|visit|do|go to|survey|round|square,) )(?:the )?(?:four )?corners(?: of"
    r" (?:the|its|that) (?:[\w-]+ )?(?:square|ring))? (?:only|"
    r"alone)\b|"
    r"\b(?:leave out|skip|omit|no|without|forget|drop|not|miss out)(?: all)? (?:the )?(?:four"
    r" )?mid-?sides?(?: points| waypoints)?\b",
    re.IGNORECASE,
)
NOT_CORNERS = re.compile(
    r"\bat the (?:four )?corners\b[^.;]{0,60}\bmid-?sides?\b|\bmid-?sides?\b[^.;]{0,60}\bat the"
    r" (?:four )?corners\b|\beight\b|\bstandard\b",
    re.IGNORECASE,
)
_ONWARD = re.compile(
    r"\b(?:then (?:go|run|do|head|sail|make|start|survey|turn|hold|drift|wait|stay)|but"
    r" first|before (?:that|going|you|heading)|after that|(?:another|a "
    r"second|a) (?:square|grid))\b|[\[(]\s*[-−–]?\d",
    re.IGNORECASE,
)
ACCURACY = re.compile(
    r"\b(?:against|better than|worse than|no more than|at most|threshold(?: of)?|limit(?: of)?)"
    r" \d+(?:\.\d+)? ?(?:m|met(?:re|er)s?)\b",
    re.IGNORECASE,
)
"""A length that something is measured by."""
CLOSED = re.compile(
    r"\bclos(?P<e>e|ing) (?:it|the (?:square|ring|loop|circuit))(?: again)? (?:at|on|with|by \w+ing"
    r" (?:back )?(?:to|at)) (?:the |its )?(?:very )?(?:first|"
    r"start\w*)(?: (?:way-?point|point|corner|one|position))?",
    re.IGNORECASE,
)
ELSEWHERE = re.compile(
    r"\b(?:twice|again|laps?|rounds|half|instead|rather|sorry|but first|reverse\w*|two"
    r" (?:squares|grids)|back to)\b",
    re.IGNORECASE,
)
ORDERED = re.compile(r"\bfirst\b|\bthen\b", re.IGNORECASE)


def read_part(record: dict[str, Any], task: Task, own: Point | None, home: Point) -> Path | None:
    """Every waypoint of the answer in order, where the input asks for a part of the task's shape,
    or for all of it and the way home.
    """
    given, prompt = record.get("parameters"), str(record.get("prompt", ""))
    if (
        task.pattern not in ("lawnmower", "square")
        or own is None
        or len(prompt) > LONGEST
        or not isinstance(given, dict)
    ):
        return None
    text = CLOSED.sub(
        r"clos\g<e> it",
        ACCURACY.sub(
            " ", WAY_HOME.sub(" ", w.NOT_HOME.sub(" ", without_fences(plain_text(prompt))))
        ),
    )
    homeward = [*HOME_LAST.finditer(text)]
    text = HOME_LAST.sub(lambda said: said["stop"] or "", text)
    if len(homeward) > 1 or HOME.search(text):
        return None
    ends = (home,) if homeward else ()
    if homeward and _goes_on(homeward[0].string[homeward[0].end() :]):
        return None
    path = (
        _lanes(text, given, task, own)
        if task.pattern == "lawnmower"
        else _corners(text, given, own)
    )
    if path is None and homeward:
        path = _whole(text, given, task, own)
    return (*path, *ends) if path else None


def _goes_on(behind: str) -> bool:
    """Whether a text leads on from home."""
    return _ONWARD.search(behind) is not None


def _whole(text: str, parameters: dict[str, Any], task: Task, own: Point) -> Path | None:
    """The one path that the task's shape can be by the text."""
    found = one_shape(text, parameters, task, own)
    if not found or found[1]:
        return None
    paths, cues = found[0], read_cues(text)
    if len(paths) > 1 and task.pattern == "lawnmower" and len(cues.corners) == len(cues.axes) == 1:
        # Nothing is said of where the lanes begin, or it is said plainly.
        south, west = cues.corners[0].split("-")
        paths = tuple(
            path
            for path in paths
            if (path[0][1] < own[1]) == (south == "south")
            and (path[0][0] < own[0]) == (west == "west")
        )
    return paths[0] if len(paths) == 1 else None


def _lanes(text: str, parameters: dict[str, Any], task: Task, own: Point) -> Path | None:
    """Some lanes of the grid."""
    first, stop, last = FIRST.search(text), STOP_AFTER.search(text), WITHOUT_LAST.search(text)
    told = [match for match in (first, stop, last) if match]
    if len(told) != 1 or ELSEWHERE.search(text):
        return None
    match = told[0]
    if first:
        only = (
            first["only"]
            or first["only2"]
            or first["alone"]
            or first["before"].strip().lower() in ("only", "just")
        )
        if not only or LED.search(text[: first.start()]) or LED.search(first["before"]):
            return None
        rest = (
            f"{text[: first.start()]}{first['before'] if first['before'][:1] in '.;:,' else ' '}run"
            f" the grid{text[first.end() :]}"
        )
    else:
        rest = text[: match.start()] + text[match.end() :]
    said = match["n"] or (match["nth"] if stop else None) or "one"
    count = _NUMBERS.get(said.lower()) or int(said)
    path = _whole(rest, parameters, task, own)
    if path is None or 2 * count >= len(path):
        return None
    return path[: len(path) - 2 * count] if last else path[: 2 * count]


def _corners(text: str, parameters: dict[str, Any], own: Point) -> Path | None:
    """Some points of the square, in the order in which they are named, or its corners."""
    lists = list(SPOTS.finditer(text))
    radius = _radius(text, parameters, own)
    if radius is None or ELSEWHERE.search(text):
        return None
    corners_only = CORNERS.search(text) is not None and not NOT_CORNERS.search(text)
    if len(lists) == 1:
        before = re.split(r"[.;] ", text[: lists[0].start()])[-1]
        names = [_name(spot[0]) for spot in _ONE_SPOT.finditer(lists[0][0])]
        led = ROUTE.search(before) if not DONE_AT.search(before) else STOPS_AT.search(before)
        if (
            not led
            or len(set(names)) < len(names)
            or w.CLOCKWISE.search(text)
            or (corners_only and len(names) != 4)
        ):
            return None
        square = dict(
            zip(g.SQUARE_STARTS, g.survey_square(own, radius, g.SQUARE_STARTS[0]), strict=True)
        )
        return tuple(square[name] for name in names)
    if not corners_only or lists:
        return None
    turns = {match[1] is None for match in w.CLOCKWISE.finditer(text)}
    starts = {str(named_corner(match)) for match in w.CORNER.finditer(text)}
    rest = w.CORNER.sub(" ", text)
    if (
        len(turns) > 1
        or len(starts) > 1
        or re.search(r"\b(?:north|south|east|west)", rest, re.IGNORECASE)
        or (not starts and re.search(r"\b(?:start|begin|first)", rest, re.I))
    ):
        return None
    start = starts.pop() if starts else "north-east"
    return tuple(g.survey_square(own, radius, start, clockwise=True in turns)[::2])


def _name(spot: str) -> str:
    """The name of a corner or of the middle of a side."""
    corner = w.CORNER.search(spot)
    if corner:
        return str(named_corner(corner))
    side = re.search(r"north|south|east|west", spot, re.IGNORECASE)
    assert side
    return side[0].lower()


def _radius(text: str, parameters: dict[str, Any], own: Point) -> float | None:
    """Half the side of the square: the one that the text names, else the task's own."""
    places = [
        Place(g.point(x, y), start, end)
        for x, y, start, end in positions(text)
        if not w.SIZE.search(text[start:end])
    ]
    if any(place.point != own for place in places):
        return None
    sizes = {
        value for value, _start, end in stated_sizes(text, places) if not CIRCLE.match(text[end:])
    }
    sizes = sizes or {
        value for value in [parameters.get("radius")] if isinstance(value, int | float)
    }
    return sizes.pop() if len(sizes) == 1 else None
