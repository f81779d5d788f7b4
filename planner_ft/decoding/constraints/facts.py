"""What a command states, read for the strength grounded: numbers by unit, coordinates, and what
could not be read.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from planner_ft.data.lexicon import is_known
from planner_ft.data.numerals import AND, FRACTIONS, SCALES, SMALL, UNITS
from planner_ft.data.quantities import Quantity, positions, quantities
from planner_ft.data.stated import CABLES, rewritings, stated_numbers, stated_positions, unhyphened
from planner_ft.data.words import edit_distance
from planner_ft.decoding.constraints.patterns import WHOLE_DIGITS
from planner_ft.vocabulary import Parameter, Vocabulary

Position = tuple[float, float]

LARGEST = 10**WHOLE_DIGITS
FEWEST_WORDS = 5
"""Words below which a command is too short to tell its language by."""
MOST_SECTORS = 36
MOST_CROSSED = 8
"""Stated places whose coordinates are crossed into corners ("the box from (0, 0) to (40, 20)"), and
stated angles that turns begin at.
"""
MEASURES = ("m", "s", "m/s", "degC")
BEFORE_NUMBERS = frozenset(
    {
        "at",
        "by",
        "of",
        "to",
        "for",
        "in",
        "is",
        "every",
        "each",
        "speed",
        "about",
        "around",
        "than",
        "off",
        "within",
    }
)
"""Words behind which "one" is a number and no pronoun."""
NO_THINGS = frozenset(
    {
        "towards",
        "across",
        "as",
        "this",
        "is",
        "less",
        "plus",
        "minus",
        "times",
        "always",
        "was",
        "has",
        "afterwards",
        "upwards",
        "outwards",
    }
)
_AND_A = re.compile(rf"(?<![a-z])(?:{'|'.join(AND)}) (?:an? )?$", re.IGNORECASE)
_WORD_BEFORE = re.compile(r"([a-z]+)\W*$", re.IGNORECASE)
_WORD_BEHIND = re.compile(r"[ -]([a-z]+s)\b(?!['’])", re.IGNORECASE)
_NUMBER = r"[-−–]?\d+(?:\.\d+)?"
_PAIR = rf"{_NUMBER}\s*[,;/]?\s*{_NUMBER}"
WRITTEN_PAIR = re.compile(
    rf"\[\s*{_PAIR}\s*\]|\(\s*{_PAIR}\s*\)|(?<!\w)x\s?[=:]?\s?{_NUMBER}\W{{0,3}}y\s?[=:]?\s?{_NUMBER}",
    re.IGNORECASE,
)
"""Two numbers that are certainly coordinates, and no other values."""
_UNREAD = re.compile(r"\d+(?:\.\d+){2,}|\d+['’]\d+|\d\^\d|0x[0-9a-f]+|[×*]\s?10\b", re.IGNORECASE)
_UNREAD_UNITS = re.compile(
    rf"\b(?:\d+|an?|half|{'|'.join([*SMALL, *SCALES])})[ -]"
    r"((?:(?:boat|ship|hull|vessel|cable|car|rope)['’s]*[- ]?lengths?|furlongs?|leagues?|chain"
    r" lengths?|fortnights?|weeks?|months?))\b",
    re.IGNORECASE,
)
_COORDINATE_UNIT = re.compile(
    r"(?:,|\(|^|\ball|\bgiven|\bcorners|\bcoordinates|\bpositions|\bis|\bare) ?in"
    r" (kilometres|kilometers|km|feet|ft|yards)\b(?! \w+ing\b)",
    re.IGNORECASE,
)
"""The unit of the coordinates in a sentence, which are metres elsewhere."""
_AXIS = r"(?:eastings?|northings?|east|north|west|south|latitude|longitude|coordinates?|[xy])"
_AXIS_CUE = re.compile(
    rf"(?<![a-z]){_AXIS}(?:(?![.;]\s)\W){{0,3}}(?:minus |negative |of |is )?[-−–]?$", re.IGNORECASE
)
_NO_AXIS = r"(?![a-z-]| (?:side|face|wall|end|edge|corner|of (?!home|base|here)))"
_CUE_BEHIND = re.compile(
    rf"^\s?(?:m|met(?:re|er)s?)?\s?(?:to the |due )?{_AXIS}{_NO_AXIS}", re.IGNORECASE
)


_ANGLE_BEFORE = re.compile(
    r"\b(?:courses?|headings?|bearings?|hdg|azimuth|steering|steer)(?: of| is| to|:|=)? ?$",
    re.IGNORECASE,
)
DIGIT_BEHIND = re.compile(
    r" (?:one|two|three|four|five|six|seven|eight|nine|niner|zero|oh)\b", re.IGNORECASE
)
"""What goes on behind a number whose digits are said one by one."""
_ANGLE = re.compile(r"0\d\d")
"""Three figures with a leading nought."""
_A_SECOND_ONE = re.compile(
    r"a second"
    r" (?:minutes?|hours?|half|holds?|times?|ones?|turns?|legs?|pass|runs?|drifts?|arcs?|nudges?|fix|still|pin|round|lap|look|stop|wait|stay)\b",
    re.IGNORECASE,
)
"""What is no duration of one second."""
_UNIT_LEFT_OUT = re.compile(
    r"(?: (?:more|at|here|there|on|and|then|in)\b|[.,;)]|$)(?! ?\d)", re.IGNORECASE
)
"""What stands behind a number whose unit was said before: "ten minutes here and five there"."""

_MULTIPLES = {
    2.0: re.compile(r"\b(?:twice|double|two times)\b", re.IGNORECASE),
    3.0: re.compile(r"\b(?:triple|treble|thrice|three times)\b", re.IGNORECASE),
    0.5: re.compile(r"\bhalf (?:as|the|that|of|its|this)\b|\bhalve\w*\b", re.IGNORECASE),
}
"""Words for a time or length by another one: "hold twice as long", "half the distance"."""


@dataclass(frozen=True)
class Reading:
    """The facts of a text.

    `bare` is the text without what certainly is a coordinate, `measures` that without what
    certainly is no measure: "two buoys", "the other one", "half a turn". `numbers_free`: numbers
    could not be read with certainty; `loose` are the numbers that coordinates can be made of, where
    those could not be.
    """

    text: str
    bare: str
    measures: str
    places: tuple[Position, ...]
    loose: tuple[float, ...]
    numbers_free: bool
    notes: tuple[str, ...]

    def numbers(self, parameter: Parameter) -> list[float] | None:
        """Values of a parameter that the text states; None where any can be meant."""
        said = self.said(parameter.unit)
        return None if said is None else usable(said, parameter)

    def said(self, unit: str | None) -> frozenset[float] | None:
        """Numbers in a unit that the text states, whatever their range; None where any can be
        meant.
        """
        if self.numbers_free:
            return None
        return stated_numbers(self.measures if unit in MEASURES else self.bare, unit) | (
            _durations(self.measures) if unit == "s" else frozenset()
        )


def read(text: str, vocabulary: Vocabulary) -> Reading:
    """Read a command or a task prompt."""
    notes = list(_notes(text))
    converted = in_metres(text)
    places = [
        converted.get(place, place)
        for x, y in stated_positions(text)
        if max(abs(x), abs(y)) < LARGEST
        for place in [(round(x, 2), round(y, 2))]
    ]
    loose = () if notes else tuple(_loose(text))
    if loose:
        notes.append("The coordinates in the command could not be read with certainty.")
    known = dict.fromkeys([vocabulary.home, vocabulary.unresolved, *places])
    bare = without_pairs(unhyphened(text))
    return Reading(
        text,
        bare,
        without_counts(bare),
        tuple(known),
        loose,
        any("number" in note for note in notes),
        tuple(notes),
    )


def in_metres(text: str) -> dict[Position, Position]:
    """Coordinates in a sentence that says their unit ("fence corners, in kilometres: ..."), with
    what they are in metres.
    """
    found = {}
    for match in _COORDINATE_UNIT.finditer(text):
        _unit, factor = UNITS[match[1].lower()]
        begins, ends = text.rfind(". ", 0, match.start()) + 1, text.find(". ", match.end())
        for x, y, start, end in positions(text):
            if begins <= start and end <= (ends if ends >= 0 else len(text)):
                found[round(x, 2), round(y, 2)] = round(x * factor, 2), round(y * factor, 2)
    return found


def without_pairs(text: str) -> str:
    """A text without what certainly is a coordinate."""
    return WRITTEN_PAIR.sub(" ; ", text)


def without_counts(text: str) -> str:
    """A text without its numbers that count things, stand for things, or are parts of a turn."""
    pieces, end = [], 0
    for quantity in quantities(text):
        word = text[quantity.start : quantity.end].lower()
        before, behind = (
            _WORD_BEFORE.search(text[: quantity.start]),
            _WORD_BEHIND.match(text[quantity.end :]),
        )
        said_before = before[1].lower() if before else ""
        stands = (
            word == "one"
            and said_before not in BEFORE_NUMBERS
            and not DIGIT_BEHIND.match(text, quantity.end)
        ) or (word in FRACTIONS and not _AND_A.search(text[: quantity.start]))
        angle = _ANGLE.fullmatch(word) or _ANGLE_BEFORE.search(text[: quantity.start])
        no_measure = stands or angle or (behind is not None and _is_thing(behind[1].lower()))
        if _A_SECOND_ONE.match(text, quantity.start) or (
            quantity.unit is None and not CABLES.match(text, quantity.end) and no_measure
        ):
            pieces.append(text[end : quantity.start])
            end = quantity.end
    return ";".join([*pieces, text[end:]])


def _durations(text: str) -> frozenset[float]:
    """Durations in seconds whose unit was said with another one: "ten minutes here and five
    there".
    """
    numbers = quantities(text)
    factors = {
        quantity.value / quantity.said
        for quantity in numbers
        if quantity.unit == "s" and quantity.said
    }
    bare = [
        quantity
        for quantity in numbers
        if quantity.unit is None and quantity.said > 0 and _UNIT_LEFT_OUT.match(text, quantity.end)
    ]
    return frozenset(quantity.said * factor for quantity in bare for factor in factors)


def _is_thing(word: str) -> bool:
    """Whether a word that ends with "s" names things, and is no unit nor near one."""
    return (
        is_known(word)
        and word not in NO_THINGS
        and not any(edit_distance(word, unit, 2) <= 2 for unit in UNITS)
    )


def usable(values: Iterable[float], parameter: Parameter) -> list[float]:
    """The values that a parameter can have, as they are written, smallest first."""
    found = {
        rounded
        for value in values
        if abs(value) < LARGEST
        for rounded in (round(value, 2), round(value, 4))
    }
    low, high = parameter.minimum, parameter.maximum
    within = (value for value in found if low is None or high is None or low <= value <= high)
    return sorted(value for value in within if parameter.type != "integer" or value == int(value))


def own_numbers(
    record: dict[str, Any], vocabulary: Vocabulary
) -> Iterator[tuple[float, str | None]]:
    """Every number in a task's parameters, with its unit; without one where the vocabulary does not
    say it.
    """
    task = vocabulary.task.get(str(record.get("task")))
    parameters = record.get("parameters")
    for name, value in parameters.items() if isinstance(parameters, dict) else ():
        unit = task.by_name[name].unit if task and name in task.by_name else None
        for item in value if isinstance(value, list) else [value]:
            if isinstance(item, int | float) and not isinstance(item, bool):
                yield item, unit


def own_texts(record: dict[str, Any]) -> Iterator[str]:
    """Every text in a task's parameters."""
    parameters = record.get("parameters")
    for value in parameters.values() if isinstance(parameters, dict) else ():
        for item in value if isinstance(value, list) else [value]:
            if isinstance(item, str):
                yield item


