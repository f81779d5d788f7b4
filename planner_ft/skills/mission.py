"""Learnt policies as skills of a mission: GoToXY, StationKeep, and once round a structure."""

import math
from pathlib import Path
from typing import Any

import numpy as np
import torch
from torch import Tensor

from planner_ft.simulation.fast import Bools, Floats, Runs, Vessel, wrapped
from planner_ft.simulation.guidance import AHEAD, Follow, Hold, Movement
from planner_ft.simulation.scene import Scene
from planner_ft.simulation.skill import Job
from planner_ft.skills import geometry
from planner_ft.skills.dynamics import aimed
from planner_ft.skills.option import ARRIVED
from planner_ft.skills.policies import Policy, read_policy
from planner_ft.skills.survey import OPTION, observation, waypoint
from planner_ft.skills.surveyor import Memory
from planner_ft.support.errors import PlannerError

SURE = 0.3
"""Metres from a goal at which a way ends, if the vehicle has not begun to leave it before."""
FLOW = 0.03  # m/s of a measured drift below which it says no direction
STANDOFF = (3.0, 8.0)  # metres of a stand-off for which the survey was measured
BLIND = 20.0  # seconds without any return after which a structure counts as lost


def policy_of(job: Job, skill: str) -> Policy:
    """The policy that settings of a job name for a skill, or the one that ships."""
    given = job.settings.get("policy")
    return read_policy(skill, Path(given) if given else None)


class Steered:
    """Commands (n, 4) of a tracking policy for where vehicles believe to be."""

    def __init__(self, policy: Policy, scene: Scene, fastest: float) -> None:
        self.tracker: Any = policy.module
        self.scene, self.fastest = scene, fastest

    def state(self, runs: Runs) -> Tensor:
        scene = self.scene
        made = np.zeros((len(runs), 8))
        made[:, :2], made[:, 2] = scene.position[runs], scene.yaw[runs]
        made[:, 3:6] = scene.twist[runs][:, [0, 1, 3]]
        return torch.as_tensor(made, dtype=torch.float32)

    def __call__(self, runs: Runs, goal: Floats, *, aim: bool) -> Floats:
        """Commands towards goals (n, 3); `aim`: on the way there the heading is the way's."""
        state, to = self.state(runs), torch.as_tensor(goal, dtype=torch.float32)
        command = self.tracker.command(state, aimed(state, to) if aim else to).numpy()
        made = np.zeros((len(runs), 4))
        made[:, 0] = np.clip(command[:, 0], -self.fastest, self.fastest)
        made[:, 3] = command[:, 1]
        return made


class LearntGo(Follow):
    """GoToXY by the learnt policy: to a point ahead on the way (line of sight), then to its end.

    A way ends where the vehicle is nearest to its goal: within the tolerance, and not getting
    nearer. A stated heading is then turned to as guidance does.
    """

    def __init__(self, job: Job, scene: Scene) -> None:
        super().__init__(job, scene)
        self.steer = Steered(policy_of(job, "goto"), scene, job.speed)
        self.before = np.full(scene.count, np.inf)

    @classmethod
    def check(cls, job: Job, vessel: Vessel) -> None:
        policy_of(job, "goto").check(vessel)

    def start(self, runs: Runs) -> None:
        super().start(runs)
        self.before[runs] = np.inf

    def step(self, runs: Runs, command: Floats) -> Floats:
        arrived, here = self.there[runs].copy(), self.scene.position[runs]
        made = super().step(runs, command)
        goal, final = self._goal(runs)
        away = np.linalg.norm(goal[:, :2] - here, axis=1)
        aim = self._aim(runs, here)[0]
        goal[:, :2] = np.where((away > AHEAD)[:, None], aim, goal[:, :2])
        near = final & (away < self.job.tolerance)
        self.there[runs] = arrived | (near & ((away >= self.before[runs]) | (away < SURE)))
        self.before[runs] = np.where(final, away, np.inf)
        learnt = self.steer(runs, goal, aim=True)
        turning = arrived if self.heading is not None else np.zeros(len(runs), dtype=bool)
        return np.where(turning[:, None], made, learnt)

    def _goal(self, runs: Runs) -> tuple[Floats, Bools]:
        """The ways' next points with the bearings of their legs (n, 3); which are the last."""
        paths, legs = self.paths[runs], self.leg[runs]
        index = np.arange(len(runs))
        start, end = paths[index, legs], paths[index, legs + 1]
        way = end - start
        bearing = np.arctan2(way[:, 1], way[:, 0])
        return np.column_stack([end, bearing]), legs >= self.last[runs]


class LearntHold(Hold):
    """StationKeep by the learnt policy, its goal's heading against the drift that is measured.

    Where the bow has to look at something, guidance holds.
    """

    def __init__(self, job: Job, scene: Scene) -> None:
        super().__init__(job, scene)
        self.steer = Steered(policy_of(job, "hold"), scene, scene.vessel.speed)
        self.bearing = np.zeros(scene.count)

    @classmethod
    def check(cls, job: Job, vessel: Vessel) -> None:
        policy_of(job, "hold").check(vessel)

    def start(self, runs: Runs) -> None:
        super().start(runs)
        self.bearing[runs] = self.scene.yaw[runs]

    def step(self, runs: Runs, command: Floats) -> Floats:
        made = super().step(runs, command)
        if self.face is not None:
            return made
        drift = self.scene.localiser.drift[runs]
        against = np.arctan2(-drift[:, 1], -drift[:, 0])
        flows = np.linalg.norm(drift, axis=1) > FLOW
        self.bearing[runs] = np.where(flows, against, self.bearing[runs])
        goal = np.column_stack([self.place[runs], self.bearing[runs]])
        return self.steer(runs, goal, aim=False)


