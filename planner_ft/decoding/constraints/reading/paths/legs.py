"""Legs by bearing and length, one after the other: "runs 90 m on 330, bends there and runs another
60 m on 010".

They begin at a stated place, at the task's start, at home or where the vehicle lies; they are run
to their end, or from it, or back again, or home at last. None where the text has fewer than two
such legs or says anything else that could lead somewhere.
"""

from __future__ import annotations

import itertools
import re
from dataclasses import dataclass
from typing import Any

from planner_ft.data.task import geometry as g
from planner_ft.decoding.constraints.reading import LONGEST
from planner_ft.decoding.constraints.reading import wordings as w
from planner_ft.decoding.constraints.reading.paths import destination_wordings as d
from planner_ft.decoding.constraints.reading.paths import face_wordings as f
from planner_ft.decoding.constraints.reading.paths import run_wordings as r
from planner_ft.decoding.constraints.reading.paths.itinerary import (
    plain_text,
    reworded,
    without_fences,
)
from planner_ft.decoding.constraints.reading.paths.shapes import Point, stated_lengths, stated_sizes
from planner_ft.decoding.constraints.reading.paths.stations import LYING

Path = tuple[Point, ...]

_WAY = (
    r"(?:(?:north|south|east|west)[ -](?:north|south)[ -]?(?:east|west)|north["
    r" -]?(?:east|west)|south[ -]?(?:east|west)|north|south|east|west)"
)
_UNITS = (
    r"(?!\.?\d)(?!"
    r" ?(?:k?m\b|met|s\b|sec|min|%|kn|km|feet|foot|ft|yards?|yd|hours?|cables?|miles?|fathoms?|cm|,\d|waypoints?|points|legs|steps|times))"
)
BEARING = re.compile(
    rf"(?<![\d.,-])(?<![-−–])(?:(?P<deg>\d{{3}}|(?<=on )\d{{1,2}}|(?<=heading"
    rf" )\d{{1,2}}|(?<=bearing )\d{{1,2}}|(?<=course )\d{{1,2}}|"
    rf"(?<= of )\d{{1,2}}(?= ?(?:deg|°)))"
    rf"{_UNITS}(?: ?(?:degrees|deg\b|°))?|\b(?P<way>{_WAY})(?:wards?|erly)?\b(?!["
    r" -](?:side|face|edge|end|wall|corner|of\b|quay|lane|line|east|west)))",
    re.IGNORECASE,
)
NO_COURSE = re.compile(
    r"\b(?:fac\w+|bow(?: (?:is |stays )?(?:at|on|to))?|look\w*|yaw(?:"
    r" of)?|angle|sector|turn(?:ing)?(?: round)?(?: on the spot)?(?: on)?to|rotate to|"
    r"point\w*(?: (?:it|her|the bow))?(?: to(?:wards)?)?|wind(?: is)?(?: from)?(?: the)?|current(?:"
    r" sets)?(?: to)?(?: the)?|side|abeam)\s*$",
    re.IGNORECASE,
)
"""Before a bearing that nothing is run on."""
PAIRED = re.compile(
    r"[\s,:]*(?:(?:on|along|at|in|to|towards?|bearing|heading|course|direction|the|a|an|of|due|true|degrees|steer(?:ing)?|going|go|goes|run|runs|"
    r"running|long|straight|dead|more|"
    r"further|another|for|over|about|and|distance|length|it|from there|then|is|by|out|on the|in"
    r" one|line|leg|goes on|continue|follow|following|same)[\s,]*)*",
    re.IGNORECASE,
)
"""What may stand between the length of a leg and its bearing."""
TO_POINT = re.compile(r"\b(?:to|at|point|position)\s+$", re.IGNORECASE)
"""Before a way off that is a place: "to 50 m west, 20 m south"."""
LENGTH = re.compile(r"[\w.]+\s?(?:k?m|met(?:re|er)s?|yards?|feet|ft)\b", re.IGNORECASE)
FAR_END = re.compile(
    r"\b(?:(?:begin|start)\w* (?:from|at|with) (?:the|its) (?:far |other )?end|from (?:the|its)"
    r" (?:far|other) end|in reverse|backwards|(?:the )?(?:wrong|"
    r"other|opposite) way (?:a?round|about)|"
    r"from (?:the )?end to (?:the )?(?:start|beginning)|in (?:the )?(?:opposite|reverse)"
    r" (?:direction|order))\b",
    re.IGNORECASE,
)
BACK_ALONG = re.compile(
    r"\b(?:there and back|out and back|both ways|(?:and )?(?:then )?(?:come |go |run |follow it"
    r" )?back (?:again )?(?:the same way|along (?:it|"
    r"the same \w+|both legs|the \w+)|the way (?:you|she|it) came)|"
    r"retrac\w+ (?:it|(?:the|your|its|both) \w+)|and back again(?=[.,;]|$)|return(?:ing)? (?:by"
    r" )?the same way)(?: to (?:the |its )?(?:start|beginning))?\b",
    re.IGNORECASE,
)
BACK_STRAIGHT = re.compile(
    r"\b(?:(?:and|then|finally|from there),? )*(?:straight |direct\w* )?(?:go |come |run |head"
    r" |steam |return |sail )?(?:straight |direct\w* )?(?:back )?to "
    r"(?:(?:the|its|your) (?:start(?:ing)?|beginning)(?: point| position)?|where (?:you|it|she|the"
    r" \w+) (?:started|began|set out|starts|begins|lies?|lay|"
    r"are lying))\b",
    re.IGNORECASE,
)
HOME_LAST = re.compile(
    r"\b(?:(?:and|then|finally|from there|after that),?"
    r" )*(?:(?:go|come|run|head|sail|steam|return|straight|direct\w*|back|it['’]s) )+(?:to"
    r" )?(?:home|"
    r"base)\b(?: again)?|"
    r"(?:then|and) home\b(?: again)?",
    re.IGNORECASE,
)
FROM_HOME = re.compile(
    r"^\W*(?:\w+: )?(?:start\w* |leav\w+ |depart\w* |go |run |set out |steam )?(?:(?:at|from)"
    r" )?(?:home|base)\b|\b(?:from|leav\w+|start\w* (?:at|"
    r"from)) (?:home|base)\b",
    re.IGNORECASE,
)
FROM_START = re.compile(
    r"\b(?:from|at|leav\w+|to) (?:the|its)"
    r" (?:(?:given|planned|stated|cable|pipeline|track)(?:['’]s)? )?start(?:ing point| point|"
    r" position)?\b",
    re.IGNORECASE,
)
ALL_OF_IT = re.compile(
    r"\b(?:follow|track|trace|run|drive|sail|steam|survey|cover|do)(?:ing|s)? (?:it|the (?:\w+"
    r" )?(?:cable|pipe\w*|line|track|route)|both legs|"
    r"all (?:\w+ )?legs|along it|the whole \w+)"
    r"(?: (?:all the way|from end to end|from (?:its |the )?(?:start|beginning)|from one end to the"
    r" other|right|as (?:it lies|laid)))*(?: to (?:the|"
    r"its) (?:far )?end)?\b|\bto (?:the|its) (?:far )?end\b|"
    r"\b(?:bends?|turns?|alters?|changes?|kinks?|ends?|stops?)(?: course)?(?: there|"
    r" here)?\b|\b(?:dog[- ]?leg|follow\w*|legs?|two legs|three legs|course|"
    r"route|track|way-?points?)\b",
    re.IGNORECASE,
)
"""Words that add nothing to the legs."""
UNCLEAR = re.compile(
    r"\b(?:port|starboard|left|right|each|twice|times|repeat\w*|again|half|but|if|unless|instead|rather|sorry|scrap|before(?!"
    r" the bend)|after(?! (?:the|"
    r"that|this|which)\b)|or|abeam|parallel|beside|"
    r"off|zig-?zag|grid|square|lanes|reciprocal|opposite)\b",
    re.IGNORECASE,
)
"""Between the first leg and the last one: a leg that is told otherwise."""


