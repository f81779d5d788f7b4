"""Where the lanes of a grid begin and which way they run, put together from what a task input says
about them.

A corner can be named as such, or by the side of the first lane and the end that it begins at
("first lane along the south edge, starting at its west end"), and a heading on the first lane or
the direction in which lane follows lane tell the axis too. What is not said follows the labelling
rules: lanes along y from the south-west corner. None where two of the words do not agree, or where
a beginning is spoken of that is not understood.
"""

from __future__ import annotations

import re

from planner_ft.data.task import geometry as g
from planner_ft.decoding.constraints.reading import wordings as w
from planner_ft.decoding.constraints.reading.paths.shapes import named_corner

_WAY = r"(north|south|east|west)"
_LANE = r"(?:lane|line|track|leg|run|strip|swath|transect|row|pass|one)"
_EDGE = r"(?:edge|side|boundary|limit|border|margin)"
_BEGIN = r"(?:start\w*|begin\w*|enter\w*|entr(?:y|ance)|from|first)"
CORNER_SAID = re.compile(
    rf"(?:{w.CORNER.pattern})(?:[ -](?:hand )?(?:corner|end|one))?(?: first\b)?", re.IGNORECASE
)
FIRST_LANE = re.compile(
    rf"\bfirst (?:{_LANE} )?(?:(?:is|runs|lies|goes|being|should be|to"
    rf" be|down|up|along|on|at|with|by|comes) )*(?:the |its )?{_WAY}(?:ern(?:most)?|most)?\b"
    rf"(?: {_EDGE}| {_LANE}|\b(?=[.,;]))|"
    rf"\bfirst {_LANE}\b[^.;]{{0,24}}?\b(?:along|on|at|the) (?:the |its"
    rf" )?{_WAY}(?:ern(?:most)?|most)?(?: {_EDGE}| {_LANE}|most\b|ernmost\b)|"
    rf"\b(?:start|begin)\w* (?:with|on|along|down|up) the {_WAY}(?:ern(?:most)?|most)?"
    rf" (?:{_EDGE}|{_LANE})\b|"
    rf"\b(?:with|at|from|on|take|do|run) the {_WAY}(?:ern)?most {_LANE}\b|"
    rf"\b{_WAY}(?:ern(?:most)?|most)? (?:{_EDGE}|{_LANE}) (?:first|to begin with)\b",
    re.IGNORECASE,
)
"""The side of the area along which the first lane runs."""
BEGINS_AT = re.compile(
    rf"\b{_BEGIN}\b(?: (?:it|them|each|off|out|point|lane|is|the grid|the survey))*(?:"
    r" (?:at|in|on|from|with|of))*(?: (?:the|"
    rf"its))? {_WAY}(?:ern)?(?: (?:end|{_EDGE}))?"
    r"\b(?![ -](?:north|south|east|west|to[ -]|and[ -]|lane|line))",
    re.IGNORECASE,
)
"""The side of the area, or the end of the first lane, where the path begins."""
FIRST_WAY = re.compile(
    rf"\bfirst\b[^.;]{{0,40}}?\b{_WAY}(?:[ -]to[ -]| (?:end )?to (?:the"
    r" )?)(?:north|south|east|west)\b|"
    rf"(?:\bfirst\b|corner|end|\bin|edge|most {_LANE}|\b(?:start|begin)\w*|(?:north|south)["
    r" -]?(?:west|"
    rf"east)(?:ern)?)\b[^.;]{{0,30}}?[ ,]+(?:and )?(?:then )?(?:is"
    rf" )?(?:run|go|head|sail|steer|driv|travel|fac|bound|run it)"
    rf"\w* (?:due |to the |towards the |it )?{_WAY}(?:wards?|bound)?\b(?!["
    r" -](?:to|and|of|north|south|east|west)\b)|"
    r"\bfirst"
    rf" {_LANE}\b[^.;]{{0,30}}?\b{_WAY}(?:bound|wards?)\b|\b(?:{_EDGE}|{_LANE}|end|corner|first)\b["
    rf" ,]+(?:and )?{_WAY}bound\b",
    re.IGNORECASE,
)
"""Where the first lane begins ("from north to south"), or which way it is run."""
STEP = re.compile(
    rf"\b(?:step\w*|work\w*|progress\w*|shift\w*|advanc\w*|mov(?:e|es|ing)|build\w*|spread\w*|continu\w*|proceed\w*|fill\w*|carry"
    rf" on|on)"
    rf"(?: (?:your way|its way|along|over|across|out|outwards?|lane by lane|line by line|from"
    rf" there|then|in|to|towards?|the|due|"
    rf"further))*,? {_WAY}(?:wards?|ern)?\b"
    rf"(?![ -](?:end|edge|side|corner|of|north|south|east|west|lane|line)\b)|"
    r"\b(?:next|following|other|others|each|every|subsequent|rest)\b[^.;]{0,32}?\b(?:further|to"
    rf" the|towards the|farther|more) {_WAY}(?:wards?|erly)?\b|"
    rf"\b{_WAY}(?:wards?)?,? (?:{_LANE} (?:by|after) {_LANE}|step by step)|"
    rf"\b{_LANE} (?:by|after) {_LANE},? (?:to(?:wards)? the |going )?{_WAY}(?:wards?)?\b|"
    rf"\b(?:then|and|from there),? (?:on )?(?:to the )?{_WAY}wards?\b",
    re.IGNORECASE,
)
"""The direction in which lane follows lane."""
LANES_X = re.compile(
    rf"{w.LANES_X.pattern}|\bin (?:the )?x(?:[- ]direction)?\b|\bx[- ]direction\b|\balong (?:a"
    r" )?constant y\b|"
    r"\b(?:lanes?|lines?|legs?|transects?|strips?|runs?|tracks?|rows?) (?:\w+"
    r" ){0,2}(?:along|in|parallel to) (?:the )?x\b",
    re.IGNORECASE,
)
LANES_Y = re.compile(
    rf"{w.LANES_Y.pattern}|\bin (?:the )?y(?:[- ]direction)?\b|\by[- ]direction\b|"
    r"\b(?:lanes?|lines?|legs?|transects?|strips?|runs?|tracks?|rows?) (?:\w+"
    r" ){0,2}(?:along|in|parallel to) (?:the )?y\b",
    re.IGNORECASE,
)
NOT_SO = re.compile(
    r"\b(?:rather than|instead of|not|never) (?:the usual |the |from"
    rf" )?(?:{w.LANES_X.pattern}|{w.LANES_Y.pattern})",
    re.IGNORECASE,
)
"""A way of the lanes that is ruled out."""
STATED_CORNER = re.compile(
    rf"(?:{w.CORNER.pattern})(?: (?:corner|end|one))?(?: of (?:the|its|this) \w+)?(?:"
    r" ?(?:is|lies|being|at|=|:|"
    rf",))* ?(?=[\[(]? ?[-−–]?\d+(?:\.\d+)? ?[,/;] ?[-−–]?\d)|\((?:{w.CORNER.pattern})\)",
    re.IGNORECASE,
)
"""A corner of the area that its coordinates are stated of."""
ACROSS = re.compile(
    rf"\bfrom (?:the )?{_WAY} (?:edge |side |end )?to (?:the )?(?:north|south|east|west)\b",
    re.IGNORECASE,
)
"""From one side of the area to the other."""
LONG_SIDE = re.compile(
    r"\b(?:along|parallel to|with|in) (?:the |its )?(?P<side>long|short)(?:er|est)?"
    r" (?:side|axis|dimension|direction|way|edge)s?\b|\blength-?ways\b|"
    r"\blengthwise\b",
    re.I,
)
"""Lanes along the longer or the shorter side of the area."""
BEGINNING = re.compile(
    r"\b(?:(?<!you )start(?!\w* (?:recording|logging|the"
    r" (?:recording|camera|video|sonar)))\w*|begin(?!\w*"
    r" (?:recording|logging))\w*|first|enter\w*|entry|"
    r"opposite|"
    r"from the|other|far|near)\b(?= |[.,;]|$)",
    re.IGNORECASE,
)
PLACED = re.compile(
    r"\b(?:corners?|edges?|sides?|ends?|north\w*|south\w*|east\w*|west\w*|lanes?|lines?|legs?|top|bottom|left|right|there|where\w*|"
    r"whichever|nearest|closest)\b",
    re.IGNORECASE,
)
NO_BEGINNING = re.compile(
    r"\bfrom the (?:first|second|third|last) \w+ on(?:wards)?\b|"
    r"\b(?:when|once|after|until|till|behind|at the end of|throughout|during|on|along|from (?:the"
    r" )?(?:start|first) to (?:the )?(?:end|finish|last))\b[^.;,]*|"
    r"\b(?:each|every|all|no|both) [^.;,]*|\bfrom (?:start|end) to (?:finish|end)\b|\bfirst of"
    r" all\b|^first,|\bfirst (?:and last|hold|turn|wait|check)\b|"
    r"\bthe other way round\b(?= for once)",
    re.IGNORECASE,
)
"""Clauses that are not about where the grid begins."""
FROM_CORNER = re.compile(r"\bfrom (?:the |its )?;{6,}(?: corner)?", re.IGNORECASE)
"""A beginning that was understood: the corner is masked."""
COURSES = re.compile(
    r"\b(?:(?:on|along|steer(?:ing)?) )?(?:an? |the )?(?:heading|course|bearing|direction)(?: of|"
    r" is)?(?: due)? (?:\d{1,3}|(?:north|south)[ -]?(?:east|"
    r"west)|north|south|east|west)\b"
    r"(?: ?(?:degrees|deg\b|°))?|\bdog[- ]?leg|\balter\w* course|\bbends?\b(?="
    r" (?:there|to|and)|[.,;])|\b(?:follow|track)\w* (?:it|(?:the |"
    r"a )?(?:\w+ )?(?:cable|pipe\w*|line|track))\b",
    re.IGNORECASE,
)
"""The course of a leg, and words for a bend in the way."""
CLAUSE = re.compile(r"[.,;:]")


