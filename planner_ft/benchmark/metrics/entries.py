"""The tasks or skills of a plan in one row, each with the step and role that it stands in."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from planner_ft.vocabulary.plans import Level, list_key, step_skills

TASK = "task"
"""The role of every entry of a mission plan."""


@dataclass(frozen=True)
class Entry:
    """A named task or skill. `step` is the index of the task, or of the skill's step; `stated` says
    whether the plan gives it parameters at all.
    """

    name: str
    role: str
    step: int
    parameters: dict[str, Any]
    stated: bool


def plan_entries(level: Level, plan: Any) -> tuple[Entry, ...]:
    """The entries of any JSON value in order, without those that have no name."""
    items = plan.get(list_key(level)) if isinstance(plan, dict) else None
    key = "title" if level == "mission" else "name"
    found = []
    for step, item in enumerate(items if isinstance(items, list) else ()):
        for role, owner in [(TASK, item)] if level == "mission" else step_skills(item):
            name = owner.get(key) if isinstance(owner, dict) else None
            if isinstance(name, str):
                given = owner.get("parameters")
                parameters = given if isinstance(given, dict) else {}
                found.append(Entry(name, role, step, parameters, isinstance(given, dict)))
    return tuple(found)
