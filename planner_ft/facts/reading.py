"""The facts of a text, and where a value is from."""

import functools
import math
import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any, Literal

from planner_ft.facts import numbers, places
from planner_ft.facts.geographic import Geographic, read_geographic, without_geographic
from planner_ft.facts.numbers import THOROUGH
from planner_ft.facts.numerals import spoken_whole
from planner_ft.facts.places import Position
from planner_ft.facts.together import AS_BEFORE, BARE, IN_PAIR, REREAD, Number
from planner_ft.facts.units import base_of, named
from planner_ft.facts.words import SCALES, SMALL, UNITS, WORDS, Phrases, Span, is_known, phrases
from planner_ft.vocabulary import Parameter
from planner_ft.vocabulary.plans import is_number as is_number

Kind = Literal["stated", "converted", "derived", "vehicle", "nobody", "unread"]
EXACT, SCORING = 0.0, 0.02
"""Relative tolerances: that of document and constraint, and what the labelling rules allow."""
ROUNDING = 0.0051  # converted values are written with two decimals,
CONVERSION = 1e-4  # and their factors are rounded: relative
FARTHEST = 0.5  # metres that a position may lie off: another whole metre is another place
LARGEST = 1e9  # longer rows of digits are no values
FEWEST_WORDS = 5  # words below which a text is too short to tell its language by
NO_MEASURES = (None, "deg", "%")  # bases whose numbers may count things, too
WAYPOINT = Parameter("x, y", "position", "m")
"""The two coordinates of a destination, judged together."""

_UNREAD = re.compile(
    r"\d+(?:\.\d+){2,}|\d+['’]\d+|\d\^\d|(?<![\w.])0x[0-9a-f]+|[×*]\s?10\b(?!\s?m)"
    rf"|\b(?:\d+|an?|half|{'|'.join([*SMALL, *SCALES])})[ -]"
    r"(?:(?:boat|ship|hull|vessel|cable|car|rope)['’s]*[- ]?lengths?"
    rf"|chain lengths?|(?:{'|'.join(WORDS['unread_units'])})s?)\b",
    re.IGNORECASE,
)

Place = tuple[float, float]


@dataclass(frozen=True)
class Evidence:
    """Where a value is from.

    - stated: the text, or a parameter of the task, says it
    - converted: the text says it in another unit
    - derived: arithmetic with what is stated makes it
    - vehicle: home or the unresolved location
    - nobody: none of these
    - unread: numbers of the text could not be read with certainty, and it may be one of them

    `mentions` are the words for it, each as the spans that say it together; several where the text
    says it several times. `rank` is how plainly a number is said (numbers.WRITTEN and following).
    """

    kind: Kind
    mentions: tuple[tuple[Span, ...], ...] = ()
    rank: int = 0

    @property
    def spans(self) -> tuple[Span, ...]:
        """The first words that say the value."""
        return self.mentions[0] if self.mentions else ()

    @property
    def given(self) -> bool | None:
        """Whether somebody gave the value; None where that cannot be told."""
        return None if self.kind == "unread" else self.kind != "nobody"


NOBODY, UNREAD = Evidence("nobody"), Evidence("unread")


