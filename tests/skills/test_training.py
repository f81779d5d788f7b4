"""Trainings: a few steps, going on after a kill with the same losses, folders, bad input."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from dataclasses import asdict
from pathlib import Path
from typing import Any

import pytest
import torch
from safetensors.torch import load_file

from planner_ft.skills import imitation, policies, tracking, training
from planner_ft.skills.training import SkillTraining, train_skill
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import sha256_file, write_json

TINY: dict[str, dict[str, Any]] = {
    "goto": {"batch": 4, "steps": 6, "window": 3},
    "hold": {"batch": 4, "steps": 6, "window": 3},
    "survey": {"environments": 4, "options": 3, "updates": 3, "minibatch": 8, "teacher": 1},
    "published": {"environments": 4, "frames": 16, "minibatch": 8, "epochs": 2},
}


class Killed(BaseException):
    """What stops a training for good."""


@pytest.fixture(autouse=True)
def uncompiled() -> Iterator[None]:
    """Compiling takes a minute, and changes no result (test_survey)."""
    with torch.compiler.set_stance("force_eager"):
        yield


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
    monkeypatch.setattr(policies, "EVERY", 2)
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


def test_all_skills_are_trained_and_what_is_done_stays(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    begun: list[SkillTraining] = []

    def train(one: SkillTraining, report: Any) -> None:
        begun.append(one)
        report("training", 1, 2)
        one.out.mkdir(exist_ok=True)
        (one.out / "checkpoint.pt").touch()
        if len(begun) == 2:
            raise Killed
        (one.out / "policy.safetensors").touch()
        inputs = {"goto": {"sha256": sha256_file(tmp_path / "goto" / "policy.safetensors")}}
        about = {"configuration": asdict(one.settings()), "inputs": inputs}
        write_json(one.out / "manifest.json", about)

    said: list[str] = []
    monkeypatch.setattr(training, "train_skill", train)
    settings: dict[str, Any] = {"seed": 3, "overwrite": False}
    with pytest.raises(Killed):
        training.train_all(
            tmp_path, lambda text, _done, _of: said.append(text), resume=False, **settings
        )
    training.train_all(
        tmp_path, lambda text, _done, _of: said.append(text), resume=True, **settings
    )
    assert [one.skill for one in begun] == ["goto", "hold", "hold", "survey"]
    assert begun[-1].goto == tmp_path / "goto" and {one.seed for one in begun} == {3}
    assert said[0] == "goto: training"
    assert [one.resume for one in begun] == [False, False, True, True]
    with pytest.raises(PlannerError, match="exclude each other"):
        training.train_all(tmp_path, quiet, seed=3, resume=True, overwrite=True)
    with pytest.raises(PlannerError, match=r"goto.manifest\.json: was made with another seed"):
        training.train_all(tmp_path, quiet, seed=77, resume=True, overwrite=False)
    (tmp_path / "goto" / "policy.safetensors").write_text("another", encoding="utf-8")
    with pytest.raises(PlannerError, match=r"survey.manifest\.json: was made with another goto"):
        training.train_all(tmp_path, quiet, resume=True, **settings)
    assert len(begun) == 4


@pytest.mark.parametrize("kind", ["survey", "published"])
def test_a_survey_goes_on_with_the_same_goto_alone(kind: str, tmp_path: Path) -> None:
    if kind == "published":
        pytest.importorskip("torchrl")
    train_skill(request(tmp_path / "goto", "goto"), quiet)
    train_skill(request(tmp_path / "survey", kind, goto=tmp_path / "goto"), quiet)
    with pytest.raises(PlannerError, match="was made with another goto; give the same"):
        train_skill(request(tmp_path / "survey", kind, resume=True), quiet)
    state = torch.load(tmp_path / "survey" / "checkpoint.pt", weights_only=True)
    del state["settings"]["goto"]  # as earlier versions wrote it
    torch.save(state, tmp_path / "survey" / "checkpoint.pt")
    train_skill(request(tmp_path / "survey", kind, resume=True), quiet)


def test_tracking_learns(tmp_path: Path) -> None:
    settings = tracking.Settings("hold", iterations=16, batch=16, steps=20, window=20)
    found = tracking.train(settings, tmp_path, False, quiet)["losses"]
    first, last = ([one["loss"] for one in some] for some in (found[:4], found[-4:]))
    assert sum(last) < 0.9 * sum(first)


def test_imitation_learns(tmp_path: Path) -> None:
    from planner_ft.skills.policies import read_policy

    settings = imitation.Settings(iterations=6, environments=8, options=4, teacher=6)
    tracker: Any = read_policy("goto").module
    found = imitation.train(settings, tracker, tmp_path, False, quiet)["losses"]
    assert found[-1]["loss"] < 0.5 * found[0]["loss"]


def learner_of(**changes: Any) -> Any:
    pytest.importorskip("torchrl")
    from planner_ft.skills.ppo import Learner, Settings

    torch.manual_seed(0)
    return Learner(Settings(**changes))


def test_the_published_recipe_tries_other_actions_and_learns_from_them() -> None:
    learner = learner_of(minibatch=64, epochs=4)
    from planner_ft.skills.ppo import Batch

    seen = torch.rand(1, 1, 68).expand(8, 16, 68)
    with torch.no_grad():
        drawn, action = learner.draw(seen, torch.randn(8, 16, 2))
    assert (action.flatten(0, 1).std(dim=0) > 0.3).all()
    ends = torch.ones(8, 16, dtype=torch.bool)
    batch = Batch(seen, drawn, seen, action[..., 0].clone(), ends, ends)
    before = learner.surveyor(seen[0, :1])[0, 0].detach()
    for _again in range(3):
        learner.learn(batch, torch.Generator().manual_seed(0))
    assert learner.surveyor(seen[0, :1])[0, 0] > before + 0.02


def test_the_published_recipes_loss_and_advantages_are_torchrls() -> None:
    learner = learner_of()
    from tensordict import TensorDict
    from tensordict.nn import TensorDictModule
    from torchrl.modules import ProbabilisticActor, TanhNormal, ValueOperator
    from torchrl.objectives import ClipPPOLoss
    from torchrl.objectives.value import GAE

    from planner_ft.skills.ppo import Batch

    spread = TensorDictModule(learner.surveyor.spread, ["observation"], ["loc", "scale"])
    how: dict[str, Any] = {"distribution_class": TanhNormal, "return_log_prob": True}
    actor = ProbabilisticActor(spread, in_keys=["loc", "scale"], **how)
    critic = ValueOperator(learner.critic, in_keys=["observation"])
    settings = {"clip_epsilon": 0.2, "entropy_coeff": 5e-4, "normalize_advantage": True}
    theirs = ClipPPOLoss(actor, critic, **settings)
    seen, after = torch.rand(4, 16, 68), torch.rand(4, 16, 68)
    reward, ends = torch.randn(4, 16), torch.rand(4, 16) < 0.2
    with torch.no_grad():
        drawn, action = learner.draw(seen, torch.randn(4, 16, 2))
    done = ends | (torch.rand(4, 16) < 0.2)
    batch = Batch(seen, drawn, after, reward, ends, done)
    before, advantage, value = learner.judge(batch)
    flags = {"reward": reward[..., None], "terminated": ends[..., None], "done": done[..., None]}
    said = {"observation": seen, "action": action, "action_log_prob": before.view(4, 16)}
    same = TensorDict({**said, "next": {"observation": after, **flags}}, [4, 16])
    GAE(gamma=0.99, lmbda=0.9, value_network=critic)(same)
    assert torch.allclose(same["advantage"].flatten(), advantage, atol=1e-5)
    for module in learner.nets.parameters():
        module.data += 0.04 * torch.randn_like(module)
    flat = same.reshape(-1)
    slope = 2 * (math.log(2) - drawn - torch.nn.functional.softplus(-2 * drawn)).sum(dim=-1)
    flat["action_log_prob"] = before - slope.flatten()
    torch.manual_seed(1)
    noise = torch.normal(torch.zeros(1, 64, 2), torch.ones(1, 64, 2))[0]
    known = seen.flatten(0, 1), drawn.flatten(0, 1), before, advantage, value, noise
    torch.manual_seed(1)
    parts = theirs(flat)
    wanted = sum(part for name, part in parts.items() if name.startswith("loss_"))
    assert float(parts["clip_fraction"]) > 0.05
    assert float(learner.loss(*known).detach()) == pytest.approx(float(wanted.detach()), abs=1e-5)


def test_the_published_recipe_ends_without_a_better_mean_reward(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pytest.importorskip("torchrl")
    from planner_ft.skills import ppo

    rewards = iter([1.0, 3.0, 2.0, 2.5, 2.9, 9.0])

    def collect(*_given: Any) -> tuple[Any, list[str]]:
        seen, flags = torch.zeros(4, 4, 68), torch.zeros(4, 4, dtype=torch.bool)
        reward = torch.full((4, 4), next(rewards))
        return ppo.Batch(seen, torch.zeros(4, 4, 2), seen, reward, flags, flags), []

    monkeypatch.setattr(ppo, "collect", collect)
    changes = {**TINY["published"], "iterations": 9, "patience": 3}
    result = train_skill(SkillTraining("survey", tmp_path, "published", changes=changes), quiet)
    assert result == {"iterations": 5, "best": 2, "reward": 3.0}
    assert len(losses(tmp_path)) == 5


@pytest.mark.parametrize(
    ("given", "text"),
    [
        ({"skill": "swim"}, "swim: must be one of goto, hold, survey"),
        ({"skill": "survey", "recipe": "best"}, "--recipe best: must be one of ours, published"),
        ({"skill": "goto", "sampling": "l3"}, "--sampling: is of"),
        ({"skill": "goto", "seed": 10**20}, "--seed 100000000000000000000: must be from 0 to"),
        ({"skill": "survey", "without": "fun"}, "--without fun: must be one of standoff"),
    ],
)
def test_unknown_words_are_refused(given: dict[str, Any], text: str, tmp_path: Path) -> None:
    with pytest.raises(PlannerError, match=text):
        SkillTraining(out=tmp_path, **given)


@pytest.mark.parametrize("state", [b"\x80garbage", b"", {"settings": 3}, [1], {}])
def test_a_damaged_checkpoint_is_named(state: Any, tmp_path: Path) -> None:
    path = tmp_path / "checkpoint.pt"
    if isinstance(state, bytes):
        path.write_bytes(state)
    else:
        torch.save(state, path)
    with pytest.raises(PlannerError, match=r"checkpoint\.pt: cannot be read as a checkpoint \(\w+"):
        train_skill(request(tmp_path, "goto", resume=True), quiet)


def test_a_loss_that_is_no_number_is_never_kept(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(tracking, "_iterate", lambda *_given: math.nan)
    with pytest.raises(PlannerError, match="the loss of iteration 1 is no number"):
        train_skill(request(tmp_path, "goto"), quiet)
    assert list(tmp_path.iterdir()) == []


def test_more_environments_than_options_are_refused(tmp_path: Path) -> None:
    pytest.importorskip("torchrl")
    changes = {"environments": 8001}
    with pytest.raises(PlannerError, match="--environments 8001: must be at most 8000"):
        train_skill(SkillTraining("survey", tmp_path, "published", changes=changes), quiet)


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
