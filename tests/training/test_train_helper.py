"""A second process that does half of every batch of a small model's training."""

import json
import os
import subprocess
import sys
from typing import Any

import pytest

from planner_ft.support import ranks
from planner_ft.support.resources import cores
from planner_ft.training import request
from planner_ft.training.run import train

pytestmark = pytest.mark.skipif(cores() == 1, reason="there is no second core")
FLAGS = {"epochs": 3, "rank": 4, "learning_rate": 1e-2, "dropout": 0.0, "quantization": "none"}
FLAGS |= {"seed": 3, "validation_answers": 3, "batch_size": 2}
# The helper is a process of its own: a fork would have the threads and sockets of its parent.
OWN = "import subprocess as s; s.Popen = [one for one in s.Popen.__mro__ if one.__module__ == s.__name__][0]\n"
ALWAYS = "import planner_ft.training.request as r; r.WORTH_HELP = 1\n"
ALWAYS += "import planner_ft.cli as c; c.main()"


def started(code: str, *words: str) -> subprocess.CompletedProcess[str]:
    known = {"OMP_NUM_THREADS": "1", "CUDA_VISIBLE_DEVICES": "", "COLUMNS": "200"}
    script = [sys.executable, "-c", OWN + code, *words]
    return subprocess.run(
        script, env=os.environ | known, capture_output=True, text=True, check=False
    )


@pytest.mark.usefixtures("forked")
def test_a_helped_run_is_that_of_one_process(ask, quiet, data, tmp_path, step_losses):
    # Seven samples: the last batch of an epoch leaves the helper without one.
    lines = (data / "train.jsonl").read_text().splitlines(keepends=True)
    (data / "train.jsonl").write_text("".join(lines[:7]))
    flags = [f"--{name.replace('_', '-')}={value}" for name, value in FLAGS.items()]
    named = ["--candidate", "Llama-3.2-1B-Instruct", "--data-dir", str(data)]
    out = tmp_path / "two"
    done = started(
        ALWAYS, "train", "--level", "mission", *named, *flags, "--output", str(out), "--device=cpu"
    )
    assert done.returncode == 0, done.stderr
    assert done.stdout.count("a second process does half of every batch") == 1
    two = json.loads((out / "manifest.json").read_text())

    one: Any = train(ask(output=str(tmp_path / "one"), **FLAGS), quiet)
    assert step_losses(out) == pytest.approx(step_losses(tmp_path / "one"), rel=2e-3)
    assert len(step_losses(out)) == two["result"]["steps"] == 12
    assert (two["result"]["helped"], one["result"]["helped"]) == (True, False)
    assert two["fingerprint"] == one["fingerprint"]
    assert two["result"]["validation_answers"]["n"] == 3
    for name in ("tokens", "completion_tokens", "epochs"):
        assert two["result"][name] == one["result"][name]


def test_what_is_worth_a_helper(ask, monkeypatch):
    assert not ask(batch_size=2).is_helped
    monkeypatch.setattr(request, "WORTH_HELP", 16)
    assert ask(batch_size=2, epochs=2).is_helped
    assert not ask(batch_size=2, epochs=1).is_helped
    assert not ask(batch_size=1, epochs=2).is_helped
    assert not ask(batch_size=2, epochs=2, max_steps=7).is_helped
    assert not ask(batch_size=2, epochs=2, threads=1).is_helped


MEETS = """
import os, sys, threading
import psutil
from planner_ft.support import ranks
from planner_ft.support.errors import PlannerError
ranks.SOON = float(sys.argv.pop())
try:
    with ranks.helped() as found:
        print(found)
        late = float(os.environ.get("LATE", "0"))
        for child in psutil.Process().children():
            threading.Timer(late, child.kill).start()
        if late:
            raise RuntimeError("the connection is closed")
        found.wait()
except PlannerError as error:
    print(error)
print(len(psutil.Process().children()))
"""


@pytest.mark.usefixtures("forked")
@pytest.mark.parametrize(("word", "seconds"), [("--version", "60"), ("candidates", "0.1")])
def test_a_helper_that_does_not_come_is_not_waited_for(word, seconds):
    done = started(MEETS, word, seconds)
    assert done.stdout.splitlines() == [repr(ranks.ALONE), "0"], done.stderr


@pytest.mark.usefixtures("forked")
@pytest.mark.parametrize("late", ["0", "0.5"])
def test_a_helper_that_ends_is_told_of_with_the_way_out(late, monkeypatch):
    monkeypatch.setenv("LATE", late)  # A connection closes before its process has ended.
    done = started(MEETS, "train", "--level", "mission", "60")
    assert done.stdout.count("\n") == 3, done.stderr
    found, told, left = done.stdout.splitlines()
    assert found == repr(ranks.Ranks(0, 2, divided=True))
    assert told.startswith("the process that helped this one ended (status -9); go on with")
    assert left == "0"
