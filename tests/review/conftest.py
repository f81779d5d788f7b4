"""Plans to decide about, made without a model."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from planner_ft.document import PlanDocument, build, write_document
from planner_ft.planning.locations import open_places
from planner_ft.planning.result import AgentUse, Answer, Planned, PlannedTask
from planner_ft.support.manifest import build_manifest
from planner_ft.vocabulary import Vocabulary, load_vocabulary

COMMAND = "Find the green buoy, circle it at 12 m, come home."


def answer(plan: dict[str, Any] | None, problem: str = "") -> Answer:
    return Answer("{", plan, () if plan else (problem,), (), 10, 20, 5, 0.1)


def step(name: str, **parameters: Any) -> dict[str, Any]:
    rest = {
        "filter_skills": [],
        "perception_skills": [],
        "stop_conditions": ["done"],
        "failure_modes": ["lost"],
        "expected_outputs": ["there"],
    }
    return {"navigation_skill": {"name": name, "parameters": parameters}, **rest}


def go(*points: tuple[float, float]) -> list[dict[str, Any]]:
    return [step("GoToXY", x=x, y=y) for x, y in points]


def task(title: str, parameters: dict[str, Any], prompt: str = "") -> dict[str, Any]:
    return {"title": title, "parameters": parameters, "task_prompt": prompt or f"{title}."}


def mission_document(
    command: str,
    tasks: list[dict[str, Any]],
    skills: dict[int, list[dict[str, Any]]],
    vocabulary: Vocabulary,
    assumptions: tuple[str, ...] = (),
) -> PlanDocument:
    """The document of a mission plan, with the skills of some of its tasks (by number, from 1)."""
    plan = {"tasks": tasks, "assumptions": list(assumptions), "constraints": []}
    places = open_places(plan, vocabulary)
    waiting = {number: place.name for place in places for number in place.tasks}
    planned = tuple(
        PlannedTask(
            entry["title"],
            entry["parameters"],
            entry["task_prompt"],
            answer({"skill_sequence": skills[number]}) if number in skills else None,
            waiting.get(number),
        )
        for number, entry in enumerate(tasks, start=1)
    )
    use = AgentUse("embedded", "lora+grounded", None, 0.0, 0, 0, 0, 0, 0.0)
    manifest = build_manifest(
        "plan",
        seed=None,
        configuration={},
        agents={"mission": {"candidate": "embedded"}, "task": {"candidate": "embedded"}},
    )
    return build(
        Planned(
            command,
            answer(plan),
            planned,
            tuple(places),
            usage={"mission": use, "task": use},
            manifest=manifest,
        ),
        vocabulary,
    )


@pytest.fixture(scope="session")
def usv() -> Vocabulary:
    return load_vocabulary("usv")


@pytest.fixture(scope="session")
def document(usv: Vocabulary) -> PlanDocument:
    """A plan of four tasks whose buoy is not located yet."""
    tasks = [
        task("SearchAndDetect", {"target_description": "green buoy"}, "Search for the green buoy."),
        task("Transit", {"target_position": [-99, -99]}, "Go to the green buoy."),
        task(
            "PerformOrbit", {"center": [-99, -99], "radius": 12}, "Circle the green buoy at 12 m."
        ),
        task("Transit", {"target_position": [0, 0]}, "Return home."),
    ]
    return mission_document(COMMAND, tasks, {1: [step("StationKeep", time=60)], 4: go((0, 0))}, usv)


@pytest.fixture
def plan(tmp_path: Path, document: PlanDocument) -> Path:
    """The plan in a file."""
    write_document(tmp_path / "plan.json", document)
    return tmp_path / "plan.json"
