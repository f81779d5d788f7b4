"""Places, legs and returns one after the other: "you are at [5, 5]: 40 m on 090, 30 m on 000, then
straight back to the point you left".

Legs are counted from the place before them, or from where the vehicle lies, which is no waypoint of
its own. A run can be retraced ("the same line back"), or half of it, or end where it began. None
where anything else in the text could lead somewhere.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from typing import Any, Literal

from planner_ft.data.quantities import positions
from planner_ft.data.task import geometry as g
from planner_ft.decoding.constraints.reading import LONGEST
from planner_ft.decoding.constraints.reading import wordings as w
from planner_ft.decoding.constraints.reading.paths import chain_wordings as c
from planner_ft.decoding.constraints.reading.paths import destination_wordings as d
from planner_ft.decoding.constraints.reading.paths import face_wordings as f
from planner_ft.decoding.constraints.reading.paths import legs as l
from planner_ft.decoding.constraints.reading.paths import run_wordings as r
from planner_ft.decoding.constraints.reading.paths.itinerary import (
    plain_text,
    reworded,
    without_fences,
)
from planner_ft.decoding.constraints.reading.paths.shapes import Point, stated_lengths, stated_sizes
from planner_ft.decoding.constraints.reading.paths.written_out import IN_CABLES, in_metres

Path = tuple[Point, ...]
Kind = Literal["place", "leg", "origin", "begin", "retrace", "half", "home"]
_RETURNS: tuple[tuple[re.Pattern[str], Kind], ...] = (
    (c.HALF, "half"),
    (c.BEGIN, "begin"),
    (c.RETRACE, "retrace"),
    (c.ORIGIN, "origin"),
    (c.STRAIGHT_BACK, "begin"),
    (l.HOME_LAST, "home"),
)
"""Words that lead back, those first that the later ones would take a part of."""


@dataclass(frozen=True)
class _Event:
    """Something that leads to a place, from `start` to `end` of the text; at the place of one that
    is `lying` the vehicle is.
    """

    start: int
    end: int
    kind: Kind
    point: Point | None = None
    leg: tuple[float, float] | None = None
    lying: bool = False


@dataclass
class _Way:
    """What was walked; `here` is where the vehicle is, `since` the corners of the legs since the
    last place, `between` the last two places in a row.
    """

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
            return len(self.since) == 2 and self._to(
                g.point((one[0] + two[0]) / 2, (one[1] + two[1]) / 2)
            )
        if event.kind == "retrace":
            gone = [self._to(point) for point in self.since[-2::-1]]
            return all(gone)
        return self._to(
            self.origin if event.kind == "origin" and self.origin is not None else self.since[0]
        )

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
    """Every waypoint of the answer in order, where the input is such a chain; None where it is not,
    or where something is not clear.
    """
    chain = _read(record, home)
    return chain[0] if chain else None


def chain_in_places(record: dict[str, Any], home: Point) -> str | None:
    """The text of such a chain with the place of each leg in its stead; None where a part of it
    leads to more than one place, or to none.
    """
    chain = _read(
        {**record, "prompt": IN_CABLES.sub(in_metres, str(record.get("prompt", "")))}, home
    )
    if chain is None:
        return None
    path, text, events = chain
    led = [event for event in events if not event.lying]
    if (
        len(led) != len(path)
        or any(event.lying and event.point != home for event in events)
        or all(event.kind == "place" for event in led)
    ):
        return None
    for event, (x, y) in reversed([*zip(led, path, strict=True)]):
        before = c.LEAD_IN.search(text[max(0, event.start - 60) : event.start])
        start = event.start - len(before[0]) if before else event.start
        stop = re.search(r"[.;:]\s[^.;:]*$", text[start : event.start])
        start += len(text[start : event.start]) - len(stop[0]) + 2 if stop else 0
        joined = (
            ", then " if text[:start].strip() and text[:start].rstrip()[-1] not in ".;:!" else " "
        )
        text = f"{text[:start].rstrip(' ,')}{joined}go to ({x:g}, {y:g}){text[event.end :]}"
    for event in events:
        text = (
            f"{text[: event.start]}{re.sub(r'^[ ,]*(?:then )?', '', text[event.end :])}"
            if event.lying
            else text
        )
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
    if any(
        match["e"]
        and (
            re.match(r"\s*:", text[match.end() :]) or not c.LEG_BEFORE.search(text[: match.start()])
        )
        for match in explicit
    ):
        return None
    bare = text
    for place in places:
        bare = bare[: place.start()] + "§" * (place.end() - place.start()) + bare[place.end() :]
    dropped = c.DROPPED.search(bare)
    bare = c.FROM_LAST.sub(_blank, c.DROPPED.sub(_blank, bare))
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


# ---------------------------------------------------------------- what leads somewhere


@dataclass
class _Rest:
    """What is left of a text while its events are taken out, with signs in their stead."""

    text: str
    events: list[_Event] = field(default_factory=list)

    def take(self, event: _Event) -> None:
        self.events.append(event)
        self.text = (
            self.text[: event.start] + "§" * (event.end - event.start) + self.text[event.end :]
        )


def _events(
    bare: str, places: list[re.Match[str]], start: Point | None, home: Point, dropped: int | None
) -> tuple[str, list[_Event]] | None:
    """The text without what leads somewhere, and that in its order; None where something leads
    nowhere that is known.
    """
    legs = l.paired_legs(bare)
    if (
        legs is None
        or any(
            c.PAIR_OF_WAYS.search(bare[: leg.start]) and l.LENGTH.match(bare[leg.start :])
            for leg in legs
        )
        or (dropped is not None and not legs)
    ):
        return None
    if dropped is not None:
        gone = [leg for leg in legs if leg.start < dropped][-1:]
        bare = bare[: gone[0].start] + " " * (gone[0].end - gone[0].start) + bare[gone[0].end :]
        legs = [leg for leg in legs if leg not in gone]
    events = [_Event(leg.start, leg.end, "leg", leg=(leg.bearing, leg.length)) for leg in legs]
    stated = _stated(bare, places, events, home)
    if stated is None:
        return None
    rest = _Rest(bare)
    for event in (*events, *stated):
        rest.take(event)
    rest.text = c.SCOPES.sub(_blank, rest.text)
    if not _take_returns(rest, several=len(legs) > 1):
        return None
    if start is not None and not places and (own := c.FROM_START.search(rest.text)):
        rest.take(_Event(own.start(), own.end(), "place", start))
    if (
        not legs
        and not any(event.lying for event in rest.events)
        and not _returns(bare, places, rest.events)
    ):
        return None
    return rest.text, sorted(rest.events, key=lambda event: event.start)


def _stated(
    bare: str, places: list[re.Match[str]], legs: list[_Event], home: Point
) -> list[_Event] | None:
    """The places that a text states, or home where legs begin there; None where one of them is not
    gone to, or where nothing tells where legs begin.
    """
    found = []
    for place in places:
        event = _place(bare, place, legs)
        if event is None:
            return None
        found.append(event)
        legs = [*legs, event]
    if sum(event.lying for event in found) > 1 or not (found or legs):
        return None
    at_home = None if found else l.FROM_HOME.search(bare[: legs[0].start])
    return [_Event(at_home.start(), at_home.end(), "place", home, lying=True)] if at_home else found


def _place(bare: str, place: re.Match[str], before_it: list[_Event]) -> _Event | None:
    """A place that is gone to, or where the vehicle lies; None where the words tell neither."""
    before, behind = bare[: place.start()], c.LYING_BEHIND.match(bare, place.end())
    begin = c.LYING.search(before[-80:])
    if (begin or behind) and not any(event.start < place.start() for event in before_it):
        first = place.start() - len(begin[0]) if begin else place.start()
        return _Event(
            first, behind.end() if behind else place.end(), "place", _point(place), lying=True
        )
    if c.NO_PLACE.search(_clause(before)) or not c.PLACE_LED.search(before[-70:]):
        return None
    if not d.TO_PLACE.search(before[-80:]) and c.LOOKED_AT.search(re.split(r"[.;]\s", before)[-1]):
        return None
    return _Event(place.start(), place.end(), "place", _point(place))


def _take_returns(rest: _Rest, *, several: bool) -> bool:
    """Take the words that lead back out of a text; False where it is not told how far, of `several`
    legs.
    """
    for pattern, kind in _RETURNS:
        # In the text as it was before the words of this kind are taken.
        for match in pattern.finditer(rest.text):
            rest.take(_Event(match.start(), _end_of_return(rest.text, match, kind), kind))
            if (
                pattern is c.STRAIGHT_BACK
                and several
                and "straight" not in match[0].lower()
                and "direct" not in match[0].lower()
            ):
                return False
    return True


def _end_of_return(text: str, match: re.Match[str], kind: Kind) -> int:
    """Where the words of a return end, with those that say by which way or to where."""
    along = c.ALONG_SAME.match(text, match.end())
    end = along.end() if along and kind in ("begin", "origin") else match.end()
    to_origin = c.ORIGIN.match(text, end + 1) if kind == "retrace" else None
    return to_origin.end() if to_origin else end


def _returns(bare: str, places: list[re.Match[str]], events: list[_Event]) -> bool:
    """Whether a way between two places is gone back as well."""
    back = any(event.kind in ("half", "begin", "retrace") for event in events)
    again = (
        len(places) == 3
        and _point(places[2]) == _point(places[0])
        and re.search(r"\bback (?:again )?to\s+$", bare[: places[2].start()], re.IGNORECASE)
    )
    return (len(places) == 2 and back) or bool(again)


def _clause(before: str) -> str:
    return re.split(r"[.;:,]\s", before)[-1]


def _point(place: re.Match[str]) -> Point:
    return g.point(f.number(place["a"] or place["c"]), f.number(place["b"] or place["d"]))


# ---------------------------------------------------------------- what is left


def _idle(rest: str, bare: str, events: list[_Event]) -> bool:
    """Whether what is left of the text leads nowhere."""
    leading = [event for event in events if event.kind != "home"]
    if not leading:
        return False
    for event in sorted(events, key=lambda event: -event.start):
        tail = c.ALONG_SAME.match(rest, event.end)
        if tail and event.kind == "place":
            rest = rest[: event.end] + " " * len(tail[0]) + rest[event.end + len(tail[0]) :]
        before = c.LEAD_IN.search(rest[max(0, event.start - 60) : event.start])
        if before:
            at = event.start - len(before[0])
            rest = rest[:at] + " " * len(before[0]) + rest[event.start :]
    plain = c.NOTHING.sub(" ", rest.replace("§", " "))
    spans = [(event.start, event.end) for event in events if event.kind == "leg"]
    sentences = {_sentence(bare, start) for start, _end in spans}
    within = " ".join(c.NOTHING.sub(" ", rest[start:end]) for start, end in sentences)
    if c.BETWEEN.search(within.replace("§", " ")):
        return False
    plain = r.NO_MOVE.sub(" ", l.ALL_OF_IT.sub(" ", plain))
    if (
        c.BESIDE.search(rest)
        or c.BARE_WAY.search(plain)
        or r.MOVE.search(plain)
        or r.ORDER.search(plain)
        or r.STOP.search(plain)
        or d.HOME.search(plain)
        or r.UNPLACED.search(rest)
    ):
        return False
    if any(
        re.match(r"\s?(?:further|farther|more)\b", rest[end:], re.IGNORECASE)
        for _value, _at, end in stated_lengths(rest, [])
    ):
        return False
    return all(
        w.OTHER_LENGTH.search(l.sentence_rest(rest, at))
        for _value, at, _end in stated_sizes(rest, [])
    ) and not any(r.WAY_BEHIND.match(rest[end:]) for _value, _at, end in stated_lengths(rest, []))


def _sentence(text: str, at: int) -> tuple[int, int]:
    """The sentence round a place of the text."""
    start = max((match.end() for match in re.finditer(r"[.;]\s", text[:at])), default=0)
    end = re.search(r"[.;](?:\s|$)", text[at:])
    return start, at + end.start() if end else len(text)
