"""The fast simulator: three degrees of freedom in numpy, all runs at once."""

from __future__ import annotations

from importlib.metadata import EntryPoint
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from planner_ft.simulation.vessel import STEP, Vessel

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]
Runs = NDArray[np.intp]  # numbers of runs, shape (n,)


class Simulator(Protocol):
    """A batch of B vehicles. `pose` (B, 4): x east, y north, z up in metres, yaw in rad
    counter-clockwise from east (REP-103). `twist` (B, 4): surge, sway to port, climb in m/s and yaw
    rate in rad/s, over ground, in the body's axes.
    """

    step_seconds: float
    pose: Floats
    twist: Floats

    def reset(self, pose: Floats) -> None:
        """Put the vehicles at rest at `pose` (B, 4)."""

    def step(self, actuators: Floats, current: Floats, wind: Floats) -> None:
        """Advance one step. `actuators` (B, 2) are port and starboard thrust in N, or (B, 4) forces
        ahead, to port and up in N and a moment in N m; `current` and `wind` (B, 2) in m/s.
        """


def turned(vector: Floats, angle: Floats) -> Floats:
    """Vectors (n, 2) turned counter-clockwise by angles (n,) in rad."""
    cosine, sine = np.cos(angle), np.sin(angle)
    x, y = vector[:, 0], vector[:, 1]
    return np.stack([cosine * x - sine * y, sine * x + cosine * y], axis=1)


def wrapped(angle: Floats) -> Floats:
    """Angles in rad between -pi and pi."""
    return (angle + np.pi) % (2 * np.pi) - np.pi


class FastSimulator:
    """A rigid body in the plane with linear drag against the water (Fossen, Handbook of Marine
    Craft Hydrodynamics and Motion Control, 2021, chapter 6, without added mass).

    Drag is taken implicitly, so that no rate makes a step unstable. A free drive climbs as well,
    with the drag of surge.
    """

    def __init__(self, vessel: Vessel, runs: int) -> None:
        self.vessel, self.step_seconds = vessel, STEP
        self.pose, self.twist = np.zeros((runs, 4)), np.zeros((runs, 4))

    def reset(self, pose: Floats) -> None:
        self.pose, self.twist = pose.astype(float), np.zeros_like(pose, dtype=float)

    def step(self, actuators: Floats, current: Floats, wind: Floats) -> None:
        own, dt, yaw = self.vessel, self.step_seconds, self.pose[:, 3]
        forces = self._forces(actuators)
        ground = turned(self.twist[:, :2], yaw)
        over = wind - ground
        gust = own.windage * np.linalg.norm(over, axis=1, keepdims=True) * over
        forces[:, :2] += turned(gust, -yaw) * (np.linalg.norm(wind, axis=1, keepdims=True) > 0)
        water = turned(current, -yaw)
        surge, sway, climb, rate = self.twist.T
        acceleration = np.stack(
            [
                forces[:, 0] / own.mass + sway * rate + own.drag[0] * water[:, 0],
                forces[:, 1] / own.mass - surge * rate + own.drag[1] * water[:, 1],
                forces[:, 2] / own.mass,
                forces[:, 3] / own.inertia,
            ],
            axis=1,
        )
        drag = np.array([own.drag[0], own.drag[1], own.drag[0], own.drag[2]])
        twist = (np.stack([surge, sway, climb, rate], axis=1) + dt * acceleration) / (1 + dt * drag)
        through = np.hypot(twist[:, 0] - water[:, 0], twist[:, 1] - water[:, 1])
        twist[:, :2] -= water
        twist[:, :2] *= np.minimum(1, own.speed / np.maximum(through, 1e-9))[:, None]
        twist[:, :2] += water
        twist[:, 3] = np.clip(twist[:, 3], -own.turn, own.turn)
        self.twist = twist
        middle = yaw + dt / 2 * twist[:, 3]
        self.pose[:, :2] += dt * turned(twist[:, :2], middle)
        self.pose[:, 2] = np.maximum(0, self.pose[:, 2] + dt * twist[:, 2])
        self.pose[:, 3] = wrapped(yaw + dt * twist[:, 3])

    def _forces(self, actuators: Floats) -> Floats:
        """(B, 4): ahead, to port, up in N, and the moment in N m."""
        if self.vessel.drive == "free":
            return actuators.copy()
        port, starboard = actuators.T
        nothing = np.zeros_like(port)
        moment = (starboard - port) * self.vessel.track / 2
        return np.stack([port + starboard, nothing, nothing, moment], axis=1)


SIMULATORS = {
    "fast": "planner_ft.simulation.fast:FastSimulator",
    "mujoco": "planner_ft.simulation.fossen:FossenSimulator",
}
"""Simulators by the name that --simulator takes."""


def build_simulator(name: str, vessel: Vessel, runs: int) -> Simulator:
    """A simulator of `runs` vehicles. Raises PlannerError where it lacks what it needs."""
    made: Simulator = EntryPoint(name, SIMULATORS[name], "").load()(vessel, runs)
    return made
