"""The vocabulary as the page needs it: tasks and skills with their parameters."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any

from planner_ft.vocabulary import Parameter, Vocabulary


def vocabulary_json(vocabulary: Vocabulary) -> dict[str, Any]:
    """Names, categories, descriptions, parameters with types, units and limits; home and the place
    that stands for an unknown one.
    """
    return {
        "name": vocabulary.name,
        "home": list(vocabulary.home),
        "unresolved": list(vocabulary.unresolved),
        "tasks": [
            {
                "title": task.title,
                "category": task.category,
                "description": task.description,
                "parameters": _parameters(task.parameters),
            }
            for task in vocabulary.tasks
        ],
        "skills": {
            skill.name: {
                "category": skill.category,
                "role": skill.role,
                "description": skill.description,
                "parameters": _parameters(skill.parameters),
            }
            for skill in vocabulary.skills
        },
    }


def _parameters(parameters: tuple[Parameter, ...]) -> list[dict[str, Any]]:
    return [asdict(parameter) for parameter in parameters]
