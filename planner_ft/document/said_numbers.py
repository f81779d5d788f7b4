"""Numbers, bearings and places of a command, found by their value."""

from __future__ import annotations

import bisect
import itertools
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from planner_ft.data.quantities import COMPASS, SHORT, Quantity, close, positions, quantities
from planner_ft.data.stated import rewritings

Span = tuple[int, int]
EXACT = 1e-4
"""Relative: how far converted values may lie off what was said, beside their rounding."""
ROUNDED = 0.0051
WRITTEN, BARE, IN_PAIR, AS_BEFORE, REREAD = range(5)
"""How plainly words say a number: with its unit, without, as half of a pair, in the unit of another
number, in another reading of the text.
"""

BEARING = re.compile(
    r"(?i:(?<![\w-])(?:(?:north|south|east|west)[ -]?){1,3}(?:erly|wards?|ern|["
    r" -]?bound)?(?![\w-]))|\b(?:[NSEW]{1,3}|[ns][ns]?[ew]|[ew][ns][ew])\b"
)
_BEARING_ENDING = re.compile(r"(?:erly|wards?|ern|[ -]?bound)$")
_SIGN = re.compile(r"(?:[-−–]|\b(?:minus|negative)\s+)$", re.IGNORECASE)
_WAY = re.compile(
    r"\s*(?:m(?:et(?:re|er)s?)?)?\s*(?:(?:to the |due"
    r" )?(?:east|west|north|south)(?:ings?|wards?)?|[EWNSewns])\b"
)
_OPENED = re.compile(r"[\[(]\s*(?:[-−–]|minus |negative )?$")
_LED = re.compile(
    r"\b(?:at|to|near|around|from|on|cent(?:re|er)|@)\W{0,3}(?:[-−–]|minus |negative )?$",
    re.IGNORECASE,
)
_PLAIN = re.compile(r"\d+(?:\.\d+)?\s*(?:,\s*|\s)(?:[-−–]|minus |negative )?\d+(?:\.\d+)?")
_AXES = re.compile(
    r"(?<![a-z])y\s?[=:]?\s?(?:[-−–]|minus )?\d|\d\s?(?:east|west|north|south)\b.*\d", re.IGNORECASE
)


@dataclass(frozen=True, order=True)
class Found:
    """A value that words of the command say; a lower rank is a plainer way."""

    value: float
    rank: int
    span: Span


def same(written: float, said: float) -> bool:
    """Whether a written value is the one that was said, up to the rounding of conversions."""
    return close(said, written) or abs(said - written) <= EXACT * abs(said)


def lookup(found: list[Found], value: float) -> list[Found]:
    """The plainest of the sorted entries that say a value."""
    margin = max(ROUNDED, 2 * EXACT * abs(value))
    first = bisect.bisect_left(found, value - margin, key=lambda item: item.value)
    fitting = [
        item
        for item in itertools.takewhile(lambda item: item.value <= value + margin, found[first:])
        if same(value, item.value)
    ]
    best = min((item.rank for item in fitting), default=0)
    return [item for item in fitting if item.rank == best]


def find_numbers(text: str, unit: str | None, *, bearing: bool, thorough: bool) -> Iterator[Found]:
    """What a text says in a unit. `bearing` takes compass directions, too; `thorough` other
    readings: misspelt, without an article.
    """
    pairs = sorted({(start, end) for _x, _y, start, end in positions(text)})
    for quantity in summed(quantities(text)):
        span = (
            _sign_start(text, quantity.start) if quantity.said < 0 else quantity.start,
            quantity.end,
        )
        if quantity.unit == unit:
            yield Found(
                quantity.value,
                WRITTEN if unit is not None else IN_PAIR if _within(pairs, span[0]) else BARE,
                span,
            )
        elif quantity.unit is None:
            yield Found(quantity.value, IN_PAIR if _within(pairs, span[0]) else BARE, span)
            # "0.25 overlap"; "for an hour and ten minutes, a reading every five"
            factors = {"%": ((100, BARE),), "s": ((60, AS_BEFORE), (3600, AS_BEFORE))}.get(
                unit or "", ()
            )
            yield from (Found(factor * quantity.value, rank, span) for factor, rank in factors)
    if bearing:
        named = ((match, bearing_of(match[0])) for match in BEARING.finditer(text))
        yield from (
            Found(angle, WRITTEN, match.span()) for match, angle in named if angle is not None
        )
    if thorough:
        yield from _reread(text, unit)


