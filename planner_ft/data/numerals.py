"""English numerals and units in a row of tokens: "ninety-five", "one point two", "a hundred and
twenty metres".
"""

from __future__ import annotations

import functools
import re

from planner_ft.data.words import edit_distance

UNITS: dict[str, tuple[str, float]] = {
    **dict.fromkeys(("s", "sec", "secs", "second", "seconds"), ("s", 1.0)),
    **dict.fromkeys(("min", "mins", "minute", "minutes"), ("s", 60.0)),
    **dict.fromkeys(("h", "hr", "hrs", "hour", "hours"), ("s", 3600.0)),
    **dict.fromkeys(("day", "days"), ("s", 86400.0)),
    **dict.fromkeys(("m", "metre", "metres", "meter", "meters"), ("m", 1.0)),
    **dict.fromkeys(
        ("km", "kilometre", "kilometres", "kilometer", "kilometers", "klick", "klicks"),
        ("m", 1000.0),
    ),
    **dict.fromkeys(("cm", "centimetre", "centimetres", "centimeter", "centimeters"), ("m", 0.01)),
    **dict.fromkeys(("mm", "millimetre", "millimetres", "millimeter", "millimeters"), ("m", 0.001)),
    **dict.fromkeys(("nm", "nmi", "mile", "miles"), ("m", 1852.0)),
    **dict.fromkeys(("ft", "foot", "feet"), ("m", 0.3048)),
    **dict.fromkeys(("yd", "yds", "yard", "yards"), ("m", 0.9144)),
    **dict.fromkeys(("inch", "inches"), ("m", 0.0254)),
    **dict.fromkeys(("fathom", "fathoms"), ("m", 1.8288)),
    **dict.fromkeys(("mps",), ("m/s", 1.0)),
    **dict.fromkeys(("mph",), ("m/s", 1609.344 / 3600)),
    **dict.fromkeys(("kmh", "kph"), ("m/s", 1 / 3.6)),
    **dict.fromkeys(("kn", "kt", "kts", "knot", "knots"), ("m/s", 1852 / 3600)),
    **dict.fromkeys(("deg", "degree", "degrees", "°"), ("deg", 1.0)),
    **dict.fromkeys(("percent", "per cent", "%"), ("%", 1.0)),
}
"""Word to the unit that parameters have and the factor to it."""

ONES = (
    *(
        "zero",
        "one",
        "two",
        "three",
        "four",
        "five",
        "six",
        "seven",
        "eight",
        "nine",
        "ten",
        "eleven",
        "twelve",
        "thirteen",
    ),
    *("fourteen", "fifteen", "sixteen", "seventeen", "eighteen", "nineteen"),
)
TENS = ("twenty", "thirty", "forty", "fifty", "sixty", "seventy", "eighty", "ninety")
SMALL = {
    **{word: float(value) for value, word in enumerate(ONES)},
    **{word: 10.0 * value for value, word in enumerate(TENS, 2)},
    "oh": 0.0,
    "fourty": 40.0,
    "niner": 9.0,
    "couple": 2.0,
}
SCALES = {"dozen": 12.0, "score": 20.0, "hundred": 100.0, "thousand": 1000.0}
FRACTIONS = {"half": 0.5, "quarter": 0.25, "third": 1 / 3}
PARTS = {**FRACTIONS, "quarters": 0.25, "thirds": 1 / 3}
ORDINALS = {
    name: 1 / value
    for value, names in enumerate(
        (
            "fifth",
            "sixth",
            "seventh",
            "eighth",
            "ninth",
            "tenth",
            "eleventh",
            "twelfth",
            "thirteenth",
            "fourteenth",
            "fifteenth",
        ),
        5,
    )
    for name in (names, f"{names}s")
} | {"twentieth": 0.05, "twentieths": 0.05, "third": 1 / 3, "thirds": 1 / 3}
"""Parts of a unit: "a tenth of an hour". Elsewhere these words count steps."""
AND = ("and", "n", "&")
BESIDE_UNIT = ("-", "of", "a", "an", "full", "whole", "good", "solid", "nautical")
"""Words that may stand between a number and its unit: "ten-minute", "half an hour", "a full
hour".
"""

