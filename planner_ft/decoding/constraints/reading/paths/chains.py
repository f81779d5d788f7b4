"""Places, legs and returns one after the other: "you are at [5, 5]: 40 m on 090, 30 m on 000, then straight back to the point you left".

Legs are counted from the place before them, or from where the vehicle lies, which is no waypoint of its own. A run can be retraced ("the same line back"), or
half of it, or end where it began. None where anything else in the text could lead somewhere.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from typing import Any, Literal

from planner_ft.data.quantities import positions
from planner_ft.data.task import geometry as g
from planner_ft.decoding.constraints.reading import LONGEST
from planner_ft.decoding.constraints.reading import wordings as w
from planner_ft.decoding.constraints.reading.paths import face_wordings as f
from planner_ft.decoding.constraints.reading.paths import legs as l
from planner_ft.decoding.constraints.reading.paths import run_wordings as r
from planner_ft.decoding.constraints.reading.paths.itinerary import plain_text, reworded, without_fences
from planner_ft.decoding.constraints.reading.paths.shapes import Point, stated_lengths, stated_sizes
from planner_ft.decoding.constraints.reading.paths.written_out import IN_CABLES, in_metres

Path = tuple[Point, ...]
Kind = Literal["place", "leg", "origin", "begin", "retrace", "half", "home"]

_SELF = r"(?:you|u|we|she|he|it|the (?:boat|vessel|craft|usv|vehicle|ship))"
_ARE = r"(?:['’]re| are| r|['’]s| is| lies?| lay| sits?| waits?| float\w*| stands?| starts?)"
LYING = re.compile(
    rf"\b{_SELF}{_ARE}(?: (?:already|now|currently|lying|stopped|at rest|waiting|sitting|moored|anchored|still|berthed|off|there|right|made fast))*,? "
    rf"(?:at|on|in)\s+$|"
    r"\b(?:your|our|her|the|its) (?:(?:present|current|own|starting) )*(?:position|place|spot|berth|mooring|anchorage|jetty|slip|pontoon)(?: is| being|"
    r",|:)?(?: (?:now|here))?"
    r"(?: at)?[,:]?\s+$|"
    rf"\bwhere {_SELF}{_ARE}(?: (?:now|already|lying|moored))*(?: at|,|:|,? (?:that|which) is)*\s+$|"
    r"\b(?:lying|moored|anchored|berthed)(?: \w+)? at\s+$|\bfrom (?:here|where you are)(?:,| at| \()*\s*$",
    re.IGNORECASE,
)
"""Before the place where the vehicle lies."""
LYING_BEHIND = re.compile(
    rf"[\s,(–-]*(?:which is |that is |that'?s |being |i\.?e\.? )?(?:(?:the place |the point |the spot |the berth |right |just )?where {_SELF}{_ARE}|"
    rf"{_SELF}{_ARE} (?:already |now |lying |right )*"
    r"(?:there|here)|(?:your|our|the|her) (?:present|current|own) (?:position|place|spot|berth|mooring))(?: (?:now|already|at the moment|lying|moored|"
    r"at present|right now))*[,)–-]*",
    re.IGNORECASE,
)
"""Behind it."""
PLACE_LED = re.compile(
    r"(?:^|[.,;:]|\b(?:to|at|via|from|through|reach|reaching|visit|leave|leaves|leaving|first|then|datum|start|begin|end|finish|on|onto|is|for|and|"
    r"position|point|past|as far as)\b)[\s,:]*"
    r"(?:(?:the|its|a|an|your|her) )?(?:(?:[\w'’-]+ ){0,5}?(?:at|to|is|,)\s*)?$",
    re.IGNORECASE,
)
"""Before a place that is gone to."""
NO_PLACE = re.compile(
    r"\b(?:of|off|around|round|about|between|near|by|past|towards?|facing|relative to|not|from (?:the|any|all|every) [\w -]+|clear of|away from|until|"
    r"when|once|after|before|while|between|beyond|till|behind)"
    r"(?: [\w'’-]+){0,3}\s*$",
    re.IGNORECASE,
)
"""Before a place that is told for something else."""
_GO = r"(?:go|goes|come|comes|run|runs|head|steam|sail|return|proceed|get|make|motor|drive|make your way|turn(?: round| around)?|be|finish|end)"
ORIGIN = re.compile(
    rf"\b(?:(?:and|then|finally|from there|straight|direct|directly|right|turn(?: round| around)?|{_GO}|bring (?:it|her)|back|all the way|"
    rf"up)[\s,]+)*(?:back to|to|at|for|by returning to)\s+(?:"
    r"(?:the |its |your |her |that |this |our )?(?:very |same )?(?:start(?!ing to\b)(?:ing)?|beginning|origin|departure|first|place of departure)(?:[ "
    r"-](?:point|position|place|spot|waypoint|corner|of the (?:first )?(?:leg|run)))*\b(?! (?:of|end|leg|run|the|at|on|recording|logging))|"
    r"(?:the|that|this|its|your|her|our) (?:very |same |old |own )*(?:place|spot|berth|mooring|anchorage|slip)\b(?! (?:at|of|where|that|which|you|"
    r"you['’]\w+|she|it)\b)|"
    rf"(?:the )?(?:point|place|spot|position|berth|one|waypoint)?\s?(?:where |that |which |from which |from where )?{_SELF} (?:(?:have |had |first "
    rf")?(?:started|began|begun|set out|set off|left|came|departed|lay)|starts?|begins?|lies?|are lying|are now|are|is|leave|left|set out)(?: (?:from|"
    rf"off|out|at|now))?)",
    re.IGNORECASE,
)
"""Back to where the whole began."""
STRAIGHT_BACK = re.compile(
    rf"(?:\b(?:and|then|finally|from there|turn(?: round| around)?)\b[\s,]*)+(?:{_GO} )?(?:(?:straight|right|direct(?:ly)?|all the way) )+back(?: "
    rf"again)?(?=\s*(?:[.,;:]|$))|"
    rf"\b(?:and|then)\b[\s,]*(?:{_GO} )?(?:straight |right |direct(?:ly)? )*back(?: again)?(?=\s*(?:[.;:]|$))|\b{_GO} (?:straight |right |directly "
    rf")*back(?: again)?(?=\s*(?:[.;:]|$))",
    re.IGNORECASE,
)
"""Back, without a word of where to: read where there is one leg."""
BEGIN = re.compile(
    rf"\b(?:(?:and|then|finally|from there|straight|direct|directly|right|{_GO}|back|turn(?: round| around)?|all the way)[\s,]+)*to (?:where|the "
    rf"(?:point|place|spot) where|the (?:start|beginning) of) "
    r"(?:the |that |this |your )?(?:run|leg|line|pass|track|transect|tow|first leg|last leg)\b(?: (?:began|begins|started|starts|begun|set out))?",
    re.IGNORECASE,
)
"""Back to where a run began."""
_LINE = r"(?:the |that |this )?(?:very )?(?:same|own) (?:line|way|track|path|route|leg|course|run|transect|legs)"
RETRACE = re.compile(
    rf"\b(?:(?:and|then|finally|from there|straight|direct|directly|right|turn(?: round| around)?|{_GO})[\s,]+)*(?:{_LINE} (?:straight )?back(?: again)?|"
    rf"(?:back|return\w*)(?: again)? (?:by |along |on |over |down |up |in )?{_LINE}|back (?:again )?(?:along|over|down|on|up) (?:it|the (?:line|leg|"
    rf"track|run|cable|pipe\w*))|"
    rf"(?:retrac\w+|revers\w+) (?:it|that|(?:the|this|that|your|both|its) (?:\w+ )?(?:legs?|run|line|track|way|course|steps?|route))|"
    rf"(?:back )?the way {_SELF} (?:came|went)|there and back|out and back|and back again)(?: back)?\b",
    re.IGNORECASE,
)
ALONG_SAME = re.compile(rf"[\s,]*(?:(?:by|along|on|over|in) )?{_LINE}\b", re.IGNORECASE)
"""Behind a return to a place."""
HALF = re.compile(
    rf"\b(?:(?:and|then|finally|from there|straight|turn(?: round| around)?|{_GO})[\s,]+)*(?:(?:half (?:of )?(?:that|it|the (?:way|distance|length|leg|"
    rf"run))|half-?way) (?:straight )?back(?: again)?(?: (?:along|on|over) {_LINE}|"
    rf" (?:along|on) it)?|back (?:again )?(?:(?:along|on|over|by|down) (?:{_LINE}|it|the (?:line|leg|track|run))(?: for)?,? )?(?:for )?(?:half (?:of "
    rf")?(?:that|it|the (?:way|distance|length|leg|run))|half-?way)"
    rf"(?: (?:along|on|over) {_LINE})?)\b",
    re.IGNORECASE,
)
"""Back along the last leg, half of it."""
DROPPED = re.compile(
    r"[.,;]?\s*(?:(?:actual?ly|no|wait|and|but|on second thoughts?|please|sorry),?\s+)*(?:drop|skip|forget|leave out|cancel|scrap|omit) the (?:last|"
    r"final) (?:one|leg)\b(?:,? the tide is turning| of (?:them|these|the legs))?",
    re.IGNORECASE,
)
FROM_START = re.compile(
    r"\b(?:go |run |head |proceed |steam |from|at|leav\w+|first |begin\w* |start\w* )*(?:from|at|to|leaving|leave|reach) (?:the|its) (?:(?:given|"
    r"planned|stated|cable|pipe|pipeline|track)(?:['’]s)? )*start(?:ing)?(?:[ -](?:point|position))?"
    r"(?: of (?:the|its) (?:cable|pipe\w*|track|line|run))?(?: first)?\b(?! (?:at|is|of)\b)(?!,? ?(?:§|\())",
    re.IGNORECASE,
)
"""The task's own start as the place to go to."""
FROM_LAST = re.compile(r" from (?:it|there|the (?:second|third|fourth|last|previous)(?: (?:one|point|corner|way-?point))?)(?=[.,;])", re.IGNORECASE)
"""Behind a leg: what it is counted from in any case."""
SCOPES = re.compile(
    r"\b(?:"
    r"(?:while |when |on |during |in )?(?:going|getting|running|coming|moving) (?:out |over )?(?:to|towards) (?:the |its )?(?:start\w*|beginning|first|"
    r"it|there)(?: (?:point|position|place|waypoint))?|"
    r"(?:the )?(?:run|way|leg|transit|passage|trip|approach)(?: out| over| up| in)? (?:to|towards) (?:(?:the |its )?(?:start\w*|beginning|first)(?: "
    r"(?:point|position|waypoint))?|it|there))\b",
    re.IGNORECASE,
)
"""Words for the way to the start, which say where something is done."""
NOTHING = re.compile(
    r"\b(?:expanding square(?: search)?|box search|triang\w+|dog[- ]?leg|"
    r"(?:(?:two|three|four|five|six|[2-6]) )?(?:straight )?(?:legs?|runs?|lines?)(?: (?:one|two|three|four|five|[1-6]))?(?= ?[:,(]| (?:from|is|of|on|"
    r"to)\b|\s*(?:\d|$))|"
    r"(?:first|second|third|fourth|fifth|next|last|final) (?:leg|run|line)\b(?=[:,. ]| is)|(?:start(?:ing)?|first)[ -]?(?:point|position|corner)?[\s:,]*(?=§)|"
    r"(?:so |and )?(?:go|head|proceed|run|get) there(?: first)?(?=[.,;]| and\b)|"
    r"(?:not|nor|never) (?:before|after|until|on the (?:way|run) (?:there|out))(?: (?:it|that|this|then|them))?|"
    r"(?:on|for|during|in) (?:that|this|the|these|those|each|all|every|both) (?:\w+ )?(?:run|leg|line|way|pass)s?\b(?: (?:out|back|home|only|alone))?|"
    r"from the (?:start|starting|first) (?:point |place )?on(?:wards?)?|(?:first|second|third|last|next|other) (?:leg|run|corner|one)|with (?:that|the "
    r"\w+) (?:leg|run) done)\b",
    re.IGNORECASE,
)
"""Words that add nothing to what was read."""
LEAD_IN = re.compile(
    r"(?:\b(?:then|and|next|now|finally|go|goes|run|runs|running|steam|steer|sail|head|proceed|continue|carry|move|moves|shift|drive|motor|make|do|"
    r"follow|following|track|take|take it|in|get|onto|"
    r"from|that|this|there|point|place|here|to|at|on|along|out|straight|another|further|a|an|the|it|leg|line|first|via|for|over|up|down|with|of|by|"
    r"cross|set|your|her|way|due|on to|"
    r"leave|leaves|leaving|start|starts|starting|begin|begins|beginning|stop|return|back|come|pick|cable|pipe|pipeline|is|are|you|she|we|trawl|retrace|"
    r"turn|round)\b[\s,:;]*)+$",
    re.IGNORECASE,
)
BETWEEN = re.compile(
    r"\b(?:port|starboard|left|right|each|twice|times|repeat\w*|half|but|if|unless|instead|rather|sorry|or|abeam|parallel|beside|zig-?zag|grid|square|"
    r"lanes|reciprocal|opposite|every|"
    r"alternat\w*|spaced|apart|arc|circle|orbit|(?:do|does)? ?not (?:go|run|return)|midpoint|middle)\b",
    re.IGNORECASE,
)
"""In a sentence with a leg: it may be told otherwise."""