def _reread(text: str, unit: str | None) -> Iterator[Found]:
    for other in rewritings(text)[1:]:
        for quantity in summed(quantities(other)):
            span = (
                _original(text, other, (quantity.start, quantity.end))
                if quantity.unit in (unit, None)
                else None
            )
            if span is not None:
                yield Found(quantity.value, REREAD + (quantity.unit is None), span)


def _original(text: str, rewritten: str, span: Span) -> Span | None:
    """A span of a rewriting in the text itself: what is the same before and behind stays where it
    is.
    """
    before = next(
        (
            index
            for index, (one, other) in enumerate(zip(text, rewritten, strict=False))
            if one != other
        ),
        min(len(text), len(rewritten)),
    )
    most = min(len(text), len(rewritten)) - before
    behind = next(
        (index for index in range(most) if text[-1 - index] != rewritten[-1 - index]), most
    )
    shift = len(text) - len(rewritten)
    start = span[0] if span[0] <= before else max(span[0] + shift, before)
    end = span[1] + shift if span[1] >= len(rewritten) - behind else len(text) - behind
    return (start, end) if start < end else None


def summed(found: Iterable[Quantity]) -> Iterator[Quantity]:
    """The quantities, and neighbouring durations as one: "two minutes and thirty seconds"."""
    quantities_ = list(found)
    yield from quantities_
    for first, second in itertools.pairwise(quantities_):
        if first.unit == second.unit == "s" and second.start - first.end <= 5:
            yield Quantity(first.value + second.value, "s", first.start, second.end, first.said)


def bearing_of(words: str) -> float | None:
    """Degrees of a compass direction as `BEARING` finds it."""
    if words.upper() in SHORT:
        return 22.5 * SHORT.index(words.upper())
    name = _BEARING_ENDING.sub("", words.lower().strip(" -")).replace(" ", "-")
    name = re.sub(r"(north|south)(east|west)$", r"\1-\2", name)
    return 22.5 * COMPASS.index(name) if name in COMPASS else None


# ---------------------------------------------------------------- places


def find_places(text: str) -> Iterator[tuple[float, float, Span]]:
    """(x, y, words) of the pairs that can be coordinates: both numbers, with their signs and
    directions.
    """
    for x, y, start, end in positions(text):
        yield x, y, (_sign_start(text, start), _way_end(text, start, end))


def is_place(text: str, start: int, end: int) -> bool:
    """Whether two neighbouring numbers are certainly coordinates: in brackets, with axes or
    directions, or behind a word like "at".
    """
    before = text[max(0, start - 16) : start]
    if _OPENED.search(before):
        return True
    said = text[start:end]
    return (_LED.search(before) is not None and _PLAIN.fullmatch(said) is not None) or _AXES.search(
        said
    ) is not None


def _within(spans: list[Span], place: int) -> bool:
    index = bisect.bisect_right(spans, place, key=lambda span: span[0])
    return any(start <= place < end for start, end in spans[max(0, index - 2) : index])


def _sign_start(text: str, start: int) -> int:
    sign = _SIGN.search(text, max(0, start - 12), start)
    return sign.start() if sign else start


def _way_end(text: str, start: int, end: int) -> int:
    """The end of a coordinate with its direction, where the one before has a direction, too: "120
    east 45 north", but not "40, 40 due east".
    """
    way = _WAY.match(text, end) if BEARING.search(text, start, end) else None
    return way.end() if way else end
