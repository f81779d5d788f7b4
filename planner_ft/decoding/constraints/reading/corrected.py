"""What a speaker takes back: "two minutes, no, make that three", "60, and not 55", "[40, 18] - no
wait, [48, 18]", "to port, sorry, starboard".
"""

from __future__ import annotations

import itertools
import re
from dataclasses import dataclass

from planner_ft.data.numerals import UNITS
from planner_ft.data.quantities import Quantity, quantities

_CORRECTION = re.compile(
    r"(?: [a-z]+){0,2}[\s,.;:()…–—-]+(?:no,? (?:wait|make (?:that|it)|sorry|hang on|rather|i"
    r" mean)|scratch that|scrap that|strike that|correction|or rather|"
    r"i meant?|make that|belay that|my mistake|i misread|sorry,? (?:make it|that's|i"
    r" mean))\b[\s,.:;…–—-]*(?:it'?s |it is |that'?s |make (?:it|that) |to )?",
    re.IGNORECASE,
)
_NO = re.compile(r"[\s,.;:()…–—-]*[,.;…–—-] ?no,? (?:it'?s |it is |that'?s )?", re.IGNORECASE)
_NOT = re.compile(r"(?:,|;|\band|\bbut|\(|^|[–—-]) ?not (?:the |at |of |for )?$", re.IGNORECASE)
_COORDINATE = re.compile(r" ?[NESW]\b")
LEAST = 0.2
"""A number that corrects another is at least this share of it, and at most as many times as
large.
"""


@dataclass(frozen=True)
class Corrections:
    """Values that were taken back and said nowhere else, and those said instead in the unit of the
    first ("two minutes, no, three").
    """

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
        alike = (
            two.unit == one.unit
            if two.unit
            else one.unit is None or LEAST < two.said / (one.said or 1) < 1 / LEAST
        )
        if (
            alike
            and one.value != two.value
            and (_CORRECTION.fullmatch(between) or _NO.fullmatch(between))
        ):
            dropped.append(one)
            if two.unit is None and one.unit is not None and one.said:
                instead.add(two.value * one.value / one.said)
    dropped += [
        number
        for number in numbers
        if len(numbers) > 1
        and _NOT.search(text[: number.start])
        and not _COORDINATE.match(text, number.end)
    ]
    kept = {number.value for number in numbers if number not in dropped}
    return Corrections(frozenset(number.value for number in dropped) - kept, frozenset(instead))


_NUMBER = r"[-−–]?\d+(?:\.\d+)?"
_PAIR = rf"[\[(]\s*{_NUMBER}\s*[,;/]\s*{_NUMBER}\s*[\])]"
_COMPASS = r"(?:north|south|east|west)(?:[ -]?(?:north|south|east|west)){0,2}"
_SIDE = r"port|starboard|left|right|(?:(?:counter|anti)-?)?clockwise"
_KINDS = tuple(
    re.compile(rf"(?<![\w-]){kind}(?![\w-])" if kind[0] != "[" else kind, re.IGNORECASE)
    for kind in (_PAIR, f"(?:{_COMPASS})", f"(?:{_SIDE})")
)
_SAID_AGAIN = re.compile(
    rf"(?P<place>{_PAIR})[\s,.;:-]*(?:i )?(?:say again|repeat):?,? (?:to |the )?(?P=place)",
    re.IGNORECASE,
)
_NOT_THIS = re.compile(
    rf"(?P<place>{_PAIR})(?:,| -| –|;)? (?:and )?not (?:to |at )?{_PAIR}", re.IGNORECASE
)
_BUT_THAT = re.compile(
    rf"\bnot (?:to |at )?{_PAIR},? but (?:to |at )?(?P<place>{_PAIR})", re.IGNORECASE
)
_SELF = re.compile(
    r"no|sorry|correction|mean|meant|misread|mistake|scratch|strike|belay|wrong|typo|apologies|scrap|misspoke|oops"
)
"""Words of which one at least stands between what is taken back and what is said instead."""
_AROUND = re.compile(
    r"wait|hang|hold|on|the|chart|line|of|sheet|column|row|that|thats|is|it|its|should|be|was|my|i|make|to|rather|actually|er|uh|um|oh|"
    r"ah|read|says|said|what|want|we|you|instead|go|at|for|ive|got|a|please|list|page|map|note|them|or|right|correct|have|has|been|ok|"
    r"okay|well|heading|bearing|course|do|one|say"
)
_UNIT_BEHIND = re.compile(r"[a-z°]+$", re.IGNORECASE)


def as_corrected(text: str) -> str:
    """A text in which what is plainly taken back is not said at all: places, directions, sides and
    numbers.
    """
    text = _SAID_AGAIN.sub(r"\g<place>", text)
    text = _BUT_THAT.sub(r"\g<place>", _NOT_THIS.sub(r"\g<place>", text))
    for kind in _KINDS:
        text = _without_first(text, [match.span() for match in kind.finditer(text)])
    pairs = [match.span() for match in _KINDS[0].finditer(text)]
    numbers = [
        one
        for one in quantities(text)
        if text[one.start : one.end].lower() != "oh"
        and not any(start <= one.start < end for start, end in pairs)
    ]
    for one, two in reversed([*itertools.pairwise(numbers)]):
        alike = two.unit == one.unit or (
            two.unit is None and LEAST < two.said / (one.said or 1) < 1 / LEAST
        )
        if alike and takes_back(text[one.end : two.start]):
            unit = (
                _UNIT_BEHIND.search(text[one.start : one.end])
                if two.unit is None and one.unit is not None
                else None
            )
            behind = f" {unit[0]}" if unit and unit[0].lower() in UNITS else ""
            if two.unit == one.unit or behind:
                text = text[: one.start] + text[two.start : two.end] + behind + text[two.end :]
    return text


def _without_first(text: str, spans: list[tuple[int, int]]) -> str:
    """The text without those of the places, directions or sides that the next one takes back."""
    for one, two in reversed([*itertools.pairwise(spans)]):
        if takes_back(text[one[1] : two[0]]):
            text = text[: one[0]] + text[two[0] :]
    return text


def takes_back(between: str) -> bool:
    """Whether words say nothing but that what was said before them was wrong."""
    words = re.sub(r"['’]", "", between.lower())
    said = re.findall(r"[a-z]+", words)
    opened = re.match(r"\s*(?:[,.;:(–—-]|no\b|sorry\b|i mean)", words) is not None
    # "No wait" alone may be an order.
    plain = re.search(r"\d|[\[\])]|no wait\s*[;.]", words) is None and all(
        _SELF.fullmatch(word) or _AROUND.fullmatch(word) for word in said
    )
    return (
        opened
        and plain
        and len(said) <= 10
        and (
            any(_SELF.fullmatch(word) for word in said)
            or re.search(r"\bor (?:rather|make (?:it|that))\b", words) is not None
        )
        and not words.rstrip().endswith("not")
    )
