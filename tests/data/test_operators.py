"""The commands of operators: what the shipped adapter is trained on, and more."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from planner_ft.data.curated import known_tests
from planner_ft.data.leakage import mask, near_pairs
from planner_ft.support.files import read_jsonl
from planner_ft.vocabulary import load_vocabulary

TASKS = Path("data/operators/tasks.jsonl")
FILES = [file for file in sorted(Path("data/operators").glob("*.jsonl")) if file != TASKS]
MEASURED = [
    Path("data/mission/validation.jsonl"),
    Path("data/mission/test.jsonl"),
    Path("data/mission/challenge.jsonl"),
    Path("data/inspection_drone/mission/challenge.jsonl"),
    *sorted(Path("eval/vehicles").glob("*/mission/test.jsonl")),
    Path("eval/challenge/operators.jsonl"),
    Path("eval/challenge/things.jsonl"),
    Path("eval/challenge/turns.jsonl"),
    Path("eval/challenge/spoken.jsonl"),
    Path("eval/challenge/sensors.jsonl"),
    *sorted(Path("eval/challenge").glob("mission*.jsonl")),
    *sorted(Path("eval/field").rglob("*.jsonl")),
]


def _records() -> list[dict[str, Any]]:
    return [record for file in FILES for record in read_jsonl(file)]


def test_no_command_of_operators_is_measured_with() -> None:
    measured = [
        record.get("prompt") or record["command"]
        for file in MEASURED
        for record in read_jsonl(file)
    ]
    splits = {"operators": [record["prompt"] for record in _records()], "measured": measured}
    masked = {name: [*map(mask, texts)] for name, texts in splits.items()}
    for texts in (splits, masked):
        found = near_pairs(texts)["measured", "operators"]
        assert not {measured[here]: splits["operators"][there] for here, there in found.items()}


def test_no_task_of_operators_is_measured_with() -> None:
    prompts = {record["prompt"] for record in read_jsonl(TASKS)}
    for measured in sorted(Path("eval/challenge").glob("task*.jsonl")):
        assert prompts.isdisjoint(record["prompt"] for record in read_jsonl(measured))


def test_families_and_commands_are_apart_from_the_curated_ones() -> None:
    records = _records()
    curated = [
        one
        for part in ("train", "validation", "test")
        for one in read_jsonl(f"data/mission/{part}.jsonl")
    ]
    for key in ("id", "family", "prompt"):
        assert {record[key] for record in records}.isdisjoint(record[key] for record in curated), (
            key
        )
    assert len({record["id"] for record in records}) == len(records)


def test_every_challenge_set_is_known_as_a_test_of_its_level(tmp_path: Path) -> None:
    known = {
        level: {one.name for one in known_tests(level, tmp_path, load_vocabulary("usv"))}
        for level in ("mission", "task")
    }
    named = {"operators.jsonl", "things.jsonl", "spoken.jsonl", "sensors.jsonl"}
    assert named | {"mission_third.jsonl"} <= known["mission"]
    assert {"task.jsonl", "task_unseen.jsonl"} <= known["task"]
    assert not [one for one in known["mission"] if one.startswith("task")]
    assert not known["task"] & {"operators.jsonl", "mission.jsonl"}
