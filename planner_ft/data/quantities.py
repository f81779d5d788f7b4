"""Numbers, positions and bearings that an English command states, with their units.

The checks of rules.py ask whether a value in a plan can come from the command: "four minutes" gives 240 s, "a metre and
a half" 1.5 m, "north-west" 315 deg, "three quarters of a circle" 270 deg.
"""

from __future__ import annotations

import functools
import itertools
import re
from dataclasses import dataclass

from planner_ft.data.words import edit_distance

UNITS: dict[str, tuple[str, float]] = {
    **dict.fromkeys(("s", "sec", "secs", "second", "seconds"), ("s", 1.0)),
    **dict.fromkeys(("min", "mins", "minute", "minutes"), ("s", 60.0)),
    **dict.fromkeys(("h", "hr", "hrs", "hour", "hours"), ("s", 3600.0)),
    **dict.fromkeys(("day", "days"), ("s", 86400.0)),
    **dict.fromkeys(("m", "metre", "metres", "meter", "meters"), ("m", 1.0)),
    **dict.fromkeys(("km", "kilometre", "kilometres", "kilometer", "kilometers", "klick", "klicks"), ("m", 1000.0)),
    **dict.fromkeys(("cm", "centimetre", "centimetres", "centimeter", "centimeters"), ("m", 0.01)),
    **dict.fromkeys(("nm", "mile", "miles"), ("m", 1852.0)),
    **dict.fromkeys(("ft", "foot", "feet"), ("m", 0.3048)),
    **dict.fromkeys(("mps",), ("m/s", 1.0)),
    **dict.fromkeys(("kmh", "kph"), ("m/s", 1 / 3.6)),
    **dict.fromkeys(("kn", "kt", "kts", "knot", "knots"), ("m/s", 1852 / 3600)),
    **dict.fromkeys(("deg", "degree", "degrees", "°"), ("deg", 1.0)),
    **dict.fromkeys(("percent", "per cent", "%"), ("%", 1.0)),
}
"""Word to the unit that parameters have and the factor to it."""

