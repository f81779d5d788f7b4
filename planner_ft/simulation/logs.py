"""The logs of runs, written while they go on: lines of JSON, and MCAP files with ROS 2 messages
(https://mcap.dev), for Foxglove and rosbag2.

Frames by REP-103 and REP-105: map is the plan's local frame (x east, y north), odom the same, as
there is no odometry of its own, and base_link the vehicle.
"""

import contextlib
import math
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import IO, Any

import numpy as np

from planner_ft.document.track import Point
from planner_ft.simulation.asked import Faults
from planner_ft.simulation.executor import Executor
from planner_ft.simulation.fast import Runs
from planner_ft.simulation.measures import Observer
from planner_ft.simulation.scene import FIX_SIGMA, Scene
from planner_ft.support.files import compact_json, read_toml

EVERY = 1.0
"""Seconds between two messages of a topic; odometry, commands and frames come in every step."""
FLUSH, POSE = 5.0, 1.0
"""Seconds of a run between two writes of its log to the disk, and between two of its poses."""
CHUNK = 2**14  # bytes of messages that a kill may cost
TOPICS = {
    "/odom": "nav_msgs/Odometry",
    "/fix": "sensor_msgs/NavSatFix",
    "/cmd_vel": "geometry_msgs/TwistStamped",
    "/plan": "nav_msgs/Path",
    "/skill": "std_msgs/String",
    "/tf": "tf2_msgs/TFMessage",
    "/scan": "sensor_msgs/LaserScan",
}
BREAK = "=" * 80
Message = dict[str, Any]


class RunLogs:
    """The logs of all runs in a folder: lines of JSON, and ROS 2 messages of the first `mcap`."""

    def __init__(
        self, folder: Path, runs: int, mcap: int, faults: Faults, stack: contextlib.ExitStack
    ) -> None:
        self.folder, self.mcap, self.faults, self.stack = folder, mcap, faults, stack
        self.first: list[dict[str, Any]] = []
        self.tracks: list[list[Point]] = [[] for _run in range(runs)]
        self.files: list[IO[str]] = []
        for run in range(runs):
            stream = open(folder / f"{name_of(run)}.jsonl", "w", encoding="utf-8")  # noqa: SIM115
            self.files.append(stack.enter_context(stream))
        self.ros: list[RosLog] = []

    def begin(self, scene: Scene, observer: Observer, way: Sequence[Point]) -> None:
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

    def tell_faults(self, runs: Runs) -> None:
        """Note the faults that begin or end now."""
        scene = self.scene
        for fault in self.faults.all:
            for at, words in ((fault.start, "begins"), (fault.end, "ends")):
                if 0 <= scene.time - at < scene.seconds - 1e-9:
                    for run in runs:
                        scene.note(int(run), "event", {"text": f"fault {fault.text} {words}"})

    def step(self, executor: Executor) -> None:
        """Poses, faults that begin or end, and ROS 2 messages of this time step."""
        scene, active = self.scene, np.flatnonzero(executor.active)
        self.tell_faults(active)
        if scene.steps % round(POSE / scene.seconds) == 0:
            for run in active:
                x, y, _z, yaw = (round(float(one), 2) for one in scene.pose[run])
                self.tracks[run].append((x, y))
                line = {"t": round(scene.time, 1), "kind": "pose", "pose": [x, y, yaw]}
                self.files[run].write(compact_json(line) + "\n")
        for run in active[active < len(self.ros)]:
            self.ros[run].step()
        if scene.steps % round(FLUSH / scene.seconds) == 0:
            streams: list[IO[Any]] = [*self.files, *(log.stream for log in self.ros)]
            for stream in streams:
                stream.flush()


def name_of(run: int) -> str:
    """The name of a run's files; `run` counts from 0."""
    return f"run-{run + 1:02d}"


