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

from planner_ft.decoding.constraints import grammar as lark
from planner_ft.decoding.constraints.grammar import TASK_OPENS, Context, Grammar, Options, Script
from planner_ft.decoding.constraints.patterns import literal, quoted
from planner_ft.vocabulary import Parameter, Task
from planner_ft.vocabulary.replay import START, Progress, target_parameter


@dataclass(frozen=True)
class MissionScript(Script):
    """A mission plan: the titles that may follow, then what follows the `chosen` title."""

    most: int = lark.MOST_TASKS
    progress: Progress = START

    def opening(self) -> str:
        grammar = Grammar()
        closes = lark.mission_closes(grammar, self.values)
        return grammar.text(f"{literal(lark.mission_opens())} ({literal(TASK_OPENS)} | {closes})")

    def following(self, text: str) -> tuple[str, Script] | None:
        if self.chosen is None and text in self.vocabulary.task:
            chosen = replace(self, chosen=self.vocabulary.task[text])
            return chosen._tasks([chosen.chosen], titles=False), chosen
        if not text.endswith(TASK_OPENS):
            return None
        if text == lark.mission_opens() + TASK_OPENS:
            return self._titles(), self
        title = self.chosen.title if self.chosen else ""
        entry, _end = json.JSONDecoder().raw_decode(TASK_OPENS + quoted(title) + text)
        task = self.vocabulary.task[entry["title"]]
        progress = self.progress.after(task, entry["parameters"], self.vocabulary)
        ahead = replace(self, progress=progress, chosen=None)
        return ahead._titles(), ahead

    def _titles(self) -> str:
        """The titles that may follow; with their tasks where one can be another's beginning."""
        known = self.vocabulary.tasks
        # A vocabulary can be such that nothing fits; the schema alone holds then.
        offered = [
            task
            for task in known
            if (not self.logical or self.progress.offers(task)) and lark.possible(task, self)
        ] or list(known)
        if lark.prefix_free(task.title for task in known):
            return Grammar().text(" | ".join(literal(task.title) for task in offered))
        return self._tasks(offered, titles=True)

    def _tasks(self, tasks: list[Task], *, titles: bool) -> str:
        grammar, options = Grammar(), []
        for task in tasks:
            title = literal(quoted(task.title)) if titles else ""
            behind = lark.body(grammar, task, self)
            behind = behind or lark.body(grammar, task, self.schema_alone)
            options += [f"{title} {behind}"] if behind else []
        more = f"{literal(',' + TASK_OPENS)} | " if self.progress.tasks + 1 < self.most else ""
        closes = lark.mission_closes(grammar, self.values)
        return grammar.text(f"({' | '.join(options)}) ({more}{closes})")

    # ------------------------------------------------------------ what the tasks so far leave

    def parameter(
        self, grammar: Grammar, parameter: Parameter, owner: Task, context: Context
    ) -> Options:
        if self.logical and parameter.name == owner.position_parameter:
            symbol = self._place(grammar, owner, identified=context >= lark.IDENTIFIED)
        elif self._is_target(parameter, owner):
            searched = [target for target in self.progress.searched if target]
            symbol = self.values.text(grammar, searched)
        else:
            return super().parameter(grammar, parameter, owner, context)
        return [(symbol, context)] if symbol else []

    def needs(self, parameter: Parameter, owner: Task) -> bool:
        # Two searches that name no target are the same search.
        again = self._is_target(parameter, owner) and "" in self.progress.searched
        return super().needs(parameter, owner) or again

    def _is_target(self, parameter: Parameter, owner: Task) -> bool:
        search = self.logical and owner.title == self.vocabulary.locate
        return search and parameter == target_parameter(owner)

    def _place(self, grammar: Grammar, task: Task, *, identified: bool) -> str | None:
        progress, unresolved, at = self.progress, self.vocabulary.unresolved, self.progress.here
        unknown = not identified and (bool(progress.searched) or task.docks)
        if task.arrival == "transit":
            lost = at is None or (at == unresolved and not unknown)
            return None if at is None or lost else literal(lark.written(at))
        without = [] if unknown else [unresolved]
        # Two places that are not known yet look the same: behind a second search, unresolved can be
        # another place.
        same = at == unresolved and len(progress.searched) > 1
        if task.title == self.vocabulary.transit and at and not (same or progress.moved):
            without.append(at)
        return self.values.position(grammar, without)
