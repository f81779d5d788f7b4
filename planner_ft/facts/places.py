"""Places in local metres, and directions of a text."""

import functools
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from typing import TypeVar

from planner_ft.facts.dictated import TIMES, dictated_pairs
from planner_ft.facts.geographic import without_geographic
from planner_ft.facts.numbers import read_numbers
from planner_ft.facts.together import BY, REREAD, WRITTEN, Number, pairs
from planner_ft.facts.words import COMPASS, SHORT, UNITS

MOST_BETWEEN = 80  # characters between two coordinates
_DIRECTION = r"(?:east|west|north|south)(?:ings?|wards?|erly)?(?!-[a-z])|[ewns](?![a-z])"
_METRES = r"(?:met(?:re|er)s?|m)\b"
_SIGN = r"(?:minus |negative |[-−–])"
_NUMBER = r"[-−–]?\d+(?:\.\d+)?"
_PAIR = rf"{_NUMBER}\s*[,;/|]?\s*{_NUMBER}"

_WRITTEN_PAIR = re.compile(
    rf"\[\s*{_PAIR}\s*\]|\(\s*{_PAIR}\s*\)"
    rf"|(?<!\w)x\s?[=:]?\s?{_NUMBER}\W{{0,3}}y\s?[=:]?\s?{_NUMBER}",
    re.IGNORECASE,
)
"""Two numbers that are certainly coordinates, and no other values."""
_DECIMAL = r"\s?[=:]?\s?(-?\d+),(\d{1,2})(?![\d,])"
_COMMAS = re.compile(rf"(?<!\w)x{_DECIMAL}\W{{0,4}}(?:and )?y{_DECIMAL}", re.IGNORECASE)
"""Axes with decimal commas: "x = 42,5; y = 18,5"."""
PAIR = re.compile(r"[-−–]?\d+(?:\.\d+)?(?:\s?[,/]\s?|;)[-−–]?\d+(?:\.\d+)?")
BESIDE = re.compile(r"[\s,;/\])\[(]*(?:and|to|then)?[\s,;/\])\[(]*")
"""What stands between the positions of a row."""
_BETWEEN = re.compile(
    rf"(?:[\s,;:/=]|(?<!\|)\|(?!\|)|comma|plus|and|by"
    rf"|(?<![a-z])[xy](?:\s(?:equals|is|of))?(?![a-z])|{_METRES}"
    rf"|(?:(?:to )?the |due )?"
    rf"(?:{_DIRECTION})|(?:of|from) (?:home|base|here|(?:the )?origin)|(?<=[,;/])\+|[-−–(])*",
    re.IGNORECASE,
)
_DIRECTED = re.compile(rf"\s*(?:{_METRES})?\s*(?:(?:to )?the |due )?({_DIRECTION})", re.IGNORECASE)
_LED = re.compile(rf"(?<![a-z])({_DIRECTION})\s*(?:of|by|[:=])?\s*{_SIGN}?\s*$", re.IGNORECASE)
_PARTED = re.compile(r"[-−–]?[\d.]+(?:\s?[;|]\s?| / )[-−–]?[\d.]+")
_THIRD = re.compile(r",?\s(?:and|or)\s")
_TIGHT = re.compile(r"[-−–]?\d{2,}(?:\.\d+)?/[-−–]?\d{2,}(?:\.\d+)?")
"""In "pen 3, 55/70" the number of the pen is no coordinate."""
_X_FIRST = re.compile(r"(?<![a-z])x\s*(?:[=:]|equals|is|of)?\s*$", re.IGNORECASE)
_Y_FIRST = re.compile(r"(?<![a-z])y\s*(?:[=:]|equals|is|of)?\s*$", re.IGNORECASE)
_HALF = re.compile(r"(?:half|quarter)\b", re.IGNORECASE)
_CLOCK = re.compile(r"(?:[01]?\d|2[0-3]):[0-5]\d(?!\d)")  # a time of day: "16:00"
_COORDINATE_UNIT = re.compile(
    r"(?:,|\(|^|\ball|\bgiven|\bcorners|\bcoordinates|\bpositions|\bis|\bare) ?in "
    r"(kilometres|kilometers|km|feet|ft|yards)\b(?! \w+ing\b)",
    re.IGNORECASE,
)
"""The unit of the coordinates in a sentence, which are metres elsewhere."""
_OPENED = re.compile(r"[\[(]\s*$")
_AT = re.compile(
    r"(?:\b(?:at|to|near|around|from|on|cent(?:re|er)|pos|position|coordinates)|@)\W{0,3}$",
    re.IGNORECASE,
)
_AXES = re.compile(
    r"(?<![a-z])y\s?(?:[=:]|equals|is|of)?\s?(?:[-−–]|minus )?\d"
    r"|\d\s?(?:east|west|north|south)\b.*\d",
    re.IGNORECASE,
)
_AXIS = r"(?:eastings?|northings?|east|north|west|south|latitude|longitude|coordinates?|[xy])"
_AXIS_BEFORE = re.compile(rf"(?<![a-z]){_AXIS}(?:(?![.;]\s)\W){{0,3}}(?:of |is )?$", re.IGNORECASE)
_AXIS_BEHIND = re.compile(
    rf"\s?(?:{_METRES})?\s?(?:to the |due )?{_AXIS}"
    r"(?![a-z-]| (?:side|face|wall|end|edge|corner|of (?!home|base|here)))",
    re.IGNORECASE,
)
_TIMES = re.compile(r"(?<![a-z])x$", re.IGNORECASE)  # "grid x2"
_COURSE = re.compile(r"\b(?:heading|bearing|course)(?: of)?\W{1,3}$", re.IGNORECASE)
_COURSES = {
    **{name.replace("-", ""): 22.5 * place for place, name in enumerate(COMPASS)},
    **{name.lower(): 22.5 * place for place, name in enumerate(SHORT)},
}
_NAMES = "|".join(name.replace("-", r"[\s-]?") for name in sorted(COMPASS, key=len, reverse=True))
_NAMES = re.sub(r"(?<=nor|sou)th", "(?:th|['’])", _NAMES)  # "nor'-east"
# A hyphen stands between two directions, and in no "south-side".
_BEARING = re.compile(
    rf"(?i:(?<!\w)(?<!(?<!north|south)(?<!east|west)-)(?P<point>{_NAMES})"
    rf"(?:erly|wards?|ern|[ -]?bound)?(?!\w|-(?!{_NAMES})))"
    r"|\b(?:[NSEW]{1,3}|[ns][ns]?[ew]|[ew][ns][ew])\b"
)
_BLANKS = re.compile(r"[\s-]")
_SHORTENED = re.compile(r"(?<=nor|sou)['’]")


