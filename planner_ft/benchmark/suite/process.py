"""The process that runs a unit: the same command line, ended with its parent, its words kept in a
log.
"""

from __future__ import annotations

import signal
import subprocess
import sys
from pathlib import Path

from planner_ft.support.resources import end_with_parent

LOG = "log.txt"
PATIENCE = 20.0
"""Seconds that an ended process has to go by itself."""


class Process:
    """A running unit. Leaving the `with` block ends it if it has not ended itself."""

    def __init__(self, arguments: list[str], log: Path, processes: int = 1) -> None:
        self.log = log
        log.parent.mkdir(parents=True, exist_ok=True)
        with open(log, "wb") as stream:
            self.child = subprocess.Popen(
                command(arguments, processes),
                stdin=subprocess.DEVNULL,
                stdout=stream,
                stderr=subprocess.STDOUT,
                preexec_fn=end_with_parent,
            )

    def running(self) -> bool:
        """Whether it is still at work."""
        return self.child.poll() is None

    def end(self) -> None:
        """End it: politely, then for good."""
        self.child.terminate()
        try:
            self.child.wait(PATIENCE)
        except subprocess.TimeoutExpired:
            self.child.kill()
            self.child.wait()

    def problem(self) -> str | None:
        """Why it failed, in one line; None when it did not."""
        code = self.child.wait()
        if code == 0:
            return None
        if code < 0:
            name = signal.Signals(-code).name
            return (
                "its process was ended by"
                f" {name}{', most likely for want of memory' if -code == signal.SIGKILL else ''}"
            )
        return last_words(self.log) or f"its process ended with status {code}"

    def __enter__(self) -> Process:
        return self

    def __exit__(self, *_: object) -> None:
        if self.running():
            self.end()


def command(arguments: list[str], processes: int = 1) -> list[str]:
    """The command of a unit; with several processes, accelerate starts them."""
    ours = ["-m", "planner_ft", *arguments]
    if processes == 1:
        return [sys.executable, *ours]
    settings = [
        "--num_processes",
        str(processes),
        "--num_machines",
        "1",
        "--mixed_precision",
        "no",
        "--dynamo_backend",
        "no",
        "--multi_gpu",
    ]
    return [sys.executable, "-m", "accelerate.commands.launch", *settings, *ours]


def last_words(log: Path) -> str:
    """The sentence with which a command refused, else the last line that it wrote."""
    lines = [
        line.strip()
        for line in log.read_text(encoding="utf-8", errors="replace").splitlines()
        if line.strip()
    ]
    ours = [line.removeprefix("plannerft: ") for line in lines if line.startswith("plannerft: ")]
    return (ours or lines or [""])[-1]