def sector_counts(numbers: Iterable[float]) -> frozenset[int]:
    """The numbers into which a turn can be divided."""
    return frozenset(int(number) for number in numbers if number in range(2, MOST_SECTORS + 1))


def multiples(text: str) -> list[float]:
    """By what a text multiplies a time or a length: "hold twice as long", "make it half as
    long".
    """
    return [factor for factor, words in _MULTIPLES.items() if words.search(text)]


def turned(said: Sequence[float], counts: Iterable[int]) -> Iterator[float]:
    """Angles in degrees that follow from stated ones: turns to port, headings evenly round the
    compass.
    """
    steps = [360 / count for count in sorted(counts)]
    yield from steps
    for value in (*said, *steps):
        yield -value
    starts = {0.0, *(value % 360 for value in said)} if len(said) <= MOST_CROSSED else {0.0}
    for start, step in itertools.product(starts, steps):
        yield from ((start + number * step) % 360 for number in range(round(360 / step)))


def _notes(text: str) -> Iterator[str]:
    """What keeps the numbers of a text from being read with certainty, in words for the
    operator.
    """
    if any(ord(letter) > 0x24F and letter.isalpha() for letter in text):
        yield "The command has words in another script; its numbers are not checked against it."
        return
    words = re.findall(r"[^\W\d_]{2,}", text)
    if len(words) >= FEWEST_WORDS and sum(map(is_known, words)) * 2 < len(words):
        yield (
            "The command is mostly in words that are not known; its numbers are not checked"
            " against it."
        )
    unread = [*_UNREAD.findall(text), *_UNREAD_UNITS.findall(text)]
    if unread:
        yield (
            f"The command has a number that could not be read ({unread[0][:24]}); numbers are not"
            " checked against it."
        )


def _loose(text: str) -> Iterator[float]:
    """The numbers that coordinates can be made of where one that is said as a coordinate has no
    partner.
    """
    found: dict[float, None] = {}
    alone = False
    for reading in rewritings(text):
        paired = {spot for _x, _y, start, end in positions(reading) for spot in range(start, end)}
        for quantity in quantities(reading):
            if quantity.unit not in ("m", None):
                continue
            if abs(quantity.said) < LARGEST:
                found[quantity.said] = None
            alone = alone or (
                reading == text
                and quantity.start not in paired
                and _said_as_coordinate(reading, quantity)
            )
    if alone:
        yield from found


def _said_as_coordinate(text: str, quantity: Quantity) -> bool:
    return bool(
        _AXIS_CUE.search(text[max(0, quantity.start - 24) : quantity.start])
        or _CUE_BEHIND.match(text[quantity.end : quantity.end + 40])
    )
