"""The logic of a mission plan: which tasks and which places may follow the tasks before them.

The rules read the vocabulary's fields (locate, transit, unresolved, a task's arrival, leaves and
pattern) and hold for any vehicle. A place that is not known yet needs a search before it; a target
is searched once; a task that is performed at a place follows what brings the vehicle there; nothing
goes to where the vehicle is. They are those of the labelling rules that need no reading of the
command: whether a vehicle that a survey took elsewhere goes on where it is then, only the command
says.
"""

from __future__ import annotations

import json
from dataclasses import dataclass, replace

from planner_ft.decoding.constraints.grammar import (
    IDENTIFIED,
    MOST_TASKS,
    TASK_OPENS,
    Context,
    Grammar,
    Logic,
    Options,
    Script,
    Values,
    body,
    mission_closes,
    mission_opens,
    possible,
    prefix_free,
    written,
)
from planner_ft.decoding.constraints.patterns import literal, quoted
from planner_ft.vocabulary import Parameter, Skill, Task, Vocabulary
from planner_ft.vocabulary.replay import START, Progress, target_parameter


class MissionLogic(Logic):
    """What the tasks so far leave for the next one."""

    def __init__(self, values: Values, vocabulary: Vocabulary, progress: Progress) -> None:
        super().__init__(values)
        self._vocabulary, self._progress = vocabulary, progress

    def parameter(
        self, grammar: Grammar, parameter: Parameter, owner: Task | Skill, context: Context
    ) -> Options:
        symbol: str | None = None
        if isinstance(owner, Task) and parameter.name == owner.position_parameter:
            symbol = self._place(grammar, owner, identified=context >= IDENTIFIED)
        elif self._is_target(parameter, owner):
            searched = [target for target in self._progress.searched if target]
            symbol = self.values.text(grammar, searched)
        else:
            return super().parameter(grammar, parameter, owner, context)
        return [(symbol, context)] if symbol else []

    def needs(self, parameter: Parameter, owner: Task | Skill) -> bool:
        # Two searches that name no target are the same search.
        again = self._is_target(parameter, owner) and "" in self._progress.searched
        return super().needs(parameter, owner) or again

    def _is_target(self, parameter: Parameter, owner: Task | Skill) -> bool:
        search = isinstance(owner, Task) and owner.title == self._vocabulary.locate
        return isinstance(owner, Task) and search and parameter == target_parameter(owner)

    def _place(self, grammar: Grammar, task: Task, *, identified: bool) -> str | None:
        progress, unresolved, at = self._progress, self._vocabulary.unresolved, self._progress.here
        unknown = not identified and (bool(progress.searched) or task.docks)
        if task.arrival == "transit":
            lost = at is None or (at == unresolved and not unknown)
            return None if at is None or lost else literal(written(at))
        without = [] if unknown else [unresolved]
        # Two places that are not known yet look the same: behind a second search, unresolved can be
        # another place.
        same = at == unresolved and len(progress.searched) > 1
        if task.title == self._vocabulary.transit and at and not (same or progress.moved):
            without.append(at)
        return self.values.position(grammar, without)


@dataclass(frozen=True)
class MissionScript:
    """Grammars of a mission plan, made as it grows: the titles that may follow, then what stands
    behind the `chosen` title. Without `logical`, any task may follow any other.
    """

    vocabulary: Vocabulary
    values: Values
    logical: bool = True
    most: int = MOST_TASKS
    progress: Progress = START
    chosen: Task | None = None

    def opening(self) -> str:
        grammar = Grammar()
        closes = mission_closes(grammar, self.values)
        return grammar.text(f"{literal(mission_opens())} ({literal(TASK_OPENS)} | {closes})")

    def following(self, text: str) -> tuple[str, Script] | None:
        if self.chosen is None and text in self.vocabulary.task:
            chosen = replace(self, chosen=self.vocabulary.task[text])
            return chosen._tasks([self.vocabulary.task[text]], titles=False), chosen
        if not text.endswith(TASK_OPENS):
            return None
        if text == mission_opens() + TASK_OPENS:
            return self._titles(), self
        title = self.chosen.title if self.chosen else ""
        entry, _end = json.JSONDecoder().raw_decode(TASK_OPENS + quoted(title) + text)
        task = self.vocabulary.task[entry["title"]]
        progress = self.progress.after(task, entry["parameters"], self.vocabulary)
        ahead = replace(self, progress=progress, chosen=None)
        return ahead._titles(), ahead

    def _titles(self) -> str:
        """The titles that may follow; with their tasks where a title can be the beginning of
        another.
        """
        known, logic = self.vocabulary.tasks, self._logic
        offered = [
            task
            for task in known
            if (not self.logical or self.progress.offers(task)) and possible(task, logic)
        ]
        # A vocabulary can be such that nothing fits; the schema alone holds then.
        offered = offered or list(known)
        if prefix_free(task.title for task in known):
            return Grammar().text(" | ".join(literal(task.title) for task in offered))
        return self._tasks(offered, titles=True)

    def _tasks(self, tasks: list[Task], *, titles: bool) -> str:
        grammar, options = Grammar(), []
        for task in tasks:
            title = literal(quoted(task.title)) if titles else ""
            behind = body(grammar, task, self._logic) or body(grammar, task, Logic(Values()))
            options += [f"{title} {behind}"] if behind else []
        more = f"{literal(',' + TASK_OPENS)} | " if self.progress.tasks + 1 < self.most else ""
        closes = mission_closes(grammar, self.values)
        return grammar.text(f"({' | '.join(options)}) ({more}{closes})")

    @property
    def _logic(self) -> Logic:
        if not self.logical:
            return Logic(self.values)
        return MissionLogic(self.values, self.vocabulary, self.progress)
