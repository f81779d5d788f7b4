"""Where a mission plan stands behind some of its tasks, read from the vocabulary's fields (locate,
transit, arrival, leaves).

Decoding asks it what may follow, the labelling rules what was forgotten, and the benchmark whether
a plan can be carried out.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

from planner_ft.vocabulary.definition import Parameter, Task, Vocabulary

Position = tuple[float, float]


@dataclass(frozen=True)
class Progress:
    """Where a plan stands behind some of its tasks.

    `here` is the place the vehicle was brought to, None when that is unknown; `found`: a target was
    located and not gone to yet; `moved`: tasks since then may have taken the vehicle off `here`.
    `searched` are the targets of all searches, `done` the titles of all tasks, `visited` the places
    that they were sent to.
    """

    tasks: int = 0
    searched: tuple[str, ...] = ()
    here: Position | None = None
    found: bool = False
    moved: bool = False
    done: tuple[str, ...] = ()
    visited: tuple[Position, ...] = ()

    def after(self, task: Task, parameters: dict[str, Any], vocabulary: Vocabulary) -> Progress:
        """Where the plan stands behind one more task; a position among its parameters is a pair of
        numbers.
        """
        ahead = replace(
            self,
            tasks=self.tasks + 1,
            moved=self.moved or task.leaves,
            done=(*self.done, task.title),
        )
        if task.title == vocabulary.locate:
            return replace(
                ahead, searched=(*self.searched, target(task, parameters)), here=None, found=True
            )
        place = parameters.get(task.position_parameter or "")
        if place is None:
            return ahead
        at = (place[0], place[1])
        return replace(
            ahead,
            here=None if task.leaves else at,
            found=False,
            moved=False,
            visited=(*self.visited, at),
        )

    def offers(self, task: Task) -> bool:
        """Whether a task can follow: not at a place that was located and not gone to."""
        return task.arrival != "transit" or not self.found


START = Progress()
"""Where a plan stands before its first task."""


def target_parameter(task: Task) -> Parameter | None:
    """The parameter of a search that says what is searched."""
    return next((item for item in task.parameters if item.type == "text"), None)


def target(task: Task, parameters: dict[str, Any]) -> str:
    """What a search is for; empty where it does not say."""
    parameter = target_parameter(task)
    return str(parameters.get(parameter.name, "")) if parameter else ""
