"""The movement of a task that is handed down as a whole: "Survey the depths around [40, 20] over 80
m by 50 m with lines 5 m apart."

The Mission Agent's task prompts say what is wanted, in one sentence and without steps; the movement
is then the task's own, as its pattern and its parameters give it
(planner_ft/data/task/handed_down.py words the same). A prompt that speaks of another place, a way
off, a second movement or a length that the task does not have is no such sentence.
"""

from __future__ import annotations

import math
import re
from typing import Any

from planner_ft.data.quantities import positions, quantities
from planner_ft.data.task import geometry as g
from planner_ft.decoding.constraints.reading import wordings as w
from planner_ft.decoding.constraints.reading.paths.shapes import Point, stated_ways
from planner_ft.vocabulary import Task, Vocabulary

Path = tuple[Point, ...]
FOUND = re.compile(
    r",?\s*\b(?:once|after|when|as soon"
    r" as)\b[^.,;]*\b(?:found|located|detected|confirmed)\b|\bwhere"
    r" (?:it|he|she|they)\b[^.,;]*\bfound\b",
    re.IGNORECASE,
)
"""Words for a place that a search has found: it is filled in by now."""
BEGINNINGS = {
    "goto": r"go|proceed|transit|head|return|sail|come|move|drive|steam|navigate",
    "approach": r"dock|berth|moor|approach|come alongside|go alongside|make fast|tie up|land",
    "lawnmower": r"survey|map|sound|chart|measure|run|conduct|carry out|record|scan",
    "square": r"survey|inspect|examine|check|look",
    "line": r"track|follow|trace",
}
"""Verbs that a sentence begins with which asks for a movement of this pattern as a whole."""
ON_SITE = re.compile(
    r"(?:circle|orbit|hold|keep|stay|maintain|cut|drift|locate|find|scan|reposition|photograph|film|record|"
    r"make (?:half )?an? (?:\w+ )?(?:arc|circle|orbit|round)|take (?:an?"
    r" )?(?:pano\w*|thermal|temperature|readings|measure\w*|picture\w*|photo\w*|image\w*))\b",
    re.IGNORECASE,
)
"""Verbs of what is performed where the vehicle was brought before."""
ONWARD = re.compile(
    r"\b(?:(?:then|before|afterwards|next|finally|go|going|proceed\w*|return\w*|home)\b|(?:to|from|towards|via|way)"
    r" [\[(])",
    re.IGNORECASE,
)
"""Words of another movement beside that."""
NAME = re.compile(r"\b[A-Z]+\d*-\d+(?:-\d+)?\b")
"""A name with numbers ("buoy J92-6"), which is no place."""
HOME = re.compile(r"\b(?:home|base|start\w*)\b", re.IGNORECASE)
AREA = re.compile(
    r"\b(?:depths?|bathymetr\w+|sounding\w*|seabed|sea"
    r" floor|bottom|grid|lawn-?mower|lines|lanes)\b",
    re.IGNORECASE,
)
OTHERWISE = re.compile(
    r"\b(?:clock-?wise|counter\w*|anti\w*|corners?|sides?|mid-?\w*|half|edge|turn\w*|rotat\w*|arc|north\w*|south\w*|east\w*|west\w*|zig\w*|spiral\w*|twice|"
    r"times|"
    r"first|last|only|just|except|start\w*|begin\w*|points?|waypoints?|steps?|legs?|stop\w*|hold\w*|stay\w*|wait\w*|before|face|facing|passes|between|while|"
    r"and|then|bow|offset|"
    r"nudg\w*|pan)\b",
    re.IGNORECASE,
)
"""Words that a movement other than the plain one may be meant with."""


def own_movement(
    text: str, parameters: dict[str, Any], own: Point | None, task: Task, vocabulary: Vocabulary
) -> Path | None:
    """The waypoints of a task whose prompt asks for it as a whole; none where it is performed where
    the vehicle is; None for other prompts.
    """
    plain = NAME.sub(lambda name: "N" * len(name[0]), FOUND.sub("", text)).strip().rstrip(".! ")
    places = _places(plain)
    if re.search(r"[.;:!?]\s", plain) or len(places) > 1:
        return None
    bare = plain
    for _x, _y, start, end in places:
        bare = bare[:start] + " " * (end - start) + bare[end:]
    if task.arrival == "transit":
        return (
            ()
            if ON_SITE.match(bare) and not ONWARD.search(plain) and not any(stated_ways(bare, []))
            else None
        )
    beginning = BEGINNINGS.get(task.pattern)
    if (
        own is None
        or beginning is None
        or any(g.point(x, y) != own for x, y, _start, _end in places)
    ):
        return None
    if (
        not re.match(rf"(?:{beginning})\b", bare, re.IGNORECASE)
        or OTHERWISE.search(bare)
        or any(stated_ways(bare, []))
    ):
        return None
    if HOME.search(bare) and own != g.point(*vocabulary.home):
        return None
    values = [value for value in parameters.values() if isinstance(value, int | float)]
    if any(
        quantity.unit == "m" and g.tidy(quantity.value) not in values
        for quantity in quantities(bare)
    ):
        return None
    return _path(bare, parameters, own, task)


def _places(text: str) -> list[tuple[float, float, int, int]]:
    """The places of a sentence, without sizes; where some stand in brackets, those alone."""
    found = [place for place in positions(text) if not w.SIZE.search(text[place[2] : place[3]])]
    return [place for place in found if text[: place[2]].endswith(("[", "("))] or found


def _path(text: str, parameters: dict[str, Any], own: Point, task: Task) -> Path | None:
    if task.pattern in ("goto", "approach"):
        return (own,)
    if task.pattern == "lawnmower" and AREA.search(text):
        return _grid(parameters, own)
    if task.pattern == "square" and (radius := _number(parameters, "radius")):
        return tuple(g.survey_square(own, radius))
    heading, length = _number(parameters, "heading"), _number(parameters, "max_dist")
    if task.pattern == "line" and heading is not None and length:
        return tuple(g.straight_line(own, heading, length))
    return None


def _grid(parameters: dict[str, Any], own: Point) -> Path | None:
    """The lanes of a grid; where the spacing does not divide the width, as many as fit, from the
    south-west corner on.
    """
    width, length, spacing = (_number(parameters, name) for name in ("width", "length", "spacing"))
    if not width or not length or not spacing:
        return None
    across = math.floor(width / spacing + 1e-9) * spacing
    if not 2 <= round(across / spacing) + 1 <= w.MOST_LANES:
        return None
    return tuple(g.lawnmower((own[0] - (width - across) / 2, own[1]), across, length, spacing))


def _number(parameters: dict[str, Any], name: str) -> float | None:
    value = parameters.get(name)
    return value if isinstance(value, int | float) else None