BESIDE = re.compile(
    r"\b(?:to|on|off|along) (?:the|its|your) (?:right|left|port|starboard|(?:north|south|east|west)(?:[ -]?(?:east|west))?(?:ern)?) (?:of|side|hand|"
    r"face)\b|\boff (?:it|the)\b|"
    r"\b(?:parallel|abeam|beside|alongside|shifted|displaced|offset|stand-?off|mirror\w*)\b",
    re.IGNORECASE,
)
"""Words of a run that does not go where it is told, but beside it."""
PAIR_OF_WAYS = re.compile(r"\b(?:for|towards|at|to|position|point|is|over to)\s+$", re.IGNORECASE)
LEG_BEFORE = re.compile(
    r"(?:[\])\d]|\b(?:legs?|then|square|search|there|run|steam|north|south|east|west|home|on|follow\w*|point|from it|where|box))[\s,:;.]*(?:and |then |"
    r"first |go |run |steam )*(?=$)",
    re.IGNORECASE,
)
"""Before legs in two directions, which might be the coordinates of a place."""
BARE_WAY = re.compile(r"\d(?: more| further)? (?:due |to the )?(?:north|south|east|west)\b", re.IGNORECASE)
"""A leg without a unit."""
LOOKED_AT = re.compile(
    r"\b(?:point(?:s|ing)?(?= (?:the (?:bow|camera|lens|nose)|it\b|her\b|at\b|to\b|towards))|bow|fac(?:e|es|ing)|look\w*|aim\w*|nose|camera|turn\w*|"
    r"lens|bearing)\b",
    re.IGNORECASE,
)
"""In a clause with a place that is only looked at."""


