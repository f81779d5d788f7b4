"""Rows of stations and of lanes that are told by the first one, a distance and a number, and a line
that is run right over.

"Six stations, the first at [-50, 30], every next one 25 m farther east", "a waypoint every 25 m
from [0, 0] to [100, 0]", "four lanes 20 m apart, the first from [10, 10] to [10, 70], the others to
the east of it", "the net lies between [0, 0] and [0, 80]: over the top of it, south end first".
None else.
"""

from __future__ import annotations

import math
import re
from typing import Any

from planner_ft.data.task import geometry as g
from planner_ft.decoding.constraints.reading import LONGEST
from planner_ft.decoding.constraints.reading import wordings as w
from planner_ft.decoding.constraints.reading.paths import face_wordings as f
from planner_ft.decoding.constraints.reading.paths import run_wordings as r
from planner_ft.decoding.constraints.reading.paths.itinerary import (
    plain_text,
    reworded,
    without_fences,
)
from planner_ft.decoding.constraints.reading.paths.shapes import Point, stated_lengths

Path = tuple[Point, ...]
MOST = 40

_NUMBERS = {
    word: number
    for number, word in enumerate(
        [
            "two",
            "three",
            "four",
            "five",
            "six",
            "seven",
            "eight",
            "nine",
            "ten",
            "eleven",
            "twelve",
        ],
        2,
    )
}
_NUMBER = rf"(?P<count>{'|'.join(_NUMBERS)}|\d{{1,2}})"
_STATIONS = (
    r"(?:stations?|points|stops|way-?points|positions|samples|buoys|places|spots|marks|soundings)"
)
_WAY = r"(?:north[ -]?(?:east|west)|south[ -]?(?:east|west)|north|south|east|west)"
STATIONS = re.compile(rf"\b{_NUMBER} (?:[a-z-]+ ){{0,3}}?{_STATIONS}\b", re.IGNORECASE)
LEGS = re.compile(
    rf"\b{_NUMBER} (?:equal(?:ly long)?|even|equally long)"
    r" (?:legs|parts|steps|stages|hops|stretches|sections)\b",
    re.IGNORECASE,
)
EVENLY = re.compile(r"\b(?:even\w*|equal\w*|regular\w*|same distance|equidistant)\b", re.IGNORECASE)
ENDS_OUT = re.compile(
    r"\b(?:not (?:at|counting|including)|exclu\w+|without) (?:the )?(?:both |two"
    r" )?(?:ends?|start\w*|first)|\bbetween (?:them|the (?:two|ends))\b|"
    r"\bother than\b|"
    r"\bfirst (?:one |waypoint |stop |station )?(?:after|\d+ m)",
    re.IGNORECASE,
)
"""The ends are no stations, or may be none."""
STEP_BEHIND = re.compile(
    r"\s?(?:apart|steps?\b|intervals?|spacing|between"
    r" (?:them|each|the|one|two|stations|stops|points)|from"
    r" (?:the|one|each)|further|farther|on\b|away "
    r"from the (?:last|previous|one)|beyond|"
    rf"(?:due |to the |further |farther )*{_WAY}(?:wards?)? (?:of|from) (?:the|its|it))",
    re.IGNORECASE,
)
STEP_BEFORE = re.compile(
    r"\b(?:every|each|at intervals of|spaced|spacing(?: of| is)?|steps of|apart by|distance"
    r" of|following|next|each (?:next|following|further|other|one|"
    r"subsequent)(?: one)?|(?:the )?(?:others|rest)(?: follow)?"
    r"(?: each| at)?|(?:next|following|further|other|subsequent)"
    r" (?:one|station|point|stop|waypoint)s?)(?: (?:is|lies|are|lie|stands?|at|follows?|"
    r"comes?|being|another|a further))*\s*$",
    re.IGNORECASE,
)
IN_LINE = re.compile(
    rf"\b{_WAY}[ -](?:to[ -])?{_WAY}(?="
    rf" (?:line|row|transect|section))|\b(?:line|row|transect|section) (?:running )?{_WAY}["
    rf" -](?:to[ -])?{_WAY}\b",
    re.IGNORECASE,
)
"""A line by its two directions, which tell no order."""
TOLD_WAY = re.compile(
    rf"(?<![-–])\b(?P<way>{_WAY})(?:wards?|erly)?\b(?!["
    rf" -](?:side|face|edge|wall|quay|pier|camera|buoy|end|{_WAY}))",
    re.IGNORECASE,
)
FIRST_AT = re.compile(
    r"\b(?:first|one|begin\w*|start\w*|from|of|number one|no\.? ?1|station 1|station one)\b(?:"
    r" (?:one|station|point|stop|waypoint|of them|being|is|lies|"
    r"at|on|in|from|with|that|position))*[\s,:(]*$",
    re.IGNORECASE,
)
OTHERWISE = re.compile(
    r"\b(?:back|return\w*|home|base|(?<!one )(?<!station )(?<!stop )(?<!point"
    r" )before|but|if|unless|half|grid|square|zig-?zag|circle|ring|arc|radius|"
    r"instead|rather|sorry|scrap|not (?:the|at|to)|reverse\w*|twice|again|other way|last one first|"
    r"off (?:it|the)|parallel|abeam|beside|side|port|starboard|left|right|depth"
    r" of|drift\w*|(?:then|and) (?:go|run|head|proceed|move|steer|sail|steam)|"
    r"go (?:to|back)|turn\w*)\b",
    re.IGNORECASE,
)
LANES = re.compile(
    rf"\b{_NUMBER} (?:[a-z-]+"
    r" ){0,2}?(?:lanes|lines|legs|tracks|transects|runs|strips|passes|swaths?)\b",
    re.IGNORECASE,
)
FIRST_LANE = re.compile(
    r"\b(?:(?:lane|line|track|leg|run|transect|strip) (?:one|1|number one|no\.? 1)|(?:the"
    r" )?first(?: (?:one|lane|line|track|leg|run|transect|strip|of them))?)"
    r"(?: (?:goes|runs|is|lies|leads|being|of them|starts|the one|straight|up))*(?: from)? $",
    re.IGNORECASE,
)
TO_END = re.compile(
    r"[\s,]*(?:(?:straight|due|directly|up|down|to|and|ends?|at|on|goes|runs)"
    rf" )*?(?:{_WAY}(?:wards?)? )?(?:up to|down to|to|and ends at|through to|until) $",
    re.IGNORECASE,
)
OTHERS = re.compile(
    r"\b(?:others?|rest|next|following|remaining|second|each|every)\b[^.;§]{0,60}?\b(?:(?:to"
    r" the|towards the|further|farther|on its|on the|due|lie|"
    r"lies|step\w*|going|work\w*|in the|of) )?(?:its |the"
    r" )?(?P<way>north|south|east|west)(?:wards?|ern)?\b|"
    r"\bstep\w* (?:to the )?(?P<step>north|south|east|west)(?:wards?)?\b",
    re.IGNORECASE,
)
SAME_WAY = re.compile(
    r"\b(?:same (?:way|direction)|all (?:run )?(?:north|south|east|west)(?:bound|wards?)|each"
    r" (?:from|run) (?:the )?(?:north|south|east|west))\b",
    re.IGNORECASE,
)
OVER = re.compile(
    r"\b(?:right |straight |directly )?(?:over (?:the top of )?(?:it|them|the"
    r" (?:top|line|net|string|cable|pipe\w*|row))|along (?:it|the line)|(?:run|"
    r"steam|follow|trace|sail) (?:the|this|that) (?:line|string|row)|from end to end)\b",
    re.IGNORECASE,
)
LIES = re.compile(
    r"\b(?:between|from|goes|runs|lies|stretches|reaches|spans)\b[^.;§]{0,20}$", re.IGNORECASE
)
END_FIRST = re.compile(
    rf"\b(?P<one>{_WAY})(?:ern)?(?:most)? end (?:first|to"
    r" begin)|\b(?:from|start\w*|begin\w*|enter\w*)(?: (?:at|from|with|in|on))*(?: (?:the|its))? "
    rf"(?P<two>{_WAY})(?:ern)?(?:most)? end\b|"
    rf"\bfrom (?:the )?(?P<three>{_WAY})(?: end)? to (?:the )?{_WAY}\b|\b(?P<four>{_WAY})[ -]to["
    rf" -]{_WAY}\b|\b(?P<five>{_WAY})(?:ern)? end to (?:the )?{_WAY}",
    re.IGNORECASE,
)


