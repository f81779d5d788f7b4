"""Simulating plans: approval, files, faults, what is refused, and a run that is killed."""

from __future__ import annotations

import contextlib
import json
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from mcap.exceptions import McapError
from mcap.stream_reader import StreamReader

from planner_ft.cli import main
from planner_ft.document import read_document, write_document
from planner_ft.review import log_beside, reject
from planner_ft.simulation import output
from planner_ft.simulation.asked import read_faults
from planner_ft.simulation.executor import Executor
from planner_ft.simulation.run import Simulated, SimulationSettings, simulate
from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary import load_vocabulary
from planner_ft.vocabulary.definition import BUNDLED
from tests.documents import DRONE, document, step, task

from .conftest import Run
from .plans import go, lines, saved, transit, using

SHORT = [transit(10, 0), transit(0, 0)]
FENCE = "The vehicle stays inside [{0}, -50], [90, -50], [90, 50], [{0}, 50]."


def settings(path: Path, **more: Any) -> SimulationSettings:
    return SimulationSettings(path, **{"runs": 2, "mcap": 0, **more})


def command(monkeypatch: pytest.MonkeyPatch, *arguments: object) -> int:
    monkeypatch.setattr(sys, "argv", ["plannerft", "simulate", *map(str, arguments)])
    try:
        main()
    except SystemExit as left:
        return int(left.code or 0)
    return 0


def test_everything_is_written(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Any
) -> None:
    look = [("SetStreamRecording", {}), ("CreateMapMarker", {"label": "a|b"})]
    report = task("AutoGenerateReportSummary", {}, [using(step("StationKeep"), (), look)])
    path = saved(tmp_path, [*SHORT, report], command="Go | there <b>.")
    assert command(monkeypatch, path, "--runs", 3, "--mcap", 0) == 0
    assert "3 of 3 runs: done" in capsys.readouterr().out
    folder = tmp_path / "plan.simulation"
    names = {"table.md", "table.csv", "tracks.svg", "report.md", "report.html"}
    names |= {"results.json", "manifest.json", *(f"run-0{run}.jsonl" for run in (1, 2, 3))}
    assert {one.name for one in folder.iterdir()} == names
    results = json.loads((folder / "results.json").read_text())
    assert results["approved"] and results["overall"]["success"]["value"] == 1
    assert results["overall"]["success"]["low"] < 1 and len(results["runs"]) == 3
    errors = [one["waypoint_error"] for one in results["runs"]]
    assert len(set(errors)) == 3 and 0 < max(errors) < 1.5
    assert all(one["energy"] > 0 and one["records"]["t3"] == 2 for one in results["runs"])
    assert "mission 1 (published)" in (folder / "table.md").read_text()
    text = (folder / "report.md").read_text()
    assert "approved by Ada" in text and "label: a\\|b" in text and "&lt;b>" in text
    page = (folder / "report.html").read_text()
    assert (
        "&lt;b&gt;" in page
        and "data:image/svg+xml" in page
        and "http:" not in page.split("<img")[0]
    )
    assert json.loads((folder / "manifest.json").read_text())["inputs"]["plan"]["sha256"]


def test_a_published_mission_stands_beside_its_figures(run: Run) -> None:
    from planner_ft.simulation.output import table

    found = "Find Durius and collect data near the J-tubes. Summarize it, then come back."
    columns = table(run(SHORT, how={"command": found})).columns
    assert list(columns) == ["fast", "mission 2 (published)", "2 + survey (published)"]


def test_a_seed_gives_the_same_runs(run: Run) -> None:
    results = [run(SHORT, seed=seed).results for seed in (1, 1, 2)]
    assert results[0] == results[1] != results[2]


def test_starts_are_taken_in_turn(run: Run) -> None:
    done = run(SHORT, starts=((5.0, 5.0), (-5.0, -5.0)), runs=3)
    assert [track[0][0] > 0 for track in done.tracks] == [True, False, True]


def test_a_plan_without_approval_is_refused_or_a_marked_draft(tmp_path: Path) -> None:
    path = tmp_path / "plan.json"
    write_document(path, document(SHORT))
    with pytest.raises(PlannerError, match=r"not approved.*plannerft review.*--draft"):
        simulate(settings(path))
    assert not (tmp_path / "plan.simulation").exists()
    done = simulate(settings(path, draft=True))
    for name in ("table.md", "report.md", "report.html", "results.json", "manifest.json"):
        assert "DRAFT - NOT APPROVED" in (done.settings.folder / name).read_text()
    reject(read_document(path), log_beside(path), "Ada", "no")
    with pytest.raises(PlannerError, match="rejected by Ada"):
        simulate(settings(path))


