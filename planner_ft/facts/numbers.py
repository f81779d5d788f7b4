"""The numbers of a text with their units, in one way of reading it: "four minutes" is 240 s, "a
metre and a half" 1.5 m.
"""

from __future__ import annotations

import functools
import itertools
import re
from collections.abc import Iterator
from dataclasses import dataclass, replace

from planner_ft.facts.lists import DIGITS, FRACTIONS, UNITS, WORDS
from planner_ft.facts.numerals import (
    AND,
    Token,
    half_behind,
    number_at,
    tokenize,
    unit_at,
    unit_of,
    word_at,
)
from planner_ft.facts.words import edit_distance, is_known

WRITTEN, BARE, IN_PAIR, AS_BEFORE, REREAD = range(5)
"""How plainly a number is said: with its unit, without, as half of a pair, in the unit of another
number, in another way of reading the text.
"""
FOOT, CABLE, POINT = 0.3048, 185.2, 11.25
"""Metres in a foot and in a cable (a tenth of a nautical mile); degrees in a compass point."""
NEIGHBOURS = 5
"""Characters that "and" with its blanks takes between two parts of one value."""
LEAST = 0.2
"""A number that corrects another is at least this share of it, and at most as many times as
large.
"""

_BY = re.compile(r"\s?(?:by|x|×)\s?", re.IGNORECASE)
_CLOCK = re.compile(r" ?m(?:in)? ?(\d{1,2}) ?s(?:ec)?\b", re.IGNORECASE)
"""What follows the minutes of "3m30s"."""
_CABLES = re.compile(r"[ -](?:of )?(?:an? )?cables?(?:[ -]lengths?)?\b", re.IGNORECASE)
_POINTS = re.compile(
    r" points?(?: of the compass)?,? (?:further |more )?(?:to (?:the )?(?:starboard|port|left|right)"
    r"|of the compass|(?:off|on|abaft|before) the)\b",
    re.IGNORECASE,
)
_EVERY = re.compile(r"\b(?:every|each|per)\s+$", re.IGNORECASE)
_UNIT_LEFT_OUT = re.compile(
    r"(?: (?:more|at|here|there|on|and|then|in)\b|[.,;)]|$)(?! ?\d)", re.IGNORECASE
)
"""What stands behind a number whose unit was said before: "ten minutes here and five there"."""
_SIZE = re.compile(r" (?:of )?(?:wide|width|long|length|broad)\b", re.IGNORECASE)
_CORRECTED = re.compile(
    r"\b(?:no|sorry|scratch|scrap|strike|correction|rather|mean|meant|belay|mistake|misread)\b"
    r"|\bmake (?:that|it)\b",
    re.IGNORECASE,
)
"""Words between a value and the one that takes its place: "two minutes, no, three"."""
_ANGLE = re.compile(
    r"\b(?:courses?|headings?|bearings?|hdg|azimuth|steering|steer)(?: of| is| to|:|=)? ?$",
    re.IGNORECASE,
)
_A_SECOND_ONE = re.compile(
    r"a second (?:minutes?|hours?|half|holds?|times?|ones?|turns?|legs?|pass|runs?|drifts?|arcs?"
    r"|nudges?|fix|still|pin|round|lap|look|stop|wait|stay)\b",
    re.IGNORECASE,
)
_WORDS = re.compile(r"[^a-z&]+")
_THINGS = re.compile(r"[ -]([a-z]+s)\b(?!['’])", re.IGNORECASE)


@dataclass(frozen=True, order=True)
class Number:
    """A number of a text: `value` in `unit` (None where no unit is said), at `start` to `end`, sign
    included; `said` before conversion, 0 for a sum. A lower `rank` is a plainer way of saying it.

    `counts`: it is no measure, but counts things, stands for a thing, or is a heading or a part.
    """

    value: float
    rank: int
    start: int
    end: int
    unit: str | None = None
    said: float = 0.0
    counts: bool = False

    @property
    def factor(self) -> float:
        """What one unit as it was said is in `unit`; 0 for a nought."""
        return self.value / self.said if self.said else 0.0


@functools.lru_cache(maxsize=4096)
def read_numbers(text: str) -> tuple[Number, ...]:
    """Every number of a text in order, words included; "a minute" is one minute, "half an hour"
    1800 s.
    """
    tokens, found, index = tokenize(text), list[Number](), 0
    while index < len(tokens):
        value, used = number_at(tokens, index)
        if used:
            sign = _sign(text, tokens, index)
            number, after = _measured(text, tokens, index, index + used, -value if sign else value)
            number = replace(number, counts=_counts(text, number))
            found.append(replace(number, start=number.start - sign))
            index = max(after, index + used)
        else:
            index += 1
    return tuple(_with_shared_units(text, found))


