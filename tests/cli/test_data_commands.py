"""gen-data, validate and vocabulary as a user runs them: output, exit status, nothing
half-written.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path

import pytest

from planner_ft.cli import main
from planner_ft.support.files import write_jsonl

ROOT = Path(__file__).parents[2]
CURATED = ROOT / "data" / "mission"
COUNTS = ("--train", "12", "--validation", "3", "--test", "3")


def run(monkeypatch: pytest.MonkeyPatch, *arguments: object) -> int:
    monkeypatch.setattr(sys, "argv", ["plannerft", *map(str, arguments)])
    with pytest.raises(SystemExit) as left:
        main()
    return int(left.value.code or 0)


def test_gen_data_says_what_it_wrote_and_where_the_time_went(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(monkeypatch, "gen-data", "--out", tmp_path, "--chat", *COUNTS) == 0
    shown = capsys.readouterr().out
    assert f"{tmp_path}/mission: train 12, validation 3, test 3" in shown
    assert f"{tmp_path}/task: train 12, validation 3, test 3, test_unseen 3" in shown
    assert "records/s" in shown and "leakage report" in shown
    assert (tmp_path / "task" / "chat" / "test_unseen.jsonl").is_file()
    assert run(monkeypatch, "gen-data", "--out", tmp_path, "--chat", *COUNTS) == 0
    assert capsys.readouterr().out.count("(up to date)") == 2


def test_gen_data_refuses_to_replace_other_results(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(monkeypatch, "gen-data", "--level", "task", "--out", tmp_path, *COUNTS) == 0
    assert (
        run(monkeypatch, "gen-data", "--level", "task", "--out", tmp_path, "--seed", "5", *COUNTS)
        == 2
    )
    error = capsys.readouterr().err.strip()
    assert error.startswith("plannerft: ") and "--overwrite" in error and "\n" not in error
    assert (
        run(
            monkeypatch,
            "gen-data",
            "--level",
            "task",
            "--out",
            tmp_path,
            "--seed",
            "5",
            "--overwrite",
            *COUNTS,
        )
        == 0
    )


def test_validate_exits_with_0_1_and_2(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(monkeypatch, "validate", "--complete", *CURATED.glob("t*.jsonl")) == 0
    assert "125 mission records: no problems" in capsys.readouterr().err
    bad = tmp_path / "bad.jsonl"
    write_jsonl(
        bad,
        [{"id": "a", "prompt": "Go.", "expected": {"tasks": [{"title": "Teleport"}]}}, {"id": "a"}],
    )
    assert run(monkeypatch, "validate", bad) == 1
    shown = capsys.readouterr()
    assert (
        f"{bad}:1: expected: tasks[0]: 'Teleport' is no task title of the vocabulary" in shown.out
    )
    assert f"{bad}:2: " in shown.out and "3 problems" in shown.err
    assert run(monkeypatch, "validate", tmp_path / "none.jsonl", bad) == 2
    shown = capsys.readouterr()
    assert "none.jsonl: no such file" in shown.err and f"{bad}:1: " in shown.out


def test_validate_refuses_an_unknown_level(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(monkeypatch, "validate", CURATED / "test.jsonl", "--level", "skills") == 2
    assert "--level skills: must be mission or task" in capsys.readouterr().err


def test_vocabulary_shows_writes_and_checks(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(monkeypatch, "vocabulary", "--vocabulary", "inspection_drone") == 0
    assert "## 8 tasks" in capsys.readouterr().out
    files = ("--schemas", tmp_path / "schemas", "--docs", tmp_path / "vocabulary.md")
    assert run(monkeypatch, "vocabulary", "--check", *files) == 1
    assert "mission.schema.json: stale" in capsys.readouterr().out
    assert run(monkeypatch, "vocabulary", *files) == 0
    assert json.loads((tmp_path / "schemas" / "task.strict.schema.json").read_text())[
        "title"
    ].startswith("task plan")
    assert run(monkeypatch, "vocabulary", "--check", *files) == 0
