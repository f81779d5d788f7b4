"""What straight runs and ways to places are read from: the task's own facts, what leads somewhere
in a text, and how certain that is.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Any, Literal

from planner_ft.decoding.constraints.reading.paths import run_wordings as r
from planner_ft.decoding.constraints.reading.paths.shapes import Place, Point

Grade = Literal["sure", "maybe", "mention"]


@dataclass(frozen=True)
class Event:
    """Something that leads to a place: the place itself, or a way (bearing, length) from where the
    vehicle is, from `start` to `end` of the text.

    `sure`: the words say so; `maybe`: it is said beside something else ("while going to"), and
    counts where the place is not named otherwise; `mention`: it is spoken of only. `since`: where
    the words begin that are understood with it.
    """

    start: int
    end: int
    point: Point | None
    way: tuple[float, float] | None = None
    grade: Grade = "sure"
    since: int | None = None


@dataclass(frozen=True)
class TaskFacts:
    parameters: dict[str, Any]
    own: Point | None
    home: Point

    def number(self, *names: str) -> float | None:
        """The first of these parameters that the task has."""
        return next(
            (
                value
                for name in names
                if isinstance(value := self.parameters.get(name), int | float)
            ),
            None,
        )


def unquoted(text: str) -> str:
    """A text with blanks for notes and names, which say nothing about the way."""
    return r.QUOTED.sub(lambda quoted: " " * len(quoted[0]), text)


def without_places(text: str, places: list[Place]) -> str:
    """A text with a mark on each letter of its places."""
    for place in places:
        text = text[: place.start] + "§" * (place.end - place.start) + text[place.end :]
    return text


def last_clause(before: str) -> str:
    """What stands behind the last mark."""
    return re.split(r"[.;:]\s|[–—]\s", before)[-1]
