"""Numbers, positions and bearings that an English command states, with their units.

The checks of rules.py ask whether a value in a plan can come from the command: "four minutes" gives
240 s, "a metre and a half" 1.5 m, "north-west" 315 deg, "three quarters of a circle" 270 deg.
"""

from __future__ import annotations

import functools
import itertools
import re
from collections.abc import Iterator
from dataclasses import dataclass, replace

from planner_ft.data.numerals import (
    Token,
    half_behind,
    number_at,
    tokenize,
    unit_at,
    unit_of,
    word_at,
)

COMPASS = (
    *(
        "north",
        "north-north-east",
        "north-east",
        "east-north-east",
        "east",
        "east-south-east",
        "south-east",
        "south-south-east",
    ),
    *(
        "south",
        "south-south-west",
        "south-west",
        "west-south-west",
        "west",
        "west-north-west",
        "north-west",
        "north-north-west",
    ),
)
SHORT = (
    "N",
    "NNE",
    "NE",
    "ENE",
    "E",
    "ESE",
    "SE",
    "SSE",
    "S",
    "SSW",
    "SW",
    "WSW",
    "W",
    "WNW",
    "NW",
    "NNW",
)
TURNS = {
    **dict.fromkeys(("full", "complete", "completely", "whole", "entire", "once", "lap"), 1.0),
    **dict.fromkeys(("half", "semicircle"), 0.5),
    "quarter": 0.25,
    "third": 1 / 3,
    "twice": 2.0,
}
ROUNDING = 0.0051
"""Converted values are written with two decimals."""

_PART = re.compile(
    r" of (?:a|an|the) (?:full |complete |whole"
    r" )?(?:turn|circle|rotation|revolution|circuit|round)\b"
)
_REPEATED = re.compile(
    r"[\s-]*(?:full |complete )?(?:times?|turns?|laps?|rounds?|circles?|circuits?|orbits?)"
)
_DIRECTION = r"(?:east|west|north|south)(?:ings?|wards?|erly)?|[ewns](?![a-z])"
_FROM_HOME = r"(?:of|from) (?:home|base|here|(?:the )?origin)"
_BETWEEN = re.compile(
    r"(?:[\s,;:/=]|comma|and|by|(?<![a-z])[xy](?![a-z])|met(?:re|er)s?|m|(?:(?:to )?the |due"
    rf" )?(?:{_DIRECTION})|{_FROM_HOME}|minus|negative|[-−–(])*",
    re.IGNORECASE,
)
_DIRECTED = re.compile(
    rf"\s*(?:met(?:re|er)s?|m)?\s*(?:(?:to )?the |due )?({_DIRECTION})", re.IGNORECASE
)
_LED = re.compile(
    rf"(?<![a-z])({_DIRECTION})\s*(?:of|by|[:=])?\s*(?:minus|negative|[-−–])?\s*$", re.IGNORECASE
)
_BY = re.compile(r"\s?(?:by|x|×)\s?", re.IGNORECASE)
_MINUTES_SECONDS = re.compile(r" ?m(?:in)? ?(\d{1,2}) ?s(?:ec)?\b", re.IGNORECASE)
"""What follows the minutes of "3m30s"."""
_SPEEDS = (
    (
        re.compile(
            r"\s*(?:an? )?(?:m/s|m s-1|m(?:et(?:re|er)s?)?,? (?:per|a) s(?:ec(?:ond)?)?\b)",
            re.IGNORECASE,
        ),
        1.0,
    ),
    (
        re.compile(
            r"\s*(?:km/h|km (?:per|an) hour|kilomet(?:re|er)s (?:per|an) hour)", re.IGNORECASE
        ),
        1 / 3.6,
    ),
)


@dataclass(frozen=True)
class Quantity:
    """A number as the command says it: `value` in `unit` (None when no unit is said), at `start` to
    `end` of the text.
    """

    value: float
    unit: str | None
    start: int
    end: int
    said: float
    """The bare number, before conversion: coordinates are compared with it."""


