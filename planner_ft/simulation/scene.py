"""The state that skills of one simulation share: estimates, sensors, the clock and the records; and
what lies between commanded and actual motion: PID autopilot, and where the vehicle believes to be.
"""

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from planner_ft.simulation.fast import Bools, Floats, Runs, Simulator, Vessel, turned
from planner_ft.simulation.world import World
from planner_ft.support.geodesy import Origin

FIX_SIGMA = 0.25  # metres, of a GPS fix along each axis: ASSUMPTION, a receiver with corrections
FIX_EVERY = 1.0  # seconds between two fixes
DRIFT, GUST = 0.05, 1e-5
"""m/s that the water may drift by at the start, and (m/s)^2/s by which that may change: 0.024 m/s
a minute, three times what a tide of 1 m/s changes by.
"""
MOORED = 60.0
"""Seconds for which the vehicle has lain at its start with the receiver on: ASSUMPTION."""
MOST_YAW = 0.7  # share of the thrust that steering may take; going ahead has the rest
LOST = 60.0  # seconds without a fix after which the position counts as lost
WAVE, PERIOD, HEEL = 1.5, 5.0, 4.0
"""Degrees and seconds of the vehicle's rolling, and degrees of heel per m/s^2 in a turn."""

Record = Callable[[int, dict[str, Any]], None]
"""Takes the number of a run (from 0) and one line of its log."""


class Pid:
    """PID over a batch: error (B,) to output (B,). The integral is clamped to `most`, and emptied
    where the error is not `small`.
    """

    def __init__(
        self, runs: int, p: float, i: float, d: float = 0.0, *, most: float, small: float
    ) -> None:
        self.p, self.i, self.d, self.most, self.small = p, i, d, most, small
        self.sum, self.last = np.zeros(runs), np.zeros(runs)

    def __call__(self, error: Floats, seconds: float) -> Floats:
        added = np.clip(self.sum + self.i * seconds * error, -self.most, self.most)
        self.sum = np.where(np.abs(error) < self.small, added, 0.0)
        slope, self.last = (error - self.last) / seconds, error
        return self.p * error + self.sum + self.d * slope


class Autopilot:
    """Forces or thrusts that bring the vehicle to a commanded twist."""

    def __init__(self, vessel: Vessel, runs: int) -> None:
        self.vessel = vessel
        self.speed = [Pid(runs, 1.5, 0.3, most=0.5, small=0.5) for _axis in range(3)]
        self.rate = Pid(runs, 3.0, 1.0, most=0.3, small=0.2)

    def __call__(self, command: Floats, twist: Floats, seconds: float, idle: Bools) -> Floats:
        """Actuators of a simulator for commands and twists (B, 4); none for `idle` runs."""
        own = self.vessel
        drag = (own.drag[0], own.drag[1], own.drag[0])
        ahead, aside, up = (
            own.mass
            * (drag[axis] * command[:, axis] + pid(command[:, axis] - twist[:, axis], seconds))
            for axis, pid in enumerate(self.speed)
        )
        rate = self.rate(command[:, 3] - twist[:, 3], seconds)
        moment = own.inertia * (own.drag[2] * command[:, 3] + rate)
        if own.drive == "free":
            limit = 2 * own.thrust
            forces = [np.clip(force, -limit, limit) for force in (ahead, aside, up)]
            made = np.stack([*forces, np.clip(moment, -limit, limit)], axis=1)
        else:
            steer = np.clip(moment / own.track, -MOST_YAW * own.thrust, MOST_YAW * own.thrust)
            room = own.thrust - np.abs(steer)
            drive = np.clip(ahead / 2, -room, room)
            made = np.stack([drive - steer, drive + steer], axis=1)
        return np.where(idle[:, None], 0.0, made)


