"""The waypoints that a task input leaves no choice about, in order: grids, survey squares, stated
places and ways off.

What is not certain is not read: None says that the model chooses among the places that the facts
give (`waypoints`). Rules: lanes of a grid run along y from the south-west corner and a square
starts in the middle of its east side and goes counter-clockwise, unless the input says otherwise
(labelling rules of the task level).
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Sequence
from typing import Any

from planner_ft.data.quantities import COMPASS, SHORT, positions
from planner_ft.data.stated import radio_digits
from planner_ft.data.task import geometry as g
from planner_ft.decoding.constraints.reading import wordings as w
from planner_ft.decoding.constraints.reading.paths import run_wordings as r
from planner_ft.decoding.constraints.reading.paths.shapes import (
    Facts,
    Place,
    Point,
    Uncertain,
    grid_path,
    square_path,
    stated_sizes,
    stated_ways,
)
from planner_ft.vocabulary import Vocabulary

Path = tuple[Point, ...]
PLACED = re.compile(r"[\[(,;/=]|[xy]|east|west|north|south|minus|[-−]", re.IGNORECASE)
"""What two numbers that are a place have between or around them: "200 and 230" are headings as
well.
"""

NOT_BEFORE = re.compile(
    r",? (?:and )?not before(?: (?:that|it|then|this))?(?=[,.;]|$)", re.IGNORECASE
)
"""Words that only say since when something is done."""
WAY_BACK = re.compile(r"\bway back\b(?! home)", re.IGNORECASE)
BACK_TO = re.compile(
    r"\b(?:back|return\w*) (?:(?:as far as|up|down|only|over|out|on) )?(?:to )?(?:the [\w -]{1,20}"
    r" at )?[\[(]",
    re.IGNORECASE,
)
"""Back to a stated place, which the way back leads to."""
NO_MOVEMENT = re.compile(
    r"\b(?:mooring|moored)"
    r" (?:dolphins?|buoys?|posts?|lines?|blocks?|ropes?|chains?|rings?|bollards?|boats?|vessels?|yachts?|ships?|barges?)\b|"
    r"\bfollows (?:x|y|the line)\b|"
    r"\b(?:lidar|laser|scanner|scan)[ -]sweeps?\b|\b(?:at|with|under|on) (?:an? |the"
    r" )?(?:(?:scan|scanning|sweep|slice) )?angle(?: of)? "
    r"\d+(?:\.\d+)?(?: ?deg(?:rees)?\b| ?°)?|"
    r"\blook(?:s|ing)? for\b|\blook-?out\b|\bstands (?:on|at) [xy]\b|\bstand-?off\b|\bturning"
    r" points?\b|"
    r"\bsecond (?:leg|run|pass|lane|line|one|square|lap|round|way-?point|point)\b",
    re.IGNORECASE,
)
"""Words of other movements in other senses."""
FIRST_ONE = re.compile(r"\b(?:first|second|third|last|next|other|each|final) $", re.IGNORECASE)
"""Before a one that is no number: "six headings, the first one 030"."""

OWN_NAMED = re.compile(r"\b(?:target|goal|berth) (?:coordinates|position)\b", re.IGNORECASE)
"""The place of the task's own parameters."""


def read_itinerary(record: dict[str, Any], vocabulary: Vocabulary) -> Path | None:
    """Every waypoint of the answer in order, where the input leaves no choice; None where it
    does.
    """
    given = record.get("parameters")
    parameters = given if isinstance(given, dict) else {}
    text = reworded(without_fences(_without_marks(str(record.get("prompt", "")))))
    if text is None or w.UNORDERED.search(text) or w.UNSURE.search(text):
        return None
    parts = [part for part in w.PART.split(text) if part and part.strip()]
    facts = Facts(
        parameters,
        _own_place(parameters),
        g.point(*vocabulary.home),
        len(parts) == 1,
        _turned(text),
    )
    walked: list[Point] = []
    shaped: list[list[Point]] = []
    try:
        for part in _with_details(parts):
            found = _part(part, facts, walked)
            walked += found
            shaped += [found] if _shapes(part) else []
    except Uncertain:
        return None
    if facts.own and facts.own not in walked and OWN_NAMED.search(text):
        return None
    # "Mow the area after that, lanes north-south" speaks of one grid.
    if any(one == two for one, two in itertools.pairwise(shaped)):
        return None
    if (
        any(one == two for one, two in itertools.pairwise(walked))
        or g.point(*vocabulary.unresolved) in walked
    ):
        return None
    return tuple(walked) if walked and not unsettled(walked, text, facts.home) else None