@dataclass(frozen=True)
class _Event:
    start: int
    end: int
    kind: Kind
    point: Point | None = None
    leg: tuple[float, float] | None = None
    lying: bool = False


@dataclass
class _Way:
    """What was walked; `here` is where the vehicle is, `since` the corners of the legs since the last place, `between` the last two places in a row."""

    home: Point
    path: list[Point] = field(default_factory=list)
    here: Point | None = None
    origin: Point | None = None
    since: list[Point] = field(default_factory=list)
    between: list[Point] = field(default_factory=list)
    places: int = 0

    def go(self, event: _Event) -> bool:
        """Walk to where an event leads; False where that is not clear."""
        if event.kind == "place" and event.point is not None:
            return self._to_place(event.point, lying=event.lying)
        if event.kind == "home":
            return self._to(self.home)
        if self.here is None:
            return False
        if event.kind == "leg" and event.leg is not None:
            self.since = self.since or [self.here]
            self.path.append(g.offset(self.here, *event.leg))
            self.here = self.path[-1]
            self.since.append(self.here)
            return True
        if not self.since:
            self.since = self.between
        if len(self.since) < 2 or (event.kind == "origin" and self.places > 1):
            return False
        if event.kind == "half":
            one, two = self.since[-2:]
            return len(self.since) == 2 and self._to(g.point((one[0] + two[0]) / 2, (one[1] + two[1]) / 2))
        if event.kind == "retrace":
            gone = [self._to(point) for point in self.since[-2::-1]]
            return all(gone)
        return self._to(self.origin if event.kind == "origin" and self.origin is not None else self.since[0])

    def _to_place(self, point: Point, *, lying: bool) -> bool:
        if lying:
            self.here = self.origin = point
            return not self.path
        self.places += point not in self.path and point != self.origin
        self.origin = point if self.origin is None else self.origin
        self.between = [] if self.since or self.here is None else [self.here, point]
        self.since = []
        return self._to(point)

    def _to(self, point: Point) -> bool:
        if self.here == point and self.path:
            return False
        self.path.append(point)
        self.here = point
        return True


