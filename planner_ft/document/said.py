"""Where a command says a value: the words for a number, a place or a text, and whether it says it at all.

The reading is that of the decoding strength `grounded` (planner_ft.benchmark.metrics.source). A long command is read in pieces, so that the
work grows with its length and no faster.
"""

from __future__ import annotations

import bisect
import functools
import itertools
import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from planner_ft.benchmark.metrics.source import Source
from planner_ft.benchmark.metrics.values import is_number, normalised
from planner_ft.data.quantities import COMPASS, SHORT, TURNS, Quantity, close, positions, quantities
from planner_ft.data.stated import rewritings
from planner_ft.data.words import says
from planner_ft.vocabulary import Parameter, Vocabulary

Span = tuple[int, int]
LONGEST_PIECE = 1500
"""Characters that are read at once."""
FARTHEST_WORD = 120
"""Characters between the words of one text value."""
_END = re.compile(r"[.!?;]\s+|\n+")
_WORD = re.compile(r"[^\W_]+(?:[-'’.][^\W_]+)*")
_BEARING = re.compile(
    r"(?i:(?<![\w-])(?:(?:north|south|east|west)[ -]?){1,3}(?:erly|wards?|ern|[ -]?bound)?(?![\w-]))|\b(?:[NSEW]{1,3}|[ns][ns]?[ew]|[ew][ns][ew])\b",
)
_BEARING_ENDING = re.compile(r"(?:erly|wards?|ern|[ -]?bound)$")
_TURN = re.compile(
    rf"\b(?:(?:(?:an?|one|two|three)[ -])?(?:quarters?|thirds?)\b|(?:{'|'.join(TURNS)})\b|all the way (?:a?round|about)|"
    r"[\w.]+ (?:full |complete )?(?:times|turns|laps|rounds|circles|circuits|orbits)\b)",
    re.IGNORECASE,
)
_SIGN = re.compile(r"(?:[-−–]|\b(?:minus|negative)\s+)$", re.IGNORECASE)
_WAY = re.compile(r"\s*(?:m(?:et(?:re|er)s?)?)?\s*(?:(?:to the |due )?(?:east|west|north|south)(?:ings?|wards?)?|[EWNSewns])\b")

_OPENED = re.compile(r"[\[(]\s*(?:[-−–]|minus |negative )?$")
_LED = re.compile(r"\b(?:at|to|near|around|from|on|cent(?:re|er)|@)\W{0,3}(?:[-−–]|minus |negative )?$", re.IGNORECASE)
_PLAIN = re.compile(r"\d+(?:\.\d+)?\s*(?:,\s*|\s)(?:[-−–]|minus |negative )?\d+(?:\.\d+)?")
_AXES = re.compile(r"(?<![a-z])y\s?[=:]?\s?(?:[-−–]|minus )?\d|\d\s?(?:east|west|north|south)\b.*\d", re.IGNORECASE)


@dataclass(frozen=True)
class Mention:
    """Words of a command that say a value: all the spans together. A lower rank is a plainer one."""

    spans: tuple[Span, ...]
    rank: int = 0

    @property
    def start(self) -> int:
        return self.spans[0][0]


@dataclass(frozen=True, eq=False)
class Piece:
    """A part of a command that begins at `offset`."""

    offset: int
    text: str
    source: Source

    def moved(self, spans: Iterator[Span] | tuple[Span, ...]) -> tuple[Span, ...]:
        """Spans of the piece as spans of the command."""
        return tuple((start + self.offset, end + self.offset) for start, end in spans)


@dataclass(frozen=True, eq=False)
class Said:
    """What a command says, by the piece."""

    command: str
    pieces: tuple[Piece, ...]

    @functools.cached_property
    def unread(self) -> bool:
        """Whether numbers of the command could not be read with certainty, so that no value can be called unsaid."""
        return any(piece.source.reading.numbers_free for piece in self.pieces)

    def states(self, value: Any, parameter: Parameter) -> bool | None:
        """Whether the command says the value; None where its numbers cannot be read with certainty."""
        verdicts = {_states(piece.source, value, parameter) for piece in self.pieces}
        if parameter.type == "texts" and isinstance(value, list) and len(self.pieces) > 1:
            verdicts = {all(True in {_states(piece.source, [text], parameter) for piece in self.pieces} for text in value)}
        return True if True in verdicts else None if None in verdicts else False

    def mentions(self, value: Any, parameter: Parameter) -> list[Mention]:
        """The words that say a value, the plainest ones alone; none where they cannot be told."""
        found = [mention for piece in self.pieces for mention in _mentions(piece, value, parameter)]
        best = min((mention.rank for mention in found), default=0)
        return list(dict.fromkeys(mention for mention in found if mention.rank == best))

    def turn(self, angle: float) -> Span | None:
        """The words for a part of a circle: "half", "once round"."""
        for piece in self.pieces:
            for match in _TURN.finditer(piece.text):
                if any(close(angle, turn) for turn in piece_turns(match[0])):
                    return match.start() + piece.offset, match.end() + piece.offset
        return None


