"""Some steps of a plan, the words of a text that mean some, and what there is to tell by which."""

from __future__ import annotations

import functools
import re
from collections.abc import Sequence
from dataclasses import dataclass

from planner_ft.decoding.constraints.reading.rows.movement_rows import Plain, Row
from planner_ft.decoding.constraints.reading.scopes import step_scope_words as s


@dataclass(frozen=True)
class Where:
    """Some steps: those of movements of the text, of kinds of movement, or every other waypoint."""

    units: frozenset[int] | None = None
    kinds: frozenset[str] | None = None
    parity: int | None = None
    beginning: bool | None = None
    """Whether they are the first waypoint, or all others."""

    def holds(self, names: Sequence[str], row: Row | None) -> bool | None:
        """Whether the last of some steps is one of these."""
        if self.parity is not None:
            return names[-1] == s.GOTO and (names.count(s.GOTO) - 1) % 2 == self.parity
        if self.beginning is not None:
            return names[-1] == s.GOTO and (names.count(s.GOTO) == 1) == self.beginning
        unit = row.unit(names) if row is not None else None
        if unit is not None and self.units is not None:
            return unit in self.units
        return names[-1] in self.kinds if self.kinds is not None else None


EVERYWHERE = Where(kinds=s.ANY)


@dataclass(frozen=True)
class Anchor:
    """A scope or a movement of the text, with the steps that it means (None: not read)."""

    start: int
    end: int
    is_scope: bool
    where: Where | None
    denied: bool = False
    kind: str = ""


@dataclass(frozen=True)
class Phrase:
    """The words of a scope, with what tells the steps that they mean: the text, the row of its
    movements, and the anchors before the words.
    """

    kind: str
    match: re.Match[str]
    row: Row
    before: Sequence[Anchor]
    said: Plain

    @property
    def words(self) -> str:
        return self.match[0]

    @property
    def count(self) -> int:
        """How many movements the text has."""
        return len(self.row.units)

    @property
    def last(self) -> Where | None:
        """The steps that were spoken of last."""
        return self.before[-1].where if self.before else None

    @functools.cached_property
    def passed(self) -> list[int]:
        """The movements before the words."""
        return [
            index for index, unit in enumerate(self.row.units) if unit.end <= self.match.start()
        ]

    @functools.cached_property
    def goes(self) -> tuple[int, ...]:
        """The movements to waypoints."""
        return self.row.of(frozenset({s.GOTO}))

    @property
    def noun(self) -> str | None:
        return self.group("noun") or self.group("noun2")

    @property
    def place(self) -> tuple[float, float] | None:
        """The place that the words name."""
        return self.said.places.get(self.match.start() + self.words.find("@"))

    def group(self, name: str) -> str | None:
        """A part of the words by its name; None where they have none."""
        return self.match.groupdict().get(name)

    def kinds_at(self, units: Sequence[int] | frozenset[int]) -> frozenset[str]:
        """The kinds of some movements."""
        return frozenset(self.row.units[index].kind for index in units)


def at(units: Sequence[int] | frozenset[int] | range) -> Where | None:
    """The steps of some movements; None for none."""
    return Where(frozenset(units)) if units else None


def the_one(units: Sequence[int]) -> Where | None:
    """The steps of the one movement; None where there are more or none."""
    return at(units) if len(units) == 1 else None
