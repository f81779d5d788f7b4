"""The waypoints that a task input leaves no choice about, in order: grids, survey squares, stated places and ways off.

What is not certain is not read: None says that the model chooses among the places that the facts give (`waypoints`). Rules: lanes of a
grid run along y from the south-west corner and a square starts in the middle of its east side and goes counter-clockwise, unless the
input says otherwise (labelling rules of the task level).
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from planner_ft.data.quantities import positions, quantities
from planner_ft.data.task import geometry as g
from planner_ft.decoding.constraints import wordings as w
from planner_ft.vocabulary import Vocabulary

Point = g.Point
Path = tuple[Point, ...]


class _Uncertain(Exception):
    """Something in the text could send the vehicle somewhere, and it is not clear where."""


@dataclass(frozen=True)
class _Place:
    """A place that a text mentions, from `start` to `end`."""

    point: Point
    start: int
    end: int


@dataclass(frozen=True)
class _Facts:
    """What the whole input gives to each of its parts: the task's parameters, its own place, home, and the one bearing that it turns to."""

    parameters: dict[str, Any]
    own: Point | None
    home: Point
    only_part: bool
    turned: float | None


def read_itinerary(record: dict[str, Any], vocabulary: Vocabulary) -> Path | None:
    """Every waypoint of the answer in order, where the input leaves no choice; None where it does."""
    given = record.get("parameters")
    parameters = given if isinstance(given, dict) else {}
    text = without_fences(_without_marks(str(record.get("prompt", ""))))
    if w.UNORDERED.search(text):
        return None
    parts = [part for part in w.PART.split(text) if part and part.strip()]
    facts = _Facts(parameters, _own_place(parameters), g.point(*vocabulary.home), len(parts) == 1, _turned(text))
    walked: list[Point] = []
    try:
        for part in _with_details(parts):
            walked += _part(part, facts, walked)
    except _Uncertain:
        return None
    if any(one == two for one, two in itertools.pairwise(walked)) or g.point(*vocabulary.unresolved) in walked:
        return None
    return tuple(walked) or None


def moves_otherwise(text: str) -> bool:
    """Whether a text may speak of a hold, a turn or another movement besides its waypoints."""
    return w.STILL.search(w.LOCKED.sub(" ", text)) is not None


def _with_details(parts: list[str]) -> list[str]:
    """The parts, those that lead nowhere put to the one part with a shape: they may say where and which way round it is run."""
    shaped = [index for index, part in enumerate(parts) if _shapes(part)]
    if len(shaped) != 1:
        return parts
    idle = {index for index, part in enumerate(parts) if index not in shaped and not positions(part) and not w.LEADS.search(w.NO_LEAD.sub(" ", part))}
    whole = ". ".join(part for index, part in enumerate(parts) if index in idle or index in shaped)
    return [whole if index in shaped else part for index, part in enumerate(parts) if index not in idle]


def _shapes(text: str) -> list[re.Pattern[str]]:
    if w.SQUARE_RUN.search(text):
        return [w.SQUARE]
    return [shape for shape in (w.GRID, w.SQUARE) if shape.search(w.MENTIONS.sub(" ", text))]


def _without_marks(text: str) -> str:
    """A text with a semicolon in place of each number of a list."""
    return w.LIST_MARK.sub(lambda mark: mark[0] if _inside(text[: mark.start()]) else ";" + " " * (len(mark[0]) - 1), text)


def _inside(before: str) -> bool:
    """Whether a bracket is open."""
    return before.count("(") > before.count(")") or before.count("[") > before.count("]")


def _turned(text: str) -> float | None:
    found = [float(match[1]) if match[1] else w.bearing_of(match[2]) for match in w.TURNED.finditer(text)]
    return found[0] if len(found) == 1 else None


def without_fences(text: str) -> str:
    """A text with blanks for the corners of boundaries: pairs in a row behind a word for one."""
    for row in itertools.chain(w.ROW.finditer(text), w.BOX.finditer(text)):
        if w.FENCE.search(text[: row.start()]):
            text = text[: row.start()] + " " * len(row[0]) + text[row.end() :]
    return text


