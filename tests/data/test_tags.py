"""Tags agree with plans, and the audit of a curated set misses nothing."""

from __future__ import annotations

import copy
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from planner_ft.data.curated import curated_folder
from planner_ft.data.labels import (
    TAGS,
    WORDS,
    coverage_problems,
    tag_problems,
    tags_of,
    unchecked_tags,
)
from planner_ft.data.leakage import leakage_report
from planner_ft.data.missions import sample_missions
from planner_ft.data.validation import validate_file
from planner_ft.support.files import read_jsonl
from planner_ft.vocabulary import load_vocabulary
from planner_ft.vocabulary.plans import plan_names

USV, DRONE = load_vocabulary(), load_vocabulary("inspection_drone")
CURATED = {
    split: read_jsonl(Path(__file__).parents[2] / "data" / "mission" / f"{split}.jsonl")
    for split in ("train", "validation", "test")
}


@pytest.fixture
def splits() -> dict[str, list[dict[str, Any]]]:
    return copy.deepcopy(CURATED)


def test_the_curated_set_covers_what_it_must(splits: dict[str, list[dict[str, Any]]]) -> None:
    assert coverage_problems(splits, USV) == []


def test_the_drones_curated_set_is_valid_and_covers_what_it_must() -> None:
    folder = curated_folder(DRONE)
    assert folder is not None
    files = {split: folder / f"{split}.jsonl" for split in CURATED}
    for path in files.values():
        assert validate_file(path, DRONE, "mission", complete=True).problems == ()
    drone = {split: read_jsonl(path) for split, path in files.items()}
    assert coverage_problems(drone, DRONE) == []
    drone["test"][0]["family"] = drone["train"][0]["family"]
    assert len(coverage_problems(drone, DRONE)) == 1


def test_the_drones_challenge_set_is_valid_and_apart() -> None:
    folder = curated_folder(DRONE)
    assert folder is not None
    path = folder / "challenge.jsonl"
    assert validate_file(path, DRONE, "mission").problems == ()
    challenge = read_jsonl(path)
    titles = {name for one in challenge for name in plan_names("mission", one["expected"])}
    assert titles == set(DRONE.task) and len({one["group"] for one in challenge}) == 11
    assert len(challenge) >= 100
    known = [record for split in CURATED for record in read_jsonl(folder / f"{split}.jsonl")]
    splits = {"train": [*known, *sample_missions(0, 60, DRONE)], "challenge": challenge}
    (overlap,) = leakage_report("mission", splits)["overlaps"]
    assert overlap["families"] == overlap["near"] == overlap["near_masked"] == 0


def test_a_vehicle_has_the_tags_of_its_tasks() -> None:
    assert {"which.roof-scan", "which.orbit", "rule.order"} <= set(tags_of(DRONE))
    assert not {"which.glare", "rule.dock"} & set(tags_of(DRONE))
    assert "which.roof-scan" not in tags_of(USV)


def test_tables_name_known_tags_and_tasks() -> None:
    titles = {title for of in TAGS.values() for title in of.get("tasks", ())}
    titles |= {of["always"] for of in TAGS.values() if "always" in of}
    assert titles <= {*USV.task, *DRONE.task}
    assert sum(tag.startswith("which.") for tag in tags_of(USV)) == 11


def test_what_is_lacking_is_named(splits: dict[str, list[dict[str, Any]]]) -> None:
    moved = splits["train"].pop()
    splits["test"] = [record for record in splits["test"] if "which.glare" not in record["tags"]]
    splits["validation"].append(moved)
    splits["validation"][0]["family"] = splits["train"][0]["family"]
    found = coverage_problems(splits, USV)
    for part in (
        "train: 124 records, 125 are expected",
        "test: GlareFreeApproach occurs 0 times, 1 are needed",
        "test: no record has the tag which.glare",
        f"family {splits['train'][0]['family']!r} is in train and in validation",
    ):
        assert part in found


def test_a_prompt_in_two_splits_is_named(splits: dict[str, list[dict[str, Any]]]) -> None:
    splits["test"][0]["prompt"] = splits["train"][0]["prompt"]
    assert any("is in train and in test" in problem for problem in coverage_problems(splits, USV))