@dataclass(frozen=True)
class _Leg:
    bearing: float
    length: float
    start: int
    end: int


CABLES = re.compile(
    r"\b(?:\d+|an?|half|two|three|four|five|six|seven|eight|nine|ten) cables?\b(?!"
    r" (?:runs?|starts?|lies|from))",
    re.IGNORECASE,
)
"""Lengths that are not read here."""


def read_legs(record: dict[str, Any], home: Point) -> Path | None:
    """Every waypoint of the answer in order, where the input is about such legs; None where it is
    not, or where something is not clear.
    """
    given, prompt = record.get("parameters"), str(record.get("prompt", ""))
    text = reworded(without_fences(plain_text(prompt))) if len(prompt) <= LONGEST else None
    if not text or CABLES.search(text):
        return None
    text = r.QUOTED.sub(lambda quoted: " " * len(quoted[0]), text)
    places = [match for match in r.EXPLICIT.finditer(text) if match["a"] or match["c"]]
    bare = text
    for place in places:
        bare = bare[: place.start()] + "§" * (place.end() - place.start()) + bare[place.end() :]
    if (
        len(places) == 2
        and FINISH_AT.search(bare[: places[1].start()])
        and _point(places[0]) == _point(places[1])
    ):
        # "... and finish at [3, 4]", where it began.
        begin = places[1].start() - len(FINISH_AT.search(bare[: places[1].start()])[0])  # type: ignore[index]
        bare, places = (
            bare[:begin] + " to the start".ljust(places[1].end() - begin) + bare[places[1].end() :],
            places[:1],
        )
    legs = paired_legs(bare)
    if not legs or any(
        TO_POINT.search(bare[: leg.start]) and LENGTH.match(bare[leg.start :]) for leg in legs
    ):
        return None
    own = given.get("start") if isinstance(given, dict) else None
    begun = _beginning(
        bare, places, legs, g.point(*own) if isinstance(own, list) and len(own) == 2 else None, home
    )
    if begun is None:
        return None
    start, walked, first = begun
    first -= len(re.split(r"[.;:,]\s", bare[:first])[-1])
    path = list(
        itertools.accumulate(
            legs, lambda at, leg: g.offset(at, leg.bearing, leg.length), initial=start
        )
    )
    rest = bare[:first] + " " * (legs[-1].end - first) + bare[legs[-1].end :]
    reverse, back, straight, homewards = (
        pattern.search(rest) for pattern in (FAR_END, BACK_ALONG, BACK_STRAIGHT, HOME_LAST)
    )
    for pattern in (FAR_END, BACK_ALONG, BACK_STRAIGHT, HOME_LAST, FROM_START):
        rest = pattern.sub(lambda match: " " * len(match[0]), rest)
    straight = None if reverse else straight
    if len(legs) < 2 and not reverse and not (back and walked):
        return None
    if (
        UNCLEAR.search(bare[first : legs[-1].end])
        or not _idle(rest, places, start)
        or sum(map(bool, (reverse, back, straight))) > 1
        or (reverse and not walked)
    ):
        return None
    if reverse:
        path.reverse()
    points = path if walked or reverse else path[1:]
    points = [*points, *path[-2::-1]] if back else [*points, path[0]] if straight else points
    return tuple([*points, home] if homewards and points[-1] != home else points)