def read_chain(record: dict[str, Any], home: Point) -> Path | None:
    """Every waypoint of the answer in order, where the input is such a chain; None where it is not, or where something is not clear."""
    chain = _read(record, home)
    return chain[0] if chain else None


def chain_in_places(record: dict[str, Any], home: Point) -> str | None:
    """The text of such a chain with the place of each leg in its stead; None where a part of it leads to more than one place, or to none."""
    chain = _read({**record, "prompt": IN_CABLES.sub(in_metres, str(record.get("prompt", "")))}, home)
    if chain is None:
        return None
    path, text, events = chain
    led = [event for event in events if not event.lying]
    if len(led) != len(path) or any(event.lying and event.point != home for event in events) or all(event.kind == "place" for event in led):
        return None
    for event, (x, y) in reversed([*zip(led, path, strict=True)]):
        before = LEAD_IN.search(text[max(0, event.start - 60) : event.start])
        start = event.start - len(before[0]) if before else event.start
        stop = re.search(r"[.;:]\s[^.;:]*$", text[start : event.start])
        start += len(text[start : event.start]) - len(stop[0]) + 2 if stop else 0
        joined = ", then " if text[:start].strip() and text[:start].rstrip()[-1] not in ".;:!" else " "
        text = f"{text[:start].rstrip(' ,')}{joined}go to ({x:g}, {y:g}){text[event.end :]}"
    for event in events:
        text = f"{text[: event.start]}{re.sub(r'^[ ,]*(?:then )?', '', text[event.end :])}" if event.lying else text
    return text.strip()


