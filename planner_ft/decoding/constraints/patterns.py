"""JSON values as Lark terminals and regular expressions, in the form in which plans are trained.

`compact_json` writes no blanks, no escape that JSON does not demand, whole numbers without a point
and fractions without closing zeros. What a grammar allows is written in the same way: one value,
one text.
"""

from __future__ import annotations

import functools
import json
import math
from fractions import Fraction

WHOLE_DIGITS = 7
"""Digits before the point where a definition sets no range."""
DECIMALS = 4
"""Digits behind the point; with more, Python would write small numbers with an exponent."""

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
    """A JSON string of at most `longest` characters, `blank` ones allowed at its beginning."""
    rest = longest if blank else longest - 1
    return regex(rf'"{"" if blank else FIRST}({CHARACTER}|{ESCAPE}){{0,{rest}}}"')


# ---------------------------------------------------------------- numbers

_FRACTION = rf"\.[0-9]{{0,{DECIMALS - 1}}}[1-9]"
ANY_INTEGER = rf"(0|-?[1-9][0-9]{{0,{WHOLE_DIGITS - 1}}})"
ANY_NUMBER = rf"({ANY_INTEGER}|-?(0|[1-9][0-9]{{0,{WHOLE_DIGITS - 1}}}){_FRACTION})"
ANY_POSITION = rf"\[{ANY_NUMBER},{ANY_NUMBER}\]"
CLOSING_ZEROS = r"-?[0-9]+\.[0-9]*0"
SUMS = r"[xy0-9.+/=;\-]"
"""Signs of a working (data.task.working); its form is not enforced: wrong sums derive nothing."""


@functools.lru_cache(maxsize=1024)
def number_range(minimum: float, maximum: float, *, whole: bool) -> str:
    """A regular expression for the numbers from `minimum` to `maximum` with at most DECIMALS
    decimals; closing zeros (CLOSING_ZEROS) are to be taken out.
    """
    low, high = Fraction(str(minimum)), Fraction(str(maximum))
    options = []
    for decimals in range(1 if whole else DECIMALS + 1):
        scale = 10**decimals
        least, most = math.ceil(low * scale), math.floor(high * scale)
        options += _digits(max(least, 0), most, decimals)
        options += [f"-{option}" for option in _digits(max(-most, 1), -least, decimals)]
    return f"({'|'.join(options)})"


def _digits(low: int, high: int, decimals: int) -> list[str]:
    """Patterns of whole numbers, one per number of digits, a point before the last `decimals`."""
    options = []
    for count in range(decimals + 1, max(len(str(high)), decimals + 1) + 1):
        first = max(low, 10 ** (count - 1) if count > decimals + 1 else 0)
        last = min(high, 10**count - 1)
        if first <= last:
            options.append(_between(str(first).zfill(count), str(last).zfill(count), decimals))
    return options


def _between(low: str, high: str, decimals: int) -> str:
    """A pattern of the digit strings from `low` to `high`, which are equally long."""
    if not low:
        return ""
    point = r"\." if len(low) == decimals else ""
    if low[0] == high[0]:
        return point + low[0] + _between(low[1:], high[1:], decimals)
    rest = len(low) - 1
    first, last, options = int(low[0]), int(high[0]), []
    if low[1:].strip("0"):
        options.append(low[0] + _between(low[1:], "9" * rest, decimals))
        first += 1
    if high[1:].strip("9"):
        options.append(high[0] + _between("0" * rest, high[1:], decimals))
        last -= 1
    if first <= last:
        behind = rf"[0-9]{{{rest - decimals}}}\.[0-9]{{{decimals}}}"
        plain = f"[0-9]{{{rest}}}"
        options.append(f"[{first}-{last}]" + (behind if 0 < decimals <= rest else plain))
    return f"{point}({'|'.join(options)})"
