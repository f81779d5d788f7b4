"""An approved plan that is run from the page: frames, abort, log, and what is refused."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from starlette.testclient import TestClient

from planner_ft.document import read_document, write_document
from planner_ft.planning.settings import PlanSettings
from planner_ft.review import log_beside, read_log
from planner_ft.review.approval import approval_of
from planner_ft.review.web.app import web_app
from planner_ft.review.web.guard import Door
from planner_ft.review.web.run import Runner
from planner_ft.review.web.session import Session, WebSettings
from planner_ft.simulation import output
from planner_ft.simulation.run import run_live
from tests.documents import document
from tests.review.web.conftest import BASE, PORT, post, state
from tests.simulation.plans import saved, transit

LONG = 60.0
"""Seconds of the clock that nothing here takes."""
Open = Callable[..., TestClient]


@pytest.fixture
def opened(monkeypatch: pytest.MonkeyPatch) -> Iterator[Open]:
    """A client of a review whose page can run plans."""
    monkeypatch.setattr(output, "track_svg", lambda _done: "<svg/>")
    sessions: list[Session] = []

    def open_plan(path: Path, runner: Runner | None = run_live) -> TestClient:
        settings = WebSettings(planning=PlanSettings(configuration="base"), runner=runner)
        session, door = Session(path, settings), Door("127.0.0.1", PORT)
        client = TestClient(web_app(session, door), base_url=BASE, headers={"Origin": BASE})
        client.cookies.set(door.cookie, door.key)
        sessions.append(session)
        return client

    yield open_plan
    for session in sessions:
        session.runs.end()


def begin(client: TestClient, **more: Any) -> Any:
    revision = state(client)["revision"]
    given = {"revision": revision, "name": "Ada Lind", "speed": 50, **more}
    return post(client, "/api/run", **given)


def frames(client: TestClient) -> list[dict[str, Any]]:
    found: list[dict[str, Any]] = client.get("/api/track").json()["frames"]
    return found


def until(client: TestClient, holds: Callable[[], bool]) -> None:
    end = time.monotonic() + LONG
    while not holds():
        assert time.monotonic() < end
        time.sleep(0.05)


def events(plan: Path) -> list[tuple[str, str]]:
    return [(one["event"], one["reason"]) for one in read_log(log_beside(plan))][1:]


def test_a_run_is_watched_to_its_end_and_stands_in_the_log(opened: Open, tmp_path: Path) -> None:
    plan = saved(tmp_path, [transit(20, 0), transit(0, 0)])
    client = opened(plan)
    assert state(client)["run"]["status"] is None and frames(client) == []
    assert begin(client).json()["run"]["status"] == "running"
    until(client, lambda: state(client)["run"]["status"] != "running")
    seen, run = frames(client), state(client)["run"]
    assert (run["status"], run["by"], run["folder"]) == ("done", "Ada Lind", "plan.run-01")
    assert [one["t"] for one in seen] == sorted({one["t"] for one in seen}) and len(seen) > 3
    assert [one["over"] for one in seen] == [False] * (len(seen) - 1) + [True]
    assert max(one["pose"][0] for one in seen) > 15
    assert {one["task"] for one in seen} == {"t1", "t2"}
    assert all(one["skills"][0] == "GoToXY" and one["step"] == 0 for one in seen)
    assert seen[0]["left"] > 20 > seen[-1]["left"]
    assert (tmp_path / "plan.run-01" / "report.html").exists()
    assert events(plan) == [
        ("run", "simulated, speed 50, into plan.run-01"),
        ("ended", "done, plan.run-01"),
    ]
    # Records of runs decide nothing.
    assert approval_of(read_document(plan), log_beside(plan)).status == "approved"
    assert begin(client).json()["run"]["folder"] == "plan.run-02"


def test_an_abort_stops_the_vehicle_at_once(opened: Open, tmp_path: Path) -> None:
    plan = saved(tmp_path, [transit(200, 0)])
    client = opened(plan)
    begin(client, speed=1)
    until(client, lambda: len(frames(client)) > 2)
    aborted = post(client, "/api/abort", name="Bo")
    at_once = frames(client)
    assert aborted.status_code == 200 and aborted.json()["run"]["status"] == "stopped"
    until(client, lambda: (tmp_path / "plan.run-01" / "results.json").exists())
    assert frames(client) == at_once
    told = (tmp_path / "plan.run-01" / "run-01.jsonl").read_text().splitlines()
    assert '"text":"stopped: aborted by Bo"' in told[-1]
    until(client, lambda: len(events(plan)) == 3)
    assert [event for event, _reason in events(plan)] == ["run", "aborted", "ended"]
    assert events(plan)[2][1] == "stopped: aborted by Bo, plan.run-01"
    assert float(events(plan)[1][1].split()[1]) == at_once[-1]["t"]
    again = post(client, "/api/abort", name="Bo")
    assert again.status_code == 422 and "nothing to abort" in again.json()["error"]
    assert begin(client).status_code == 200


def test_a_run_ends_with_its_review(opened: Open, tmp_path: Path) -> None:
    plan = saved(tmp_path, [transit(200, 0)])
    client = opened(plan)
    with client:
        begin(client, speed=1)
        until(client, lambda: len(frames(client)) > 0)
    assert events(plan)[1][0] == "aborted" and events(plan)[1][1].startswith("the review was ended")
    until(client, lambda: len(events(plan)) == 3)
    assert events(plan)[2][1] == "stopped: the review was ended, plan.run-01"


def test_what_cannot_be_run_is_told(opened: Open, tmp_path: Path) -> None:
    plan = saved(tmp_path, [transit(200, 0)])
    client = opened(plan)
    cases: list[tuple[dict[str, Any], int, str]] = [
        ({"name": " "}, 422, "needs the name"),
        ({"speed": 3}, 422, "must be one of 1, 2"),
        ({"speed": "fast"}, 422, "speed must be a number"),
        ({"revision": "0" * 64}, 409, "changed"),
    ]
    for given, status, text in cases:
        refused = begin(client, **given)
        assert (refused.status_code, text in refused.json()["error"]) == (status, True)
    assert events(plan) == [] and state(client)["run"]["status"] is None
    begin(client, speed=1)
    second = begin(client)
    assert second.status_code == 409 and "abort it, or wait" in second.json()["error"]
    alone = opened(plan, runner=None)
    assert "there is no simulator here" in begin(alone).json()["error"]


def test_a_plan_that_nobody_approved_is_not_run(opened: Open, tmp_path: Path) -> None:
    plan = tmp_path / "plan.json"
    write_document(plan, document([transit(5, 0)]))
    refused = begin(opened(plan))
    assert refused.status_code == 422 and "approve it before it is run" in refused.json()["error"]
    assert not log_beside(plan).exists()


def test_a_run_that_fails_says_why(opened: Open, tmp_path: Path) -> None:
    plan = saved(tmp_path, [transit(5, 0)], chart={"buoy": (0.5, 0.0)})
    client = opened(plan)
    begin(client)
    until(client, lambda: state(client)["run"]["status"] == "failed")
    assert "would start in buoy" in state(client)["run"]["reason"]
    assert "would start in buoy" in events(plan)[1][1]
