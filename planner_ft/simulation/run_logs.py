"""The logs of runs, written while they go on."""

from __future__ import annotations

import contextlib
from collections.abc import Sequence
from pathlib import Path
from typing import IO, Any

import numpy as np

from planner_ft.document.track import Point
from planner_ft.simulation.executor import Executor
from planner_ft.simulation.faults import Faults
from planner_ft.simulation.measures import Observer
from planner_ft.simulation.scene import Scene
from planner_ft.support.files import compact_json

FLUSH = 5.0
"""Seconds of a run between two writes of its log to the disk, and between two of its poses."""
POSE = 1.0


class RunLogs:
    """The logs of all runs in a folder: lines of JSON, and ROS 2 messages of the first `mcap`."""

    def __init__(
        self, folder: Path, runs: int, mcap: int, faults: Faults, stack: contextlib.ExitStack
    ) -> None:
        self.folder, self.mcap, self.faults, self.stack = folder, mcap, faults, stack
        self.files: list[IO[str]] = []
        self.first: list[dict[str, Any]] = []
        self.tracks: list[list[Point]] = [[] for _run in range(runs)]
        for run in range(runs):
            path = folder / f"{name_of(run)}.jsonl"
            stream = open(path, "w", encoding="utf-8")  # noqa: SIM115
            self.files.append(stack.enter_context(stream))
        self.ros: list[Any] = []

    def begin(self, scene: Scene, observer: Observer, way: Sequence[Point]) -> None:
        from planner_ft.simulation.ros_log import RosLog

        self.scene, self.observer = scene, observer
        for run in range(self.mcap):
            stream = open(self.folder / f"{name_of(run)}.mcap", "wb")  # noqa: SIM115
            self.ros.append(RosLog(stream, scene, run, way))
            self.stack.callback(self.ros[-1].close)

    def write(self, run: int, line: dict[str, Any]) -> None:
        """One line of the log of a run."""
        if run == 0:
            self.first.append(line)
        self.observer.noted(run, line)
        self.files[run].write(compact_json(line) + "\n")
        if run < len(self.ros):
            self.ros[run].note(line)

    def step(self, executor: Executor) -> None:
        """Poses, faults that begin or end, and ROS 2 messages of this time step."""
        scene, active = self.scene, np.flatnonzero(executor.active)
        for fault in self.faults.all:
            for at, words in ((fault.start, "begins"), (fault.end, "ends")):
                if 0 <= scene.time - at < scene.seconds - 1e-9:
                    for run in active:
                        scene.note(int(run), "event", {"text": f"fault {fault.text} {words}"})
        if scene.steps % round(POSE / scene.seconds) == 0:
            for run in active:
                x, y, _z, yaw = (round(float(one), 2) for one in scene.pose[run])
                self.tracks[run].append((x, y))
                line = {"t": round(scene.time, 1), "kind": "pose", "pose": [x, y, yaw]}
                self.files[run].write(compact_json(line) + "\n")
        for run in active[active < len(self.ros)]:
            self.ros[run].step()
        if scene.steps % round(FLUSH / scene.seconds) == 0:
            for stream in (*self.files, *self.ros):
                stream.flush()


def name_of(run: int) -> str:
    """The name of a run's files; `run` counts from 0."""
    return f"run-{run + 1:02d}"
