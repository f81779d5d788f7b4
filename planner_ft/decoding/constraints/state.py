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
from collections.abc import Sequence
from dataclasses import dataclass, replace

from planner_ft.decoding.constraints import grammar as lark
from planner_ft.decoding.constraints.grammar import TASK_OPENS, Context, Grammar, Options, Script
from planner_ft.decoding.constraints.patterns import literal
from planner_ft.vocabulary import Parameter, Task
from planner_ft.vocabulary.replay import START, Progress, target_parameter


@dataclass(frozen=True)
class MissionScript(Script):
    """A mission plan: the titles that may follow, then what follows the `chosen` title."""

    opens: str = TASK_OPENS
    most: int = lark.MOST_TASKS
    progress: Progress = START

    def opening(self) -> str:
        grammar = Grammar()
        closes = lark.mission_closes(grammar, self.values)
        return grammar.text(f"{literal(lark.mission_opens())} ({literal(TASK_OPENS)} | {closes})")

    @property
    def known(self) -> Sequence[Task]:
        return self.vocabulary.tasks

    def offers(self, owner: Task) -> bool:
        fits = not self.logical or self.progress.offers(owner)
        return fits and lark.possible(owner, self)

    def read(self, text: str) -> MissionScript:
        progress = self.progress
        if self.written:
            entry, _end = json.JSONDecoder().raw_decode(text)
            task = self.vocabulary.task[entry["title"]]
            progress = progress.after(task, entry["parameters"], self.vocabulary)
        return replace(self, progress=progress, chosen=None, written=TASK_OPENS)

    def behind(self, owners: Sequence[Task], *, names: bool) -> str:
        grammar = Grammar()
        entries = " | ".join(self.entry(grammar, task, named=not names) for task in owners)
        more = f"{literal(',' + TASK_OPENS)} | " if self.progress.tasks + 1 < self.most else ""
        return grammar.text(f"({entries}) ({more}{lark.mission_closes(grammar, self.values)})")

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