def _point(place: re.Match[str]) -> Point:
    return g.point(f.number(place["a"] or place["c"]), f.number(place["b"] or place["d"]))


def paired_legs(bare: str) -> list[_Leg] | None:
    """The legs of a text, each made of the length and the bearing that stand together; None where
    they cannot be paired.
    """
    lengths = [
        (start, end, value, True)
        for value, start, end in stated_sizes(bare, [])
        if not f.OFF_BEHIND.match(bare[end:]) or r.WAY_BEHIND.match(bare[end:])
    ]
    bearings = [
        (
            match.start(),
            match.end(),
            float(match["deg"]) % 360 if match["deg"] else w.bearing_of(match["way"].lower()),
            False,
        )
        for match in BEARING.finditer(bare)
        if not NO_COURSE.search(bare[: match.start()])
        and not any(start <= match.start() < end for start, end, _value, _is_length in lengths)
    ]
    found = sorted([*lengths, *bearings])
    legs: list[_Leg] = []
    while found:
        (start, end, value, is_length), *found = found
        if not found or found[0][3] == is_length or not PAIRED.fullmatch(bare[end : found[0][0]]):
            # A length of something else, or a bearing that nothing is run on.
            if is_length and not w.OTHER_LENGTH.search(sentence_rest(bare, end)):
                return None
            if not is_length and legs and found:
                return None
            continue
        (_start, behind, other, _is_length), *found = found
        legs.append(
            _Leg(other if is_length else value, value if is_length else other, start, behind)
        )
    return legs