@functools.lru_cache(maxsize=4096)
def quantities(text: str) -> tuple[Quantity, ...]:
    """Every number of the text in order, words included; "a minute" counts as one minute, "half an
    hour" as 1800 s.
    """
    tokens = tokenize(text)
    found = []
    index = 0
    while index < len(tokens):
        value, used = number_at(tokens, index)
        if used == 0:
            index += 1
            continue
        negative = _negative(text, tokens, index)
        quantity, after = _with_unit(
            text, tokens, index, index + used, -value if negative else value
        )
        found.append(quantity)
        index = max(after, index + used)
    return tuple(_with_shared_units(text, found))


def _with_shared_units(text: str, found: list[Quantity]) -> Iterator[Quantity]:
    """The quantities, the first side of an area with the unit that is said behind the second: "200
    by 120 feet".
    """
    for one, two in itertools.zip_longest(found, found[1:]):
        shared = (
            two is not None
            and one.unit is None
            and two.unit == "m"
            and two.said
            and _BY.fullmatch(text[one.end : two.start])
        )
        yield (
            replace(one, value=one.said * two.value / two.said, unit=two.unit)
            if two is not None and shared
            else one
        )


def _negative(text: str, tokens: list[Token], index: int) -> bool:
    previous = word_at(tokens, index - 1)
    if previous in ("minus", "negative"):
        return True
    if previous not in ("-", "−", "–") or tokens[index - 1][2] != tokens[index][1]:
        return False
    before = text[: tokens[index - 1][1]]
    # A sign, and no hyphen: nothing before it, or no letter or digit, or the name of an axis
    # ("Y-83").
    return (
        not before
        or not (before[-1].isalnum() or before[-1] == ")")
        or re.search(r"(?<![^\W\d_])[xy]$", before, re.IGNORECASE) is not None
    )


def _with_unit(
    text: str, tokens: list[Token], first: int, after: int, value: float
) -> tuple[Quantity, int]:
    start, end = tokens[first][1], tokens[after - 1][2]
    for pattern, factor in _SPEEDS:
        speed = pattern.match(text, end)
        if speed:
            behind = next(
                (index for index in range(after, len(tokens)) if tokens[index][1] >= speed.end()),
                len(tokens),
            )
            return Quantity(value * factor, "m/s", start, speed.end(), value), behind
    if clock := _MINUTES_SECONDS.match(text, end):
        behind = next(
            (index for index in range(after, len(tokens)) if tokens[index][1] >= clock.end()),
            len(tokens),
        )
        return Quantity(60 * value + float(clock[1]), "s", start, clock.end(), value), behind
    unit, behind = unit_at(tokens, after)
    if (
        unit is not None
        and unit[0] == "m"
        and word_at(tokens, behind) in ("per", "a", "an", "each", "every", "/")
    ):
        rate = unit_of(word_at(tokens, behind + 1))
        if rate is not None and rate[0] == "s":
            return (
                Quantity(value * unit[1] / rate[1], "m/s", start, tokens[behind + 1][2], value),
                behind + 2,
            )
    # "40S" is a coordinate.
    if unit is None or text[tokens[behind - 1][1] : tokens[behind - 1][2]] == "S":
        return Quantity(value, None, start, end, value), after
    fraction, more = half_behind(tokens, behind)
    if more and value == int(value):
        value, behind = value + fraction, behind + more
    return Quantity(value * unit[1], unit[0], start, tokens[behind - 1][2], value), behind


# ---------------------------------------------------------------- directions, turns and places


def close(said: float, written: float) -> bool:
    """Whether a value that was said is the written one, up to the rounding of conversions."""
    return abs(said - written) <= ROUNDING