@functools.lru_cache(maxsize=64)
def read_command(command: str, vocabulary: Vocabulary) -> Said:
    """A command, read once for all that asks about it."""
    return Said(command, tuple(Piece(offset, text, Source(text, vocabulary)) for offset, text in pieces(command)))


def pieces(text: str, longest: int = LONGEST_PIECE) -> Iterator[tuple[int, str]]:
    """The text cut behind sentences, or words where a sentence is too long, with where each piece begins."""
    start = 0
    while len(text) - start > longest:
        window = text[start : start + longest]
        ends = [match.end() for match in _END.finditer(window)]
        cut = ends[-1] if ends else window.rfind(" ") + 1 or longest
        yield start, window[:cut]
        start += cut
    yield start, text[start:]


@functools.lru_cache(maxsize=1024)
def piece_turns(words: str) -> frozenset[float]:
    """The angles that words for a part of a circle mean."""
    from planner_ft.data.quantities import turns

    return turns(words)


def _states(source: Source, value: Any, parameter: Parameter) -> bool | None:
    """As Source.states, but a number must be the very one that was said: an operator looks at what a model may be forgiven."""
    if parameter.type not in ("number", "integer"):
        return source.states(value, parameter)
    said = source.reading.said(parameter.unit)
    if said is None:
        return True if source.states(value, parameter) else None
    return is_number(value) and any(_same(value, number) for number in said)


def _same(written: float, said: float) -> bool:
    return close(said, written) or abs(said - written) <= 1e-4 * abs(said)


# ---------------------------------------------------------------- the words for a value


def _mentions(piece: Piece, value: Any, parameter: Parameter) -> Iterator[Mention]:
    kind = parameter.type
    if kind in ("number", "integer"):
        yield from _number(piece, value, parameter)
    elif kind == "position":
        yield from (Mention(piece.moved((span,))) for span in _place(piece, value))
    elif kind == "polygon":
        corners = [next(iter(_place(piece, corner)), None) for corner in value]
        spans = tuple(span for span in corners if span)
        if spans:
            yield Mention(piece.moved(tuple(sorted(set(spans)))), rank=len(corners) - len(spans))
    else:
        texts = [str(text) for text in value] if isinstance(value, list) else [str(value)]
        parts = [_text(piece.text, text) for text in texts]
        spans = tuple(span for part in parts for span in part)
        if spans:
            yield Mention(piece.moved(tuple(sorted(set(spans)))), rank=sum(not part for part in parts))


def _number(piece: Piece, value: float, parameter: Parameter) -> Iterator[Mention]:
    unit = "deg" if parameter.unit == "degC" else parameter.unit
    pairs = _pair_spans(piece)
    for quantity in _summed(quantities(piece.text)):
        span = piece.moved(((_signed_start(piece.text, quantity), quantity.end),))
        if quantity.unit == unit and _same(value, quantity.value):
            yield Mention(span, 0 if unit is not None else 1)
        elif quantity.unit is None and (_same(value, quantity.value) or (unit == "%" and _same(value, 100 * quantity.value))):
            yield Mention(span, 2 if _within(pairs, quantity.start) else 1)
        elif quantity.unit is None and unit == "s" and quantity.value and value / quantity.value in (60, 3600):
            # "for an hour and ten minutes, a reading every five"
            yield Mention(span, 3)
    if is_bearing(parameter):
        for match in _BEARING.finditer(piece.text):
            if _bearing(match[0]) == value % 360:
                yield Mention(piece.moved((match.span(),)), 0)
    if piece.source.reading.said(unit) is not None:
        yield from _rewritten(piece, value, unit)


def is_bearing(parameter: Parameter) -> bool:
    """Whether a parameter is a direction, and no angle that may be more than a full turn."""
    return parameter.unit == "deg" and (parameter.maximum is None or parameter.maximum <= 360)


def _rewritten(piece: Piece, value: float, unit: str | None) -> Iterator[Mention]:
    """Words that say a number in another reading of the text: misspelt, without an article."""
    for text in rewritings(piece.text)[1:]:
        for quantity in _summed(quantities(text)):
            if quantity.unit in (unit, None) and _same(value, quantity.value):
                span = _original(piece.text, text, (quantity.start, quantity.end))
                if span is not None:
                    yield Mention(piece.moved((span,)), 4 + (quantity.unit is None))