_MIXED = {"1/2": 0.5, "1/4": 0.25, "3/4": 0.75}

_TOKEN = re.compile(
    r"\d{1,3},\d{3}(?=\s?(?:m|metres|meters|s|seconds)\b)|(?:1/[2-9]|2/[3579]|3/[4578]|4/5|5/[68]|7/8)(?!\d)|\d*\.\d+|\d+|[a-z°]+(?:'[a-z]+)?|(?<![a-z])[-−–]|[-−–](?![a-z])|[^\s\w−–-]",
    re.IGNORECASE,
)
"""A hyphen between letters is no token: "ninety-five" is ninety five."""

Token = tuple[str, int, int]
"""Lower-case text, start, end."""


def signed(digits: str) -> float:
    """The number that `digits` say; its minus may be a dash. Raises ValueError for anything
    else.
    """
    return float(digits.replace("−", "-").replace("–", "-"))


def tokenize(text: str) -> list[Token]:
    """Numbers, words and signs of a text; digits and letters that stand together ("5m", "39E") are
    apart.
    """
    return [(match.group().lower(), match.start(), match.end()) for match in _TOKEN.finditer(text)]


def word_at(tokens: list[Token], index: int) -> str:
    """The token's text, or an empty one outside the row."""
    return tokens[index][0] if 0 <= index < len(tokens) else ""


def number_at(tokens: list[Token], index: int) -> tuple[float, int]:
    """The number that begins at `index` and how many tokens it takes; no token where no number
    begins.
    """
    word, following = word_at(tokens, index), word_at(tokens, index + 1)
    if word[:1].isdigit() or (word[:1] == "." and word[1:].isdigit()):
        above, _, below = word.replace(",", "").partition("/")
        if word.isdigit() and following in _MIXED and unit_at(tokens, index + 2)[0]:
            return float(word) + _MIXED[following], 2
        return _and_a_half(tokens, index, float(above) / float(below or 1), 1)
    if word in FRACTIONS:
        dozen = index + 1 + (following in ("a", "of"))
        return (
            (12 * FRACTIONS[word], dozen + 1 - index)
            if word_at(tokens, dozen) == "dozen"
            else (FRACTIONS[word], 1)
        )
    if word in ("a", "an", "per", "each", "every"):
        if _is_part(tokens, index + 1):
            return ORDINALS[following], 2
        if following in (*SCALES, "couple"):
            value, used = _in_words(tokens, index + 1, 0.0)
            return value, used + 1
        # A letter alone is rather a name or an article than a unit.
        return (1.0, 1) if len(following) > 2 and unit_at(tokens, index + 1)[0] else (0.0, 0)
    if word not in SMALL and word not in SCALES:
        return 0.0, 0
    value, used = _spelled_out(tokens, index) or _in_words(tokens, index, 0.0)
    if _is_part(tokens, index + used):
        return value * ORDINALS[word_at(tokens, index + used)], used + 1
    if word_at(tokens, index + used) in PARTS:
        return value * PARTS[word_at(tokens, index + used)], used + 1
    return _and_a_half(tokens, index, value, used)


def _is_part(tokens: list[Token], index: int) -> bool:
    """Whether an ordinal stands for a part of a unit: "tenth of an hour", "eighth of a turn"."""
    return (
        word_at(tokens, index) in ORDINALS
        and word_at(tokens, index + 1) == "of"
        and word_at(tokens, index + 2) in ("a", "an", "the")
    )


def _spelled_out(tokens: list[Token], index: int) -> tuple[float, int] | None:
    """Digits as they are read over the radio: "one two zero", "minus two five"; two with a unit
    behind them may be "two five minute holds".
    """
    digits = ""
    while SMALL.get(word_at(tokens, index + len(digits)), 10) < 10:
        digits += str(int(SMALL[word_at(tokens, index + len(digits))]))
    two = (
        len(digits) == 2
        and digits[0] != "0"
        and (digits[1] == "0" or unit_at(tokens, index + 2)[0] is None)
    )
    return (float(digits), len(digits)) if len(digits) >= 3 or two else None