def plain_text(prompt: str) -> str:
    """A prompt with its spoken digits and its thousands in figures."""
    return r.THOUSANDS.sub(
        lambda number: number[0].replace(",", ""), radio_digits(r.SPOKEN.sub(_figures, prompt))
    )


def _figures(spoken: re.Match[str]) -> str:
    """Three digits that were said one by one, as figures."""
    return "".join(
        str(
            r.DIGITS.index(
                word.lower().removesuffix("r") if word.lower() == "niner" else word.lower()
            )
        )
        for word in spoken.groups()
    )


def reworded(text: str) -> str | None:
    """A text without notes and without a way home that is ruled out, with places for names of
    places; None where the names cannot be told.
    """
    text = NOT_BEFORE.sub(_blanks, w.NOT_HOME.sub(_blanks, w.QUOTED.sub(_blanks, text)))
    text = w.THEN_IN.sub(
        r"\1 go in", w.TO_BASE.sub("return to base", w.IN_LETTERS.sub(_direction, text))
    )
    places = {match["name"]: match["place"] for match in w.NAMED_PLACE.finditer(text)}
    rest = w.NAMED_PLACE.sub(_blanks, text)
    said = re.findall(rf"\b[{''.join(places)}]\b", rest) if len(places) > 1 else []
    if not said:
        return text
    lists = [
        match
        for match in w.NAME_LIST.finditer(rest)
        if set(re.findall(r"\b[A-Z]\b", match[0])) == set(places)
    ]
    if len(lists) != 1 or len(re.findall(r"\b[A-Z]\b", lists[0][0])) != len(said):
        return None
    return (
        rest[: lists[0].start()].strip(" ,;.")
        + " "
        + re.sub(r"\b[A-Z]\b", lambda name: places[name[0]], lists[0][0])
        + rest[lists[0].end() :]
    )


def _blanks(match: re.Match[str]) -> str:
    return " " * len(match[0])


def _direction(match: re.Match[str]) -> str:
    """A length with its direction in words."""
    return f"{match[1]} {COMPASS[SHORT.index(match[2])]}" if match[2] in SHORT else match[0]


def unsettled(walked: Sequence[Point], text: str, home: Point) -> bool:
    """Whether a place may be visited twice only because the text says where something is done, or
    the way home is spoken of and not gone.
    """
    if home not in walked and w.WAY_HOME.search(
        WAY_BACK.sub(" ", text) if BACK_TO.search(text) else text
    ):
        return True
    return (
        len(set(walked)) < len(walked)
        and w.SCOPE_CUE.search(text) is not None
        and not w.COMING_BACK.search(text)
    )


def stays(record: dict[str, Any]) -> bool:
    """Whether a task input certainly sends the vehicle nowhere: it has no place outside of fences,
    no way off and no word of a run.
    """
    given = record.get("parameters")
    text = radio_digits(without_fences(_without_marks(str(record.get("prompt", "")))))
    led = (
        w.LEADS.search(w.NO_LEAD.sub(" ", text))
        or w.GOES.search(text)
        or _shapes(text)
        or w.SHAPED.search(text)
    )
    placed = any(PLACED.search(text[start:end]) for _x, _y, start, end in positions(text))
    own = _own_place(given if isinstance(given, dict) else {})
    return own is None and not led and not placed and not any(stated_ways(text, []))


def moves_otherwise(text: str) -> bool:
    """Whether a text may speak of a hold, a turn or another movement besides its waypoints."""
    return w.STILL.search(NO_MOVEMENT.sub(" ", w.LOCKED.sub(" ", text))) is not None


def _with_details(parts: list[str]) -> list[str]:
    """The parts, those that lead nowhere put to the one part with a shape: they may say where and
    which way round it is run.
    """
    shaped = [index for index, part in enumerate(parts) if _shapes(part)]
    if len(shaped) != 1:
        return parts
    idle = {index for index, part in enumerate(parts) if index not in shaped and not _leads(part)}
    whole = ". ".join(part for index, part in enumerate(parts) if index in idle or index in shaped)
    return [
        whole if index in shaped else part for index, part in enumerate(parts) if index not in idle
    ]


