"""Where a grid or square begins, which way its lanes run and which way round it goes, by the words of a task input.

A word that names it decides; where none does and none speaks of a beginning either, the labelling rules of the task level do: lanes along y from the
south-west corner, a square from the middle of its east side counter-clockwise. In any other case all are possible.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

from planner_ft.data.task import geometry as g
from planner_ft.decoding.constraints.reading import wordings as w
from planner_ft.decoding.constraints.reading.shapes import named_corner

BEGINNING = re.compile(
    r"\b(?:(?<!you )start\w*|begin\w*|first|enter\w*|entr\w+|from the|opposite|other|far|near|upper|lower|top|bottom|left|right)\b", re.IGNORECASE
)
REVERSED = re.compile(r"\b(?:other way|reverse\w*|opposite|either way)\b", re.IGNORECASE)


@dataclass(frozen=True)
class Cues:
    """What is possible: corners that a grid begins at and axes along which its lanes run, starts of a square, and whether it goes clockwise."""

    corners: tuple[g.Corner, ...]
    axes: tuple[g.Axis, ...]
    starts: tuple[str, ...]
    turns: tuple[bool, ...]


ANY = Cues(g.CORNERS, ("y", "x"), g.SQUARE_STARTS, (False, True))


def read_cues(text: str) -> Cues:
    """What the words of an input leave possible."""
    along_x, along_y = w.LANES_X.search(text), w.LANES_Y.search(text)
    plain = w.LANES_Y.sub(" ", w.LANES_X.sub(" ", text))
    corners = tuple(dict.fromkeys(named_corner(match) for match in w.CORNER.finditer(plain)))
    rest = w.CORNER.sub(" ", plain)
    sides = tuple(dict.fromkeys(re.sub(r"ern$", "", match[1] or match[2]).lower() for match in w.SIDE.finditer(rest)))
    open_beginning = BEGINNING.search(rest) is not None
    turns = tuple(sorted({match[1] is None for match in w.CLOCKWISE.finditer(text)}))
    return Cues(
        corners or (ANY.corners if open_beginning else ("south-west",)),
        ANY.axes if along_x and along_y else ("x",) if along_x else ("y",),
        (*corners, *sides) or (ANY.starts if open_beginning else ("east",)),
        ANY.turns if REVERSED.search(text) else turns or (False,),
    )
