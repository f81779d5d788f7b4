"""Kill a benchmark run at random points and compare what comes out with a run that nobody killed.

    python benchmarks/kill_bench.py --kills 20

The run is `plannerft bench` on the embedded candidate, in real processes that are ended by SIGKILL
after a random number of lines and a random moment. Asserted are: every answer is there once, and
answers and every metric that is not a time are those of the run that was not interrupted.
"""

from __future__ import annotations

import argparse
import json
import random
import signal
import subprocess
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path
from typing import Any

FILES = ("predictions.jsonl", "latency.jsonl")
TIMES = ("latency_s",)


def command(out: Path, samples: int) -> list[str]:
    """A run in both configurations, with some timed queries."""
    flags = {
        "level": "mission",
        "candidates": "embedded",
        "configurations": "base,lora",
        "data": "data/mission/test.jsonl",
        "limit": samples,
    }
    flags |= {"latency-samples": 4, "batch-size": 4, "device": "cpu", "out": out}
    named = (str(item) for name, value in flags.items() for item in (f"--{name}", value))
    return [sys.executable, "-m", "planner_ft", "bench", *named, "--resume", "--no-report"]


def lines(out: Path) -> int:
    """Whole lines that a run has written."""
    return sum((out / name).read_bytes().count(b"\n") for name in FILES if (out / name).is_file())


def kill_once(out: Path, samples: int, rng: random.Random) -> bool:
    """Start the run and kill it; False when it ended before that."""
    wanted = lines(out) + rng.randrange(0, 4)
    process = subprocess.Popen(
        command(out, samples), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
    )
    if wanted == lines(out):
        # While it loads.
        time.sleep(rng.uniform(0, 5))
    while process.poll() is None and lines(out) < wanted:
        time.sleep(0.01)
    time.sleep(rng.uniform(0, 0.3))
    if process.poll() is not None:
        assert process.returncode == 0, f"the run was refused: {' '.join(command(out, samples))}"
        return False
    process.send_signal(signal.SIGKILL)
    process.wait()
    return True


def answers(out: Path) -> dict[tuple[str, str, str], Any]:
    """Every record by file, configuration and sample; raises AssertionError when one is there
    twice.
    """
    found = [
        (name, json.loads(line))
        for name in FILES
        for line in (out / name).read_text(encoding="utf-8").splitlines()
    ]
    counts = Counter((name, record["configuration"], record["id"]) for name, record in found)
    assert max(counts.values()) == 1, (
        f"written twice: {[key for key, count in counts.items() if count > 1]}"
    )
    return {
        (name, record["configuration"], record["id"]): record.get("output", record["tokens"])
        for name, record in found
    }


def figures(out: Path) -> list[Any]:
    """Every metric that is not a time."""
    rows = json.loads((out / "results.json").read_text(encoding="utf-8"))["rows"]
    return [
        {name: value for name, value in row["metrics"].items() if name not in TIMES} for row in rows
    ]


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--kills", type=int, default=20)
    parser.add_argument("--samples", type=int, default=25)
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args()
    rng = random.Random(options.seed)
    with tempfile.TemporaryDirectory() as temporary:
        whole, killed = Path(temporary) / "whole", Path(temporary) / "killed"
        subprocess.run(
            command(whole, options.samples),
            check=True,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        points = []
        for number in range(options.kills):
            if not kill_once(killed, options.samples, rng):
                print(f"the run ended after {number} kills")
                break
            points.append(lines(killed))
            print(f"kill {number + 1}: {points[-1]} lines written", flush=True)
        subprocess.run(
            command(killed, options.samples),
            check=True,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        assert answers(killed) == answers(whole), "answers differ"
        assert figures(killed) == figures(whole), "figures differ"
    print(
        f"{len(points)} kills at {points} of {2 * (options.samples + 4)} lines: same answers, same"
        " figures, nothing twice"
    )


if __name__ == "__main__":
    main()
