"""The numbers and turns of a text: "four minutes" is 240 s, "a metre and a half" 1.5 m."""

import functools
import itertools
import re
from collections.abc import Iterable, Iterator
from dataclasses import replace

from planner_ft.facts import words as lists
from planner_ft.facts.clock import TIME, read_times
from planner_ft.facts.numerals import AND, NUMERALS, Row
from planner_ft.facts.together import AS_BEFORE, BARE, REREAD, WRITTEN, Number, sums, with_units
from planner_ft.facts.units import base_of, named
from planner_ft.facts.words import SMALL, UNITS, WORDS, is_known

THOROUGH = 6000
"""Characters of a text whose misspelt words are put right; what follows is read as it stands."""
CHOICES = range(2)  # words that a misspelt one can be, and that are tried
MOST_TIMES = 5  # times that a number is as large as another one, at most, to be in its unit

_RARE = re.compile(
    r"[ -](?:of )?(?:an? )?(cable)s?(?:[ -]lengths?)?\b|[ -](point)s?(?: of the compass)?,?"
    r" (?:further |more )?(?:to (?:the )?(?:starboard|port|left|right)|of the compass"
    r"|(?:off|on|abaft|before) the)\b",
    re.IGNORECASE,
)
RARE_UNITS = {"cable": ("m", 185.2), "point": ("deg", 11.25)}
"""Words that mostly mean things: a tenth of a nautical mile, a point of the compass."""
_ANGLE = re.compile(
    r"\b(?:courses?|headings?|bearings?|hdg|azimuth|steering|steer)(?: of| is| to|:|=)? ?$",
    re.IGNORECASE,
)
_A_SECOND_ONE = re.compile(
    r"a second (?:minutes?|hours?|half|holds?|times?|ones?|turns?|legs?|pass|runs?|drifts?|arcs?"
    r"|nudges?|fix|still|pin|round|lap|look|stop|wait|stay)\b",
    re.IGNORECASE,
)
_NAME = re.compile(r"(?<![^\W_])(?P<letters>[^\W\d_]+)(?P<joint>[-_/]?)(?:\d+[-_/])*$")
_LEADS_TO_NAME = re.compile(r"[-_][A-Z]+[-_]?\d")
AXES = tuple("nsew")
_BY_AXES = re.compile(
    r"(?<![^\W_])(?:[ew][-−–]?\d+(?:\.\d+)?,?\s?[ns]|[ns][-−–]?\d+(?:\.\d+)?,?\s?[ew])[-−–]?\d",
    re.IGNORECASE,
)
"""Coordinates, whose hyphens are signs: "E60 N-25"."""
_FREE = re.compile(r"(?:[,/;=(\[] ?|\b(?:to|at|x|y) )[-−–] $", re.IGNORECASE)  # "to - 85"
_FREE_TOO = re.compile(r"\d+(?:\.\d+)?\s?[,;/]\s?[-−–] \d")  # "- 85, - 40"
LONGEST_NAME = 24  # characters of a name before its last figures
_THINGS = re.compile(r"[ -]([a-z]+s)\b(?!['’])", re.IGNORECASE)

_PART = re.compile(
    r" of (?:a|an|the) (?:full |complete |whole )?"
    r"(?:turn|circle|rotation|revolution|circuit|round)\b",
    re.IGNORECASE,
)
_ROUND = ("round", "around", "about")
_LAPS = re.compile(
    r"[\s-]*(?:(?:full|complete|\w*-?clockwise|left[ -]hand|right[ -]hand) )?"
    r"(?:(?:time|turn|lap|round|circle|circuit|orbit)s?|x(?=\s+[a-z]))",
    re.IGNORECASE,
)


@functools.lru_cache(maxsize=4096)
def read_numbers(text: str) -> tuple[Number, ...]:
    """Every number of a text in order and in the plain way of reading it, words included."""
    return _plain(read_rows(text)[0])


