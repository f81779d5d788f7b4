"""Places that a text states by their ways off home ("0.35 km east and 1,200 ft south of home"),
written out as coordinates for the readers of waypoints.
"""

from __future__ import annotations

import itertools
import math
import re
from collections.abc import Iterator

from planner_ft.data.numerals import signed
from planner_ft.data.quantities import quantities
from planner_ft.data.stated import CABLE, CABLES
from planner_ft.data.task import geometry as g
from planner_ft.decoding.constraints.reading import wordings as w
from planner_ft.decoding.constraints.reading.paths.itinerary import plain_text
from planner_ft.decoding.constraints.reading.paths.shapes import Point

_WAY = r"(?:north[ -]?(?:east|west)|south[ -]?(?:east|west)|north|south|east|west)"
DIRECTED = re.compile(
    rf"\s?(?:(?:straight|directly|due|to the) )*({_WAY})(?:wards?)?\b(?!["
    r" -](?:north|south|east|west|side|face|end|of (?!home|base|the origin|it\b)))",
    re.IGNORECASE,
)
OF_HOME = re.compile(r" (?:of|from) (?:home|base|the origin)\b(?! (?:port|berth))", re.IGNORECASE)
OF_IT = re.compile(r" of it\b", re.IGNORECASE)
JOINED = re.compile(r",?\s*(?:and )?", re.IGNORECASE)


VERB_BEFORE = re.compile(
    r"\b(?:shift|go|move|head|run|sail|proceed|transit|steam|drive|out|over|her|boat|vessel|craft|vehicle|usv)\s$",
    re.IGNORECASE,
)
"""What needs a "to" before a place."""
THERE = re.compile(
    r"\b(?:is|lies|stands|sits)(?: at)? (?P<place>\([-\d., ]+\))(?P<mark>[:;,.]|,?"
    r" (?:and|so))(?P<go> (?:now |please )?(?:go|head|proceed|sail|run|"
    r"move|shift|steam|transit)) there\b",
    re.IGNORECASE,
)
"""A place that is described first and gone to then."""


_NUMBER = r"[-−–]?\d+(?:\.\d+)?"
REDUNDANT = re.compile(
    rf"(?P<one>[\[(]\s*(?P<a>{_NUMBER})\s*[,;/]\s*(?P<b>{_NUMBER})\s*[\])]),?"
    r" (?:(?:straight|directly|due|exactly|running|to the|and runs|then|up|down|out) )*"
    rf"(?P<way>{_WAY})(?:wards?|erly)? (?:(?:up|down|as far as|over|across|along it) )?to (?:the"
    r" (?:other )?end (?:at )?)?"
    rf"(?P<two>[\[(]\s*(?P<c>{_NUMBER})\s*[,;/]\s*(?P<d>{_NUMBER})\s*[\])])",
    re.IGNORECASE,
)
"""A line between two places with the direction in which it goes: "from [0, 0] due north to [0,
80]".
"""
SHORT = re.compile(r"\bbrg\b\.?", re.IGNORECASE)
CENTIMETRES = re.compile(r"\b(\d{3,6}) ?(?:cm|centimet(?:re|er)s)\b", re.IGNORECASE)
PARTS = {
    "half a": 0.5,
    "a": 1,
    "one": 1,
    "two": 2,
    "three": 3,
    "four": 4,
    "five": 5,
    "six": 6,
    "seven": 7,
    "eight": 8,
    "nine": 9,
    "ten": 10,
}
IN_CABLES = re.compile(
    rf"\b(?P<count>half a|a|one|two|three|four|five|six|seven|eight|nine|ten|\d+(?:\.\d+)?)"
    rf" cables?(?P<half> and a half)?"
    rf"(?= (?:(?:straight|directly|due|to the|further|farther) )*{_WAY}(?:wards?)?\b(?!"
    r" (?:side|face|end))| (?:on|along) (?:bearing |course |heading |a "
    rf")?(?:\d|{_WAY})| (?:wide|long|apart|across)\b)",
    re.IGNORECASE,
)
"""A length in cables, with a word for a length or a direction behind it."""
PLUS = re.compile(r"(?<=[\s,;(\[=/])\+(?=\d)")
"""The sign of a coordinate that needs none."""


