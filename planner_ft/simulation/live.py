"""One run at a pace that a person can watch, for the review page."""

from __future__ import annotations

import importlib.util
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from planner_ft.review.web.run import Frame, Stop
from planner_ft.simulation.asked import SimulationSettings
from planner_ft.simulation.executor import Executor, Stage
from planner_ft.simulation.guidance import SETTLE
from planner_ft.simulation.run import simulate
from planner_ft.simulation.staging import PATIENCE, SLACK

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
    return {"outcome": result.outcome, "reason": result.reason, "seconds": result.seconds}


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