class Facts:
    """What a text states. Everything is read once, when it is first asked for; the work grows with
    the length of the text and no faster.
    """

    def __init__(self, text: str) -> None:
        self.text = text
        self._numbers: dict[str | None, tuple[Number, ...]] = {}

    def numbers(self, unit: str | None) -> tuple[Number, ...]:
        """Every value of a parameter in `unit` that the text can state, in every way of reading it,
        by value: numbers with this unit, converted, and without one. Counts are no measures, and
        coordinates are neither.
        """
        if unit not in self._numbers:
            found, counted = numbers.in_unit(self._local, unit), base_of(unit) in NO_MEASURES
            spans = [(place.start, place.end) for place in places.read_positions(self._local)]
            certain, inside = _covered(places.written_pairs(self._local)), _covered(spans)
            self._numbers[unit] = tuple(
                replace(one, rank=IN_PAIR) if one.rank == BARE and one.start in inside else one
                for one in sorted(
                    dict.fromkeys(found), key=lambda one: (one.value, one.rank, one.start)
                )
                if not (one.counts and not counted)
                and one.start not in certain
                and not self._is_part(one)
                and not (one.rank == AS_BEFORE and one.start in inside)
                and abs(one.value) < LARGEST
            )
        return self._numbers[unit]

    def _is_part(self, number: Number) -> bool:
        """Whether a number is a part of one that is said in full: 20 of "twenty two"."""
        own, word = (number.start, number.stop), number.stop > number.start
        return word and any(a <= own[0] and own[1] <= b and own != (a, b) for a, b in self._in_full)

    @functools.cached_property
    def _in_full(self) -> list[Span]:
        return list(spoken_whole(numbers.read_rows(self._local)[0].tokens))

    @functools.cached_property
    def positions(self) -> tuple[Position, ...]:
        """Local coordinates in metres that the text can state, the plainest reading first."""
        found = places.positions_of(self._local, self._all)
        return tuple(place for place in found if max(abs(place.x), abs(place.y)) < LARGEST)

    @functools.cached_property
    def geographic(self) -> tuple[Geographic, ...]:
        """Positions in degrees. They are neither local positions nor numbers."""
        return read_geographic(self.text)

    @functools.cached_property
    def bearings(self) -> tuple[Number, ...]:
        """Compass directions, in degrees clockwise from north."""
        return places.read_bearings(self._local)

    @functools.cached_property
    def turns(self) -> tuple[Number, ...]:
        """Angles of parts and numbers of circles: "half", "once round", "three times"."""
        return tuple(dict.fromkeys(numbers.turns_of(self._local, self._all)))

    @functools.cached_property
    def counts(self) -> tuple[float, ...]:
        """The bare numbers of the text, those that count things included."""
        return tuple(number.said for number in numbers.read_numbers(self._local))

    @property
    def phrases(self) -> Phrases:
        """The words of the text."""
        return phrases(self.text)

    @functools.cached_property
    def unread(self) -> tuple[str, ...]:
        """Why numbers of the text could not be read with certainty, for an operator."""
        return tuple(_notes(without_geographic(self.text)[:THOROUGH]))

    @functools.cached_property
    def loose(self) -> tuple[float, ...]:
        """Numbers that coordinates can be of, where one of these has no partner."""
        if self.unread or not places.unpaired_coordinates(self._local[:THOROUGH]):
            return ()
        return tuple(dict.fromkeys(one.said for one in self._all if one.unit in ("m", None)))

    def evidence(self, value: Any, parameter: Parameter, tolerance: float = EXACT) -> Evidence:
        """Whether the text says a value of a parameter, and with which words. A number may differ
        by `tolerance`, relative, beside rounding; texts may have their spelling put right.
        """
        kind = parameter.type
        if kind in ("number", "integer"):
            return self._number(value, parameter, tolerance) if is_number(value) else NOBODY
        if kind == "position":
            return self._position(value, tolerance) if is_place(value) else NOBODY
        items = value if isinstance(value, list) else [value]
        if kind == "polygon":
            return together(self.evidence(corner, WAYPOINT, tolerance) for corner in items)
        texts = [str(item) for item in items]
        spans = (filter(None, self.phrases.spans(text)) for text in texts)
        return together(
            NOBODY if self.phrases.missing(text) else Evidence("stated", tuple(found))
            for text, found in zip(texts, spans, strict=True)
        )

    def _number(self, value: float, parameter: Parameter, tolerance: float) -> Evidence:
        angle = named(parameter.unit) == UNITS["deg"]
        known = self.numbers(parameter.unit)
        found = [number for number in known if near(value, number.value, tolerance)]
        # An arc of more than a circle is no direction: "half round, the south wall too".
        if angle and (parameter.maximum or 360) <= 360:
            found += [one for one in self.bearings if near(value % 360, one.value)]
        plainest = min((number.rank for number in found), default=REREAD + 2)
        turns = self.turns if angle and plainest else ()
        if turned := [turn for turn in turns if near(abs(value), turn.value, tolerance)]:
            return Evidence("derived", _mentions(turned))
        if not found:
            return UNREAD if self.unread else NOBODY
        best = [number for number in found if number.rank == plainest]
        plain = plainest != AS_BEFORE and bool(best[0].said)
        plain = plain and math.isclose(best[0].value, best[0].said)
        kind: Kind = "stated" if plain else "converted" if best[0].said else "derived"
        return Evidence(kind, _mentions(best), plainest)

    def _position(self, value: Sequence[float], tolerance: float) -> Evidence:
        here = self.positions
        found = [place for place in here if same_place(value, (place.x, place.y), tolerance)]
        if found:
            return Evidence("stated", _mentions(found))
        loose = self.loose and all(
            any(near(abs(part), abs(number), tolerance) for number in self.loose) for part in value
        )
        return UNREAD if self.unread else Evidence("stated") if loose else NOBODY

    @functools.cached_property
    def _local(self) -> str:
        """The text with blanks for geographic positions."""
        return without_geographic(self.text)

    @property
    def _all(self) -> tuple[Number, ...]:
        return numbers.read_all(self._local)


