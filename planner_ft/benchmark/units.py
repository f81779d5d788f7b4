"""Units of work, a process each and one after the other: finished ones are left as they are, a
failure is named, and the time left is said. Suites and learning curves are lists of them.
"""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager
from dataclasses import dataclass, field, fields
from pathlib import Path
from typing import Any, NamedTuple

from planner_ft.benchmark.folder import LATENCY, PLANNING, PREDICTIONS
from planner_ft.benchmark.settings import BenchSettings
from planner_ft.support.files import read_json, write_json
from planner_ft.support.resources import clock, end_with_parent

UNIT = "unit.json"  # the file that a finished unit has
LOGS = (PREDICTIONS, LATENCY, PLANNING)
POLL, PATIENCE = 1.0, 20.0
"""Seconds between looks at a process, and that one which is ended has to go by itself."""
LAUNCH = ["--num_machines", "1", "--mixed_precision", "no", "--dynamo_backend", "no", "--multi_gpu"]


@dataclass(frozen=True)
class Unit:
    """A unit in a folder: some `queries` that take a time in proportion to `weight`, and other work
    before them.
    """

    name: str
    folder: Path
    queries: int
    weight: float = 1.0
    before: float = 0.0

    def written(self) -> int:
        """Answers and timed queries that are there. Folders may go while it looks: trainings drop
        their older checkpoints.
        """
        walked = ((folder, {*LOGS} & {*names}) for folder, _below, names in os.walk(self.folder))
        paths = (Path(folder, name) for folder, names in walked for name in names)
        return sum(path.read_bytes().count(b"\n") for path in paths)

    def done(self) -> float:
        """How much of the work is done."""
        made = self.weight * min(self.written(), self.queries)
        return made + (self.before if made else 0)

    def asked(self) -> dict[str, Any]:
        """All that its figures depend on, apart from the code that scores."""
        return {}

    def is_finished(self) -> bool:
        path = self.folder / UNIT
        return path.is_file() and read_json(path).get("fingerprint", {}) == self.asked()

    def steps(self) -> Iterator[tuple[str, list[str], Path]]:
        """What is run: a name, the arguments of `plannerft`, the log of what they print."""
        raise NotImplementedError


class State(NamedTuple):
    """The unit that runs (counted from 1), its step and queries, seconds left in all if known."""

    number: int
    units: int
    unit: Unit
    step: str
    left: float | None

    def __str__(self) -> str:
        done = min(self.unit.written(), self.unit.queries)
        left = f", {clock(self.left)} left in all" if self.left is not None else ""
        said = f"{self.unit.name}: {self.step}, {done}/{self.unit.queries} queries{left}"
        return f"({self.number}/{self.units}) {said}"


@dataclass
class Units:
    """Units that are run, each process shared by `processes`; one without a new answer for
    `stall_minutes` is ended. `seconds` is the time of those that ran, `finished` names those that
    were finished before.
    """

    units: Sequence[Unit]
    report: Callable[[State], None]
    processes: int = 1
    stall_minutes: float = float("inf")
    seconds: dict[str, float] = field(default_factory=dict)
    finished: list[str] = field(default_factory=list)

    def run(self) -> Iterator[tuple[Unit, str, str, Path]]:
        """Run what is not finished; yields failures: the unit, its step, why, and the log."""
        before, begun = sum(one.done() for one in self.units), time.monotonic()
        for index, unit in enumerate(self.units):
            if unit.is_finished():
                self.finished.append(unit.name)
                continue
            started, problem = time.monotonic(), None
            for step, arguments, log in unit.steps():
                with Process(arguments, log, self.processes) as process:
                    problem = self._watch(index, step, process, before, begun)
                self.seconds[unit.name] = round(time.monotonic() - started, 1)
                if problem is not None:
                    yield unit, step, problem, log
                    break
            if problem is None and unit.name in self.seconds:
                record = {"fingerprint": unit.asked(), "seconds": self.seconds[unit.name]}
                write_json(unit.folder / UNIT, record)

    def _watch(
        self, index: int, step: str, process: Process, before: float, begun: float
    ) -> str | None:
        """Wait for a process; returns why it failed."""
        unit, last, written = self.units[index], time.monotonic(), -1
        while True:
            running, now = process.running(), time.monotonic()
            left = self._left(index, before, now - begun)
            self.report(State(index + 1, len(self.units), unit, step, left))
            if not running:
                return process.problem()
            if (count := unit.written()) > written:
                last, written = now, count
            elif now - last > self.stall_minutes * 60:
                process.end()
                problem = f"no new answer for {self.stall_minutes} minutes, so its process was"
                return f"{problem} ended; what was answered is kept"
            time.sleep(POLL)

    def _left(self, index: int, before: float, seconds: float) -> float | None:
        """Seconds for the work that is left, at the pace of what was done since the beginning."""
        done = [(one, one.done()) for one in self.units]
        coming = [(one, so_far) for one, so_far in done[index:] if one.name not in self.finished]
        work = ((one.before + one.weight * one.queries, so_far) for one, so_far in coming)
        ahead = sum(max(0.0, whole - so_far) for whole, so_far in work)
        made = sum(so_far for _one, so_far in done) - before
        return seconds * ahead / made if made > 0 else None


def arguments(settings: BenchSettings) -> list[str]:
    """The arguments of `plannerft` that make a run with these settings, or go on with it."""
    found = ["bench"]
    for one in fields(settings):
        value = getattr(settings, one.name)
        if value != one.default:
            name = one.name.replace("_", "-").replace("adapters", "adapter")
            found += [f"--{name}", ",".join(value) if isinstance(value, tuple) else str(value)]
    return [*found, "--resume", "--no-report"]


class Process(AbstractContextManager["Process"]):
    """A unit's process, ended with its parent and the `with` block, its output in a log."""

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
                process_group=0,
            )

    def running(self) -> bool:
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
        """Why it failed: the sentence with which a command refused, else its last line, or None."""
        code = self.child.wait()
        if code == 0:
            return None
        if code < 0:
            hint = ", most likely for want of memory" if -code == signal.SIGKILL else ""
            return f"its process was ended by {signal.Signals(-code).name}{hint}"
        text = self.log.read_text(encoding="utf-8", errors="replace")
        lines = [line.strip() for line in text.splitlines() if line.strip()]
        ours = [line for line in lines if line.startswith("plannerft: ")] or lines
        return ours[-1].removeprefix("plannerft: ") if ours else f"its process ended with {code}"

    def __exit__(self, *_: object) -> None:
        if self.running():
            self.end()


def command(arguments: list[str], processes: int = 1) -> list[str]:
    """The command of a unit; with several processes, accelerate starts them."""
    launcher = ["-m", "accelerate.commands.launch", "--num_processes", str(processes), *LAUNCH]
    shared = launcher if processes > 1 else []
    return [sys.executable, *shared, "-m", "planner_ft", *arguments]
