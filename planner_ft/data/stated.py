"""Every value that an English command can be taken to state, where quantities.py reads the most
probable one.

People drop articles ("for hour or so"), write "4" for "for", misspell units and say two numbers in
a row, so that "seventy one hundred and eighty" is 71 180 or 70 and 180. Each such reading is the
text written out in another way (`rewritings`); a value is stated when one of them states it.
"""

from __future__ import annotations

import functools
import itertools
import re
from collections.abc import Iterator

from planner_ft.data.lexicon import corrections
from planner_ft.data.numerals import (
    BESIDE_UNIT,
    FRACTIONS,
    PARTS,
    SCALES,
    SMALL,
    UNITS,
    Token,
    number_at,
    tokenize,
    unit_of,
    word_at,
)
from planner_ft.data.quantities import (
    TURNS,
    Quantity,
    bearings,
    close,
    positions,
    quantities,
    turns,
)

MOST_REWRITINGS = 24
LARGEST = 1e9
"""Longer rows of digits are no values."""
NUMERALS = frozenset([*SMALL, *SCALES, *PARTS, *TURNS])
ARTICLES = ("a", "an", "per", "each", "every", "one")
WHOLE = ("full", "whole", "good", "solid")
BARE_UNITS = ("minute", "hour", "metre", "meter", "kilometre", "kilometer", "day", "mile")
"""Units that are said without a number in telegram style; "second" is rather an ordinal."""
VULGAR = {"½": 0.5, "¼": 0.25, "¾": 0.75, "⅓": 1 / 3, "⅔": 2 / 3, "⅛": 0.125}

_VULGAR = re.compile(rf"(\d*)\s?([{''.join(VULGAR)}])")
_SPEAK = re.compile(
    rf"(?<![\w.,-])[24](?= (?:an?|the|another|total|space|\d|{'|'.join([*SMALL, *FRACTIONS])})\b)",
    re.IGNORECASE,
)
_THOUSANDS = re.compile(r"(?<![\d.,])\d{1,3}(?:,\d{3})+(?![\d.])")
_CLOCK = re.compile(r"(?<![\d:])(\d{1,3}):([0-5]\d)(?![\d:])")
_EVERY = re.compile(r"\b(?:every|each|per)\s+$", re.IGNORECASE)
_SMALL_SOUTH = re.compile(
    r"(\d\s?[ew]\W{1,5}\d+(?:\.\d+)?\s?)s(?![a-z])|(?<![\w.])(\d+(?:\.\d+)?\s?)s(?=\W{1,5}\d+(?:\.\d+)?\s?[ew](?![a-z]))"
)
_HALF = re.compile(
    r"\band (?:a )?half[ -](hour|minute|kilometre|kilometer|mile|metre|meter)\b", re.IGNORECASE
)
_NUMBER_ARTICLE = re.compile(
    r"(\d) (an? (?:hour|minute|kilometre|kilometer|mile|metre|meter|day)\b)", re.IGNORECASE
)
_DIGITS = {
    word: str(int(value)) for word, value in SMALL.items() if value < 10 and word != "couple"
}
_RADIO = re.compile(
    rf"\b({'|'.join(_DIGITS)}) ({'|'.join(_DIGITS)})(?="
    rf" ({'|'.join(unit for unit in UNITS if len(unit) > 2)})\b)",
    re.IGNORECASE,
)
_AXIS_RADIO = re.compile(
    rf"\b([xy] (?:minus |negative )?)({'|'.join(_DIGITS)}) ({'|'.join(_DIGITS)})\b(?!"
    rf" (?:{'|'.join(_DIGITS)})\b)",
    re.IGNORECASE,
)
"""A coordinate of two digits: "x five five"."""
_TENS = {word: int(value) for word, value in SMALL.items() if value >= 10}
_NONZERO = "|".join(word for word in _DIGITS if word not in ("zero", "oh"))
_HUNDREDS = re.compile(
    rf"\b({_NONZERO})[ -]({'|'.join(_TENS)})(?:[ -]({_NONZERO}))?\b", re.IGNORECASE
)
_PRONOUNCED = {
    "wun": "one",
    "tree": "three",
    "fower": "four",
    "fife": "five",
    "ait": "eight",
    "niner": "nine",
}
_SAID_SO = re.compile(
    rf"\b({'|'.join(_PRONOUNCED)})(?="
    rf" (?:{'|'.join([*_DIGITS, *_PRONOUNCED])}|[a-z]*(?:metres?|meters?|minutes?|seconds?|degrees?|hours?))\b)",
    re.IGNORECASE,
)
"""Digits as radio procedure has them pronounced, before another one or a unit: a tree is a tree
elsewhere.
"""
_HYPHENED = re.compile(
    rf"\b({'|'.join([*_DIGITS, *_PRONOUNCED])})-(?=(?:{'|'.join([*_DIGITS, *_PRONOUNCED])})\b)",
    re.IGNORECASE,
)
"""A digit that a hyphen ties to the next: "one-eight-zero"."""
_PAIRED = re.compile(
    rf"(?<![\w-])({'|'.join([*_DIGITS, *_PRONOUNCED])})-({'|'.join([*_DIGITS, *_PRONOUNCED])})(?![\w-])",
    re.IGNORECASE,
)
"""Two digits that a hyphen ties together, and no others: "minus three-zero"."""
CABLES = re.compile(r"[ -](?:of )?(?:an? )?cables?(?:[ -]lengths?)?\b", re.IGNORECASE)
FOOT = 0.3048
CABLE = 185.2
"""Metres in a cable, a tenth of a nautical mile."""
POINTS = re.compile(
    r" points?(?: of the compass)?,? (?:further |more )?(?:to (?:the"
    r" )?(?:starboard|port|left|right)|of the compass|(?:off|on|abaft|before) the)\b",
    re.IGNORECASE,
)
POINT = 11.25
"""Degrees in a point of the compass, a thirty-second of the circle."""
_EXPONENT = re.compile(r"(?<![\w.])\d+(?:\.\d+)?e\+?\d{1,2}(?!\w)", re.IGNORECASE)


