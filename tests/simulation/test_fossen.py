"""The MuJoCo simulator beside the fast one, with which it shares no equation."""

from __future__ import annotations

import sys

import numpy as np
import pytest

from planner_ft.document.vehicle import load_vehicle
from planner_ft.simulation.fast import (
    SIMULATORS,
    STEP,
    Floats,
    Simulator,
    Vessel,
    build_simulator,
    build_vessel,
)
from planner_ft.simulation.scene import Autopilot
from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary import Vocabulary
from tests.documents import DRONE, USV

from .conftest import Run
from .plans import transit


def vessel_of(vocabulary: Vocabulary) -> Vessel:
    return build_vessel(vocabulary, load_vehicle(None, vocabulary).as_json())


@pytest.fixture(scope="module")
def vessel() -> Vessel:
    return vessel_of(USV)


def moved(name: str, vessel: Vessel, seconds: float, current: Floats, thrust: Floats) -> Simulator:
    """A simulator after constant thrusts (B, 2)."""
    made = build_simulator(name, vessel, len(thrust))
    made.reset(np.zeros((len(thrust), 4)))
    for _step in range(round(seconds / STEP)):
        made.step(thrust, current, np.zeros_like(current))
    return made


def commanded(name: str, vessel: Vessel, commands: Floats) -> Floats:
    """Twists (B, 4) a minute after commands (B, 4) to the autopilot."""
    made, pilot = build_simulator(name, vessel, len(commands)), Autopilot(vessel, len(commands))
    made.reset(np.zeros_like(commands))
    still, idle = np.zeros((len(commands), 2)), np.zeros(len(commands), dtype=bool)
    for _step in range(300):
        made.step(pilot(commands, made.twist, STEP, idle), still, still)
    return made.twist


def test_steady_speed_and_turning_are_those_of_the_fast_simulator(vessel: Vessel) -> None:
    surge = [(speed, 0, 0, 0) for speed in (0.5, 1.0, 1.5, 2.0)]
    turns = [(0, 0, 0, rate) for rate in (-0.2, -0.1, 0.1, 0.2)]
    both = [(1.0, 0, 0, 0.1), (1.0, 0, 0, -0.1)]
    commands = np.array([*surge, *turns, *both], dtype=float)
    fast, other = (commanded(name, vessel, commands) for name in SIMULATORS)
    assert other[:4, 0] == pytest.approx(fast[:4, 0], rel=0.05)
    assert other[4:8, 3] == pytest.approx(fast[4:8, 3], rel=0.05)
    assert other[8:, 3] == pytest.approx(fast[8:, 3], rel=0.05)
    assert other[8:, 0] == pytest.approx(fast[8:, 0], rel=0.15)
    # Nothing is shared but parameters: the way there is another.
    assert not np.allclose(other[8:, :2], fast[8:, :2], rtol=1e-3)


def test_full_thrust_gives_the_top_speeds(vessel: Vessel) -> None:
    full = vessel.thrust * np.array([[1.0, 1.0], [-1.0, 1.0]])
    fast, other = (moved(name, vessel, 120, np.zeros((2, 2)), full).twist for name in SIMULATORS)
    assert other[0, 0] == pytest.approx(fast[0, 0], rel=0.02) == vessel.speed
    assert fast[1, 3] == pytest.approx(vessel.turn)
    assert 0.85 * vessel.turn < other[1, 3] < vessel.turn


def test_a_hull_adrift_goes_with_the_current(vessel: Vessel) -> None:
    current = np.array([[0.0, 0.3], [0.0, 0.0]])
    made = moved("mujoco", vessel, 300, current, np.zeros((2, 2)))
    assert made.twist[0, :2] == pytest.approx((0, 0.3), abs=0.02)
    assert made.pose[1] == pytest.approx((0, 0, 0, 0), abs=1e-6)
    assert abs(made.pose[0, 2]) < 0.02


def test_a_pose_of_the_past_is_forgotten_by_a_reset(vessel: Vessel) -> None:
    made = moved("mujoco", vessel, 5, np.zeros((1, 2)), np.array([[60.0, 20.0]]))
    start = np.array([[3.0, -2.0, 0.0, 2.5]])
    made.reset(start)
    assert made.pose == pytest.approx(start) and made.twist == pytest.approx(np.zeros((1, 4)))


@pytest.mark.parametrize("name", SIMULATORS)
def test_a_thrust_that_is_no_number_breaks_its_own_run_alone(name: str, vessel: Vessel) -> None:
    thrust = np.array([[30.0, 30.0], [np.nan, 30.0]])
    made = moved(name, vessel, 20, np.zeros((2, 2)), thrust)
    assert np.isfinite(made.pose[0]).all() and made.pose[0, 0] > 10
    assert not np.isfinite(made.pose[1]).all()


@pytest.mark.parametrize("name", SIMULATORS)
def test_a_run_without_a_finite_state_is_stopped_and_told(
    name: str, run: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    calls = Autopilot.__call__

    def failing(
        self: Autopilot, command: Floats, twist: Floats, seconds: float, idle: Floats
    ) -> Floats:
        made = calls(self, command, twist, seconds, idle)
        made[0] = np.nan if command[0, 0] > 1 else made[0]
        return made

    monkeypatch.setattr(Autopilot, "__call__", failing)
    first, second = run([transit(20, 0)], simulator=name).results
    assert (first.outcome, first.reason) == ("stopped", "the simulator gave no finite state")
    assert second.success and first.energy == first.energy


def test_a_plan_ends_in_both_simulators(run: Run) -> None:
    done = run([transit(20, 5), transit(0, 0)], simulator="mujoco")
    assert all(one.success and (one.waypoint_error or 9) < 1.2 for one in done.results)


def test_what_lacks_or_does_not_fit_is_told(
    vessel: Vessel, monkeypatch: pytest.MonkeyPatch
) -> None:
    with pytest.raises(PlannerError, match="not of free drives; use --simulator fast"):
        build_simulator("mujoco", vessel_of(DRONE), 1)
    monkeypatch.setitem(sys.modules, "mujoco", None)
    with pytest.raises(PlannerError, match=r"not installed; pip install planner_ft\[sim\]"):
        build_simulator("mujoco", vessel, 1)
