"""Tried and broken on purpose: a clear sentence, exit status 2, and nothing written or lost."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from planner_ft.document import read_document, write_document
from planner_ft.review import log_beside, reject
from planner_ft.simulation import output
from planner_ft.simulation.guidance import Follow
from planner_ft.simulation.run import SimulationSettings, simulate
from planner_ft.skills.mission import LearntGo
from planner_ft.skills.policies import SHIPPED
from planner_ft.support.errors import PlannerError
from tests.documents import document, step, task

from .plans import saved, transit, using
from .test_run import FENCE, SHORT, command

UNKNOWN = task("Transit", {"target_position": [-99, -99]}, None, prompt="Go to the raft.")
ENDLESS = task("PerformOrbit", {"center": [20, 0]}, [using(step("ArcTurn"))])
Make = Callable[[Path], Path]


def plan(*tasks: dict[str, Any], **how: Any) -> Make:
    return lambda folder: saved(folder, tasks or SHORT, **how)


def altered(folder: Path) -> Path:
    path = saved(folder, SHORT)
    content = json.loads(path.read_text())
    content["tasks"][0]["skill_sequence"][0]["navigation_skill"]["parameters"]["x"] = 99
    path.write_text(json.dumps(content))
    return path


def unapproved(folder: Path) -> Path:
    write_document(folder / "plan.json", document(SHORT))
    return folder / "plan.json"


def rejected(folder: Path) -> Path:
    path = saved(folder, SHORT)
    reject(read_document(path), log_beside(path), "Ada", "no")
    return path


def log_broken(folder: Path) -> Path:
    path = saved(folder, SHORT)
    log = log_beside(path)
    log.write_text(log.read_text().replace("Ada", "Bob"))
    return path


def cut(folder: Path) -> Path:
    path = saved(folder, SHORT)
    path.write_text(path.read_text()[:500])
    return path


def ran_before(folder: Path) -> Path:
    path = saved(folder, SHORT)
    simulate(SimulationSettings(path, runs=1, mcap=0))
    return path


def ran_with_notes(folder: Path) -> Path:
    path = ran_before(folder)
    (folder / "plan.simulation" / "thesis.txt").write_text("mine")
    return path


CASES: dict[str, tuple[Make, list[str], str]] = {
    "unresolved place": (plan(UNKNOWN), [], "is not known, and task 1 needs it"),
    "two tasks at it": (plan(UNKNOWN, UNKNOWN), [], "is not known, and tasks 1, 2 need it"),
    "no end": (plan(ENDLESS), [], "task 1 PerformOrbit: its movement is not known in full"),
    "altered": (altered, [], "altered since Ada approved it"),
    "altered draft": (altered, ["--draft"], "altered since Ada approved it"),
    "not approved": (unapproved, [], "not approved"),
    "rejected": (rejected, [], "rejected by Ada"),
    "broken log": (log_broken, [], "its hash does not fit"),
    "half a plan": (cut, [], "plan.json"),
    "no plan": (lambda folder: folder / "none.json", [], "no such file"),
    "another vehicle": (plan(), ["--vocabulary", "inspection_drone"], "another vocabulary"),
    "structure on the start": (
        plan(chart={"buoy": (0.5, 0.0)}),
        [],
        "would start in buoy, at [0, 0]",
    ),
    "outline on the start": (
        plan(chart={"buoy": (8.0, 0.0)}),
        ["--outline", "buoy=16x4"],
        "would start in buoy, at [0, 0]",
    ),
    "outline of nothing": (
        plan(chart={"buoy": (8.0, 0.0)}),
        ["--outline", "dock=16x4"],
        "--outline dock: is no structure of the plan; there is buoy",
    ),
    "structure on another start": (
        plan(chart={"buoy": (20.0, 0.0)}),
        ["--start", "20,0.2"],
        "would start in buoy, at [20, 0.2]",
    ),
    "fence without home": (plan(constraints=[FENCE.format(5)]), [], "excludes the start [0, 0]"),
    "fence without home, start inside": (
        plan(constraints=[FENCE.format(5)]),
        ["--start", "8,0"],
        "excludes home, where runs that fail return to",
    ),
    "fence without a start": (
        plan(constraints=[FENCE.format(-5)]),
        ["--start", "0,0", "--start", "0,60"],
        "excludes the start [0, 60]",
    ),
    "folder of an earlier run": (ran_before, [], "give --overwrite to replace it"),
    "folder with notes": (ran_with_notes, ["--overwrite"], "holds thesis.txt"),
    "policy of another skill": (
        plan(),
        ["--goto", str(SHIPPED / "survey")],
        "is a policy of survey, not of goto",
    ),
    "no policy": (plan(), ["--goto", str(SHIPPED)], "is not there; give a folder"),
    "no folder": (plan(), ["--survey", "none"], "--survey none: must be waypoints, learnt, or"),
    "no run": (plan(), ["--runs", "0"], "--runs 0: must be from 1"),
    "too many logs": (plan(), ["--mcap", "3"], "--mcap 3"),
    "no tolerance": (plan(), ["--tolerance", "0"], "--tolerance 0"),
    "no such simulator": (plan(), ["--simulator", "sea"], "--simulator sea: must be one of fast"),
    "no place": (plan(), ["--start", "here"], "--start here: expected"),
    "no such fault": (plan(), ["--fault", "fog"], "--fault fog: there is current"),
    "no location": (plan(), ["--locate", "x"], "--locate"),
}


@pytest.mark.parametrize("name", CASES)
def test_a_sentence_and_nothing_lost(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Any
) -> None:
    monkeypatch.setattr(output, "track_svg", lambda _done: "<svg/>")
    make, flags, sentence = CASES[name]
    path = make(tmp_path)
    before = {one: one.read_bytes() for one in tmp_path.rglob("*") if one.is_file()}
    capsys.readouterr()
    runs = [] if "--runs" in flags else ["--runs", "2"]
    logs = [] if "--mcap" in flags else ["--mcap", "0"]
    assert command(monkeypatch, path, *runs, *logs, *flags) == 2
    told = " ".join(capsys.readouterr().err.split())
    assert sentence in told and told.count("plannerft: ") == 1 and "Traceback" not in told
    assert {one: one.read_bytes() for one in tmp_path.rglob("*") if one.is_file()} == before


@pytest.mark.parametrize("simulator", ["fast", "mujoco"])
@pytest.mark.parametrize(("goto", "skill"), [("guidance", Follow), ("learnt", LearntGo)])
def test_what_is_no_number_stops_its_run_and_is_told(
    simulator: str,
    goto: str,
    skill: type[Follow],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: Any,
) -> None:
    going = skill.step

    def broken(self: Any, runs: Any, given: Any) -> Any:
        made = going(self, runs, given)
        made[runs == 0] = np.nan if self.scene.time > 2 else made[runs == 0]
        return made

    monkeypatch.setattr(output, "track_svg", lambda _done: "<svg/>")
    monkeypatch.setattr(skill, "step", broken)
    path = saved(tmp_path, [transit(15, 0)])
    flags = ["--runs", 2, "--mcap", 0, "--simulator", simulator, "--goto", goto]
    assert command(monkeypatch, path, *flags) == 0
    told = " ".join(capsys.readouterr().out.split())
    assert "1 of 2 runs: stopped (GoToXY: its command is not finite" in told
    results = json.loads((tmp_path / "plan.simulation" / "results.json").read_text())["runs"]
    assert [one["success"] for one in results] == [False, True]
    assert results[0]["seconds"] < 4 < results[1]["seconds"]


def raises(_self: Any, _runs: Any, *_given: Any) -> Any:
    raise KeyError("weights")


def makes_nothing(self: Any, job: Any, scene: Any) -> None:
    self.job, self.scene = job, scene


AT = "[skill.GoToXY], t1 step 1"


@pytest.mark.parametrize(
    ("method", "own", "sentence"),
    [
        ("step", raises, f"{AT}, run 1 and 1 more: Follow.step raised KeyError ('weights') at "),
        (
            "step",
            lambda _self, runs, _given: np.zeros((len(runs), 2)),
            "step returned shape (2, 2)",
        ),
        ("done", lambda *_given: None, "done returned None instead of shape (2,); mend the skill"),
        ("failed", lambda *_given: [True], "failed returned shape (1,) instead of shape (2,)"),
        ("errors", lambda *_given: {"holding": np.zeros(3)}, "errors returned shape (3,)"),
        ("start", raises, "Follow.start raised KeyError"),
        ("check", raises, f"{AT}: Follow.check raised KeyError"),
        ("__init__", makes_nothing, "does not call super().__init__(job, scene)"),
    ],
)
def test_a_broken_skill_is_named(
    method: str,
    own: Any,
    sentence: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: Any,
) -> None:
    monkeypatch.setattr(Follow, method, own)
    path = saved(tmp_path, [transit(15, 0)])
    assert command(monkeypatch, path, "--runs", 2, "--mcap", 0) == 2
    told = " ".join(capsys.readouterr().err.split())
    assert sentence in told and "mend the skill" in told and "Traceback" not in told


def test_one_truth_value_holds_for_all_runs(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(output, "track_svg", lambda _done: "<svg/>")
    monkeypatch.setattr(Follow, "failed", lambda *_given: False)
    done = simulate(SimulationSettings(saved(tmp_path, [transit(3, 0)]), runs=2, mcap=0))
    assert all(one.success for one in done.results)


def test_two_runs_into_one_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(output, "track_svg", lambda _done: "<svg/>")
    settings = SimulationSettings(saved(tmp_path, SHORT), runs=1, mcap=0, overwrite=True)
    refused: list[str] = []

    def report(_label: str, _done: int, _total: int) -> None:
        with pytest.raises(PlannerError) as second:
            simulate(settings)
        refused.append(str(second.value))

    assert simulate(settings, report).results[0].success
    assert refused and all("a simulation runs there" in one for one in refused)
    assert (settings.folder / "results.json").exists()
