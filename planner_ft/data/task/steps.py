"""Steps of a skill plan in canonical form, from the skills that run in them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from planner_ft.vocabulary.definition import Vocabulary
from planner_ft.vocabulary.plans import canonical_parameters

Step = tuple[str, dict[str, Any]]
"""A navigation skill and its parameters."""
Entry = dict[str, Any]


def entry_of(name: str, parameters: Mapping[str, Any], vocabulary: Vocabulary) -> Entry:
    """A skill as it stands in a plan."""
    canonical = canonical_parameters(dict(parameters), vocabulary.skill[name])
    return {"name": name, "parameters": canonical}


def plan_step(
    name: str,
    parameters: dict[str, Any],
    filters: list[Entry],
    perceptions: list[Entry],
    vocabulary: Vocabulary,
) -> Entry:
    """A step of the plan, with the strings that its skills report. Parameters are brought into
    canonical form.
    """
    running = [
        vocabulary.skill[entry["name"]] for entry in ({"name": name}, *filters, *perceptions)
    ]
    return {
        "navigation_skill": entry_of(name, parameters, vocabulary),
        "filter_skills": filters,
        "perception_skills": perceptions,
        "stop_conditions": _distinct([running[0].stop]),
        "failure_modes": _distinct(skill.failure for skill in running),
        "expected_outputs": _distinct(skill.output for skill in running),
    }


def _distinct(texts: Iterable[str | None]) -> list[str]:
    return list(dict.fromkeys(text for text in texts if text))
