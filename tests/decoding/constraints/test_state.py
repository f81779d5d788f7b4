"""Strength state: a plan keeps its own logic, and every right plan can still be written."""

from __future__ import annotations

import itertools
from typing import Any

import pytest

from planner_ft.data.missions import sample_missions
from planner_ft.data.rules import rule_problems
from planner_ft.data.task.sampler import sample_tasks
from planner_ft.decoding.configurations import Strength
from planner_ft.prompts import answer_text
from planner_ft.support.files import compact_json, read_jsonl
from planner_ft.vocabulary import Vocabulary, load_vocabulary
from planner_ft.vocabulary.definition import build_vocabulary
from planner_ft.vocabulary.plans import LEVELS, Level, plan_problems

from .conftest import LIMITS, answer_ids, decoded, make_factory, random_answer, taken
from .test_schema import CURATED

Entry = tuple[str, dict[str, Any]]
UNKNOWN = [-99, -99]
BUOY: Entry = ("SearchAndDetect", {"target_description": "red buoy"})

GREEN: Entry = ("SearchAndDetect", {"target_description": "green buoy"})


def go(*position: float) -> Entry:
    return "Transit", {"target_position": list(position)}


def orbit(*position: float) -> Entry:
    return "PerformOrbit", {"center": list(position)}


def text_of(entries: list[Entry]) -> str:
    tasks = [
        {"title": title, "parameters": parameters, "task_prompt": ""}
        for title, parameters in entries
    ]
    return compact_json({"tasks": tasks, "assumptions": [], "constraints": []})


def admitted(
    tokenizer: Any,
    entries: list[Entry],
    vocabulary: Vocabulary | None = None,
    prompt: str = "inspect the red buoy",
    strength: Strength = "state",
) -> bool:
    factory = make_factory(tokenizer, "mission", vocabulary or load_vocabulary(), strength)
    ids = answer_ids(tokenizer, text_of(entries))
    return taken(factory.start({"prompt": prompt}), ids) == len(ids)


@pytest.mark.parametrize(
    "entries",
    [
        [],
        [go(12, -40), orbit(12, -40), ("KeepStation", {"duration": 60})],
        [BUOY, go(*UNKNOWN), orbit(*UNKNOWN)],
        [BUOY, ("SurveyTarget", {"target_position": UNKNOWN, "radius": 10}), ("KeepStation", {})],
        [BUOY, ("FollowTarget", {"target_position": UNKNOWN})],
        [BUOY, go(*UNKNOWN), ("GlareFreeApproach", {"target_feature": "red buoy"})],
        [("FollowTarget", {"target_id": "contact 4"})],
        [("FollowTarget", {"target_id": "contact 4", "target_position": [1, 2]})],
        [("DockingApproach", {"goal_position": UNKNOWN})],
        [("KeepStation", {"duration": 60}), ("DriftAudit", {}), go(3, 4)],
        [
            BUOY,
            go(*UNKNOWN),
            orbit(*UNKNOWN),
            ("SearchAndDetect", {"target_description": "green buoy"}),
            go(*UNKNOWN),
            orbit(*UNKNOWN),
        ],
        [BUOY, GREEN, go(*UNKNOWN), ("KeepStation", {}), go(*UNKNOWN)],
        [go(12, -40), ("DriftAudit", {}), go(12, -40), go(0, 0)],
        [("BathymetryGridSurvey", {"center": [5, 6]}), go(5, 6), ("DriftAudit", {})],
        [("BathymetryGridSurvey", {"center": [5, 6]}), ("KeepStation", {})],
    ],
)
def test_logical_plans_can_be_written(embedded: Any, entries: list[Entry]) -> None:
    assert admitted(embedded, entries)


@pytest.mark.parametrize(
    "entries",
    [
        [go(*UNKNOWN)],
        [("SurveyTarget", {"target_position": UNKNOWN})],
        [go(12, -40), ("FollowTarget", {"target_position": UNKNOWN})],
        [BUOY, GREEN, go(12, -40), go(12, -40)],
        [BUOY, BUOY],
        [BUOY, go(*UNKNOWN), ("SearchAndDetect", {"target_description": "Red BUOY"})],
        [orbit(12, -40)],
        [go(12, -40), orbit(12, 40)],
        [go(12, -40), orbit(*UNKNOWN)],
        [BUOY, orbit(*UNKNOWN)],
        [BUOY, ("KeepStation", {})],
        [BUOY, go(1, 2), orbit(*UNKNOWN)],
        [("BathymetryGridSurvey", {"center": [5, 6]}), orbit(5, 6)],
        [go(12, -40), go(12, -40)],
        [BUOY, ("FollowTarget", {"target_id": "contact 4", "target_position": UNKNOWN})],
    ],
)
def test_plans_without_logic_cannot(embedded: Any, entries: list[Entry]) -> None:
    assert not admitted(embedded, entries)
    assert admitted(embedded, entries, strength="schema")


