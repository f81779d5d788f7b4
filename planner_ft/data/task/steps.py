"""Steps of a skill plan in canonical form, from the skills that run in them."""

from __future__ import annotations

import functools
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
    running = (name, *(entry["name"] for entry in (*filters, *perceptions)))
    stops, failures, outputs = _reports(vocabulary, running)
    return {
        "navigation_skill": entry_of(name, parameters, vocabulary),
        "filter_skills": filters,
        "perception_skills": perceptions,
        "stop_conditions": list(stops),
        "failure_modes": list(failures),
        "expected_outputs": list(outputs),
    }


@functools.lru_cache(maxsize=4096)
def _reports(vocabulary: Vocabulary, running: tuple[str, ...]) -> tuple[list[str], ...]:
    """Stop condition of the first skill, failure modes and outputs of all."""
    skills = [vocabulary.skill[name] for name in running]
    failures, outputs = ([getattr(skill, key) for skill in skills] for key in ("failure", "output"))
    return _distinct([skills[0].stop]), _distinct(failures), _distinct(outputs)


def _distinct(texts: Iterable[str | None]) -> list[str]:
    return list(dict.fromkeys(text for text in texts if text))
