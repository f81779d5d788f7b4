"""Which constraint belongs to a strength."""

from __future__ import annotations

import functools
from dataclasses import dataclass, replace
from typing import Any

from planner_ft.decoding.configurations import Strength
from planner_ft.decoding.constraints.answer import Answer
from planner_ft.decoding.constraints.budget import least_limit, reserve
from planner_ft.decoding.constraints.grammar import SKILL_OPENS, Values
from planner_ft.decoding.constraints.grounded import GroundedValues
from planner_ft.decoding.constraints.state import MissionScript
from planner_ft.decoding.constraints.steps import TaskScript
from planner_ft.decoding.constraints.tokens import Tokens, tokens_of
from planner_ft.decoding.constraints.waypoints import Waypoints, read_waypoints
from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import Level


def constraint_factory(
    tokenizer: Any,
    level: Level,
    vocabulary: Vocabulary,
    strength: Strength,
    *,
    end_ids: tuple[int, ...],
    limit: int,
    n_vocab: int | None = None,
) -> Factory | None:
    """What answers are constrained with; None at strength free.

    `end_ids` are the tokens that may end an answer, `limit` the tokens that it may have, `n_vocab`
    the width of the model's logits (None takes the tokenizer's size). Raises PlannerError for a
    limit within which an answer cannot be guaranteed to end.
    """
    if strength == "free":
        return None
    tokens = tokens_of(tokenizer, tuple(end_ids), n_vocab)
    factory = Factory(tokens, level, vocabulary, strength, limit)
    factory.check(limit)
    return factory


@dataclass(frozen=True, eq=False)
class Factory:
    """Starts constraints of one strength, over one tokenizer, for one level and vocabulary."""

    tokens: Tokens
    level: Level
    vocabulary: Vocabulary
    strength: Strength
    limit: int

    @functools.cached_property
    def least_tokens(self) -> int:
        """The smallest limit within which every answer ends."""
        return least_limit(self.level, self.vocabulary, self.tokens)

    def start(
        self, record: dict[str, Any], limit: int | None = None, most: int | None = None
    ) -> Answer:
        """The state before the first token of the answer to `record` ({"prompt", ...}), which
        always ends within `limit` tokens, its end token included.

        None takes the factory's limit. With `most`, the answer has at most that many tasks or steps
        and is held to the schema alone. Raises PlannerError when `limit` is under `least_tokens`.
        """
        limit = self.limit if limit is None else limit
        self.check(limit)
        given, unresolved = record.get("parameters"), list(self.vocabulary.unresolved)
        open_place = isinstance(given, dict) and unresolved in given.values()
        logical = self.strength != "schema" and not (self.level == "task" and open_place)
        kind = MissionScript if self.level == "mission" else TaskScript
        script = kind(self.vocabulary, Values(), logical=logical and most is None)
        script = script if most is None else replace(script, most=most)
        if self.strength != "grounded" or not script.logical:
            return Answer(self.tokens, script, limit, self._reserve)
        return self._grounded(record, limit, script)

    def check(self, limit: int) -> None:
        """Raise PlannerError for a limit within which an answer cannot be guaranteed to end."""
        if limit < self.least_tokens:
            raise PlannerError(
                f"--max-new-tokens {limit}: at strength {self.strength} a {self.level} plan of this"
                f" vocabulary needs room for {self.least_tokens} tokens; give at least that, or a"
                " shorter prompt"
            )

    def _grounded(
        self, record: dict[str, Any], limit: int, script: MissionScript | TaskScript
    ) -> Answer:
        found = read_waypoints(record, self.vocabulary) if self.level == "task" else None
        free = found if isinstance(found, str) else ""
        values = GroundedValues(self.level, record, self.vocabulary, free_waypoints=bool(free))
        goes = [SKILL_OPENS + skill.name for skill in self.vocabulary.skills if skill.coordinates]

        def notes(text: str) -> list[str]:
            moves = any(name in text for name in goes)
            return [*values.notes, *([free] if free and moves else [])]

        if not isinstance(script, TaskScript):
            # A mission's places are stated or unresolved, its other values can be left out.
            grounded = replace(script, values=values)
            return Answer(self.tokens, grounded, limit, self._reserve, notes)
        known = found if isinstance(found, Waypoints) else None
        steps = replace(script, values=values, waypoints=known, whole=known)
        # The lanes of a grid follow from the task's own parameters: the model is not left to write
        # others.
        own = known if known and known.whole else None
        loose = replace(script, waypoints=own, whole=known)
        return Answer(self.tokens, steps, limit, self._reserve, notes, loose)

    @functools.cached_property
    def _reserve(self) -> int:
        return reserve(self.level, self.vocabulary, self.tokens)
