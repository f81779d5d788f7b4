"""What a run came to: errors, violations, energy and data, measured against the truth."""

import math
from collections import Counter, defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, fields
from typing import Any

import numpy as np

from planner_ft.benchmark.statistics import Estimate, bootstrap_mean, wilson
from planner_ft.document.structures import SAME
from planner_ft.simulation.executor import Executor, Running
from planner_ft.simulation.fast import Bools, Floats, Runs
from planner_ft.simulation.scene import Scene
from planner_ft.simulation.skill import Job, Skill, ask
from planner_ft.simulation.world import PILE, Fence, Reach

FASTER = 1.1
"""Times a limit of speed above which it is broken: the autopilot swings over it by up to 8 %."""


@dataclass(frozen=True)
class Ring:
    """The stand-off of a task: distance from a centre, along the axes for a square."""

    center: tuple[float, float]
    radius: float
    square: bool

    def off(self, places: Floats) -> Floats:
        """Metres by which places (n, 2) are off the stand-off."""
        away = np.abs(places - np.array(self.center))
        reach = away.max(axis=1) if self.square else np.linalg.norm(away, axis=1)
        return np.asarray(np.abs(reach - self.radius), dtype=float)

    def holds(self, movement: Job) -> bool:
        """Whether a planned way keeps it: its ends lie on it, but for the way to an arc."""
        arc = movement.motion is not None and movement.motion.kind == "arc"
        points = np.array(movement.points[1 if arc else 0 :], dtype=float).reshape(-1, 2)
        return bool(len(points) and self.off(points).max() < SAME)


@dataclass(frozen=True)
class Bound:
    """A limit of the plan in words, with the area that it keeps to, the seconds that the mission
    may take or the m/s over ground that it may go at; with `tasks` (ids) it holds for those alone,
    and its seconds for each of them.
    """

    text: str
    area: Fence | Reach | None = None
    seconds: float = math.inf
    tasks: frozenset[str] = frozenset()
    speed: float = math.inf

    @property
    def broken(self) -> str:
        """What it means to break it, in words."""
        if self.area is not None:
            return "fence crossed"
        return "speed exceeded" if self.speed < math.inf else "time exceeded"


@dataclass(frozen=True)
class RunResult:
    """One run: metres, seconds, N s; errors are means over what they are measured at, None where
    there is none. `clearance` is the nearest that the vehicle came to a structure's surface.
    """

    run: int
    outcome: str
    reason: str
    steps: int
    seconds: float
    length: float
    waypoint_error: float | None
    holding_error: float | None
    standoff_error: float | None
    fence_violations: int
    clearance_violations: int
    time_violations: int
    speed_violations: int
    clearance: float | None
    energy: float
    charge_left: float
    records: dict[str, int]  # data records by task

    @property
    def success(self) -> bool:
        """Whether every step ended by its own end condition."""
        return self.outcome == "done"


VIOLATIONS = {
    "fence_violations": "fences crossed",
    "clearance_violations": "stand-offs cut",
    "time_violations": "times exceeded",
    "speed_violations": "speeds exceeded",
}
"""Figures that count broken limits, in words."""
METRICS = [one.name for one in fields(RunResult)][3:-2]  # figures of a run that have a mean