@pytest.mark.parametrize("level", LEVELS)
def test_every_right_plan_can_be_written(tokenizer: Any, level: Level) -> None:
    vocabulary = load_vocabulary()
    factory = make_factory(tokenizer, level, vocabulary, "state")
    records = [*read_jsonl(CURATED / "train.jsonl"), *itertools.islice(sample_missions(6), 150)]
    for record in records if level == "mission" else sample_tasks(vocabulary, 6, 60, "train"):
        if level == "mission" and rule_problems(record["expected"], vocabulary):
            continue
        ids = answer_ids(tokenizer, answer_text(level, record, vocabulary))
        assert taken(factory.start(record, 4096), ids) == len(ids), record["prompt"]


@pytest.mark.parametrize("name", ["usv", "inspection_drone"])
def test_a_random_model_gives_plans_that_keep_the_rules(tokenizer: Any, name: str) -> None:
    vocabulary = load_vocabulary(name)
    factory = make_factory(tokenizer, "mission", vocabulary, "state")
    tasks = 0
    for seed in range(8):
        plan = decoded(
            tokenizer,
            random_answer(factory.start({"prompt": "x"}), LIMITS["mission"], seed, busy=tokenizer),
        )
        assert plan_problems("mission", plan, vocabulary, strict=True) == []
        problems = rule_problems(plan, vocabulary)
        # Whether a vehicle goes on where a survey took it, and how a return ends, only the command
        # says.
        assert [
            problem
            for problem in problems
            if "does not end at its place" not in problem and "return" not in problem
        ] == []
        tasks += len(plan["tasks"])
    assert tasks > 20


def test_a_skill_sequence_goes_nowhere_unresolved_unless_its_task_does(embedded: Any) -> None:
    factory = make_factory(embedded, "task", load_vocabulary(), "state")

    def goes(x: float, y: float, **parameters: Any) -> bool:
        ids = answer_ids(
            embedded,
            f'{{"skill_sequence":[{{"navigation_skill":{{"name":"GoToXY","parameters":{{"x":{x},"y":{y}}}}}',
        )
        record = {"task": "Transit", "prompt": "go", "parameters": parameters}
        return taken(factory.start(record), ids) == len(ids)

    assert goes(-99, 5)
    assert goes(5, -99)
    assert goes(-99, -99.5)
    assert not goes(-99, -99)
    assert goes(-99, -99, target_position=UNKNOWN)


def test_titles_that_begin_other_titles(embedded: Any) -> None:
    def task(title: str, arrival: str) -> dict[str, Any]:
        parameter = {"name": "target_position", "type": "position", "required": True}
        common = {
            "category": "c",
            "description": "d",
            "pattern": "goto",
            "skills": {"navigation": ["Go"]},
        }
        return {
            "title": title,
            "arrival": arrival,
            "parameters": [parameter] if title != "Look" else [],
            **common,
        }

    vehicle = {
        "name": "v",
        "title": "v",
        "frame": "f",
        "home": [0, 0],
        "unresolved": [-99, -99],
        "transit": "Fly",
        "locate": "Look",
    }
    skill = {"name": "Go", "category": "c", "role": "navigation", "description": "d"}
    tasks = [
        task("Fly", "self"),
        task("FlyHome", "self"),
        task("Look", "self"),
        task("Orbit", "transit"),
    ]
    vocabulary = build_vocabulary({"vehicle": vehicle, "task": tasks, "skill": [skill]}, {}, "test")
    there = {"target_position": [1, 2]}
    assert admitted(
        embedded,
        [("Fly", there), ("Orbit", there), ("FlyHome", {"target_position": [0, 0]}), ("Look", {})],
        vocabulary,
    )
    assert not admitted(embedded, [("Orbit", there)], vocabulary)
    assert not admitted(
        embedded,
        [("Fly", there), ("FlyHome", there), ("Orbit", {"target_position": [3, 4]})],
        vocabulary,
    )