def read_station_rows(record: dict[str, Any]) -> Path | None:
    """Every waypoint of the answer in order, where the input is such a row; None where it is not,
    or where something is not clear.
    """
    prompt = str(record.get("prompt", ""))
    text = reworded(without_fences(plain_text(prompt))) if len(prompt) <= LONGEST else None
    if not text:
        return None
    text = r.QUOTED.sub(lambda quoted: " " * len(quoted[0]), text)
    places = [match for match in r.EXPLICIT.finditer(text) if match["a"] or match["c"]]
    bare = text
    for place in places:
        bare = bare[: place.start()] + "§" * (place.end() - place.start()) + bare[place.end() :]
    if not 1 <= len(places) <= 2 or "§" not in bare:
        return None
    if len({_point(place) for place in places}) == 1:
        return _from_first(bare, places[0])
    return _lanes(bare, places) or _between(bare, places) or _over(bare, places)


def _number(match: re.Match[str]) -> int:
    said = match["count"].lower()
    return _NUMBERS.get(said) or int(said)


def _point(place: re.Match[str]) -> Point:
    return g.point(f.number(place["a"] or place["c"]), f.number(place["b"] or place["d"]))


def _steps(bare: str) -> tuple[set[float], bool]:
    """How far apart the stations are, and whether there is another length in the text."""
    steps, others = set(), False
    for value, start, end in stated_lengths(bare, []):
        if STEP_BEFORE.search(bare[:start]) or STEP_BEHIND.match(bare[end:]):
            steps.add(value)
        elif not w.OTHER_LENGTH.search(_clause(bare, start)):
            others = True
    return steps, others


