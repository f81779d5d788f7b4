"""Which constraint belongs to a strength."""

from __future__ import annotations

import functools
from dataclasses import dataclass, replace
from typing import Any

from planner_ft.decoding.configurations import Strength
from planner_ft.decoding.constraints.answer import Answer
from planner_ft.decoding.constraints.grammar import SKILL_OPENS, Values, key, mission_opens, name_of
from planner_ft.decoding.constraints.grounded import LONGEST_WORD, GroundedValues
from planner_ft.decoding.constraints.patterns import DECIMALS, WHOLE_DIGITS
from planner_ft.decoding.constraints.scripts import MissionScript, TaskScript
from planner_ft.decoding.constraints.tokens import Tokens, tokens_of
from planner_ft.decoding.constraints.waypoints import Waypoints, read_waypoints
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import compact_json
from planner_ft.vocabulary import Skill, Task, Vocabulary
from planner_ft.vocabulary.plans import MISSION_KEYS, STEP_KEYS, Level

_NUMBER = 2 + WHOLE_DIGITS + DECIMALS
_POSITION = 2 * _NUMBER + 3
_BYTES = {
    "number": _NUMBER,
    "integer": _NUMBER,
    "position": _POSITION,
    "polygon": 3 * (_POSITION + 1) + 1,
}
"""Bytes that a value takes at most when everything that can be left out is."""


def constraint_factory(
    tokenizer: Any,
    level: Level,
    vocabulary: Vocabulary,
    strength: Strength,
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
        return least_limit(self.level, self.vocabulary)

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
        return reserve(self.level, self.vocabulary)


# ---------------------------------------------------------------- how an answer is closed

# A grammar bounds every list and text, but the sum of the bounds is far above any limit, so the last
# tokens of the limit are kept for closing what is open. No token is shorter than a byte.


def reserve(level: Level, vocabulary: Vocabulary) -> int:
    """Tokens that close a plan from wherever it stands: the longest task or skill, begun where
    another one ends, and what stands behind it.
    """
    mission = level == "mission"
    owners = vocabulary.tasks if mission else vocabulary.skills
    lists: dict[str, list[Any]] = {
        name: [] for name in (MISSION_KEYS[1:] if mission else STEP_KEYS)
    }
    rest = compact_json([lists, {"task_prompt": ""}])
    return max(map(_most_bytes, owners)) + len(rest) + LONGEST_WORD + 8


def least_limit(level: Level, vocabulary: Vocabulary) -> int:
    """The smallest limit within which every answer ends, its beginning and end token included."""
    opens = mission_opens() if level == "mission" else "{" + key("skill_sequence") + "["
    return reserve(level, vocabulary) + len(opens) + 1


def _most_bytes(owner: Task | Skill) -> int:
    """Bytes of a name and the parameters that must be written, or the one that was begun."""
    sizes = [
        len(f",{key(item.name)}".encode()) + _BYTES.get(item.type, LONGEST_WORD)
        for item in owner.parameters
    ]
    needed = bool(owner.require_any) or any(item.required for item in owner.parameters)
    opens = len(compact_json({"name": name_of(owner), "parameters": {}}).encode())
    return opens + (sum(sizes) if needed else max(sizes, default=0))
