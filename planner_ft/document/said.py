"""Where a command says a value: the words for a number, a place or a text, and whether it says it
at all.

The reading is that of the decoding strength `grounded` (planner_ft.decoding.constraints.facts). A
command is read in pieces, and what stands beyond the first THOROUGH characters only in its plainest
reading: the work grows with the length and no faster.
"""

from __future__ import annotations

import bisect
import functools
import itertools
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from planner_ft.benchmark.metrics.values import is_number
from planner_ft.data.quantities import TURNS, close, turns
from planner_ft.data.stated import stated_positions
from planner_ft.decoding.constraints.facts import Reading, read
from planner_ft.document.said_numbers import (
    IN_PAIR,
    ROUNDED,
    Found,
    Span,
    find_numbers,
    find_places,
    is_place,
    lookup,
    same,
)
from planner_ft.document.said_words import WordIndex
from planner_ft.vocabulary import Parameter, Vocabulary

__all__ = ["Mention", "Piece", "Said", "Span", "is_place", "pieces", "read_command"]

LONGEST_PIECE = 1500
"""Characters that are read at once."""
THOROUGH = 6000
"""Characters of a command that are read in every way that they can be meant."""
_END = re.compile(r"[.!?;]\s+|\n+")
_TURN = re.compile(
    rf"\b(?:(?:(?:an?|one|two|three)[ -])?(?:quarters?|thirds?)\b|(?:{'|'.join(TURNS)})\b|all the"
    r" way (?:a?round|about)|"
    r"[\w.]{1,20} (?:full |complete )?(?:times|turns|laps|rounds|circles|circuits|orbits)\b)",
    re.IGNORECASE,
)


@dataclass(frozen=True)
class Mention:
    """Words of a command that say a value: all the spans together. `rank`: how plainly, 0 with its
    unit.
    """

    spans: tuple[Span, ...]
    rank: int = 0

    @property
    def start(self) -> int:
        return self.spans[0][0]


@dataclass(frozen=True)
class Piece:
    """A part of a command that begins at `offset`."""

    offset: int
    text: str


