"""Trainings: a few steps, going on after a kill with the same losses, folders, bad input."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
import torch
from safetensors.torch import load_file

from planner_ft.skills import checkpoint, imitation, tracking
from planner_ft.skills.training import SkillTraining, train_skill
from planner_ft.support.errors import PlannerError

TINY: dict[str, dict[str, Any]] = {
    "goto": {"batch": 4, "steps": 6, "window": 3},
    "hold": {"batch": 4, "steps": 6, "window": 3},
    "survey": {"environments": 4, "options": 3, "updates": 3, "minibatch": 8, "teacher": 1},
    "published": {"environments": 4, "frames": 16, "minibatch": 8, "epochs": 2},
}


class Killed(BaseException):
    """What stops a training for good."""


def quiet(_label: str, _done: int, _total: int) -> None:
    pass


def request(folder: Path, kind: str, **more: Any) -> SkillTraining:
    recipe, skill = ("published", "survey") if kind == "published" else ("ours", kind)
    changes = {"iterations": 4, **TINY[kind]}
    return SkillTraining(skill, folder, recipe, changes=changes, **more)


def losses(folder: Path) -> list[float]:
    lines = (folder / "log.jsonl").read_text(encoding="utf-8").splitlines()
    return [json.loads(line)["loss"] for line in lines]


@pytest.mark.parametrize("kind", list(TINY))
def test_a_killed_training_goes_on_with_the_same_losses(
    kind: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    if kind == "published":
        pytest.importorskip("torchrl")
    monkeypatch.setattr(checkpoint, "EVERY", 2)
    train_skill(request(tmp_path / "whole", kind), quiet)

    def die(_label: str, done: int, _total: int) -> None:
        if done == 3:
            raise Killed

    with pytest.raises(Killed):
        train_skill(request(tmp_path / "cut", kind), die)
    assert not (tmp_path / "cut" / "policy.safetensors").exists()
    train_skill(request(tmp_path / "cut", kind, resume=True), quiet)
    whole = losses(tmp_path / "whole")
    assert len(whole) == 4 and losses(tmp_path / "cut") == whole
    first, second = (load_file(tmp_path / one / "policy.safetensors") for one in ("whole", "cut"))
    assert first and all(torch.equal(value, second[name]) for name, value in first.items())


def test_tracking_learns(tmp_path: Path) -> None:
    settings = tracking.TrackingSettings("hold", iterations=16, batch=16, steps=20, window=20)
    found = tracking.train(settings, tmp_path, False, quiet)["losses"]
    first, last = ([one["loss"] for one in some] for some in (found[:4], found[-4:]))
    assert sum(last) < 0.9 * sum(first)


def test_imitation_learns(tmp_path: Path) -> None:
    from planner_ft.skills.policies import read_policy

    settings = imitation.ImitationSettings(iterations=6, environments=8, options=4, teacher=6)
    tracker: Any = read_policy("goto").module
    found = imitation.train(settings, tracker, tmp_path, False, quiet)["losses"]
    assert found[-1]["loss"] < 0.5 * found[0]["loss"]


def test_the_published_recipe_tries_other_actions_and_learns_from_them() -> None:
    pytest.importorskip("torchrl")
    from tensordict import TensorDict

    from planner_ft.skills.ppo import Learner, PpoSettings

    torch.manual_seed(0)
    learner = Learner(PpoSettings(minibatch=64, epochs=4))
    seen = torch.rand(1, 1, 68).expand(8, 16, 68)
    with torch.no_grad():
        batch = learner.actor(TensorDict({"observation": seen}, [8, 16]))
    assert (batch["action"].flatten(0, 1).std(dim=0) > 0.3).all()
    ends = torch.ones(8, 16, 1, dtype=torch.bool)
    reward = batch["action"][..., :1].clone()
    after = {"observation": seen, "reward": reward, "terminated": ends, "done": ends}
    batch["next"] = TensorDict(after, [8, 16])
    before = learner.surveyor(seen[0, :1])[0, 0].detach()
    for _again in range(3):
        learner.learn(batch.clone(), torch.Generator().manual_seed(0))
    assert learner.surveyor(seen[0, :1])[0, 0] > before + 0.02


@pytest.mark.parametrize(
    ("given", "text"),
    [
        ({"skill": "swim"}, "swim: must be one of goto, hold, survey"),
        ({"skill": "survey", "recipe": "best"}, "--recipe best: must be one of ours, published"),
        ({"skill": "goto", "sampling": "l3"}, "--sampling: is of"),
        ({"skill": "survey", "without": "fun"}, "--without fun: must be one of standoff"),
    ],
)
def test_unknown_words_are_refused(given: dict[str, Any], text: str, tmp_path: Path) -> None:
    with pytest.raises(PlannerError, match=text):
        SkillTraining(out=tmp_path, **given)


def test_folders_are_not_overwritten(tmp_path: Path) -> None:
    train_skill(request(tmp_path, "goto"), quiet)
    with pytest.raises(PlannerError, match="holds a training; give --resume"):
        train_skill(request(tmp_path, "goto"), quiet)
    other = request(tmp_path, "goto", resume=True, seed=4)
    with pytest.raises(PlannerError, match="was made with another seed"):
        train_skill(other, quiet)
    train_skill(request(tmp_path, "goto", overwrite=True), quiet)
    (tmp_path / "thesis.txt").write_text("mine", encoding="utf-8")
    with pytest.raises(PlannerError, match=r"holds thesis\.txt"):
        train_skill(request(tmp_path, "goto", overwrite=True), quiet)
    changes = {"batch": 0}
    with pytest.raises(PlannerError, match="--batch 0: must be 1 or more"):
        train_skill(SkillTraining("goto", tmp_path / "new", changes=changes), quiet)
