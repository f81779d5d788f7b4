"""The task of SurveyTarget: options, ends, rewards, observation, and going on from a snapshot."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import pytest
import torch

from planner_ft.skills.dynamics import Guidance, Tracker
from planner_ft.skills.episodes import contour_follower, oracle, play
from planner_ft.skills.geometry import PUBLISHED
from planner_ft.skills.option import Compiled
from planner_ft.skills.survey import Survey, Task, action_of, waypoint
from planner_ft.skills.surveyor import Memory, Surveyor

GUIDANCE = Guidance(Tracker((2.3, 0.43)))


def world(count: int, task: Task = Task(), families: Sequence[str] | None = None) -> Survey:  # noqa: B008
    random = np.random.default_rng(5)
    return Survey(task, count, GUIDANCE, random, families)  # type: ignore[arg-type]


def test_an_observation_is_what_was_published() -> None:
    one = world(6)
    seen = one.observe()
    assert seen.shape == (6, 68) and seen[:, :64].min() >= 0 and seen[:, :64].max() <= 1
    assert torch.allclose(seen[:, 64], torch.ones(6))
    assert torch.allclose(seen[:, 67], one.standoff / 10)
    away = (one.outline - one.state[:, None, :2]).norm(dim=2).amin(dim=1)
    assert float(away.min()) > 1.9 and float(away.max()) <= 7.01
    assert float(one.standoff.min()) >= 4 and float(one.standoff.max()) <= 7


def test_an_option_ends_at_its_waypoint_or_after_15_steps() -> None:
    one = world(8)
    far, near = torch.ones(8, 2) * torch.tensor([1.0, 0.0]), torch.full((8, 2), -1.0)
    near[:, 1] = 0.0
    one.step(far)
    assert one.time.tolist() == [15.0] * 8 and one.left.tolist() == [0.0] * 8
    for _option in range(6):
        before = one.time
        one.step(near)
    assert (one.time - before < 15).sum() >= 6
    assert torch.equal(one.left, 15 - (one.time - before))


def test_actions_and_waypoints_are_inverse() -> None:
    pose = torch.tensor([[3.0, -2.0, 0.7], [0.0, 0.0, -2.5]])
    action = torch.tensor([[0.3, -0.8], [-1.0, 1.0]])
    assert torch.allclose(action_of(waypoint(action, pose), pose), action, atol=1e-5)


def test_ends_and_rewards() -> None:
    one = world(4, Task(current=(0.0, 0.0)), ["circle"] * 4)
    one.standoff[:] = 5.0
    radius = (one.outline[0] - one.outline[0].mean(dim=0)).norm(dim=1).mean()
    center = one.outline.mean(dim=1)
    size = (one.outline[:, 0] - center).norm(dim=1)
    assert float(radius) > 2.9
    one.state[:] = 0.0
    offset = torch.tensor([size[0] + 5, size[1] + 3, size[2] + 200, size[3] + 5])
    one.state[:, 0], one.state[:, 1] = center[:, 0] + offset, center[:, 1]
    one.state[:, 2] = torch.tensor([np.pi / 2, np.pi, np.pi / 2, np.pi / 2])
    one.index = (one.outline - one.state[:, None, :2]).norm(dim=2).argmin(dim=1)
    one.lap[3] = 149.0
    straight = torch.tensor([[1.0, 0.0]] * 4)
    first = one.step(straight)
    assert first.outcome[0] is None and first.outcome[2] == "lost" and first.outcome[3] == "success"
    assert float(first.reward[2]) == pytest.approx(-3.2, abs=0.01)
    second = one.step(straight)
    collided = [ended for ended in (first, second) if ended.outcome[1] == "collision"]
    assert collided and float(collided[0].reward[1]) <= -10.2 + 1.0 + 0.2
    one.state[0, :3] = torch.tensor(
        [float(center[0, 0] + offset[0]), float(center[0, 1]), np.pi / 2]
    )
    one.index = (one.outline - one.state[:, None, :2]).norm(dim=2).argmin(dim=1)
    on_it = action_of(center + (size + 5)[:, None] * torch.tensor([0.98, 0.199]), one.pose)
    assert float(one.step(on_it).reward[0]) > 3.0


def test_the_oracle_goes_round_every_shape_and_the_follower_too() -> None:
    families = [family for family in PUBLISHED for _each in range(2)]
    for actor, most in ((oracle, 0.3), (contour_follower, 0.8)):
        found = play(actor, GUIDANCE, Task(rounding=1.5), families, 1)  # type: ignore[arg-type]
        assert [one.outcome for one in found] == ["success"] * 10
        assert np.mean([one.error for one in found]) < most
        assert [one.family for one in found] == families


def test_without_a_term_its_reward_is_gone() -> None:
    assert Task().without("standoff").standoff_weight == 0
    assert Task().without("visibility") == Task(visibility_weight=0.0)
    assert Task().without(None) == Task()


def test_a_snapshot_goes_on_as_if_nothing_had_been() -> None:
    one = world(4)
    one.step(torch.zeros(4, 2))
    kept = one.snapshot()
    after = []
    for _again in range(2):
        one.restore({k: v.clone() if isinstance(v, torch.Tensor) else v for k, v in kept.items()})
        one.step(torch.full((4, 2), 0.5))
        one.reset(range(2))
        after.append((one.state.clone(), one.observe()))
    assert torch.equal(after[0][0], after[1][0]) and torch.equal(after[0][1], after[1][1])


def graph(function: Callable[..., Any]) -> Compiled:
    """Compiled as far as the graph that a C++ compiler would get."""
    one = Compiled(function)
    one.fast = torch.compile(function, backend="aot_eager", dynamic=False, fullgraph=True)
    return one


def test_compiled_it_moves_sees_and_rewards_as_before() -> None:
    plain, fast = world(4), world(4)
    graphs = [graph(one) for one in (plain.advance, plain.cast, plain.judge)]
    fast.advance, fast.cast, fast.judge = graphs
    touched = 0
    for turn in range(30):
        action = torch.full((4, 2), 0.3 if turn % 2 else -0.5)
        first, second = (one.step(action) for one in (plain, fast))
        assert first.outcome == second.outcome
        touched += first.outcome.count("collision")
        assert torch.allclose(first.reward, second.reward, atol=1e-3)
        assert torch.allclose(plain.observe(), fast.observe(), atol=1e-3)
        for one in (plain, fast):
            one.reset(torch.nonzero(first.done)[:, 0].tolist())
    assert touched and all(one.works for one in graphs)


def test_what_does_not_compile_runs_as_it_is(monkeypatch: pytest.MonkeyPatch) -> None:
    from torch._dynamo.exc import TorchDynamoException

    def broken(_given: int) -> int:
        raise TorchDynamoException("no compiler")

    one = Compiled(lambda given: given + 1)
    monkeypatch.setattr(one, "fast", broken)
    assert one(2) == 3 and not one.works


def test_memory_shows_past_returns_from_where_the_vehicle_is_now() -> None:
    memory, rows = Memory(2), torch.arange(2)
    scan = torch.full((2, 64), 10.0)
    scan[0, 0] = 6.0  # 6 m ahead of the first vehicle
    fresh = torch.tensor([True, True])
    pose = torch.zeros(2, 3)
    assert float(memory.look(rows, scan, pose, fresh).min()) == 10.0
    moved = torch.tensor([[2.0, 0.0, np.pi / 2], [0.0, 0.0, 0.0]])
    seen = memory.look(rows, torch.full((2, 64), 10.0), moved, ~fresh)
    assert float(seen[0, 48]) == pytest.approx(4.0, abs=1e-4)  # abeam to starboard now
    assert (seen < 10).sum() == 1
    forgotten = memory.look(rows, scan, moved, fresh)
    assert float(forgotten.min()) == 10.0


@pytest.mark.parametrize(("recipe", "width"), [("published", 68), ("ours", 132)])
def test_policies_begin_wide_and_act_within_the_box(recipe: str, width: int) -> None:
    torch.manual_seed(0)
    policy, one = Surveyor(recipe), world(3)
    seen = policy.observe(one)
    assert seen.shape == (3, width)
    _location, spread = policy.spread(seen)
    assert torch.allclose(spread, torch.ones_like(spread), atol=0.35)
    action = policy.act(one)
    assert action.shape == (3, 2) and float(action.abs().max()) <= 1
    assert policy.critic()(seen).shape == (3, 1)
