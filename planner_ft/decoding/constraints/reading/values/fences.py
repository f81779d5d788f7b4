"""The fences that an input states as lists of corners: "inside (0, 0), (60, 0), (60, 40) and (0,
40)".
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from planner_ft.data.numerals import signed
from planner_ft.decoding.constraints.facts import WRITTEN_PAIR, Position, in_metres
from planner_ft.decoding.constraints.reading.wordings import FENCE_BEHIND

LEAST_CORNERS = 3
_FENCED = re.compile(
    r"fenc\w*|bound\w*|\bbounds\b|polygon|\bbox\b|\binside\b|\bwithin\b|limits?\b|\bzone\b|\barea\b|rectangle|triangle|quadrilateral|"
    r"\bstay(?:ing)? in\b|\bleav(?:e|ing)\b|"
    r"confin\w+|border\w*|perimeter|corners",
    re.IGNORECASE,
)
_NUMBER = re.compile(r"[-−–]?\d+(?:\.\d+)?")
_SEPARATOR = re.compile(r"[\s,;/|)\](\[–—-]{0,5}(?:and|then|to)?[\s,;/|(\[]{0,4}")
"""What stands between the corners of one list."""


def fences(text: str) -> Iterator[list[Position]]:
    """The lists of corners that stand behind or before words for a fence, in metres."""
    metres = in_metres(text)
    runs: list[list[re.Match[str]]] = []
    for match in WRITTEN_PAIR.finditer(text):
        if runs and _SEPARATOR.fullmatch(text[runs[-1][-1].end() : match.start()]):
            runs[-1].append(match)
        else:
            runs.append([match])
    for number, run in enumerate(runs):
        begins = max(
            text.rfind(". ", 0, run[0].start()) + 1, runs[number - 1][-1].end() if number else 0
        )
        if len(run) >= LEAST_CORNERS and (
            _FENCED.search(text[begins : run[0].start()])
            or FENCE_BEHIND.match(text[run[-1].end() :])
        ):
            corners = [
                tuple(signed(part) for part in _NUMBER.findall(match.group())) for match in run
            ]
            yield [metres.get(corner, corner) for corner in corners if len(corner) == 2]