class RosLog:
    """Writes one run. What was written can be read after a kill: chunks are closed as they fill."""

    def __init__(self, stream: IO[bytes], scene: Scene, run: int, way: Sequence[Point]) -> None:
        from mcap_ros2.writer import Writer

        self.writer = Writer(stream, chunk_size=CHUNK)
        self.stream, self.scene, self.run = stream, scene, run
        self.schemas = {
            name: self.writer.register_msgdef(name.replace("/", "/msg/"), definition(name))
            for topic, name in TOPICS.items()
            if topic != "/scan" or scene.vessel.rays
        }
        poses = [{"header": self._header("map"), "pose": _pose(*at, 0.0, 0.0)} for at in way]
        self.write("/plan", {"header": self._header("map"), "poses": poses})

    def note(self, line: Mapping[str, Any]) -> None:
        """A line of the run's log on /skill, as JSON."""
        self.write("/skill", {"data": compact_json(dict(line))})

    def step(self) -> None:
        """The messages of this time step."""
        scene, run = self.scene, self.run
        pose, twist = _pose(*scene.pose[run]), _twist(*scene.twist[run])
        held: Message = {"covariance": [0.0] * 36}
        odometry = {"pose": {"pose": pose, **held}, "twist": {"twist": twist, **held}}
        head = {"header": self._header("odom"), "child_frame_id": "base_link"}
        self.write("/odom", {**head, **odometry})
        wanted = _twist(*scene.command[run])
        self.write("/cmd_vel", {"header": self._header("base_link"), "twist": wanted})
        odom = self._frame("map", "odom", _pose(0.0, 0.0, 0.0, 0.0))
        self.write("/tf", {"transforms": [odom, self._frame("odom", "base_link", pose)]})
        if scene.steps % round(EVERY / scene.seconds) == 0:
            self.write("/fix", self._fix())
            if scene.vessel.rays:
                self.write("/scan", self._scan())

    def close(self) -> None:
        """Finish the file."""
        self.writer.finish()
        self.stream.close()

    def write(self, topic: str, message: Message) -> None:
        """Write a message at the time of the scene."""
        at = round(self.scene.time * 1e9)
        self.writer.write_message(topic, self.schemas[TOPICS[topic]], message, at, at)

    def _header(self, frame: str) -> Message:
        nanoseconds = round(self.scene.time * 1e9)
        stamp = {"sec": nanoseconds // 10**9, "nanosec": nanoseconds % 10**9}
        return {"stamp": stamp, "frame_id": frame}

    def _frame(self, parent: str, child: str, pose: Message) -> Message:
        moved = {"translation": pose["position"], "rotation": pose["orientation"]}
        return {"header": self._header(parent), "child_frame_id": child, "transform": moved}

    def _fix(self) -> Message:
        place, heard = self.scene.localiser.fix[self.run], self.scene.localiser.silent[self.run] < 2
        latitude, longitude = self.scene.origin.to_geographic(float(place[0]), float(place[1]))
        spread = [FIX_SIGMA**2 if index in (0, 4) else 0.0 for index in range(9)]
        return {
            "header": self._header("base_link"),
            "status": {"status": 0 if heard else -1, "service": 1},
            "latitude": latitude,
            "longitude": longitude,
            "altitude": float(self.scene.pose[self.run, 2]),
            "position_covariance": spread,
            "position_covariance_type": 2,
        }

    def _scan(self) -> Message:
        ranges = self.scene.ranges(np.array([self.run]))[0]
        return {
            "header": self._header("base_link"),
            "angle_min": 0.0,
            "angle_max": 2 * math.pi * (1 - 1 / len(ranges)),
            "angle_increment": 2 * math.pi / len(ranges),
            "time_increment": 0.0,
            "scan_time": EVERY,
            "range_min": 0.0,
            "range_max": self.scene.vessel.reach,
            "ranges": ranges.tolist(),
            "intensities": [],
        }


def definition(name: str) -> str:
    """The definition of a message with those that it is made of, as MCAP wants it."""
    known = read_toml(Path(__file__).with_name("messages.toml"))
    used = [f"MSG: {one}\n{known[one].strip()}" for one in dict.fromkeys(_used(name, known))]
    return f"\n{BREAK}\n".join([known[name].strip(), *used]) + "\n"


def _used(name: str, known: Mapping[str, str]) -> Iterator[str]:
    for line in known[name].split("\n"):
        kind = line.split("[")[0].split(" ")[0]
        if kind in known:
            yield kind
            yield from _used(kind, known)


def _pose(x: float, y: float, z: float, yaw: float) -> Message:
    turn = {"x": 0.0, "y": 0.0, "z": math.sin(yaw / 2), "w": math.cos(yaw / 2)}
    return {"position": {"x": float(x), "y": float(y), "z": float(z)}, "orientation": turn}


def _twist(surge: float, sway: float, climb: float, rate: float) -> Message:
    linear = {"x": float(surge), "y": float(sway), "z": float(climb)}
    return {"linear": linear, "angular": {"x": 0.0, "y": 0.0, "z": float(rate)}}
