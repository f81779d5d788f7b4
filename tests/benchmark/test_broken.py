"""Runs that are broken on purpose: nothing is lost, nothing is paid twice, and one sentence says
what is wrong.
"""

from __future__ import annotations

import json
import multiprocessing
import os
import random
import resource
import shutil
import signal
import time
from collections import Counter
from pathlib import Path
from typing import Any

import pytest

from planner_ft.benchmark.runner import run_bench
from planner_ft.benchmark.settings import BenchSettings
from planner_ft.decoding import generate as generate_module
from planner_ft.support.errors import PlannerError

NAME = "Llama-3.2-1B-Instruct"
COUNT = 8
TIMED = 2


@pytest.fixture
def settings(tmp_path: Path, models: Path) -> Any:
    records = [
        {
            "id": f"m{index}",
            "prompt": f"go to {index}" + " soon" * index,
            "expected": {"tasks": [{"title": "Transit"}]},
        }
        for index in range(COUNT)
    ]
    (tmp_path / "data.jsonl").write_text("".join(json.dumps(record) + "\n" for record in records))

    def make(**changes: Any) -> BenchSettings:
        values: dict[str, Any] = {
            "level": "mission",
            "candidates": (NAME,),
            "configurations": ("base",),
            "data": tmp_path / "data.jsonl",
            "out": tmp_path / "out",
            "device": "cpu",
            "batch_size": 2,
            "max_new_tokens": 40,
            "latency_samples": TIMED,
        }
        return BenchSettings(**{**values, **changes})

    return make


def records(folder: Path) -> dict[tuple[str, str, str], Any]:
    """Every record, each there once: the text of an answer, the tokens of a timed query."""
    found = [
        (name, json.loads(line))
        for name in ("predictions.jsonl", "latency.jsonl")
        for line in (folder / name).read_text().splitlines()
    ]
    counts = Counter((name, record["configuration"], record["id"]) for name, record in found)
    assert set(counts.values()) <= {1}, counts
    return {
        (name, record["configuration"], record["id"]): record.get("output", record["tokens"])
        for name, record in found
    }


def figures(folder: Path) -> list[Any]:
    rows = json.loads((folder / "results.json").read_text())["rows"]
    return [
        {name: value for name, value in row["metrics"].items() if name != "latency_s"}
        for row in rows
    ]


def lines(folder: Path) -> int:
    return sum(
        (folder / name).read_bytes().count(b"\n")
        for name in ("predictions.jsonl", "latency.jsonl")
        if (folder / name).is_file()
    )


def in_a_process(settings: BenchSettings, *, bytes_allowed: int | None = None) -> Any:
    """The run in a process of its own, forked: libraries are loaded already."""

    def run() -> None:
        import torch

        torch.set_num_threads(1)
        if bytes_allowed is not None:
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (bytes_allowed, bytes_allowed))
        try:
            run_bench(settings)
        except PlannerError as error:
            (settings.folder / "error.txt").write_text(str(error)[:200])
            os._exit(2)
        os._exit(0)

    process = multiprocessing.get_context("fork").Process(target=run)
    process.start()
    return process


def test_a_run_that_is_killed_at_random_points_loses_nothing_and_pays_nothing_twice(
    settings: Any, tmp_path: Path
) -> None:
    run_bench(settings(out=tmp_path / "whole"))
    rng, kills = random.Random(0), 0
    while kills < 5:
        wanted = lines(tmp_path / "out") + rng.randrange(0, 3)
        process = in_a_process(settings(resume=True))
        while process.is_alive() and lines(tmp_path / "out") < wanted:
            time.sleep(0.002)
        time.sleep(rng.uniform(0, 0.05))
        process.kill()
        process.join()
        if process.exitcode == 0:
            break
        assert process.exitcode == -signal.SIGKILL
        kills += 1
    assert kills
    run_bench(settings(resume=True))
    assert records(tmp_path / "out") == records(tmp_path / "whole")
    assert figures(tmp_path / "out") == figures(tmp_path / "whole")


def test_a_model_that_cannot_be_loaded_leaves_nothing_for_the_next_run(
    settings: Any, models: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    broken = tmp_path / "models" / NAME
    shutil.copytree(models / NAME, broken)
    config = json.loads((broken / "config.json").read_text())
    (broken / "config.json").write_text(json.dumps(config | {"hidden_size": 128}))
    with monkeypatch.context() as patch:
        patch.setenv("PLANNERFT_MODELS", str(tmp_path / "models"))
        with pytest.raises(PlannerError, match="the model cannot be loaded"):
            run_bench(settings())
    assert list((tmp_path / "out").iterdir()) == []
    run_bench(settings())


def test_a_disk_that_is_full_in_the_middle_of_an_answer(settings: Any, tmp_path: Path) -> None:
    run_bench(settings(out=tmp_path / "whole"))
    process = in_a_process(settings(), bytes_allowed=2500)
    process.join()
    assert process.exitcode == 2
    assert "cannot be written" in (tmp_path / "out" / "error.txt").read_text()
    assert 0 < lines(tmp_path / "out") < COUNT
    run_bench(settings(resume=True))
    assert records(tmp_path / "out") == records(tmp_path / "whole")


def test_a_disk_that_is_full_when_results_are_written(
    settings: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with monkeypatch.context() as patch:
        patch.setattr(os, "fsync", _full_for_results)
        with pytest.raises(
            PlannerError, match=r"table\.md: cannot be written \(No space left on device\)"
        ):
            run_bench(settings())
    before = records(tmp_path / "out")
    assert len(before) == COUNT + TIMED
    assert not (tmp_path / "out" / "results.json").exists()
    assert not list((tmp_path / "out").glob(".*.tmp"))
    with monkeypatch.context() as patch:
        patch.setattr(generate_module, "_run", None)
        run_bench(settings(resume=True))
    assert records(tmp_path / "out") == before


def _full_for_results(descriptor: int) -> None:
    if "table.md" in str(Path(f"/proc/self/fd/{descriptor}").readlink()):
        raise OSError(28, "No space left on device")


def test_a_model_that_never_ends_is_cut_and_the_table_says_so(
    settings: Any, tmp_path: Path
) -> None:
    results = run_bench(settings(max_new_tokens=5, latency_samples=0))
    assert results.rows[0].finish_reasons == {"length": COUNT}
    assert (
        f"{COUNT} of {COUNT} outputs were cut at the token limit"
        in (tmp_path / "out" / "table.md").read_text()
    )
