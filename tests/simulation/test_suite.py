"""Suites of missions: from the command to the table, killed in the middle, and broken files."""

from __future__ import annotations

import itertools
import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from planner_ft.review import log_beside
from planner_ft.review.log import read_log
from planner_ft.simulation import output
from planner_ft.simulation.suite import Ran, read_suite, run_suite, suite_table
from planner_ft.support.errors import PlannerError

from .test_run import command

BUNDLED = Path(__file__).parents[2] / "eval" / "suites" / "missions.toml"
MISSION = """
[[missions]]
name = "{name}"
command = "Find Durius and collect data near the J-tubes. Summarize it, then come back."
published = "mission 2"
locate = {{ Durius = [{x}, 5] }}
runs = {runs}
{more}
"""
SURVEYED = 'survey = "learnt"\noutlines = { Durius = "2.5" }'
HEAD = 'title = "Short"\nsimulators = ["fast", "mujoco"]\nseed = 0\n'


def written(folder: Path, *missions: str, head: str = HEAD) -> Path:
    path = folder / "short.toml"
    path.write_text(head + "".join(missions))
    return path


def mission(name: str, x: float = 20, more: str = "", runs: int = 1) -> str:
    return MISSION.format(name=name, x=x, more=more, runs=runs)


@pytest.fixture
def plain(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(output, "track_svg", lambda _done: "<svg/>")


def ran(path: Path, out: Path, *, overwrite: bool = False) -> Ran:
    return run_suite(read_suite(path), out, lambda _label, _done, _total: None, overwrite=overwrite)


@pytest.mark.usefixtures("plain")
def test_a_command_becomes_runs_in_both_simulators(tmp_path: Path) -> None:
    path = written(tmp_path, mission("One", runs=2), mission("Two", 18, SURVEYED, runs=2))
    done = ran(path, tmp_path / "out")
    both = ("fast", "mujoco")
    assert list(done) == [(name, one) for name in ("One", "Two") for one in both]
    for result in done.values():
        assert result["approved"] and result["overall"]["success"]["value"] == 1
        assert result["command"].startswith("Find Durius")
    plan = tmp_path / "out" / "one" / "plan.json"
    assert json.loads(plan.read_text())["located"] == {"Durius": [20, 5]}
    (record,) = read_log(log_beside(plan))
    assert record["event"] == "approved" and "read by nobody" in record["reason"]
    table = (tmp_path / "out" / "table.md").read_text()
    assert table.count("| 2 | 100.0 [") == 4 and table.count(", published* | 20 | 100.0 |") == 2
    first = (tmp_path / "out" / "two" / "fast" / "run-01.jsonl").read_text()
    assert '"skills":["SurveyTarget"' in first


KILL = """
import os, signal, sys
from pathlib import Path
from planner_ft.simulation.suite import read_suite, run_suite
def report(label, done, total):
    if label.startswith("Two, fast"):
        os.kill(os.getpid(), signal.SIGKILL)
run_suite(read_suite(Path(sys.argv[1])), Path(sys.argv[2]), report)
"""


@pytest.mark.usefixtures("plain", "forked")
def test_a_killed_suite_goes_on(tmp_path: Path) -> None:
    head, out = HEAD.replace(', "mujoco"', ""), tmp_path / "out"
    path = written(tmp_path, mission("One"), mission("Two", 22, runs=2), head=head)
    killed = subprocess.run([sys.executable, "-c", KILL, str(path), str(out)], check=False)
    assert killed.returncode == -9 and not (out / "table.md").exists()
    kept = [out / "one" / "fast" / "results.json", out / "two" / "plan.json"]
    before = [one.stat().st_mtime_ns for one in kept]
    assert (out / "two" / "fast" / "run-01.jsonl").exists()
    assert len(ran(path, out)) == 2
    assert [one.stat().st_mtime_ns for one in kept] == before
    ran(path, tmp_path / "whole")
    assert (out / "table.md").read_text() == (tmp_path / "whole" / "table.md").read_text()


def test_another_suite_needs_another_folder(tmp_path: Path) -> None:
    head, out = HEAD.replace(', "mujoco"', ""), tmp_path / "out"
    ran(written(tmp_path, mission("One"), head=head), out)
    other = written(tmp_path, mission("One", 21), head=head)
    with pytest.raises(PlannerError, match=r"results of another suite than .*--overwrite"):
        ran(other, out)
    assert len(ran(other, out, overwrite=True)) == 1
    for mine in (
        out / "thesis.txt",
        out / "one" / "notes" / "plan.json",
        out / "two" / "plan.json",
    ):
        mine.parent.mkdir(exist_ok=True)
        mine.write_text("mine")
        before = set(out.rglob("*"))
        with pytest.raises(PlannerError, match=r"holds (thesis|one/notes|two).*not of a suite"):
            ran(other, out, overwrite=True)
        assert set(out.rglob("*")) == before
        mine.unlink()
        if mine.parent != out:
            mine.parent.rmdir()
    third = written(tmp_path, mission("Three"), head=head)
    assert len(ran(third, out, overwrite=True)) == 1 and not (out / "one").exists()
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "thesis.txt").write_text("mine")
    for overwrite in (False, True):
        with pytest.raises(PlannerError, match=r"holds thesis.txt and no suite"):
            ran(other, tmp_path / "mine", overwrite=overwrite)
    assert (tmp_path / "mine" / "thesis.txt").read_text() == "mine"


