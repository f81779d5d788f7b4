"""The logic of a mission plan: which tasks and which places may follow the tasks before them.

The rules read the vocabulary's fields (locate, transit, unresolved, a task's arrival, leaves and
pattern) and hold for any vehicle. A place that is not known yet needs a search before it; a target
is searched once; a task that is performed at a place follows what brings the vehicle there; nothing
goes to where the vehicle is. They are those of the labelling rules that need no reading of the
command: whether a vehicle that a survey took elsewhere goes on where it is then, only the command
says.
"""

from __future__ import annotations

import itertools
import json
from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import Any

from planner_ft.data.rules import DOCKING
from planner_ft.decoding.constraints import patterns
from planner_ft.decoding.constraints.answer import Script
from planner_ft.decoding.constraints.grammar import (
    IDENTIFIED,
    MOST_TASKS,
    TASK_OPENS,
    Context,
    Grammar,
    Narrowed,
    SchemaValues,
    Values,
    corners,
    mission_closes,
    mission_opens,
    task_body,
    title,
    titled_task,
    written,
    written_number,
)
from planner_ft.decoding.constraints.patterns import literal
from planner_ft.vocabulary import Parameter, Skill, Task, Vocabulary
from planner_ft.vocabulary.replay import START, Progress, target_parameter

Position = tuple[float, float]


class LogicalValues(Narrowed):
    """The values of another strength, less those that break the logic of the plan."""

    def __init__(self, values: Values, vocabulary: Vocabulary, progress: Progress) -> None:
        super().__init__(values)
        self._vocabulary, self._progress = vocabulary, progress

    def parameter(
        self, grammar: Grammar, parameter: Parameter, owner: Task | Skill, context: Context
    ) -> list[tuple[str, Context]]:
        symbol: str | None = None
        if isinstance(owner, Task) and parameter.name == owner.position_parameter:
            symbol = self._place(grammar, owner, identified=context >= IDENTIFIED)
        elif self._is_target(parameter, owner):
            symbol = self.text(grammar, [target for target in self._progress.searched if target])
        else:
            return super().parameter(grammar, parameter, owner, context)
        return [(symbol, context)] if symbol else []

    def needs(self, parameter: Parameter, owner: Task | Skill) -> bool:
        # Two searches that name no target are the same search.
        return super().needs(parameter, owner) or (
            self._is_target(parameter, owner) and "" in self._progress.searched
        )

    def _is_target(self, parameter: Parameter, owner: Task | Skill) -> bool:
        return (
            isinstance(owner, Task)
            and owner.title == self._vocabulary.locate
            and parameter == target_parameter(owner)
        )

    def _place(self, grammar: Grammar, task: Task, *, identified: bool) -> str | None:
        progress, unresolved = self._progress, self._vocabulary.unresolved
        unknown = not identified and (bool(progress.searched) or task.pattern == DOCKING)
        if task.arrival == "transit":
            at = progress.here
            return (
                None if at is None or (at == unresolved and not unknown) else literal(written(at))
            )
        without = [] if unknown else [unresolved]
        # Two places that are not known yet look the same: behind a second search, unresolved can be
        # another place.
        same = progress.here == unresolved and len(progress.searched) > 1
        if (
            task.title == self._vocabulary.transit
            and progress.here is not None
            and not (same or progress.moved)
        ):
            without.append(progress.here)
        return self.position(grammar, tuple(without))


class ResolvedValues(Narrowed):
    """The values of another strength for the skill sequence of a task that has no unresolved place:
    there is none in it.
    """

    def __init__(self, values: Values, vocabulary: Vocabulary) -> None:
        super().__init__(values)
        self._unresolved = vocabulary.unresolved

    def parameter(
        self, grammar: Grammar, parameter: Parameter, owner: Task | Skill, context: Context
    ) -> list[tuple[str, Context]]:
        if isinstance(owner, Skill) and parameter in owner.coordinates:
            return self._coordinate(grammar, parameter, owner.coordinates.index(parameter), context)
        if parameter.type == "polygon":
            position = self.position(grammar, (self._unresolved,))
            return [(corners(grammar, position), context)] if position else []
        return super().parameter(grammar, parameter, owner, context)

    def _coordinate(
        self, grammar: Grammar, parameter: Parameter, axis: int, context: Context
    ) -> list[tuple[str, Context]]:
        """A coordinate of a destination: the second is not that of the unresolved place when the
        first one is.
        """
        value, suspect = self._unresolved[axis], frozenset({"unresolved"})
        other = self.number(grammar, parameter, (value,))
        options = [(other, context)] if other else []
        if axis == 0 and self.has_number(parameter, value):
            options.append((literal(written_number(value)), context | suspect))
        elif axis == 1 and not context >= suspect:
            options = [
                (symbol, context) for symbol in [self.number(grammar, parameter, ())] if symbol
            ]
        return options