ONES = (
    *("zero", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten", "eleven", "twelve", "thirteen"),
    *("fourteen", "fifteen", "sixteen", "seventeen", "eighteen", "nineteen"),
)
TENS = ("twenty", "thirty", "forty", "fifty", "sixty", "seventy", "eighty", "ninety")
SMALL = {
    **{word: float(value) for value, word in enumerate(ONES)},
    **{word: 10.0 * value for value, word in enumerate(TENS, 2)},
    "oh": 0.0,
    "fourty": 40.0,
    "dozen": 12.0,
}
COMPASS = (
    *("north", "north-north-east", "north-east", "east-north-east", "east", "east-south-east", "south-east", "south-south-east"),
    *("south", "south-south-west", "south-west", "west-south-west", "west", "west-north-west", "north-west", "north-north-west"),
)
SHORT = ("N", "NNE", "NE", "ENE", "E", "ESE", "SE", "SSE", "S", "SSW", "SW", "WSW", "W", "WNW", "NW", "NNW")
TURNS = {
    **dict.fromkeys(("full", "complete", "whole", "entire", "once", "lap"), 1.0),
    **dict.fromkeys(("half", "semicircle"), 0.5),
    "quarter": 0.25,
    "third": 1 / 3,
    "twice": 2.0,
}
FRACTIONS = {"half": 0.5, "quarter": 0.25, "third": 1 / 3}
PLURAL_FRACTIONS = {"quarters": 0.25, "thirds": 1 / 3}
ROUNDING = 0.0051
"""Converted values are written with two decimals."""

_TOKEN = re.compile(r"\d{1,3},\d{3}(?=\s?(?:m|metres|meters|s|seconds)\b)|[1-9]/[2-9](?!\d)|\d*\.\d+|\d+|[a-z°]+(?:'[a-z]+)?|[-−–]|%|[^\s\w]", re.IGNORECASE)
_REPEATED = re.compile(r"[\s-]*(?:full |complete )?(?:times|turns|laps|rounds|circles|orbits)")
_BETWEEN = re.compile(r"(?:[\s,;:/=]|comma|and|by|x|y|m|metres?|meters?|east|west|north|south|minus|negative|[-−–(])*", re.IGNORECASE)
_SPEED = re.compile(r"\s*(?:m/s|m s-1|met(?:re|er)s? (?:per|a) second)", re.IGNORECASE)
_HALF_SPEED = re.compile(r"\s*an? met(?:re|er) (?:per|a) second", re.IGNORECASE)


@dataclass(frozen=True)
class Quantity:
    """A number as the command says it: `value` in `unit` (None when no unit is said), at `start` to `end` of the text."""

    value: float
    unit: str | None
    start: int
    end: int
    said: float
    """The bare number, before conversion: coordinates are compared with it."""


@functools.lru_cache(maxsize=4096)
def quantities(text: str) -> tuple[Quantity, ...]:
    """Every number of the text in order, words included; "a minute" counts as one minute, "half an hour" as 1800 s."""
    tokens = [(match.group().lower(), match.start(), match.end()) for match in _TOKEN.finditer(text)]
    found = []
    index = 0
    while index < len(tokens):
        value, used = _number(tokens, index)
        if used == 0:
            index += 1
            continue
        negative = _negative(text, tokens, index)
        quantity, after = _with_unit(text, tokens, index, index + used, -value if negative else value)
        found.append(quantity)
        index = max(after, index + used)
    return tuple(found)


Token = tuple[str, int, int]


def _word(tokens: list[Token], index: int) -> str:
    return tokens[index][0] if 0 <= index < len(tokens) else ""


def _number(tokens: list[Token], index: int) -> tuple[float, int]:
    """The number that begins at `index` and how many tokens it takes; none, and 0 tokens, where no number begins."""
    word = _word(tokens, index)
    if word[:1].isdigit() or (word[:1] == "." and word[1:].isdigit()):
        above, _, below = word.replace(",", "").partition("/")
        return _and_a_half(tokens, index, float(above) / float(below or 1), 1)
    if word in FRACTIONS:
        return FRACTIONS[word], 1
    if word in ("a", "an", "per", "each", "every") and _word(tokens, index + 1) in UNITS and len(_word(tokens, index + 1)) > 2:
        return 1.0, 1
    if word in ("a", "an") and _word(tokens, index + 1) in ("hundred", "thousand", "dozen"):
        value, used = _words(tokens, index + 1, 1.0)
        return value, used + 1
    if word not in SMALL and word not in ("hundred", "thousand"):
        return 0.0, 0
    value, used = _words(tokens, index, 0.0)
    if _word(tokens, index + used) in PLURAL_FRACTIONS:
        return value * PLURAL_FRACTIONS[_word(tokens, index + used)], used + 1
    return _and_a_half(tokens, index, value, used)


def _words(tokens: list[Token], index: int, value: float) -> tuple[float, int]:
    """A number in words: "one hundred and twenty", "ninety five", "one point two", "one two zero" (digit by digit)."""
    start, total, current, seen = index, 0.0, value, False
    digits = [_word(tokens, place) for place in range(index, len(tokens))]
    spelled = next((count for count, word in enumerate(digits) if not SMALL.get(word, 10) < 10), len(digits))
    if spelled >= 3:
        return float("".join(str(int(SMALL[word])) for word in digits[:spelled])), spelled
    while True:
        word, skip = _word(tokens, index), 0
        if word in ("-", "and") and seen and (current >= 20 or (word == "and" and current >= 100)):
            skip, word = 1, _word(tokens, index + 1)
        if word in SMALL and (not seen or _joins(current, SMALL[word])):
            current += SMALL[word]
        elif word == "hundred":
            current = max(current, 1) * 100
        elif word == "thousand":
            total, current = total + max(current, 1) * 1000, 0.0
        else:
            break
        seen = True
        index += 1 + skip
    if seen and _word(tokens, index) in ("point", "decimal") and _word(tokens, index + 1) in SMALL:
        decimals = ""
        index += 1
        while SMALL.get(_word(tokens, index), 10) < 10:
            decimals += str(int(SMALL[_word(tokens, index)]))
            index += 1
        return total + current + float(f"0.{decimals or '0'}"), index - start
    return total + current, index - start


def _joins(current: float, following: float) -> bool:
    """Whether `following` continues the number: five after twenty, twenty after a hundred."""
    if current >= 100 and current % 100 == 0:
        return following < 100
    return current >= 20 and current % 10 == 0 and 0 < following < 10


def _and_a_half(tokens: list[Token], index: int, value: float, used: int) -> tuple[float, int]:
    after = index + used
    if _word(tokens, after) == "and" and _word(tokens, after + 1) in ("a", "one") and _word(tokens, after + 2) in FRACTIONS:
        return value + FRACTIONS[_word(tokens, after + 2)], used + 3
    return value, used


def _negative(text: str, tokens: list[Token], index: int) -> bool:
    previous = _word(tokens, index - 1)
    if previous in ("minus", "negative"):
        return True
    if previous not in ("-", "−", "–"):
        return False
    before = tokens[index - 1][1]
    glued = tokens[index - 1][2] == tokens[index][1]
    return glued and (before == 0 or not (text[before - 1].isalnum() or text[before - 1] == ")"))


def _unit(tokens: list[Token], index: int) -> tuple[tuple[str, float] | None, int]:
    """The unit at `index`, passing over a hyphen, "of", "an" or "a" ("ten-minute", "half an hour"), and the index behind it."""
    passed = 0
    while _word(tokens, index) in ("-", "of", "a", "an") and passed < 3:
        index, passed = index + 1, passed + 1
    word = _word(tokens, index)
    if word in UNITS:
        return UNITS[word], index + 1
    if len(word) >= 6:
        for name, unit in UNITS.items():
            if len(name) >= 5 and edit_distance(word, name, 2) <= 2:
                return unit, index + 1
    return None, index


def _with_unit(text: str, tokens: list[Token], first: int, after: int, value: float) -> tuple[Quantity, int]:
    start, end = tokens[first][1], tokens[after - 1][2]
    speed = _SPEED.match(text, end) or (_HALF_SPEED.match(text, end) if value == 0.5 else None)
    if speed:
        behind = next((index for index in range(after, len(tokens)) if tokens[index][1] >= speed.end()), len(tokens))
        return Quantity(value, "m/s", start, speed.end(), value), behind
    unit, behind = _unit(tokens, after)
    if unit is None:
        return Quantity(value, None, start, end, value), after
    if _word(tokens, behind) == "and" and _word(tokens, behind + 1) == "a" and _word(tokens, behind + 2) in FRACTIONS and value == int(value):
        value += FRACTIONS[_word(tokens, behind + 2)]
        behind += 3
    return Quantity(value * unit[1], unit[0], start, tokens[behind - 1][2], value), behind


# ---------------------------------------------------------------- questions about a value


def states_number(text: str, value: float, unit: str | None) -> bool:
    """Whether `value` in a parameter's `unit` can come from the text. A number said in another unit does not count."""
    kind = "deg" if unit == "degC" else unit
    for quantity in quantities(text):
        if quantity.unit in (kind, None) and close(quantity.value, value):
            return True
    if kind == "s" and any(close(total, value) for total in _durations(text)):
        return True
    return unit == "deg" and (value % 360 in bearings(text) or any(close(turn, abs(value)) for turn in turns(text)))


def _durations(text: str) -> list[float]:
    """Sums of neighbouring durations: "two minutes and thirty seconds", "1 h 20 min"."""
    timed = [quantity for quantity in quantities(text) if quantity.unit == "s"]
    return [first.value + second.value for first, second in itertools.pairwise(timed) if second.start - first.end <= 5]


def close(said: float, written: float) -> bool:
    """Whether a value that was said is the written one, up to the rounding of conversions."""
    return abs(said - written) <= ROUNDING


@functools.lru_cache(maxsize=4096)
def bearings(text: str) -> frozenset[float]:
    """Compass directions that the text names, in degrees clockwise from north."""
    lowered = re.sub(r"\b(north|south)[\s-]?(east|west)", r"\1-\2", text.lower())
    lowered = re.sub(r"\b(north|south|east|west)[\s-]((?:north|south)-(?:east|west))", r"\1-\2", lowered)
    found = {22.5 * index for index, name in enumerate(COMPASS) if re.search(rf"(?<![\w-]){name}(?:erly|wards?|ern|bound)?(?![\w-])", lowered)}
    return frozenset(found | {22.5 * SHORT.index(name) for name in re.findall(rf"\b(?:{'|'.join(sorted(SHORT, key=len, reverse=True))})\b", text)})


@functools.lru_cache(maxsize=4096)
def turns(text: str) -> frozenset[float]:
    """Angles in degrees of the turns that the text speaks of: full, once, half, three quarters, twice, three times."""
    words = re.findall(r"[a-z]+", text.lower())
    found = {360 * TURNS[word] for word in words if word in TURNS}
    if re.search(r"all the way (?:a?round|about)", text.lower()):
        found.add(360.0)
    for quantity in quantities(text):
        behind = text[quantity.end : quantity.end + 24].lower()
        if quantity.unit is None and (quantity.value in (0.75, 1.5, 2 / 3) or _REPEATED.match(behind)):
            found.add(360 * quantity.value)
    return frozenset(found)


@functools.lru_cache(maxsize=4096)
def positions(text: str) -> tuple[tuple[float, float, int, int], ...]:
    """Pairs of neighbouring numbers that can be coordinates, as (x, y, start, end), whatever form they are written in.

    A pair is read both as it stands and by its directions: "40 south 12 east" is also (12, -40).
    """
    found = []
    numbers = quantities(text)
    for first, second in itertools.pairwise(numbers):
        between = text[first.end : second.start]
        if not _BETWEEN.fullmatch(between):
            continue
        behind = text[second.end : second.end + 8].lower()
        one, two = _directed(first, between.lower()), _directed(second, behind)
        found.append((one[0], two[0], first.start, second.end))
        if one[1] == "y" or two[1] == "x" or re.search(r"y\s*[=:]?\s*-?$", text[: first.start].lower()):
            found.append((two[0], one[0], first.start, second.end))
    return tuple(found)


def _directed(quantity: Quantity, behind: str) -> tuple[float, str | None]:
    """The coordinate with the sign of the direction said behind it, and the axis that the direction gives."""
    match = re.match(r"\s*(?:m|metres?|meters?)?\s*(east|west|north|south)", behind)
    if match is None:
        return quantity.said, None
    sign = -1 if match[1] in ("west", "south") else 1
    return sign * quantity.said, "x" if match[1] in ("east", "west") else "y"


def states_position(text: str, position: list[float]) -> bool:
    """Whether the coordinates occur in the text as a pair, in this order."""
    return any(close(x, position[0]) and close(y, position[1]) for x, y, _start, _end in positions(text))
