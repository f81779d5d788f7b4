"""Positions of a command that are written as such, and rows of them."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from planner_ft.facts.numbers import read_numbers
from planner_ft.facts.places import Position, read_positions

PAIR = re.compile(r"[-−–]?\d+(?:\.\d+)?\s?[,/]\s?[-−–]?\d+(?:\.\d+)?")
BESIDE = re.compile(r"[\s,;\])\[(]*(?:and|to|then)?[\s,;\])\[(]*")
"""What stands between the positions of a row."""


def positions_of(text: str) -> list[Position]:
    """Positions that are written as such: certain ones, and "40,25"; none overlaps another."""
    numbers = {number.end: number for number in read_numbers(text) if number.unit}
    chosen = list[Position]()
    options = [
        place
        for place in read_positions(text)
        if place.certain
        or (PAIR.fullmatch(text, place.start, place.end) and place.end not in numbers)
    ]
    tight = sorted(options, key=lambda place: (not place.certain, place.end - place.start))
    for place in tight:
        if all(place.end <= one.start or one.end <= place.start for one in chosen):
            chosen.append(place)
    return sorted(chosen, key=lambda place: place.start)


def rows_of(text: str, pairs: Sequence[Position]) -> Iterator[list[Position]]:
    """Positions with nothing but "and", "then" and marks between them."""
    row = list[Position]()
    for place in pairs:
        if row and not BESIDE.fullmatch(text, row[-1].end, place.start):
            yield row
            row = []
        row.append(place)
    if row:
        yield row