def _own_place(parameters: dict[str, Any]) -> Point | None:
    """The one place among the task's parameters."""
    own = [value for value in parameters.values() if isinstance(value, list) and len(value) == 2 and all(isinstance(item, int | float) for item in value)]
    return g.point(*own[0]) if len(own) == 1 else None


def _part(text: str, facts: _Facts, walked: list[Point]) -> list[Point]:
    """The waypoints of one part of the text."""
    places = [_Place(g.point(x, y), start, end) for x, y, start, end in positions(text) if _is_place(text[start:end]) and not w.COUNTS.search(text[:start])]
    shapes = _shapes(text)
    if any(one.end > two.start for one, two in itertools.pairwise(places)):
        raise _Uncertain
    if len(shapes) > 1 or (w.OTHER_SHAPE if shapes else w.SHAPED).search(text):
        raise _Uncertain
    if shapes:
        read = _grid if shapes == [w.GRID] else _square
        return read(text, places, facts)
    return _legs(text, places, facts, walked)


def _is_place(text: str) -> bool:
    """Whether two numbers with what stands between them are no size and no time."""
    if w.FAR.search(text):
        raise _Uncertain
    return w.COMPASS.search(text) is not None or not w.SIZE.search(text)


def _lengths(text: str, places: list[_Place]) -> list[tuple[float, int, int]]:
    """Lengths in metres that the text states outside its places, with where they stand."""
    return [
        (g.tidy(quantity.value), quantity.start, quantity.end)
        for quantity in quantities(text)
        if quantity.unit == "m" and quantity.value > 0 and not any(place.start <= quantity.start < place.end for place in places)
    ]


def _sizes_said(text: str, places: list[_Place]) -> list[tuple[float, int, int]]:
    """The lengths that are no margins, accuracies and distances kept."""
    return [found for found in _lengths(text, places) if not _is_margin(text, found[1], found[2])]


def _is_margin(text: str, start: int, end: int) -> bool:
    before, behind = w.CLAUSE.split(text[:start])[-1], w.CLAUSE.split(text[end:])[0]
    return w.MARGIN.search(before[-30:]) is not None or w.MARGIN.search(behind[:30]) is not None


def _centre(text: str, places: list[_Place], facts: _Facts) -> Point:
    """The centre of the one shape in a part that leads nowhere else."""
    if len(places) > 1 or w.LEADS.search(w.NO_LEAD.sub(" ", text)) or any(_ways(text, places)):
        raise _Uncertain
    if places:
        if w.AT_CORNER.search(text[: places[0].start]):
            raise _Uncertain
        return places[0].point
    if facts.own is None:
        raise _Uncertain
    return facts.own


def _grid(text: str, places: list[_Place], facts: _Facts) -> list[Point]:
    centre = _centre(text, places, facts)
    width, length, spacing = _sizes(text, places, facts)
    along, corner = _along(text), _grid_corner(text)
    lanes = g.lane_count(width if along == "y" else length, spacing) if spacing > 0 else None
    if lanes is None or not 2 <= lanes <= w.MOST_LANES:
        raise _Uncertain
    return g.lawnmower(centre, width, length, spacing, corner, along)


def _sizes(text: str, places: list[_Place], facts: _Facts) -> tuple[float, float, float]:
    """Width, length and spacing: those of the text, else the task's own; each length of the text must be one of them."""
    said: dict[str, float] = {}
    rest = _sizes_said(text, places)
    for name, value, used in _named_sizes(text, rest):
        if said.setdefault(name, value) != value:
            raise _Uncertain
        rest = [found for found in rest if found[1] not in used]
    sizes = [said.get(name, facts.parameters.get(name)) for name in ("width", "length", "spacing")]
    if not all(isinstance(size, int | float) for size in sizes) or any(value not in sizes for value, _start, _end in rest):
        raise _Uncertain
    return sizes[0], sizes[1], sizes[2]  # type: ignore[return-value]