def _original(text: str, rewritten: str, span: Span) -> Span | None:
    """A span of a rewriting in the text itself: what is the same before and behind stays where it is."""
    before = next((index for index, (one, other) in enumerate(zip(text, rewritten, strict=False)) if one != other), min(len(text), len(rewritten)))
    most = min(len(text), len(rewritten)) - before
    behind = next((index for index in range(most) if text[-1 - index] != rewritten[-1 - index]), most)
    shift = len(text) - len(rewritten)
    start = span[0] if span[0] <= before else max(span[0] + shift, before)
    end = span[1] + shift if span[1] >= len(rewritten) - behind else len(text) - behind
    return (start, end) if start < end else None


def _summed(found: tuple[Quantity, ...]) -> Iterator[Quantity]:
    """The quantities, and neighbouring durations as one: "two minutes and thirty seconds"."""
    yield from found
    for first, second in itertools.pairwise(found):
        if first.unit == second.unit == "s" and second.start - first.end <= 5:
            yield Quantity(first.value + second.value, "s", first.start, second.end, first.said)


def _place(piece: Piece, value: Any) -> list[Span]:
    """The words for a position: both its numbers, with their signs and directions."""
    return [
        (_sign_start(piece.text, start), _way_end(piece.text, start, end))
        for x, y, start, end in positions(piece.text)
        if abs(x - value[0]) <= 0.0051 and abs(y - value[1]) <= 0.0051
    ]


def is_place(text: str, start: int, end: int) -> bool:
    """Whether two neighbouring numbers are certainly coordinates: in brackets, with axes or directions, or behind a word like "at"."""
    before = text[max(0, start - 16) : start]
    if _OPENED.search(before):
        return True
    said = text[start:end]
    return (_LED.search(before) is not None and _PLAIN.fullmatch(said) is not None) or _AXES.search(said) is not None


def _pair_spans(piece: Piece) -> list[Span]:
    return sorted({(start, end) for _x, _y, start, end in positions(piece.text)})


def _within(spans: list[Span], place: int) -> bool:
    index = bisect.bisect_right(spans, (place, len(spans) + 10**9)) - 1
    return any(start <= place < end for start, end in spans[max(0, index - 2) : index + 1])


def _signed_start(text: str, quantity: Quantity) -> int:
    return _sign_start(text, quantity.start) if quantity.said < 0 else quantity.start


def _sign_start(text: str, start: int) -> int:
    sign = _SIGN.search(text, max(0, start - 12), start)
    return sign.start() if sign else start


def _way_end(text: str, start: int, end: int) -> int:
    """The end of a coordinate with its direction, where the one before has a direction, too: "120 east 45 north", but not "40, 40 due east"."""
    way = _WAY.match(text, end) if _BEARING.search(text, start, end) else None
    return way.end() if way else end


def _bearing(words: str) -> float | None:
    if words.upper() in SHORT:
        return 22.5 * SHORT.index(words.upper())
    name = _BEARING_ENDING.sub("", words.lower()).replace(" ", "-")
    name = re.sub(r"^(north|south)(east|west)$", r"\1-\2", name)
    return 22.5 * COMPASS.index(name) if name in COMPASS else None


def _text(text: str, value: str) -> tuple[Span, ...]:
    """The words for a text value: in one place where they stand so, else word by word near each other."""
    whole = re.search(rf"(?<!\w){re.escape(normalised(value))}(?!\w)", text, re.IGNORECASE)
    if whole is not None:
        return (whole.span(),)
    words = list(_WORD.finditer(text))
    options = [[word.span() for word in words if not says(word[0], wanted, misspelt=False)] for wanted in _WORD.findall(value)]
    if not all(options):
        options = [
            found or [word.span() for word in words if not says(word[0], wanted, misspelt=True)]
            for found, wanted in zip(options, _WORD.findall(value), strict=True)
        ]
    found = [spans for spans in options if spans]
    return _joined(_nearest(found), text) if found and len(found) * 2 >= len(options) else ()


def _nearest(options: list[list[Span]]) -> list[Span]:
    """One span per word so that they stand near each other: all near one of the last word, mostly a noun."""
    best: list[Span] = []
    for anchor in options[-1]:
        chosen = [min(spans, key=lambda span: abs(span[0] - anchor[0])) for spans in options]
        if not best or _width(chosen) < _width(best):
            best = chosen
    return [span for span in best if abs(span[0] - best[-1][0]) <= FARTHEST_WORD]


def _width(spans: list[Span]) -> int:
    return max(end for _start, end in spans) - min(start for start, _end in spans)


def _joined(spans: list[Span], text: str) -> tuple[Span, ...]:
    """Spans in order; those with nothing but blanks between them as one."""
    joined: list[Span] = []
    for start, end in sorted(set(spans)):
        if joined and not text[joined[-1][1] : start].strip():
            joined[-1] = (joined[-1][0], end)
        else:
            joined.append((start, end))
    return tuple(joined)
