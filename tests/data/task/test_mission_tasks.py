"""Task inputs as the Mission Agent writes them."""

from __future__ import annotations

import itertools
from pathlib import Path

import pytest

from planner_ft.data.task.sampler import mission_tasks, task_record
from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary import load_vocabulary
from planner_ft.vocabulary.plans import plan_problems

VOCABULARY = load_vocabulary()


def steps(
    title: str,
    parameters: dict,
    prompt: str = "Do it.",
    subject: str | None = None,
    place: tuple[int, int] = (10, 20),
) -> list[tuple[str, dict]] | None:
    record = task_record(
        {"title": title, "parameters": parameters, "task_prompt": prompt},
        subject,
        list(place),
        VOCABULARY,
    )
    return record and [
        (step["navigation_skill"]["name"], step["navigation_skill"]["parameters"])
        for step in record["expected"]["skill_sequence"]
    ]


def test_records_are_valid_and_the_same_for_the_same_seed() -> None:
    first, again = (list(itertools.islice(mission_tasks(VOCABULARY, 4), 200)) for _ in range(2))
    assert first == again and len({record["task"] for record in first}) > 12
    assert all(
        plan_problems("task", record["expected"], VOCABULARY, strict=True) == [] for record in first
    )
    assert all([-99, -99] not in record["parameters"].values() for record in first)


def test_an_open_place_is_filled_in_and_a_found_boat_is_kept_in_the_picture() -> None:
    assert steps("Transit", {"target_position": [-99, -99]}) == [("GoToXY", {"x": 10, "y": 20})]
    assert steps("FollowTarget", {"target_position": [-99, -99]}, subject="red kayak") == [
        ("GoToXY", {"x": 10, "y": 20}),
        ("VisualStationKeep", {"target_id": "red kayak"}),
    ]


def test_a_survey_is_eight_waypoints_from_the_middle_of_the_east_side() -> None:
    found = steps("SurveyTarget", {"target_position": [0, 0], "radius": 10})
    assert found is not None and len(found) == 8
    assert [tuple(values.values()) for _name, values in found[:3]] == [(10, 0), (10, 10), (0, 10)]


def test_a_pass_runs_abreast_of_the_structure_that_its_prompt_places() -> None:
    values = {"side_id": "west", "length": 60, "distance": 8}
    entry = {"title": "ParallelStructurePass", "parameters": values}
    entry["task_prompt"] = "Run along the west side of the quay at [40, 10] for 60 m, 8 m off."
    record = task_record(entry, None, [0, 0], VOCABULARY, at=[40, 10])
    assert record is not None
    ends = [step["navigation_skill"]["parameters"] for step in record["expected"]["skill_sequence"]]
    assert ends == [{"x": 32, "y": -20}, {"x": 32, "y": 40}]
    assert task_record(entry, None, [0, 0], VOCABULARY, at=[70, 10]) is None


def test_a_grid_of_20_by_20_at_5_metres_has_ten_waypoints_and_without_spacing_six() -> None:
    size = {"center": [0, 0], "width": 20, "length": 20}
    found = steps("BathymetryGridSurvey", {**size, "spacing": 5})
    assert found is not None and len(found) == 10 and found[0] == ("GoToXY", {"x": -10, "y": -10})
    lanes_of_the_vehicle = steps("BathymetryGridSurvey", size)
    assert lanes_of_the_vehicle is not None and len(lanes_of_the_vehicle) == 6
    assert steps("BathymetryGridSurvey", {"center": [0, 0], "spacing": 5}) is None


def test_another_vehicle_has_no_such_tasks(tmp_path: Path) -> None:
    with pytest.raises(PlannerError, match="inspection_drone"):
        next(mission_tasks(load_vocabulary("inspection_drone"), 0))