def test_a_mission_of_ones_own_has_no_published_figures(tmp_path: Path) -> None:
    own = mission("Mine").replace('published = "mission 2"\n', "")
    one = mission("mission 1").replace('published = "mission 2"\n', "")
    suite = read_suite(written(tmp_path, own, one))
    pairs = itertools.product(("Mine", "mission 1"), suite.simulators)
    made: Ran = {pair: {"overall": {}, "runs": [1]} for pair in pairs}
    assert [one.published for one in suite.missions] == [None, "mission 1"]
    rows = suite_table(suite, made).rows
    assert [one.heading for one in rows if one.kind == "published"] == ["mission 1, published"]
    alone = read_suite(written(tmp_path, own))
    table = suite_table(alone, made)
    assert "Published" not in table.caption and len(table.rows) == len(suite.simulators)


@pytest.mark.parametrize(
    ("missions", "head", "message"),
    [
        ([], HEAD, "missions is missing"),
        ([mission("One"), mission("one")], HEAD, "two missions are named one"),
        ([mission("One", more="tolerance = 1")], HEAD, "tolerance must be a float"),
        ([mission("One", more="depth = 1.0")], HEAD, "unknown key 'depth'"),
        ([mission("One", more='survey = "sonar"')], HEAD, "must be one of waypoints, learnt"),
        ([mission("One", more='outlines = { Durius = "x" }')], HEAD, "--outline Durius=x"),
        ([mission("One", more="starts = [[1]]")], HEAD, r"a place is no \[x, y\]"),
        ([mission("One").replace("mission 2", "mission 9")], HEAD, "is no published mission"),
        ([mission("One")], HEAD.replace("fast", "sea"), "--simulator sea: must be one of fast"),
        ([mission("One", runs=0)], HEAD, "--runs 0"),
    ],
)
def test_a_broken_suite_is_refused(
    tmp_path: Path, missions: list[str], head: str, message: str
) -> None:
    with pytest.raises(PlannerError, match=message):
        read_suite(written(tmp_path, *missions, head=head))


def test_the_bundled_suite_holds_the_published_commands() -> None:
    suite = read_suite(BUNDLED)
    told = [(one["mission"], one["command"], one["runs"]) for one in output.published_missions()]
    assert [
        (one.published, one.command, str(one.asked.get("runs", 20))) for one in suite.missions
    ] == told
    field = suite.missions[-1].asked
    assert len(set(field["starts"])) == 8 and field["tolerance"] == 2


def test_a_suite_says_everything_itself(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Any
) -> None:
    path = written(tmp_path, mission("One"))
    for given, message in (
        (["--suite", path, "--runs", 3], "--runs: a suite says this itself"),
        (["plan.json", "--suite", path], "give a plan, or --suite FILE, not both"),
        ([], "give a plan, or --suite FILE, not both"),
    ):
        assert command(monkeypatch, *given) == 2
        assert message in capsys.readouterr().err.replace("\n", " ")