def test_ros_logs_need_their_extra(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "mcap_ros2", None)
    path = saved(tmp_path, SHORT)
    with pytest.raises(PlannerError, match=r"planner_ft\[sim\], or give --mcap 0"):
        simulate(settings(path, mcap=1))
    assert not (tmp_path / "plan.simulation").exists()


HOVER = task("HoverWatch", {"duration": 5}, [step("Hover", {"time": 5})])


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("[skill.Hover]\nimplementation = 'none'", r"implementation = 'none' is not installed"),
        ("[skill.Hover]\nmeasure = 'smell'", r"\[skill.Hover\]: measure = 'smell' must be one of"),
        ("[skill.Swim]", "is no skill of inspection_drone"),
        ("[vessel]\nwheels = 4", "has no key 'wheels'"),
        ("[vessel]\nspeed = -1", "speed = -1 must be above 0"),
        ("[vessel]\ndrag = 3", "drag must be three numbers"),
        ("[skill]\nHover = 3", "skill.Hover: 3 is not of type 'object'"),
        ("[vessel]\ndrive = 'sail'", "must be differential or free"),
        ("[sails]", r"unknown table \[sails\]"),
    ],
)
def test_a_wrong_simulation_file_is_refused(tmp_path: Path, content: str, message: str) -> None:
    vocabulary = vehicle_of_ones_own(tmp_path)
    vocabulary.with_suffix(".simulation.toml").write_text(content)
    path = saved(tmp_path, [HOVER], load_vocabulary(vocabulary))
    with pytest.raises(PlannerError, match=message):
        simulate(settings(path, vocabulary=str(vocabulary)))
    assert not (tmp_path / "plan.simulation").exists()


def test_a_vehicle_without_a_simulation_file_flies_by_its_profile(tmp_path: Path) -> None:
    vocabulary = vehicle_of_ones_own(tmp_path)
    look = using(step("Hover", {"time": 5}), (), [("TakePhoto", {"note": "x"})])
    path = saved(tmp_path, [{**HOVER, "skill_sequence": [look]}], load_vocabulary(vocabulary))
    done = simulate(settings(path, vocabulary=str(vocabulary)))
    assert all(one.success and one.records == {"t1": 1} for one in done.results)
    assert done.scene.vessel.drive == "free" and done.scene.vessel.speed == 7.5


def vehicle_of_ones_own(folder: Path) -> Path:
    """The drone's files but for that of the simulation."""
    for name in ("", ".motion", ".vehicle"):
        shutil.copy(BUNDLED / f"inspection_drone{name}.toml", folder / f"mine{name}.toml")
    return folder / "mine.toml"


def test_a_drone_has_no_port_thruster(tmp_path: Path) -> None:
    path = saved(tmp_path, [HOVER], DRONE)
    with pytest.raises(PlannerError, match="has no port and starboard thrusters"):
        simulate(settings(path, faults=read_faults(["port=0.5"])))


KILL = """
import os, signal, sys
from pathlib import Path
from planner_ft.simulation.run import SimulationSettings, simulate
def report(label, done, total):
    os.kill(os.getpid(), signal.SIGKILL)
simulate(SimulationSettings(Path(sys.argv[1]), runs=2, mcap=1), report)
"""


@pytest.mark.usefixtures("forked")
def test_the_logs_of_a_killed_simulation_can_be_read(tmp_path: Path) -> None:
    path = saved(tmp_path, [transit(80, 0)])
    killed = subprocess.run([sys.executable, "-c", KILL, str(path)], check=False)
    assert killed.returncode == -9
    told = (tmp_path / "plan.simulation" / "run-02.jsonl").read_text().splitlines()
    times = [json.loads(line)["t"] for line in told]
    assert 14 < max(times) <= 20 and len(times) > 14
    kinds = set()
    log = tmp_path / "plan.simulation" / "run-01.mcap"
    # The file ends in the middle: its last record is no footer.
    with open(log, "rb") as stream, contextlib.suppress(McapError):
        for record in StreamReader(stream).records:
            kinds.add(type(record).__name__)
    assert "Message" in kinds and "Footer" not in kinds
    with pytest.raises(PlannerError, match="--overwrite"):
        simulate(settings(path))
    assert simulate(settings(path, overwrite=True)).results[0].success