@functools.lru_cache(maxsize=1024)
def rewritings(text: str) -> tuple[str, ...]:
    """The text, and the ways in which it can be written out otherwise; at most MOST_REWRITINGS in
    all.
    """
    text = _VULGAR.sub(lambda match: f" {float(match[1] or 0) + VULGAR[match[2]]:g}", text)
    text = _SAID_SO.sub(lambda match: _PRONOUNCED[match[1].lower()], unhyphened(text))
    found = dict.fromkeys([text])
    makers = (
        _with_numerals,
        _with_units,
        _with_articles,
        _thousands,
        _clock,
        _south,
        _apart,
        _speak,
        _radio,
        _hundreds,
        _cuts,
    )
    for maker in makers:
        for known in list(found) if maker is not _cuts else [*found][:3]:
            found.update(dict.fromkeys(itertools.islice(maker(known), MOST_REWRITINGS)))
    return tuple(itertools.islice(found, MOST_REWRITINGS))


@functools.lru_cache(maxsize=4096)
def stated_numbers(text: str, unit: str | None) -> frozenset[float]:
    """Values of a parameter in `unit` that the text states. A number said in another unit does not
    count.
    """
    values = (
        value
        for reading in rewritings(text)
        for value in _numbers(reading, "deg" if unit == "degC" else unit)
    )
    return frozenset(value for value in values if abs(value) < LARGEST)


@functools.lru_cache(maxsize=1024)
def stated_positions(text: str) -> tuple[tuple[float, float], ...]:
    """Coordinates (x, y) that the text states."""
    found = ((x, y) for reading in rewritings(text) for x, y, _start, _end in positions(reading))
    return tuple(dict.fromkeys((x, y) for x, y in found if max(abs(x), abs(y)) < LARGEST))


def states_number(text: str, value: float, unit: str | None) -> bool:
    """Whether `value` in a parameter's `unit` can come from the text. A bearing counts in any turn
    of the compass.
    """
    if any(close(said, value) for said in stated_numbers(text, unit)):
        return True
    return unit == "deg" and (
        value % 360 in bearings(text) or any(close(turn, abs(value)) for turn in turns(text))
    )


def states_position(text: str, position: list[float]) -> bool:
    """Whether the coordinates occur in the text as a pair, in this order."""
    return any(close(x, position[0]) and close(y, position[1]) for x, y in stated_positions(text))


def unhyphened(text: str) -> str:
    """A text with "one-eight-zero" in words apart, and "three-zero" in figures; "two-three" is a
    choice.
    """
    return _HYPHENED.sub(r"\1 ", _PAIRED.sub(_two_digits, text))


def _two_digits(match: re.Match[str]) -> str:
    first, second = (
        int(_DIGITS[_PRONOUNCED.get(word.lower(), word.lower())]) for word in match.groups()
    )
    return match[0] if second == first + 1 or first == 0 else f"{first}{second}"


