"""The state that skills of one simulation share: estimates, sensors, the clock and the records."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from planner_ft.simulation.control import FIX_EVERY, Autopilot, Localiser
from planner_ft.simulation.fast import Bools, Floats, Runs, Simulator
from planner_ft.simulation.world import World
from planner_ft.support.geodesy import Origin

LOST = 60.0
"""Seconds without a fix after which the position counts as lost."""
WAVE, PERIOD, HEEL = 1.5, 5.0, 4.0
"""Degrees and seconds of the vehicle's rolling, and degrees of heel per m/s^2 in a turn."""

Record = Callable[[int, dict[str, Any]], None]
"""Takes the number of a run (from 0) and one line of its log."""


class Scene:
    """B vehicles in one world. Skills see estimates (`position`) and their own motion; measures of
    success see the truth (`pose`).
    """

    def __init__(
        self, world: World, simulator: Simulator, starts: Floats, origin: Origin, write: Record
    ) -> None:
        count = len(starts)
        self.world, self.simulator, self.origin, self.write = world, simulator, origin, write
        self.vessel, self.seconds, self.steps = world.vessel, simulator.step_seconds, 0
        simulator.reset(starts)
        self.localiser = Localiser(starts[:, :2], world.generator)
        self.localiser.settle(simulator.pose, world.currents(0.0), self.seconds)
        self.autopilot = Autopilot(world.vessel, count)
        self.command, self.idle = np.zeros((count, 4)), np.zeros(count, dtype=bool)
        self.broken = np.zeros(count, dtype=bool)
        """Runs of which the simulator gave no finite state: they stay where they were."""
        self.actuators = np.zeros((count, 4 if world.vessel.drive == "free" else 2))
        self.energy = np.zeros(count)
        """N s: the integral of all thrust."""
        self.charge = np.full(count, world.vessel.capacity * world.faults.share("battery", 0))
        """N s that the battery has left, hotel load included."""
        self._phase = world.generator.uniform(0, 2 * np.pi, count)
        self._scan: tuple[int, Floats] | None = None

    @property
    def time(self) -> float:
        """Seconds since the start."""
        return self.steps * self.seconds

    @property
    def count(self) -> int:
        return len(self.idle)

    @property
    def pose(self) -> Floats:
        """The true pose (B, 4)."""
        return self.simulator.pose

    @property
    def position(self) -> Floats:
        """Where the vehicles believe to be (B, 2)."""
        return self.localiser.position

    @property
    def yaw(self) -> Floats:
        return self.simulator.pose[:, 3]

    @property
    def twist(self) -> Floats:
        return self.simulator.twist

    @property
    def lost(self) -> Bools:
        """Whether there was no fix for too long (B,)."""
        return self.localiser.silent > LOST

    def ranges(self, runs: Runs) -> Floats:
        """LiDAR ranges (n, rays) of this step."""
        if self._scan is None or self._scan[0] != self.steps:
            everyone = np.arange(self.count)
            self._scan = self.steps, self.world.ranges(self.pose, everyone, self.time)
        return self._scan[1][runs]

    def tilt(self, runs: Runs) -> Floats:
        """Degrees of roll: waves, and heel in a turn."""
        waves = WAVE * np.sin(2 * np.pi * self.time / PERIOD + self._phase[runs])
        return np.asarray(waves + HEEL * self.twist[runs, 0] * self.twist[runs, 3], dtype=float)

    def advance(self, active: Bools) -> None:
        """One step of all vehicles under their commands; those that are not `active` stand still
        in the books: they take no energy and no command.
        """
        world, time, dt = self.world, self.time, self.seconds
        current, wind = world.currents(time), world.winds(time)
        idle = self.idle | ~active | (self.charge <= 0)
        made = self.autopilot(self.command, self.twist, dt, idle)
        if self.vessel.drive == "differential":
            left = np.array([world.faults.share(side, time) for side in ("port", "starboard")])
            made = np.clip(made, -left * self.vessel.thrust, left * self.vessel.thrust)
        self.actuators = made
        before = self.pose.copy()
        self.simulator.step(made, current, wind)
        self.broken |= ~np.isfinite(np.hstack([self.pose, self.twist])).all(axis=1)
        self.pose[self.broken], self.twist[self.broken] = before[self.broken], 0.0
        spent = (
            dt
            * np.abs(np.nan_to_num(made)[:, : 2 if made.shape[1] == 2 else 3]).sum(axis=1)
            * active
        )
        self.energy += spent
        self.charge = np.maximum(0, self.charge - spent - dt * self.vessel.hotel * active)
        self.steps += 1
        every = round(FIX_EVERY / dt)
        heard = not any(world.faults.active("gps", self.time))
        moved = self.pose, self.twist, current
        self.localiser.step(*moved, dt, heard, self.steps % every == 0)

    def note(self, run: int, kind: str, values: Mapping[str, Any]) -> None:
        """Write a line into the log of a run."""
        x, y = self.position[run]
        place = {"t": round(self.time, 1), "kind": kind, "at": [round(x, 2), round(y, 2)]}
        self.write(run, {**place, **values})
