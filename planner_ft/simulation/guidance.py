"""Line-of-sight guidance on paths: what all movements share, and going somewhere.

Guidance steers the course over ground to a point ahead on the path (line of sight, Fossen 2021,
chapter 12); the sideslip that wind and current cause is measured and taken off, which is what the
integral of ILOS estimates.
"""

from __future__ import annotations

import math

import numpy as np

from planner_ft.document.clearance import way_round
from planner_ft.document.track import Point
from planner_ft.simulation.fast import Bools, Floats, Runs, turned, wrapped
from planner_ft.simulation.scene import FIX_SIGMA, Pid, Scene
from planner_ft.simulation.skill import Job, Skill

AHEAD = 4.0  # metres that guidance looks ahead on the path
NEAR, DETOUR = 3.0, 24
"""Tolerances within which a planned way is joined, and points of a way to it from farther off."""
SLOW, BRAKE = 0.1, 0.125  # m/s at the goal, and m/s^2 at which the vehicle slows down before it
TANGENT = 1.0  # metres of the path that say its direction
STILL = 0.05  # m/s or rad/s below which the vehicle rests
HEADING = math.radians(3)  # angular error of a reached heading


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


class Movement(Skill):
    """What all movements share."""

    def __init__(self, job: Job, scene: Scene) -> None:
        super().__init__(job, scene)
        self.steering = Steering(scene)
        self.free = scene.vessel.drive == "free"

    def failed(self, runs: Runs) -> Bools:
        return self.scene.lost[runs]

    def toward(self, runs: Runs, velocity: Floats) -> Floats:
        """The command (n, 4) for a velocity over ground (n, 2) in the world's axes."""
        command, yaw = np.zeros((len(runs), 4)), self.scene.yaw[runs]
        speed = np.linalg.norm(velocity, axis=1)
        body = turned(velocity, -yaw)
        ahead, aside = self.scene.twist[runs, 0], self.scene.twist[runs, 1]
        slip = np.where(ahead > 0.3, np.arctan2(aside, np.maximum(ahead, 0.3)), 0.0)
        error = wrapped(np.arctan2(velocity[:, 1], velocity[:, 0]) - yaw - (not self.free) * slip)
        command[:, 3] = self.steering(runs, np.where(speed > STILL, error, 0.0))
        if self.free:
            command[:, :2] = body
        else:
            command[:, 0] = speed * np.clip(np.cos(error), 0, 1) ** 2
        return command


