"""Facts are followed from the command to parameters and task prompts, and are seen to get lost
where they do.
"""

from __future__ import annotations

import copy
import json
from collections import Counter
from pathlib import Path
from typing import Any, NamedTuple

import pytest

from planner_ft.benchmark.metrics.alignment import align, plan_entries
from planner_ft.benchmark.metrics.facts import given_values, slot_propagation
from planner_ft.facts import read_input
from planner_ft.vocabulary import load_vocabulary
from planner_ft.vocabulary.plans import Level

USV = load_vocabulary()
DATA = Path(__file__).parents[2] / "data" / "mission"

PROMPT = (
    "Orbit the met mast at [120, -35] 25 metres off at 1.2 m/s, then film the lamp there for two"
    " minutes and come home."
)
EXPECTED: dict[str, Any] = {
    "tasks": [
        {
            "title": "Transit",
            "parameters": {"target_position": [120, -35]},
            "task_prompt": "Go to the met mast at [120, -35].",
        },
        {
            "title": "PerformOrbit",
            "parameters": {"center": [120, -35], "radius": 25, "speed": 1.2},
            "task_prompt": "Circle the mast at [120, -35] with a stand-off of 25 m at 1.2 m/s.",
        },
        {
            "title": "FeatureStare",
            "parameters": {"feature_type": "lamp", "duration": 120},
            "task_prompt": "Film the lamp for two minutes.",
        },
        {"title": "Transit", "parameters": {"target_position": [0, 0]}, "task_prompt": "Go home."},
    ]
}
RECORD = {"prompt": PROMPT, "expected": EXPECTED}
ALL = Counter(coordinates=2, lengths=1, speeds=1, names=1, durations=1)


class Reached(NamedTuple):
    """Slots by kind."""

    stated: Counter[str]
    in_parameters: Counter[str]
    in_prompt: Counter[str]


def follow(plan: Any, level: Level = "mission", record: dict[str, Any] = RECORD) -> Reached:
    pairs = align(plan_entries(level, record["expected"]), plan_entries(level, plan), USV)
    found = slot_propagation(plan, pairs, read_input(record, USV), USV)
    return Reached(*(+Counter({kind: n[at] for kind, n in found.items()}) for at in range(3)))


def changed(index: int, **task: Any) -> dict[str, Any]:
    plan = copy.deepcopy(EXPECTED)
    plan["tasks"][index] |= task
    return plan


def lost(reached: Reached) -> tuple[Counter[str], Counter[str]]:
    return reached.stated - reached.in_parameters, reached.stated - reached.in_prompt


def test_the_expected_plan_carries_every_fact_and_home_is_no_fact() -> None:
    assert follow(EXPECTED) == Reached(ALL, ALL, ALL)


LOSSES: list[tuple[Any, Counter[str], Counter[str]]] = [
    (None, ALL, ALL),
    ({"tasks": []}, ALL, ALL),
    (
        changed(1, parameters={"center": [120, -35], "radius": 30}),
        Counter(lengths=1, speeds=1),
        Counter(),
    ),
    (
        changed(1, task_prompt="Circle the mast at [120, -35]."),
        Counter(),
        Counter(lengths=1, speeds=1),
    ),
    (changed(1, task_prompt=None), Counter(), Counter(coordinates=1, lengths=1, speeds=1)),
    (changed(2, title="KeepStation"), Counter(names=1, durations=1), Counter(names=1, durations=1)),
    (
        changed(2, parameters={"feature_type": "The  Lamp", "duration": "2 min"}),
        Counter(),
        Counter(),
    ),
    (changed(2, task_prompt="Film the lamps for 120 s."), Counter(), Counter()),
    (changed(3, parameters={"target_position": [5, 5]}), Counter(), Counter()),
]


@pytest.mark.parametrize(("plan", "from_parameters", "from_prompt"), LOSSES)
def test_what_gets_lost_on_the_way(
    plan: Any, from_parameters: Counter[str], from_prompt: Counter[str]
) -> None:
    reached = follow(plan)
    assert reached.stated == ALL
    assert lost(reached) == (from_parameters, from_prompt)


def test_every_fact_of_the_curated_commands_is_in_the_right_parameter_and_task_prompt() -> None:
    stated = reached = prompts = 0
    for line in (DATA / "test.jsonl").read_text().splitlines():
        record = json.loads(line)
        found = follow(record["expected"], record=record)
        stated, reached, prompts = (
            stated + found.stated.total(),
            reached + found.in_parameters.total(),
            prompts + found.in_prompt.total(),
        )
    assert stated > 80
    assert (reached, prompts) == (stated, stated)


def test_at_task_level_stated_values_and_places_must_reach_the_right_skill() -> None:
    skills = [("GoToXY", {"x": 10, "y": 20}), ("StationKeep", {"time": 300})]
    steps = [{"navigation_skill": {"name": name, "parameters": given}} for name, given in skills]
    record = {
        "task": "Transit",
        "parameters": {"target_position": [10, 20]},
        "prompt": "Go there and hold for five minutes.",
        "expected": {"skill_sequence": steps},
    }
    assert follow(record["expected"], "task", record).in_parameters == Counter(
        coordinates=1, durations=1
    )
    swapped = {
        "skill_sequence": [
            {"navigation_skill": {"name": "GoToXY", "parameters": {"x": 20, "y": 10}}},
            steps[1],
        ]
    }
    assert lost(follow(swapped, "task", record))[0] == Counter(coordinates=1)


def test_slots_are_counted_by_what_they_are() -> None:
    square = [[0, 0], [10, 0], [10, 10]]
    skills = [
        ("GoToXY", {"x": 10, "y": 20, "yaw": 30}),
        ("ArcTurn", {"radius": 5, "delta_yaw": -90}),
        ("StationKeep", {"time": 60, "note": 7}),
        ("BoundaryEnforcement", {"poly_coords": square}),
        ("Sail", {"place": [3, 4], "marks": ["red buoy"], "count": 8}),
    ]
    plan = {
        "skill_sequence": [
            {"navigation_skill": {"name": name, "parameters": given}} for name, given in skills
        ]
    }
    prompt = (
        "At (10, 20) face 30 degrees, arc 5 m to 90 degrees, -90 degrees, drift a minute, note 7,"
        " [0, 0], [10, 0], [10, 10], [3, 4], the red buoy, 8."
    )
    record = {"task": "Transit", "parameters": {}, "prompt": prompt, "expected": plan}
    found = follow(plan, "task", record)
    assert found.stated == Counter(
        coordinates=3, angles=2, lengths=1, durations=1, numbers=2, names=1
    )
    assert found.in_parameters == found.stated and not found.in_prompt
    half = copy.deepcopy(plan)
    half["skill_sequence"][0]["navigation_skill"]["parameters"].pop("y")
    assert lost(follow(half, "task", record))[0] == Counter(coordinates=1)
    assert next(given_values(plan_entries("task", half), USV)).value == 10
