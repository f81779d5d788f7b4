"""What a reading of rotations is made of: the rotations that a part of a text gives (`turns`,
`counted_turns`).
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from planner_ft.decoding.constraints.reading.rows import turn_forms as f

Turn = tuple[str, float]
ROTATE, NUDGE = "RotateToHeading", "NudgeYaw"
MOST = 24
CURVED = f.compiled(r"~a|radius|circle|orbit|curve|bend|\bwide\b|round (?:it|the)\b|\bsweep")
"""Words by which a turn may be an arc."""


@dataclass(frozen=True)
class Found:
    """Rotations that the text from `start` to `end` gives; `side_note` when they are said in
    passing ("while facing ...").
    """

    start: int
    end: int
    turns: tuple[Turn, ...]
    side_note: bool = False


class Uncertain(Exception):
    """A turn that cannot be told."""


def heading(value: float) -> Turn:
    """A rotation to a heading."""
    if not 0 <= value <= 360:
        raise Uncertain
    return ROTATE, value


def blank(text: str, spans: Iterable[tuple[int, int]]) -> str:
    """The text with underscores in some parts."""
    for start, end in spans:
        text = text[:start] + "_" * (end - start) + text[end:]
    return text
