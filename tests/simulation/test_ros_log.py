"""The ROS 2 log, read back by another library than wrote it."""

from __future__ import annotations

import json
import math
import tomllib
from collections import Counter
from pathlib import Path

import pytest
from rosbags.highlevel import AnyReader

import planner_ft.simulation
from planner_ft.simulation.logs import TOPICS, definition
from tests.documents import DRONE, step, task

from .conftest import Run
from .plans import transit, using


def test_the_log_is_read_back_with_all_topics(run: Run) -> None:
    steps = [using(step("GoToXY", {"x": 12, "y": 5}), (), [("GetSeabedDepth", {})])]
    done = run([transit(12, 5, *steps)], mcap=1)
    files = sorted(done.settings.folder.glob("*.mcap"))
    assert [path.name for path in files] == ["run-01.mcap"]
    with AnyReader(files) as reader:
        counts, last, told = Counter[str](), {}, []
        for connection, _time, raw in reader.messages():
            counts[connection.topic] += 1
            last[connection.topic] = reader.deserialize(raw, connection.msgtype)
            if connection.topic == "/skill":
                told.append(json.loads(last["/skill"].data))
        kinds = {one.topic: one.msgtype.replace("/msg", "") for one in reader.connections}
    assert kinds == TOPICS
    steps_taken = done.results[0].steps
    assert counts["/odom"] == counts["/tf"] == counts["/cmd_vel"] >= steps_taken - 1
    assert counts["/scan"] == counts["/fix"] == (steps_taken - 1) // 5
    x, y = (getattr(last["/odom"].pose.pose.position, axis) for axis in "xy")
    assert math.dist((x, y), (12, 5)) < 1.5
    assert len(last["/scan"].ranges) == 64 and last["/fix"].status.status == 0
    assert len(last["/plan"].poses) == 2 and told[0]["kind"] == "step"
    assert any("depth_m" in line for line in told)


def test_a_vehicle_of_the_air_has_its_height(run: Run) -> None:
    fly = step("FlyToXY", {"x": 5, "y": 0, "altitude": 10})
    done = run([task("FlyToPoint", {"target_position": [5, 0]}, [fly])], DRONE, mcap=1)
    with AnyReader(sorted(done.settings.folder.glob("*.mcap"))) as reader:
        wanted = [one for one in reader.connections if one.topic == "/odom"]
        read = list(reader.messages(connections=wanted))
        heights = [
            reader.deserialize(raw, one.msgtype).pose.pose.position.z for one, _t, raw in read
        ]
    assert heights[0] < 1 and heights[-1] == pytest.approx(10, abs=1.2)


def test_definitions_hold_what_they_use() -> None:
    path = Path(planner_ft.simulation.__file__).with_name("messages.toml")
    known = tomllib.loads(path.read_text(encoding="utf-8"))
    assert set(TOPICS.values()) <= known.keys()
    for name in TOPICS.values():
        text = definition(name)
        named = {
            line.removeprefix("MSG: ") for line in text.split("\n") if line.startswith("MSG: ")
        }
        used = {line.split("[")[0].split(" ")[0] for line in text.split("\n") if "/" in line}
        assert used - {"MSG:"} == named