def written_out(prompt: str, home: Point) -> str:
    """The prompt with coordinates for each place that is so many metres off home in one or two
    directions, behind the word that leads to it.
    """
    prompt = SHORT.sub("bearing", CENTIMETRES.sub(lambda said: f"{int(said[1]) / 100:g} m", prompt))
    prompt = REDUNDANT.sub(_between, IN_CABLES.sub(in_metres, PLUS.sub("", prompt)))
    return THERE.sub(r"\g<mark>\g<go> to \g<place>", _in_coordinates(prompt, home))


def in_metres(cables: re.Match[str]) -> str:
    """Cables (tenths of a nautical mile) as metres."""
    said = cables["count"].lower()
    count = PARTS[said] if said in PARTS else float(said)
    return f"{g.tidy((count + 0.5 * bool(cables['half'])) * CABLE):g} m"


def _between(ends: re.Match[str]) -> str:
    """Two ends of a line without the direction from one to the other, where it agrees with them."""
    (x, y), (to_x, to_y) = (
        (signed(ends[axis]) for axis in pair) for pair in (("a", "b"), ("c", "d"))
    )
    bearing = w.bearing_of(ends["way"])
    agrees = abs((math.degrees(math.atan2(to_x - x, to_y - y)) - bearing + 180) % 360 - 180) < 46
    return f"{ends['one']} to {ends['two']}" if agrees else ends[0]


def places_off_home(text: str, home: Point) -> list[Point]:
    """The places that a text states by their ways off home."""
    return (
        [point for _start, _end, point in _off_home(plain_text(text), home)]
        if OF_HOME.search(text)
        else []
    )


def _in_coordinates(prompt: str, home: Point) -> str:
    if not OF_HOME.search(prompt):
        return prompt
    text, pieces, done = plain_text(prompt), [], 0
    for start, end, point in _off_home(text, home):
        pieces += [
            text[done:start] + "to " * bool(VERB_BEFORE.search(text[:start])),
            f"({point[0]:g}, {point[1]:g})" if max(map(abs, point)) < 1e5 else text[start:end],
        ]
        done = end
    return "".join([*pieces, text[done:]]) if pieces else prompt


def _off_home(text: str, home: Point) -> Iterator[tuple[int, int, Point]]:
    """Where such places stand in a text, from where to where, and where they are."""
    ways = list(_ways(text))
    index = 0
    while index < len(ways):
        start, end, bearing, length = ways[index]
        of_home, following = (
            OF_HOME.match(text, end),
            (ways[index + 1] if index + 1 < len(ways) else None),
        )
        if following and (
            JOINED.fullmatch(text[end : following[0]])
            or (of_home and JOINED.fullmatch(text[of_home.end() : following[0]]))
        ):
            last = OF_IT.match(text, following[1]) if of_home else OF_HOME.match(text, following[1])
            if last and abs((bearing - following[2]) % 180 - 90) < 1:
                yield (
                    start,
                    last.end(),
                    g.offset(g.offset(home, bearing, length), following[2], following[3]),
                )
                index += 2
                continue
        if of_home and not any(
            JOINED.fullmatch(text[one[1] : start]) for one in itertools.islice(ways, index)
        ):
            yield start, of_home.end(), g.offset(home, bearing, length)
        index += 1


def _ways(text: str) -> Iterator[tuple[int, int, float, float]]:
    """Lengths with a unit and a direction behind them: start, end, bearing, metres."""
    for quantity in quantities(text):
        cables = CABLES.match(text, quantity.end) if quantity.unit is None else None
        length, end = (
            (quantity.value * CABLE, cables.end()) if cables else (quantity.value, quantity.end)
        )
        match = DIRECTED.match(text, end)
        if match and (cables or quantity.unit == "m") and length > 0:
            yield quantity.start, match.end(), w.bearing_of(match[1]), length