@functools.lru_cache(maxsize=4096)
def read_all(text: str, *, letters: bool = False) -> tuple[Number, ...]:
    """The numbers in every way of reading a text, in order; rank REREAD for not the plain one. With
    `letters`, a single letter can be a unit: "24 V".
    """
    rows = read_rows(text, letters=letters)
    plain = dict.fromkeys(_plain(rows[0]))
    others = itertools.chain(read_times(text), *map(_every, rows))
    reread = (replace(one, rank=REREAD + (one.rank >= BARE)) for one in others if one not in plain)
    return tuple(sorted((*plain, *dict.fromkeys(reread)), key=lambda number: number.start))


def in_unit(text: str, unit: str | None) -> Iterator[Number]:
    """The numbers as values of a parameter in `unit`, bare ones and sums of neighbours too."""
    own, base = named(unit), base_of(unit)
    if unit and own is None:
        # What nobody knows how to convert stands as it is said.
        yield from (replace(one, value=one.said, unit=None) for one in read_all(text))
        return
    for number in _in_base(text, base):
        if own and number.unit == base is not None:
            added = (number.added - own.added) / own.factor
            yield replace(number, value=own.of_base(number.value), unit=unit, added=added)
        else:
            yield number
    for word, start, end in read_rows(text)[0].tokens if base is None else ():
        if times := lists.TIMES.get(word):  # "twice" and "once" as counts
            yield Number(times, WRITTEN, start, end, said=times, counts=True, stop=end)


def _in_base(text: str, unit: str | None) -> Iterator[Number]:
    """The numbers as values in a base unit."""
    numbers = read_all(text, letters=unit not in lists.SPOKEN)
    totals = list(sums(numbers, unit))
    # "2 h 20 min" are no two hours.
    parts = [total for total, whole in totals if whole]
    for number in numbers:
        if number.unit == unit:
            if not any(total.start <= number.start < total.end for total in parts):
                yield number
        elif number.unit is None or (unit == "degC" and number.unit == "deg"):
            yield number
            if unit == "%" and number.value < 1:
                yield replace(number, value=100 * number.value, counts=False)
    yield from (total for total, _whole in totals)
    for row in read_rows(text):
        yield from _as_before(row, unit)


@functools.lru_cache(maxsize=64)
def read_rows(text: str, *, letters: bool = False) -> tuple[Row, ...]:
    """A text with the spelling of its units put right, and in the ways that all of it can be."""
    row = Row.of(text, letters=letters)
    plain = row.mended(THOROUGH, numerals=False)
    rows = (plain, *(row.mended(THOROUGH, choice) for choice in CHOICES))
    return tuple({tuple(one.tokens): one for one in rows}.values())


@functools.lru_cache(maxsize=64)
def _plain(row: Row) -> tuple[Number, ...]:
    """The numbers of a row, one behind the other."""
    found, index = list[Number](), 0
    while index < len(row.tokens):
        number, index = next(_at(row, index), (None, index + 1))
        found += [number] if number else []
    return tuple(with_units(row.text, found))


def _every(row: Row) -> list[Number]:
    """The numbers from every token on at which one can begin."""
    found, todo, seen = list[Number](), [0], set[int]()
    while todo:
        index = todo.pop()
        if index in seen or index >= len(row.tokens):
            continue
        seen.add(index)
        options = list(_at(row, index))
        todo += [behind for _number, behind in options] or [index + 1]
        if row.bare_unit(index):
            options += _measured(row, index, index, 1.0)
        found += [number for number, _behind in options]
    return with_units(row.text, found)


def _at(row: Row, index: int) -> Iterator[tuple[Number, int]]:
    """The numbers that begin at a token, the plain one first, each with the index behind it."""
    sign = _sign(row, index)
    for value, after in row.numerals(index):
        for number, behind in _measured(row, index, after, -value if sign else value):
            if _is_of_name(row, index, number) or _is_of_time(row.text, number):
                continue
            counts = _counts(row, index, number)
            yield replace(number, start=number.start - sign, counts=counts), behind


