"""The word lists of facts/english.toml as Python tables."""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import NamedTuple

FOLDER = Path(__file__).parent
_ENGLISH = tomllib.loads((FOLDER / "english.toml").read_text(encoding="utf-8"))
_NUMERALS = _ENGLISH["numerals"]


class Unit(NamedTuple):
    """A unit: what one of it is in the base unit, and what is added to that (degrees)."""

    base: str
    factor: float
    added: float = 0.0

    def in_base(self, value: float) -> float:
        return value * self.factor + self.added

    def of_base(self, value: float) -> float:
        return (value - self.added) / self.factor


UNITS: dict[str, Unit] = {
    word: Unit(row["unit"], float(factor))
    for row in _ENGLISH["units"]
    for factor, words in row["words"].items()
    for word in words.split()
}
"""Word to the unit that parameters have and the factor to it."""
SPOKEN = (None, *dict.fromkeys(unit.base for unit in UNITS.values()))
"""Their bases. Beside these, a letter behind a number is no unit, and "a bar" is none."""

SMALL: dict[str, float] = {
    **{word: float(value) for value, word in enumerate(_NUMERALS["ones"].split())},
    **{word: 10.0 * value for value, word in enumerate(_NUMERALS["tens"].split(), 2)},
    **{word: float(value) for word, value in _NUMERALS["others"].items()},
}
DIGITS = {word: str(int(value)) for word, value in SMALL.items() if value < 10 and word != "couple"}
SCALES: dict[str, float] = _NUMERALS["scales"]
FRACTIONS: dict[str, float] = _NUMERALS["fractions"]
PARTS = {**FRACTIONS, "quarters": 0.25, "thirds": 1 / 3}
ORDINALS = {
    form: 1 / value
    for value, word in [
        *enumerate(_NUMERALS["ordinals"].split(), 5),
        *((3, "third"), (20, "twentieth")),
    ]
    for form in (word, f"{word}s")
}
"""Parts of a unit: "a tenth of an hour". Elsewhere these words count steps."""
VULGAR: dict[str, float] = _NUMERALS["vulgar"]
PRONOUNCED: dict[str, str] = _NUMERALS["pronounced"]
TURNS = {word: float(value) for value, words in _ENGLISH["turns"].items() for word in words.split()}
"""Words for a part or a number of full circles."""
COMPASS = tuple(_ENGLISH["compass"]["names"].split())
SHORT = tuple(_ENGLISH["compass"]["short"].split())
"""Compass points in steps of 22.5 degrees from north."""
WORDS = {name: tuple(words.split()) for name, words in _ENGLISH["words"].items()}
TIMES: dict[str, float] = _ENGLISH["times"]
"""Words for how often."""
MULTIPLES: dict[str, float] = _ENGLISH["multiples"]
"""Words for a time or length by another one: "hold twice as long", "half the distance"."""
