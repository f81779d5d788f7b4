"""Which constraint belongs to a strength."""

from __future__ import annotations

import functools
from dataclasses import dataclass, replace
from typing import Any

from planner_ft.data.lexicon import known_words
from planner_ft.data.task.geometry import point
from planner_ft.decoding.configurations import Strength
from planner_ft.decoding.constraints import Constraint
from planner_ft.decoding.constraints.answer import Answer, Script, Whole
from planner_ft.decoding.constraints.budget import Budget
from planner_ft.decoding.constraints.companions import read_companions, to_insist_on
from planner_ft.decoding.constraints.grammar import SchemaValues, plan_grammar
from planner_ft.decoding.constraints.ground import Ground
from planner_ft.decoding.constraints.grounded_mission import MissionValues
from planner_ft.decoding.constraints.grounded_task import FreeWaypoints, GroundedTaskValues
from planner_ft.decoding.constraints.reading import LONGEST
from planner_ft.decoding.constraints.reading.corrected import as_corrected
from planner_ft.decoding.constraints.reading.paths.chains import chain_in_places
from planner_ft.decoding.constraints.reading.rows.sequence import Sequence, agreed, read_sequence
from planner_ft.decoding.constraints.reading.rows.turns import read_turns
from planner_ft.decoding.constraints.reading.telegrams import in_small_letters
from planner_ft.decoding.constraints.reading.told_otherwise import told_plainly
from planner_ft.decoding.constraints.reading.values.clocks import with_durations
from planner_ft.decoding.constraints.reading.values.own_values import in_figures
from planner_ft.decoding.constraints.routes import TaskScript
from planner_ft.decoding.constraints.state import MissionScript, ResolvedValues, names_unresolved
from planner_ft.decoding.constraints.tokens import Tokens, tokens_of
from planner_ft.decoding.constraints.waypoints import read_ground
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
    factory = Factory(
        tokens_of(tokenizer, tuple(end_ids), n_vocab), level, vocabulary, strength, limit
    )
    factory.check(limit)
    return factory


@dataclass(frozen=True, eq=False)
class Factory:
    """Starts constraints of one strength, over one tokenizer, for one level and vocabulary.

    At strength grounded and the task level, the filter and perception skills `insisted` on run in
    every step that does not rule them out.
    """

    tokens: Tokens
    level: Level
    vocabulary: Vocabulary
    strength: Strength
    limit: int
    insisted: frozenset[str] = frozenset()

    def __post_init__(self) -> None:
        """Compile what does not depend on the record."""
        self.tokens.compile(self._schema.opening())
        if self.strength == "grounded":
            known_words()

    @functools.cached_property
    def least_tokens(self) -> int:
        return self._budget.least_limit(steps=self._steps)

    def start(self, record: dict[str, Any], limit: int | None = None) -> Constraint:
        limit = self.limit if limit is None else limit
        self.check(limit)
        if self.strength == "grounded" and self.level == "task":
            return self._grounded_task(record, limit)
        if self.strength == "grounded":
            values = MissionValues(str(record.get("prompt", "")), self.vocabulary)
            return Answer(
                self.tokens,
                MissionScript(self.vocabulary, values, told=values.told),
                limit,
                self._reserve,
                values.notes,
            )
        return Answer(self.tokens, self._script(record), limit, self._reserve)

    def _grounded_task(self, record: dict[str, Any], limit: int) -> Constraint:
        if names_unresolved(record, self.vocabulary):
            return Answer(self.tokens, self._schema, limit, self._reserve)
        record = _plainly_written(record)
        prompt = record["prompt"]
        companions = replace(read_companions(record, self.vocabulary), insisted=self.insisted)
        values, ground = (
            GroundedTaskValues(record, self.vocabulary, companions.mentioned),
            read_ground(record, self.vocabulary),
        )
        companions = companions.along(prompt, ground.one_path, _pattern(record, self.vocabulary))
        turns = read_turns(record, self.vocabulary) if len(prompt) <= LONGEST else None
        # Where the readings contradict each other, neither is certain.
        turns = None if turns and ground.waypoints_alone else turns
        # Where waypoints cannot be told, any may be meant.
        held = ResolvedValues(FreeWaypoints(values), self.vocabulary) if ground.free else values
        sequence = self._sequence(record, ground) if len(prompt) <= LONGEST else None
        script = TaskScript(
            self.vocabulary,
            held,
            ground,
            prompt,
            turns,
            companions,
            None if ground.shaped else sequence,
        )
        return Answer(self.tokens, script, limit, self._reserve, values.notes)

    def _sequence(self, record: dict[str, Any], ground: Ground) -> Sequence | None:
        """All movements, also where legs that add up to known waypoints stand among them."""
        itinerary = None if ground.free else ground.itinerary
        found = read_sequence(record, self.vocabulary)
        if found is None and itinerary:
            placed = chain_in_places(record, point(*self.vocabulary.home))
            found = read_sequence({**record, "prompt": placed}, self.vocabulary) if placed else None
        return agreed(found, itinerary, self.vocabulary)

    def mending(self, record: dict[str, Any], answer: str) -> Factory | None:
        """What an answer is to be written again with, because it leaves out what its input asks for
        beyond doubt; None where it need not be.
        """
        if (
            self.strength != "grounded"
            or self.level != "task"
            or self.insisted
            or names_unresolved(record, self.vocabulary)
        ):
            return None
        insisted = to_insist_on(_plainly_written(record), answer, self.vocabulary)
        return replace(self, insisted=insisted) if insisted else None

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
        return self._budget.reserve(steps=self._steps)

    @functools.cached_property
    def _budget(self) -> Budget:
        return Budget(self.level, self.vocabulary, self.tokens)

    @property
    def _steps(self) -> int:
        # The grammar of a path that was begun asks for its next waypoint.
        return 2 if self.strength == "grounded" else 1

    def _script(self, record: dict[str, Any]) -> Script:
        if self.strength == "schema" or (
            self.level == "task" and names_unresolved(record, self.vocabulary)
        ):
            return self._schema
        return self._logic

    @functools.cached_property
    def _schema(self) -> Script:
        return Whole(plan_grammar(self.level, self.vocabulary, SchemaValues()))

    @functools.cached_property
    def _logic(self) -> Script:
        if self.level == "mission":
            return MissionScript(self.vocabulary, SchemaValues())
        return Whole(
            plan_grammar(
                self.level, self.vocabulary, ResolvedValues(SchemaValues(), self.vocabulary)
            )
        )


def _pattern(record: dict[str, Any], vocabulary: Vocabulary) -> str:
    task = vocabulary.task.get(str(record.get("task")))
    return task.pattern if task else ""


def _plainly_written(record: dict[str, Any]) -> dict[str, Any]:
    """A task input whose prompt is not in capitals, says nothing that it takes back, no times of
    day for durations and nothing by way of something else.

    Everything that reads it gets it so.
    """
    prompt = in_small_letters(str(record.get("prompt", "")))
    if len(prompt) > LONGEST:
        return {**record, "prompt": prompt}
    given = record.get("parameters")
    parameters = given if isinstance(given, dict) else {}
    return {
        **record,
        "prompt": told_plainly(
            in_figures(with_durations(as_corrected(prompt)), parameters), parameters
        ),
    }
