"""Test data from outsiders, good and bad."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from planner_ft.benchmark.samples import load_bench_data
from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary import load_vocabulary

USV = load_vocabulary()
MISSION = {
    "id": "a",
    "prompt": "go home",
    "expected": {"tasks": [{"title": "Transit", "parameters": {"target_position": [0, 0]}}]},
}
TASK = {
    "id": "a",
    "prompt": "hold",
    "task": "KeepStation",
    "parameters": {},
    "expected": {
        "skill_sequence": [
            {"navigation_skill": {"name": "StationKeep", "parameters": {"time": 60}}}
        ]
    },
}


def write(path: Path, *records: Any) -> Path:
    path.write_text("".join(json.dumps(record) + "\n" for record in records), encoding="utf-8")
    return path


def changed(record: dict[str, Any], **values: Any) -> dict[str, Any]:
    return {key: value for key, value in {**record, **values}.items() if value is not ...}


def test_names_and_parameters_are_enough(tmp_path: Path) -> None:
    mission = load_bench_data(
        write(tmp_path / "m.jsonl", MISSION, {**MISSION, "id": "b", "family": "f"}), "mission", USV
    )
    assert [(sample.id, sample.family) for sample in mission.samples] == [("a", "a"), ("b", "f")]
    names_only = {**MISSION, "expected": {"tasks": [{"title": "Transit"}]}}
    assert (
        load_bench_data(write(tmp_path / "n.jsonl", names_only), "mission", USV).summary()["n"] == 1
    )
    assert len(load_bench_data(write(tmp_path / "t.jsonl", TASK), "task", USV).samples) == 1


def test_the_limit_keeps_the_first_samples(tmp_path: Path) -> None:
    path = write(tmp_path / "m.jsonl", *({**MISSION, "id": str(index)} for index in range(5)))
    data = load_bench_data(path, "mission", USV, 2)
    assert [sample.id for sample in data.samples] == ["0", "1"]
    assert data.summary()["n"] == 2
    assert data.ids == frozenset("01234")
    with pytest.raises(PlannerError, match="--limit 0"):
        load_bench_data(path, "mission", USV, 0)


@pytest.mark.parametrize(
    ("record", "problem"),
    [
        (changed(MISSION, id=...), "id is missing"),
        (changed(MISSION, id=7), "id is missing or no text"),
        (changed(MISSION, prompt=" "), "prompt is missing"),
        (changed(MISSION, expected=...), "--level mission"),
        (changed(MISSION, expected={"skill_sequence": []}), "--level mission"),
        (changed(MISSION, expected={"tasks": [{"title": "Fly"}]}), "'Fly'"),
        (changed(MISSION, expected={"tasks": ["Transit"]}), r"tasks\[0\] has no title"),
        (
            changed(MISSION, expected={"tasks": [{"title": "Transit", "parameters": []}]}),
            "parameters is no object",
        ),
        ([1], "a JSON object is expected"),
    ],
)
def test_a_bad_mission_record_is_named_by_file_and_line(
    tmp_path: Path, record: Any, problem: str
) -> None:
    path = write(tmp_path / "m.jsonl", {**MISSION, "id": "first"}, record)
    with pytest.raises(PlannerError, match=rf"m\.jsonl:2: .*{problem}"):
        load_bench_data(path, "mission", USV)


@pytest.mark.parametrize(
    ("record", "problem"),
    [
        (changed(TASK, task="Fly"), "'Fly'"),
        (changed(TASK, task={}), "is no task"),
        (changed(TASK, parameters=...), "parameters is missing"),
        (changed(TASK, expected={"tasks": []}), "--level task"),
        (changed(TASK, expected={"skill_sequence": [{"filter_skills": []}]}), "has no name"),
        (changed(TASK, expected={"skill_sequence": ["hold"]}), "has no name"),
    ],
)
def test_a_bad_task_record_is_named(tmp_path: Path, record: Any, problem: str) -> None:
    with pytest.raises(PlannerError, match=problem):
        load_bench_data(write(tmp_path / "t.jsonl", record), "task", USV)


def test_all_bad_lines_are_reported_at_once(tmp_path: Path) -> None:
    path = tmp_path / "m.jsonl"
    path.write_text(json.dumps(MISSION) + "\n{\n\n" + json.dumps(MISSION) + "\n" + "[]\n" * 6)
    with pytest.raises(PlannerError) as caught:
        load_bench_data(path, "mission", USV)
    text = str(caught.value)
    assert "m.jsonl:2: not JSON" in text
    assert "m.jsonl:4: id 'a' stands on line 1 already" in text
    assert "and 3 more" in text


def test_missing_empty_and_non_utf8_files_are_one_sentence(tmp_path: Path) -> None:
    (tmp_path / "empty.jsonl").write_text("\n")
    (tmp_path / "latin.jsonl").write_bytes(b'{"id": "\xe9"}\n')
    for name, problem in (
        ("none.jsonl", "no such file"),
        ("empty.jsonl", "no samples"),
        ("latin.jsonl", "UTF-8"),
    ):
        with pytest.raises(PlannerError, match=problem):
            load_bench_data(tmp_path / name, "mission", USV)
