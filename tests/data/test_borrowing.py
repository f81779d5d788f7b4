"""Commands to the surface vehicle, translated for another one."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace
from pathlib import Path

import pytest

from planner_ft.data.borrowing import borrowed, like_tasks, operators_files
from planner_ft.document.own_vehicle import check_vehicle, new_vehicle
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_jsonl
from planner_ft.training.samples import read_split
from planner_ft.vocabulary import load_vocabulary
from planner_ft.vocabulary.plans import plan_problems

DRONE = load_vocabulary("inspection_drone")
RECORDS = borrowed(DRONE, 9999, 0)
PLANS = {record["prompt"]: record["expected"] for record in RECORDS}


def test_plans_are_the_other_vehicles_own() -> None:
    assert len(RECORDS) > 1000
    for record in RECORDS:
        assert not plan_problems("mission", record["expected"], DRONE, strict=True)
    titles = Counter(task["title"] for plan in PLANS.values() for task in plan["tasks"])
    assert titles.keys() == {task.title for task in DRONE.tasks} - {"RoofScan"}


def test_a_command_keeps_its_words_and_values() -> None:
    wanted = {record["prompt"]: record for path in operators_files() for record in read_jsonl(path)}
    alike = like_tasks(DRONE)
    for prompt, plan in PLANS.items():
        source = wanted[prompt]["expected"]
        assert [alike[task["title"]].title for task in source["tasks"]] == [
            task["title"] for task in plan["tasks"]
        ]
        for old, new in zip(source["tasks"], plan["tasks"], strict=True):
            assert new["parameters"].items() <= old["parameters"].items()
            assert {**old["parameters"], **new["parameters"]} == old["parameters"]


def test_prompts_are_in_the_words_of_the_other_vehicle() -> None:
    plan = PLANS["Inspect the feed barge, she lies at 70,25. Standoff 15 m."]
    assert [task["task_prompt"] for task in plan["tasks"]] == [
        "Fly an inspection square around the feed barge at [70, 25] at 15 m."
    ]
    prompts = [task["task_prompt"] for plan in PLANS.values() for task in plan["tasks"]]
    first_words = {prompt.split()[0] for prompt in prompts}
    assert first_words == {"Fly", "Hover", "Orbit", "Search", "Check", "Compile"}
    assert not any("geotagged" in prompt or "depth" in prompt for prompt in prompts)


def test_a_vehicle_with_no_task_like_another_borrows_nothing() -> None:
    rover = load_vocabulary("eval/vehicles/plant_rover/plant_rover.toml")
    assert borrowed(rover, 9999, 0) == []


def test_the_surface_vehicle_has_its_own() -> None:
    known = {record["prompt"]: record for path in operators_files() for record in read_jsonl(path)}
    records = borrowed(load_vocabulary(), 200, 0)
    assert len(records) == 200
    for record in records:
        assert record["expected"] == known[record["prompt"]]["expected"]


def test_the_same_seed_draws_the_same_and_fewer_are_the_first() -> None:
    assert borrowed(DRONE, 20, 3) == borrowed(DRONE, 50, 3)[:20]
    assert borrowed(DRONE, 20, 3) != borrowed(DRONE, 20, 4)


def test_home_and_the_unresolved_place_are_the_other_vehicles(tmp_path: Path) -> None:
    new_vehicle("my_rover", tmp_path / "my_rover")
    path = tmp_path / "my_rover" / "my_rover.toml"
    text = path.read_text("utf-8")
    assert "home = [0, 0]" in text and "unresolved = [-99, -99]" in text
    text = text.replace("home = [0, 0]", "home = [4, 2]").replace("[-99, -99]", "[-7777, -7777]")
    path.write_text(text, "utf-8")
    missions = path.with_suffix(".missions.toml")
    said = missions.read_text("utf-8").replace(r"\[0, 0\]", r"\[4, 2\]")
    missions.write_text(said, "utf-8")
    rover = load_vocabulary(str(path))
    records = borrowed(rover, 9999, 0)
    tasks = [task for record in records for task in record["expected"]["tasks"]]
    places = [task["parameters"].get("target_position") for task in tasks]
    assert [4, 2] in places and [-7777, -7777] in places
    assert [-99, -99] not in places and [0, 0] not in places
    assert "Drive back home to [4, 2]." in {task["task_prompt"] for task in tasks}
    assumed = {text for record in records for text in record["expected"]["assumptions"]}
    assert "Home is [4, 2]." in assumed and "Home is [0, 0]." not in assumed
    assert not any(" 0, 0" in record["prompt"] for record in records)


def test_what_cannot_be_borrowed_is_one_sentence(tmp_path: Path) -> None:
    new_vehicle("my_rover", tmp_path / "my_rover")
    missions = tmp_path / "my_rover" / "my_rover.missions.toml"
    text = missions.read_text("utf-8").replace('like = "KeepStation"', 'like = "Waiting"')
    missions.write_text(text, "utf-8")
    with pytest.raises(PlannerError, match="'Waiting' is no task of the surface vehicle"):
        borrowed(load_vocabulary(str(tmp_path / "my_rover" / "my_rover.toml")), 5, 0)
    (part,) = [
        one for one in check_vehicle(str(missions.parent)) if one.file.endswith(".missions.toml")
    ]
    assert part.state == "wrong" and "'Waiting' is no task" in part.text


def test_a_split_takes_them_behind_its_own() -> None:
    problems: list[str] = []
    path = Path("data/inspection_drone/mission/train.jsonl")
    split = read_split(path, "mission", DRONE, problems)
    assert split and not problems
    own, added = len(split.records), list[str]()
    copies = split.multiplied(0, 2, 0, added)
    both = split.multiplied(0, 2, 1, added)
    assert both.records[:own] == copies.records[:own] == split.records
    assert abs(len(both.records) - len(copies.records)) < own / 10
    lent = [one for one in both.records if one["id"].startswith("borrowed-")]
    assert len(lent) == own
    assert both.sha256 != copies.sha256 != split.sha256
    assert added[-1] == f"{own} of the training samples borrowed"
    bare = load_vocabulary("eval/vehicles/plant_rover/plant_rover.toml")
    replace(split, vocabulary=bare).multiplied(0, 0, 3, added)
    assert added.pop().startswith("none of the training samples borrowed: see `like`")
    few = split.multiplied(0, 1, 30, added)
    assert not [one for one in few.records if one["id"].startswith("varied-")]
