"""A review in the browser without a browser: a plan on the disk, the application, and a client that
has the key.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from starlette.testclient import TestClient

from planner_ft.document import PlanDocument, build, write_document
from planner_ft.exporters import run as exporting
from planner_ft.planning.result import AgentUse, Answer, Planned, PlannedTask
from planner_ft.planning.settings import PlanSettings
from planner_ft.review.web.app import web_app
from planner_ft.review.web.guard import Door
from planner_ft.review.web.session import Session, WebSettings
from planner_ft.support.manifest import build_manifest
from planner_ft.vocabulary import load_vocabulary
from tests.planning.conftest import FIND_AND_ORBIT, SKILLS, known  # noqa: F401

COMMAND = "Find the green buoy, circle it at 12 m, come home."
MARKUP = """<script>alert(1)</script> & "quoted" </title>\u2028 [bold]x[/bold] \x1b[2J \U0001f6a4"""
PORT = 8765
BASE = f"http://127.0.0.1:{PORT}"
REMOVE = {"kind": "remove", "task": "t4"}


def answer(plan: dict[str, Any]) -> Answer:
    return Answer("", plan, (), (), 3, 10, 6, 0.25)


def planned(command: str = COMMAND) -> Planned:
    """What the agents would give for a command: a search, and two tasks at a place that is open."""
    waits = {1: "green buoy", 2: "green buoy"}
    tasks = tuple(
        PlannedTask(
            task["title"],
            dict(task["parameters"]),
            task["task_prompt"],
            None if index in waits else answer(SKILLS),
            waits.get(index),
        )
        for index, task in enumerate(FIND_AND_ORBIT["tasks"])
    )
    mission = answer(FIND_AND_ORBIT)
    usage = {"mission": AgentUse("embedded", "base", None, 0.5, 1, 1, 1, 1, 1.0)}
    return Planned(
        command,
        mission,
        tasks,
        (),
        usage=usage,
        manifest=build_manifest("plan", seed=None, configuration={}),
    )


def make_document(command: str = COMMAND) -> PlanDocument:
    return build(planned(command), load_vocabulary())


@pytest.fixture
def plan(tmp_path: Path) -> Path:
    """A plan with an open place, on the disk."""
    write_document(tmp_path / "plan.json", make_document())
    return tmp_path / "plan.json"


Serve = Callable[..., TestClient]


@pytest.fixture
def serve_plan(tmp_path: Path) -> Serve:
    """Call it with a plan, or None: a client that has the session's key as a browser of the same
    origin has it. The agents start in a `with` block.
    """

    def make(path: Path | None, **settings: Any) -> TestClient:
        planning = PlanSettings(configuration="base", **settings)
        session = Session(
            path, WebSettings(folder=tmp_path, planning=planning, exporting=exporting)
        )
        door = Door("127.0.0.1", PORT)
        client = TestClient(
            web_app(session, door), base_url=BASE, follow_redirects=False, headers={"Origin": BASE}
        )
        client.cookies.set(door.cookie, door.key)
        client.app_state.update(session=session, door=door)
        return client

    return make


@pytest.fixture
def client(serve_plan: Serve, plan: Path) -> TestClient:
    return serve_plan(plan)


def state(client: TestClient) -> dict[str, Any]:
    answered = client.get("/api/state")
    assert answered.status_code == 200, answered.text
    found: dict[str, Any] = answered.json()
    return found


def post(client: TestClient, address: str, **body: Any) -> Any:
    return client.post(address, json=body)