def in_unit(text: str, unit: str | None) -> Iterator[Number]:
    """The numbers of a text as values of a parameter in `unit`, bare ones and sums of neighbours
    ("two minutes and thirty seconds") included.
    """
    numbers = read_numbers(text)
    totals = list(_sums(numbers, unit))
    # "2 h 20 min" are no two hours.
    parts = [total for total, whole in totals if whole]
    for number in numbers:
        if number.unit == unit:
            if not any(total.start <= number.start < total.end for total in parts):
                yield replace(number, rank=WRITTEN if unit else BARE)
        elif number.unit is None:
            yield replace(number, rank=BARE)
            yield from _without_unit(text, number, unit)
    yield from (total for total, _whole in totals)
    yield from _as_before(text, numbers, unit)
    if unit == "m/s":
        yield from _speeds(text, numbers)


# ---------------------------------------------------------------- one number


def _sign(text: str, tokens: list[Token], index: int) -> int:
    """How many characters before a number its sign begins; none where it has no sign."""
    before, start, end = tokens[index - 1] if index else ("", 0, 0)
    first = tokens[index][1]
    if before in ("minus", "negative"):
        return first - start
    if before not in ("-", "−", "–") or end != first:
        return 0
    # A sign, and no hyphen: nothing before it, or no letter or digit, or the name of an axis.
    left = text[max(0, start - 2) : start].lower()
    letter = left[-1:]
    axis = letter in ("x", "y") and not left[:-1].isalpha()
    return first - start if axis or not (letter.isalnum() or letter == ")") else 0


def _measured(
    text: str, tokens: list[Token], first: int, after: int, value: float
) -> tuple[Number, int]:
    """The number of the tokens `first` to `after` with the unit behind it, and the token behind
    that.
    """
    start, end = tokens[first][1], tokens[after - 1][2]
    if clock := _CLOCK.match(text, end):
        behind = sum(token[1] < clock.end() for token in tokens)
        seconds = 60 * value + float(clock[1])
        return Number(seconds, WRITTEN, start, clock.end(), "s", value), behind
    unit, behind = unit_at(tokens, after)
    # "40S" is a coordinate.
    if unit is None or text[tokens[behind - 1][1] : tokens[behind - 1][2]] == "S":
        return Number(value, BARE, start, end, None, value), after
    rate, last = _rate(tokens, behind) if unit[0] == "m" else (0.0, behind)
    if rate:
        speed = value * unit[1] / rate
        return Number(speed, WRITTEN, start, tokens[last - 1][2], "m/s", value), last
    fraction, more = half_behind(tokens, behind)
    if more and value == int(value):
        value, behind = value + fraction, behind + more
    return Number(value * unit[1], WRITTEN, start, tokens[behind - 1][2], unit[0], value), behind


def _rate(tokens: list[Token], index: int) -> tuple[float, int]:
    """The seconds of "per second", "/h", "an hour" at `index`, and the token behind; 0 where there
    are none.
    """
    index += word_at(tokens, index) == "," and word_at(tokens, index + 1) == "per"
    if [word_at(tokens, index + place) for place in range(3)] == ["s", "-", "1"]:
        return 1.0, index + 3
    if word_at(tokens, index) in ("per", "a", "an", "each", "every", "/"):
        unit = unit_of(word_at(tokens, index + 1))
        if unit is not None and unit[0] == "s":
            return unit[1], index + 2
    return 0.0, index


def _counts(text: str, number: Number) -> bool:
    """Whether a number is certainly no measure: "two buoys", "the other one", "heading 045"."""
    if _A_SECOND_ONE.match(text, number.start):
        return True
    if number.unit is not None or _CABLES.match(text, number.end):
        return False
    word = text[number.start : number.end].lower()
    before, behind = text[: number.start][-24:].lower(), text[number.end :][:24]
    *_, second, last = ("", "", *(found for found in _WORDS.split(before) if found))
    added = last in AND or (last in ("a", "an") and second in AND)
    following = tokenize(behind)
    digit = behind[:1] == " " and bool(following) and following[0][0] in DIGITS
    stands = word == "one" and last not in WORDS["before_one"] and not digit
    part = word in FRACTIONS and not added
    bearing = len(word) == 3 and word.isdigit() and word[0] == "0"
    things = _THINGS.match(text, number.end)
    thing = things is not None and _is_thing(things[1])
    return stands or part or bearing or thing or _ANGLE.search(before) is not None


