"""Plan documents for tests, made without a model."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from planner_ft.document import PlanDocument, build
from planner_ft.planning.locations import open_places
from planner_ft.planning.result import AgentUse, Answer, Planned, PlannedTask
from planner_ft.support.manifest import build_manifest
from planner_ft.vocabulary import Vocabulary, load_vocabulary

USV, DRONE = load_vocabulary("usv"), load_vocabulary("inspection_drone")


def step(name: str, parameters: dict[str, Any] | None = None) -> dict[str, Any]:
    """A step with one navigation skill."""
    rest: dict[str, Any] = {
        "filter_skills": [],
        "perception_skills": [],
        "stop_conditions": [],
        "failure_modes": [],
        "expected_outputs": [],
    }
    return {"navigation_skill": {"name": name, "parameters": parameters or {}}, **rest}


def task(
    title: str,
    parameters: dict[str, Any],
    steps: list[dict[str, Any]] | None,
    prompt: str = "Do it.",
) -> dict[str, Any]:
    """A task of a mission plan with its skills; None where the Task Agent was not asked."""
    return {
        "title": title,
        "parameters": parameters,
        "task_prompt": prompt,
        "skill_sequence": steps,
    }


def document(
    tasks: Sequence[dict[str, Any]],
    vocabulary: Vocabulary = USV,
    *,
    command: str = "Do it.",
    constraints: Sequence[str] = (),
    **planned_as: Any,
) -> PlanDocument:
    """The document of a command that was planned as `tasks`."""
    entries = [
        {key: value for key, value in entry.items() if key != "skill_sequence"} for entry in tasks
    ]
    plan = {"tasks": entries, "assumptions": [], "constraints": [*constraints]}
    waiting = {
        number: place.name for place in open_places(plan, vocabulary) for number in place.tasks
    }
    planned = [
        PlannedTask(
            *(entry[key] for key in ("title", "parameters", "task_prompt")),
            _answer(entry["skill_sequence"]),
            waiting.get(number),
        )
        for number, entry in enumerate(tasks, start=1)
    ]
    use = AgentUse("embedded", "lora", None, 0.0, 1, 1, 1, 1, 1.0)
    manifest = build_manifest(
        "plan", seed=None, configuration={}, agents={"mission": {"candidate": "embedded"}}
    )
    answer = Answer("", plan, (), (), 1, 1, 1, 1.0)
    what = command, answer, tuple(planned), (), {}, {"mission": use}, 1, manifest
    return build(Planned(*what, **planned_as), vocabulary)


def _answer(steps: list[dict[str, Any]] | None) -> Answer | None:
    return None if steps is None else Answer("", {"skill_sequence": steps}, (), (), 1, 1, 1, 1.0)
