"""Simulating an approved plan: read and check it, run it, write results, logs and reports; for the
review page one run at a pace that a person can watch.
"""

from __future__ import annotations

import contextlib
import importlib.util
import math
import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from planner_ft.document.track import Point, point_of
from planner_ft.exporters.formats import PlanExport
from planner_ft.exporters.run import read_plan
from planner_ft.simulation.asked import SimulationSettings
from planner_ft.simulation.executor import Executor, Stage
from planner_ft.simulation.fast import build_simulator, build_vessel, simulation_file
from planner_ft.simulation.guidance import SETTLE
from planner_ft.simulation.logs import RunLogs
from planner_ft.simulation.measures import Observer, RunResult, broken
from planner_ft.simulation.scene import Scene
from planner_ft.simulation.staging import PATIENCE, SLACK, Staging
from planner_ft.simulation.world import World
from planner_ft.support.alone import alone
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import check_writable
from planner_ft.support.geodesy import Origin
from planner_ft.support.terminal import Report

if TYPE_CHECKING:
    from planner_ft.review.web.run import Frame, Stop

RESULTS, MANIFEST, TEMPORARY = "results.json", "manifest.json", ".*.tmp"
OURS = (
    *("run-*.jsonl", "run-*.mcap", RESULTS, MANIFEST),
    *("table.*", "tracks.svg", "report.*", TEMPORARY),
)
"""Files of a simulation, which --overwrite may remove."""
Watch = Callable[[Executor], None]


@dataclass(frozen=True)
class Simulated:
    """A simulation that has ended: the plan, what was run, and the results."""

    plan: PlanExport
    settings: SimulationSettings
    staging: Staging
    scene: Scene
    results: list[RunResult]
    tracks: list[list[Point]]
    log: list[dict[str, Any]]  # the log of run 1, without its poses


def simulate(
    settings: SimulationSettings, report: Report | None = None, watch: Watch | None = None
) -> Simulated:
    """Run an approved plan and write everything into the folder; `watch` is called after every
    step. Raises PlannerError.
    """
    plan = read_plan(settings, "results that are marked so", altered=False)
    with alone(settings.folder, "--out", "a simulation"):
        check_writable(settings.folder)
        kept = [path.name for path in settings.folder.glob("*")] if settings.folder.exists() else []
        if kept and not settings.overwrite:
            hint = "give --overwrite to replace it, or another folder with --out"
            raise PlannerError(f"--out {settings.folder}: holds {kept[0]}; {hint}")
        prepared = _Prepared(plan, settings)
        if kept:
            _clear(settings.folder)
        settings.folder.mkdir(parents=True, exist_ok=True)
        done = prepared.run(report or (lambda _label, _done, _total: None), watch)
        from planner_ft.simulation.output import write_all

        write_all(done)
    return done


class _Prepared:
    """A checked plan with its world, before anything is written."""

    def __init__(self, plan: PlanExport, settings: SimulationSettings) -> None:
        self.plan, self.settings = plan, settings
        vocabulary, document = plan.vocabulary, plan.document
        raw = simulation_file(vocabulary)
        self.vessel = build_vessel(vocabulary, document["vehicle"])
        one_sided = [one for one in settings.faults.all if one.kind in ("port", "starboard")]
        if one_sided and self.vessel.drive != "differential":
            problem = f"{vocabulary.name} has no port and starboard thrusters"
            raise PlannerError(f"--fault {one_sided[0].text}: {problem}; leave it out")
        self.staging = Staging(plan, self.vessel, raw, settings)
        if settings.mcap and importlib.util.find_spec("mcap_ros2") is None:
            ways = "pip install planner_ft[sim], or give --mcap 0"
            raise PlannerError(f"--mcap {settings.mcap}: ROS 2 logs need an extra; {ways}")
        self.stages, self.home = list(self.staging.stages()), self.staging.home()
        self.staging.check_skills([*self.stages, self.home])
        starts, count = list(settings.starts) or [vocabulary.home], settings.runs
        self.world = self._world()
        for name, corners in settings.outlines.items():
            self.world.add_outline(name, corners)
        self.staging.check_starts(starts, self.world)
        self.simulator = build_simulator(settings.simulator, self.vessel, count)
        self.starts = np.zeros((count, 4))
        self.starts[:, :2] = [starts[run % len(starts)] for run in range(count)]
        turned = np.random.default_rng([settings.seed, 3]).uniform(-math.pi, math.pi, count)
        self.starts[:, 3] = turned

    def _world(self) -> World:
        """Objects of plan and chart, and located places, stand where they truly are."""
        settings, staging, document = self.settings, self.staging, self.plan.document
        known = {one.name: one.position for one in staging.structures}
        for told in (document.get("structures", {}), document.get("located", {})):
            known |= {name: point_of(place) for name, place in told.items()}
        given = {name: point_of(place) for name, place in settings.locations.items()}
        objects, charted = known | given, staging.structures
        true = {place: objects[name] for name, place in known.items()}
        placed = [replace(one, position=true.get(one.position, one.position)) for one in charted]
        water = staging.fences, staging.allowed, settings.faults, settings.runs, settings.seed
        return World(self.vessel, self.plan.vocabulary.home, charted, placed, objects, *water)

    def run(self, report: Report, watch: Watch | None) -> Simulated:
        settings, staging = self.settings, self.staging
        with contextlib.ExitStack() as stack:
            writer = RunLogs(settings.folder, settings.runs, settings.mcap, settings.faults, stack)
            origin = self.plan.origin or Origin(0.0, 0.0)
            scene = Scene(self.world, self.simulator, self.starts, origin, writer.write)
            tasks = [task["id"] for task in self.plan.document["tasks"]]
            kept = staging.rings(), staging.close(), staging.least()
            observer = Observer(scene, staging.bounds, *kept, tasks)
            way = [point for leg in self.plan.track.legs for point in leg.points]
            writer.begin(scene, observer, way)
            executor = Executor(self.stages, self.home, scene, observer, staging.seconds)
            executor.begin()
            writer.tell_faults(np.flatnonzero(executor.active))
            while executor.step():
                writer.step(executor)
                if watch is not None:
                    watch(executor)
                if scene.steps % 100 == 0:
                    ended = settings.runs - int(executor.active.sum())
                    report("runs ended", ended, settings.runs)
            report("runs ended", settings.runs, settings.runs)
            results = [observer.result(run, executor) for run in range(settings.runs)]
            told = writer.tracks, writer.first
            return Simulated(self.plan, settings, staging, scene, results, *told)


