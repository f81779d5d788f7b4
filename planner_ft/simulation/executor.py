"""The executor: runs a plan's steps, each skill in closed loop, for all runs at once.

Per step one movement runs with its filters and its perception and data skills, all at the same
time. When its end condition holds, the others are switched off and the next step begins.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np

from planner_ft.simulation.fast import Bools, Runs
from planner_ft.simulation.scene import Scene
from planner_ft.simulation.skill import Job, ask, build

if TYPE_CHECKING:
    from planner_ft.simulation.measures import Observer

RESERVE = 1.3  # how much more than the way home takes is kept of time and battery
AROUND = 10.0  # seconds of the time that turning round and coming to rest take besides
Outcome = Literal["running", "done", "returned", "stopped", "collision"]


@dataclass(frozen=True)
class Stage:
    """A step of the plan ready to run: its skills, its time-out in s, its failure modes."""

    task: str
    step: int
    movement: Job
    filters: tuple[Job, ...]
    sensors: tuple[Job, ...]
    patience: float
    failures: tuple[str, ...]

    @property
    def jobs(self) -> tuple[Job, ...]:
        """All skills, the movement first."""
        return self.movement, *self.filters, *self.sensors


class Running:
    """The skills of a stage, made when the first run comes to it."""

    def __init__(self, stage: Stage, scene: Scene) -> None:
        self.stage = stage
        self.skills = [build(job, scene) for job in stage.jobs]
        self.movement, self.sensors = self.skills[0], self.skills[1 + len(stage.filters) :]
        self.wrong: dict[int, str] = {}
        """The runs in which a skill, such as a learnt policy, gave no finite command."""

    def start(self, runs: Runs) -> None:
        for skill in self.skills:
            ask(skill, "start", runs)

    def step(self, runs: Runs, scene: Scene) -> None:
        command = np.zeros((len(runs), 4))
        for skill in self.skills:
            command = ask(skill, "step", runs, command)
            wrong = ~np.isfinite(command).all(axis=1)
            self.wrong |= {int(run): skill.job.skill for run in runs[wrong]}
            command[wrong] = 0.0
        own = scene.vessel
        fastest = np.maximum(1, np.linalg.norm(command[:, :2], axis=1) / own.speed)
        command[:, :2] /= fastest[:, None]
        command[:, 3] = np.clip(command[:, 3], -own.turn, own.turn)
        scene.command[runs] = command

    def done(self, runs: Runs) -> Bools:
        waiting = self.sensors if self.movement.waits else []
        done = [ask(skill, "done", runs) for skill in (self.movement, *waiting)]
        return np.asarray(np.logical_and.reduce(done))

    def failures(self, runs: Runs) -> dict[int, tuple[str, str]]:
        """(failure mode, sentence) of the runs in which a skill has failed or the step is late."""
        wrong = {run: name for run, name in self.wrong.items() if run in runs}
        found = {run: ("", f"{name}: its command is not finite") for run, name in wrong.items()}
        for skill in self.skills:
            for run in runs[ask(skill, "failed", runs)]:
                found.setdefault(int(run), (skill.job.failure, ask(skill, "why", runs)))
        late = runs[ask(self.movement, "elapsed", runs) > self.stage.patience]
        for run in late:
            waiting, only = self.sensors if self.movement.waits else [], np.array([run])
            silent = next((one for one in waiting if not ask(one, "done", only)[0]), None)
            mode, seconds = self.movement.job.failure, f"{self.stage.patience:.0f} s"
            why = f"{silent.job.skill}: nothing found" if silent else ""
            what = why or ask(self.movement, "why", only)
            found.setdefault(int(run), (mode, f"{what} after {seconds}"))
        return found

    def stop(self, runs: Runs) -> None:
        for skill in self.skills:
            ask(skill, "stop", runs)


class Executor:
    """Carries out stages for all runs of a scene; the last stage is the way home, to which only a
    failure leads. The observer is told when runs end a stage by its end condition, and after each
    time step what ran.
    """

    def __init__(
        self, stages: Sequence[Stage], home: Stage, scene: Scene, observer: Observer, most: float
    ) -> None:
        self.stages, self.scene, self.most = [*stages, home], scene, most
        self.observer = observer
        self.at = np.zeros(scene.count, dtype=int)
        self.outcome: list[Outcome] = ["running"] * scene.count
        self.reason = [""] * scene.count
        self.ended = np.zeros(scene.count)  # steps that each run took
        self.running: dict[int, Running] = {}

    @property
    def active(self) -> Bools:
        return np.array([one == "running" for one in self.outcome])

    def begin(self) -> None:
        """Start every run on the first stage."""
        self._enter(np.arange(self.scene.count), 0)

    def step(self) -> bool:
        """One time step of all runs; whether any still runs."""
        active = self.active
        if not active.any():
            return False
        groups = {int(at): np.flatnonzero(active & (self.at == at)) for at in set(self.at[active])}
        for at, runs in groups.items():
            self.running[at].step(runs, self.scene)
        self.scene.advance(active)
        self.observer.observed([(self.running[at], runs) for at, runs in groups.items()], active)
        for at, runs in groups.items():
            self._judge(at, runs)
        return True

    def abort(self, runs: Runs, reason: str = "aborted") -> None:
        """Stop runs at once."""
        self._end(runs, "stopped", reason)

    def _judge(self, at: int, runs: Runs) -> None:
        """End what is over: steps, and runs that cannot go on."""
        scene, stage, running = self.scene, self.stages[at], self.running[at]
        returning = at == len(self.stages) - 1
        hit = scene.world.nearest(scene.pose[runs, :2]) < scene.vessel.radius
        ends: list[tuple[Bools, Outcome, str]] = [
            (scene.broken[runs], "stopped", "the simulator gave no finite state"),
            (hit, "collision", f"hit a structure during {stage.movement.skill}"),
            (scene.charge[runs] <= 0, "stopped", "the battery is empty"),
        ]
        for which, outcome, reason in ends:
            self._end(runs[which], outcome, reason)
        runs = runs[self.active[runs]]
        failures, done = running.failures(runs), running.done(runs)
        short = {} if returning else self._short(runs)
        for run, is_done in zip(runs.tolist(), done, strict=True):
            if run in failures:
                self._fail(run, at, *failures[run])
            elif run in short and not is_done:
                self._home(run, at, short[run])
        over = runs[(self.at[runs] == at) & self.active[runs] & done]
        if not len(over):
            return
        running.stop(over)
        self.observer.finished(running.movement, over)
        if returning:
            self._end(over, "returned", "")
        elif at + 2 == len(self.stages):
            self._end(over, "done", "")
        else:
            self._enter(over, at + 1)

    def _short(self, runs: Runs) -> dict[int, str]:
        """The runs that must turn back now: time or battery is only enough for the way home."""
        scene = self.scene
        away = np.linalg.norm(scene.position[runs] - np.array(scene.world.home), axis=1)
        seconds = RESERVE * away / scene.vessel.cruise
        late = scene.time + seconds + AROUND > self.most
        hotel = scene.vessel.hotel
        draw = np.maximum(scene.energy[runs] / scene.time + hotel, scene.vessel.draw)
        weak = scene.charge[runs] < seconds * draw * RESERVE
        why = {int(run): "the time is nearly over" for run in runs[late]}
        return why | {int(run): "the battery is low" for run in runs[weak & ~late]}

    def _fail(self, run: int, at: int, mode: str, reason: str) -> None:
        """Home where the step names the failure mode and the position is known; else stop."""
        if at == len(self.stages) - 1:
            end = reason
        elif self.scene.lost[run]:
            end = f"{reason}; without a GPS fix it cannot return"
        elif mode in self.stages[at].failures:
            self._home(run, at, reason)
            return
        else:
            end = f"{reason}; no failure mode of the step says more"
        self.running[at].stop(np.array([run]))
        self._end([run], "stopped", end)

    def _home(self, run: int, at: int, reason: str) -> None:
        self.running[at].stop(np.array([run]))
        self.reason[run] = reason
        self.scene.note(run, "event", {"text": f"returns home: {reason}"})
        self._enter(np.array([run]), len(self.stages) - 1)

    def _enter(self, runs: Runs, at: int) -> None:
        if at not in self.running:
            self.running[at] = Running(self.stages[at], self.scene)
        self.at[runs] = at
        self.running[at].start(runs)
        stage = self.stages[at]
        skills = [job.skill for job in stage.jobs]
        for run in runs:
            where = {"task": stage.task, "step": stage.step + 1, "skills": skills}
            self.scene.note(int(run), "step", where)

    def _end(self, runs: Iterable[int], outcome: Outcome, reason: str) -> None:
        """End runs; for one that was on the way home, the reason for that comes first."""
        late = f"on the way home: {reason}" if reason else ""
        for run in map(int, runs):
            if self.outcome[run] == "running":
                before = self.reason[run]
                why = "; ".join(filter(None, (before, late))) if before else reason
                self.outcome[run], self.reason[run] = outcome, why
                self.ended[run], self.scene.idle[run] = self.scene.steps, True
                self.scene.note(run, "end", {"text": outcome + (f": {why}" if why else "")})
