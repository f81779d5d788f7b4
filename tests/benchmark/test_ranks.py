"""Several processes that share a run: same answers and figures as one, whatever their number was
before a kill.
"""

from __future__ import annotations

import csv
import json
import os
import subprocess
from dataclasses import replace
from pathlib import Path

import pytest

from planner_ft.benchmark.folder import RecordLog
from planner_ft.benchmark.plan import WORTH_HELP, is_helped
from planner_ft.benchmark.settings import BenchSettings
from planner_ft.benchmark.units import command
from planner_ft.support.ranks import Ranks
from planner_ft.support.resources import cores

NAME = "Llama-3.2-1B-Instruct"


@pytest.mark.parametrize("way", ["share", "stretch"])
def test_every_item_is_in_one_share(way: str) -> None:
    items = list(range(7))
    shares = [getattr(Ranks(rank, 3), way)(items) for rank in range(3)]
    assert sorted(item for share in shares for item in share) == items
    assert max(map(len, shares)) - min(map(len, shares)) <= 1


@pytest.mark.skipif(cores() == 1, reason="there is no second core")
def test_many_answers_of_a_small_model_are_worth_a_second_process() -> None:
    every = BenchSettings("mission", ("embedded",), ("base",), Path("data/mission/challenge.jsonl"))
    assert is_helped(every) and not is_helped(replace(every, limit=WORTH_HELP - 1))


def test_processes_add_to_one_log_and_read_what_the_others_wrote(tmp_path: Path) -> None:
    path = tmp_path / "predictions.jsonl"
    with RecordLog(path) as one, RecordLog(path) as other:
        for name in "abc":
            one.append({"key": "k", "id": name})
            other.append({"key": "k", "id": name.upper()})
        one.read()
        assert set(one.of_key("k")) == set("abcABC")
    assert len(path.read_text().splitlines()) == 6


@pytest.mark.usefixtures("forked")
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
            "--no-report",
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
