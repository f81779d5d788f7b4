"""The movements of a task input as a row: in which of them a step of a plan is, found by the plan's
own movements.

A movement of the text is one step where it goes to a place or turns once, and as many as it takes
where it runs a grid or a line.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

from planner_ft.data.quantities import positions
from planner_ft.decoding.constraints.reading.paths.itinerary import without_fences
from planner_ft.decoding.constraints.reading.rows import movement_words as m


@dataclass(frozen=True)
class Unit:
    """A movement of the text: its navigation skill, where its words stand, of how many steps it is
    (None: not known), and the place that it goes to.

    One that is `chained` is a place that the one before it is followed by.
    """

    kind: str
    start: int
    end: int
    steps: int | None = 1
    place: tuple[float, float] | None = None
    chained: bool = False

    @property
    def single(self) -> bool:
        return self.steps == 1


@dataclass(frozen=True)
class Row:
    """The movements of a text in their order."""

    units: tuple[Unit, ...]

    def unit(self, names: Sequence[str]) -> int | None:
        """In which movement the last of some steps is; None where the steps are not those of the
        text.
        """
        at, done = -1, 0
        for name in names:
            unit = self.units[at] if at >= 0 else None
            if unit is not None and name == unit.kind and (unit.steps is None or done < unit.steps):
                if (
                    unit.steps is None
                    and at + 1 < len(self.units)
                    and self.units[at + 1].kind == name
                ):
                    return None
                done += 1
                continue
            at, done = at + 1, 1
            if (
                at >= len(self.units)
                or self.units[at].kind != name
                or (
                    unit is not None
                    and unit.steps is not None
                    and unit.steps > 1
                    and unit.kind == name
                )
            ):
                return None
        return at if at >= 0 else None

    def of(self, kinds: frozenset[str]) -> tuple[int, ...]:
        """The movements of some kinds."""
        return tuple(index for index, unit in enumerate(self.units) if unit.kind in kinds)


@dataclass(frozen=True)
class Plain:
    """A text in small letters with signs for places and quotations, the places, and where each
    letter stood.
    """

    text: str
    places: dict[int, tuple[float, float]]
    origin: tuple[int, ...]


_SIGN = re.compile(r"(?:\b(?:x|minus|\+)\s*=?\s*|[\[({]\s?|[-−–](?=~))*~(?:\s?[\])}])*")
_WRITTEN = re.compile(
    r"^(?!.*(?:minute|second|hour|metre|meter)).*(?:\d|\b[xy]\b|minus)", re.DOTALL
)
_NAMED = re.compile(r"\b(?:position|waypoint|point)\s+(?=~)")
_LITERAL = re.compile(r"\s*@\s*")


def plain(text: str) -> Plain:
    """The text as `Plain`: ~ for a place while it is made, @ in the end."""
    made, origin = without_fences(text).lower(), tuple(range(len(text)))
    if len(made) != len(text):
        return Plain("", {}, ())
    made, origin = _put(
        made, origin, [(match.start(), match.end(), " at ") for match in _LITERAL.finditer(made)]
    )
    found, behind = [], len(made)
    for x, y, start, end in sorted(positions(made), key=lambda place: -place[2]):
        if (
            end <= behind
            and not m.COUNTED.search(made[:start])
            and _WRITTEN.search(made[start:end])
        ):
            found.append((start, end, (float(x), float(y))))
            behind = start
    found.reverse()
    made, origin = _put(made, origin, [(start, end, "~") for start, end, _place in found])
    for pattern, sign in (
        (m.QUOTED, " q "),
        (_NAMED, ""),
        (_SIGN, "@"),
        (m.SENSORS, " cam "),
        (re.compile(r"\s+(?=[,.;:!?])"), ""),
        (re.compile(r"[ \t]+"), " "),
    ):
        made, origin = _put(
            made, origin, [(match.start(), match.end(), sign) for match in pattern.finditer(made)]
        )
    signs = [match.start() for match in re.finditer("@", made)]
    places = (
        {sign: place for sign, (_start, _end, place) in zip(signs, found, strict=True)}
        if len(signs) == len(found)
        else {}
    )
    return Plain(made, places, origin)


def _put(
    text: str, origin: tuple[int, ...], parts: list[tuple[int, int, str]]
) -> tuple[str, tuple[int, ...]]:
    """A text with other words in some parts, and where its letters stood."""
    made: list[str] = []
    where: list[int] = []
    end = 0
    for start, stop, sign in parts:
        made += [text[end:start], sign]
        where += [*origin[end:start], *[origin[start] if start < len(origin) else 0] * len(sign)]
        end = stop
    return "".join([*made, text[end:]]), (*where, *origin[end:])