def _clear(folder: Path) -> None:
    """Remove the files of an earlier simulation. Raises PlannerError when others are there."""
    ours = {path for pattern in OURS for path in folder.glob(pattern) if path.is_file()}
    if foreign := sorted(set(folder.iterdir()) - ours):
        problem = f"holds {foreign[0].name}, which is not of a simulation"
        raise PlannerError(f"--out {folder}: {problem}; give another folder")
    for path in ours:
        path.unlink()


FRAME = 0.1  # seconds between two frames at least
ONE = np.array([0])


def run_live(
    plan: Path,
    log: Path,
    folder: Path,
    vocabulary: str,
    speed: float,
    tell: Callable[[Frame], None],
    stop: Stop,
) -> dict[str, Any]:
    """Simulate a plan once into `folder`, `speed` times as fast as the clock. Raises PlannerError.

    `tell` gets its frames; once `stop` is set it is aborted before its next step.
    """
    mcap = int(importlib.util.find_spec("mcap_ros2") is not None)
    how: dict[str, Any] = {"log": log, "vocabulary": vocabulary}
    settings = SimulationSettings(plan, folder, runs=1, mcap=mcap, **how)
    begun, told = time.monotonic(), -FRAME

    def watch(executor: Executor) -> None:
        """After every step: tell, wait, and abort."""
        nonlocal told
        now, over = time.monotonic() - begun, not executor.active[0]
        if over or now - told >= FRAME:
            told = now
            tell(frame_of(executor))
        due = 0.0 if over else executor.scene.time / speed - now
        if stop.wait(max(0.0, due)):
            executor.abort(ONE, stop.reason)

    (result,) = simulate(settings, watch=watch).results
    limits = broken([result])
    words = f"limits of the plan broken: {limits}" if limits else ""
    reason = "; ".join(filter(None, (result.reason, words)))
    return {"outcome": result.outcome, "reason": reason, "seconds": result.seconds}


def frame_of(executor: Executor) -> Frame:
    """What a page shows of the first run: where it is, what runs, and s that are left."""
    scene, at = executor.scene, int(executor.at[0])
    stage, last = executor.stages[at], len(executor.stages) - 1
    x, y, _z, yaw = (round(float(one), 2) for one in scene.pose[0])
    gone = float(executor.running[at].movement.elapsed(ONE)[0])
    here = [stage] if at == last else executor.stages[at:last]
    left = sum(map(_planned, here[1:])) + max(0.0, _planned(here[0]) - gone)
    if at == last:
        away = np.linalg.norm(scene.position[0] - np.array(scene.world.home))
        left = float(away) / scene.vessel.cruise
    return {
        "t": round(scene.time, 1),
        "pose": [x, y, yaw],
        "task": stage.task,
        "step": stage.step,
        "skills": [job.skill for job in stage.jobs],
        "left": round(left),
        "over": not executor.active[0],
    }


def _planned(stage: Stage) -> float:
    """Seconds that a step is planned for."""
    return (stage.patience - SLACK) / PATIENCE or SETTLE