def _read(record: dict[str, Any], home: Point) -> tuple[Path, str, list[_Event]] | None:
    """The waypoints of a chain, its text and what leads from one to the next."""
    given, prompt = record.get("parameters"), str(record.get("prompt", ""))
    text = reworded(without_fences(plain_text(prompt))) if len(prompt) <= LONGEST else None
    if not text or l.CABLES.search(text):
        return None
    text = r.QUOTED.sub(_blank, text)
    explicit = list(r.EXPLICIT.finditer(text))
    places = [match for match in explicit if match["a"] or match["c"]]
    if any(match["e"] and (re.match(r"\s*:", text[match.end() :]) or not LEG_BEFORE.search(text[: match.start()])) for match in explicit):
        return None
    bare = text
    for place in places:
        bare = bare[: place.start()] + "§" * (place.end() - place.start()) + bare[place.end() :]
    dropped = DROPPED.search(bare)
    bare = FROM_LAST.sub(_blank, DROPPED.sub(_blank, bare))
    if any(_apart(bare, pair) for pair in positions(bare)):
        return None
    own = given.get("start") if isinstance(given, dict) else None
    start = g.point(*own) if isinstance(own, list) and len(own) == 2 else None
    found = _events(bare, places, start, home, dropped.start() if dropped else None)
    if not found:
        return None
    rest, events = found
    if not _idle(rest, bare, events):
        return None
    way = _Way(home)
    if not all(way.go(event) for event in events):
        return None
    return (tuple(way.path), text, events) if way.path else None