@dataclass(frozen=True)
class Position:
    """Two neighbouring numbers as local coordinates in metres, at `start` to `end` of the text.

    `certain`: they are nothing else, standing in brackets, with axes or directions, or behind a
    word like "at".
    """

    x: float
    y: float
    start: int
    end: int
    certain: bool = False


Placed = TypeVar("Placed", Number, Position)


def rows_of(
    text: str, found: Iterable[Placed], between: re.Pattern[str] = BESIDE
) -> list[list[Placed]]:
    """Positions with nothing but "and", "then" and marks between, or numbers with `between`."""
    rows = list[list[Placed]]()
    for one in found:
        if rows and between.fullmatch(text, rows[-1][-1].end, one.start):
            rows[-1].append(one)
        else:
            rows.append([one])
    return rows


def rows_of_sizes(text: str) -> list[list[Number]]:
    """The numbers that are said together: "50 by 60 m", "100x60x20"."""
    return [row for row in rows_of(text, read_numbers(text), BY) if len(row) > 1]


def written_positions(text: str) -> list[Position]:
    """Positions that are written as such: certain ones, and "40,25"; none overlaps another."""
    measures = {one.end for one in read_numbers(text) if one.unit or one.counts}
    measures |= {one.end for one in read_numbers(text) if TIMES.match(text, one.end)}
    options = [
        one
        for one in read_positions(text)
        if one.certain or (PAIR.fullmatch(text, one.start, one.end) and one.end not in measures)
    ]
    chosen = list[Position]()
    blanks = {one: text[one.start : one.end].count(" ") for one in options}
    for place in sorted(
        options, key=lambda one: (not one.certain, one.end - one.start, blanks[one])
    ):
        if all(place.end <= one.start or one.end <= place.start for one in chosen):
            chosen.append(place)
    return sorted(chosen, key=lambda place: place.start)


def written_pairs(text: str) -> list[tuple[int, int]]:
    """The spans of what certainly are coordinates: "[40, 12]", "x=40 y=12", "E40 N12", "at 40,
    12"; not the first of "at 12, 18 and 25 metres".
    """
    measured, known = {one.start for one in read_numbers(text) if one.unit}, list[tuple[int, int]]()
    for one in written_positions(text):
        third = _THIRD.match(text, one.end)
        plain = PAIR.fullmatch(text, one.start, one.end)
        plain = plain if not third or third.end() not in measured else None
        known += [(one.start, one.end)] if one.certain and (plain or _is_led(text, one)) else []
    known += [pair[2:] for pair in dictated_pairs(text)]
    return [*(match.span() for match in _WRITTEN_PAIR.finditer(text)), *known]


