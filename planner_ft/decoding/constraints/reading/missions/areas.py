"""Which side of an area is its width and which its length, where a command says so: "60 is the
width", "the longer dimension is the length".
"""

from __future__ import annotations

import itertools
import re

from planner_ft.data.quantities import Quantity, quantities

_BY = re.compile(r"\s?(?:m\s?)?(?:by|x|×)\s?", re.IGNORECASE)
_BEHIND = re.compile(
    r"[\s,-]{0,2}(?:m )?(?:(?P<wide>wide|broad|across)|(?P<long>long)|(?:in|of|for|is|as|being|=)?"
    r" ?(?:the |its )?(?P<name>width|length|breadth))\b"
    r"(?! (?:of|is|=|:)? ?\d)",
    re.IGNORECASE,
)
_BEFORE = re.compile(r"\b(?P<name>width|length|breadth)(?: is| of|:|=|,)? ?$", re.IGNORECASE)
_LONGER = re.compile(
    r"\b(?P<one>long|short|larg|small|great|bigg?)(?:er|est)?"
    r" (?:dimension|side|one|figure|number|value|edge|way)(?: of (?:the"
    r" )?(?:two|box|area|grid))?,? "
    r"(?:is|being|as|for|goes as|counts as) (?:the |its )?(?P<name>width|length)\b"
    r"|\b(?P<other>width|length) (?:is|being|as|=) the"
    r" (?P<two>long|short|larg|small|great|bigg?)er\b",
    re.IGNORECASE,
)
WIDTH, LENGTH = "width", "length"


def read_area(text: str) -> dict[str, float]:
    """Width and length in metres of the only area that a text speaks of, where it says which is
    which; empty where it does not.
    """
    numbers = [one for one in quantities(text) if one.unit in ("m", None)]
    pairs = [
        (one, two)
        for one, two in itertools.pairwise(numbers)
        if _BY.fullmatch(text[one.end : two.start])
    ]
    sizes = {(round(one.value, 4), round(two.value, 4)) for one, two in pairs}
    said = _labelled(text, numbers)
    if len(sizes) > 1 or any(len(values) > 1 for values in said.values()):
        return {}
    told = {name: next(iter(values)) for name, values in said.items()}
    if not sizes:
        return told if len(told) == 2 and len(numbers) < 12 else {}
    first, second = next(iter(sizes))
    longer = _longer(text)
    if longer and first != second:
        large, small = max(first, second), min(first, second)
        return {LENGTH: large, WIDTH: small} if longer == LENGTH else {WIDTH: large, LENGTH: small}
    told = {name: value for name, value in told.items() if value in (first, second)}
    if len(told) == 1 and first != second:
        name, value = next(iter(told.items()))
        told[LENGTH if name == WIDTH else WIDTH] = second if value == first else first
    return told if sorted(told.values()) == sorted((first, second)) else {}


def _labelled(text: str, numbers: list[Quantity]) -> dict[str, set[float]]:
    found: dict[str, set[float]] = {}
    used = 0
    for number in numbers:
        behind, before = (
            _BEHIND.match(text, number.end),
            _BEFORE.search(text, max(used, number.start - 14), number.start),
        )
        used = behind.end() if behind and not before else used
        name = (
            before["name"]
            if before
            else behind and (behind["name"] or (LENGTH if behind["long"] else WIDTH))
        )
        if name:
            found.setdefault(WIDTH if name.lower() in (WIDTH, "breadth") else LENGTH, set()).add(
                round(number.value, 4)
            )
    return found


def _longer(text: str) -> str | None:
    """The name of the longer side, where the text says it."""
    names = set()
    for match in _LONGER.finditer(text):
        name, size = (
            (match["name"] or match["other"]).lower(),
            (match["one"] or match["two"]).lower(),
        )
        names.add(name if size not in ("short", "small") else WIDTH if name == LENGTH else LENGTH)
    return names.pop() if len(names) == 1 else None