def sentence_rest(text: str, at: int) -> str:
    return re.split(r"[.;,]\s", text[:at])[-1] + re.split(r"[.;,](?:\s|$)", text[at:])[0]


def _beginning(
    bare: str, places: list[re.Match[str]], legs: list[_Leg], own: Point | None, home: Point
) -> tuple[Point, bool, int] | None:
    """Where the legs begin, whether that is a waypoint of its own, and where in the text it is
    said.
    """
    if len(places) > 1 or any(place.start() > legs[0].start for place in places):
        behind = [place for place in places if place.start() > legs[0].start]
        # "90 m on 330 from [3, 4]"
        if (
            len(places) != 1
            or len(legs) < 2
            or behind[0].start() > legs[1].start
            or not re.search(
                r"\bfrom\s+(?:the \w+ at )?$", bare[: behind[0].start()], re.IGNORECASE
            )
        ):
            return None
    if places:
        point = _point(places[0])
        lying = LYING.search(bare[: places[0].start()]) or WHERE_YOU_LIE.search(
            bare[: places[0].start()]
        )
        return point, not lying, min(places[0].start(), legs[0].start)
    at_home = FROM_HOME.search(bare[: legs[0].start])
    if at_home:
        return home, False, at_home.start()
    at_start = FROM_START.search(bare[: legs[0].start])
    return (own, True, at_start.start()) if own is not None and at_start else None


FINISH_AT = re.compile(
    r",?(?: (?:and|then|so|to|you|it))* (?:finish|end|stop|come|go|return|run|arrive|work|follow"
    r" it)\w*(?: (?:up|back|at|in|on|to|again))* $|"
    r" back (?:again )?to $",
    re.IGNORECASE,
)
"""Before the place where a run ends that began there, or that is run in reverse."""
WHERE_YOU_LIE = re.compile(
    r"\b(?:you|we|she|it|boat|vessel|craft|usv|vehicle) (?:are|is|lies?|sits?|waits?)(?: \w+){0,2}"
    r" (?:at|on)\s+$|\b(?:your|our|present|"
    r"current) (?:\w+ )?(?:position|place|spot)(?: is|,|:)?(?: at)?\s+$|"
    r"\b(?:lying|moored|waiting|anchored|stopped)(?: \w+)? at\s+$",
    re.IGNORECASE,
)
"""Before the place where the vehicle is already."""


def _idle(rest: str, places: list[re.Match[str]], start: Point) -> bool:
    """Whether what is left of the text leads nowhere."""
    plain = r.NO_MOVE.sub(" ", ALL_OF_IT.sub(" ", rest.replace("§", " ")))
    if (
        r.MOVE.search(plain)
        or r.ORDER.search(plain)
        or r.STOP.search(plain)
        or d.HOME.search(plain)
        or r.UNPLACED.search(rest)
    ):
        return False
    return all(
        w.OTHER_LENGTH.search(sentence_rest(rest, at))
        for _value, at, _end in stated_sizes(rest, [])
        for at in [at]
    ) and not any(r.WAY_BEHIND.match(rest[end:]) for _value, _at, end in stated_lengths(rest, []))