class Said:
    """What a command says; everything is read once, when it is first asked for."""

    def __init__(self, command: str, vocabulary: Vocabulary) -> None:
        self.command = command
        self.vocabulary = vocabulary
        self.pieces = tuple(Piece(offset, text) for offset, text in pieces(command))
        self._numbers: dict[tuple[str | None, bool], list[Found]] = {}
        self._verdicts: dict[str | None, list[float]] = {}

    @property
    def unread(self) -> bool:
        """Whether numbers of the command could not be read with certainty, so that no value can be
        called unsaid.
        """
        return any(reading.numbers_free for reading in self._readings)

    def states(self, value: Any, parameter: Parameter) -> bool | None:
        """Whether the command says the value; None where its numbers cannot be read with certainty.

        A number must be the very one that was said, up to the rounding of conversions: an operator
        looks at what a model may be forgiven.
        """
        kind = parameter.type
        if kind in ("number", "integer"):
            return self._states_number(value, parameter)
        if kind == "position":
            return self._states_place(value)
        if kind == "polygon":
            verdicts = {self._states_place(corner) for corner in value}
            return False if False in verdicts else None if None in verdicts else True
        return all(
            self.words.states(str(text)) for text in (value if isinstance(value, list) else [value])
        )

    def mentions(self, value: Any, parameter: Parameter) -> list[Mention]:
        """The words that say a value, the plainest ones alone; none where they cannot be told."""
        kind = parameter.type
        if kind in ("number", "integer"):
            return list(
                dict.fromkeys(
                    Mention((found.span,), found.rank) for found in self._lookup(value, parameter)
                )
            )
        if kind == "position":
            return [Mention((span,)) for span in self._place_spans(value)]
        if kind == "polygon":
            return _together([self._place_spans(corner)[:1] for corner in value])
        if isinstance(value, list):
            return _together(
                [
                    [span for spans in self.words.spans(str(text))[:1] for span in spans]
                    for text in value
                ]
            )
        return [Mention(spans) for spans in self.words.spans(str(value)) if spans]

    def turn(self, angle: float) -> Span | None:
        """The words for a part of a circle: "half", "once round"."""
        return next(
            (span for span, angles in self._turns if any(close(angle, turn) for turn in angles)),
            None,
        )

    @functools.cached_property
    def words(self) -> WordIndex:
        """The words of the command."""
        return WordIndex(self.command)

    # ------------------------------------------------------------ numbers

    def _states_number(self, value: Any, parameter: Parameter) -> bool | None:
        if not is_number(value):
            return False
        unit = parameter.unit
        if unit not in self._verdicts:
            said = {number for reading in self._readings for number in reading.said(unit) or ()}
            plain = (
                found.value
                for found in self._found(parameter)
                if found.rank <= IN_PAIR and found.span[0] >= THOROUGH
            )
            self._verdicts[unit] = sorted(said.union(plain))
        known = self._verdicts[unit]
        index = bisect.bisect_left(known, value)
        if any(same(value, number) for number in known[max(0, index - 1) : index + 2]):
            return True
        if self.unread:
            return True if self._lookup(value, parameter) else None
        return False

    def _lookup(self, value: Any, parameter: Parameter) -> list[Found]:
        return lookup(self._found(parameter), value) if is_number(value) else []

    def _found(self, parameter: Parameter) -> list[Found]:
        bearing = parameter.unit == "deg" and (
            parameter.maximum is None or parameter.maximum <= 360
        )
        unit = "deg" if parameter.unit == "degC" else parameter.unit
        if (unit, bearing) not in self._numbers:
            found = {
                Found(
                    item.value,
                    item.rank,
                    (item.span[0] + piece.offset, item.span[1] + piece.offset),
                )
                for piece in self.pieces
                for item in find_numbers(
                    piece.text,
                    unit,
                    bearing=bearing,
                    thorough=piece.offset < THOROUGH and not self.unread,
                )
            }
            self._numbers[unit, bearing] = sorted(found)
        return self._numbers[unit, bearing]

    @functools.cached_property
    def _readings(self) -> tuple[Reading, ...]:
        return tuple(
            read(piece.text, self.vocabulary) for piece in self.pieces if piece.offset < THOROUGH
        )

    @functools.cached_property
    def _turns(self) -> list[tuple[Span, frozenset[float]]]:
        found = ((piece, match) for piece in self.pieces for match in _TURN.finditer(piece.text))
        return [
            ((piece.offset + match.start(), piece.offset + match.end()), turns(match[0]))
            for piece, match in found
        ]

    # ------------------------------------------------------------ places

    def _states_place(self, value: Any) -> bool | None:
        if self._at(self._stated, value):
            return True
        if self.unread:
            return None
        loose = [abs(number) for reading in self._readings for number in reading.loose]
        return bool(loose) and all(
            any(same(abs(part), number) for number in loose) for part in value
        )

    def _place_spans(self, value: Any) -> list[Span]:
        return sorted({span for _x, _y, span in self._at(self._places, value)})

    @staticmethod
    def _at(
        places: Sequence[tuple[float, float, Span]], value: Any
    ) -> list[tuple[float, float, Span]]:
        """The entries, sorted by x, at a place."""
        first = bisect.bisect_left(places, value[0] - ROUNDED, key=lambda item: item[0])
        near = itertools.takewhile(
            lambda item: item[0] <= value[0] + ROUNDED, itertools.islice(places, first, None)
        )
        return [item for item in near if abs(item[1] - value[1]) <= ROUNDED]

    @functools.cached_property
    def _places(self) -> list[tuple[float, float, Span]]:
        found = (
            (piece.offset, place) for piece in self.pieces for place in find_places(piece.text)
        )
        return sorted(
            {(x, y, (start + offset, end + offset)) for offset, (x, y, (start, end)) in found}
        )

    @functools.cached_property
    def _stated(self) -> list[tuple[float, float, Span]]:
        """Every place that is stated in some reading."""
        reread = [
            (x, y, (0, 0))
            for piece in self.pieces
            if piece.offset < THOROUGH
            for x, y in stated_positions(piece.text)
        ]
        return sorted([*self._places, *reread])


@functools.lru_cache(maxsize=64)
def read_command(command: str, vocabulary: Vocabulary) -> Said:
    """A command, read once for all that asks about it."""
    return Said(command, vocabulary)


def pieces(text: str, longest: int = LONGEST_PIECE) -> Iterator[tuple[int, str]]:
    """The text cut behind sentences, or words where a sentence is too long, with where each piece
    begins.
    """
    start = 0
    while len(text) - start > longest:
        window = text[start : start + longest]
        ends = [match.end() for match in _END.finditer(window)]
        cut = ends[-1] if ends else window.rfind(" ") + 1 or longest
        yield start, window[:cut]
        start += cut
    yield start, text[start:]


def _together(parts: Sequence[Sequence[Span]]) -> list[Mention]:
    """The words for all parts of a value as one mention."""
    spans = sorted({span for part in parts for span in part})
    return [Mention(tuple(spans))] if spans else []
