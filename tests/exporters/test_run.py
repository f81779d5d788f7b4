"""Handing a plan over: approval, files, reports; as a library and as `plannerft export PLAN`."""

from __future__ import annotations

import json
import sys
from pathlib import Path

import pytest

from planner_ft.cli import main
from planner_ft.document import read_document, write_document
from planner_ft.exporters import DRAFT, Origin
from planner_ft.exporters.run import (
    PlanExportSettings,
    export_plan,
    loss_lines,
    loss_summary,
    stop_words,
)
from planner_ft.review import approve, log_beside, reject
from planner_ft.support.errors import PlannerError

from .plans import BUOY, DRONE, MAST, built, step, task

ORIGIN = Origin(59.9, 10.7)


@pytest.fixture
def plan(tmp_path: Path) -> Path:
    """An approved plan."""
    path = tmp_path / "plan.json"
    write_document(path, built(MAST))
    approve(read_document(path), log_beside(path), "Ada", ["all"])
    return path


def run(monkeypatch: pytest.MonkeyPatch, *arguments: object) -> int:
    monkeypatch.setattr(sys, "argv", ["plannerft", "export", *map(str, arguments)])
    with pytest.raises(SystemExit) as left:
        main()
    return int(left.value.code or 0)


def test_an_approved_plan_is_written_with_its_report(plan: Path) -> None:
    done = export_plan(PlanExportSettings(plan, ("qgc", "geojson"), ORIGIN))
    assert [one.file.name for one in done] == ["plan.plan", "plan.geojson"]
    written = json.loads(done[0].file.read_text(encoding="utf-8"))
    assert written["planner_ft"]["approval"].startswith("approved by Ada at ")
    report = done[0].report.read_text(encoding="utf-8")
    assert done[0].report.name == "plan.plan.losses.md"
    assert (
        "| t1 | ObstacleAvoidance (step 1); ObstacleAvoidance min\\_distance = 5 (step 1) |"
        in report
    )
    assert DRAFT not in report and "## Lost" in report and "## Carried in another form" in report
    assert "0 lost" in done[1].report.read_text(encoding="utf-8") and "## Lost" not in done[
        1
    ].report.read_text(encoding="utf-8")


def test_a_plan_without_approval_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "plan.json"
    write_document(path, built(MAST))
    with pytest.raises(PlannerError, match=r"not approved.*plannerft review"):
        export_plan(PlanExportSettings(path, ("qgc",), ORIGIN))
    assert [file.name for file in tmp_path.iterdir()] == ["plan.json"]


def test_an_altered_or_rejected_plan_is_refused(plan: Path) -> None:
    approved = plan.read_text(encoding="utf-8")
    plan.write_text(approved.replace('"radius": 25', '"radius": 5'), encoding="utf-8")
    with pytest.raises(PlannerError, match="altered"):
        export_plan(PlanExportSettings(plan, ("qgc",), ORIGIN))
    plan.write_text(approved, encoding="utf-8")
    reject(read_document(plan), log_beside(plan), "Bo", "too close")
    with pytest.raises(PlannerError, match=r"rejected by Bo.*too close"):
        export_plan(PlanExportSettings(plan, ("qgc",), ORIGIN))


def test_the_log_may_lie_elsewhere(plan: Path, tmp_path: Path) -> None:
    with pytest.raises(PlannerError, match="not approved"):
        export_plan(PlanExportSettings(plan, ("qgc",), ORIGIN, log=tmp_path / "other.jsonl"))
    approve(read_document(plan), tmp_path / "other.jsonl", "Cleo", ["all"])
    (done,) = export_plan(
        PlanExportSettings(plan, ("geojson",), ORIGIN, log=tmp_path / "other.jsonl")
    )
    assert "approved by Cleo" in done.file.read_text(encoding="utf-8")


def test_a_draft_is_marked_in_its_name_in_itself_and_in_its_report(tmp_path: Path) -> None:
    path = tmp_path / "plan.json"
    write_document(path, built(MAST))
    for done in export_plan(
        PlanExportSettings(path, ("qgc", "waypoints", "geojson"), ORIGIN, draft=True)
    ):
        assert done.file.name.startswith("plan.DRAFT.")
        assert DRAFT in done.file.read_text(encoding="utf-8") and DRAFT in done.report.read_text(
            encoding="utf-8"
        )