@dataclass(eq=False)
class Observer:
    """Watches an executor, which tells it what it has done; every record goes to `noted`."""

    scene: Scene
    bounds: Sequence[Bound]
    rings: Mapping[str, Ring]
    close: frozenset[str]
    kept: Sequence[float]
    tasks: Sequence[str]

    def __post_init__(self) -> None:
        scene, count, structures = self.scene, self.scene.count, self.scene.world.structures
        self.waypoints: list[list[float]] = [[] for _run in range(count)]
        self.holding, self.held, self.standing, self.stood, self.length = np.zeros((5, count))
        self.least = np.full(count, np.inf)
        self.over = np.zeros((count, len(self.bounds)), dtype=bool)
        self.spent: dict[str, Floats] = defaultdict(lambda: np.zeros(count))  # seconds by task
        self.inside = np.zeros((count, len(structures)), dtype=bool)
        self.fence_violations, self.clearance_violations = np.zeros((2, count), dtype=int)
        self.time_violations, self.speed_violations = np.zeros((2, count), dtype=int)
        self.counts = {
            "fence crossed": self.fence_violations,
            "time exceeded": self.time_violations,
            "speed exceeded": self.speed_violations,
        }
        self.records: list[Counter[str]] = [Counter() for _run in range(count)]
        self.reached: dict[str, Bools] = {}  # per task the runs that have come to its stand-off
        self.last = scene.pose[:, :2].copy()
        start = np.linalg.norm(self.last[:, None] - scene.world.piles[None], axis=-1)
        self.allowed = np.minimum(np.array(self.kept), start - PILE) if structures else start

    def noted(self, run: int, line: Mapping[str, Any]) -> None:
        """Count a record."""
        if line["kind"] == "record":
            self.records[run][line["task"]] += 1

    def finished(self, skill: Skill, runs: Runs) -> None:
        """Take the errors at the end of a step."""
        for run, error in zip(runs, ask(skill, "errors", runs).get("waypoint", ()), strict=False):
            self.waypoints[run].append(float(error))

    def observed(self, groups: Sequence[tuple[Running, Runs]], active: Bools) -> None:
        """Take what is measured in a time step."""
        scene, here = self.scene, self.scene.pose[:, :2]
        self.length += np.linalg.norm(here - self.last, axis=1) * active
        self.last = here.copy()
        near = scene.world.nearest(here)
        self.least = np.where(active, np.minimum(self.least, near), self.least)
        for running, runs in groups:
            self._step(running, runs)
            self._watch(running.stage.task, runs)

    def _watch(self, task: str, runs: Runs) -> None:
        """Count the limits that runs have broken since the last time step."""
        scene = self.scene
        self.spent[task][runs] += scene.seconds
        for index, bound in enumerate(self.bounds):
            if bound.tasks and task not in bound.tasks:
                over = np.zeros(len(runs), dtype=bool)
            elif bound.area is not None:
                over = bound.area.outside_by(scene.pose[runs, :2]) > 0
            elif bound.speed < math.inf:
                most = bound.speed * np.where(self.over[runs, index], 1.0, FASTER)
                over = np.linalg.norm(scene.twist[runs, :2], axis=1) > most
            else:
                gone = self.spent[task][runs] if bound.tasks else np.full(len(runs), scene.time)
                over = gone > bound.seconds + scene.seconds / 2
            fresh = over & ~self.over[runs, index]
            self.counts[bound.broken][runs] += fresh
            for run in runs[fresh]:
                self._tell(run, f"{bound.broken}: {bound.text}")
            self.over[runs, index] = over

    def _step(self, running: Running, runs: Runs) -> None:
        stage, scene = running.stage, self.scene
        here, errors = scene.pose[runs, :2], ask(running.movement, "errors", runs)
        held, kept = errors.get("holding"), errors.get("standoff")
        if held is not None:
            self.holding[runs] += held
            self.held[runs] += 1
        ring = self.rings.get(stage.task)
        if ring is not None and (kept is not None or ring.holds(stage.movement)):
            off = ring.off(here) if kept is None else kept
            reached = self.reached.setdefault(stage.task, self.held < 0)
            reached[runs] |= errors.get("flown", off) < stage.movement.tolerance
            self.standing[runs] += off * reached[runs]
            self.stood[runs] += reached[runs]
        if len(scene.world.piles) and stage.task not in self.close:
            away = np.linalg.norm(here[:, None] - scene.world.piles[None], axis=-1)
            close = away < self.allowed[runs]
            fresh = close & ~self.inside[runs]
            self.clearance_violations[runs] += fresh.sum(axis=1)
            self.inside[runs] = close
            for at, number in np.argwhere(fresh):
                near, metres = scene.world.structures[number], f"{away[at, number]:.1f} m"
                text = f"stand-off cut: {metres} from {near.name} instead of {near.standoff:g} m"
                self._tell(runs[at], text)

    def _tell(self, run: int, text: str) -> None:
        """Write a broken limit into the log of a run, with where it truly is."""
        x, y = self.scene.pose[run, :2]
        self.scene.note(int(run), "event", {"text": f"{text}, at [{x:.1f}, {y:.1f}]"})

    def result(self, run: int, executor: Executor) -> RunResult:
        """The result of a run (from 0) so far."""
        scene = self.scene
        steps = int(executor.ended[run]) or scene.steps
        points = self.waypoints[run]
        return RunResult(
            run + 1,
            executor.outcome[run],
            executor.reason[run],
            steps,
            round(steps * scene.seconds, 1),
            round(float(self.length[run]), 1),
            _mean(sum(points), len(points)),
            _mean(self.holding[run], self.held[run]),
            _mean(self.standing[run], self.stood[run]),
            int(self.fence_violations[run]),
            int(self.clearance_violations[run]),
            int(self.time_violations[run]),
            int(self.speed_violations[run]),
            round(float(self.least[run]), 2) if np.isfinite(self.least[run]) else None,
            round(float(scene.energy[run]), 1),
            round(float(scene.charge[run] / scene.vessel.capacity), 3),
            {task: self.records[run][task] for task in self.tasks},
        )


def broken(results: Sequence[RunResult]) -> str:
    """The limits that runs broke, in words, such as "fences crossed 2"; empty for none."""
    totals = {
        words: sum(getattr(one, name) for one in results) for name, words in VIOLATIONS.items()
    }
    return ", ".join(f"{words} {total}" for words, total in totals.items() if total)


def summary(results: Sequence[RunResult], seed: int) -> dict[str, Estimate]:
    """Success (Wilson) and the means over runs (bootstrap) with their 95 % intervals."""
    found = {"success": wilson(sum(one.success for one in results), len(results))}
    for name in METRICS:
        values = [asdict(one)[name] for one in results]
        known = [float(value) for value in values if value is not None]
        found[name] = bootstrap_mean(known, range(len(known)), seed) if known else Estimate(None)
    return found


def _mean(total: float, count: float) -> float | None:
    return round(float(total / count), 3) if count else None
