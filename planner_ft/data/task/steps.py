"""From a script to the expected plan."""

from __future__ import annotations

from typing import Any

from planner_ft.data.task.movements import Movement
from planner_ft.data.task.phrasebook import Call
from planner_ft.data.task.phrasing import Script
from planner_ft.vocabulary.definition import Vocabulary
from planner_ft.vocabulary.plans import canonical_parameters


def expected_plan(script: Script, vocabulary: Vocabulary) -> dict[str, Any]:
    """The skill plan in canonical form. Within a step, filters and perception skills stand in the
    order of mention.
    """
    steps = []
    for index, movement in enumerate(script.movements):
        here = [scoped for scoped in script.scoped if index in scoped.steps]
        filters = _entries(
            [
                *script.filters,
                *movement.filters,
                *(scoped.call for scoped in here if scoped.role == "filters"),
            ],
            vocabulary,
        )
        perceptions = _entries(
            [
                *script.perceptions,
                *movement.perceptions,
                *(scoped.call for scoped in here if scoped.role == "perceptions"),
            ],
            vocabulary,
        )
        steps += [
            plan_step(name, parameters, filters, perceptions, vocabulary)
            for name, parameters in movement.steps
        ]
    return {"skill_sequence": steps}


def _entries(calls: list[Call], vocabulary: Vocabulary) -> list[dict[str, Any]]:
    said = sorted((call for call in calls if call.skill is not None), key=lambda call: call.order)
    return [
        {
            "name": call.skill,
            "parameters": canonical_parameters(call.parameters, vocabulary.skill[str(call.skill)]),
        }
        for call in said
    ]


def plan_step(
    name: str,
    parameters: dict[str, Any],
    filters: list[dict[str, Any]],
    perceptions: list[dict[str, Any]],
    vocabulary: Vocabulary,
) -> dict[str, Any]:
    """A step of the plan, with the strings that its skills report. Parameters are brought into
    canonical form.
    """
    skill = vocabulary.skill
    running = [
        name,
        *(entry["name"] for entry in filters),
        *(entry["name"] for entry in perceptions),
    ]
    return {
        "navigation_skill": {
            "name": name,
            "parameters": canonical_parameters(parameters, skill[name]),
        },
        "filter_skills": filters,
        "perception_skills": perceptions,
        "stop_conditions": _distinct([skill[name].stop]),
        "failure_modes": _distinct([skill[entry].failure for entry in running]),
        "expected_outputs": _distinct([skill[entry].output for entry in running]),
    }


def _distinct(texts: list[str | None]) -> list[str]:
    return list(dict.fromkeys(text for text in texts if text))


def movement_kinds(movements: list[Movement]) -> str:
    """The kinds of the movements, for the name of the family."""
    return "+".join(movement.kind for movement in movements)