@pytest.mark.parametrize(
    ("titles", "tags", "problem"),
    [
        (["KeepStation"], ["which.keep", "rule.zen"], "tag 'rule.zen' is not known"),
        (["KeepStation"], ["which.keep", "which.orbit"], "tag which.orbit needs PerformOrbit"),
        (["KeepStation"], [], "the tag which.keep is not"),
        (["KeepStation"], ["which.keep", "which.keep"], "stands twice"),
        ([], [], "go together"),
        (["KeepStation"], ["which.keep", "rule.empty"], "go together"),
    ],
)
def test_tags_and_tasks_must_agree(titles: list[str], tags: list[str], problem: str) -> None:
    record = {
        "tags": tags,
        "expected": {"tasks": [{"title": title, "parameters": {}} for title in titles]},
    }
    assert any(problem in text for text in tag_problems(record, USV))


def test_a_search_and_a_transit_are_those_of_the_definition() -> None:
    """Whatever a vehicle calls them: a plan without them has no such tag."""
    titles = {USV.locate: "FindThing", USV.transit: "DriveTo"}
    tasks = tuple(replace(task, title=titles.get(task.title, task.title)) for task in USV.tasks)
    rover = replace(USV, tasks=tasks, locate="FindThing", transit="DriveTo")
    plan = {"tasks": [{"title": "FindThing", "parameters": {}, "task_prompt": "Find it."}]}
    record = {"expected": plan, "tags": ["rule.search", "rule.transit"]}
    assert list(tag_problems(record, rover)) == ["tag rule.transit needs DriveTo in the plan"]


@pytest.mark.parametrize(("split", "least"), [("train", 8), ("validation", 1), ("test", 1)])
def test_every_title_occurs_often_enough(
    splits: dict[str, list[dict[str, Any]]], split: str, least: int
) -> None:
    def with_title(record: dict[str, Any]) -> bool:
        return "HorizontalPanorama" in plan_names("mission", record["expected"])

    once = next(record for record in splits["train"] if with_title(record))
    for count, problems in (
        (least, []),
        (least - 1, [f"{split}: HorizontalPanorama occurs {least - 1} times, {least} are needed"]),
    ):
        changed = copy.deepcopy(splits)
        others = [record for record in splits[split] if not with_title(record)]
        changed[split] = others + [copy.deepcopy(once) for _ in range(count)]
        found = [one for one in coverage_problems(changed, USV) if "HorizontalPanorama" in one]
        assert found == problems


def test_a_split_of_another_size_is_named(splits: dict[str, list[dict[str, Any]]]) -> None:
    for split, size in (("train", 125), ("validation", 25), ("test", 25)):
        more = {**splits, split: [*splits[split], splits[split][0]]}
        assert coverage_problems(more, USV) == [f"{split}: {size + 1} records, {size} are expected"]


def test_tags_of_other_vehicles_are_checked_by_nobody() -> None:
    records = [{"tags": ["which.roof-scan", "rule.order"]}, {"tags": ["which.orbit"]}, {}]
    assert unchecked_tags(records, USV) == ["which.roof-scan"]
    assert unchecked_tags(records, DRONE) == []


@pytest.mark.parametrize(
    ("titles", "tags", "problems"),
    [
        (["KeepStation"], ["which.keep"], []),
        ([], ["rule.empty"], []),
        (["Transit"], ["rule.transit"], []),
        (
            ["KeepStation"],
            ["which.keep", "rule.transit"],
            ["tag rule.transit needs Transit in the plan"],
        ),
        # A tag of tasks that this vehicle has not asks for nothing.
        (["Transit"], ["which.roof-scan"], []),
        (["Transit"], ["rule.zen"], ["tag 'rule.zen' is not known"]),
    ],
)
def test_all_that_is_wrong_with_tags(
    titles: list[str], tags: list[str], problems: list[str]
) -> None:
    expected = {"tasks": [{"title": title, "parameters": {}} for title in titles]}
    assert list(tag_problems({"tags": tags, "expected": expected}, USV)) == problems


@pytest.mark.parametrize(
    ("tag", "words", "right"),
    [
        ("rule.search-on-request", "FIND it", True),
        ("rule.search-on-request", "a finder", False),
        ("rule.explicit-go", "proceeding there", True),
        ("rule.no-transit", "hold right there", True),
        ("rule.no-transit", "hold at the pier", False),
    ],
)
def test_words_that_an_exception_may_be_said_with(tag: str, words: str, right: bool) -> None:
    assert (WORDS[tag].search(words) is not None) is right