def names_unresolved(record: dict[str, Any], vocabulary: Vocabulary) -> bool:
    """Whether a task itself still has the unresolved place among its parameters."""
    parameters = record.get("parameters")
    return isinstance(parameters, dict) and list(vocabulary.unresolved) in parameters.values()


@dataclass(frozen=True)
class MissionScript:
    """Grammars of a mission plan, made as it grows: the titles that may follow, then what stands
    behind the chosen title.

    They meet on both sides of a title, where letters follow signs and signs letters: tokenizers
    keep the two apart. `chosen` is the task whose title was written last.
    """

    vocabulary: Vocabulary
    values: Values
    progress: Progress = START
    chosen: Task | None = None

    def opening(self) -> str:
        grammar = Grammar()
        return grammar.text(
            f"{literal(mission_opens())} ({literal(TASK_OPENS)} |"
            f" {mission_closes(grammar, self.values)})"
        )

    def following(self, text: str) -> tuple[str, Script] | None:
        if self.chosen is None and text in self.vocabulary.task:
            chosen = replace(self, chosen=self.vocabulary.task[text])
            return chosen._tasks([self.vocabulary.task[text]], titles=False), chosen
        if not text.endswith(TASK_OPENS):
            return None
        if text == mission_opens() + TASK_OPENS:
            return self._titles(), self
        written_title = self.chosen.title if self.chosen else ""
        entry, _end = json.JSONDecoder().raw_decode(
            TASK_OPENS + patterns.quoted(written_title) + text
        )
        progress = self.progress.after(
            self.vocabulary.task[entry["title"]], entry["parameters"], self.vocabulary
        )
        ahead = replace(self, progress=progress, chosen=None)
        return ahead._titles(), ahead

    def _titles(self) -> str:
        """The titles that may follow; with their tasks where a title can be the beginning of
        another.
        """
        offered = [
            task
            for task in self.vocabulary.tasks
            if self.progress.offers(task) and self._possible(task)
        ]
        # A vocabulary can be such that nothing fits; the schema alone holds then.
        offered = offered or list(self.vocabulary.tasks)
        if prefix_free(task.title for task in self.vocabulary.tasks):
            return Grammar().text(" | ".join(title(task) for task in offered))
        return self._tasks(offered, titles=True)

    def _possible(self, task: Task) -> bool:
        needy = task.require_any or any(self._logical.needs(item, task) for item in task.parameters)
        return not needy or task_body(Grammar(), task, self._logical) is not None

    def _tasks(self, tasks: list[Task], *, titles: bool) -> str:
        grammar = Grammar()
        make = titled_task if titles else task_body
        bodies = [
            make(grammar, task, self._logical) or make(grammar, task, SchemaValues())
            for task in tasks
        ]
        more = f"{literal(',' + TASK_OPENS)} | " if self.progress.tasks + 1 < MOST_TASKS else ""
        return grammar.text(
            f"({' | '.join(body for body in bodies if body)})"
            f" ({more}{mission_closes(grammar, self.values)})"
        )

    @property
    def _logical(self) -> LogicalValues:
        return LogicalValues(self.values, self.vocabulary, self.progress)


def prefix_free(names: Iterable[str]) -> bool:
    """Whether no name begins another and none needs an escape."""
    known = sorted(names)
    return not any(
        longer.startswith(shorter) for shorter, longer in itertools.pairwise(known)
    ) and all(patterns.quoted(name) == name for name in known)