def _leads(part: str) -> bool:
    """Whether a part of the text may lead somewhere: it has a place that is no centre, or a word
    for a way.
    """
    stated = [part[:start] for _x, _y, start, _end in positions(part)]
    return (
        any(not w.CENTRE.search(before) for before in stated)
        or w.LEADS.search(w.NO_LEAD.sub(" ", part)) is not None
    )


def _shapes(text: str) -> list[re.Pattern[str]]:
    if w.SQUARE_RUN.search(text):
        return [w.SQUARE]
    return [shape for shape in (w.GRID, w.SQUARE) if shape.search(w.MENTIONS.sub(" ", text))]


def _without_marks(text: str) -> str:
    """A text with a semicolon in place of each number of a list."""
    return w.LIST_MARK.sub(
        lambda mark: mark[0] if _inside(text[: mark.start()]) else ";" + " " * (len(mark[0]) - 1),
        text,
    )


def _inside(before: str) -> bool:
    """Whether a bracket is open."""
    return before.count("(") > before.count(")") or before.count("[") > before.count("]")


def _turned(text: str) -> float | None:
    found = [
        float(match[1]) if match[1] else w.bearing_of(match[2]) for match in w.TURNED.finditer(text)
    ]
    return found[0] if len(found) == 1 else None


def without_fences(text: str) -> str:
    """A text with blanks for the corners of boundaries: pairs in a row behind a word for one."""
    for row in itertools.chain(w.ROW.finditer(text), w.BOX.finditer(text)):
        if w.FENCE.search(text[: row.start()]) or (
            not w.BOX.fullmatch(row[0]) and w.FENCE_BEHIND.match(text[row.end() :])
        ):
            text = text[: row.start()] + " " * len(row[0]) + text[row.end() :]
    return text


def _own_place(parameters: dict[str, Any]) -> Point | None:
    """The one place among the task's parameters."""
    own = [
        value
        for value in parameters.values()
        if isinstance(value, list)
        and len(value) == 2
        and all(isinstance(item, int | float) for item in value)
    ]
    return g.point(*own[0]) if len(own) == 1 else None


def _part(text: str, facts: Facts, walked: list[Point]) -> list[Point]:
    """The waypoints of one part of the text."""
    places = [
        Place(g.point(x, y), start, end)
        for x, y, start, end in positions(text)
        if not _angles(text, start, end)
        and _is_place(text[start:end])
        and not w.COUNTS.search(text[:start])
    ]
    shapes = _shapes(text)
    if any(one.end > two.start for one, two in itertools.pairwise(places)):
        raise Uncertain
    if len(shapes) > 1 or (w.OTHER_SHAPE if shapes else w.SHAPED).search(text):
        raise Uncertain
    if shapes:
        read = grid_path if shapes == [w.GRID] else square_path
        return read(text, places, facts)
    return _legs(text, places, facts, walked)


def _angles(text: str, start: int, end: int) -> bool:
    """Whether two numbers are headings."""
    bare = (
        w.BARE_PAIR.fullmatch(text[start:end])
        and not w.TO_BEFORE.search(text[:start])
        and text[max(0, start - 1) : start] not in ("[", "(", "-", "−", "–")
    )
    if text[start : start + 4].lower() == "one " and FIRST_ONE.search(text[:start]):
        return True
    return w.ANGLED.search(text[start : end + 8]) is not None or bool(
        bare and w.TURNING.search(text)
    )


def _is_place(text: str) -> bool:
    """Whether two numbers with what stands between them are no size and no time."""
    if w.FAR.search(text):
        raise Uncertain
    return w.COMPASS.search(text) is not None or not w.SIZE.search(text)


