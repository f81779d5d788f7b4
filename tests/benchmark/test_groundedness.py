"""Values that nobody gave are told from those that the command, the task or geometry give."""

from __future__ import annotations

import itertools
import json
from pathlib import Path
from typing import Any, NamedTuple

import pytest

from planner_ft.benchmark.metrics.alignment import plan_entries
from planner_ft.benchmark.metrics.facts import Given, groundedness
from planner_ft.data.missions import sample_missions
from planner_ft.data.task.sampler import sample_tasks
from planner_ft.facts import read_input
from planner_ft.vocabulary import load_vocabulary
from planner_ft.vocabulary.plans import Level

USV, DRONE = load_vocabulary(), load_vocabulary("inspection_drone")
DATA = Path(__file__).parents[2] / "data" / "mission"


class Groundedness(NamedTuple):
    """Values that can be judged, and those of them that nobody gave."""

    judged: int
    ungrounded: list[Given]


def judged(level: Level, record: dict[str, Any], plan: Any, vocabulary: Any = USV) -> Groundedness:
    source = read_input(record, vocabulary)
    return Groundedness(*groundedness(plan_entries(level, plan), source, vocabulary))


def mission(prompt: str, title: str, vocabulary: Any = USV, **parameters: Any) -> list[str]:
    """The parameters of one task that nobody gave."""
    found = judged(
        "mission",
        {"prompt": prompt},
        {"tasks": [{"title": title, "parameters": parameters}]},
        vocabulary,
    )
    assert found.judged == len(parameters)
    return [given.parameter.name for given in found.ungrounded]


ORBIT = (
    "Circle the mast at [120, -35] at a stand-off of half a kilometre and 1.2 m/s, twice, then come"
    " home."
)
TASKS = [
    (ORBIT, "PerformOrbit", {"center": [120, -35], "radius": 500, "speed": 1.2, "arc": 720}, []),
    (
        ORBIT,
        "PerformOrbit",
        {"center": [-35, 120], "radius": 25, "speed": 1.5, "arc": 360},
        ["center", "radius", "speed", "arc"],
    ),
    (
        ORBIT,
        "PerformOrbit",
        {"center": [-99, -99], "radius": 505},
        [],
    ),  # Unresolved; 2 % are allowed.
    (
        ORBIT,
        "PerformOrbit",
        {"center": [0, 0], "radius": 120},
        ["radius"],
    ),  # A coordinate is no length.
    (
        "Survey the two wrecks.",
        "SurveyTarget",
        {"target_position": [-99, -99], "radius": 2},
        ["radius"],
    ),  # Two is how many.
    (
        "Hold there for 300 m.",
        "KeepStation",
        {"duration": 300},
        ["duration"],
    ),  # A length is no duration.
    ("Find teh grean barell.", "SearchAndDetect", {"target_description": "green barrel"}, []),
    (
        "Find the green barrel.",
        "SearchAndDetect",
        {"target_description": "red barrel"},
        ["target_description"],
    ),
    ("Follow contact T142.", "FollowTarget", {"target_id": "T143"}, ["target_id"]),
    ("Follow contact 4.", "FollowTarget", {"target_id": 4}, []),
    (
        "Send the photos and the log.",
        "SmartDataHarvest",
        {"target_list": ["photos", "video"]},
        ["target_list"],
    ),
    (
        "Head north-west along the cable from [1, 2].",
        "SubseaCableTrack",
        {"start": [1, 2], "heading": 315},
        [],
    ),
    ("Go to [1, 2].", "Berthing", {"goal": [1, 2], "mark": "lamp", "depth": 4}, ["mark", "depth"]),
    ("Go there.", "Transit", {"target_position": "there"}, ["target_position"]),
]


@pytest.mark.parametrize(("prompt", "title", "parameters", "ungrounded"), TASKS)
def test_values_of_a_task(
    prompt: str, title: str, parameters: dict[str, Any], ungrounded: list[str]
) -> None:
    assert mission(prompt, title, **parameters) == ungrounded


def test_another_vehicle() -> None:
    assert mission(
        "Scan the roof at [4, 5], lines 2 m apart.",
        "RoofScan",
        DRONE,
        center=[4, 5],
        spacing=2,
        width=9,
    ) == ["width"]


def test_numbers_that_cannot_be_read_with_certainty_are_not_judged() -> None:
    plan = {
        "tasks": [
            {"title": "KeepStation", "parameters": {"duration": 60}},
            {"title": "SearchAndDetect", "parameters": {"target_description": "owl"}},
        ]
    }
    found = judged("mission", {"prompt": "Hold three fortnights beside the buoy."}, plan)
    assert (found.judged, [given.parameter.name for given in found.ungrounded]) == (
        1,
        ["target_description"],
    )