def _is_of_name(row: Row, index: int, number: Number) -> bool:
    """Whether figures are of a tag or name: "P-101", "11-TK-7", "T142"; not "for30 min", "x40"."""
    if not row.word(index)[:1].isdigit() or _is_by_axes(row.text, number.start):
        return False
    if _LEADS_TO_NAME.match(row.text, number.stop):
        return True
    name = _NAME.search(row.text, max(0, number.start - LONGEST_NAME), number.start)
    if not name or name["letters"].lower() in NUMERALS:
        return False
    letters = name["letters"]
    if letters.lower() in ("x", "y", "by") or (letters.lower() in AXES and not name["joint"]):
        return False
    return letters.isupper() or not (
        number.unit or (not name["joint"] and len(letters) > 1 and is_known(letters))
    )


def _is_by_axes(text: str, place: int) -> bool:
    """Whether a figure is one of two coordinates behind their directions."""
    found = _BY_AXES.finditer(text, max(0, place - LONGEST_NAME), place + LONGEST_NAME)
    return any(pair.start() < place < pair.end() for pair in found)


def _is_of_time(text: str, number: Number) -> bool:
    """Whether figures are the hours or minutes of "14:30", which are no values by themselves."""
    times = TIME.finditer(text, max(0, number.start - 4), number.stop + 4)
    return any(time.start() <= number.start < time.end() for time in times)


def _sign(row: Row, index: int) -> int:
    """How many characters before a number its sign begins; none where it has no sign."""
    if not index:
        return 0
    (before, start, end), first = row.tokens[index - 1], row.tokens[index].start
    if before in ("minus", "negative"):
        return first - start
    free = _FREE.search(row.text, max(0, first - 8), first) or _FREE_TOO.match(row.text, first)
    if before not in ("-", "−", "–") or not (end == first or free):
        return 0
    # A sign, and no hyphen: nothing before it, or no letter or digit, or the name of an axis.
    left = row.text[max(0, start - 2) : start].lower()
    letter = left[-1:]
    axis = letter in ("x", "y") and not left[:-1].isalpha()
    axis |= letter in AXES and _is_by_axes(row.text, first)
    return first - start if axis or not (letter.isalnum() or letter == ")") else 0


def _measured(row: Row, first: int, after: int, value: float) -> Iterator[tuple[Number, int]]:
    """The number of some tokens with the unit behind it, and the token behind that."""
    start, stop = row.tokens[first].start, row.tokens[max(first, after - 1)].end
    words = [row.word(after + place) for place in range(3)]

    def number(
        value: float, unit: str | None, said: float, behind: int, added: float = 0.0
    ) -> tuple[Number, int]:
        end, rank = row.tokens[behind - 1].end, WRITTEN if unit else BARE
        return Number(value, rank, start, end, unit, said, stop=stop, added=added), behind

    bare = number(value, None, value, after)
    unit, behind = row.unit(after)
    # "At 85,40 a minute" is no 40 minutes.
    article = words[0] in ("a", "an") and row.written(after).islower()
    whole = float(value).is_integer() or "." in row.written(after - 1)
    apart = article and whole and _is_second(row, first)
    if words[0] in ("m", "min") and words[1].isdigit() and words[2] in ("s", "sec"):  # 3m30s
        yield number(60 * value + float(words[1]), "s", value, after + 3)
    # "40S" is a coordinate.
    elif unit is None or apart or row.written(behind - 1) == "S":
        yield bare
        if rare := _RARE.match(row.text, stop):
            word = (rare[1] or rare[2]).lower()
            yield number(value * RARE_UNITS[word][1], RARE_UNITS[word][0], value, after)
    else:
        rate, last = _rate(row, behind) if unit[0] == "m" else (0.0, behind)
        fraction, more = row.half(behind) if float(value).is_integer() else (0.0, behind)
        if rate:
            yield number(value * unit[1] / rate, "m/s", value, last)
        else:
            said = value + fraction
            yield number(unit.in_base(said), unit[0], said, more, unit.added)
            time = UNITS.get(row.word(behind)) if unit[0] == "m" else None
            if time and time[0] == "s":  # "one metre second"
                yield number(value * unit[1] / time[1], "m/s", value, behind + 1)
            if fraction and row.word(more) in WORDS["bare_units"]:
                yield number(value * unit[1], unit[0], value, behind)
        # "Drift 4 an hour".
        if article and row.word(after - 1)[-1:].isdigit():
            yield bare