def test_a_run_is_aborted_at_once(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    going = Executor.step

    def stepping(self: Executor) -> bool:
        if self.scene.time >= 4:
            self.abort(np.array([0]))
        return going(self)

    monkeypatch.setattr(Executor, "step", stepping)
    first, second = run(SHORT).results
    assert (first.outcome, first.reason, first.seconds) == ("stopped", "aborted", 4.0)
    assert second.success


def outcome(done: Simulated) -> tuple[set[str], set[str]]:
    return {one.outcome for one in done.results}, {one.reason for one in done.results}


FAULTY = ("report.md", "report.html", "table.md", "table.csv")
FAR = [transit(60, 0, using(go(60, 0), (), [("GetGPSLocation", {})])), transit(0, 0)]


def test_faults_are_told_and_lead_home_or_stop(run: Run) -> None:
    assert outcome(run(FAR, faults=read_faults(["battery=0.01"]))) == (
        {"returned"},
        {"the battery is low"},
    )
    late = run(FAR, faults=read_faults(["battery=0@5"])).results
    assert [(one.reason, one.seconds) for one in late] == [("the battery is empty", 5.2)] * 2
    lost = run(FAR, faults=read_faults(["gps@10"]))
    assert outcome(lost)[0] == {"stopped"} and "without a GPS fix" in lost.results[0].reason
    texts = [line["text"] for line in lines(lost) if line["kind"] == "event"]
    assert texts == ["fault gps@10 begins"]
    blown = run(FAR, faults=read_faults(["wind=1/90", "battery=0.05@0"]))
    texts = [(line["t"], line["text"]) for line in lines(blown) if line["kind"] == "event"]
    assert texts[:2] == [(0, "fault wind=1/90 begins"), (0, "fault battery=0.05@0 begins")]
    files = {name: (blown.settings.folder / name).read_text() for name in FAULTY}
    assert all("wind=1/90, battery=0.05@0" in text for text in files.values())
    results = json.loads((blown.settings.folder / "results.json").read_text())
    assert results["faults"] == ["wind=1/90", "battery=0.05@0"]
    limit = "The mission takes at most 60 s."
    assert outcome(run(FAR, how={"constraints": [limit]})) == (
        {"returned"},
        {"the time is nearly over"},
    )


def test_a_run_that_ends_on_the_way_home_says_why_it_turned(run: Run) -> None:
    limit = {"constraints": ["The mission takes at most 60 s."]}
    for one in run(FAR, how=limit, faults=read_faults(["battery=0@35"])).results:
        assert one.outcome == "stopped"
        assert one.reason == "the time is nearly over; on the way home: the battery is empty"


def test_wind_and_a_weak_thruster_are_felt(run: Run) -> None:
    plain = run(FAR).results[0]
    weak = run(FAR, faults=read_faults(["port=0.3"])).results[0]
    windy = run(FAR, faults=read_faults(["wind=9/0"])).results[0]
    assert plain.success and weak.success and windy.success
    assert weak.seconds > plain.seconds and windy.energy > 1.3 * plain.energy


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("fog", "there is current, wind"),
        ("current", "numbers are expected"),
        ("current=9", "from 0 to 5"),
        ("gps=1", "takes no value"),
        ("port=0.5/90", "only current and wind have a bearing"),
        ("gps@60-30", "before it ends"),
        ("wind=nan", "from 0 to 40"),
        ("battery=0.5@60-90", "does not come back; leave out -90"),
    ],
)
def test_a_fault_that_is_none_is_refused(text: str, message: str) -> None:
    with pytest.raises(PlannerError, match=message):
        read_faults([text])


def test_violations_of_fences_are_counted(run: Run) -> None:
    fence = FENCE.format(-5)
    inside = run([transit(20, 0), transit(0, 0)], how={"constraints": [fence]})
    assert [one.fence_violations for one in inside.results] == [0, 0]
    close = run(
        [transit(-4.9, 0)],
        how={"constraints": [fence]},
        tolerance=0.3,
        faults=read_faults(["current=0.5/270"]),
    )
    assert sum(one.fence_violations for one in close.results) >= 1
    # Who was carried out and turns home comes home, instead of being kept outside.
    assert {one.outcome for one in close.results} <= {"done", "returned"}
    assert "returned" in {one.outcome for one in close.results}
    assert max(one.seconds for one in close.results) < 120


def test_a_time_to_be_back_is_kept(run: Run) -> None:
    limit = ["The vehicle is back within 60 s."]
    done = run(FAR, how={"constraints": limit})
    assert outcome(done) == ({"returned"}, {"the time is nearly over"})
    assert all(one.seconds < 60 and not one.time_violations for one in done.results)
    # A current that the way home goes against.
    late = run(FAR, how={"constraints": limit}, faults=read_faults(["current=1/90"]))
    assert [one.time_violations for one in late.results] == [1, 1]


