"""The last run of a session with a runner that does what it is told: what a page is shown."""

from __future__ import annotations

import threading
from pathlib import Path
from typing import Any

import pytest

from planner_ft.document import PlanDocument, read_document, write_document
from planner_ft.review import approve, log_beside, read_log
from planner_ft.review.desk import open_desk
from planner_ft.review.web import run
from planner_ft.review.web.planning import Events
from planner_ft.review.web.run import Runs, _free
from planner_ft.support.errors import PlannerError
from tests.review.web.conftest import make_document

SPEEDS = (1, 2, 5, 10, 20, 50)


class Runner:
    """Tells two frames, waits to be stopped or let go, and ends as it is told."""

    def __init__(
        self, outcome: str = "done", reason: str = "", error: Exception | None = None
    ) -> None:
        self.outcome, self.reason, self.error = outcome, reason, error
        self.told, self.go, self.ended = threading.Event(), threading.Event(), threading.Event()
        self.given: tuple[Any, ...] = ()

    def __call__(self, *given: Any) -> dict[str, Any]:
        self.given = given[:5]
        tell, stop = given[5:]
        for second in (0.5, 2.25):
            tell({"t": second})
        self.told.set()
        self.go.wait(60)
        tell({"t": 9.0})
        self.ended.set()
        if self.error:
            raise self.error
        return {"outcome": self.outcome, "reason": self.reason or stop.reason}


@pytest.fixture
def approved(tmp_path: Path) -> Path:
    write_document(tmp_path / "plan.json", make_document())
    document: PlanDocument = read_document(tmp_path / "plan.json")
    approve(document, log_beside(tmp_path / "plan.json"), "Ann", ["all"])
    return tmp_path / "plan.json"


def runs(plan: Path, runner: Runner | None) -> Runs:
    return Runs(runner, log_beside(plan), "usv", Events(), lambda: None)


def over(own: Runs) -> None:
    assert own._thread is not None
    own._thread.join(60)


def records(plan: Path) -> list[tuple[str, str, str]]:
    read = read_log(log_beside(plan))[1:]
    return [(one["event"], one["reviewer"], one["reason"]) for one in read]


def test_a_run_from_its_beginning_to_its_end(approved: Path) -> None:
    runner = Runner()
    own = runs(approved, runner)
    assert own.as_json() == {"available": True, "speeds": SPEEDS, "status": None}
    assert runs(approved, None).as_json()["available"] is False and own.track() == {"frames": []}
    own.begin(open_desk(approved, None, None, None), " Bo ", 5.0)
    assert runner.told.wait(60)
    shown = {"plan": "plan.json", "by": "Bo", "speed": 5, "folder": "plan.run-01", "reason": ""}
    assert own.as_json() == {"available": True, "speeds": SPEEDS, **shown, "status": "running"}
    with pytest.raises(PlannerError, match=r"a run of plan\.json is on; abort it"):
        own.begin(open_desk(approved, None, None, None), "Bo", 5)
    runner.go.set()
    over(own)
    assert own.as_json()["status"] == "done"
    assert own.track() == {"frames": [{"t": 0.5}, {"t": 2.25}, {"t": 9.0}]}
    assert runner.given[2:] == (approved.with_suffix(".run-01"), "usv", 5)
    assert records(approved) == [
        ("run", "Bo", "simulated, speed 5, into plan.run-01"),
        ("ended", "Bo", "done, plan.run-01"),
    ]
    with pytest.raises(PlannerError, match="nothing to abort"):
        own.abort("Bo")
    own.end()


@pytest.mark.parametrize(("name", "by"), [("Cy", "Cy"), (" ", "Bo")])
def test_no_frame_comes_after_an_abort(approved: Path, name: str, by: str) -> None:
    runner = Runner("stopped")
    own = runs(approved, runner)
    own.begin(open_desk(approved, None, None, None), "Bo", 1)
    assert runner.told.wait(60)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(run, "PATIENCE", 0.01)
        own.abort(name)
    assert own.as_json()["status"] == "stopped"
    assert own.as_json()["reason"] == f"aborted by {by}"
    runner.go.set()
    over(own)
    assert own.track()["frames"][-1] == {"t": 2.25}
    assert records(approved)[1:] == [
        ("aborted", by, "after 2.25 s, plan.run-01"),
        ("ended", "Bo", f"stopped: aborted by {by}, plan.run-01"),
    ]


def test_a_run_that_ends_with_the_review_says_so(approved: Path) -> None:
    runner = Runner("stopped")
    own = runs(approved, runner)
    own.begin(open_desk(approved, None, None, None), "Bo", 1)
    assert runner.told.wait(60)
    own.end()
    runner.go.set()
    over(own)
    assert records(approved)[1] == (
        "aborted",
        "Bo",
        "the review was ended, after 2.25 s, plan.run-01",
    )
    assert own.as_json()["reason"] == "the review was ended"


@pytest.mark.parametrize(
    ("error", "reason"), [(PlannerError("no"), "no"), (ValueError("x"), "ValueError('x')")]
)
def test_a_runner_that_fails_is_a_run_that_failed(
    approved: Path, error: Exception, reason: str
) -> None:
    runner = Runner(error=error)
    runner.go.set()
    own = runs(approved, runner)
    own.begin(open_desk(approved, None, None, None), "Bo", 50)
    over(own)
    assert (own.as_json()["status"], own.as_json()["reason"]) == ("failed", reason)
    assert records(approved)[1][2] == f"failed: {reason}, plan.run-01"


@pytest.mark.parametrize("speed", [0, 0.5, 3, 51, 100])
def test_there_are_six_speeds(approved: Path, speed: float) -> None:
    own = runs(approved, Runner())
    with pytest.raises(PlannerError, match=f"speed {speed:g}: must be one of 1, 2, 5, 10, 20, 50"):
        own.begin(open_desk(approved, None, None, None), "Bo", speed)
    assert own.last is None


def test_the_folders_of_runs_are_numbered_from_one(tmp_path: Path) -> None:
    for number in (1, 2, 3):
        folder = _free(tmp_path / "plan.json")
        assert folder.name == f"plan.run-{number:02d}"
        folder.mkdir()
    assert run.PATIENCE == 2
