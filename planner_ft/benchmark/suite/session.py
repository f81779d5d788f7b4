"""Running a suite: unit after unit, each in a process of its own; one that fails is named and the
others go on.
"""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

from planner_ft.benchmark import folder
from planner_ft.benchmark.records import Line, Tail
from planner_ft.benchmark.suite.definition import Suite
from planner_ft.benchmark.suite.estimate import Kind, Pace, Work, time_left
from planner_ft.benchmark.suite.units import LOG, UNIT, Flags, Process, Unit, make_units
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_json, write_json
from planner_ft.vocabulary import Vocabulary, load_vocabulary

SUITE = "suite.json"
POLL = 1.0
"""Seconds between looks at the files of a unit's process."""
WRITTEN: dict[str, tuple[Kind, str]] = {
    folder.PREDICTIONS: ("answers", "time_s"),
    folder.LATENCY: ("latency", "latency_s"),
}
"""The kind of queries of each file, and the field with their seconds."""


@dataclass
class State:
    """The state of a session: the unit that runs (counted from 1), its queries, and seconds left,
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
    start: Callable[[list[str], Path, int], Process] = Process
    pace: Pace = field(default_factory=Pace)
    counts: Counter[tuple[str, str, Kind]] = field(default_factory=Counter)
    failures: dict[tuple[str, str, str], str] = field(default_factory=dict)
    seconds: dict[str, float] = field(default_factory=dict)
    skipped: list[str] = field(default_factory=list)

    def run(self) -> None:
        """Run every unit that is not finished."""
        names = (*WRITTEN, folder.PLANNING)
        written = {one.name: Tail(*(one.folder / name for name in names)) for one in self.units}
        for unit in self.units:
            self._read(unit, written[unit.name].new())
        for index, unit in enumerate(self.units):
            self._fail(unit, unit.failed)
            if unit.configurations and unit.finished(self.vocabulary):
                self.skipped.append(unit.name)
            elif unit.configurations:
                self._run_unit(index, unit, written[unit.name])

    def _run_unit(self, index: int, unit: Unit, written: Tail) -> None:
        started = self.clock()
        with self.start(unit.arguments(), unit.folder / LOG, unit.flags.processes) as process:
            problem, answered = self._watch(index, unit, written, process)
        seconds = self.seconds[unit.name] = self.clock() - started
        if problem is not None:
            self._fail(unit, dict.fromkeys(unit.configurations, problem))
            return
        self.pace.add_overhead(unit.candidate.name, seconds - answered)
        unit.finish(self.vocabulary, seconds)

    def _watch(
        self, index: int, unit: Unit, written: Tail, process: Process
    ) -> tuple[str | None, float]:
        """(why the process failed or None, seconds that it answered). A process that stalls is
        ended.
        """
        last, answered, minutes = self.clock(), 0.0, self.suite.stall_minutes
        while process.running():
            self.report(self._state(index, unit, begun=answered > 0))
            self.sleep(POLL)
            new = written.new()
            answered += self._read(unit, new)
            last = self.clock() if new else last
            if self.clock() - last > minutes * 60:
                process.end()
                problem = f"no new answer for {minutes} minutes, so its process was ended"
                return f"{problem}; what was answered is kept", answered
        answered += self._read(unit, written.new())
        self.report(self._state(index, unit, begun=True))
        return process.problem(), answered

    def _read(self, unit: Unit, records: list[tuple[str, Line]]) -> float:
        """Count new records; return the seconds that they took, those of answers divided among the
        processes that share them.
        """
        total = 0.0
        for name, record in records:
            if name not in WRITTEN:
                continue
            kind, key = WRITTEN[name]
            configuration, seconds = str(record.get("configuration")), record.get(key)
            self.counts[unit.name, configuration, kind] += 1
            if isinstance(seconds, int | float):
                seconds /= unit.flags.processes if kind == "answers" else 1
                self.pace.add(_work(unit, configuration, kind, 1), seconds)
                total += seconds
        return total

    def _fail(self, unit: Unit, reasons: dict[str, str]) -> None:
        for configuration, reason in reasons.items():
            self.failures[unit.part.name, unit.candidate.name, configuration] = reason

    def _state(self, index: int, unit: Unit, *, begun: bool) -> State:
        own = self._left(unit)
        open_units = (other for other in self.units[index + 1 :] if other.configurations)
        later = [other for other in open_units if other.name not in self.skipped]
        work = [*own, *(part for other in later for part in self._left(other))]
        starting = [other.candidate.name for other in ([] if begun else [unit]) + later]
        each = len(unit.data.samples) + unit.latency_samples
        total = len(unit.configurations) * each
        done = total - sum(part.count for part in own)
        left = time_left(self.pace, work, starting)
        return State(index + 1, len(self.units), unit.name, done, total, left)

    def _left(self, unit: Unit) -> list[Work]:
        samples, timed = len(unit.data.samples), unit.latency_samples
        totals: dict[Kind, int] = {"answers": samples, "latency": timed}
        return [
            _work(unit, name, kind, max(0, total - self.counts[unit.name, name, kind]))
            for name in unit.configurations
            for kind, total in totals.items()
        ]


def _work(unit: Unit, configuration: str, kind: Kind, count: int) -> Work:
    candidate = unit.candidate
    return Work(candidate.name, unit.part.level, configuration, kind, count, candidate.parameters)


def opened(
    suite: Suite,
    out: Path,
    flags: Flags,
    report: Report,
    *,
    resume: bool = False,
    overwrite: bool = False,
) -> Session:
    """A suite in its folder, checked; whoever calls holds the folder. Raises PlannerError, also
    when data changed since an earlier session.
    """
    vocabulary = load_vocabulary(suite.vocabulary)
    units = make_units(suite, vocabulary, out, flags)
    if not (resume or overwrite):
        hint = "give --resume to go on, --overwrite to start anew, or another --out"
        folder.check_folder(out, (SUITE,), hint)
    folder.check_writable(out)
    if overwrite:
        (out / SUITE).unlink(missing_ok=True)
        for unit in units:
            folder.clear(unit.folder, (*folder.ALL, UNIT, LOG))
    _record(suite, units, out)
    return Session(suite, vocabulary, out, units, report)


def _record(suite: Suite, units: list[Unit], out: Path) -> None:
    """Write suite.json, and refuse data that changed since it was begun with."""
    path = out / SUITE
    data: dict[str, str] = read_json(path)["data"] if path.is_file() else {}
    for unit in units:
        if data.setdefault(unit.part.name, unit.data.sha256) != unit.data.sha256:
            way = "restore it, give --overwrite to start anew, or another --out"
            raise PlannerError(f"{unit.part.data}: changed since {out} was begun; {way}")
    write_json(path, {"title": suite.title, "suite": str(suite.path), "data": data})