class Follow(Movement):
    """Along a path, with an altitude and a heading at its end where they are stated."""

    def __init__(self, job: Job, scene: Scene) -> None:
        super().__init__(job, scene)
        points = job.points if len(job.points) > 1 else (*job.points, *job.points)
        self.planned = [(float(x), float(y)) for x, y in points]
        self.paths = np.tile(np.array([*points, *[points[-1]] * DETOUR]), (scene.count, 1, 1))
        self.leg = np.zeros(scene.count, dtype=int)
        self.last = np.full(scene.count, len(points) - 2)  # the last leg of each run's path
        self.there = np.zeros(scene.count, dtype=bool)
        self.doubt = float(np.clip(job.tolerance - 3 * FIX_SIGMA, 0, FIX_SIGMA))
        """Metres by which a goal must be nearer than its tolerance, as far as that leaves room."""
        altitude, heading = job.value("altitude"), job.value("heading")
        self.altitude = None if altitude is None else float(altitude)
        self.heading = None if heading is None else math.radians(90 - float(heading))

    def start(self, runs: Runs) -> None:
        super().start(runs)
        for run in runs:
            here = float(self.scene.position[run, 0]), float(self.scene.position[run, 1])
            if math.dist(here, self.planned[0]) >= NEAR * self.job.tolerance:
                self._join(int(run), here)
        self.leg[runs], self.there[runs] = 0, False

    def _join(self, run: int, here: Point) -> None:
        """Begin the way anew from afar, round the structures of the plan."""
        world = self.scene.world
        way = way_round(here, self.planned[1], world.charted, world.allowed)[:DETOUR]
        points = [here, *way, *self.planned[1:]]
        self.last[run] = len(points) - 2
        self.paths[run] = [*points, *[points[-1]] * (self.paths.shape[1] - len(points))]

    def step(self, runs: Runs, command: Floats) -> Floats:
        here = self.scene.position[runs]
        aim, left = self._aim(runs, here)
        to = aim - here
        away = np.linalg.norm(to, axis=1)
        self.there[runs] |= left < self.job.tolerance - self.doubt
        speed = np.minimum(self.job.speed, SLOW + np.sqrt(2 * BRAKE * left))
        made = self.toward(runs, to / np.maximum(away, 1e-6)[:, None] * speed[:, None])
        arrived = self.there[runs]
        made[arrived, :2] = 0.0
        if self.heading is not None:
            error = wrapped(self.heading - self.scene.yaw[runs])
            made[arrived, 3] = self.steering(runs, error)[arrived]
        if self.altitude is not None:
            most = self.scene.vessel.speed / 4
            made[:, 2] = np.clip(self.altitude - self.scene.pose[runs, 2], -most, most)
        return made

    def _aim(self, runs: Runs, here: Floats) -> tuple[Floats, Floats]:
        """The points to steer to (n, 2), and how far (n,) the goals are."""
        paths, legs, last = self.paths[runs], self.leg[runs], self.last[runs]
        index = np.arange(len(runs))
        start, end = paths[index, legs], paths[index, legs + 1]
        way = end - start
        length = np.maximum(np.linalg.norm(way, axis=1), 1e-6)
        unit = way / length[:, None]
        along = ((here - start) * unit).sum(axis=1)
        passed = (legs < last) & (along > length - np.minimum(self.job.tolerance, length / 4))
        self.leg[runs] += passed
        goal = np.linalg.norm(paths[:, -1] - here, axis=1)
        along = np.clip(along, 0, length)
        on, next_on = (self._ahead(paths, legs, along + more) for more in (0.0, TANGENT))
        direction = next_on - on
        step = np.maximum(np.linalg.norm(direction, axis=1), 1e-6)[:, None]
        closing = legs == last
        near = closing & (goal < AHEAD)
        aim = np.where(near[:, None], paths[:, -1], on + direction / step * AHEAD)
        return aim, np.where(closing, goal, np.maximum(goal, AHEAD))

    def _ahead(self, paths: Floats, legs: Runs, along: Floats) -> Floats:
        """Points (n, 2) so many metres along the paths, counted from the start of a leg."""
        lengths = np.linalg.norm(np.diff(paths, axis=1), axis=2)
        ends = np.cumsum(lengths, axis=1)
        index = np.arange(len(paths))
        far = np.minimum(along + ends[index, legs] - lengths[index, legs], ends[:, -1])
        leg = np.minimum((ends < far[:, None] - 1e-9).sum(axis=1), lengths.shape[1] - 1)
        part = 1 - (ends[index, leg] - far) / np.maximum(lengths[index, leg], 1e-9)
        start, end = paths[index, leg], paths[index, leg + 1]
        return np.asarray(start + part[:, None] * (end - start), dtype=float)

    def done(self, runs: Runs) -> Bools:
        done = self.there[runs]
        if self.heading is not None:
            done &= np.abs(wrapped(self.heading - self.scene.yaw[runs])) < HEADING
        if self.altitude is not None:
            done &= np.abs(self.altitude - self.scene.pose[runs, 2]) < self.job.tolerance
        return done

    def errors(self, runs: Runs) -> dict[str, Floats]:
        goal = self.paths[runs, -1]
        return {"waypoint": np.linalg.norm(self.scene.pose[runs, :2] - goal, axis=1)}
