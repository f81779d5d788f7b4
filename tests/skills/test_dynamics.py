"""The batched vessel is the vessel of missions."""

from __future__ import annotations

import numpy as np
import pytest
import torch

from planner_ft.simulation.fast import FastSimulator
from planner_ft.simulation.scene import Autopilot
from planner_ft.skills.dynamics import Dynamics, published_vessel

COUNT = 16


def test_it_moves_as_the_simulator_of_missions() -> None:
    own, random = published_vessel(), np.random.default_rng(0)
    assert (own.speed, own.turn) == (2.3, pytest.approx(0.43))
    simulator, autopilot = FastSimulator(own, COUNT), Autopilot(own, COUNT)
    pose = np.zeros((COUNT, 4))
    pose[:, 3] = random.uniform(-3, 3, COUNT)
    simulator.reset(pose)
    current, still = random.normal(0, 0.1, (COUNT, 2)), np.zeros((COUNT, 2))
    dynamics = Dynamics(own)
    state = torch.zeros(COUNT, 8, dtype=torch.float64)
    state[:, :3] = torch.tensor(pose[:, [0, 1, 3]])
    for step in range(120):
        if step % 20 == 0:
            command = np.zeros((COUNT, 4))
            command[:, 0] = random.uniform(-2.3, 2.3, COUNT)
            command[:, 3] = random.uniform(-0.43, 0.43, COUNT)
        thrust = autopilot(command, simulator.twist, 0.2, np.zeros(COUNT, dtype=bool))
        simulator.step(thrust, current, still)
        state = dynamics(state, torch.tensor(command[:, [0, 3]]), torch.tensor(current))
    assert np.abs(simulator.pose[:, :2]).max() > 5
    assert np.allclose(state[:, :3], simulator.pose[:, [0, 1, 3]], atol=1e-9)
    assert np.allclose(state[:, 3:6], simulator.twist[:, [0, 1, 3]], atol=1e-9)


def test_a_leak_changes_gradients_alone() -> None:
    state = torch.zeros(1, 8)
    made = []
    for leak in (False, True):
        command = torch.tensor([[50.0, 0.0]], requires_grad=True)
        new = Dynamics(published_vessel(), leak)(state, command, torch.zeros(1, 2))
        (slope,) = torch.autograd.grad(new[0, 3], command)
        made.append((new.detach(), float(slope[0, 0])))
    assert torch.equal(made[0][0], made[1][0])
    assert made[0][1] == 0 and made[1][1] > 0