def test_a_draft_is_marked_in_the_name_that_is_given_and_the_place_is_said(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "plan.json"
    write_document(path, built(MAST))
    out = tmp_path / "t.plan"
    arguments = ("--format", "qgc", "--origin=-8.84,41.69", "--draft", "--out", out)
    assert run(monkeypatch, path, *arguments) == 0
    assert not out.exists() and (tmp_path / "t.DRAFT.plan").is_file()
    place = "[0, 0] lies at 8.84° S, 41.69° E."
    assert place in capsys.readouterr().err
    report = (tmp_path / "t.DRAFT.plan.losses.md").read_text(encoding="utf-8")
    assert "8.84° S, 41.69° E" in report


def test_an_origin_that_is_hardly_right_is_asked_about_before_anything_is_written(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "plan.json"
    write_document(path, built(MAST))
    arguments = ("--format", "qgc", "--origin", "0,0", "--draft")
    assert run(monkeypatch, path, *arguments) == 2
    assert "Gulf of Guinea" in capsys.readouterr().err
    assert not list(tmp_path.glob("*.plan"))
    assert run(monkeypatch, path, *arguments, "--origin-is-right") == 0
    assert (tmp_path / "plan.DRAFT.plan").is_file()


@pytest.mark.parametrize("name", ["qgc", "moos"])
def test_losses_begin_with_what_stops_the_mission(name: str, tmp_path: Path) -> None:
    path = tmp_path / "plan.json"
    waits = task("KeepStation", {}, [step("StationKeep")])
    write_document(path, built([MAST[0], waits, MAST[3]]))
    (done,) = export_plan(PlanExportSettings(path, (name,), ORIGIN, draft=True))
    assert next(loss_lines(done.account)).startswith("changed  t2: StationKeep (step 1)")
    assert loss_summary(done.account).startswith("waits for the operator at task 2; ")
    assert stop_words(done.account) == ["waits for the operator at task 2"]
    report = done.report.read_text(encoding="utf-8")
    assert report.index("## Stops or diverts the mission") < report.index("## Lost")


@pytest.mark.parametrize(("name", "held"), [("qgc", '"command": 19'), ("moos", "duration = 300")])
def test_a_hold_by_a_skill_without_a_time_keeps_the_time_of_its_task(
    name: str, held: str, tmp_path: Path
) -> None:
    path = tmp_path / "plan.json"
    looks = task("KeepStation", {"duration": 300}, [step("VisualStationKeep", {"target_id": "b1"})])
    write_document(path, built([MAST[0], looks, MAST[3]]))
    (done,) = export_plan(PlanExportSettings(path, (name,), ORIGIN, draft=True))
    assert held in done.file.read_text(encoding="utf-8")
    assert stop_words(done.account) == []


def test_nothing_is_overwritten_unless_told(plan: Path) -> None:
    (done,) = export_plan(PlanExportSettings(plan, ("waypoints",), ORIGIN))
    with pytest.raises(PlannerError, match="exists; give --overwrite"):
        export_plan(PlanExportSettings(plan, ("waypoints",), ORIGIN))
    done.file.unlink()
    with pytest.raises(PlannerError, match=r"losses\.md: exists"):
        export_plan(PlanExportSettings(plan, ("waypoints",), ORIGIN))
    (again,) = export_plan(PlanExportSettings(plan, ("waypoints",), ORIGIN, overwrite=True))
    assert again.file.is_file()


def test_when_one_format_cannot_take_the_plan_none_is_written(tmp_path: Path) -> None:
    path = tmp_path / "plan.json"
    write_document(path, built(BUOY[1:]))
    with pytest.raises(PlannerError, match="--format qgc: nothing of the plan can be written"):
        export_plan(PlanExportSettings(path, ("geojson", "qgc"), ORIGIN, draft=True))
    assert [file.name for file in tmp_path.iterdir()] == ["plan.json"]


def test_every_format_at_once_for_another_vehicle(tmp_path: Path) -> None:
    path = tmp_path / "flight.json"
    write_document(
        path,
        built(
            [
                task(
                    "FlyToPoint",
                    {"target_position": [9, 9]},
                    [step("FlyToXY", {"x": 9, "y": 9, "altitude": 20})],
                )
            ],
            DRONE,
        ),
    )
    approve(read_document(path), log_beside(path), "Ada", ["all"])
    done = export_plan(PlanExportSettings(path, ("all",), ORIGIN))
    assert {one.format.name for one in done} >= {"qgc", "waypoints", "geojson", "bt", "moos"}


def test_the_command_prints_what_is_lost(
    plan: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    assert (
        run(
            monkeypatch,
            plan,
            "--format",
            "qgc",
            "--origin",
            "-33.9,151.2",
            "--out",
            plan.with_name("boat.plan"),
        )
        == 0
    )
    shown = capsys.readouterr().out
    assert f"{plan.with_name('boat.plan')}: " in shown and "entries carried" in shown
    assert "  lost     t3: LockHeading (step 1) - the autopilot keeps the bow on its way" in shown
    assert "  changed  t2: ArcTurn (step 1)" in shown


@pytest.mark.parametrize("name", ["qgc", "moos"])
def test_a_circle_without_an_angle_is_the_vehicles_own_and_said_to_be(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "plan.json"
    orbit = task(
        "PerformOrbit", {"center": [120, -35], "radius": 25}, [step("ArcTurn", {"radius": 25})]
    )
    write_document(path, built([MAST[0], orbit, MAST[3]]))
    assert run(monkeypatch, path, "--format", name, "--origin", "1,1", "--draft") == 0
    shown = capsys.readouterr().out
    assert "as planned" not in shown and "the plan says no angle" in shown


def test_a_movement_that_is_lost_stands_in_the_first_line(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "plan.json"
    lost = task("PerformOrbit", {"center": [120, -35], "radius": 25}, [step("ArcTurn")])
    write_document(path, built([MAST[0], lost, lost, MAST[3]]))
    assert run(monkeypatch, path, "--format", "qgc", "--origin", "1,1", "--draft") == 0
    assert ".plan: does not move as planned in tasks 2-3; " in capsys.readouterr().out
    report = (tmp_path / "plan.DRAFT.plan.losses.md").read_text(encoding="utf-8")
    assert "\n\ndoes not move as planned in tasks 2-3; " in report
    write_document(path, built(MAST))
    assert (
        run(monkeypatch, path, "--format", "qgc", "--origin", "1,1", "--draft", "--overwrite") == 0
    )
    assert "as planned" not in capsys.readouterr().out


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["{plan}"], "--format: say for which vehicle; there is qgc, waypoints"),
        (["{plan}", "--format", "qgc"], "--format qgc: needs --origin LAT,LON"),
        (["{plan}", "--format", "boat", "--origin", "1,1"], "--format boat: must be one of"),
        (["{plan}", "--format", "qgc", "--origin", "151.2,-33.9"], "latitude comes first"),
        (["{plan}", "--format", "all", "--origin", "1,1", "--out", "x"], "names one file"),
        (["{plan}", "--format", "qgc", "--origin", "1,1", "--out", "{plan}"], "is the plan itself"),
        (["{plan}", "--format", "qgc", "--origin", "1,1", "--out", "{folder}"], "is a folder"),
        (["{plan}", "--format", "qgc", "--merge"], "--merge: exports a model"),
        (["{plan}", "--check-data", "x.jsonl"], "--check-data: exports a model"),
        (["--format", "qgc"], "--format: hands a plan over"),
        (["--candidate", "embedded", "--out", "x", "--draft"], "--draft: hands a plan over"),
        (["--candidate", "embedded"], "--out: a model needs a folder"),
        ([], "nothing to export"),
        (["{folder}/none.json", "--format", "qgc", "--origin", "1,1"], "none.json: no such file"),
    ],
)
def test_a_mistake_is_one_sentence(
    arguments: list[str],
    said: str,
    plan: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    before = sorted(plan.parent.iterdir())
    assert (
        run(
            monkeypatch, *(argument.format(plan=plan, folder=plan.parent) for argument in arguments)
        )
        == 2
    )
    shown = capsys.readouterr()
    assert said in shown.err and shown.err.count("\n") == 1 and not shown.out
    assert sorted(plan.parent.iterdir()) == before


def test_text_of_a_command_cannot_shape_the_report(tmp_path: Path) -> None:
    path = tmp_path / "plan.json"
    odd = task(
        "SearchAndDetect",
        {"target_description": "a | b\n# c \x1b[31m<b>"},
        [step("StationKeep", {"time": 5})],
    )
    write_document(path, built([odd]))
    (done,) = export_plan(PlanExportSettings(path, ("qgc",), ORIGIN, draft=True))
    report = done.report.read_text(encoding="utf-8")
    assert "\x1b" not in report and "a \\| b\\\\n\\# c \\\\u001b\\[31m\\<b\\>" in report
    assert all(line.count(" | ") == 2 for line in report.splitlines() if line.startswith("| t1"))
