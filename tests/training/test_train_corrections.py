"""Corrected plans beside the training samples."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from planner_ft.training.preflight import Prepared, run_preflight
from planner_ft.training.samples import Split, read_split
from planner_ft.vocabulary import load_vocabulary

VOCABULARY = load_vocabulary()


def record(name: str) -> dict[str, Any]:
    tasks = [
        {
            "title": "Transit",
            "parameters": {"target_position": [0, 0]},
            "task_prompt": "Return home.",
        }
    ]
    return {
        "id": name,
        "prompt": f"Come home, {name}.",
        "expected": {"tasks": tasks, "assumptions": [], "constraints": []},
    }


def written(path: Path, *names: str) -> Path:
    path.write_text("".join(json.dumps(record(name)) + "\n" for name in names))
    return path


def split(folder: Path) -> Split:
    found = read_split(written(folder / "train.jsonl", "a", "b"), "mission", VOCABULARY, [])
    assert found is not None
    return found


def test_corrections_come_after_the_training_samples_and_change_the_digest(tmp_path: Path) -> None:
    problems: list[str] = []
    train = split(tmp_path)
    both = train.corrected(written(tmp_path / "corrections.jsonl", "c"), problems)
    assert not problems and [item["id"] for item in both.records] == ["a", "b", "c"]
    other = train.corrected(written(tmp_path / "corrections.jsonl", "d"), problems)
    assert len({train.sha256, both.sha256, other.sha256}) == 3


def test_what_is_wrong_with_the_file_is_a_problem_of_the_run(tmp_path: Path) -> None:
    for names, problem in ((("b",), "id 'b' stands in"), (("c", "c"), "stands in line 1 already")):
        problems: list[str] = []
        split(tmp_path).corrected(written(tmp_path / "corrections.jsonl", *names), problems)
        assert len(problems) == 1 and problem in problems[0]
    missing: list[str] = []
    split(tmp_path).corrected(tmp_path / "none.jsonl", missing)
    assert len(missing) == 1 and "none.jsonl: no such file" in missing[0]


def test_the_preflight_says_how_many_there_are_and_leaves_the_validation_split_alone(
    ask: Any, tmp_path: Path
) -> None:
    plain, corrected = Prepared(), Prepared()
    list(run_preflight(ask(), plain))
    found = list(
        run_preflight(
            ask(corrections=str(written(tmp_path / "corrections.jsonl", "c", "d"))), corrected
        )
    )
    assert plain.train and corrected.train and plain.validation and corrected.validation
    assert (
        len(corrected.train.samples) == len(plain.train.samples) + 2
        and corrected.train.sha256 != plain.train.sha256
    )
    assert corrected.validation.sha256 == plain.validation.sha256
    assert any("2 of the training samples from" in finding.text for finding in found)
