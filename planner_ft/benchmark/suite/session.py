"""Running a suite: unit after unit, each in a process of its own; one that fails is named and the
others go on.
"""

from __future__ import annotations

import contextlib
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from planner_ft.benchmark import folder
from planner_ft.benchmark.folder import PLANNING, PREDICTIONS
from planner_ft.benchmark.suite.definition import Suite
from planner_ft.benchmark.suite.estimate import Kind, Pace, Work, time_left
from planner_ft.benchmark.suite.process import LOG, Process
from planner_ft.benchmark.suite.units import Flags, Unit, Written, make_units
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_json, write_json
from planner_ft.vocabulary import Vocabulary, load_vocabulary

SUITE, LOCK = "suite.json", ".suite.lock"
POLL = 1.0
"""Seconds between looks at what a unit's process has written."""


@dataclass
class State:
    """Where a session stands: the unit that runs (counted from 1), its queries, and seconds left,
    None while nothing can be said.
    """

    unit: int
    units: int
    name: str
    done: int
    total: int
    left: float | None


Report = Callable[[State], None]


@dataclass
class Session:
    """A suite in a folder. `failures` are reasons by (part, candidate, configuration), `seconds`
    the time of each unit that ran.
    """

    suite: Suite
    vocabulary: Vocabulary
    out: Path
    units: list[Unit]
    report: Report
    clock: Callable[[], float] = time.monotonic
    sleep: Callable[[float], None] = time.sleep
    pace: Pace = field(default_factory=Pace)
    counts: dict[tuple[str, str, Kind], int] = field(default_factory=dict)
    failures: dict[tuple[str, str, str], str] = field(default_factory=dict)
    seconds: dict[str, float] = field(default_factory=dict)
    skipped: list[str] = field(default_factory=list)
    start: Callable[[list[str], Path, int], Process] = Process

    def run(self) -> None:
        """Run every unit that is not finished."""
        written = {unit.name: unit.progress() for unit in self.units}
        for unit in self.units:
            self._read(unit, written[unit.name].new())
        for index, unit in enumerate(self.units):
            self._fail(unit, unit.failed)
            if not unit.configurations:
                continue
            if unit.finished(self.vocabulary):
                self.skipped.append(unit.name)
                continue
            self._run_unit(index, unit, written[unit.name])

    def _run_unit(self, index: int, unit: Unit, written: Written) -> None:
        started = self.clock()
        with self.start(unit.arguments(), unit.folder / LOG, unit.flags.processes) as process:
            problem, answered = self._watch(index, unit, written, process)
        self.seconds[unit.name] = self.clock() - started
        if problem is not None:
            self._fail(unit, dict.fromkeys(unit.configurations, problem))
            return
        self.pace.add_overhead(unit.candidate.name, self.seconds[unit.name] - answered)
        unit.finish(self.vocabulary, self.seconds[unit.name])

    def _watch(
        self, index: int, unit: Unit, written: Written, process: Process
    ) -> tuple[str | None, float]:
        """(why the process failed or None, seconds that it answered). A process that stalls is
        ended.
        """
        last, answered = self.clock(), 0.0
        while process.running():
            self.report(self._state(index, unit, begun=answered > 0))
            self.sleep(POLL)
            new = written.new()
            answered += self._read(unit, new)
            last = self.clock() if new else last
            if self.clock() - last > self.suite.stall_minutes * 60:
                process.end()
                return (
                    (
                        f"no new answer for {self.suite.stall_minutes} minutes, so its process was"
                        " ended; what was answered is kept"
                    ),
                    answered,
                )
        answered += self._read(unit, written.new())
        self.report(self._state(index, unit, begun=True))
        return process.problem(), answered

    def _read(self, unit: Unit, records: list[tuple[str, dict[str, Any]]]) -> float:
        """Count what was written; return the seconds that it took, those of answers divided among
        the processes that share them.
        """
        total = 0.0
        for name, record in records:
            if name == PLANNING:
                continue
            kind: Kind = "answers" if name == PREDICTIONS else "latency"
            configuration = str(record.get("configuration"))
            seconds = record.get("time_s" if kind == "answers" else "latency_s")
            self.counts[unit.name, configuration, kind] = (
                self.counts.get((unit.name, configuration, kind), 0) + 1
            )
            if isinstance(seconds, int | float):
                seconds /= unit.flags.processes if kind == "answers" else 1
                self.pace.add(_work(unit, configuration, kind, 1), seconds)
                total += seconds
        return total

    def _fail(self, unit: Unit, reasons: dict[str, str]) -> None:
        self.failures.update(
            {
                (unit.part.name, unit.candidate.name, configuration): reason
                for configuration, reason in reasons.items()
            }
        )

    def _state(self, index: int, unit: Unit, *, begun: bool) -> State:
        work = self._left(unit)
        total = sum(_total(unit, kind) for _configuration in unit.configurations for kind in KINDS)
        later = [
            other
            for other in self.units[index + 1 :]
            if other.configurations and other.name not in self.skipped
        ]
        left = time_left(
            self.pace,
            [*work, *(part for other in later for part in self._left(other))],
            [other.candidate.name for other in ([] if begun else [unit]) + later],
        )
        return State(
            index + 1,
            len(self.units),
            unit.name,
            total - sum(part.count for part in work),
            total,
            left,
        )

    def _left(self, unit: Unit) -> list[Work]:
        return [
            _work(
                unit,
                configuration,
                kind,
                max(0, _total(unit, kind) - self.counts.get((unit.name, configuration, kind), 0)),
            )
            for configuration in unit.configurations
            for kind in KINDS
        ]


