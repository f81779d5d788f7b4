"""The tasks or skills of a plan as one row of entries, with the step and role that each stands
in.
"""

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
    """The entries of any JSON value in order; what has no name that is a text is passed over, and
    so is a plan of None.
    """
    items = plan.get(list_key(level)) if isinstance(plan, dict) else None
    found = []
    for step, item in enumerate(items if isinstance(items, list) else ()):
        named = [(TASK, item)] if level == "mission" else step_skills(item)
        for role, owner in named:
            name = (
                owner.get("title" if level == "mission" else "name")
                if isinstance(owner, dict)
                else None
            )
            if isinstance(name, str):
                parameters = owner.get("parameters")
                found.append(
                    Entry(
                        name,
                        role,
                        step,
                        parameters if isinstance(parameters, dict) else {},
                        isinstance(parameters, dict),
                    )
                )
    return tuple(found)