class LearntSurvey(Movement):
    """Once round a structure that nobody knows, at a stand-off from its surface, by LiDAR alone.

    It ends when the vehicle has gone round the target, and fails when no ray returns for long.
    Before the first return it goes to where the target is said to be. The vehicle's position is
    what it believes: a fix that jumps moves what is remembered. A stand-off outside of what the
    policy was measured for is told, and flown at the nearest within.
    """

    def __init__(self, job: Job, scene: Scene) -> None:
        super().__init__(job, scene)
        self.policy: Any = policy_of(job, "survey").module
        self.steer = Steered(read_policy("goto"), scene, job.speed)
        self.memory, count = Memory(scene.count), scene.count
        self.center = np.array(job.center or (0.0, 0.0), dtype=float)
        self.asked = float(job.settings["standoff"])
        self.standoff = float(np.clip(self.asked, *STANDOFF))
        self.goal, self.left = np.zeros((count, 3)), np.zeros(count)
        self.swept, self.bearing = np.zeros(count), np.zeros(count)
        self.seen, self.blind = np.zeros(count, dtype=bool), np.zeros(count)
        self.fresh = np.ones(count, dtype=bool)

    @classmethod
    def check(cls, job: Job, vessel: Vessel) -> None:
        policy_of(job, "survey").check(vessel)
        read_policy("goto").check(vessel)
        if (vessel.rays, vessel.reach) != (geometry.RAYS, geometry.REACH):
            need = f"needs a LiDAR of {geometry.RAYS} rays and {geometry.REACH:g} m"
            raise PlannerError(f"--survey learnt: {need}; use --survey waypoints")

    def start(self, runs: Runs) -> None:
        super().start(runs)
        self.left[runs], self.swept[runs], self.blind[runs] = 0, 0.0, 0.0
        self.seen[runs], self.fresh[runs] = False, True
        self.bearing[runs] = self._bearing(runs)
        for run in map(int, runs) if self.kept else ():
            self.scene.note(run, "event", {"text": f"{self.job.skill}: {self.kept}"})

    @property
    def kept(self) -> str:
        """What it keeps instead of the stand-off that the plan asks for; empty where it does."""
        if abs(self.asked - self.standoff) < 0.05:  # the decimals that are shown
            return ""
        most = "most" if self.asked > self.standoff else "least"
        return f"the policy keeps at {most} {self.standoff:g} m, the plan asks {self.asked:.1f} m"

    def _bearing(self, runs: Runs) -> Floats:
        off = self.scene.position[runs] - self.center
        return np.asarray(np.arctan2(off[:, 1], off[:, 0]))

    def step(self, runs: Runs, command: Floats) -> Floats:
        bearing = self._bearing(runs)
        returns = np.isfinite(self.scene.ranges(runs)).any(axis=1)
        first = returns & ~self.seen[runs]
        self.seen[runs] |= returns
        self.swept[runs] += wrapped(bearing - self.bearing[runs]) * self.seen[runs]
        self.bearing[runs] = bearing
        self.blind[runs] = np.where(returns, 0.0, self.blind[runs] + self.scene.seconds)
        away = np.linalg.norm(self.goal[runs, :2] - self.scene.position[runs], axis=1)
        over = runs[(self.left[runs] <= 0) | (away < ARRIVED) | first]
        if len(over):
            self._choose(over)
        self.left[runs] -= 1
        return self.steer(runs, self.goal[runs], aim=True)

    def _choose(self, runs: Runs) -> None:
        """The next waypoints of runs whose option has ended."""
        state, rows = self.steer.state(runs), torch.as_tensor(runs)
        scan = np.nan_to_num(self.scene.ranges(runs), posinf=geometry.REACH)
        seen = torch.as_tensor(scan, dtype=torch.float32)
        fresh = torch.as_tensor(self.fresh[runs])
        left = torch.as_tensor(self.left[runs], dtype=torch.float32).clamp_min(0)
        standoff = torch.full((len(runs),), self.standoff)
        limits = self.steer.tracker.limits.expand(len(runs), 2)
        now = observation(seen, left, state, standoff, limits)
        if self.policy.recipe == "ours":
            past = self.memory.look(rows, seen, state[:, :3], fresh) / geometry.REACH
            now = torch.cat([now, past], dim=1)
        with torch.no_grad():
            target = waypoint(self.policy(now), state[:, :3]).numpy().astype(float)
        target = np.where(self.seen[runs, None], target, self.center)
        to = target - self.scene.position[runs]
        self.goal[runs] = np.column_stack([target, np.arctan2(to[:, 1], to[:, 0])])
        self.left[runs], self.fresh[runs] = OPTION, False

    def done(self, runs: Runs) -> Bools:
        return np.asarray(np.abs(self.swept[runs]) >= 2 * math.pi)

    def failed(self, runs: Runs) -> Bools:
        lost = self.seen[runs] & (self.blind[runs] > BLIND)
        return np.asarray(super().failed(runs) | lost)

    @property
    def why(self) -> str:
        lost = f"{self.job.skill}: the structure is lost, no ray returns"
        return "; ".join(filter(None, (lost, self.kept)))

    def errors(self, runs: Runs) -> dict[str, Floats]:
        away = self.scene.world.nearest(self.scene.pose[runs, :2])
        return {"standoff": np.abs(away - self.asked), "flown": np.abs(away - self.standoff)}
