"""Places that are stated by their offset from others: "40 m due east of [110, 65]"."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

from planner_ft.data.numerals import signed
from planner_ft.data.quantities import Quantity, bearings, quantities
from planner_ft.data.task import geometry as g

Point = tuple[float, float]
_WAY = r"(?:north[ -]?(?:east|west)|south[ -]?(?:east|west)|north|south|east|west)"
_DIRECTED = re.compile(
    rf"\s?(?:(?:straight|directly|due|to the|dead) ){{0,2}}({_WAY})(?:wards?)?\b", re.IGNORECASE
)
_JOINED = re.compile(r",?\s*(?:and )?", re.IGNORECASE)
_NUMBER = r"[-−–]?\d{1,7}(?:\.\d{1,4})?"
_OF_PLACE = re.compile(
    r" (?:of|from)(?P<thing> (?:the|that|our) [\w' -]{2,40}?,? (?:at|on|in|\())?\s?(?:point"
    rf" |position )?[\[(]\s*({_NUMBER})\s*[,;/]\s*({_NUMBER})\s*[\])]",
    re.IGNORECASE,
)


_OF_HOME = re.compile(r" (?:of|from) (?:home|base|the origin)\b(?! (?:port|berth))", re.IGNORECASE)


@dataclass(frozen=True)
class Offset:
    """A place that words from `start` to `end` tell from another, its `base`; `bare` where they
    name nothing that is there.
    """

    start: int
    end: int
    place: Point
    base: Point
    bare: bool


def read_offsets(text: str, home: Point | None = None) -> Iterator[Offset]:
    """The places that a text tells from stated ones, from `home` where it is given, by one way or
    two that cross.
    """
    ways = list(_ways(text))
    for index, (quantity, end, bearing) in enumerate(ways):
        match = _OF_PLACE.match(text, end)
        from_home = _OF_HOME.match(text, end) if home is not None else None
        if match:
            base = (signed(match[2]), signed(match[3]))
        elif from_home and home is not None:
            base = home
        else:
            continue
        place, start = g.offset(base, bearing, quantity.value), quantity.start
        before = ways[index - 1] if index else None
        if before and _JOINED.fullmatch(text[before[1] : quantity.start]):
            if abs((before[2] - bearing) % 180 - 90) > 1:
                continue
            place, start = g.offset(place, before[2], before[0].value), before[0].start
        behind = match or from_home
        assert behind is not None
        yield Offset(
            start,
            behind.end(),
            (round(place[0], 2), round(place[1], 2)),
            base,
            match is not None and match["thing"] is None,
        )


def _ways(text: str) -> Iterator[tuple[Quantity, int, float]]:
    """Lengths with a direction behind them: the length, where the direction ends, and its
    bearing.
    """
    for quantity in quantities(text):
        match = _DIRECTED.match(text, quantity.end)
        if match and quantity.unit == "m" and quantity.value > 0:
            yield quantity, match.end(), min(bearings(match[1]))