def _blank(match: re.Match[str]) -> str:
    return " " * len(match[0])


def _apart(bare: str, pair: tuple[float, float, int, int]) -> bool:
    """Whether two numbers may be a place that was not read."""
    said = bare[pair[2] : pair[3]]
    return re.search(r"[/=xy]|minus", said) is not None and not w.SIZE.search(said)


def _events(bare: str, places: list[re.Match[str]], start: Point | None, home: Point, dropped: int | None) -> tuple[str, list[_Event]] | None:
    """The text without what leads somewhere, and that in its order; None where something leads nowhere that is known."""
    legs = l.paired_legs(bare)
    if legs is None or any(PAIR_OF_WAYS.search(bare[: leg.start]) and l.LENGTH.match(bare[leg.start :]) for leg in legs) or (dropped is not None and not legs):
        return None
    if dropped is not None:
        gone = [leg for leg in legs if leg.start < dropped][-1:]
        bare = bare[: gone[0].start] + " " * (gone[0].end - gone[0].start) + bare[gone[0].end :]
        legs = [leg for leg in legs if leg not in gone]
    rest, events = bare, [_Event(leg.start, leg.end, "leg", leg=(leg.bearing, leg.length)) for leg in legs]
    lying = 0
    for place in places:
        before, behind = bare[: place.start()], LYING_BEHIND.match(bare, place.end())
        is_lying = bool(LYING.search(before[-80:]) or behind) and not events_before(events, place.start())
        begin = LYING.search(before[-80:])
        first = place.start() - len(begin[0]) if begin and is_lying else place.start()
        if not is_lying and (NO_PLACE.search(_clause(before)) or not PLACE_LED.search(before[-70:])):
            return None
        if not is_lying and not r.TO_PLACE.search(before[-80:]) and LOOKED_AT.search(re.split(r"[.;]\s", before)[-1]):
            return None
        lying += is_lying
        events.append(_Event(first, behind.end() if behind and is_lying else place.end(), "place", _point(place), lying=is_lying))
    if lying > 1:
        return None
    if not any(event.kind == "place" for event in events):
        if not legs:
            return None
        at_home = l.FROM_HOME.search(bare[: legs[0].start])
        if at_home:
            events.append(_Event(at_home.start(), at_home.end(), "place", home, lying=True))
    for event in events:
        rest = rest[: event.start] + "§" * (event.end - event.start) + rest[event.end :]
    rest = SCOPES.sub(_blank, rest)
    for pattern, kind in ((HALF, "half"), (BEGIN, "begin"), (RETRACE, "retrace"), (ORIGIN, "origin"), (STRAIGHT_BACK, "begin"), (l.HOME_LAST, "home")):
        for match in pattern.finditer(rest):
            along = ALONG_SAME.match(rest, match.end())
            end = along.end() if along and kind in ("begin", "origin") else match.end()
            to_origin = ORIGIN.match(rest, end + 1) if kind == "retrace" else None
            end = to_origin.end() if to_origin else end
            events.append(_Event(match.start(), end, kind))  # type: ignore[arg-type]
            rest = rest[: match.start()] + "§" * (end - match.start()) + rest[end:]
            if pattern is STRAIGHT_BACK and len(legs) > 1 and "straight" not in match[0].lower() and "direct" not in match[0].lower():
                return None
    if start is not None and not places and (own := FROM_START.search(rest)):
        events.append(_Event(own.start(), own.end(), "place", start))
        rest = rest[: own.start()] + "§" * len(own[0]) + rest[own.end() :]
    if not legs and not lying and not _returns(bare, places, events):
        return None
    return rest, sorted(events, key=lambda event: event.start)


