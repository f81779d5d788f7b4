"""Plans in few words, for tests."""

from __future__ import annotations

from typing import Any

Named = tuple[str, dict[str, Any]]


def mission(*tasks: str | Named) -> dict[str, Any]:
    """A mission plan of titles, or of titles with parameters."""
    pairs = [(task, {}) if isinstance(task, str) else task for task in tasks]
    return {
        "tasks": [
            {"title": title, "parameters": dict(parameters), "task_prompt": "Do it."}
            for title, parameters in pairs
        ],
        "assumptions": [],
        "constraints": [],
    }


def step(
    navigation: str | Named,
    filters: tuple[str | Named, ...] = (),
    perception: tuple[str | Named, ...] = (),
) -> dict[str, Any]:
    """A step of a skill plan."""
    return {
        "navigation_skill": _skill(navigation),
        "filter_skills": [_skill(skill) for skill in filters],
        "perception_skills": [_skill(skill) for skill in perception],
        "stop_conditions": [],
        "failure_modes": [],
        "expected_outputs": [],
    }


def steps(*given: dict[str, Any]) -> dict[str, Any]:
    """A skill plan."""
    return {"skill_sequence": list(given)}


def _skill(skill: str | Named) -> dict[str, Any]:
    name, parameters = (skill, {}) if isinstance(skill, str) else skill
    return {"name": name, "parameters": dict(parameters)}
