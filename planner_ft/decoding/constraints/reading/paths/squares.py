"""Survey squares that are run more than once: "two squares, one after the other: radius 10 m, then
radius 18 m", "twice round", "the second lap clockwise".

None where a text speaks of one square, or does not say plainly how each of them is run.
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
from planner_ft.decoding.constraints.reading.paths.shapes import Place, Point, stated_sizes

Path = tuple[Point, ...]

TWO = re.compile(
    r"\b(?:two|2|both) (?:[a-z-]+"
    r" ){0,2}?(?:squares|rings)\b|\bsquares?\b[^.;]{0,60}\b(?:second|another|one more|then a)"
    r" (?:square|one)\b",
    re.IGNORECASE,
)
TWICE = re.compile(
    r"\b(?:twice(?! (?:the|as|that))|two (?:(?:full|complete|whole)"
    r" )?(?:rounds|laps|circuits|times|turns round)|(?:a|the) second (?:time|lap|round|"
    r"circuit))\b",
    re.IGNORECASE,
)
OTHER_WAY_ROUND = re.compile(
    r"\b(?:second|then|other|next|again|outer|inner|larger|bigger|smaller)\b[^.;]{0,40}\b(?:other"
    r" way|opposite (?:way|direction)|revers\w+|opposite)\b|"
    r"\bonce (?:in )?each (?:way|direction)\b|\bin both directions\b",
    re.IGNORECASE,
)
UNCLEAR = re.compile(
    r"\b(?:three|3|half|only|corners?"
    r" (?:only|alone)|but|instead|rather|sorry|clos(?:e|es|ed|ing)|grid|home|base|go to|then"
    r" (?:go|move|head)|transit|"
    r"between (?:them|the (?:two|squares|rounds|laps)))\b",
    re.IGNORECASE,
)


def read_squares(record: dict[str, Any], own: Point | None) -> Path | None:
    """The waypoints of all squares in their order."""
    prompt, parameters = str(record.get("prompt", "")), record.get("parameters")
    if (
        len(prompt) > LONGEST
        or not (TWO.search(prompt) or TWICE.search(prompt))
        or not w.SQUARE.search(prompt.replace("squares", "square"))
    ):
        return None
    text = without_fences(plain_text(prompt))
    places = [
        Place(g.point(x, y), start, end)
        for x, y, start, end in positions(text)
        if not w.SIZE.search(text[start:end])
    ]
    centres = {place.point for place in places} or ({own} if own else set())
    if len(centres) != 1 or UNCLEAR.search(text):
        return None
    sizes = list(dict.fromkeys(value for value, _start, _end in stated_sizes(text, places)))
    radius = parameters.get("radius") if isinstance(parameters, dict) else None
    if len(sizes) < 2 and not TWICE.search(text):
        return None
    radii = sizes if len(sizes) == 2 else sizes * 2 if len(sizes) == 1 else [radius, radius]
    cues = read_cues(_without_turns(text))
    if (
        len(radii) != 2
        or len(cues.starts) != 1
        or not all(isinstance(value, int | float) for value in radii)
    ):
        return None
    turns = [match[1] is None for match in w.CLOCKWISE.finditer(text)]
    if OTHER_WAY_ROUND.search(text):
        turns = [(turns or [False])[0], not (turns or [False])[0]]
    elif len(turns) < 2:
        turns = (turns or [False]) * 2
    if len(turns) != 2:
        return None
    (centre,) = centres
    return tuple(
        point
        for size, turn in zip(radii, turns, strict=True)
        for point in g.survey_square(centre, size, cues.starts[0], clockwise=turn)  # type: ignore[arg-type]
    )


def _without_turns(text: str) -> str:
    """A text whose squares are numbered, not where they begin."""
    return re.sub(
        r"\b(?:first|second|other|outer|inner)(?: (?:one|square|time|lap|round|circuit))?(?="
        r" (?:at|with|of|is|has|round|on|clockwise|counter\w*|anti\w*|"
        r"radius)|[:,;.]| \d)",
        " ",
        text,
        flags=re.IGNORECASE,
    )
