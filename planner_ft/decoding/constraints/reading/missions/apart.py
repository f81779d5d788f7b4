"""Values that a command gives apart to several places: "at A, B and C for 2, 4 and 6 minutes
respectively", "pier A at 1 m/s and pier B at 0.6".
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterator, Sequence

from planner_ft.data.numerals import UNITS, signed
from planner_ft.data.quantities import Quantity, quantities

Point = tuple[float, float]
Given = dict[Point, dict[str, frozenset[float]]]
"""Per place the values in each unit that are meant for it."""
MOST = 8
_NUMBER = r"[-−–]?\d{1,7}(?:\.\d{1,4})?"
PLACE = re.compile(rf"[\[(]\s*({_NUMBER})\s*[,;/]\s*({_NUMBER})\s*[\])]")
SENTENCE = re.compile(r"[.;!?](?=\s|$)|\n")
_RESPECTIVELY = re.compile(
    r"\b(?:respectively|in (?:that|this|the same) order|in order named)\b", re.IGNORECASE
)
_LISTED = re.compile(r",? and |, ?", re.IGNORECASE)
_NAME = (
    r"(?P<noun>[A-Za-z][a-z]{2,})s?(?: no\.?| number)? (?P<id>[A-Z]|\d{1,3}|[A-Z]{1,4}-?\d{1,3})"
)
_NAMED = re.compile(rf"\b{_NAME}(?:,| is| stands| lies)?(?: at| in| on|:)? ?\(?$")
_NAMES = re.compile(
    r"\b(?P<noun>[A-Za-z][a-z]{2,}s) (?P<ids>(?:[A-Z]|\d{1,3})(?:, (?:[A-Z]|\d{1,3})){0,6},? and"
    r" (?:[A-Z]|\d{1,3}))"
    r"(?: are| lie| stand| sit)?(?: at| in)?:? $"
)
_MENTION = re.compile(rf"\b{_NAME}(?!\w|['’.]\d)")
_SAME = re.compile(r"\b(?:same|as for|as with|like|ditto|likewise|both|each|all)\b", re.IGNORECASE)


def read_apart(text: str) -> Given:
    """What a text gives to one of its places alone."""
    places = [
        ((signed(match[1]), signed(match[2])), match.start(), match.end())
        for match in PLACE.finditer(text)
    ]
    if not 2 <= len({place for place, _start, _end in places}) <= MOST:
        return {}
    blank = PLACE.sub(lambda match: " " * len(match[0]), text)
    found: Given = {}
    for place, unit, values in (*_in_order(text, blank, places), *_by_name(text, blank, places)):
        units = found.setdefault(place, {})
        units[unit] = units.get(unit, frozenset()) | values
    return found


def lists_of_numbers(text: str) -> Iterator[tuple[Quantity, ...]]:
    """Numbers that stand in a row, the last with a unit, which is that of all: "2, 4 and 6
    minutes".
    """
    rows: list[list[Quantity]] = []
    for number in quantities(text):
        last = rows[-1][-1] if rows else None
        if (
            last
            and _LISTED.fullmatch(text[last.end : number.start])
            and last.unit in (None, number.unit)
            and last.said > 0
        ):
            rows[-1].append(number)
        else:
            rows.append([number])
    for row in rows:
        last = row[-1]
        if len(row) > 1 and last.unit is not None:
            factor = last.value / last.said if last.said else 1.0
            yield tuple(
                (
                    Quantity(one.said * factor, last.unit, one.start, one.end, one.said)
                    if one.unit is None
                    else one
                )
                for one in row
            )


def _in_order(
    text: str, blank: str, places: list[tuple[Point, int, int]]
) -> Iterator[tuple[Point, str, frozenset[float]]]:
    """Lists of as many values as there are places, in the order of these."""
    for row in lists_of_numbers(blank):
        start, end = _sentence(text, row[0].start)
        near = [item for item in places if start <= item[1] < end] or places
        said = _RESPECTIVELY.search(text, start, end) or len(row) > 2
        if said and len(near) == len(row) and len({item[0] for item in near}) == len(row):
            yield from (
                (item[0], number.unit or "", frozenset({round(number.value, 4)}))
                for item, number in zip(near, row, strict=True)
            )


def _by_name(
    text: str, blank: str, places: list[tuple[Point, int, int]]
) -> Iterator[tuple[Point, str, frozenset[float]]]:
    """What stands behind the name of a place, up to the next name, place or sentence."""
    named = dict(named_places(text, places))
    if len(set(named.values())) < 2:
        return
    mentions = [(match, _key(match)) for match in _MENTION.finditer(blank) if _key(match) in named]
    marks = sorted(
        [
            *(match.start() for match, _key_ in mentions),
            *(start for _place, start, _end in places),
            len(text),
        ]
    )
    before: Quantity | None = None
    for match, key in mentions:
        end = min(
            next(mark for mark in marks if mark >= match.end()), _sentence(text, match.start())[1]
        )
        if any(
            match.end() <= start <= match.end() + 12 for _place, start, _end in places
        ) or _SAME.search(text, match.end(), end):
            before = None
            continue
        numbers = [one for one in quantities(blank[:end]) if one.start >= match.end()]
        for number in numbers:
            if number.unit is None and before is not None and len(numbers) == 1 and before.said:
                number = Quantity(
                    number.said * before.value / before.said,
                    before.unit,
                    number.start,
                    number.end,
                    number.said,
                )
            if number.unit in ("s", "m", "m/s"):
                yield named[key], number.unit, frozenset({round(number.value, 4)})
        before = numbers[0] if len(numbers) == 1 and numbers[0].unit else None


def named_places(
    text: str, places: Sequence[tuple[Point, int, int]]
) -> Iterator[tuple[tuple[str, str], Point]]:
    """The names of places: "pier A at [1, 2]", "rafts 1, 2 and 3 are at [1, 2], [3, 4] and [5,
    6]".
    """
    for index, (place, start, _end) in enumerate(places):
        before = text[max(0, start - 80) : start]
        listed = _NAMES.search(before)
        if listed:
            ids = re.findall(r"[A-Z]|\d+", listed["ids"])
            following = places[index : index + len(ids)]
            if len(following) == len(ids) and all(
                _LISTED.fullmatch(text[one[2] : two[1]])
                for one, two in itertools.pairwise(following)
            ):
                yield from (
                    ((_singular(listed["noun"]), name), item[0])
                    for name, item in zip(ids, following, strict=True)
                )
        elif (single := _NAMED.search(before)) and single["noun"].lower() not in UNITS:
            yield _key(single), place


def _key(match: re.Match[str]) -> tuple[str, str]:
    return _singular(match["noun"]), match["id"]


def _singular(noun: str) -> str:
    return noun.lower().removesuffix("s")


def _sentence(text: str, place: int) -> tuple[int, int]:
    """Where the sentence around a place begins and ends."""
    ends = [match.start() for match in SENTENCE.finditer(text)]
    return max((end + 1 for end in ends if end < place), default=0), min(
        (end for end in ends if end >= place), default=len(text)
    )


def sentences(text: str) -> Iterator[str]:
    """The sentences of a text, but for blank ones."""
    ends = [0, *(match.end() for match in SENTENCE.finditer(text)), len(text)]
    yield from (
        text[start:end] for start, end in itertools.pairwise(ends) if text[start:end].strip()
    )
