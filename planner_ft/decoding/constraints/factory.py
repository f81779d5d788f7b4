"""Which constraint belongs to a strength."""

from __future__ import annotations

import functools
from dataclasses import dataclass
from typing import Any

from planner_ft.decoding.configurations import Strength
from planner_ft.decoding.constraints import Constraint
from planner_ft.decoding.constraints.answer import Answer, Script, Whole
from planner_ft.decoding.constraints.budget import Budget
from planner_ft.decoding.constraints.grammar import SKILL_OPENS, SchemaValues, plan_grammar
from planner_ft.decoding.constraints.grounded import GroundedValues
from planner_ft.decoding.constraints.state import MissionScript, ResolvedValues, names_unresolved
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
        return self._budget.least_limit()

    def start(
        self, record: dict[str, Any], limit: int | None = None, most: int | None = None
    ) -> Constraint:
        limit = self.limit if limit is None else limit
        self.check(limit)
        if most is not None:
            grammar = plan_grammar(self.level, self.vocabulary, SchemaValues(), most)
            return Answer(self.tokens, Whole(grammar), limit, self._reserve)
        if self.strength == "schema" or (
            self.level == "task" and names_unresolved(record, self.vocabulary)
        ):
            return Answer(self.tokens, self._schema, limit, self._reserve)
        if self.strength == "state":
            return Answer(self.tokens, self._logic, limit, self._reserve)
        return self._grounded(record, limit)

    def _grounded(self, record: dict[str, Any], limit: int) -> Constraint:
        found = read_waypoints(record, self.vocabulary) if self.level == "task" else None
        free = found if isinstance(found, str) else ""
        values = GroundedValues(self.level, record, self.vocabulary, free_waypoints=bool(free))
        if self.level == "mission":
            script: Script = MissionScript(self.vocabulary, values)
        elif isinstance(found, Waypoints):
            script = TaskScript(self.vocabulary, values, found)
        else:
            script = TaskScript(self.vocabulary, ResolvedValues(values, self.vocabulary))
        goes = [SKILL_OPENS + skill.name for skill in self.vocabulary.skills if skill.coordinates]

        def notes(text: str) -> list[str]:
            moves = any(name in text for name in goes)
            return [*values.notes, *([free] if free and moves else [])]

        # A mission's places are stated or unresolved, its other values can be left out.
        loose = self._logic if self.level == "task" else None
        return Answer(self.tokens, script, limit, self._reserve, notes, loose)

    def check(self, limit: int) -> None:
        """Raise PlannerError for a limit within which an answer cannot be guaranteed to end."""
        if limit < self.least_tokens:
            raise PlannerError(
                f"--max-new-tokens {limit}: at strength {self.strength} a {self.level} plan of this"
                f" vocabulary needs room for {self.least_tokens} tokens; give at least that, or a"
                " shorter prompt"
            )

    @functools.cached_property
    def _reserve(self) -> int:
        return self._budget.reserve()

    @functools.cached_property
    def _budget(self) -> Budget:
        return Budget(self.level, self.vocabulary, self.tokens)

    @functools.cached_property
    def _schema(self) -> Script:
        return Whole(plan_grammar(self.level, self.vocabulary, SchemaValues()))

    @functools.cached_property
    def _logic(self) -> Script:
        if self.level == "mission":
            return MissionScript(self.vocabulary, SchemaValues())
        return TaskScript(self.vocabulary, ResolvedValues(SchemaValues(), self.vocabulary))
