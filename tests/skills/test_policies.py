"""Policy files: what ships works, and what is no policy of the skill is refused."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import pytest
import torch
from safetensors.torch import save_file

from planner_ft.skills.bench import SkillBench, measure
from planner_ft.skills.dynamics import published_vessel
from planner_ft.skills.episodes import play
from planner_ft.skills.geometry import PUBLISHED
from planner_ft.skills.policies import SHIPPED, SKILLS, read_policy
from planner_ft.skills.survey import Task
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import sha256_file


def test_the_shipped_goto_reaches_20_of_20_waypoints_in_twice_the_current() -> None:
    settings = {"implementation": "learnt-goto"}
    arrived, errors, _seconds = measure(SkillBench("goto"), settings, 2.0)
    assert arrived.sum() == 20 == len(arrived)
    assert errors.mean() < 0.6 and errors.max() < 1.3


def test_the_shipped_hold_stays() -> None:
    settings = {"implementation": "learnt-hold"}
    stayed, errors, later = measure(SkillBench("hold"), settings, 2.0)
    assert stayed.all() and errors.mean() < 0.3 and later.mean() < 0.2


def test_the_shipped_survey_goes_round_every_shape() -> None:
    tracker, policy = read_policy("goto").module, read_policy("survey").module
    policy.memory = None  # type: ignore[assignment]
    families = [family for family in PUBLISHED for _each in range(4)]
    found = play(policy.act, tracker, Task(), families, 3)  # type: ignore[arg-type]
    assert sum(one.outcome == "success" for one in found) >= 19
    assert sum(one.error for one in found) / len(found) < 0.6


@pytest.mark.parametrize("skill", SKILLS)
def test_what_ships_has_a_card_and_a_manifest(skill: str) -> None:
    folder = SHIPPED / skill
    manifest = json.loads((folder / "manifest.json").read_text(encoding="utf-8"))
    weights = folder / "policy.safetensors"
    assert manifest["inputs"]["policy"]["sha256"] == sha256_file(weights)
    assert manifest["configuration"]["skill"] == skill and manifest["seed"] is not None
    assert f"skill bench {skill}" in (folder / "README.md").read_text(encoding="utf-8")
    assert weights.stat().st_size < 1_000_000
    read_policy(skill).check(published_vessel())


def test_the_survey_was_trained_with_the_goto_that_ships() -> None:
    manifest = json.loads((SHIPPED / "survey" / "manifest.json").read_text(encoding="utf-8"))
    goto = sha256_file(SHIPPED / "goto" / "policy.safetensors")
    assert manifest["inputs"]["goto"]["sha256"] == goto


def test_other_files_are_refused(tmp_path: Path) -> None:
    with pytest.raises(PlannerError, match="is a policy of goto, not of hold; give one of hold"):
        read_policy("hold", SHIPPED / "goto")
    with pytest.raises(PlannerError, match="is not there; give a folder"):
        read_policy("hold", tmp_path)
    file = tmp_path / "policy.safetensors"
    file.write_bytes(b"no policy")
    with pytest.raises(PlannerError, match="is no policy"):
        read_policy("hold", tmp_path)
    other = tmp_path / "other"
    other.mkdir()
    save_file(
        {"weight": torch.zeros(2)},
        other / "policy.safetensors",
        {"skill": "hold", "recipe": "ours"},
    )
    with pytest.raises(PlannerError, match="its weights do not fit hold"):
        read_policy("hold", other)
    foreign = tmp_path / "foreign"
    foreign.mkdir()
    save_file({"weight": torch.zeros(2)}, foreign / "policy.safetensors")
    with pytest.raises(PlannerError, match="is a policy of no skill of ours"):
        read_policy("hold", foreign)


def test_another_vehicle_is_refused() -> None:
    heavier = replace(published_vessel(), mass=500.0)
    with pytest.raises(PlannerError, match="trained for a vehicle with mass 130, not 500"):
        read_policy("goto").check(heavier)