def _clause(text: str, at: int) -> str:
    return re.split(r"[.;,]\s", text[:at])[-1] + re.split(r"[.;,](?:\s|$)", text[at:])[0]


def _bearing(bare: str) -> float | None:
    """The one direction that the text tells."""
    plain = IN_LINE.sub(" ", bare)
    found = {w.bearing_of(match["way"].lower()) for match in TOLD_WAY.finditer(plain)}
    found |= {float(match["deg"]) % 360 for match in f.BEARING.finditer(plain) if match["deg"]}
    return found.pop() if len(found) == 1 else None


def _from_first(bare: str, place: re.Match[str]) -> Path | None:
    """Stations from the first one on."""
    counts, (steps, others), bearing = list(STATIONS.finditer(bare)), _steps(bare), _bearing(bare)
    if len(counts) != 1 or len(steps) != 1 or others or bearing is None or OTHERWISE.search(bare):
        return None
    if not FIRST_AT.search(bare[: place.start()][-60:]) and not re.match(
        r"[\s,]*(?:is|being) the first", bare[place.end() :], re.IGNORECASE
    ):
        return None
    count, step = _number(counts[0]), steps.pop()
    return (
        tuple(g.offset(_point(place), bearing, step * index) for index in range(count))
        if 2 <= count <= MOST
        else None
    )


def _between(bare: str, places: list[re.Match[str]]) -> Path | None:
    """Stations from one place to another, by their distance or their number."""
    (steps, others), counts, legs = (
        _steps(bare),
        list(STATIONS.finditer(bare)),
        list(LEGS.finditer(bare)),
    )
    joined = re.fullmatch(
        r"[\s,]*(?:(?:up|on|over|across|straight) )*(?:to|and)\s+",
        bare[places[0].end() : places[1].start()],
        re.IGNORECASE,
    )
    led = re.search(
        r"\b(?:from|between|line|run|transect|section|leg|row|on)\W+(?:the \w+ at )?$",
        bare[: places[0].start()],
        re.IGNORECASE,
    )
    if not joined or not led or others or OTHERWISE.search(bare) or ENDS_OUT.search(bare):
        return None
    (x, y), (to_x, to_y) = map(_point, places)
    far = math.hypot(to_x - x, to_y - y)
    if len(steps) == 1 and not legs:
        parts = far / steps.pop()
        if abs(parts - round(parts)) > 0.001 or (counts and _number(counts[0]) != round(parts) + 1):
            return None
    elif len(legs) == 1 and not steps:
        parts = _number(legs[0])
    elif len(counts) == 1 and not steps and EVENLY.search(bare):
        parts = _number(counts[0]) - 1
    else:
        return None
    if not 1 < round(parts) < MOST:
        return None
    parts = round(parts)
    return tuple(
        g.point(x + (to_x - x) * index / parts, y + (to_y - y) * index / parts)
        for index in range(parts + 1)
    )


def _lanes(bare: str, places: list[re.Match[str]]) -> Path | None:
    """Lanes side by side, told by the first one."""
    counts, (steps, others) = list(LANES.finditer(bare)), _steps(bare)
    sides = {(match["way"] or match["step"]).lower() for match in OTHERS.finditer(bare)}
    if not FIRST_LANE.search(bare[: places[0].start()]) or not TO_END.fullmatch(
        bare[places[0].end() : places[1].start()]
    ):
        return None
    if not counts or len(steps) != 1 or others or len(sides) != 1 or SAME_WAY.search(bare):
        return None
    one, two = map(_point, places)
    side, step = w.bearing_of(sides.pop()), steps.pop()
    if (one[0] == two[0]) == (one[1] == two[1]) or (one[0] == two[0]) != (side in (90, 270)):
        return None
    path: list[Point] = []
    for index in range(_number(counts[0])):
        ends = [g.offset(end, side, step * index) for end in (one, two)]
        path += ends if index % 2 == 0 else ends[::-1]
    return tuple(path) if len(path) <= MOST else None


def _over(bare: str, places: list[re.Match[str]]) -> Path | None:
    """A line that is run from one of its ends to the other."""
    told = [
        next(way for way in match.groups() if way).lower() for match in END_FIRST.finditer(bare)
    ]
    joined = re.fullmatch(
        r"[\s,]*(?:up to|to|and)\s+", bare[places[0].end() : places[1].start()], re.IGNORECASE
    )
    if (
        not joined
        or not LIES.search(bare[: places[0].start()])
        or not OVER.search(bare)
        or len(set(told)) != 1
    ):
        return None
    if OTHERWISE.search(OVER.sub(" ", END_FIRST.sub(" ", bare))) or any(
        not w.OTHER_LENGTH.search(_clause(bare, start))
        for _value, start, _end in stated_lengths(bare, [])
    ):
        return None
    one, two = map(_point, places)
    bearing = math.radians(w.bearing_of(told[0]))
    ahead = (one[0] - two[0]) * math.sin(bearing) + (one[1] - two[1]) * math.cos(bearing)
    return None if abs(ahead) < 1 else (one, two) if ahead > 0 else (two, one)
