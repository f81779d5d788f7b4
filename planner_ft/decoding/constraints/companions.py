"""Which filter and perception skills run beside a movement, as far as the input says it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from planner_ft.decoding.constraints.reading import LONGEST
from planner_ft.decoding.constraints.reading.asked import asked_movements
from planner_ft.decoding.constraints.reading.evidence import required, spoken_of
from planner_ft.decoding.constraints.reading.movements import spoken_movements
from planner_ft.decoding.constraints.reading.scopes import Scope, read_scopes
from planner_ft.vocabulary import Vocabulary


@dataclass(frozen=True)
class Companions:
    """What an input says of the skills beside its movements.

    `spoken` are those that it speaks of, `movements` the navigation skills likewise (None: that cannot be told); `asked` are those that it asks for
    beyond doubt, movements among them, `scopes` the steps in which some run.
    """

    spoken: frozenset[str] | None = None
    asked: frozenset[str] = frozenset()
    movements: frozenset[str] | None = None
    scopes: Mapping[str, Scope] = field(default_factory=dict)

    def runs(self, skill: str, movement: str, earlier: Sequence[str]) -> bool | None:
        """Whether a skill must run (True) or must not (False) beside a movement, behind those `earlier`; None where the model decides."""
        if self.spoken is not None and skill not in self.spoken:
            return False
        scope = self.scopes.get(skill)
        verdict = scope.allows(len(earlier), movement, None, earlier) if scope else None
        return None if verdict and skill not in self.asked else verdict


def read_companions(record: dict[str, Any], vocabulary: Vocabulary) -> Companions:
    """What the prompt of a task input says of the skills beside its movements."""
    text = str(record.get("prompt", ""))
    spoken = spoken_of(text, vocabulary) if len(text) <= LONGEST else None
    if spoken is None:
        return Companions()
    scopes = {name: scope for name, scope in read_scopes(text, vocabulary).items() if name in spoken}
    return Companions(spoken, required(text, vocabulary) | asked_movements(text, vocabulary), spoken_movements(text, vocabulary), scopes)