class Localiser:
    """Position by GPS and dead reckoning; heading and speed through the water are measured.

    A Kalman filter of `position` (B, 2) and `drift` (B, 2) of the water, the same along both axes;
    `spread` (2, 2) is its covariance. `silent` (B,) are seconds since
    the last fix, `fix` (B, 2) the last fix.
    """

    def __init__(self, place: Floats, generator: np.random.Generator) -> None:
        self.position, self.drift = place.copy(), np.zeros_like(place)
        self.fix, self.silent = place.copy(), np.zeros(len(place))
        self.spread = np.diag([FIX_SIGMA**2, DRIFT**2])
        self.generator = generator

    def settle(self, pose: Floats, current: Floats, seconds: float) -> None:
        """Lie still at `pose` before the start, so that fixes tell how the water moves."""
        every, still = round(FIX_EVERY / seconds), np.zeros((len(pose), 4))
        for step in range(1, round(MOORED / seconds) + 1):
            self.step(pose, still, current, seconds, heard=True, due=step % every == 0)

    def step(
        self, pose: Floats, twist: Floats, current: Floats, seconds: float, heard: bool, due: bool
    ) -> None:
        """Take one step; `heard`: the receiver works, `due`: a fix is due now."""
        through = turned(twist[:, :2], pose[:, 3]) - current
        moving = np.array([[1.0, seconds], [0.0, 1.0]])
        self.spread = moving @ self.spread @ moving.T + np.diag([0.0, GUST * seconds])
        self.position = self.position + seconds * (through + self.drift)
        self.silent += seconds
        if heard and due:
            noise = self.generator.normal(0.0, FIX_SIGMA, self.position.shape)
            self.fix = pose[:, :2] + noise
            error = self.fix - self.position
            gain = self.spread[:, 0] / (self.spread[0, 0] + FIX_SIGMA**2)
            self.spread = self.spread - np.outer(gain, self.spread[0])
            self.position = self.position + gain[0] * error
            self.drift = self.drift + gain[1] * error
            self.silent[:] = 0.0


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
        self.energy = np.zeros(count)  # N s: the integral of all thrust
        self.charge = np.full(count, self._left)
        """N s that the battery has left, hotel load included."""
        self._phase = world.generator.uniform(0, 2 * np.pi, count)
        self._scan: tuple[int, Floats] | None = None

    @property
    def time(self) -> float:
        """Seconds since the start."""
        return self.steps * self.seconds

    @property
    def _left(self) -> float:
        """N s that the battery can hold now: all of it, or the share that a fault leaves."""
        return self.vessel.capacity * self.world.faults.share("battery", self.time)

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
            self._scan = self.steps, self.world.ranges(self.pose, self.time)
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
        self.charge = np.minimum(self.charge, self._left)
        idle = self.idle | ~active | (self.charge <= 0)
        made = self.autopilot(self.command, self.twist, dt, idle)
        if self.vessel.drive == "differential":
            left = np.array([world.faults.share(side, time) for side in ("port", "starboard")])
            made = np.clip(made, -left * self.vessel.thrust, left * self.vessel.thrust)
        before = self.pose.copy()
        self.simulator.step(made, current, wind)
        self.broken |= ~np.isfinite(np.hstack([self.pose, self.twist])).all(axis=1)
        self.pose[self.broken], self.twist[self.broken] = before[self.broken], 0.0
        spent = dt * np.abs(np.nan_to_num(made)[:, :3]).sum(axis=1) * active
        self.energy += spent
        self.charge = np.maximum(0, self.charge - spent - dt * self.vessel.hotel * active)
        self.steps += 1
        heard, due = world.faults.active("gps", self.time), self.steps % round(FIX_EVERY / dt) == 0
        self.localiser.step(self.pose, self.twist, current, dt, not any(heard), due)

    def note(self, run: int, kind: str, values: Mapping[str, Any]) -> None:
        """Write a line into the log of a run."""
        x, y = self.position[run]
        place = {"t": round(self.time, 1), "kind": kind, "at": [round(x, 2), round(y, 2)]}
        self.write(run, {**place, **values})


class Steering:
    """PID on an error of heading or course: rad to rad/s."""

    def __init__(self, scene: Scene) -> None:
        self.pid, self.scene = Pid(scene.count, 0.9, 0.02, 0.1, most=0.05, small=0.2), scene
        self.error = np.zeros(scene.count)

    def __call__(self, runs: Runs, error: Floats) -> Floats:
        self.error[:] = 0.0
        self.error[runs] = error
        most = self.scene.vessel.turn
        return np.clip(self.pid(self.error, self.scene.seconds)[runs], -most, most)