def _is_led(text: str, place: Position) -> bool:
    """Whether a position begins with its direction, or stands behind its axis: "x equals 40"."""
    axis = _X_FIRST.search(text, max(0, place.start - 24), place.start)
    return bool(axis or re.match(_DIRECTION, text[place.start : place.end], re.IGNORECASE))


def read_positions(text: str) -> tuple[Position, ...]:
    """Pairs of neighbouring numbers that can be coordinates, whatever form they are written in, in
    the plain way of reading the text.

    A pair is read by its directions, said behind the numbers or before them: "40 south 12 east" and
    "south 40, east 12" are (12, -40).
    """
    return positions_of(text, read_numbers(text))


@functools.lru_cache(maxsize=4096)
def positions_of(text: str, numbers: tuple[Number, ...]) -> tuple[Position, ...]:
    """The positions that numbers of a text can be, the plainest first."""
    whole = [Position(*pair, certain=True) for pair in dictated_pairs(text)]
    for at in _COMMAS.finditer(text):
        x, y = float(f"{at[1]}.{at[2]}"), float(f"{at[3]}.{at[4]}")
        whole.append(Position(x, y, at.start(1), at.end(), certain=True))
    found, taken = dict.fromkeys(whole, WRITTEN), list(whole)
    for first, second in pairs((one for one in numbers if _is_metric(text, one)), MOST_BETWEEN):
        start, end = first.start, second.end
        between = _BETWEEN.fullmatch(text, first.stop, second.start)
        # "120 metres 9 metres off", "25 m, half a turn".
        measures = first.unit == second.unit == "m" and text[first.end : second.start].isspace()
        if measures or _HALF.match(text, second.start):
            continue
        if between and not _CLOCK.fullmatch(text, start, second.stop):
            led_in = _AT.search(text[:start][-16:])
            plain = led_in and _are_plain(text, first, second)
            opened = _OPENED.search(text[:start][-16:]) or _AXES.search(text[start:end])
            named = led_in or opened or _AXIS_BEFORE.search(text[:start][-24:])
            if BY.fullmatch(text, first.stop, second.start) and not named:
                continue  # "60 x 40 around the tower" are sizes.
            parted = text[first.end : second.start] == ";"
            # "120 east 45 north", but not "40, 40 due east".
            way = _DIRECTED.match(text, end) if _BEARING.search(text, start, end) else None
            rank = max(first.rank, second.rank)
            led = None if way else _led(text, first, second)
            directed = None not in _ways(text, first, second) and not _led_by(text, first)
            start = led.start if led else start
            if led and any(_share(led, one) for one in whole):
                continue
            taken += [led] if led else []
            for x, y in [(led.x, led.y)] if led else _readings(text, first, second):
                certain = bool(plain or opened or parted or led)
                place = Position(x, y, start, way.end() if way else end, certain)
                found[place] = min(rank, found.get(place, REREAD))
                whole += [place] if directed else []
                taken += [place] if directed or _TIGHT.fullmatch(text, start, end) else []
    # No number of "E12 N48, 100 m" is one of another position.
    known = [one for one in found if one in taken or not any(_share(one, led) for led in taken)]
    found = {one: found[one] for one in known}
    # A sentence may say the unit of its positions: "fence corners, in kilometres: ...".
    for match in _COORDINATE_UNIT.finditer(text):
        factor = UNITS[match[1].lower()][1]
        begin, stop = text.rfind(". ", 0, match.start()) + 1, text.find(". ", match.end())
        for place in known:
            if begin <= place.start and place.end <= (stop if stop >= 0 else len(text)):
                x, y = round(place.x * factor, 2), round(place.y * factor, 2)
                found[place] = found[replace(place, x=x, y=y)] = found[place]
    return tuple(sorted(found, key=lambda place: found[place] >= REREAD))


def _is_metric(text: str, number: Number) -> bool:
    """Whether a number can be a coordinate: in metres or without a unit. "15s" is south, and what
    stands behind "-160 second" comes second.
    """
    behind = text[number.stop : number.end].strip().lower() if number.stop else ""
    return bool(number.stop) and (number.unit in (None, "m") or behind in ("s", "second"))


def _share(one: Position, other: Position) -> bool:
    return one.start < other.end and other.start < one.end


def _readings(text: str, first: Number, second: Number) -> Iterator[tuple[float, float]]:
    before, ways = (max(0, first.start - 24), first.start), _ways(text, first, second)
    one, two = (_along(number, way) for number, way in zip((first, second), ways, strict=True))
    if one[1] != "y" and two[1] != "x":
        yield one[0], two[0]
    if (one[1] is None) != (two[1] is None):
        # The direction belongs to what follows: "from 22/98 westwards".
        yield first.said, second.said
    if one[1] == "y" or two[1] == "x" or _Y_FIRST.search(text, *before):
        yield two[0], one[0]


