"""Exact sequence: the right names in the right order, repetitions included."""

from __future__ import annotations

from typing import Any

from planner_ft.vocabulary.plans import Level, list_key, plan_names, step_skills

Sequence = list[tuple[str, ...]]


def name_sequence(level: Level, plan: dict[str, Any]) -> Sequence:
    """The names in order: one title per task, or per step its skills with their roles, sorted, as
    skills of one step run at the same time.
    """
    if level == "mission":
        return [(title,) for title in plan_names(level, plan)]
    steps = plan.get(list_key(level))
    return [
        tuple(sorted(f"{role} {skill.get('name')}" for role, skill in step_skills(step)))
        for step in (steps if isinstance(steps, list) else ())
    ]


def flat_sequence(level: Level, plan: dict[str, Any]) -> list[str]:
    """The names of `name_sequence` one by one."""
    return [name for step in name_sequence(level, plan) for name in step]


def exact_sequence(level: Level, plan: dict[str, Any] | None, expected: dict[str, Any]) -> bool:
    """Whether an answer names the expected tasks, or steps with their skills, in the expected order
    and nothing else; an answer that does not parse never does.
    """
    return plan is not None and name_sequence(level, plan) == name_sequence(level, expected)
