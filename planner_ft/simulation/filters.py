"""Filters: what limits the command of a movement."""

import math

import numpy as np

from planner_ft.document.structures import MARGIN
from planner_ft.simulation.fast import Bools, Floats, Runs, turned, wrapped
from planner_ft.simulation.scene import Scene
from planner_ft.simulation.skill import Job, Skill
from planner_ft.simulation.world import PILE, Fence

BUFFER = 4.0  # metres before a margin in which the vehicle slows down and turns away
CLOSING = 0.4  # m/s by which it may come nearer, for each metre that is left
ASIDE = math.radians(100)  # the bearing at which what is kept away from is held
OVER = 1.0  # metres by which a boundary may be crossed before the filter has failed
SERIOUS = 0.8  # share of a margin below which the filter has failed
BAND, LOST_BOW = math.radians(15), math.radians(45)
"""How far the bow may leave a locked heading for steering, and when the heading is lost."""
PATIENT = 5.0  # seconds for which a failure must hold


class Filter(Skill):
    """What all filters share: a failure that must hold for some time after a good start."""

    def __init__(self, job: Job, scene: Scene) -> None:
        super().__init__(job, scene)
        self.kept, self.bad = np.zeros(scene.count, dtype=bool), np.zeros(scene.count)

    def start(self, runs: Runs) -> None:
        super().start(runs)
        self.kept[runs], self.bad[runs] = False, 0.0

    def watch(self, runs: Runs, good: Bools, bad: Bools) -> None:
        """Note whether the limit is kept, and for how long it was broken since it was kept."""
        self.kept[runs] |= good
        broken = bad & self.kept[runs]
        self.bad[runs] = np.where(broken, self.bad[runs] + self.scene.seconds, 0.0)

    def failed(self, runs: Runs) -> Bools:
        return self.bad[runs] > PATIENT

    def clear(self, runs: Runs, command: Floats, room: Floats, bearing: Floats) -> Floats:
        """The command with no more speed towards `bearing` (n,) in rad from the bow than `room`
        (n,) metres allow, and turned aside.
        """
        made = command.copy()
        close = 1 - np.clip(room / BUFFER, 0, 1)
        near = close > 0
        allowed = np.maximum(0, CLOSING * room)
        if self.scene.vessel.drive == "free":
            toward = np.stack([np.cos(bearing), np.sin(bearing)], axis=1)
            speed = (made[:, :2] * toward).sum(axis=1)
            over = np.where(near & (speed > allowed), speed - allowed, 0.0)
            across = np.stack([toward[:, 1], -toward[:, 0]], axis=1)
            made[:, :2] += over[:, None] * (0.5 * across - toward)
            back = np.where(room < 0, np.minimum(0.5, -room), 0.0)
            made[:, :2] -= back[:, None] * toward
            return made
        astern = made[:, 0] < 0
        ahead = wrapped(np.where(astern, bearing + np.pi, bearing))
        facing = np.abs(ahead) < ASIDE
        most = allowed / np.maximum(np.cos(ahead), 0.05)
        speed = np.where(near & (np.abs(ahead) < np.pi / 2), most, np.inf)
        made[:, 0] = np.clip(made[:, 0], -speed, speed)
        side = np.where(ahead >= 0, -1.0, 1.0)
        turn = side * np.minimum(self.scene.vessel.turn, 0.9 * (ASIDE - np.abs(ahead)))
        made[:, 3] = np.where(near & facing, (1 - close) * made[:, 3] + close * turn, made[:, 3])
        # Aside of what is too near, the vehicle goes on rather than to stand there for good.
        slow = near & (room < BUFFER / 2) & (np.abs(ahead) > np.pi / 3) & (command[:, 0] >= 0)
        free = np.abs(ahead) >= np.pi / 2 - 0.05
        creep = np.where(free, 0.5, np.minimum(0.5, most))
        made[:, 0] = np.where(slow, np.maximum(made[:, 0], creep), made[:, 0])
        return made