def radio_digits(text: str) -> str:
    """A text with "lanes one five metres apart", as it is said over the radio, in figures; three
    digits and more are read so anyway.
    """
    plain = _SAID_SO.sub(lambda match: _PRONOUNCED[match[1].lower()], text)
    plain = _AXIS_RADIO.sub(
        lambda match: match[1] + _DIGITS[match[2].lower()] + _DIGITS[match[3].lower()], plain
    )
    return _RADIO.sub(lambda match: _DIGITS[match[1].lower()] + _DIGITS[match[2].lower()], plain)


def _numbers(text: str, unit: str | None) -> Iterator[float]:
    numbers = quantities(text)
    parts = _parts_of_durations(text, numbers) if unit == "s" else set()
    yield from (
        quantity.value
        for quantity in numbers
        if quantity.unit in (unit, None) and quantity not in parts
    )
    yield from (float(match) for match in _EXPONENT.findall(text))
    if unit == "s":
        yield from _durations(numbers)
        yield from _repeated(text, numbers)
    elif unit == "m":
        yield from _lengths(numbers)
        yield from (
            quantity.value * CABLE
            for quantity in numbers
            if quantity.unit is None and CABLES.match(text, quantity.end)
        )
    elif unit == "%":
        yield from (
            100 * quantity.value
            for quantity in numbers
            if quantity.unit is None and quantity.value < 1
        )
    elif unit == "m/s":
        yield from _speeds(text, numbers)
    elif unit == "deg":
        yield from bearings(text)
        yield from turns(text)
        yield from (
            quantity.value * POINT
            for quantity in numbers
            if quantity.unit is None and POINTS.match(text, quantity.end)
        )


def _parts_of_durations(text: str, numbers: tuple[Quantity, ...]) -> set[Quantity]:
    """The parts of "2 h 20 min": durations side by side, the longer unit first, which are said as
    one.
    """
    found: set[Quantity] = set()
    for first, second in itertools.pairwise(numbers):
        joined = (
            first.unit == second.unit == "s"
            and first.said > 0
            and second.said > 0
            and text[first.end : second.start] in (" ", "")
        )
        if (
            joined
            and first.value / first.said > second.value / second.said
            and second.value < first.value / first.said
        ):
            found |= {first, second}
    return found


def _durations(numbers: tuple[Quantity, ...]) -> Iterator[float]:
    """Sums of neighbouring durations: "two minutes and thirty seconds", "1 h 20 min", "5 minutes
    30".
    """
    for first, second in itertools.pairwise(numbers):
        gap = second.start - first.end
        if first.unit == second.unit == "s" and gap <= 5:
            yield first.value + second.value
        elif first.unit == "s" and second.unit is None and gap <= 1 and first.said:
            yield first.value + second.value * first.value / first.said / 60


def _lengths(numbers: tuple[Quantity, ...]) -> Iterator[float]:
    """Sums of feet and inches: "2 feet 6 inches", "two foot six"."""
    for first, second in itertools.pairwise(numbers):
        feet = (
            first.unit == "m"
            and first.said
            and abs(first.value / first.said - FOOT) < 1e-6
            and second.start - first.end <= 5
        )
        if (
            feet
            and 0 < second.said < 12
            and (second.unit is None or abs(second.value / second.said - FOOT / 12) < 1e-6)
        ):
            yield first.value + second.said * FOOT / 12


def _repeated(text: str, numbers: tuple[Quantity, ...]) -> Iterator[float]:
    """ "for an hour and ten minutes, a reading every five": minutes, or hours, as said before."""
    factors = {
        quantity.value / quantity.said
        for quantity in numbers
        if quantity.unit == "s" and quantity.said
    }
    for quantity in numbers:
        if quantity.unit is None and _EVERY.search(text[: quantity.start]):
            yield from (quantity.value * factor for factor in factors)


def _speeds(text: str, numbers: tuple[Quantity, ...]) -> Iterator[float]:
    """Lengths with a unit of time right behind them: "one metre second"."""
    for quantity in numbers:
        behind = re.match(r"[\s,/]*([a-z]+)", text[quantity.end :], re.IGNORECASE)
        unit = unit_of(behind[1].lower()) if behind and quantity.unit == "m" else None
        if unit and unit[0] == "s":
            yield quantity.value / unit[1]


# ---------------------------------------------------------------- other ways of writing a text


def _thousands(text: str) -> Iterator[str]:
    if _THOUSANDS.search(text):
        yield _THOUSANDS.sub(lambda match: match[0].replace(",", ""), text)


def _clock(text: str) -> Iterator[str]:
    """ "2:30" as minutes and as hours."""
    if _CLOCK.search(text):
        yield _CLOCK.sub(r"\1 minutes \2 seconds", text)
        yield _CLOCK.sub(r"\1 hours \2 minutes", text)


