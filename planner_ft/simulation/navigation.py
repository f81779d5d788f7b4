"""Movements that stay: holds, turns on the spot, drifting and waiting."""

from __future__ import annotations

import math

import numpy as np

from planner_ft.simulation.fast import Bools, Floats, Runs, turned, wrapped
from planner_ft.simulation.guidance import HEADING, STILL, Movement
from planner_ft.simulation.scene import Scene
from planner_ft.simulation.skill import Job

STEADY = 3.0  # seconds for which a condition must hold
RADIUS, GRACE = 3.0, 20.0
"""Metres of a watch circle that nobody states, and seconds for which it may be left."""
SETTLE = 10.0  # seconds of a stay that lasts until its perception is done, at least
ASTERN = (math.radians(65), math.radians(100))
"""Errors of the bow above which a hold goes on astern, and begins to."""
TILT = 5.0  # degrees of a threshold that nobody states


class Hold(Movement):
    """Stays at a place, its bow to what it looks at where the plan names that."""

    def __init__(self, job: Job, scene: Scene) -> None:
        super().__init__(job, scene)
        self.waits = job.seconds is None
        stated = job.value("radius")
        self.radius = float(stated) if stated else RADIUS
        self.place, self.away = np.zeros((scene.count, 2)), np.zeros(scene.count)
        self.astern = np.zeros(scene.count, dtype=bool)
        names = [value for value in job.parameters.values() if isinstance(value, str)]
        found = next(filter(None, map(scene.world.find, names)), None)
        self.face = np.array(found[1]) if found else None

    def start(self, runs: Runs) -> None:
        super().start(runs)
        here = self.scene.position[runs]
        planned = np.array(self.job.points[-1]) if self.job.points else here
        near = np.linalg.norm(planned - here, axis=1) <= max(self.radius, 2 * self.job.tolerance)
        self.place[runs] = np.where(near[:, None], planned, here)
        self.away[runs], self.astern[runs] = 0.0, False

    def step(self, runs: Runs, command: Floats) -> Floats:
        yaw, here = self.scene.yaw[runs], self.scene.position[runs]
        to = self.place[runs] - here
        far = np.linalg.norm(to, axis=1)
        self.away[runs] = np.where(far > self.radius, self.away[runs] + self.scene.seconds, 0.0)
        speed = np.minimum(0.35 * far, 0.7 * self.job.speed)
        velocity = to / np.maximum(far, 1e-6)[:, None] * speed[:, None]
        made, body = np.zeros((len(runs), 4)), turned(velocity, -yaw)
        made[:, :2] = body if self.free else body * (1, 0)
        error = np.zeros(len(runs)) if self.free else self._against(runs, velocity)
        if self.face is not None:
            sight = self.face - here
            bearing = wrapped(np.arctan2(sight[:, 1], sight[:, 0]) - yaw)
            error = np.where((far < self.radius / 2) | self.free, bearing, error)
        made[:, 3] = self.steering(runs, error)
        return made

    def _against(self, runs: Runs, velocity: Floats) -> Floats:
        """The error (n,) of the bow, or of the stern where that is nearer, from the way through the
        water that gives a velocity over ground (n, 2).
        """
        water = velocity - self.scene.localiser.drift[runs]
        error = wrapped(np.arctan2(water[:, 1], water[:, 0]) - self.scene.yaw[runs])
        most = np.where(self.astern[runs], ASTERN[0], ASTERN[1])
        self.astern[runs] = np.abs(error) > most
        error = np.where(self.astern[runs], wrapped(error + np.pi), error)
        return np.where(np.linalg.norm(water, axis=1) > STILL / 2, error, 0.0)

    def done(self, runs: Runs) -> Bools:
        seconds = SETTLE if self.job.seconds is None else self.job.seconds
        return np.asarray((self.elapsed(runs) >= seconds) & (self.away[runs] == 0))

    def failed(self, runs: Runs) -> Bools:
        return super().failed(runs) | (self.away[runs] > GRACE)

    def errors(self, runs: Runs) -> dict[str, Floats]:
        away = np.linalg.norm(self.scene.pose[runs, :2] - self.place[runs], axis=1)
        return {"holding": away}


class Turn(Movement):
    """Turns on the spot, to a heading or by an angle."""

    def __init__(self, job: Job, scene: Scene) -> None:
        super().__init__(job, scene)
        self.left, self.last = np.zeros(scene.count), np.zeros(scene.count)

    def start(self, runs: Runs) -> None:
        super().start(runs)
        yaw = self.scene.yaw[runs]
        heading, angle = self.job.value("heading"), self.job.value("angle")
        if heading is not None:
            self.left[runs] = wrapped(math.radians(90 - float(heading)) - yaw)
        else:
            self.left[runs] = -math.radians(float(angle or 0))
        self.last[runs] = yaw

    def step(self, runs: Runs, command: Floats) -> Floats:
        yaw = self.scene.yaw[runs]
        self.left[runs] -= wrapped(yaw - self.last[runs])
        self.last[runs] = yaw
        made = np.zeros((len(runs), 4))
        made[:, 3] = self.steering(runs, self.left[runs])
        return made

    def done(self, runs: Runs) -> Bools:
        still = np.abs(self.scene.twist[runs, 3]) < 2 * STILL
        return np.asarray((np.abs(self.left[runs]) < HEADING) & still)


class Drift(Movement):
    """Goes where wind and current take it; without a time until its perception is done."""

    def __init__(self, job: Job, scene: Scene) -> None:
        super().__init__(job, scene)
        self.waits = job.seconds is None

    def step(self, runs: Runs, command: Floats) -> Floats:
        self.scene.idle[runs] = True
        return np.zeros((len(runs), 4))

    def done(self, runs: Runs) -> Bools:
        seconds = SETTLE if self.job.seconds is None else self.job.seconds
        return np.asarray(self.elapsed(runs) >= seconds)

    def failed(self, runs: Runs) -> Bools:
        near = self.scene.world.nearest(self.scene.pose[runs, :2])
        return np.asarray(near < 2 * self.scene.vessel.length)

    def stop(self, runs: Runs) -> None:
        self.scene.idle[runs] = False


class Wait(Movement):
    """Waits until the vehicle is steady, for its time at most."""

    def __init__(self, job: Job, scene: Scene) -> None:
        super().__init__(job, scene)
        self.calm = np.zeros(scene.count)
        stated = next((job.parameters[key] for key in job.parameters if key == "threshold"), None)
        self.most = float(stated) if stated is not None else TILT

    def step(self, runs: Runs, command: Floats) -> Floats:
        low = np.abs(self.scene.tilt(runs)) < self.most
        self.calm[runs] = np.where(low, self.calm[runs] + self.scene.seconds, 0.0)
        return np.zeros((len(runs), 4))

    def done(self, runs: Runs) -> Bools:
        return np.asarray(self.calm[runs] >= STEADY)

    def failed(self, runs: Runs) -> Bools:
        if self.job.seconds is None:
            return super().failed(runs)
        late = self.elapsed(runs) > max(self.job.seconds, STEADY + 1)
        return super().failed(runs) | (late & ~self.done(runs))
