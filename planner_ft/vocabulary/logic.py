"""What tasks bring about and need beyond their places: the companion file NAME.logic.toml of a
definition.

Only replaying a plan reads it (planner_ft.benchmark.metrics.executability). It changes no prompt,
no schema and no grammar, and so it is no part of the vocabulary's digest, by which adapters know
what they were trained on.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from planner_ft.vocabulary.definition import Task

LOGIC = ".logic.toml"
LISTS = ("gives", "needs", "yields")


@dataclass(frozen=True)
class TaskLogic:
    """Facts that a task `gives` and `needs`, words for what it `yields`, and the parameter that
    lists what it `sends`.
    """

    gives: tuple[str, ...] = ()
    needs: tuple[str, ...] = ()
    yields: tuple[str, ...] = ()
    sends: str | None = None


@dataclass(frozen=True)
class Logic:
    """Per fact the sentence for a plan that lacks it, and per task title what it gives and
    needs.
    """

    lacking: dict[str, str] = field(default_factory=dict)
    tasks: dict[str, TaskLogic] = field(default_factory=dict)

    def of(self, title: str) -> TaskLogic:
        """The logic of a task; an empty one where nothing is declared."""
        return self.tasks.get(title, TaskLogic())


def build_logic(raw: Mapping[str, Any]) -> Logic:
    """The logic of a parsed file that `logic_problems` finds nothing wrong with."""
    tasks = {
        title: TaskLogic(
            **{key: tuple(entry.get(key, ())) for key in LISTS}, sends=entry.get("sends")
        )
        for title, entry in raw.get("task", {}).items()
    }
    return Logic({name: fact["lacking"] for name, fact in raw.get("fact", {}).items()}, tasks)


def logic_problems(raw: Mapping[str, Any], tasks: Mapping[str, Task]) -> Iterator[str]:
    """Everything wrong with a parsed file, for a vocabulary with these tasks by title."""
    yield from (
        f"the logic file has an unknown key {key!r}" for key in raw if key not in ("fact", "task")
    )
    facts, entries = raw.get("fact", {}), raw.get("task", {})
    if not _tables(facts) or not _tables(entries):
        yield "the logic file needs tables [fact.NAME] and [task.TITLE]"
        return
    for name, fact in facts.items():
        if (
            set(fact) != {"lacking"}
            or not isinstance(fact["lacking"], str)
            or not fact["lacking"].strip()
        ):
            yield f"the logic file: fact {name} must have a text lacking, and nothing else"
    for title, entry in entries.items():
        yield from (
            f"the logic file: task {title}: {problem}"
            for problem in _task_problems(entry, tasks.get(title), facts)
        )
    given = {
        name
        for entry in entries.values()
        for name in entry.get("gives", ())
        if isinstance(name, str)
    }
    yield from (
        f"the logic file: no task gives the fact {name!r}" for name in facts if name not in given
    )


def _task_problems(
    entry: Mapping[str, Any], task: Task | None, facts: Mapping[str, Any]
) -> Iterator[str]:
    if task is None:
        yield "it is not defined"
        return
    for key, value in entry.items():
        if key == "sends":
            parameter = task.by_name.get(value) if isinstance(value, str) else None
            if parameter is None or parameter.type != "texts":
                yield f"sends = {value!r} must name a parameter of type texts"
        elif key not in LISTS:
            yield f"unknown key {key!r}"
        elif not isinstance(value, list) or not all(
            isinstance(name, str) and name.strip() for name in value
        ):
            yield f"{key} = {value!r} must be a list of names"
        elif key != "yields":
            yield from (
                f"{key} names the fact {name!r}, which is not declared"
                for name in value
                if name not in facts
            )


def _tables(value: Any) -> bool:
    return isinstance(value, dict) and all(isinstance(entry, dict) for entry in value.values())
