"""Which filter and perception skills run beside a movement, as far as the input says it."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from planner_ft.decoding.constraints.reading import LONGEST
from planner_ft.decoding.constraints.reading.scopes.own_sentences import read_own_sentences
from planner_ft.decoding.constraints.reading.scopes.path_scopes import PathScope, read_path_scopes
from planner_ft.decoding.constraints.reading.scopes.scope_parts import Scope
from planner_ft.decoding.constraints.reading.scopes.scopes import read_scopes
from planner_ft.decoding.constraints.reading.scopes.step_scopes import StepScope, read_step_scopes
from planner_ft.decoding.constraints.reading.skills.asked import asked_movements
from planner_ft.decoding.constraints.reading.skills.evidence import required, spoken_of
from planner_ft.decoding.constraints.reading.skills.movements import spoken_movements
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import STEP_KEYS

Path = Sequence[tuple[float, float]]


@dataclass(frozen=True)
class Companions:
    """What an input says of the skills beside its movements.

    `spoken` are those that it speaks of, `movements` the navigation skills likewise (None: that
    cannot be told); `asked` are those that it asks for beyond doubt, movements among them, `scopes`
    the steps in which some run. Those `insisted` on run in every step that does not rule them out.
    `told` are the steps as the row of the text's movements tells them, `on_path` those that places
    on a known path tell.
    """

    spoken: frozenset[str] | None = None
    asked: frozenset[str] = frozenset()
    movements: frozenset[str] | None = None
    scopes: Mapping[str, Scope] = field(default_factory=dict)
    insisted: frozenset[str] = frozenset()
    told: Mapping[str, StepScope] = field(default_factory=dict)
    on_path: Mapping[str, PathScope] = field(default_factory=dict)

    @property
    def mentioned(self) -> frozenset[str]:
        """The skills that the input speaks of, movements among them, as far as that can be told."""
        return (self.spoken or frozenset()) | (self.movements or frozenset())

    def along(self, text: str, paths: Sequence[Path], pattern: str) -> Companions:
        """These with what a text says of places on the path of its task, that is one of some of one
        shape.
        """
        found = (
            read_path_scopes(text, self.spoken, paths, pattern)
            if self.spoken and len(text) <= LONGEST
            else {}
        )
        return replace(self, on_path=found) if found else self

    def runs(
        self, skill: str, movement: str, earlier: Sequence[str], path: Path = ()
    ) -> bool | None:
        """Whether a skill must run (True) or must not (False) beside a movement, behind those
        `earlier`; None where the model decides.

        `path` are the waypoints up to that of the movement, if it goes to one.
        """
        if self.spoken is not None and skill not in self.spoken:
            return False
        if path and skill in self.on_path:
            return self.on_path[skill].allows(path)
        scope = self.scopes.get(skill)
        verdict = scope.allows(len(earlier), movement, None, earlier) if scope else None
        told = self.told[skill].allows([*earlier, movement]) if skill in self.told else None
        # Where the readings contradict each other, neither is certain.
        verdict = told if verdict is None else None if told not in (None, verdict) else verdict
        if skill in self.insisted and verdict is None:
            return True
        return None if verdict and skill not in self.asked else verdict

    def value(self, skill: str, movement: str, earlier: Sequence[str]) -> float | None:
        """The value of a skill's first parameter beside a movement, where it differs between steps
        and is told for this one.
        """
        return self.told[skill].value([*earlier, movement]) if skill in self.told else None


def read_companions(record: dict[str, Any], vocabulary: Vocabulary) -> Companions:
    """What the prompt of a task input says of the skills beside its movements."""
    text = str(record.get("prompt", ""))
    spoken = spoken_of(text, vocabulary) if len(text) <= LONGEST else None
    if spoken is None:
        return Companions()
    asked = required(text, vocabulary)
    spoken |= asked
    own = read_own_sentences(text, asked, vocabulary)
    scopes = {
        name: scope
        for name, scope in (read_scopes(text, vocabulary) | own).items()
        if name in spoken
    }
    steps = read_step_scopes(text, spoken, vocabulary)
    asked_for = asked | (steps.asked & spoken) | asked_movements(text, vocabulary)
    return Companions(
        spoken, asked_for, spoken_movements(text, vocabulary), scopes, told=steps.scopes
    )


def to_insist_on(record: dict[str, Any], answer: str, vocabulary: Vocabulary) -> frozenset[str]:
    """Filter and perception skills that the prompt of a task input asks for beyond doubt, if an
    answer in JSON has one of them in no step.
    """
    try:
        steps = json.loads(answer)["skill_sequence"]
    except ValueError:
        return frozenset()
    written = {skill["name"] for step in steps for key in STEP_KEYS[1:3] for skill in step[key]}
    asked = frozenset(
        name
        for name in read_companions(record, vocabulary).asked
        if vocabulary.skill[name].role != "navigation"
    )
    return asked if steps and asked - written else frozenset()