def _named_sizes(text: str, lengths: list[tuple[float, int, int]]) -> Iterator[tuple[str, float, set[int]]]:
    """(name, value, places in the text) of the sizes that a text names."""
    for value, start, end in lengths:
        before, behind = text[:start], text[end:]
        if w.IS_SPACING_BEHIND.match(behind) or w.IS_SPACING_BEFORE.search(before):
            yield "spacing", value, {start}
        elif w.IS_WIDTH.match(behind):
            yield "width", value, {start}
        elif w.IS_LENGTH.match(behind):
            yield "length", value, {start}
    spans = sorted((quantity.start, quantity.end, quantity.said) for quantity in quantities(text))
    for (start, end, first), (following, _end, second) in itertools.pairwise(spans):
        if w.BY.fullmatch(text[end:following]) or w.BY.fullmatch(re.sub(r"^\s?k?m\b|^\s?met(?:re|er)s?\b", "", text[end:following])):
            values = [value for value, at, _end in lengths if at in (start, following)]
            if len(values) == 2:
                yield "width", values[0], {start}
                yield "length", values[1], {following}
            elif len(values) == 1 and g.tidy(second) == values[0]:
                yield "width", g.tidy(first), {start}
                yield "length", values[0], {following}


def _along(text: str) -> g.Axis:
    x, y = w.LANES_X.search(text), w.LANES_Y.search(text)
    if x and y:
        raise _Uncertain
    return "x" if x else "y"


def _grid_corner(text: str) -> g.Corner:
    """The corner that a grid starts at."""
    plain = w.LANES_Y.sub(" ", w.LANES_X.sub(" ", text))
    named = {_named_corner(match) for match in w.CORNER.finditer(plain)}
    rest = w.STEP.sub(" ", w.CORNER.sub(" ", plain))
    steps = [match[1].lower() for match in w.STEP.finditer(plain)]
    if len(named) > 1 or w.COMPASS.search(rest) or (not named and (steps or w.BEGINS.search(rest))):
        raise _Uncertain
    corner = named.pop() if named else "south-west"
    if any(step in corner for step in steps):
        raise _Uncertain
    return corner


def _named_corner(match: re.Match[str]) -> g.Corner:
    south, west = (match[3][0], match[3][1]) if match[3] else (match[1], match[2])
    return next(corner for corner in g.CORNERS if corner.startswith(south[0].lower()) and corner.split("-")[1].startswith(west[0].lower()))


def _square(text: str, places: list[_Place], facts: _Facts) -> list[Point]:
    centre = _centre(text, places, facts)
    turns = {match[1] is None for match in w.CLOCKWISE.finditer(text)}
    if (w.NO_SQUARE.search(text) and not w.EIGHT.search(text)) or len(turns) > 1:
        raise _Uncertain
    return g.survey_square(centre, _radius(text, places, facts), _square_start(text), clockwise=True in turns)


def _radius(text: str, places: list[_Place], facts: _Facts) -> float:
    said = {value for value, _start, _end in _sizes_said(text, places)}
    own = facts.parameters.get("radius")
    if isinstance(own, int | float) and (said == {own} or (not said and (facts.only_part or w.OWN_SIZE.search(text)) and not _lengths(text, places))):
        return own
    if len(said) != 1 or len(_lengths(text, places)) > 1:
        raise _Uncertain
    return said.pop()


def _square_start(text: str) -> str:
    corners = {str(_named_corner(match)) for match in w.CORNER.finditer(text)}
    plain = w.CORNER.sub(" ", text)
    sides = {re.sub(r"ern$", "", match[1] or match[2]).lower() for match in w.SIDE.finditer(plain)}
    named = corners | sides
    if len(named) > 1 or w.COMPASS.search(w.SIDE.sub(" ", plain)) or (not named and w.BEGINS.search(plain)):
        raise _Uncertain
    return named.pop() if named else "east"


def _ways(text: str, places: list[_Place]) -> Iterator[tuple[float, float, int, int, bool]]:
    """Lengths with a compass direction behind them: length, bearing, start, end, and whether it is "north of" something."""
    for value, start, end in _lengths(text, places):
        match = w.WAY_BEHIND.match(text[end:])
        if match:
            yield value, w.bearing_of(match[1]), start, end + match.end(), match[2] is not None