def _in_words(tokens: list[Token], index: int, current: float) -> tuple[float, int]:
    """A number in words: "one thousand six hundred and seventy-four", "one point two"."""
    start, total, seen = index, 0.0, False
    while True:
        word, skip = word_at(tokens, index), 0
        if seen and word in AND and (current >= 100 or (total and not current)):
            skip, word = 1, word_at(tokens, index + 1)
        if word in SMALL and (not seen or _joins(current, SMALL[word], total)):
            current += SMALL[word]
        elif word in ("hundred", "dozen", "score"):
            current = max(current, 1) * SCALES[word]
        elif word == "thousand":
            total, current = total + max(current, 1) * 1000, 0.0
        else:
            break
        seen = True
        index += 1 + skip
    decimals, used = _decimals(tokens, index) if seen else (0.0, 0)
    return total + current + decimals, index + used - start


def _joins(current: float, following: float, total: float) -> bool:
    """Whether `following` continues the number: five after twenty, twenty after a hundred, six
    after a thousand.
    """
    if current == 0:
        return total > 0
    if current >= 100 and current % 100 == 0:
        return following < 100
    return current >= 20 and current % 10 == 0 and 0 < following < 10


def _decimals(tokens: list[Token], index: int) -> tuple[float, int]:
    digits = ""
    if word_at(tokens, index) in ("point", "decimal"):
        while SMALL.get(word_at(tokens, index + 1 + len(digits)), 10) < 10:
            digits += str(int(SMALL[word_at(tokens, index + 1 + len(digits))]))
    return (float(f"0.{digits}"), len(digits) + 1) if digits else (0.0, 0)


def _and_a_half(tokens: list[Token], index: int, value: float, used: int) -> tuple[float, int]:
    fraction, more = half_behind(tokens, index + used)
    return value + fraction, used + more


def half_behind(tokens: list[Token], index: int) -> tuple[float, int]:
    """What "and a half" adds when it stands at `index`, and its tokens; "and half" does as well,
    and so do "and three quarters", "and two thirds".
    """
    if word_at(tokens, index) not in AND:
        return 0.0, 0
    several, part = (
        {"three": 3, "two": 2}.get(word_at(tokens, index + 1), 0),
        word_at(tokens, index + 2),
    )
    if several and part in ("quarters", "thirds", "quarter", "third") and several * PARTS[part] < 1:
        # "And three quarters of a turn" is something else.
        whole = word_at(tokens, index + 3) not in ("of", "turn", "turns", "circle", "circles") and (
            part.endswith("s") or unit_of(word_at(tokens, index + 3))
        )
        return (several * PARTS[part], 3) if whole else (0.0, 0)
    if word_at(tokens, index + 1) in _MIXED:
        return _MIXED[word_at(tokens, index + 1)], 2
    place = index + 1 + (word_at(tokens, index + 1) in ("a", "one"))
    if word_at(tokens, place + 1) in ("a", "an"):
        # "Nine minutes and half an hour" are two.
        return 0.0, 0
    return (
        (FRACTIONS[word_at(tokens, place)], place + 1 - index)
        if word_at(tokens, place) in FRACTIONS
        else (0.0, 0)
    )


def unit_at(tokens: list[Token], index: int) -> tuple[tuple[str, float] | None, int]:
    """The unit at `index`, with its factor, and the index behind it; words that may stand before it
    are passed over.
    """
    passed = 0
    while word_at(tokens, index) in BESIDE_UNIT and passed < 3:
        index, passed = index + 1, passed + 1
    unit = unit_of(word_at(tokens, index))
    return unit, index + 1


@functools.lru_cache(maxsize=4096)
def unit_of(word: str) -> tuple[str, float] | None:
    """The unit that a word means, misspelt or not: "minuets" are minutes, "horu" is an hour."""
    if word in UNITS:
        return UNITS[word]
    if word in SMALL or len(word) < 4:
        return None
    limit = 0 if len(word) == 4 else 1 if len(word) == 5 else 2
    for name, unit in UNITS.items():
        if len(name) < 4 or name[0] != word[0]:
            continue
        if sorted(word) == sorted(name) or (
            limit and len(name) >= 5 and edit_distance(word, name, limit) <= limit
        ):
            return unit
    return None
