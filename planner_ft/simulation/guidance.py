"""Movements: along paths, holds, turns on the spot, drifting and waiting.

Guidance steers the course over ground to a point ahead on the path (line of sight, Fossen 2021,
chapter 12); the sideslip that wind and current cause is measured and taken off, which is what the
integral of ILOS estimates.
"""

import math

import numpy as np

from planner_ft.document.clearance import way_round
from planner_ft.document.track import Point
from planner_ft.simulation.fast import Bools, Floats, Runs, turned, wrapped
from planner_ft.simulation.scene import FIX_SIGMA, Scene, Steering
from planner_ft.simulation.skill import Job, Skill

AHEAD = 4.0  # metres that guidance looks ahead on the path
NEAR, DETOUR = 3.0, 24
"""Tolerances within which a planned way is joined, and points of a way to it from farther off."""
SLOW, BRAKE = 0.1, 0.125  # m/s at the goal, and m/s^2 at which the vehicle slows down before it
TANGENT = 1.0  # metres of the path that say its direction
STILL = 0.05  # m/s or rad/s below which the vehicle rests
HEADING = math.radians(3)  # angular error of a reached heading


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
        return {"holding": np.linalg.norm(self.scene.pose[runs, :2] - self.place[runs], axis=1)}


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
        stated = job.parameters.get("threshold")
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
