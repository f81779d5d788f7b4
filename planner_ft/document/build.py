"""A plan document of what was planned."""

from __future__ import annotations

import copy
from dataclasses import asdict
from typing import TYPE_CHECKING, Any

from planner_ft.document.files import PlanDocument
from planner_ft.document.places import locate_parameters
from planner_ft.document.revise import revise
from planner_ft.document.vehicle import Vehicle, load_vehicle
from planner_ft.planning.result import Answer, Planned, PlannedTask
from planner_ft.vocabulary.document_schema import FORMAT, VERSION

if TYPE_CHECKING:
    from planner_ft.vocabulary import Vocabulary


def build(planned: Planned, vocabulary: Vocabulary, vehicle: Vehicle | None = None) -> PlanDocument:
    """The document of a planned command. `vehicle` is what estimates rest on: the vocabulary's own
    profile by default.
    """
    plan = planned.mission.plan or {"tasks": []}
    located = locate_parameters(plan, [task.parameters for task in planned.tasks], vocabulary)
    tasks = [
        _task(number, task, located.get(number, {}))
        for number, task in enumerate(planned.tasks, start=1)
    ]
    places = {
        name: planned.tasks[number - 1].parameters[parameter]
        for number, named in located.items()
        for parameter, name in named.items()
    }
    texts = {
        "assumptions": [*plan.get("assumptions", []), *planned.mission.notes],
        "constraints": list(plan.get("constraints", [])),
    }
    document = {
        "format": FORMAT,
        "version": VERSION,
        "command": planned.command,
        "vocabulary": {"name": vocabulary.name, "sha256": vocabulary.sha256},
        "vehicle": (vehicle or load_vehicle(None, vocabulary)).as_json(),
        "tasks": tasks,
        **texts,
        "located": places,
        **problems(planned.mission),
        "proposed": copy.deepcopy({"tasks": tasks, **texts, "located": places}),
        "edits": [],
        "usage": {agent: asdict(use) for agent, use in planned.usage.items()},
        "peak_memory_bytes": planned.peak_memory,
        "manifest": planned.manifest,
    }
    return revise(document, vocabulary)


def skills_of(answer: Answer | None) -> dict[str, Any]:
    """What a document says of the Task Agent's answer for a task; its skill sequence is null where
    there is none, or no valid one.
    """
    if answer is None:
        return {"skill_sequence": None}
    skills = answer.plan["skill_sequence"] if answer.plan is not None else None
    return {
        "skill_sequence": skills,
        **({"assumptions": list(answer.notes)} if answer.notes else {}),
        **problems(answer),
    }


def problems(answer: Answer) -> dict[str, Any]:
    """What is wrong with an answer, with its raw text; nothing for a valid one."""
    return (
        {}
        if answer.plan is not None
        else {"problems": list(answer.problems), "output": answer.text}
    )


def _task(number: int, task: PlannedTask, located: dict[str, str]) -> dict[str, Any]:
    told = {
        "id": f"t{number}",
        "title": task.title,
        "parameters": task.parameters,
        "task_prompt": task.task_prompt,
    }
    return copy.deepcopy(
        {**told, **skills_of(task.answer), **({"located": located} if located else {})}
    )
