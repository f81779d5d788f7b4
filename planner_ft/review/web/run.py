"""Carrying the approved plan out while the page watches: one run at a time, with an abort."""

from __future__ import annotations

import contextlib
import threading
from collections.abc import Callable
from dataclasses import dataclass, field
from itertools import count
from pathlib import Path
from typing import Any

from planner_ft.review.approval import record_run
from planner_ft.review.desk import Desk
from planner_ft.review.web.planning import BusyError, Events
from planner_ft.support.errors import PlannerError

SPEEDS = (1, 2, 5, 10, 20, 50)
"""Simulated seconds in one second."""
RUNNING = "running"
"""The outcome of a run until its files are written."""
PATIENCE = 2.0
"""Seconds within which a run that is aborted has ended; its files come later."""
Frame = dict[str, Any]
"""t (s), pose [x, y, yaw], task, step, skills, left (s): a moment of a run."""


class Stop(threading.Event):
    """Ends a run at its next step once it is set; `reason` stands in its log."""

    reason = ""


Runner = Callable[[Path, Path, Path, str, float, Callable[[Frame], None], Stop], dict[str, Any]]
"""Carries a plan out (planner_ft.simulation.run): the files of plan and log, the folder of the
run, vocabulary, speed, what to call with each frame, and what stops it; gives outcome, reason and
seconds. Raises PlannerError.
"""


@dataclass
class _Run:
    """A run, and everything that was seen of it."""

    desk: Desk
    by: str
    folder: Path
    speed: int
    stop: Stop = field(default_factory=Stop)
    frames: list[Frame] = field(default_factory=list)
    outcome: str = RUNNING
    reason: str = ""

    @property
    def is_on(self) -> bool:
        """Whether it moves."""
        return self.outcome == RUNNING and not self.stop.is_set()


@dataclass
class Runs:
    """The last run of a session. Actions come from any thread."""

    runner: Runner | None
    log: Path
    vocabulary: str
    events: Events
    changed: Callable[[], None]
    last: _Run | None = None
    _thread: threading.Thread | None = None
    _lock: threading.Lock = field(default_factory=threading.Lock)

    def as_json(self) -> dict[str, Any]:
        """The last run without its frames; "status" None before the first."""
        known: dict[str, Any] = {"available": self.runner is not None, "speeds": SPEEDS}
        run = self.last
        if run is None:
            return {**known, "status": None}
        told = {"plan": run.desk.path.name, "by": run.by, "speed": run.speed}
        told |= {"folder": run.folder.name, "reason": run.reason or run.stop.reason}
        return {
            **known,
            **told,
            "status": "stopped" if run.outcome == RUNNING and not run.is_on else run.outcome,
        }

    def track(self) -> dict[str, Any]:
        """All frames so far, for a page that comes later and for the replay."""
        with self._lock:
            return {"frames": list(self.last.frames) if self.last else []}

    def begin(self, desk: Desk, name: str, speed: float) -> None:
        """Run an approved plan. Raises PlannerError, and BusyError while one is run."""
        if self.runner is None:
            raise PlannerError("there is no simulator here; run `plannerft simulate` instead")
        if speed not in SPEEDS:
            raise PlannerError(f"speed {speed:g}: must be one of {', '.join(map(str, SPEEDS))}")
        approval = desk.approval()
        if approval.status != "approved":
            raise PlannerError(f"{desk.path.name}: {approval.text}; approve it before it is run")
        with self._lock:
            if self.last is not None and self.last.is_on:
                problem = f"a run of {self.last.desk.path.name} is on"
                raise BusyError(f"{problem}; abort it, or wait for its end")
            folder = _free(desk.path)
            words = f"simulated, speed {speed:g}, into {folder.name}"
            record_run("run", desk.document, self.log, name, words)
            self.last = _Run(desk, name.strip(), folder, int(speed))
            self._thread = threading.Thread(
                target=self._carry_out, args=(self.runner, self.last), daemon=True
            )
        self._thread.start()
        self.changed()

    def abort(self, name: str) -> None:
        """Stop the run at once: no frame comes after this. Raises PlannerError without one."""
        self._stop(name, "")
        assert self._thread is not None
        self._thread.join(PATIENCE)
        self.changed()

    def end(self) -> None:
        """The server ends, and so does a run."""
        with contextlib.suppress(PlannerError):
            self._stop("", "the review was ended, ")

    def _stop(self, name: str, why: str) -> None:
        with self._lock:
            run = self.last
            if run is None or not run.is_on:
                raise PlannerError("no run is on; there is nothing to abort")
            by = name.strip() or run.by
            run.stop.reason = why.removesuffix(", ") or f"aborted by {by}"
            run.stop.set()
            at = run.frames[-1]["t"] if run.frames else 0.0
        words = f"{why}after {at:g} s, {run.folder.name}"
        record_run("aborted", run.desk.document, self.log, by, words)

    def _carry_out(self, runner: Runner, run: _Run) -> None:
        def tell(frame: Frame) -> None:
            with self._lock:
                if not run.stop.is_set():
                    run.frames.append(frame)
                    self.events.tell("run", frame)

        where = run.desk.path, self.log, run.folder, self.vocabulary, run.speed
        try:
            ended = runner(*where, tell, run.stop)
        except Exception as error:
            text = str(error) if isinstance(error, PlannerError) else repr(error)
            ended = {"outcome": "failed", "reason": text}
        outcome, reason = ended["outcome"], ended["reason"]
        text = f"{outcome}{f': {reason}' if reason else ''}, {run.folder.name}"
        try:
            record_run("ended", run.desk.document, self.log, run.by, text)
        except PlannerError as error:
            reason = f"{reason}; {error}".removeprefix("; ")
        run.outcome, run.reason = outcome, reason
        self.changed()


def _free(plan: Path) -> Path:
    """A folder beside the plan that no run has yet."""
    folders = (plan.with_suffix(f".run-{number:02d}") for number in count(1))
    return next(folder for folder in folders if not folder.exists())