def _legs(text: str, places: list[_Place], facts: _Facts, walked: list[Point]) -> list[Point]:
    """Stated places, home and ways off, in the order of the text."""
    events: list[tuple[int, Point | None, tuple[float, float] | None]] = []
    used: set[int] = set()
    ways = list(_ways(text, places))
    for length, bearing, start, end, of in ways:
        base, at = _base(text, end, places, facts) if of else (None, None)
        used |= {at} if at is not None else set()
        events.append((start, base, (bearing, length)))
    for place in places:
        if place.start not in used:
            if w.NO_DESTINATION.search(text[: place.start]):
                raise _Uncertain
            events.append((place.start, place.point, None))
    named = [match for match in w.TO_OWN.finditer(text) if not any(start <= match.start() < end for _l, _b, start, end, _o in ways)]
    if any("start" in match[0].lower() and "start" not in facts.parameters for match in named):
        raise _Uncertain
    if (walked or places) and not ways and any(match[0].lower() == "go in" for match in named):
        raise _Uncertain
    owns = [match.start() for match in named]
    homes = [match.start() for match in w.HOME.finditer(text)]
    events += [(at, facts.own, None) for at in owns] + [(at, facts.home, None) for at in homes]
    events += _line(text, places, facts, ways)
    if (not events and w.LEADS.search(w.NO_LEAD.sub(" ", text))) or w.UNREAD.search(_blank(text, places, w.HOME)) or (owns and facts.own is None):
        raise _Uncertain
    return _follow(sorted(events, key=lambda event: event[0]), walked)


def _blank(text: str, places: list[_Place], *patterns: re.Pattern[str]) -> str:
    """A text without its places and what the patterns match."""
    for place in places:
        text = text[: place.start] + " " * (place.end - place.start) + text[place.end :]
    for pattern in patterns:
        text = pattern.sub(" ", text)
    return text


def _line(text: str, places: list[_Place], facts: _Facts, ways: list[Any]) -> list[tuple[int, None, tuple[float, float]]]:
    """A straight run whose direction and length stand apart: "along 45 degrees for 40 m", "the distance of the task on 090"."""
    if ways or not w.LINE.search(text):
        return []
    lengths = {value: start for value, start, _end in _sizes_said(text, places)} | _own_number(w.OWN_LENGTH, text, facts, ("max_dist", "length"))
    bare = _blank(text, places)
    directions = {float(match[1]): match.start() for match in w.ON_DEGREES.finditer(bare)} | _own_number(w.OWN_HEADING, text, facts, ("heading",))
    directions |= {w.bearing_of(match[1]): match.start() for match in w.ON_WAY.finditer(text)}
    if facts.turned is not None and (that := w.THAT_BEARING.search(text)):
        directions[facts.turned] = that.start()
    if not w.OWN_LENGTH.search(text) and (not lengths or (w.NO_LINE.search(text) and not directions)):
        return []
    if len(lengths) != 1 or len(directions) != 1 or w.NO_LINE.search(text):
        raise _Uncertain
    (length, first), (direction, second) = *lengths.items(), *directions.items()
    if any(place.start > max(first, second) for place in places):
        raise _Uncertain
    return [(max(first, second), None, (direction, length))]


def _own_number(wording: re.Pattern[str], text: str, facts: _Facts, names: tuple[str, ...]) -> dict[float, int]:
    """The task's own value that the text refers to, with where it does."""
    value = next((facts.parameters[name] for name in names if isinstance(facts.parameters.get(name), int | float)), None)
    match = wording.search(text)
    return {value: match.start()} if match and value is not None else {}


def _base(text: str, end: int, places: list[_Place], facts: _Facts) -> tuple[Point, int | None]:
    """What a way off is counted from, and where that place stands in the text."""
    for place in places:
        if place.start >= end and not re.search(r"\w", text[end : place.start]):
            return place.point, place.start
    if facts.own is not None and w.OWN.match(text[end:]):
        return facts.own, None
    raise _Uncertain


def _follow(events: list[tuple[int, Point | None, tuple[float, float] | None]], walked: list[Point]) -> list[Point]:
    found: list[Point] = []
    for _at, point, way in events:
        base = point or (found or walked or [None])[-1]
        if base is None:
            raise _Uncertain
        found.append(g.offset(base, *way) if way else base)
    return found