def _speak(text: str) -> Iterator[str]:
    """ "4 an hour" as "for an hour", "2 the pier" as "to the pier"."""
    if _SPEAK.search(text):
        yield _SPEAK.sub(lambda match: "for" if match[0] == "4" else "to", text)


def _radio(text: str) -> Iterator[str]:
    if _RADIO.search(text) or _AXIS_RADIO.search(text):
        yield radio_digits(text)


def _hundreds(text: str) -> Iterator[str]:
    """ "one eighty" as 180, "two twenty-five" as 225."""

    def number(match: re.Match[str]) -> str:
        hundreds, tens, ones = (part.lower() if part else "" for part in match.groups())
        return str(100 * int(_DIGITS[hundreds]) + _TENS[tens] + int(_DIGITS.get(ones, "0")))

    if _HUNDREDS.search(text):
        yield _HUNDREDS.sub(number, text)


def _south(text: str) -> Iterator[str]:
    """ "33w 15s" as coordinates, not as seconds."""
    if _SMALL_SOUTH.search(text):
        yield _SMALL_SOUTH.sub(lambda match: f"{match[1] or match[2]}S", text)


def _with_numerals(text: str) -> Iterator[str]:
    """Number words with their spelling put right: "quartesr", "thrity", "onec"; and "secotrs",
    which are no seconds.
    """
    for word, start, end in tokenize(text):
        if len(word) > 3 and word.isalpha() and word not in UNITS:
            meant = corrections(word)
            numerals = [other for other in meant if other in NUMERALS]
            if not numerals and unit_of(word) and meant and meant[0] not in UNITS:
                numerals = [meant[0]]
            yield from (f"{text[:start]}{numeral}{text[end:]}" for numeral in numerals)


def _with_units(text: str) -> Iterator[str]:
    """Units behind a number or an article that are misspelt beyond what quantities.py takes: "two
    hous", "500 fewt", "a full hur".
    """
    tokens = tokenize(text)
    for word, start, end in (tokens[place] for place in _behind_numbers(tokens)):
        if not unit_of(word):
            for unit in corrections(word):
                if unit in UNITS:
                    yield f"{text[:start]}{unit}{text[end:]}"


def _behind_numbers(tokens: list[Token]) -> Iterator[int]:
    index = 0
    while index < len(tokens):
        _value, used = number_at(tokens, index)
        index += used or 1
        if used or word_at(tokens, index - 1) in ARTICLES:
            place = index
            while word_at(tokens, place) in BESIDE_UNIT and place < index + 3:
                place += 1
            if place < len(tokens):
                yield place


def _apart(text: str) -> Iterator[str]:
    """ "at 4 m and a half hour of film": half an hour, not four and a half metres; "from 22/0 a
    kilometre": a kilometre, not none.
    """
    if _HALF.search(text):
        yield _HALF.sub(r", half an \1", text)
    if _NUMBER_ARTICLE.search(text):
        yield _NUMBER_ARTICLE.sub(r"\1, \2", text)


def _with_articles(text: str) -> Iterator[str]:
    """Telegram style with its articles: "wait minute at each" as "wait a minute at each"."""
    tokens, places = tokenize(text), []
    for index, (word, _start, _end) in enumerate(tokens):
        unit = unit_of(word)
        if (
            unit is None
            or len(word) < 3
            or not (word in BARE_UNITS or (word not in UNITS and not word.endswith("s")))
        ):
            continue
        first = index - 1 if word_at(tokens, index - 1) in WHOLE else index
        before = word_at(tokens, first - 1)
        if not (
            before in (*ARTICLES, *SMALL, *SCALES, *FRACTIONS, "-", "/", "of")
            or before[:1].isdigit()
            or _numeric(tokens, first - 1)
        ):
            places.append(tokens[first][1])
    if places:
        cuts = [0, *places, len(text)]
        yield "a ".join(text[start:end] for start, end in itertools.pairwise(cuts))


def _numeric(tokens: list[Token], index: int) -> bool:
    return index >= 0 and number_at(tokens, index)[1] > 0


def _cuts(text: str) -> Iterator[str]:
    """Numbers in words that stand in a row, apart: "seventy one hundred and eighty" as "seventy /
    one hundred and eighty".
    """
    tokens = tokenize(text)
    for (word, _start, end), (following, start, _end) in itertools.pairwise(tokens):
        apart = text[end:start].isspace() and "\n" not in text[end:start]
        if apart and (word in SMALL or word in SCALES) and following in SMALL:
            yield f"{text[:end]} / {text[start:]}"