def _returns(bare: str, places: list[re.Match[str]], events: list[_Event]) -> bool:
    """Whether a way between two places is gone back as well."""
    back = any(event.kind in ("half", "begin", "retrace") for event in events)
    again = len(places) == 3 and _point(places[2]) == _point(places[0]) and re.search(r"\bback (?:again )?to\s+$", bare[: places[2].start()], re.IGNORECASE)
    return (len(places) == 2 and back) or bool(again)


def events_before(events: list[_Event], at: int) -> bool:
    """Whether a leg stands before a place of the text."""
    return any(event.start < at for event in events)


def _clause(before: str) -> str:
    return re.split(r"[.;:,]\s", before)[-1]


def _point(place: re.Match[str]) -> Point:
    return g.point(f.number(place["a"] or place["c"]), f.number(place["b"] or place["d"]))


def _idle(rest: str, bare: str, events: list[_Event]) -> bool:
    """Whether what is left of the text leads nowhere."""
    leading = [event for event in events if event.kind != "home"]
    if not leading:
        return False
    for event in sorted(events, key=lambda event: -event.start):
        tail = ALONG_SAME.match(rest, event.end)
        if tail and event.kind == "place":
            rest = rest[: event.end] + " " * len(tail[0]) + rest[event.end + len(tail[0]) :]
        before = LEAD_IN.search(rest[max(0, event.start - 60) : event.start])
        if before:
            at = event.start - len(before[0])
            rest = rest[:at] + " " * len(before[0]) + rest[event.start :]
    plain = NOTHING.sub(" ", rest.replace("§", " "))
    spans = [(event.start, event.end) for event in events if event.kind == "leg"]
    sentences = {_sentence(bare, start) for start, _end in spans}
    within = " ".join(NOTHING.sub(" ", rest[start:end]) for start, end in sentences)
    if BETWEEN.search(within.replace("§", " ")):
        return False
    plain = r.NO_MOVE.sub(" ", l.ALL_OF_IT.sub(" ", plain))
    if (
        BESIDE.search(rest)
        or BARE_WAY.search(plain)
        or r.MOVE.search(plain)
        or r.ORDER.search(plain)
        or r.STOP.search(plain)
        or r.HOME.search(plain)
        or r.UNPLACED.search(rest)
    ):
        return False
    if any(re.match(r"\s?(?:further|farther|more)\b", rest[end:], re.IGNORECASE) for _value, _at, end in stated_lengths(rest, [])):
        return False
    return all(w.OTHER_LENGTH.search(l.sentence_rest(rest, at)) for _value, at, _end in stated_sizes(rest, [])) and not any(
        r.WAY_BEHIND.match(rest[end:]) for _value, _at, end in stated_lengths(rest, [])
    )


def _sentence(text: str, at: int) -> tuple[int, int]:
    """The sentence round a place of the text."""
    start = max((match.end() for match in re.finditer(r"[.;]\s", text[:at])), default=0)
    end = re.search(r"[.;](?:\s|$)", text[at:])
    return start, at + end.start() if end else len(text)
