"""Several processes that share a run: same answers and figures as one, whatever their number was
before a kill.
"""

from __future__ import annotations

import csv
import json
import os
import subprocess
from pathlib import Path

import pytest

from planner_ft.benchmark.ranks import Ranks, part_name, take_in, take_in_abandoned
from planner_ft.benchmark.records import RecordLog
from planner_ft.benchmark.suite.units import command
from planner_ft.support.errors import PlannerError

NAME = "Llama-3.2-1B-Instruct"


def record(name: str) -> dict[str, str]:
    return {"key": "k", "id": name, "output": name}


def test_every_item_is_in_one_share() -> None:
    items = list(range(7))
    shares = [Ranks(rank, 3).share(items) for rank in range(3)]
    assert sorted(item for share in shares for item in share) == items
    assert max(map(len, shares)) - min(map(len, shares)) <= 1


def test_parts_are_taken_in_once_however_often_it_is_tried(tmp_path: Path) -> None:
    for rank, names in ((1, "bc"), (2, "d")):
        (tmp_path / part_name(rank)).write_text(
            "".join(json.dumps(record(name)) + "\n" for name in names)
        )
    with RecordLog(tmp_path / "predictions.jsonl") as log:
        log.append(record("a"))
        log.append(record("b"))
        take_in(tmp_path, log)
        take_in(tmp_path, log)
    written = [
        json.loads(line)["id"] for line in (tmp_path / "predictions.jsonl").read_text().splitlines()
    ]
    assert written == ["a", "b", "c", "d"]


def test_what_killed_processes_left_is_kept_and_its_unfinished_line_dropped(tmp_path: Path) -> None:
    (tmp_path / part_name(1)).write_text(json.dumps(record("a")) + '\n{"key":"k","id":"b","out')
    with RecordLog(tmp_path / "predictions.jsonl") as log:
        take_in_abandoned(tmp_path, log)
        assert set(log.of_key("k")) == {"a"}
    assert not (tmp_path / part_name(1)).exists()


def test_a_part_that_somebody_writes_is_left_alone(tmp_path: Path) -> None:
    with (
        RecordLog(tmp_path / part_name(1)),
        RecordLog(tmp_path / "predictions.jsonl") as log,
        pytest.raises(PlannerError, match="another run is writing"),
    ):
        take_in_abandoned(tmp_path, log)


def test_two_processes_give_the_result_of_one(tmp_path: Path, models: Path) -> None:
    data = tmp_path / "data.jsonl"
    records = [
        {
            "id": f"m{index}",
            "prompt": f"go to {index} {index}" + " soon" * index,
            "expected": {"tasks": [{"title": "Transit"}]},
        }
        for index in range(5)
    ]
    data.write_text("".join(json.dumps(line) + "\n" for line in records))
    environment = {**os.environ, "OMP_NUM_THREADS": "1", "CUDA_VISIBLE_DEVICES": ""}
    for processes in (1, 2):
        flags = {
            "level": "mission",
            "candidates": NAME,
            "configurations": "base",
            "data": data,
            "out": tmp_path / str(processes),
        }
        flags |= {"device": "cpu", "max-new-tokens": 6, "latency-samples": 1}
        arguments = [
            "bench",
            *(str(item) for name, value in flags.items() for item in (f"--{name}", value)),
        ]
        done = subprocess.run(
            command(arguments, processes),
            env=environment,
            capture_output=True,
            text=True,
            check=False,
        )
        assert done.returncode == 0, done.stderr
    outputs, tables = [], []
    for processes in ("1", "2"):
        lines = [
            json.loads(line)
            for line in (tmp_path / processes / "predictions.jsonl").read_text().splitlines()
        ]
        assert len(lines) == len(records)
        outputs.append({line["id"]: (line["output"], line["tokens"]) for line in lines})
        with open(tmp_path / processes / "table.csv", newline="") as stream:
            tables.append(
                [
                    {name: value for name, value in row.items() if "latency" not in name}
                    for row in csv.DictReader(stream)
                ]
            )
    assert outputs[0] == outputs[1]
    assert tables[0] == tables[1]
    assert not list((tmp_path / "2").glob("predictions.part*"))