@functools.lru_cache(maxsize=4096)
def read(text: str) -> Facts:
    """The facts of a text, read once for all that ask about it."""
    return Facts(text)


def is_place(value: Any) -> bool:
    """Whether a JSON value is a pair of numbers."""
    return isinstance(value, list | tuple) and len(value) == 2 and all(map(is_number, value))


def near(value: float, said: float, tolerance: float = EXACT) -> bool:
    """Whether a value is the one that was said, up to rounding and a relative tolerance."""
    return abs(value - said) <= max(ROUNDING, max(tolerance, CONVERSION) * abs(said))


def same_place(value: Sequence[float], said: Place, tolerance: float = EXACT) -> bool:
    """Whether a position is the one that was said: by distance, half a metre at most."""
    allowed = min(tolerance * math.hypot(*said), FARTHEST + 1e-9)
    return math.dist(value, said) <= max(allowed, ROUNDING * math.sqrt(2))


def together(parts: Iterable[Evidence]) -> Evidence:
    """The evidence of a value with parts: the weakest kind, and the first words of each part."""
    found = list(parts)
    if len(found) == 1:
        return found[0]
    order: list[Kind] = ["stated", "converted", "vehicle", "derived", "unread", "nobody"]
    kind: Kind = order[max((order.index(part.kind) for part in found), default=0)]
    spans = sorted({span for part in found for span in part.spans})
    return Evidence(kind, (tuple(spans),) if spans else ())


def _mentions(found: Iterable[Number | Position]) -> tuple[tuple[Span, ...], ...]:
    return tuple(((start, end),) for start, end in sorted({(one.start, one.end) for one in found}))


def _covered(spans: Iterable[Span]) -> set[int]:
    """The places of a text that spans cover."""
    return {place for start, end in spans for place in range(start, end)}


def _notes(text: str) -> Iterator[str]:
    if any(ord(letter) > 0x24F and letter.isalpha() for letter in text):
        yield "The command has words in another script; its numbers are not checked against it."
        return
    words = re.findall(r"[^\W\d_]{2,}", text)
    unchecked = "numbers are not checked against it."
    if len(words) >= FEWEST_WORDS and sum(map(is_known, words)) * 2 < len(words):
        yield f"The command is mostly in words that are not known; its {unchecked}"
    if unread := _UNREAD.search(text):
        yield f"The command has a number that could not be read ({unread[0][:24]}); {unchecked}"
