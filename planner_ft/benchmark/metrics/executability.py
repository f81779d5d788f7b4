"""Executability: can the vehicle carry a mission plan out, task by task?

The plan is replayed against the preconditions and effects of its tasks, as planning systems
validate plans (VAL: Howey, Long and Fox 2004). They stand in the vocabulary: where a task takes
place, what locates a target and what brings the vehicle there in the definition, facts that tasks
give and need in its logic file. The replay knows neither command nor expected plan: a plan that
runs to its end can still be another plan than the one that was asked for.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any, Literal

from planner_ft.data.rules import DOCKING
from planner_ft.data.words import words
from planner_ft.vocabulary import Task, Vocabulary
from planner_ft.vocabulary.logic import TaskLogic
from planner_ft.vocabulary.plans import value_problem
from planner_ft.vocabulary.progress import START, Progress

Condition = Literal[
    "plan given",
    "task known",
    "position known",
    "target located",
    "vehicle at the place",
    "data collected",
]
NO_PLAN: Condition = "plan given"


@dataclass(frozen=True)
class Stop:
    """Where a plan stops: number (from 0) and title of the task, the condition that does not hold,
    and why in words.
    """

    index: int
    title: str
    condition: Condition
    reason: str


@dataclass(frozen=True)
class Holds:
    """What holds before a task. `items` may be sent although the plan collects them later, if at
    all: they are on board.
    """

    progress: Progress = START
    facts: frozenset[str] = frozenset()
    items: frozenset[str] = frozenset()
    done: tuple[TaskLogic, ...] = ()


def executable(
    plan: Mapping[str, Any] | None, expected: Mapping[str, Any], vocabulary: Vocabulary
) -> Stop | None:
    """Where a mission answer stops, or None when it runs to its end.

    Data that the expected plan sends or reports without collecting it is on board from before and
    given to the answer, too. An answer that does not parse, and one without tasks where tasks are
    expected, is no plan and stops at once: refusing everything is not executable.
    """
    entries = plan.get("tasks") if plan else None
    if not isinstance(entries, list) or (not entries and expected["tasks"]):
        return Stop(
            0, "", NO_PLAN, "the answer does not parse" if plan is None else "nothing is planned"
        )
    return replay(plan or {}, vocabulary, on_board(expected, vocabulary))


def replay(
    plan: Mapping[str, Any], vocabulary: Vocabulary, holds: Holds | None = None
) -> Stop | None:
    """The first task of a mission plan that cannot be carried out, or None. `holds` is what holds
    at the start: nothing by default.
    """
    return next((stop for stop, _missing in stops(plan, vocabulary, holds or Holds())), None)


def on_board(plan: Mapping[str, Any], vocabulary: Vocabulary) -> Holds:
    """What a plan takes for granted: the facts that it needs and the items that it sends before it
    brings them about.
    """
    missing = {
        fact
        for stop, facts in stops(plan, vocabulary, Holds())
        if stop.condition == "data collected"
        for fact in facts
    }
    return Holds(
        facts=frozenset(missing & vocabulary.logic.lacking.keys()),
        items=frozenset(missing - vocabulary.logic.lacking.keys()),
    )


def stops(
    plan: Mapping[str, Any], vocabulary: Vocabulary, holds: Holds
) -> Iterator[tuple[Stop, frozenset[str]]]:
    """Every unmet condition with the facts and items that are lacking; a plan goes on behind one as
    if it were met.
    """
    entries = [entry if isinstance(entry, dict) else {} for entry in plan["tasks"]]
    logics = [vocabulary.logic.of(str(entry.get("title"))) for entry in entries]
    for index, entry in enumerate(entries):
        title = str(entry.get("title"))
        task, given = vocabulary.task.get(title), entry.get("parameters")
        if task is None:
            yield (
                Stop(index, title, "task known", f"{title!r} is no task of this vehicle"),
                frozenset(),
            )
            continue
        parameters = _sound(given if isinstance(given, dict) else {}, task)
        unmet = _unmet_place(task, parameters, holds.progress, vocabulary)
        if unmet:
            yield Stop(index, title, *unmet), frozenset()
        missing = _missing(logics[index], parameters, holds, logics[index + 1 :])
        if missing:
            first = sorted(missing)[0]
            reason = (
                vocabulary.logic.lacking.get(first) or f"{first!r} is collected later in the plan"
            )
            yield Stop(index, title, "data collected", reason), missing
        holds = Holds(
            holds.progress.after(task, parameters, vocabulary),
            holds.facts | {*logics[index].gives},
            holds.items,
            (*holds.done, logics[index]),
        )


def _unmet_place(
    task: Task, parameters: Mapping[str, Any], progress: Progress, vocabulary: Vocabulary
) -> tuple[Condition, str] | None:
    """The condition on places that keeps a task from running where the plan stands."""
    name = task.position_parameter
    place = parameters.get(name) if name else None
    lacking = _lacking_place(task, parameters)
    if lacking:
        return "position known", f"{lacking} is missing or no position"
    unresolved = place == list(vocabulary.unresolved)
    if unresolved and not progress.searched and task.pattern != DOCKING:
        return (
            "target located",
            f"its place is unresolved and no {vocabulary.locate} comes before it",
        )
    if (
        unresolved
        and task.title == vocabulary.transit
        and progress.here == vocabulary.unresolved
        and not progress.moved
        and len(progress.searched) == 1
    ):
        return (
            "target located",
            f"the only target that was located ({progress.searched[0]}) is where the vehicle is",
        )
    if task.arrival != "transit":
        return None
    if not progress.offers(task):
        return (
            "vehicle at the place",
            (
                f"{vocabulary.locate} locates but does not arrive; no {vocabulary.transit} comes"
                " before this task"
            ),
        )
    if place is not None and (progress.here is None or list(progress.here) != place):
        return (
            "vehicle at the place",
            f"performed at {place}, but no {vocabulary.transit} there comes before it",
        )
    return None


def _lacking_place(task: Task, parameters: Mapping[str, Any]) -> str | None:
    """The parameter, or the choice of them, that must say where or what and does not."""
    places = {item.name: item for item in task.parameters if item.type in ("position", "id")}
    choice = [name for name in task.require_any if name in places]
    if choice and not parameters.keys() & set(task.require_any):
        return " or ".join(choice)
    return next(
        (name for name, item in places.items() if item.required and name not in parameters), None
    )


def _missing(
    logic: TaskLogic, parameters: Mapping[str, Any], holds: Holds, later: list[TaskLogic]
) -> frozenset[str]:
    """The facts that a task needs and the items that it sends, as far as they are not there.

    An item that a task of the plan yields must have been yielded before; any other comes with the
    facts that are needed.
    """
    items = parameters.get(logic.sends or "", ())
    waiting = [
        item
        for item in items
        if item.casefold() not in holds.items and not any(collects(one, item) for one in holds.done)
    ]
    early = frozenset(
        item.casefold() for item in waiting if any(collects(one, item) for one in later)
    )
    if early or (items and not waiting):
        return early
    return frozenset(logic.needs) - holds.facts


def collects(logic: TaskLogic, item: str) -> bool:
    """Whether what is sent under a name is what a task yields: they share a word, in the singular
    or plural.
    """
    return any(
        form in logic.yields
        for word in words(item)
        for form in (word, word.removesuffix("s"), word.removesuffix("es"))
    )


def _sound(parameters: Mapping[str, Any], task: Task) -> dict[str, Any]:
    """The parameters that are valid by themselves; a place that is no position is none."""
    return {
        name: value
        for name, value in parameters.items()
        if name in task.by_name and value_problem(value, task.by_name[name]) is None
    }
