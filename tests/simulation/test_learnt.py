"""Learnt skills in missions: the slots of a plan, filled either way."""

from __future__ import annotations

import math
import shutil
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely
import torch
from safetensors import safe_open
from safetensors.torch import load_file, save_file

from planner_ft.simulation.asked import read_outlines
from planner_ft.simulation.run import Simulated, SimulationSettings
from planner_ft.skills.mission import LearntSurvey
from planner_ft.skills.policies import SHIPPED
from planner_ft.support.errors import PlannerError
from tests.documents import DRONE, step, task

from .conftest import Run
from .plans import go, lines, transit, using

CORNERS = [(20, 20), (30, 20), (40, 20), (40, 30), (40, 40), (30, 40), (20, 40), (20, 30)]


def broken(folder: Path, skill: str) -> Path:
    """A policy of a skill whose weights are not finite."""
    shutil.copytree(SHIPPED / skill, folder)
    path = folder / "policy.safetensors"
    with safe_open(path, "pt") as stream:
        about = stream.metadata()
    weights = {
        name: torch.full_like(value, float("nan")) for name, value in load_file(path).items()
    }
    save_file(weights, path, about)
    return folder


def survey() -> list[dict[str, Any]]:
    """Round a structure at [30, 30] by waypoints, and home."""
    perception = [("GetGPSLocation", {})]
    steps = [using(step("GoToXY", {"x": x, "y": y}), (), perception) for x, y in CORNERS]
    given = {"target_position": [30, 30], "radius": 10}
    return [task("SurveyTarget", given, steps), transit(0, 0)]


def test_goto_is_learnt_or_guided(run: Run) -> None:
    hold = transit(15, 5, go(15, 5), using(step("StationKeep", {"time": 20})))
    by = {goto: run([hold], goto=goto, runs=4) for goto in ("guidance", "learnt")}
    assert [one.outcome for done in by.values() for one in done.results] == ["done"] * 8
    error = {
        name: np.mean([one.waypoint_error or 9 for one in d.results]) for name, d in by.items()
    }
    assert error["learnt"] < 0.4 < error["guidance"]


def ran(done: Simulated) -> list[str]:
    return [line["skills"][0] for line in done.log if line["kind"] == "step"]


def test_the_slot_of_a_survey_is_filled_by_waypoints_or_the_learnt_skill(run: Run) -> None:
    outlines = read_outlines(["[30, 30]=2.5"])
    by = {}
    for name in ("waypoints", "learnt"):
        by[name] = run(survey(), survey=name, outlines=outlines)
        assert [one.outcome for one in by[name].results] == ["done", "done"], by[name].results
    assert ran(by["waypoints"]) == ["GoToXY"] * 9
    assert ran(by["learnt"]) == ["GoToXY", "SurveyTarget", "GoToXY"]
    assert all(one.records["t1"] > 0 for done in by.values() for one in done.results)
    track = np.array(by["learnt"].tracks[0]) - 30
    angles = np.unwrap(np.arctan2(track[:, 1], track[:, 0]))
    assert angles.max() - angles.min() > 1.5 * math.pi
    assert all((one.standoff_error or 9) < 1.5 for one in by["learnt"].results)


def test_a_stand_off_that_the_policy_does_not_keep_is_told_and_measured(run: Run) -> None:
    told = "SurveyTarget: the policy keeps at most 8 m, the plan asks 9.5 m"  # round a pile
    done = run(survey(), survey="learnt")
    assert [one.outcome for one in done.results] == ["done", "done"]
    assert all(1 < (one.standoff_error or 0) < 2.5 for one in done.results)
    for number in (1, 2):
        assert told in [line["text"] for line in lines(done, number) if line["kind"] == "event"]


def test_a_stand_off_that_rounding_alone_moves_is_not_told() -> None:
    flown = LearntSurvey.__new__(LearntSurvey)
    flown.asked, flown.standoff = 3 - 1e-15, 3.0
    assert not flown.kept
    flown.asked = 1.75
    assert flown.kept == "the policy keeps at least 3 m, the plan asks 1.8 m"


@pytest.mark.parametrize("slot", ["goto", "survey"])
def test_a_policy_that_gives_nan_stops_the_run(slot: str, run: Run, tmp_path: Path) -> None:
    folder = broken(tmp_path / "nan", slot)
    done = run(survey(), **{slot: str(folder)})
    skill = {"goto": "GoToXY", "survey": "SurveyTarget"}[slot]
    assert [one.outcome for one in done.results] == ["stopped", "stopped"]
    assert all(one.reason.startswith(f"{skill}: its command is not finite") for one in done.results)


def test_what_cannot_fill_a_slot_is_refused_before_anything_is_written(
    run: Run, tmp_path: Path
) -> None:
    with pytest.raises(PlannerError, match="is a policy of hold, not of goto; give one of goto"):
        run(survey(), goto=str(SHIPPED / "hold"))
    with pytest.raises(PlannerError, match="is a policy of goto, not of survey"):
        run(survey(), survey=str(SHIPPED / "goto"))
    with pytest.raises(PlannerError, match="--survey maybe: must be waypoints, learnt, or"):
        SimulationSettings(tmp_path / "plan.json", survey="maybe")
    moves = [using(step("FlyToXY", {"x": 20, "y": 5, "altitude": 12}))]
    with pytest.raises(PlannerError, match="--goto learnt: inspection_drone has no learnt skill"):
        run([task("FlyToPoint", {"target_position": [20, 5]}, moves)], DRONE, goto="learnt")
    assert not (tmp_path / "plan.simulation").exists()


def test_outlines_are_read_and_seen() -> None:
    found = read_outlines(["Durius=2.5", "dock=16x4", "pier=L8x8", "jetty=T10x8"])
    areas = {name: shapely.Polygon(corners).area for name, corners in found.items()}
    assert areas["dock"] == 64 and areas["pier"] == 39 and areas["jetty"] == 45
    assert areas["Durius"] == pytest.approx(math.pi * 2.5**2, rel=0.01)
    assert all(shapely.Polygon(corners).exterior.is_ccw for corners in found.values())
    for wrong in (
        "Durius",
        "=3",
        "Durius=x",
        "Durius=-1",
        "Durius=1x2x3",
        "Durius=L4",
        "Durius=900",
    ):
        with pytest.raises(PlannerError, match="--outline"):
            read_outlines([wrong])