def _is_second(row: Row, index: int) -> bool:
    """Whether a number stands behind another one, as the second of two coordinates does."""
    index -= row.word(index - 1) in ("-", "−", "–", "minus", "negative")
    before = row.word(index - 1)
    return (
        before in WORDS["before_second"]
        or before in AXES
        or before in SMALL
        or before[:1].isdigit()
    )


def _rate(row: Row, index: int) -> tuple[float, int]:
    """The seconds of "per second", "/h", "an hour", and the token behind; 0 for none."""
    index += row.word(index) == "," and row.word(index + 1) == "per"
    if [row.word(index + place) for place in range(3)] == ["s", "-", "1"]:
        return 1.0, index + 3
    if row.word(index) in ("per", "a", "an", "each", "every", "/"):
        unit = UNITS.get(row.word(index + 1))
        if unit is not None and unit[0] == "s":
            return unit[1], index + 2
    return 0.0, index


def _counts(row: Row, index: int, number: Number) -> bool:
    """Whether a number is certainly no measure: "two buoys", "the other one", "heading 045"."""
    text, start, end = row.text, number.start, number.end
    if _A_SECOND_ONE.match(text, start):
        return True
    if number.unit is not None:
        return False
    word, last, second = row.word(index), row.word(index - 1), row.word(index - 2)
    added = last in AND or (last in ("a", "an") and second in AND)
    lone = last not in WORDS["before_one"] and row.word(index + 1) not in lists.DIGITS
    stands = number.said == 1 and word == "one" and lone
    part = word in lists.FRACTIONS and end == row.tokens[index].end and not added
    bearing = len(word) == 3 and word.isdigit() and word[0] == "0"
    things = None if last in ("by", "x") else _THINGS.match(text, end)
    thing = things is not None and _is_thing(things[1].lower())
    angle = bool(_ANGLE.search(text, max(0, start - 24), start))
    return stands or part or bearing or thing or angle


@functools.lru_cache(maxsize=2048)
def _is_thing(word: str) -> bool:
    """Whether a word that ends with "s" names things, and is no unit nor near one."""
    if not is_known(word) or word in WORDS["no_things"]:
        return False
    return not any(lists.edit_distance(word, unit, 2) <= 2 for unit in UNITS)


def _as_before(row: Row, unit: str | None) -> Iterator[Number]:
    """Bare numbers in the unit of a like number before: "ten minutes here and five there"."""
    before: Number | None = None
    for number in _plain(row) if unit in ("s", "m") else ():
        if number.unit == unit:
            before = number
        if not before or not before.said or number.unit is not None or number.counts:
            continue
        if 1 / MOST_TIMES < number.said / before.said < MOST_TIMES:
            yield replace(number, value=number.said * before.factor, unit=unit, rank=AS_BEFORE)


def turns_of(text: str, numbers: Iterable[Number]) -> Iterator[Number]:
    """Angles in degrees of the turns of a text: full, once, half, twice, three times."""
    measured = [(one.start, one.end) for one in read_numbers(text) if one.unit]
    for row in read_rows(text):
        for index, (word, start, end) in enumerate(row.tokens):
            # "Half a knot" is no half turn.
            whole = not any(first <= start < last for first, last in measured)
            turn = lists.TURNS.get(word, 0.0) if whole else 0.0
            if word == "way" and row.word(index - 2) == "all" and row.word(index + 1) in _ROUND:
                turn, start, end = 1.0, row.tokens[index - 2].start, row.tokens[index + 1].end
            if turn:
                yield Number(360 * turn, WRITTEN, start, end, "deg", turn)
    for number in (one for one in numbers if one.unit is None):
        laps = _LAPS.match(text, number.end)
        part = number.value in (0.75, 1.5) or abs(number.value - 2 / 3) < 1e-9
        if part or laps or _PART.match(text, number.end):
            end = laps.end() if laps else number.end
            yield Number(360 * number.value, WRITTEN, number.start, end, "deg", number.said)
