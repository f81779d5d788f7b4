"""The units of a suite: a candidate on a data set, each a process and a run folder of its own."""

from __future__ import annotations

import signal
import subprocess
import sys
from dataclasses import dataclass, fields, replace
from pathlib import Path
from typing import Any

from planner_ft.benchmark.plan import Plan, make_plan
from planner_ft.benchmark.samples import BenchData, load_bench_data
from planner_ft.benchmark.settings import BenchSettings
from planner_ft.benchmark.suite.definition import Part, Suite
from planner_ft.candidates import Candidate, resolve_candidate
from planner_ft.support.errors import PlannerError
from planner_ft.support.resources import end_with_parent
from planner_ft.vocabulary import load_vocabulary

LOG = "log.txt"
PATIENCE = 20.0
"""Seconds that an ended process has to go by itself."""
LAUNCH = ["--num_machines", "1", "--mixed_precision", "no", "--dynamo_backend", "no", "--multi_gpu"]


@dataclass(frozen=True)
class Unit:
    """One candidate on one data set, as the run that `settings` describe."""

    part: Part
    candidate: Candidate
    data: BenchData
    settings: BenchSettings

    @property
    def name(self) -> str:
        return f"{self.part.name}, {self.candidate.name}"

    @property
    def queries(self) -> int:
        """Answers and timed queries."""
        each = len(self.data.samples) + self.settings.latency_samples
        return each * len(self.settings.configurations)

    def planned(self) -> tuple[Plan | None, dict[str, str]]:
        """The run of the configurations that can be run, and why the others cannot."""
        settings, failed = self.settings, dict[str, str]()
        try:
            return make_plan(settings), failed
        except PlannerError as error:
            if len(settings.configurations) == 1:
                return None, {settings.configurations[0]: str(error)}
        for one in settings.configurations:
            failed |= replace(self, settings=replace(settings, configurations=(one,))).planned()[1]
        runs = tuple(name for name in settings.configurations if name not in failed)
        return make_plan(replace(settings, configurations=runs)) if runs else None, failed


def make_units(suite: Suite, out: Path, changes: dict[str, Any]) -> list[Unit]:
    """Every candidate on every data set, with the command line's `changes`. Raises PlannerError."""
    parts: list[tuple[Part, BenchData]] = []
    for part in suite.parts:
        limits = (part.settings.limit, changes.get("limit"))
        limit = min((one for one in limits if one is not None), default=None)
        settings = replace(part.settings, **changes | {"limit": limit})
        vocabulary = load_vocabulary(settings.vocabulary)
        data = load_bench_data(settings.data or "", settings.level, vocabulary, limit)
        timed = min(settings.latency_samples, len(data.samples))
        parts.append((replace(part, settings=replace(settings, latency_samples=timed)), data))
    candidates: dict[str, Candidate] = {}
    for name in suite.candidates:
        # A folder relative to the suite file, else a name or a hub id.
        folder = suite.path.parent / name
        candidate = resolve_candidate(str(folder) if folder.is_dir() else name)
        if candidate.slug in candidates:
            way = "leave one out, or rename its folder"
            raise PlannerError(f"{suite.path}: two candidates are named {candidate.slug}; {way}")
        candidates[candidate.slug] = candidate
    units = []
    for slug, candidate in candidates.items():
        for part, data in parts:
            adapter = suite.adapters.get(candidate.name, {}).get(part.settings.level)
            settings = replace(
                part.settings,
                candidates=(candidate.given_as,),
                adapters=(str(adapter),) if adapter else (),
                out=out / part.name / slug,
            )
            units.append(Unit(part, candidate, data, settings))
    return units


def arguments(settings: BenchSettings) -> list[str]:
    """The arguments of `plannerft` that make a run with these settings, or go on with it."""
    found = ["bench"]
    for one in fields(settings):
        value = getattr(settings, one.name)
        if value != one.default:
            name = one.name.replace("_", "-").replace("adapters", "adapter")
            found += [f"--{name}", ",".join(value) if isinstance(value, tuple) else str(value)]
    return [*found, "--resume", "--no-report"]


def fingerprint(plan: Plan) -> dict[str, Any]:
    """Everything that the figures of a run depend on, apart from the code that scores."""
    asked = replace(plan.settings, out=None)
    return {"arguments": arguments(asked), "keys": {job.name: job.key for job in plan.jobs}}


class Process:
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

    def __enter__(self) -> Process:
        return self

    def __exit__(self, *_: object) -> None:
        if self.running():
            self.end()


def command(arguments: list[str], processes: int = 1) -> list[str]:
    """The command of a unit; with several processes, accelerate starts them."""
    launcher = ["-m", "accelerate.commands.launch", "--num_processes", str(processes), *LAUNCH]
    shared = launcher if processes > 1 else []
    return [sys.executable, *shared, "-m", "planner_ft", *arguments]
