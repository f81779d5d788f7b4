"""JSON values as Lark terminals and regular expressions, in the form in which plans are trained.

`compact_json` writes no blanks, no escape that JSON does not demand, whole numbers without a point
and fractions without closing zeros. What a grammar allows is written in the same way: one value,
one text.
"""

from __future__ import annotations

import functools
import json
from fractions import Fraction

WHOLE_DIGITS = 7
"""Digits before the point where a definition sets no range: lengths of ten thousand kilometres in
metres.
"""
DECIMALS = 4
"""Digits behind the point. Labels have two; with more than four, Python would write small numbers
with an exponent.
"""

QUOTE = '"'
CHARACTER = r'[^"\\\x00-\x1f\x7f]'
ESCAPE = r'\\(["\\bfnrt]|u00(0[0-7be-f]|1[0-9a-f]))'
FIRST = r'([^"\\\s\x00-\x1f\x7f]|\\["\\])'
"""The first character of a text that must not be blank."""


@functools.lru_cache(maxsize=4096)
def literal(text: str) -> str:
    """A Lark string that matches exactly `text`."""
    # json.dumps leaves DEL as it is, and Lark takes no control character.
    return json.dumps(text).replace("\x7f", "\\u007f")


def regex(pattern: str) -> str:
    """A Lark regular expression."""
    return "/" + pattern.replace("/", r"\/") + "/"


def quoted(text: str) -> str:
    """`text` inside a JSON string, without the quotation marks."""
    return json.dumps(text, ensure_ascii=False)[1:-1]


def escaped(text: str) -> str:
    """A regular expression that matches exactly `text`."""
    return "".join(
        letter if letter.isalnum() or letter in " _" else rf"\x{{{ord(letter):x}}}"
        for letter in text
    )


def string(longest: int, *, blank: bool) -> str:
    """A JSON string of at most `longest` characters; without `blank` it begins with one that is no
    blank.
    """
    rest = longest if blank else longest - 1
    return regex(rf'"{"" if blank else FIRST}({CHARACTER}|{ESCAPE}){{0,{rest}}}"')


# ---------------------------------------------------------------- numbers

_FRACTION = rf"\.[0-9]{{0,{DECIMALS - 1}}}[1-9]"
ANY_INTEGER = rf"(0|-?[1-9][0-9]{{0,{WHOLE_DIGITS - 1}}})"
ANY_NUMBER = rf"({ANY_INTEGER}|-?(0|[1-9][0-9]{{0,{WHOLE_DIGITS - 1}}}){_FRACTION})"
ANY_POSITION = rf"\[{ANY_NUMBER},{ANY_NUMBER}\]"
SUMS = r"[xy0-9.+/=;\-]"
"""Signs of a working (see planner_ft.data.task.working). Its form is not enforced: where sums are
read, wrong ones derive nothing.
"""


@functools.lru_cache(maxsize=1024)
def number_range(minimum: float | None, maximum: float | None, *, whole: bool) -> str:
    """A regular expression for the numbers from `minimum` to `maximum`, both given or neither, with
    at most DECIMALS decimals.
    """
    if minimum is None or maximum is None:
        return ANY_INTEGER if whole else ANY_NUMBER
    low, high = Fraction(str(minimum)), Fraction(str(maximum))
    options = []
    if high >= 0:
        options += _from_to(max(low, Fraction(0)), high, whole=whole)
    if low < 0:
        options += [
            f"-{option}"
            for option in _from_to(max(-high, Fraction(0)), -low, whole=whole, zero=False)
        ]
    return f"({'|'.join(options)})"


def _from_to(low: Fraction, high: Fraction, *, whole: bool, zero: bool = True) -> list[str]:
    """Patterns of the numbers from `low` to `high`, neither below nought; `zero` says whether
    nought is one of them.
    """
    first = max(-(-low // 1), 0 if zero else 1)
    options = _integers(first, high // 1)
    if whole:
        return options
    first, last = low // 1, high // 1
    inner_first, inner_last = (first if low == first else first + 1), last - 1
    options += [f"{option}{_FRACTION}" for option in _integers(inner_first, inner_last)]
    # The whole numbers at both ends, where only some fractions lie in the range.
    for end in sorted({first, last}):
        if inner_first <= end <= inner_last:
            continue
        options += _fractions(end, max(low - end, Fraction(0)), min(high - end, Fraction(1)))
    return options


def _fractions(whole: int, low: Fraction, high: Fraction) -> list[str]:
    """Patterns of `whole` with a fraction between `low` and `high`, which lie between 0 and 1."""
    options = []
    for digits in range(1, DECIMALS + 1):
        scale = 10**digits
        first, last = max(-(-low * scale // 1), 1), min(high * scale // 1, scale - 1)
        if first <= last:
            options.append(
                rf"{whole}\.{_same_length(str(first).zfill(digits), str(last).zfill(digits))}"
            )
    return options


def _integers(low: int, high: int) -> list[str]:
    """Patterns of the whole numbers from `low` to `high`, one for each number of digits."""
    options = []
    for digits in range(len(str(low)), len(str(max(high, 0))) + 1):
        first, last = max(low, 10 ** (digits - 1) if digits > 1 else 0), min(high, 10**digits - 1)
        if first <= last:
            options.append(_same_length(str(first), str(last)))
    return options


def _same_length(low: str, high: str) -> str:
    """A pattern of the digit strings from `low` to `high`, which are equally long."""
    if not low:
        return ""
    if low[0] == high[0]:
        return low[0] + _same_length(low[1:], high[1:])
    rest = len(low) - 1
    first, last, options = int(low[0]), int(high[0]), []
    if low[1:].strip("0"):
        options.append(low[0] + _same_length(low[1:], "9" * rest))
        first += 1
    if high[1:].strip("9"):
        options.append(high[0] + _same_length("0" * rest, high[1:]))
        last -= 1
    if first <= last:
        options.append(f"[{first}-{last}]" + (f"[0-9]{{{rest}}}" if rest else ""))
    return f"({'|'.join(options)})"
