"""English numerals and units in a row of tokens: "ninety-five", "one point two", "a hundred and
twenty metres".
"""

from __future__ import annotations

import functools
import re

from planner_ft.facts.lists import DIGITS, FRACTIONS, ORDINALS, PARTS, SCALES, SMALL, UNITS, WORDS
from planner_ft.facts.words import edit_distance

AND = WORDS["and"]
MIXED = {"1/2": 0.5, "1/4": 0.25, "3/4": 0.75}
TURNED = ("of", "turn", "turns", "circle", "circles")

_TOKEN = re.compile(
    r"\d{1,3},\d{3}(?=\s?(?:m|metres|meters|s|seconds)\b)"
    r"|(?:1/[2-9]|2/[3579]|3/[4578]|4/5|5/[68]|7/8)(?!\d)|\d*\.\d+|\d+"
    r"|[a-z°]+(?:'[a-z]+)?|(?<![a-z])[-−–]|[-−–](?![a-z])|[^\s\w−–-]",
    re.IGNORECASE,
)
"""A hyphen between letters is no token: "ninety-five" is ninety five."""

Token = tuple[str, int, int]
"""Lower-case text, start, end."""
Unit = tuple[str, float]


def signed(digits: str) -> float:
    """The number that `digits` say; its minus may be a dash. Raises ValueError for anything
    else.
    """
    return float(digits.replace("−", "-").replace("–", "-"))


def tokenize(text: str) -> list[Token]:
    """Numbers, words and signs of a text; digits and letters that stand together ("5m") are
    apart.
    """
    return [(match[0].lower(), *match.span()) for match in _TOKEN.finditer(text)]


def word_at(tokens: list[Token], index: int) -> str:
    """The token's text, or an empty one outside the row."""
    return tokens[index][0] if 0 <= index < len(tokens) else ""


def number_at(tokens: list[Token], index: int) -> tuple[float, int]:
    """The number that begins at `index` and its number of tokens; 0 where none begins."""
    word, following = word_at(tokens, index), word_at(tokens, index + 1)
    if word[:1].isdigit() or (word[:1] == "." and word[1:].isdigit()):
        if word.isdigit() and following in MIXED and unit_at(tokens, index + 2)[0]:
            return float(word) + MIXED[following], 2
        above, _, below = word.replace(",", "").partition("/")
        return _with_fraction(tokens, index, float(above) / float(below or 1), 1)
    if word in FRACTIONS:
        dozen = index + 1 + (following in ("a", "of"))
        if word_at(tokens, dozen) == "dozen":
            return 12 * FRACTIONS[word], dozen + 1 - index
        return FRACTIONS[word], 1
    if word in ("a", "an", "per", "each", "every"):
        return _behind_article(tokens, index)
    if word not in SMALL and word not in SCALES:
        return 0.0, 0
    value, used = _digit_by_digit(tokens, index) or _in_words(tokens, index)
    part = word_at(tokens, index + used)
    if _is_part(tokens, index + used) or part in PARTS:
        return value * {**ORDINALS, **PARTS}[part], used + 1
    return _with_fraction(tokens, index, value, used)


def half_behind(tokens: list[Token], index: int) -> tuple[float, int]:
    """The fraction that "and a half", "and three quarters" add at `index`, and its tokens."""
    if word_at(tokens, index) not in AND:
        return 0.0, 0
    first, second, third = (word_at(tokens, index + place) for place in (1, 2, 3))
    several = {"three": 3, "two": 2}.get(first, 0)
    if several and second.startswith(("quarter", "third")) and several * PARTS[second] < 1:
        # "And three quarters of a turn" is something else.
        whole = third not in TURNED and (second.endswith("s") or unit_of(third))
        return (several * PARTS[second], 3) if whole else (0.0, 0)
    if first in MIXED:
        return MIXED[first], 2
    place = index + 1 + (first in ("a", "one"))
    # "Nine minutes and half an hour" are two.
    if word_at(tokens, place) not in FRACTIONS or word_at(tokens, place + 1) in ("a", "an"):
        return 0.0, 0
    return FRACTIONS[word_at(tokens, place)], place + 1 - index