def read_lanes(
    text: str, width: float | None = None, length: float | None = None
) -> tuple[g.Corner, g.Axis] | None:
    """The corner that a grid begins at and the axis along which its lanes run."""
    plain = NOT_SO.sub(_mask, STATED_CORNER.sub(_mask, w.EXTENT.sub(r"\1", text)))
    axes = _axes(plain)
    across: list[str] = []
    if len(axes) > 1:  # "north-south lanes, from east to west"
        across = [match[1].lower() for match in ACROSS.finditer(plain)]
        plain = ACROSS.sub(" ", plain)
        axes = _axes(plain)
    long_side = LONG_SIDE.search(plain)
    if long_side and not axes and width and length and width != length:
        axes.add(
            "x" if (width > length) == ((long_side["side"] or "long").lower() == "long") else "y"
        )
    masked = CORNER_SAID.sub(_mask, LANES_Y.sub(_mask, LANES_X.sub(_mask, plain)))
    corners = {
        named_corner(match)
        for match in w.CORNER.finditer(LANES_Y.sub(_mask, LANES_X.sub(_mask, plain)))
    }
    ways, first, sides, steps = (
        _said(FIRST_WAY, plain),
        _said(FIRST_LANE, masked),
        _said(BEGINS_AT, masked),
        _said(STEP, masked),
    )
    begun = [_start_of(way, said) for way, said in ways]
    rest = masked
    for pattern, searched in (
        (FIRST_WAY, plain),
        (FIRST_LANE, masked),
        (BEGINS_AT, masked),
        (STEP, masked),
    ):
        for match in pattern.finditer(searched):
            rest = rest[: match.start()] + ";" * (match.end() - match.start()) + rest[match.end() :]
    halves = (
        {way for way, _match in [*first, *sides]}
        | set(begun)
        | set(across)
        | {_across(way) for way, _match in steps}
    )
    halves |= {half for corner in corners for half in corner.split("-")}
    axes |= (
        {_axis(way) for way, _match in ways}
        | {_other(_axis(way)) for way in across}
        | {_other(_axis(way)) for way, _match in [*steps, *first]}
    )
    if len(axes) > 1 or {"north", "south"} <= halves or {"east", "west"} <= halves or _open(rest):
        return None
    south, west = "north" if "north" in halves else "south", "east" if "east" in halves else "west"
    corner = next(corner for corner in g.CORNERS if corner == f"{south}-{west}")
    return corner, next(iter(axes), "y")