def _ways(text: str, first: Number, second: Number) -> tuple[re.Match[str] | None, ...]:
    """The directions behind two numbers: "40 south 12 east"."""
    between = _DIRECTED.match(text, first.stop, second.start)
    return between, _DIRECTED.match(text, second.stop, second.end + 24)


def _led_by(text: str, number: Number) -> re.Match[str] | None:
    """The direction that a number stands behind: "E1200"."""
    return _LED.search(text, max(0, number.start - 24), number.start)


def _are_plain(text: str, first: Number, second: Number) -> bool:
    """Whether numbers without units have a comma, a semicolon, " / ", "plus" or a blank between
    them.
    """
    between, measured = text[first.end : second.start], first.unit or second.unit
    digits = text[first.end - 1].isdigit() == text[second.end - 1].isdigit()
    blank = between.isspace() and digits and max(first.rank, second.rank) < REREAD
    signs = (",", ";", "|", "comma", "plus")
    parted = between.strip().lower() in signs or between == " / "
    return (blank or parted) and not (measured or first.counts or second.counts)


def _led(text: str, first: Number, second: Number) -> Position | None:
    """The position of two numbers that both stand behind their direction: "E1200 N0"."""
    ways = _led_by(text, first), _LED.search(text, first.stop, second.start)
    numbers = zip((first, second), ways, strict=True)
    by_axis = {axis: value for value, axis in (_along(*pair) for pair in numbers)}
    if ways[0] is None or not {"x", "y"} <= by_axis.keys():
        return None
    return Position(by_axis["x"], by_axis["y"], ways[0].start(1), second.end, True)


def _along(number: Number, way: re.Match[str] | None) -> tuple[float, str | None]:
    """The coordinate with the sign of its direction, and the axis that the direction gives."""
    letter = way[1][0].lower() if way else "?"
    axis = None if way is None else "x" if letter in "ew" else "y"
    return -number.said if letter in "ws" else number.said, axis


def with_brackets(text: str) -> str:
    """The text with its positions in the form of plans, where their notation leaves no doubt:
    "easting 72, northing 36", "x=72 y=36", "at 72 / 36" and, dictated, "at seventy two thirty six"
    as "[72, 36]". A comma alone ("at 72, 36"), directions behind ("12 m south of the buoy") and
    geographic positions stay.
    """
    parts, done, local = list[str](), 0, without_geographic(text)
    dictated = {pair[2] for pair in dictated_pairs(local)}
    for place in read_positions(local):
        start, end = place.start, place.end
        axis = _X_FIRST.search(text, max(0, start - 24), start)
        told = start in dictated or _is_led(text, place) or _PARTED.fullmatch(text, start, end)
        opened = _OPENED.search(text[:start][-16:])
        if place.certain and told and start >= done and (not opened or "|" in text[start:end]):
            written = f"{place.x:.12g}, {place.y:.12g}"
            written = written if opened else f"[{written}]"
            parts += [text[done : axis.start() if axis else start], written]
            done = end
    return "".join([*parts, text[done:]])


@functools.lru_cache(maxsize=4096)
def unpaired_coordinates(text: str) -> bool:
    """Whether a number is said as a coordinate ("x 40 ...") and has no partner. A lone length in a
    direction is a way: "400 feet due east of home".
    """
    paired = [(place.start, place.end) for place in read_positions(text)]
    paired += [(row[0].start, row[-1].end) for row in rows_of_sizes(text)]
    found = [
        one
        for one in read_numbers(text)
        if one.unit in ("m", None)
        and (
            _AXIS_BEFORE.search(text[: one.start][-24:])
            or _AXIS_BEHIND.match(text[one.end : one.end + 40])
        )
        and not any(at <= one.start < end for at, end in paired)
        and not (one.said in range(10) and _TIMES.search(text, max(0, one.start - 2), one.start))
    ]
    return len(found) > 1 or any(one.unit is None for one in found)


@functools.lru_cache(maxsize=4096)
def read_bearings(text: str) -> tuple[Number, ...]:
    """Compass directions that a text names, in degrees clockwise from north."""
    found = []
    for match in _BEARING.finditer(text):
        name = _SHORTENED.sub("th", (match["point"] or match[0]).lower())
        angle = _COURSES.get(_BLANKS.sub("", name))
        if angle is not None:
            found.append(Number(angle, WRITTEN, *match.span(), "deg", angle))
    return tuple(found)


def is_course(text: str, place: int) -> bool:
    """Whether a number at a place of the text stands behind "heading" or a word like it."""
    return _COURSE.search(text, max(0, place - 20), place) is not None