def unit_at(tokens: list[Token], index: int) -> tuple[Unit | None, int]:
    """The unit at `index`, with its factor, and the index behind it; words that may stand before it
    are passed over.
    """
    for _passed in range(3):
        index += word_at(tokens, index) in WORDS["beside_unit"]
    if word_at(tokens, index) == "per" and word_at(tokens, index + 1) == "cent":
        return UNITS["percent"], index + 2
    return unit_of(word_at(tokens, index)), index + 1


@functools.lru_cache(maxsize=4096)
def unit_of(word: str) -> Unit | None:
    """The unit that a word means, misspelt or not: "minuets" are minutes, "horu" is an hour."""
    if word in UNITS or word in SMALL or len(word) < 4:
        return UNITS.get(word)
    limit = 0 if len(word) == 4 else 1 if len(word) == 5 else 2
    for name, unit in UNITS.items():
        if len(name) >= 4 and name[0] == word[0]:
            near = len(name) >= 5 and limit and edit_distance(word, name, limit) <= limit
            if near or sorted(word) == sorted(name):
                return unit
    return None


def _behind_article(tokens: list[Token], index: int) -> tuple[float, int]:
    following = word_at(tokens, index + 1)
    if _is_part(tokens, index + 1):
        return ORDINALS[following], 2
    if following in SCALES or following == "couple":
        value, used = _in_words(tokens, index + 1)
        return value, used + 1
    # A letter alone is rather a name or an article than a unit.
    return (1.0, 1) if len(following) > 2 and unit_at(tokens, index + 1)[0] else (0.0, 0)


def _is_part(tokens: list[Token], index: int) -> bool:
    """Whether an ordinal stands for a part of a unit: "tenth of an hour", "eighth of a turn"."""
    word, of, article = (word_at(tokens, index + place) for place in range(3))
    return word in ORDINALS and of == "of" and article in ("a", "an", "the")


def _digits(tokens: list[Token], index: int) -> str:
    found = ""
    while word_at(tokens, index + len(found)) in DIGITS:
        found += DIGITS[word_at(tokens, index + len(found))]
    return found


def _digit_by_digit(tokens: list[Token], index: int) -> tuple[float, int] | None:
    """Digits as they are read over the radio: "one two zero", "minus two five"; two with a unit
    behind them may be "two five minute holds".
    """
    digits = _digits(tokens, index)
    two = len(digits) == 2 and digits[0] != "0"
    sure = two and (digits[1] == "0" or unit_at(tokens, index + 2)[0] is None)
    return (float(digits), len(digits)) if len(digits) >= 3 or sure else None


def _in_words(tokens: list[Token], start: int) -> tuple[float, int]:
    """A number in words: "one thousand six hundred and seventy-four", "one point two"."""
    index, total, current = start, 0.0, 0.0
    while True:
        word, skip = word_at(tokens, index), 0
        if index > start and word in AND and (current >= 100 or (total and not current)):
            word, skip = word_at(tokens, index + 1), 1
        if word in SMALL and (index == start or _joins(current, SMALL[word], total)):
            current += SMALL[word]
        elif word == "thousand":
            total, current = total + max(current, 1) * 1000, 0.0
        elif word in SCALES:
            current = max(current, 1) * SCALES[word]
        else:
            break
        index += 1 + skip
    decimals = ""
    if index > start and word_at(tokens, index) in ("point", "decimal"):
        decimals = _digits(tokens, index + 1)
    if decimals:
        return total + current + float(f"0.{decimals}"), index + 1 + len(decimals) - start
    return total + current, index - start


def _joins(current: float, following: float, total: float) -> bool:
    """Whether `following` continues the number: five after twenty, twenty after a hundred, six
    after a thousand.
    """
    if current == 0:
        return total > 0
    if current >= 100 and current % 100 == 0:
        return following < 100
    return current >= 20 and current % 10 == 0 and 0 < following < 10


def _with_fraction(tokens: list[Token], index: int, value: float, used: int) -> tuple[float, int]:
    fraction, more = half_behind(tokens, index + used)
    return value + fraction, used + more