@functools.lru_cache(maxsize=2048)
def _is_thing(word: str) -> bool:
    """Whether a word that ends with "s" names things, and is no unit nor near one."""
    lowered = word.lower()
    units = any(edit_distance(lowered, unit, 2) <= 2 for unit in UNITS)
    return is_known(lowered) and lowered not in WORDS["no_things"] and not units


def _with_shared_units(text: str, found: list[Number]) -> Iterator[Number]:
    """The numbers, the first side of an area with the unit that is said behind the second: "200 by
    120 feet".
    """
    for one, two in itertools.zip_longest(found, found[1:]):
        shared = two is not None and one.unit is None and two.unit == "m" and two.factor
        if shared and _BY.fullmatch(text[one.end : two.start]):
            yield replace(one, value=one.said * two.factor, unit=two.unit, counts=False)
        else:
            yield one


# ---------------------------------------------------------------- what numbers say together


def _without_unit(text: str, number: Number, unit: str | None) -> Iterator[Number]:
    """What a number without a unit says as well: cables, points of the compass, parts of a
    hundred.
    """
    if unit == "m" and (cables := _CABLES.match(text, number.end)):
        yield replace(number, value=number.value * CABLE, unit="m", rank=WRITTEN, end=cables.end())
    elif unit == "deg" and (points := _POINTS.match(text, number.end)):
        yield replace(number, value=number.value * POINT, unit="deg", end=points.end())
    elif unit == "%" and number.value < 1:
        yield replace(number, value=100 * number.value, unit="%", rank=BARE, counts=False)


def neighbours(numbers: tuple[Number, ...], unit: str | None) -> list[Number]:
    """The values that neighbouring numbers are together: "two minutes and thirty seconds"."""
    return [total for total, _whole in _sums(numbers, unit)]


def _sums(numbers: tuple[Number, ...], unit: str | None) -> Iterator[tuple[Number, bool]]:
    """Neighbours that are one value ("1 h 20 min", "5 minutes 30", "two foot six"), and whether
    their parts are none.
    """
    for first, second in itertools.pairwise(numbers):
        gap, value = second.start - first.end, 0.0
        if first.unit != unit or gap > NEIGHBOURS or not first.said or unit not in ("s", "m"):
            continue
        if unit == "s" and second.unit == "s":
            value = first.value + second.value
        elif unit == "s" and second.unit is None and gap <= 1:
            value = first.value + second.value * first.factor / 60
        elif unit == "m" and abs(first.factor - FOOT) < 1e-6 and 0 < second.said < 12:
            inches = second.unit is None or abs(second.factor - FOOT / 12) < 1e-6
            value = first.value + second.said * FOOT / 12 if inches else 0.0
        if value:
            joined = unit == second.unit == "s" and gap <= 1 and first.said > 0 and second.said > 0
            whole = joined and first.factor > second.factor and second.value < first.factor
            yield Number(value, WRITTEN, first.start, second.end, unit), whole


def _as_before(text: str, numbers: tuple[Number, ...], unit: str | None) -> Iterator[Number]:
    """Bare numbers in the unit of another one: "ten minutes here and five there", "a reading every
    five", "two minutes, no, three".
    """
    factors = {number.factor for number in numbers if number.unit == unit and number.factor}
    for before, number in itertools.pairwise((None, *numbers)):
        if number is None or number.unit is not None or number.said <= 0 or unit not in ("s", "m"):
            continue
        again = (
            _SIZE.match(text, number.end)
            if unit == "m"
            else (_UNIT_LEFT_OUT.match(text, number.end) or _EVERY.search(text[: number.start]))
        )
        if before is not None and before.unit == unit and before.factor:
            between = text[before.end : number.start]
            size = number.said / before.said
            if len(between) <= 40 and _CORRECTED.search(between) and LEAST < size < 1 / LEAST:
                value = number.said * before.factor
                yield replace(number, value=value, unit=unit, rank=AS_BEFORE, counts=False)
        for factor in sorted(factors) if again else ():
            yield replace(
                number, value=number.said * factor, unit=unit, rank=AS_BEFORE, counts=False
            )


def _speeds(text: str, numbers: tuple[Number, ...]) -> Iterator[Number]:
    """Lengths with a unit of time right behind them: "one metre second"."""
    for number in numbers:
        if number.unit == "m":
            tokens = tokenize(text[number.end : number.end + 16])
            place = next((at for at, token in enumerate(tokens) if token[0] not in ",/"), 0)
            unit = unit_of(word_at(tokens, place))
            if unit and unit[0] == "s":
                end = number.end + tokens[place][2]
                yield replace(
                    number, value=number.value / unit[1], unit="m/s", end=end, rank=REREAD
                )