KINDS: tuple[Kind, ...] = ("answers", "latency")


def _total(unit: Unit, kind: Kind) -> int:
    return len(unit.data.samples) if kind == "answers" else unit.latency_samples


def _work(unit: Unit, configuration: str, kind: Kind, count: int) -> Work:
    return Work(
        unit.candidate.name, unit.part.level, configuration, kind, count, unit.candidate.parameters
    )


@contextlib.contextmanager
def opened(
    suite: Suite,
    out: Path,
    flags: Flags,
    report: Report,
    *,
    resume: bool = False,
    overwrite: bool = False,
) -> Iterator[Session]:
    """A suite in its folder, checked and locked. Raises PlannerError, also when data changed since
    an earlier session.
    """
    vocabulary = load_vocabulary(suite.vocabulary)
    units = make_units(suite, vocabulary, out, flags)
    if not (resume or overwrite):
        folder.check_folder(
            out, (SUITE,), "give --resume to go on, --overwrite to start anew, or another --out"
        )
    folder.check_writable(out)
    with _locked(out):
        if overwrite:
            _clear(units)
        _record(suite, units, out, overwrite)
        yield Session(suite, vocabulary, out, units, report)


def _clear(units: list[Unit]) -> None:
    from planner_ft.benchmark.suite.units import UNIT

    for unit in units:
        folder.clear(unit.folder, (*folder.ALL, UNIT, LOG))


def _record(suite: Suite, units: list[Unit], out: Path, overwrite: bool) -> None:
    """Write suite.json, and refuse data that changed since it was begun with."""
    path = out / SUITE
    before: dict[str, str] = read_json(path)["data"] if path.is_file() and not overwrite else {}
    data = {unit.part.name: unit.data.sha256 for unit in units}
    changed = [
        unit.part
        for unit in units
        if before.get(unit.part.name, unit.data.sha256) != unit.data.sha256
    ]
    if changed:
        raise PlannerError(
            f"{changed[0].data}: changed since {out} was begun; restore it, give --overwrite to"
            " start anew, or another --out"
        )
    write_json(path, {"title": suite.title, "suite": str(suite.path), "data": {**before, **data}})


@contextlib.contextmanager
def _locked(out: Path) -> Iterator[None]:
    """Hold the folder: two sessions would start the same units."""
    try:
        import fcntl
    except ImportError:  # not on Windows
        yield
        return
    with open(out / LOCK, "w") as stream:
        try:
            fcntl.flock(stream, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise PlannerError(
                f"{out}: another suite is running here; wait for it or give another --out"
            ) from None
        yield
