"""Running a suite: unit after unit, a process each; one that fails is named, the others go on."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, NamedTuple

from planner_ft.benchmark import folder
from planner_ft.benchmark.suite.definition import Suite
from planner_ft.benchmark.suite.units import LOG, Process, Unit, arguments, fingerprint, make_units
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_json, write_json

SUITE, UNIT = "suite.json", "unit.json"
POLL = 1.0
"""Seconds between looks at the files of a unit's process."""


class State(NamedTuple):
    """The unit that runs (counted from 1), its queries, and seconds left in all, None: unknown."""

    unit: int
    units: int
    name: str
    done: int
    total: int
    left: float | None


Report = Callable[[State], None]


@dataclass
class Session:
    """A suite in a folder. `changes` are settings of the command line, `before` the queries of each
    unit that were there, `failures` reasons by (unit, configuration), `seconds` the time of each
    unit that ran, `finished` the units that an earlier session finished.
    """

    suite: Suite
    out: Path
    units: list[Unit]
    report: Report
    changes: dict[str, Any]
    processes: int
    clock: Callable[[], float] = time.monotonic
    sleep: Callable[[float], None] = time.sleep
    start: Callable[[list[str], Path, int], Process] = Process
    before: dict[str, int] = field(default_factory=dict)
    failures: dict[tuple[str, str], str] = field(default_factory=dict)
    seconds: dict[str, float] = field(default_factory=dict)
    finished: list[str] = field(default_factory=list)

    def run(self) -> None:
        """Run every unit that is not finished."""
        self.before, begun = {one.name: _written(one) for one in self.units}, self.clock()
        for index, unit in enumerate(self.units):
            plan, failed = unit.planned()
            self._fail(unit, failed)
            if plan is None:
                continue
            where, asked = plan.settings.folder, fingerprint(plan)
            recorded = read_json(where / UNIT) if (where / UNIT).is_file() else {}
            if (where / folder.RESULTS).is_file() and recorded.get("fingerprint") == asked:
                self.finished.append(unit.name)
                continue
            self.units[index], started = replace(unit, settings=plan.settings), self.clock()
            with self.start(arguments(plan.settings), where / LOG, self.processes) as process:
                problem = self._watch(index, process, begun)
            seconds = self.seconds[unit.name] = round(self.clock() - started, 1)
            if problem is None:
                write_json(where / UNIT, {"fingerprint": asked, "seconds": seconds})
            else:
                self._fail(unit, dict.fromkeys(plan.settings.configurations, problem))

    def _watch(self, index: int, process: Process, begun: float) -> str | None:
        """Wait for a process; returns why it failed. One that stalls is ended."""
        unit, last, minutes = self.units[index], self.clock(), self.suite.stall_minutes
        written = _written(unit, folder.PLANNING)
        while process.running():
            self.report(self._state(index, begun))
            self.sleep(POLL)
            if (now := _written(unit, folder.PLANNING)) > written:
                last, written = self.clock(), now
            elif self.clock() - last > minutes * 60:
                process.end()
                problem = f"no new answer for {minutes} minutes, so its process was ended"
                return f"{problem}; what was answered is kept"
        self.report(self._state(index, begun))
        return process.problem()

    def _fail(self, unit: Unit, reasons: dict[str, str]) -> None:
        self.failures |= {(unit.name, name): reason for name, reason in reasons.items()}

    def _state(self, index: int, begun: float) -> State:
        """The time left: the queries left at this session's pace, in proportion to sizes."""
        unit = self.units[index]
        written = {one.name: _written(one) for one in self.units}
        size = {one.name: one.candidate.parameters or 1 for one in self.units}
        left = {
            one.name: max(0, one.queries - written[one.name])
            for one in self.units[index:]
            if one.name not in self.finished
        }
        made = sum(size[name] * (count - self.before[name]) for name, count in written.items())
        ahead = sum(size[name] * count for name, count in left.items())
        seconds = (self.clock() - begun) * ahead / made if made else None
        done = unit.queries - left[unit.name]
        return State(index + 1, len(self.units), unit.name, done, unit.queries, seconds)


def _written(unit: Unit, *also: str) -> int:
    """Answers and timed queries in a unit's folder, and lines of other files."""
    paths = [unit.settings.folder / one for one in (folder.PREDICTIONS, folder.LATENCY, *also)]
    return sum(path.read_bytes().count(b"\n") for path in paths if path.is_file())


def opened(
    suite: Suite,
    out: Path,
    changes: dict[str, Any],
    report: Report,
    *,
    processes: int = 1,
    resume: bool = False,
    overwrite: bool = False,
) -> Session:
    """A suite in its folder, checked; whoever calls holds the folder. `changes` are settings of the
    command line, and `processes` share each run. Raises PlannerError, also when data changed since
    an earlier session.
    """
    units = make_units(suite, out, changes)
    folder.check_folder(out, () if resume or overwrite else (SUITE,), folder.GO_ON)
    if overwrite:
        (out / SUITE).unlink(missing_ok=True)
        for unit in units:
            folder.clear(unit.settings.folder, (*folder.ALL, UNIT, LOG))
    path = out / SUITE
    data: dict[str, str] = read_json(path)["data"] if path.is_file() else {}
    for unit in units:
        if data.setdefault(unit.part.name, unit.data.sha256) != unit.data.sha256:
            way = "restore it, give --overwrite to start anew, or another --out"
            raise PlannerError(f"{unit.data.path}: changed since {out} was begun; {way}")
    write_json(path, {"title": suite.title, "suite": str(suite.path), "data": data})
    return Session(suite, out, units, report, changes, processes)