def without_courses(text: str) -> str:
    """A text without the words for the way on which lanes and legs are run: they ask for no
    turn.
    """
    return COURSES.sub(" ", FIRST_WAY.sub(" ", text))


def _axes(text: str) -> set[g.Axis]:
    """The axes along which the text says that lanes run."""
    axes: set[g.Axis] = set()
    if LANES_X.search(text):
        axes.add("x")
    if LANES_Y.search(text):
        axes.add("y")
    return axes


def _mask(match: re.Match[str]) -> str:
    return ";" * len(match[0])


def _said(pattern: re.Pattern[str], text: str) -> list[tuple[str, str]]:
    """The directions that a pattern finds, each with the words that tell it."""
    return [
        (next(group for group in match.groups() if group).lower(), match[0].lower())
        for match in pattern.finditer(text)
    ]


def _start_of(way: str, said: str) -> str:
    """The end at which a first lane begins that is run from one side to another or in a
    direction.
    """
    return way if re.search(rf"\b{way}(?:[ -]to[ -]| (?:end )?to )", said) else _across(way)


def _across(way: str) -> str:
    return {"north": "south", "south": "north", "east": "west", "west": "east"}[way]


def _axis(way: str) -> g.Axis:
    return "y" if way in ("north", "south") else "x"


def _other(axis: g.Axis) -> g.Axis:
    return "x" if axis == "y" else "y"


def _open(text: str) -> bool:
    """Whether what is left of the text may tell a beginning."""
    clauses = CLAUSE.split(NO_BEGINNING.sub(" ", FROM_CORNER.sub(_mask, text)))
    return (
        any(BEGINNING.search(clause) and PLACED.search(clause) for clause in clauses)
        or re.search(r"\b(?:opposite|other way|reverse\w*|either way|diagonal\w*)\b", text, re.I)
        is not None
    )
