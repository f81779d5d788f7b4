"""JSON values as Lark terminals and regular expressions, in the form in which plans are trained.

`compact_json` writes no blanks, no escape that JSON does not demand, whole numbers without a point
and fractions without closing zeros. What a grammar allows is written in the same way: one value,
one text.
"""

import functools
import json
from decimal import Decimal

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


def any_number(*, whole: bool, digits: int = WHOLE_DIGITS) -> str:
    """A regular expression for numbers of at most `digits` digits before the point."""
    integer = rf"[1-9][0-9]{{0,{digits - 1}}}"
    fraction = rf"\.[0-9]{{0,{DECIMALS - 1}}}[1-9]"
    return rf"(0|-?{integer}" + ("" if whole else rf"|-?(0|{integer}){fraction}") + ")"


ANY_INTEGER, ANY_NUMBER = any_number(whole=True), any_number(whole=False)
ANY_POSITION = rf"\[{ANY_NUMBER},{ANY_NUMBER}\]"


@functools.lru_cache(maxsize=1024)
def number_range(minimum: float, maximum: float, *, whole: bool) -> tuple[str, list[str]]:
    """A regular expression for numbers as they are written, and those for the numbers below
    `minimum` and above `maximum`, which are to be taken out of it.
    """
    least, most = _plain(minimum), _plain(maximum)
    digits = max(len(text.lstrip("-").partition(".")[0]) for text in (least, most))
    barred = [f"-{_beyond(least[1:], 1)}"] if least[0] == "-" else ["-.*", _beyond(least, -1)]
    if most[0] == "-":
        barred += ["[0-9].*", f"-{_beyond(most[1:], -1)}"]
    else:
        barred.append(_beyond(most, 1))
    return any_number(whole=whole, digits=digits), [one for one in barred if one.strip("-")]


def _plain(number: float) -> str:
    """A number without exponent and closing zeros."""
    return f"{Decimal(str(number)) + 0:f}" if number % 1 else str(int(number))


def _beyond(bound: str, side: int) -> str:
    """Pattern of the numbers without sign above a bound (`side` 1) or below it (-1); "" for none."""
    whole, _point, part = bound.partition(".")
    more = r"(\.[0-9]+)?"
    if side > 0:
        options = [rf"[1-9][0-9]{{{len(whole)},}}{more}", rf"{whole}\.{part}[0-9]+"]
    else:
        options = [rf"[0-9]{{1,{len(whole) - 1}}}{more}"] if len(whole) > 1 else []
        options += [rf"{whole}\.{part[:place]}" if place else whole for place in range(len(part))]
    for place, digit in enumerate(whole + part):
        first, last = (int(digit) + 1, 9) if side > 0 else (0, int(digit) - 1)
        left = len(whole) - place
        same = whole[:place] if left > 0 else rf"{whole}\.{part[:-left]}"
        behind = rf"[0-9]{{{left - 1}}}{more}" if left > 0 else "[0-9]*"
        options += [f"{same}[{first}-{last}]{behind}"] if first <= last else []
    return f"({'|'.join(options)})" if options else ""
