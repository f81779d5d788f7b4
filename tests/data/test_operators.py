"""The commands of operators that the shipped adapter is trained on."""

from __future__ import annotations

from pathlib import Path

import pytest

from planner_ft.data.leakage import near_duplicate
from planner_ft.support.files import read_jsonl

FILE = Path("data/operators/train.jsonl")
MEASURED = [
    Path("data/mission/validation.jsonl"),
    Path("data/mission/test.jsonl"),
    Path("data/mission/challenge.jsonl"),
    Path("eval/challenge/operators.jsonl"),
    *sorted(Path("eval/challenge").glob("mission*.jsonl")),
    *sorted(Path("eval/field").glob("*.jsonl")),
]


@pytest.mark.parametrize("measured", MEASURED, ids=str)
def test_no_command_of_operators_is_measured_with(measured: Path) -> None:
    records = list(read_jsonl(FILE))
    commands = [record.get("prompt") or record["command"] for record in read_jsonl(measured)]
    assert not [found for one in commands if (found := near_duplicate(one, records))]


def test_families_and_commands_are_apart_from_the_curated_ones() -> None:
    records = list(read_jsonl(FILE))
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
