"""One run in an output folder at a time."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from unittest.mock import Mock

import pytest
from filelock import FileLock, Timeout

from planner_ft.cli import main
from planner_ft.document import write_document
from planner_ft.support.alone import alone, staging
from planner_ft.support.errors import PlannerError
from tests.documents import document


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


def test_a_folder_that_takes_no_lock_is_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    refused = Mock(side_effect=Timeout("lock"))  # as in /proc, where no file can be made
    monkeypatch.setattr(FileLock, "acquire", refused)
    with (
        pytest.raises(PlannerError, match=r"--out .*run: nothing can be written in .*; give ano"),
        alone(tmp_path / "run", "--out", "a benchmark"),
    ):
        pass


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
        "compare eval --out OUT --overwrite",
        "report eval --out OUT --overwrite",
        "bench --field --out OUT --overwrite",
        "bench --level both --candidates embedded --out OUT --overwrite",
        "score --level mission --predictions README.md --out OUT --overwrite",
        "train --level mission --candidate embedded --output OUT --overwrite",
        "learning-curve --level mission --candidate embedded --out OUT --overwrite",
        "calibrate data/mission/validation.jsonl --out OUT",
        "simulate PLAN --draft --out OUT --overwrite",
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
    plan = tmp_path / "plan.json"
    write_document(plan, document([]))
    words = command.replace("OUT", str(out)).replace("PLAN", str(plan)).split()
    monkeypatch.setattr(sys, "argv", ["plannerft", *words])
    with alone(out, "--out", "something"), pytest.raises(SystemExit) as stop:
        main()
    assert stop.value.code == 2
    assert "runs there; wait for its end" in capsys.readouterr().err
    assert {path.name: path.read_text() for path in out.iterdir()} == kinds


def test_the_next_one_removes_what_a_killed_one_was_staging(tmp_path: Path) -> None:
    """`out` and `out.2` are two folders, and a file that merely looks alike is a user's."""
    script = (
        "import os, sys; from pathlib import Path; from planner_ft.support.alone import alone,"
        " staging\n"
        "held = []\n"
        "for name in ('out', 'out.2'):\n"
        "    folder = Path(sys.argv[1], name)\n"
        "    held += [alone(folder, '--out', 'x'), staging(folder)]\n"
        "    held[-2].__enter__(); (held[-1].__enter__() / 'half').write_text('h')\n"
        "os.kill(os.getpid(), 9)"
    )
    subprocess.run([sys.executable, "-c", script, str(tmp_path)], check=False)
    (tmp_path / ".out.notes.tmp").mkdir()
    left = {path.name for path in tmp_path.glob(".*.tmp")}
    assert len(left) == 3
    with alone(tmp_path / "out", "--out", "x"), staging(tmp_path / "out") as staged:
        kept = {path.name for path in tmp_path.glob(".*.tmp")} - {staged.name}
    assert sorted(".".join(name.split(".")[:3]) for name in kept) == [".out.2", ".out.notes"]
    assert not staged.exists()


def test_the_next_one_removes_files_that_a_killed_one_was_writing(tmp_path: Path) -> None:
    """Also of a folder in the folder; a file of the user's that ends alike stays."""
    script = (
        "import os, sys; from planner_ft.support.files import atomic_writer\n"
        "held = [atomic_writer(path) for path in sys.argv[1:]]\n"
        "[one.__enter__() for one in held]\n"
        "os.kill(os.getpid(), 9)"
    )
    out = tmp_path / "out"
    (out / "figures").mkdir(parents=True)
    (out / ".my.notes.tmp").write_text("")
    names = [str(out / "table.md"), str(out / "figures" / "a.svg")]
    subprocess.run([sys.executable, "-c", script, *names], check=False)
    assert len(list(out.rglob("*.tmp"))) == 3
    with alone(out, "--out", "x"):
        assert [path.name for path in out.rglob("*.tmp")] == [".my.notes.tmp"]


def test_a_link_to_a_folder_is_that_folder(tmp_path: Path) -> None:
    (tmp_path / "real").mkdir()
    (tmp_path / "link").symlink_to("real")
    with (
        alone(tmp_path / "real", "--out", "x"),
        pytest.raises(PlannerError, match="link: x runs there"),
        alone(tmp_path / "link", "--out", "x"),
    ):
        pass


def test_errors_name_a_staged_file_as_it_is_to_be_called(tmp_path: Path) -> None:
    with pytest.raises(PlannerError) as caught, staging(tmp_path / "out") as staged:
        raise PlannerError(f"{staged / 'a.json'}: cannot be written")
    assert str(caught.value) == f"{tmp_path / 'out' / 'a.json'}: cannot be written"
    assert list(tmp_path.iterdir()) == []
