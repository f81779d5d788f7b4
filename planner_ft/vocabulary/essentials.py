"""What a vehicle adds to its tasks and asks for: NAME.essentials.toml, no part of the digest."""

import functools
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any, get_args

from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary.checks import Entry
from planner_ft.vocabulary.definition import ESSENTIALS, Skill, SkillMotion, Task, Vocabulary
from planner_ft.vocabulary.plans import value_problem

KEYS = ("skills", "during", "takes", "defaults", "asks")


@dataclass(frozen=True)
class TaskEssentials:
    """What makes a task that task, and the values that it has or needs.

    `skills` are names with the parameters that a step takes when it states none, `during` the
    motions of the steps that perform the task (empty: every motion but going somewhere). `takes`
    has, by skill and its parameter, the parameter of the task that it takes when it has no value.
    """

    skills: Mapping[str, Entry] = field(default_factory=dict)
    during: tuple[str, ...] = ()
    takes: Mapping[str, Mapping[str, str]] = field(default_factory=dict)
    defaults: Entry = field(default_factory=dict)
    asks: tuple[str, ...] = ()


NOTHING = TaskEssentials()


@functools.lru_cache(maxsize=16)
def load_essentials(vocabulary: Vocabulary) -> Mapping[str, TaskEssentials]:
    """By title, of tasks that NAME.essentials.toml names. Raises PlannerError with all problems."""
    raw = vocabulary.beside(ESSENTIALS)
    if problems := list(_problems(raw, vocabulary)):
        raise PlannerError(f"{vocabulary.name}{ESSENTIALS}: " + "; ".join(problems))
    return {title: _built(entry) for title, entry in raw.get("task", {}).items()}


def essentials_of(title: str, vocabulary: Vocabulary) -> TaskEssentials:
    """The essentials of a task; nothing where none are declared. Raises PlannerError."""
    return load_essentials(vocabulary).get(title, NOTHING)


def _built(entry: Entry) -> TaskEssentials:
    made = {key: entry.get(key, {}) for key in ("skills", "takes", "defaults")}
    during, asks = (tuple(entry.get(key, ())) for key in ("during", "asks"))
    return TaskEssentials(**made, during=during, asks=asks)


def _problems(raw: Entry, vocabulary: Vocabulary) -> Iterator[str]:
    yield from (
        f"unknown key {key!r}; there are tables [task.TITLE]" for key in raw.keys() - {"task"}
    )
    tasks = raw.get("task", {})
    if not isinstance(tasks, dict):
        yield "needs tables [task.TITLE]"
        return
    for title, entry in tasks.items():
        if title not in vocabulary.task:
            yield f"[task.{title}]: the vehicle has no such task"
        elif not isinstance(entry, dict):
            yield f"[task.{title}]: must be a table with {', '.join(KEYS)}"
        else:
            found = _entry_problems(entry, vocabulary.task[title], vocabulary)
            yield from (f"[task.{title}]: {problem}" for problem in found)


def _entry_problems(entry: Entry, task: Task, vocabulary: Vocabulary) -> Iterator[str]:
    yield from (f"unknown key {key!r}" for key in entry if key not in KEYS)
    for key in ("skills", "takes"):
        yield from _skill_problems(key, entry.get(key, {}), task, vocabulary)
    defaults = entry.get("defaults", {})
    motions = get_args(SkillMotion)
    yield from _name_problems("during", entry, motions, "a motion of skills")
    yield from _name_problems("asks", entry, task.by_name, "a parameter")
    if not isinstance(defaults, dict):
        yield "defaults must be a table of parameters with their values"
        return
    yield from _value_problems("defaults", defaults, task)
    both = [name for name in defaults if name in entry.get("asks", ())]
    yield from (f"{name} has a default and is asked for: leave one of them out" for name in both)


def _skill_problems(key: str, skills: Any, task: Task, vocabulary: Vocabulary) -> Iterator[str]:
    if not isinstance(skills, dict) or not all(isinstance(own, dict) for own in skills.values()):
        yield f"{key} must be a table of skills with their parameters: {{ SKILL = {{}} }}"
        return
    for name, own in skills.items():
        skill = vocabulary.skill.get(name)
        if skill is None:
            yield f"{key}: the vehicle has no skill {name!r}"
        elif key == "skills":
            yield from _value_problems(f"{key}: {name}", own, skill)
        else:
            yield from (
                f"{key}: {name}.{own_name} = {given!r} must name a parameter of the skill, then"
                " one of the task"
                for own_name, given in own.items()
                if own_name not in skill.by_name or given not in task.by_name
            )


def _name_problems(key: str, entry: Entry, known: Any, what: str) -> Iterator[str]:
    names, there = entry.get(key, []), ", ".join(known) or "none"
    yield from (
        f"{key}: {name!r} is not {what}; there is {there}" for name in names if name not in known
    )


def _value_problems(where: str, values: Entry, owner: Task | Skill) -> Iterator[str]:
    for name, value in values.items():
        parameter = owner.by_name.get(name)
        if parameter is None:
            yield f"{where}: no parameter {name!r}; there is {', '.join(owner.by_name) or 'none'}"
        elif problem := value_problem(value, parameter):
            yield f"{where}: {name} = {problem}"
