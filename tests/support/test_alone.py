"""One run in an output folder at a time."""

from __future__ import annotations

import json
import sys
from pathlib import Path

import pytest

from planner_ft.cli import main
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import alone


def test_a_second_one_is_refused_and_leaves_nothing(tmp_path: Path) -> None:
    folder = tmp_path / "new" / "run"
    with alone(folder, "--out", "a benchmark"):
        with (
            pytest.raises(PlannerError, match=r"--out .*run: a benchmark runs there; wait"),
            alone(folder, "--out", "a benchmark"),
        ):
            pass
        with alone(tmp_path / "new" / "other", "--out", "a benchmark"):
            pass
    with alone(folder, "--out", "a benchmark"):
        pass
    assert list(tmp_path.iterdir()) == []


def test_files_of_the_run_stay(tmp_path: Path) -> None:
    with alone(tmp_path / "a" / "b", "--out", "x"):
        (tmp_path / "a" / "b").mkdir()
        (tmp_path / "a" / "b" / "result").write_text("1")
    assert [path.name for path in (tmp_path / "a").iterdir()] == ["b"]


@pytest.mark.parametrize(
    "command",
    [
        "bench --level mission --candidates embedded --overwrite --out OUT",
        "bench --gate eval/gates/ci.toml --out OUT",
        "bench --suite eval/suites/ci.toml --out OUT",
        "gen-data --out OUT --overwrite",
        "export --candidate embedded --out OUT --overwrite",
    ],
)
def test_every_long_command_leaves_a_running_ones_files_alone(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    command: str,
) -> None:
    out = tmp_path / "out"
    out.mkdir()
    kinds = {"manifest.json": json.dumps({"kind": "export"}), "results.json": "{}"}
    for name, content in kinds.items():
        (out / name).write_text(content)
    words = command.replace("OUT", str(out)).split()
    monkeypatch.setattr(sys, "argv", ["plannerft", *words])
    with alone(out, "--out", "something"), pytest.raises(SystemExit) as stop:
        main()
    assert stop.value.code == 2
    assert "runs there; wait for its end" in capsys.readouterr().err
    assert {path.name: path.read_text() for path in out.iterdir()} == kinds
