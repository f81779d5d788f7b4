"""Where a grid or square begins, which way its lanes run and which way round it goes, by the words
of a task input.

A word that names it decides; where none does and none speaks of a beginning either, the labelling
rules of the task level do: lanes along y from the south-west corner, a square from the middle of
its east side counter-clockwise. In any other case all are possible.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

from planner_ft.data.task import geometry as g
from planner_ft.decoding.constraints.reading import wordings as w
from planner_ft.decoding.constraints.reading.paths.shapes import named_corner

BEGINNING = re.compile(
    r"\b(?:(?<!you )start\w*|begin\w*|first|enter\w*|entr\w+|from the (?!(?:[\w'’-]+"
    r" ){0,2}(?:camera|cam|sensor|stream|imu|sounder|lidar|feed|lens|video|"
    r"buffer|"
    r"target|mast|pile|wreck|buoy)\b)|opposite|other|far|near|upper|lower|top|bottom|left|right)\b",
    re.IGNORECASE,
)
REVERSED = re.compile(r"\b(?:other way|reverse\w*|opposite|either way)\b", re.IGNORECASE)
FIRST_LANE = re.compile(
    r"\bfirst (?:lane|line|track|leg|run)\b[^.;]{0,30}?\b(north|south|east|west)(?:ern)?most\b|"
    r"\b(?:with|at|from|on) the (north|south|east|west)(?:ern)?most (?:lane|line|track|leg|run)\b|"
    r"\b(north|south|east|west)(?:ern)?most (?:lane|line|track|leg|run) first\b",
    re.IGNORECASE,
)
"""The lane that a grid begins with."""
LANE_END = re.compile(
    r"\b(?:start\w*|begin\w*|from)\b[^.;,]{0,15}?\b(?:its|the) (north|south|east|west)(?:ern)?"
    r" end\b",
    re.IGNORECASE,
)
"""The end of it that is first."""

APART = re.compile(
    r"\b(?:at|on|along|for) (?:all )?(?:the )?(?:(?:three|four|eight|[348])"
    r" )?(?:(?:waypoints?|points?|middles?|corners?)(?: waypoints?|"
    r" points?)? (?:of|on|along) )?"
    r"(?:the |its |each |every |all )(?:(?:north|south|east|west)(?:ern)? )?(?:sides?|edges?)\b|"
    r"\b(?:for|on|along|over) the (?:whole|entire|full) (?:north|south|east|west)(?:ern)?"
    r" side\b|(?<=metres )from the\b|(?<=yards )from the\b|"
    r"(?<=feet )from the\b",
    re.IGNORECASE,
)
"""Places of a square at which something is done, and lengths off something, in sentences that say
nothing of where it begins.
"""
BEGINS = re.compile(
    r"\b(?:start|begin|first|enter|entr|commenc|clockwise|from (?!the\b))", re.IGNORECASE
)


@dataclass(frozen=True)
class Cues:
    """What is possible: corners that a grid begins at and axes along which its lanes run, starts of
    a square, and whether it goes clockwise.
    """

    corners: tuple[g.Corner, ...]
    axes: tuple[g.Axis, ...]
    starts: tuple[str, ...]
    turns: tuple[bool, ...]


ANY = Cues(g.CORNERS, ("y", "x"), g.SQUARE_STARTS, (False, True))


def read_cues(text: str) -> Cues:
    """What the words of an input leave possible."""
    text = w.EXTENT.sub(r"\1", _without_apart(text))
    along_x, along_y = w.LANES_X.search(text), w.LANES_Y.search(text)
    plain = w.LANES_Y.sub(" ", w.LANES_X.sub(" ", text))
    corners = tuple(dict.fromkeys(named_corner(match) for match in w.CORNER.finditer(plain)))
    corners = corners or _first_lane(plain)
    rest = w.CORNER.sub(" ", plain)
    sides = tuple(
        dict.fromkeys(
            re.sub(r"ern$", "", match[1] or match[2]).lower() for match in w.SIDE.finditer(rest)
        )
    )
    open_beginning = BEGINNING.search(rest) is not None
    turns = tuple(sorted({match[1] is None for match in w.CLOCKWISE.finditer(text)}))
    return Cues(
        corners or (ANY.corners if open_beginning else ("south-west",)),
        ANY.axes if along_x and along_y else ("x",) if along_x else ("y",),
        (*corners, *sides) or (ANY.starts if open_beginning else ("east",)),
        ANY.turns if REVERSED.search(text) else turns or (False,),
    )


def _without_apart(text: str) -> str:
    """A text without the places of a square that only say where something is done."""
    return "".join(
        sentence if BEGINS.search(sentence) else APART.sub(" ", sentence)
        for sentence in re.split(r"(?<=[.;])(?=\s)", text)
    )


def _first_lane(text: str) -> tuple[g.Corner, ...]:
    """The corner at which the lane begins that is named first, by its side of the area and by its
    end.
    """
    lanes = {next(filter(None, match.groups())).lower() for match in FIRST_LANE.finditer(text)}
    ends = {match[1].lower() for match in LANE_END.finditer(text)}
    return tuple(
        corner
        for corner in g.CORNERS
        if len(lanes) == len(ends) == 1 and set(corner.split("-")) == lanes | ends
    )