@functools.lru_cache(maxsize=4096)
def bearings(text: str) -> frozenset[float]:
    """Compass directions that the text names, in degrees clockwise from north."""
    lowered = re.sub(r"\b(north|south)[\s-]?(east|west)", r"\1-\2", text.lower())
    lowered = re.sub(
        r"\b(north|south|east|west)[\s-]((?:north|south)-(?:east|west))", r"\1-\2", lowered
    )
    found = {
        22.5 * index
        for index, name in enumerate(COMPASS)
        if re.search(rf"(?<![\w-]){name}(?:erly|wards?|ern|[ -]?bound)?(?![\w-])", lowered)
    }
    short = [
        name.upper() for name in re.findall(r"\b(?:[NESW]|(?i:[ns][ns]?[ew]|[ew][ns][ew]))\b", text)
    ]
    return frozenset(found | {22.5 * SHORT.index(name) for name in short if name in SHORT})


@functools.lru_cache(maxsize=4096)
def turns(text: str) -> frozenset[float]:
    """Angles in degrees of the turns that the text speaks of: full, once, half, three quarters,
    twice, three times.
    """
    words = re.findall(r"[a-z]+", text.lower())
    found = {360 * TURNS[word] for word in words if word in TURNS}
    if re.search(r"all the way (?:a?round|about)", text.lower()):
        found.add(360.0)
    for quantity in quantities(text):
        behind = text[quantity.end : quantity.end + 24].lower()
        if quantity.unit is None and (
            quantity.value in (0.75, 1.5, 2 / 3) or _REPEATED.match(behind) or _PART.match(behind)
        ):
            found.add(360 * quantity.value)
    return frozenset(found)


@functools.lru_cache(maxsize=4096)
def positions(text: str) -> tuple[tuple[float, float, int, int], ...]:
    """Pairs of neighbouring numbers that can be coordinates, as (x, y, start, end), whatever form
    they are written in.

    A pair is read both as it stands and by its directions, said behind the numbers or before them:
    "40 south 12 east" and "south 40, east 12" are also (12, -40).
    """
    found = []
    numbers = quantities(text)
    for first, second in itertools.pairwise(numbers):
        between = _between(text, first, second)
        if not _BETWEEN.fullmatch(between):
            continue
        one, two = _directed(first, between), _directed(second, text[_number_end(text, second) :])
        found.append((one[0], two[0], first.start, second.end))
        if (one[1] is None) != (two[1] is None):
            # The direction belongs to what follows: "from 22/98 westwards".
            found.append((first.said, second.said, first.start, second.end))
        if (
            one[1] == "y"
            or two[1] == "x"
            or re.search(r"y\s*[=:]?\s*-?$", text[: first.start].lower())
        ):
            found.append((two[0], one[0], first.start, second.end))
        led = {
            axis: value
            for value, axis in (_led(first, text[: first.start]), _led(second, between))
            if axis
        }
        if len(led) == 2:
            found.append((led["x"], led["y"], first.start, second.end))
    return tuple(found)


def _number_end(text: str, quantity: Quantity) -> int:
    """Where the number ends and its unit begins: coordinates keep the unit in the text between
    them.
    """
    said = text[quantity.start : quantity.end]
    return (
        quantity.start + len(re.sub(r"\s*(?:met(?:re|er)s?|m)$", "", said, flags=re.IGNORECASE))
        if quantity.unit == "m"
        else quantity.end
    )


def _between(text: str, first: Quantity, second: Quantity) -> str:
    return text[_number_end(text, first) : second.start]


def _directed(quantity: Quantity, behind: str) -> tuple[float, str | None]:
    """The coordinate with the sign of the direction said behind it, and the axis that the direction
    gives.
    """
    match = _DIRECTED.match(behind)
    return _along(quantity, match[1]) if match else (quantity.said, None)


def _led(quantity: Quantity, before: str) -> tuple[float, str | None]:
    """The coordinate with the sign of the direction said before it, and the axis that the direction
    gives.
    """
    match = _LED.search(before)
    return _along(quantity, match[1]) if match else (quantity.said, None)


def _along(quantity: Quantity, direction: str) -> tuple[float, str]:
    letter = direction[0].lower()
    return (-1 if letter in "ws" else 1) * quantity.said, "x" if letter in "ew" else "y"