class Clearance(Filter):
    """Keeps a distance from what the LiDAR sees and from the structures of the plan."""

    def __init__(self, job: Job, scene: Scene) -> None:
        super().__init__(job, scene)
        stated = job.value("distance")
        margin = float(stated) if stated is not None else job.margin
        # A plan keeps the distance from the middle of a structure, less what a leg may cut.
        self.margin = max(0.0, margin - PILE - max(MARGIN, 0.005 * margin))
        self.chart = np.array([one.position for one in scene.world.charted]).reshape(-1, 2)

    def step(self, runs: Runs, command: Floats) -> Floats:
        away, bearing = self._nearest(runs)
        room = away - self.margin
        self.watch(runs, room >= 0, away < SERIOUS * self.margin)
        return self.clear(runs, command, room, bearing)

    def _nearest(self, runs: Runs) -> tuple[Floats, Floats]:
        """Distance (n,) and bearing from the bow (n,) of the nearest obstacle."""
        away, bearing = np.full(len(runs), np.inf), np.zeros(len(runs))
        seen = self.scene.ranges(runs)
        if seen.shape[1]:
            ray = seen.argmin(axis=1)
            away = seen[np.arange(len(runs)), ray]
            bearing = wrapped(self.scene.world.ray_angles[ray])
        if len(self.chart):
            to = self.chart[None] - self.scene.position[runs][:, None]
            far = np.linalg.norm(to, axis=-1) - PILE
            which = far.argmin(axis=1)
            index = np.arange(len(runs))
            nearer = far[index, which] < away
            body = turned(to[index, which], -self.scene.yaw[runs])
            bearing = np.where(nearer, np.arctan2(body[:, 1], body[:, 0]), bearing)
            away = np.minimum(far[index, which], away)
        return away, bearing


class Boundary(Filter):
    """Keeps the vehicle inside a polygon: its own, or the fences of the plan."""

    def __init__(self, job: Job, scene: Scene) -> None:
        super().__init__(job, scene)
        corners = job.value("polygon")
        own = [Fence(tuple((float(x), float(y)) for x, y in corners))] if corners else []
        self.fences = own or list(scene.world.fences)

    def step(self, runs: Runs, command: Floats) -> Floats:
        here, yaw = self.scene.position[runs], self.scene.yaw[runs]
        worst = np.full(len(runs), -np.inf)
        for fence in self.fences:
            over = fence.outside_by(here)
            worst = np.maximum(worst, over)
            body = turned(fence.nearest(here) - here, -yaw)
            bearing = np.arctan2(body[:, 1], body[:, 0])
            inside = self.clear(runs, command, -over, bearing)
            back = np.zeros_like(command)
            back[:, 0] = 0.5 * np.clip(np.cos(bearing), 0, 1)
            back[:, 3] = np.clip(0.9 * bearing, -self.scene.vessel.turn, self.scene.vessel.turn)
            kept, out = self.kept[runs][:, None], over[:, None]
            # Who begins outside, such as on the way home, is led in by the movement.
            made = np.where(kept & (out > OVER / 2), back, inside)
            command = np.where(~kept & (out > 0), command, made)
        self.watch(runs, worst <= 0, worst > OVER)
        return command


class Heading(Filter):
    """Keeps the bow where it points once the movement goes straight, within a narrow band."""

    def __init__(self, job: Job, scene: Scene) -> None:
        super().__init__(job, scene)
        self.lock = np.full(scene.count, np.nan)

    def start(self, runs: Runs) -> None:
        super().start(runs)
        self.lock[runs] = np.nan

    def step(self, runs: Runs, command: Floats) -> Floats:
        yaw, most = self.scene.yaw[runs], self.scene.vessel.turn
        fresh = np.isnan(self.lock[runs]) & (np.abs(command[:, 3]) < 0.05)
        self.lock[runs] = np.where(fresh, yaw, self.lock[runs])
        off = np.nan_to_num(wrapped(yaw - self.lock[runs]))
        held = ~np.isnan(self.lock[runs])
        self.watch(runs, held, np.abs(off) > LOST_BOW)
        low = np.where(held, 0.9 * (-BAND - off), -most)
        high = np.where(held, 0.9 * (BAND - off), most)
        made = command.copy()
        made[:, 3] = np.clip(np.clip(command[:, 3], low, high), -most, most)
        return made