def _legs(text: str, places: list[Place], facts: Facts, walked: list[Point]) -> list[Point]:
    """Stated places, home and ways off, in the order of the text."""
    events: list[tuple[int, Point | None, tuple[float, float] | None]] = []
    used: set[int] = set()
    ways = list(stated_ways(text, places))
    if (
        places
        and not ways
        and all(place.point in walked for place in places)
        and not w.LEADS.search(w.NO_LEAD.sub(" ", w.SCOPE.sub(" ", text)))
    ):
        rest = _blank(text, places)
        if w.SCOPE_CUE.search(rest):
            return []
        if re.search(r"[a-z]{5}", rest):
            raise Uncertain
    for length, bearing, start, end, of in ways:
        base, at = _base(text, end, places, facts) if of else (None, None)
        used |= {at} if at is not None else set()
        events.append((start, base, (bearing, length)))
    for place in places:
        if place.start not in used:
            before = text[: place.start].rstrip("-−–")
            if w.NO_DESTINATION.search(before) or w.CENTRE.search(before):
                raise Uncertain
            events.append((place.start, place.point, None))
    named = [
        match
        for match in w.TO_OWN.finditer(text)
        if not any(start <= match.start() < end for _l, _b, start, end, _o in ways)
    ]
    if any("start" in match[0].lower() and "start" not in facts.parameters for match in named):
        raise Uncertain
    if w.OWN_OPENS.match(text) and not named:
        raise Uncertain
    if (walked or places) and not ways and any(match[0].lower() == "go in" for match in named):
        raise Uncertain
    owns = [match.start() for match in named]
    homes = [match.start() for match in w.HOME.finditer(text)]
    events += [(at, facts.own, None) for at in owns] + [(at, facts.home, None) for at in homes]
    line = _line(text, places, facts, ways)
    events += line
    left = [
        start
        for _value, start, _end in stated_sizes(text, places)
        if not line and start not in {way[2] for way in ways}
    ]
    if left and (events or w.FURTHER.search(text)) and not w.OTHER_LENGTH.search(text):
        raise Uncertain
    if w.BACK_ALONE.search(_blank(text, [], w.HOME)):
        raise Uncertain
    if (
        (not events and w.LEADS.search(w.NO_LEAD.sub(" ", text)))
        or w.UNREAD.search(_blank(text, places, w.HOME))
        or (owns and facts.own is None)
    ):
        raise Uncertain
    return _follow(sorted(events, key=lambda event: event[0]), walked)


def _blank(text: str, places: list[Place], *patterns: re.Pattern[str]) -> str:
    """A text without its places and what the patterns match."""
    for place in places:
        text = text[: place.start] + " " * (place.end - place.start) + text[place.end :]
    for pattern in patterns:
        text = pattern.sub(" ", text)
    return text


def _line(
    text: str, places: list[Place], facts: Facts, ways: list[Any]
) -> list[tuple[int, None, tuple[float, float]]]:
    """A straight run whose direction and length stand apart: "along 45 degrees for 40 m", "the
    distance of the task on 090".
    """
    if ways or not w.LINE.search(text):
        return []
    lengths = {value: start for value, start, _end in stated_sizes(text, places)} | _own_number(
        w.OWN_LENGTH, text, facts, ("max_dist", "length")
    )
    bare = _blank(text, places)
    directions = {
        float(match[1]): match.start() for match in w.ON_DEGREES.finditer(bare)
    } | _own_number(w.OWN_HEADING, text, facts, ("heading",))
    directions |= {w.bearing_of(match[1]): match.start() for match in w.ON_WAY.finditer(text)}
    if facts.turned is not None and (that := w.THAT_BEARING.search(text)):
        directions[facts.turned] = that.start()
    if not w.OWN_LENGTH.search(text) and (
        not lengths or (w.NO_LINE.search(text) and not directions)
    ):
        return []
    if len(lengths) != 1 or len(directions) != 1 or w.NO_LINE.search(text):
        raise Uncertain
    (length, first), (direction, second) = *lengths.items(), *directions.items()
    if any(place.start > max(first, second) for place in places):
        raise Uncertain
    return [(max(first, second), None, (direction, length))]


def _own_number(
    wording: re.Pattern[str], text: str, facts: Facts, names: tuple[str, ...]
) -> dict[float, int]:
    """The task's own value that the text refers to, with where it does."""
    value = next(
        (
            facts.parameters[name]
            for name in names
            if isinstance(facts.parameters.get(name), int | float)
        ),
        None,
    )
    match = wording.search(text)
    return {value: match.start()} if match and value is not None else {}


def _base(text: str, end: int, places: list[Place], facts: Facts) -> tuple[Point, int | None]:
    """What a way off is counted from, and where that place stands in the text."""
    for place in places:
        if place.start >= end and not re.search(r"\w", text[end : place.start]):
            return place.point, place.start
    if facts.own is not None and w.OWN.match(text[end:]):
        return facts.own, None
    raise Uncertain


def _follow(
    events: list[tuple[int, Point | None, tuple[float, float] | None]], walked: list[Point]
) -> list[Point]:
    found: list[Point] = []
    for _at, point, way in events:
        if point is None and not (found or walked):
            raise Uncertain
        base = point or (found or walked)[-1]
        found.append(g.offset(base, *way) if way else base)
    return found
