"""Numbers that a speaker takes back: "two minutes, no, make that three", "60, and not 55"."""

from __future__ import annotations

import itertools
import re
from dataclasses import dataclass

from planner_ft.data.quantities import Quantity, quantities

_CORRECTION = re.compile(
    r"(?: [a-z]+){0,2}[\s,.;:()…–—-]+(?:no,? (?:wait|make (?:that|it)|sorry|hang on|rather|i mean)|scratch that|scrap that|strike that|correction|or rather|"
    r"i meant?|make that|belay that|my mistake|i misread|sorry,? (?:make it|that's|i mean))\b[\s,.:;…–—-]*(?:it'?s |it is |that'?s |make (?:it|that) |to )?",
    re.IGNORECASE,
)
_NO = re.compile(r"[\s,.;:()…–—-]*[,.;…–—-] ?no,? (?:it'?s |it is |that'?s )?", re.IGNORECASE)
_NOT = re.compile(r"(?:,|;|\band|\bbut|\(|^|[–—-]) ?not (?:the |at |of |for )?$", re.IGNORECASE)
_COORDINATE = re.compile(r" ?[NESW]\b")
LEAST = 0.2
"""A number that corrects another is at least this share of it, and at most as many times as large."""


@dataclass(frozen=True)
class Corrections:
    """Values that were taken back and said nowhere else, and those said instead in the unit of the first ("two minutes, no, three")."""

    taken_back: frozenset[float] = frozenset()
    instead: frozenset[float] = frozenset()


def read_corrections(text: str) -> Corrections:
    """What a text takes back of its numbers."""
    numbers = quantities(text)
    dropped: list[Quantity] = []
    instead = set()
    for one, two in itertools.pairwise(numbers):
        between = text[one.end : two.start]
        # A bare number is the other one's if it is of its size.
        alike = two.unit == one.unit if two.unit else one.unit is None or LEAST < two.said / (one.said or 1) < 1 / LEAST
        if alike and one.value != two.value and (_CORRECTION.fullmatch(between) or _NO.fullmatch(between)):
            dropped.append(one)
            if two.unit is None and one.unit is not None and one.said:
                instead.add(two.value * one.value / one.said)
    dropped += [number for number in numbers if len(numbers) > 1 and _NOT.search(text[: number.start]) and not _COORDINATE.match(text, number.end)]
    kept = {number.value for number in numbers if number not in dropped}
    return Corrections(frozenset(number.value for number in dropped) - kept, frozenset(instead))
