"""Commands in sections, one per place ("Pier 4, at [80, -10]: ... both 5 m off. Pier 5, at ...:
..."): what a section says is meant for its place alone.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from planner_ft.data.numerals import signed
from planner_ft.data.quantities import quantities
from planner_ft.decoding.constraints.reading.missions.apart import PLACE, SENTENCE, Given

_HEAD = re.compile(
    r"\s*(?:(?:[Aa]t |[Oo]n |[Ff]irst,? |[Tt]hen,? )?(?:[^\s.;:!?,\[(]+,? ){0,6})\(?$"
)
"""What stands before the place that a section is about."""
_COLON = re.compile(r"\)?\s*[:–—]\s")
_SHARED = re.compile(
    r"\b(?:same|likewise|ditto|again|as"
    r" (?:before|above|for|with|there)|each|all|every\w*|throughout|respectively|other|another|twice|half"
    r" of|double"
    r"|too|also|instead|sorry|no,)\b",
    re.IGNORECASE,
)
"""Words by which a section may mean what another one says."""


def read_sections(text: str) -> Given:
    """The values of the sections of a text, by place; none where something is said for all of
    them.
    """
    starts = [0, *(match.end() for match in SENTENCE.finditer(text))]
    heads = [(start, place) for start in starts for place in [_head(text, start)] if place]
    if len(heads) < 2 or _SHARED.search(text) or len(PLACE.findall(text)) != len(heads):
        return {}
    ends = [*(start for start, _place in heads[1:]), len(text)]
    # What follows the first sentence of the last section may be about all places.
    last = next((start for start in starts if start > heads[-1][1].end()), len(text))
    if quantities(text[: heads[0][0]]) or quantities(text[last:]):
        return {}
    return {
        (signed(place[1]), signed(place[2])): dict(_values(text[place.end() : end]))
        for (_start, place), end in zip(heads, ends, strict=True)
    }


def _head(text: str, start: int) -> re.Match[str] | None:
    """The place that a sentence begins with, if a colon stands behind it."""
    place = PLACE.search(text, start, start + 120)
    return (
        place
        if place and _HEAD.fullmatch(text, start, place.start()) and _COLON.match(text, place.end())
        else None
    )


def _values(section: str) -> Iterator[tuple[str, frozenset[float]]]:
    """Lengths and durations of a section; whether a bare number is one, only its task says."""
    numbers = quantities(section)
    for unit in ("m", "s"):
        values = {round(number.value, 4) for number in numbers if number.unit in (unit, None)}
        if any(number.unit == unit for number in numbers):
            yield unit, frozenset(values)
