"""Replaying a mission plan: where the vehicle stands behind its tasks, and where it must stop.

Preconditions and effects are checked as planning systems validate plans (VAL: Howey, Long and Fox
2004); they stand in the definition and its logic file.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any, Literal

from planner_ft.vocabulary.checks import Entry
from planner_ft.vocabulary.definition import Parameter, Task, TaskLogic, Vocabulary
from planner_ft.vocabulary.plans import value_problem

Position = tuple[float, float]
Places = Literal["position known", "target located", "vehicle at the place"]
Condition = Literal["plan given", "task known", Places, "data collected"]


@dataclass(frozen=True)
class Progress:
    """Where a plan stands: `here` is the vehicle's place (None: unknown), `found`: a target.

    `moved`: tasks may have left `here`. `searched` targets, `done` titles and `visited` places.
    """

    tasks: int = 0
    searched: tuple[str, ...] = ()
    here: Position | None = None
    found: bool = False
    moved: bool = False
    done: tuple[str, ...] = ()
    visited: tuple[Position, ...] = ()

    def after(self, task: Task, parameters: dict[str, Any], vocabulary: Vocabulary) -> Progress:
        """Progress behind one more task; a position is a pair of numbers."""
        done, moved = (*self.done, task.title), self.moved or task.leaves
        ahead = replace(self, tasks=self.tasks + 1, moved=moved, done=done)
        if task.title == vocabulary.locate:
            searched = (*self.searched, target(task, parameters))
            return replace(ahead, searched=searched, here=None, found=True)
        place = parameters.get(task.position_parameter or "")
        if place is None:
            return ahead
        at = (place[0], place[1])
        here, visited = None if task.leaves else at, (*self.visited, at)
        return replace(ahead, here=here, found=False, moved=False, visited=visited)

    def offers(self, task: Task) -> bool:
        """Whether a task can follow: not at a place that was located and not gone to."""
        return task.arrival != "transit" or not self.found


START = Progress()  # where a plan stands before its first task


def target_parameter(task: Task) -> Parameter | None:
    """The parameter of a search that says what is searched."""
    return next((item for item in task.parameters if item.type == "text"), None)


def target(task: Task, parameters: dict[str, Any]) -> str:
    """What a search is for; empty where it does not say."""
    parameter = target_parameter(task)
    return str(parameters.get(parameter.name, "")) if parameter else ""


@dataclass(frozen=True)
class Stop:
    """Where a plan stops: index and title of the task, the unmet condition, and why in words."""

    index: int
    title: str
    condition: Condition
    reason: str


@dataclass(frozen=True)
class Holds:
    """What holds before a task; `items` on board may be sent before the plan collects them."""

    progress: Progress = START
    facts: frozenset[str] = frozenset()
    items: frozenset[str] = frozenset()
    done: tuple[TaskLogic, ...] = ()


def replay(plan: Entry, vocabulary: Vocabulary, holds: Holds | None = None) -> Stop | None:
    """The first task that cannot be carried out from `holds` (by default nothing), or None."""
    return next((stop for stop, _missing in stops(plan, vocabulary, holds)), None)


def on_board(plan: Entry, vocabulary: Vocabulary) -> Holds:
    """The facts and items that a plan needs before it brings them about."""
    missing = frozenset().union(*(facts for _stop, facts in stops(plan, vocabulary)))
    known = vocabulary.logic.lacking.keys()
    return Holds(facts=missing & known, items=missing - known)


def stops(
    plan: Entry, vocabulary: Vocabulary, holds: Holds | None = None
) -> Iterator[tuple[Stop, frozenset[str]]]:
    """Every unmet condition with missing facts and items; the plan goes on as if it were met."""
    holds = holds or Holds()
    entries = [entry if isinstance(entry, dict) else {} for entry in plan["tasks"]]
    logics = [vocabulary.logic.of(str(entry.get("title"))) for entry in entries]
    for index, entry in enumerate(entries):
        title, logic = str(entry.get("title")), logics[index]
        task = vocabulary.task.get(title)
        if task is None:
            reason = f"{title!r} is no task of this vehicle"
            yield Stop(index, title, "task known", reason), frozenset()
            continue
        parameters = sound(entry.get("parameters"), task)
        unmet = _unmet_place(task, parameters, holds.progress, vocabulary)
        if unmet:
            yield Stop(index, title, *unmet), frozenset()
        missing = _missing(logic, parameters, holds, logics[index + 1 :])
        if missing:
            first = min(missing)
            later = f"{first!r} is collected later in the plan"
            reason = vocabulary.logic.lacking.get(first) or later
            yield Stop(index, title, "data collected", reason), missing
        progress = holds.progress.after(task, parameters, vocabulary)
        holds = Holds(progress, holds.facts | {*logic.gives}, holds.items, (*holds.done, logic))


def _unmet_place(
    task: Task, parameters: Entry, progress: Progress, vocabulary: Vocabulary
) -> tuple[Condition, str] | None:
    """The condition on places that keeps a task from running where the plan stands."""
    place = parameters.get(task.position_parameter or "")
    absent = _absent_place(task, parameters)
    if absent:
        return "position known", f"{absent} is missing or no position"
    unresolved = place == list(vocabulary.unresolved)
    locate, transit = vocabulary.locate, vocabulary.transit
    if unresolved and not progress.searched and not task.docks:
        return "target located", f"its place is unresolved and no {locate} comes before it"
    stays = progress.here == vocabulary.unresolved and not progress.moved
    if unresolved and task.title == transit and stays and len(progress.searched) == 1:
        only = f"the only target that was located ({progress.searched[0]})"
        return "target located", f"{only} is where the vehicle is"
    if task.arrival != "transit":
        return None
    if not progress.offers(task):
        reason = f"{locate} locates but does not arrive; no {transit} comes before this task"
        return "vehicle at the place", reason
    if place is not None and (progress.here is None or list(progress.here) != place):
        reason = f"performed at {place}, but no {transit} there comes before it"
        return "vehicle at the place", reason
    return None


def _absent_place(task: Task, parameters: Entry) -> str | None:
    """The parameter, or the choice of them, that must say where or what and does not."""
    places = {item.name: item for item in task.parameters if item.type in ("position", "id")}
    choice = [name for name in task.require_any if name in places]
    if choice and not parameters.keys() & set(task.require_any):
        return " or ".join(choice)
    needed = (name for name, item in places.items() if item.required)
    return next((name for name in needed if name not in parameters), None)


def _missing(
    logic: TaskLogic, parameters: Entry, holds: Holds, later: list[TaskLogic]
) -> frozenset[str]:
    """The facts that a task needs and the items that it sends, as far as they are missing."""
    items = [item.casefold() for item in parameters.get(logic.sends or "", ())]
    absent = [item for item in items if item not in holds.items]
    waiting = [item for item in absent if not any(collects(one, item) for one in holds.done)]
    early = frozenset(item for item in waiting if any(collects(one, item) for one in later))
    if early or (items and not waiting):
        return early
    return frozenset(logic.needs) - holds.facts


def collects(logic: TaskLogic, item: str) -> bool:
    """Whether a name shares a word, singular or plural, with what a task yields."""
    return any(
        word.removesuffix(ending) in logic.yields
        for word in re.findall(r"[^\W_]+(?:[-'’.][^\W_]+)*", item.lower())
        for ending in ("", "s", "es")
    )


def sound(parameters: Any, task: Task) -> dict[str, Any]:
    """The parameters that are valid by themselves; a place that is no position is none."""
    given = parameters.items() if isinstance(parameters, dict) else ()
    known = {name: value for name, value in given if name in task.by_name}
    return {
        key: value for key, value in known.items() if not value_problem(value, task.by_name[key])
    }