def test_a_distance_from_home_is_watched(run: Run) -> None:
    for metres, times in ((20, 1), (30, 0)):
        limit = f"The vehicle stays within {metres} m of home."
        done = run([transit(29.8, 0), transit(0, 0)], how={"constraints": [limit]})
        assert [one.fence_violations for one in done.results] == [times, times]
        told = [line["text"] for line in lines(done) if line["kind"] == "event"]
        report = (done.settings.folder / "report.md").read_text()
        words = "limits of the plan broken: fences crossed 1"
        assert [text.split(", at [")[0] for text in told] == [
            f"fence crossed: {limit[:-1]}"
        ] * times
        assert all(text in report for text in told)
        assert (f"done; {words}" in report) == (times == 1)
        line = "2 of 2 runs: done; 2 broke limits of the plan: fences crossed 2"
        assert output.outcome_lines(done.results) == [line if times else "2 of 2 runs: done"]


STAY = task("KeepStation", {"duration": 30}, [using(step("StationKeep", {"time": 30}))])


def test_limits_of_one_task_hold_for_it_alone(run: Run) -> None:
    tasks = [transit(40, 0), STAY, transit(0, 0)]

    def ran(*constraints: str) -> Simulated:
        done = run(tasks, how={"constraints": constraints})
        assert all(one.success for one in done.results)
        return done

    def late(*constraints: str) -> list[int]:
        return [one.time_violations for one in ran(*constraints).results]

    assert late("The mission takes at most 20 s during KeepStation.") == [1, 1]
    assert late("The mission takes at most 40 s during KeepStation.") == [0, 0]
    away = ran("The vehicle stays within 10 m of home during KeepStation.")
    assert [one.fence_violations for one in away.results] == [1, 1]
    slow, free = (
        ran(f"The vehicle goes no faster than 0.5 m/s during {title}.").results[0].seconds
        for title in ("Transit", "KeepStation")
    )
    assert slow > 150 > free


def test_a_speed_that_is_exceeded_is_counted_in_the_tasks_of_its_limit(run: Run) -> None:
    drift = using(step("DriftWithCurrent", {"time": 20}))
    tasks = [transit(5, 0), task("DriftAudit", {"duration": 20}, [drift])]
    for title, times in (("DriftAudit", 1), ("Transit", 0)):
        limit = f"The vehicle goes no faster than 0.6 m/s during {title}."
        how: Any = {"how": {"constraints": [limit]}, "faults": read_faults(["current=1/90@15"])}
        done = run(tasks, **how)
        assert [one.speed_violations for one in done.results] == [times, times]
        told = [line["text"] for line in lines(done) if line["kind"] == "event"]
        exceeded = [text.split(", at [")[0] for text in told if "exceeded" in text]
        assert exceeded == [f"speed exceeded: {limit[:-1]}"] * times
        broken = "2 broke limits of the plan: speeds exceeded 2"
        assert (broken in output.outcome_lines(done.results)[0]) == (times == 1)


def test_a_stand_off_that_is_cut_is_told(run: Run) -> None:
    # The chart is wrong: the buoy truly stands beside the way.
    chart, there = {"chart": {"wreck buoy": (20.0, 60.0)}}, {"wreck buoy": (20.0, 4.0)}
    done = run([transit(40, 0)], how=chart, locations=there)
    assert all(one.success and one.clearance_violations == 1 for one in done.results)
    (told,) = (line["text"] for line in lines(done) if line["kind"] == "event")
    assert told.startswith("stand-off cut: ") and "from wreck buoy instead of 10 m, at [" in told
    assert "; 2 broke limits of the plan: stand-offs cut 2" in output.outcome_lines(done.results)[0]


def test_the_turn_onto_a_circle_cuts_no_stand_off(run: Run) -> None:
    circle = task(
        "PerformOrbit",
        {"center": [60, 0], "radius": 15, "arc": 360},
        [using(step("ArcTurn", {"radius": 15, "delta_yaw": 360}))],
        prompt="Circle the tower at [60, 0] at a stand-off of 15 m.",
    )
    done = run([transit(45, 0), circle])
    assert all(one.success and not one.clearance_violations for one in done.results)
    assert done.staging.least() == [14]
    # A limit is no tolerance.
    for metres, least in ((14.8, 14.3), (15, 14.5)):
        limit = f"The vehicle stays at least {metres} m from [60, 0]."
        assert run([transit(45, 0), circle], how={"constraints": [limit]}).staging.least() == [
            least
        ]