GRID = {
    "task": "BathymetryGridSurvey",
    "parameters": {"center": [10, 20], "width": 20, "length": 10, "spacing": 10},
    "prompt": "Run the grid.",
}


def steps(*skills: tuple[str, dict[str, Any]]) -> dict[str, Any]:
    return {
        "skill_sequence": [
            {"navigation_skill": {"name": name, "parameters": given}} for name, given in skills
        ]
    }


def goto(x: float, y: float) -> tuple[str, dict[str, Any]]:
    return "GoToXY", {"x": x, "y": y}


def test_waypoints_that_follow_from_a_grid_are_given_and_others_are_not() -> None:
    lanes = [(0, 15), (0, 25), (10, 25), (10, 15), (20, 15), (20, 25)]
    assert judged("task", GRID, steps(*(goto(*place) for place in lanes))) == Groundedness(6, [])
    found = judged("task", GRID, steps(goto(0, 15), goto(5, 25)))
    assert [given.value for given in found.ungrounded] == [[5, 25]]


def test_waypoints_follow_from_those_before_them() -> None:
    record = {**GRID, "task": "Transit", "parameters": {}}
    record["prompt"] = "From (40, 5) head north in legs of 20 m."
    found = judged("task", record, steps(goto(40, 5), goto(40, 25), goto(40, 45), goto(40, 85)))
    assert (found.judged, [given.value for given in found.ungrounded]) == (4, [[40, 85]])


def test_what_stands_beside_a_pair_of_coordinates_is_judged_too() -> None:
    found = judged("task", GRID, steps(("GoToXY", {"x": 0, "y": 15, "mark": "owl"})))
    assert [given.value for given in found.ungrounded] == ["owl"]


def test_waypoints_of_shapes_that_are_not_derived_are_not_judged() -> None:
    assert judged("task", {**GRID, "prompt": "Run a zigzag."}, steps(goto(7, 7))).judged == 0


def test_angles_of_equal_turns_and_a_points_way_off_are_given() -> None:
    record = {
        "task": "Transit",
        "parameters": {"target_position": [10, 0]},
        "prompt": "Turn to 4 headings, then stop 30 m north of there.",
    }
    found = judged(
        "task",
        record,
        steps(
            ("RotateToHeading", {"heading": 270}),
            ("RotateToHeading", {"heading": 200}),
            goto(10, 30),
            goto(10, 31),
        ),
    )
    assert (found.judged, [given.value for given in found.ungrounded]) == (4, [200, [10, 31]])


def test_expected_values_of_the_curated_commands_are_all_grounded() -> None:
    records = [
        json.loads(line)
        for name in ("train", "validation", "test")
        for line in (DATA / f"{name}.jsonl").read_text().splitlines()
    ]
    found = [judged("mission", record, record["expected"]) for record in records]
    assert sum(one.judged for one in found) > 600
    assert [one.ungrounded for one in found if one.ungrounded] == []


def test_expected_values_of_the_generators_are_grounded_but_for_few() -> None:
    """What is called ungrounded here is what the reading misses: the metric must not blame right
    plans.
    """
    missions = [
        judged("mission", record, record["expected"]) for record in sample_missions(21, 150)
    ]
    tasks = [
        judged("task", record, record["expected"])
        for record in itertools.islice(sample_tasks(USV, 21, None, "test"), 200)
    ]
    for found in (missions, tasks):
        assert sum(bool(one.ungrounded) for one in found) <= 0.03 * len(found)
        assert sum(one.judged for one in found) > 2 * len(found)


def test_moved_values_are_found() -> None:
    """Every number of the curated plans set to another one that nobody said."""
    records = [json.loads(line) for line in (DATA / "test.jsonl").read_text().splitlines()]
    moved = stayed = 0
    for record in records:
        for task in record["expected"]["tasks"]:
            numbers = {
                key: value * 1.37 + 3.1
                for key, value in task["parameters"].items()
                if isinstance(value, int | float)
            }
            found = judged(
                "mission", record, {"tasks": [{"title": task["title"], "parameters": numbers}]}
            )
            moved, stayed = (
                moved + len(found.ungrounded),
                stayed + found.judged - len(found.ungrounded),
            )
    assert moved > 40
    assert stayed <= 0.05 * moved
