"""The places that a text states: pairs in brackets, with axes or with directions, and two bare
numbers behind words that lead to a place.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterator

from planner_ft.data.numerals import signed
from planner_ft.data.quantities import positions
from planner_ft.data.task import geometry as g
from planner_ft.decoding.constraints.reading import wordings as w
from planner_ft.decoding.constraints.reading.paths import destination_wordings as d
from planner_ft.decoding.constraints.reading.paths import run_wordings as r
from planner_ft.decoding.constraints.reading.paths.run_parts import without_places
from planner_ft.decoding.constraints.reading.paths.shapes import Place, Uncertain


def stated_places(text: str) -> Iterator[Place]:
    """The places that the text states: pairs in brackets, with axes or with directions; and two
    numbers behind words that lead to a place.
    """
    found: list[Place] = []
    for match in r.EXPLICIT.finditer(text):
        found += _explicit(match, text)
    rest = without_places(text, found)
    pairs = [pair for pair in positions(rest) if _can_be_pair(rest, pair[2], pair[3])]
    leading = [pair for pair in pairs if _is_pair(rest, pair[2], pair[3])]
    if any(
        one[3] > two[2]
        for one, two in itertools.pairwise(sorted(leading, key=lambda pair: pair[2]))
    ):
        raise Uncertain
    if any(
        not any(pair[2] < one[3] and one[2] < pair[3] for one in leading)
        and not _are_angles(rest, pair[2], pair[3])
        for pair in pairs
    ):
        raise Uncertain
    bare = [Place(g.point(x, y), start - _sign(rest[:start]), end) for x, y, start, end in leading]
    yield from sorted([*found, *bare], key=lambda place: place.start)


def _explicit(match: re.Match[str], text: str) -> list[Place]:
    """The place that EXPLICIT has found."""
    if match["a"] or match["c"]:
        x, y = signed(match["a"] or match["c"]), signed(match["b"] or match["d"])
        return [Place(g.point(x, y), match.start(), match.end())]
    first, second = match["f"].lower(), match["i"].lower()
    if (first in ("east", "west")) == (second in ("east", "west")) or (
        match["j"] and not r.OF_HOME.match(match["j"])
    ):
        raise Uncertain
    one, two = (
        signed(match[value]) * (-1 if way in ("west", "south") else 1)
        for value, way in (("e", first), ("h", second))
    )
    return [
        Place(
            g.point(one, two) if first in ("east", "west") else g.point(two, one),
            match.start(),
            match.end(),
        )
    ]


def _sign(before: str) -> int:
    """How long the sign is at the end of a text: "minus " or "-"."""
    match = r.SIGN_BEFORE.search(before)
    return len(match[0]) if match else 0


def _can_be_pair(text: str, start: int, end: int) -> bool:
    """Whether two bare numbers are no sizes, times, angles and counts."""
    said = re.sub(r"\bminus\b", "", text[start:end], flags=re.IGNORECASE)
    return not (
        w.SIZE.search(said)
        or r.ANGLE_UNIT.search(said)
        or "§" in said
        or r.MEASURED.match(text[end:])
        or w.COUNTS.search(text[:start])
    )


def _is_pair(text: str, start: int, end: int) -> bool:
    """Whether two bare numbers are a place: with a sign, or behind words that lead to one."""
    if r.ANGLES.search(text[:start]):
        return False
    return (
        r.SIGNED.search(text[max(0, start - 9) : end]) is not None
        or d.TO_PLACE.search(text[:start]) is not None
    )


def _are_angles(text: str, start: int, end: int) -> bool:
    """Whether two bare numbers are angles."""
    return (
        r.ANGLES.search(text[:start]) is not None
        and r.SIGNED.search(text[max(0, start - 9) : end]) is None
    )
