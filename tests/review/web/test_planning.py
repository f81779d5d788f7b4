"""The agents behind the page: watched while they plan, asked for one task again, absent, at work,
broken.
"""

from __future__ import annotations

import asyncio
import json
import threading
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from starlette.testclient import TestClient

from planner_ft.decoding.engine import Engine
from planner_ft.document import read_document
from planner_ft.review.desk import add_plan
from planner_ft.review.web.planning import MOST_WAITING, Events
from planner_ft.support.errors import PlannerError
from tests.planning.conftest import FIND_AND_ORBIT, HOLD, SKILLS, Known, KnownAnswers, mission, task
from tests.review.web.conftest import COMMAND, MARKUP, REMOVE, Serve, post, state

Told = list[tuple[str, Any]]


class Listener:
    """A page that is open: what it was told, by one thread that listens as long as the test
    lasts.
    """

    def __init__(self, events: Events) -> None:
        self.told: Told = []
        self.news = threading.Condition()
        self.thread = threading.Thread(
            target=lambda: asyncio.run(self._listen(events)), daemon=True
        )
        self.listening = threading.Event()
        self.thread.start()
        assert self.listening.wait(600)

    async def _listen(self, events: Events) -> None:
        async for text in events.listen():
            self.listening.set()
            if text.startswith("event: "):
                kind, data = text.strip().split("\n")
                with self.news:
                    self.told.append(
                        (kind.removeprefix("event: "), json.loads(data.removeprefix("data: ")))
                    )
                    self.news.notify_all()

    def until(self, enough: Callable[[Told], bool]) -> Told:
        with self.news:
            assert self.news.wait_for(lambda: enough(self.told), 30), self.told
            return list(self.told)

    def kinds(self) -> list[str]:
        return [kind for kind, _data in self.told]


def saw(kind: str) -> Callable[[Told], bool]:
    return lambda told: any(heard == kind for heard, _data in told)


def rested(client: TestClient) -> Callable[[Told], bool]:
    """Whether the agents have done what they were asked, and the pages were told."""
    return lambda told: (
        bool(told) and told[-1][0] == "state" and client.app_state["session"].planning.busy is None
    )


@pytest.fixture
def held(
    monkeypatch: pytest.MonkeyPatch, known: Known
) -> Iterator[tuple[threading.Event, KnownAnswers]]:
    """Agents whose answers wait until the event is set."""
    engine, go = known(), threading.Event()
    answer = engine.answer

    def wait(query: Any, configuration: object) -> Any:
        assert go.wait(600)
        return answer(query, configuration)

    monkeypatch.setattr(engine, "answer", wait)
    yield go, engine
    go.set()


def test_a_page_watches_the_agents_and_sees_the_plan_that_was_saved_beside_the_former(
    serve_plan: Serve, plan: Path, known: Known
) -> None:
    known()
    before = plan.read_bytes()
    with serve_plan(plan) as client:
        page = Listener(client.app_state["session"].events)
        assert post(client, "/api/plan", command=COMMAND).status_code == 202
        told = page.until(lambda told: saw("skills")(told) and rested(client)(told))
        shown = state(client)
    kinds = [kind for kind, _data in told]
    assert (
        kinds.index("progress") < kinds.index("tasks") < kinds.index("skills")
        and kinds[-1] == "state"
    )
    tasks = next(data for kind, data in told if kind == "tasks")["tasks"]
    assert [(entry["id"], entry["title"], entry.get("waits_for")) for entry in tasks][1] == (
        "t2",
        "Transit",
        "green buoy",
    )
    assert [data for kind, data in told if kind == "skills"] == [
        {"task": "t1", "skill_sequence": [HOLD]},
        {"task": "t4", "skill_sequence": [HOLD]},
    ]
    steps = [data for kind, data in told if kind == "progress" and data["label"] == "Task Agent"]
    assert [(data["done"], data["total"]) for data in steps] == [(0, 2), (1, 2), (2, 2)] and steps[
        0
    ]["what"] == "planning"
    new = plan.parent / shown["path"]
    assert (
        new != plan
        and new.name.startswith("plan-2")
        and read_document(new) == shown["document"]
        and shown["document"]["command"] == COMMAND
    )
    assert plan.read_bytes() == before and sorted(shown["plans"]) == sorted([plan.name, new.name])
    assert told[-1][1]["revision"] == shown["revision"]


def test_places_can_be_given_with_the_command(serve_plan: Serve, known: Known) -> None:
    known()
    with serve_plan(None) as client:
        page = Listener(client.app_state["session"].events)
        post(client, "/api/plan", command=COMMAND, locate={"green buoy": [120, -35.5]})
        page.until(lambda told: saw("skills")(told) and rested(client)(told))
        assert (
            state(client)["document"]["located"] == {"green buoy": [120, -35.5]}
            and state(client)["document"]["complete"]
        )


def test_a_command_with_markup_comes_back_as_it_was_given(
    serve_plan: Serve, known: Known, tmp_path: Path
) -> None:
    known()
    with serve_plan(None) as client:
        page = Listener(client.app_state["session"].events)
        assert post(client, "/api/plan", command=MARKUP, sure=True).status_code == 202
        busy = state(client)["busy"]
        assert busy is None or busy["command"] == MARKUP
        told = page.until(lambda told: saw("skills")(told) and rested(client)(told))
        assert next(data for kind, data in told if kind == "progress")["command"] == MARKUP
        assert state(client)["document"]["command"] == MARKUP
    assert [read_document(path)["command"] for path in tmp_path.glob("plan-*.json")] == [MARKUP]


def test_two_plans_of_one_second_do_not_meet(plan: Path) -> None:
    written = [add_plan(plan.parent, read_document(plan)) for _ in range(5)]
    assert len({path.name for path in written}) == 5 and all(path.is_file() for path in written)


def test_while_the_agents_work_nothing_else_is_asked_of_them_but_the_plan_can_be_reviewed(
    serve_plan: Serve, plan: Path, held: tuple[threading.Event, KnownAnswers]
) -> None:
    with serve_plan(plan) as client:
        page = Listener(client.app_state["session"].events)
        assert post(client, "/api/plan", command="Go home.").status_code == 202
        busy = state(client)["busy"]
        assert busy["what"] == "planning" and busy["command"] == "Go home."
        second = post(client, "/api/plan", command="Go home again.")
        assert second.status_code == 409 and "at work already" in second.json()["error"]
        again = post(client, "/api/skills", revision=state(client)["revision"], task="t1")
        assert again.status_code == 409
        assert (
            post(client, "/api/edit", revision=state(client)["revision"], edit=REMOVE).status_code
            == 200
        )
        held[0].set()
        page.until(lambda told: saw("tasks")(told) and rested(client)(told))
        assert state(client)["busy"] is None and state(client)["document"]["command"] == "Go home."
        assert post(client, "/api/plan", command="Go home again.").status_code == 202


def test_a_page_that_comes_late_hears_what_was_known_of_the_plan_before(
    serve_plan: Serve, known: Known, monkeypatch: pytest.MonkeyPatch
) -> None:
    engine, go = known(), threading.Event()
    answer = engine.answer

    def wait(query: Any, configuration: object) -> Any:
        assert query.level == "mission" or go.wait(600)
        return answer(query, configuration)

    monkeypatch.setattr(engine, "answer", wait)
    with serve_plan(None) as client:
        events = client.app_state["session"].events
        early = Listener(events)
        post(client, "/api/plan", command=COMMAND)
        early.until(saw("tasks"))
        late = Listener(events)
        assert late.until(saw("tasks"))[0][0] == "tasks"
        go.set()
        early.until(rested(client))
        after = Listener(events)
        assert after.told == []


def test_the_skills_of_one_task_are_asked_for_again_and_become_an_edit(
    serve_plan: Serve, plan: Path, known: Known
) -> None:
    other = {**HOLD, "navigation_skill": {"name": "StationKeep", "parameters": {"time": 90}}}
    engine = known(FIND_AND_ORBIT, {"skill_sequence": [other]})
    with serve_plan(plan) as client:
        page = Listener(client.app_state["session"].events)
        assert (
            post(client, "/api/skills", revision=state(client)["revision"], task="t1").status_code
            == 202
        )
        page.until(lambda told: saw("progress")(told) and rested(client)(told))
        shown = state(client)
    assert (
        shown["document"]["tasks"][0]["skill_sequence"] == [other]
        and read_document(plan) == shown["document"]
    )
    assert shown["document"]["edits"][-1]["edit"]["kind"] == "skills"
    assert [level for level, _record in engine.asked] == ["task"]


def test_skills_of_a_task_that_was_edited_meanwhile_are_not_taken(
    serve_plan: Serve, plan: Path, held: tuple[threading.Event, KnownAnswers]
) -> None:
    with serve_plan(plan) as client:
        page = Listener(client.app_state["session"].events)
        post(client, "/api/skills", revision=state(client)["revision"], task="t1")
        post(
            client,
            "/api/edit",
            revision=state(client)["revision"],
            edit={"kind": "prompt", "task": "t1", "text": "Find the red buoy."},
        )
        held[0].set()
        told = page.until(lambda told: saw("error")(told) and rested(client)(told))
        assert (
            next(data for kind, data in told if kind == "error")["error"]
            == "task t1 was edited while its skills were planned; ask again"
        )
        assert [record["edit"]["kind"] for record in state(client)["document"]["edits"]] == [
            "prompt"
        ]


def test_skills_reach_a_plan_in_which_another_task_was_edited_meanwhile(
    serve_plan: Serve, plan: Path, held: tuple[threading.Event, KnownAnswers]
) -> None:
    with serve_plan(plan) as client:
        page = Listener(client.app_state["session"].events)
        post(client, "/api/skills", revision=state(client)["revision"], task="t1")
        post(client, "/api/edit", revision=state(client)["revision"], edit=REMOVE)
        held[0].set()
        page.until(lambda told: len(told) > 2 and rested(client)(told))
        assert [record["edit"]["kind"] for record in state(client)["document"]["edits"]] == [
            "remove",
            "skills",
        ]


def test_skills_for_a_task_whose_place_is_open_are_not_asked_for(client: TestClient) -> None:
    refused = post(client, "/api/skills", revision=state(client)["revision"], task="t2")
    assert refused.status_code == 422 and "its place is not known yet" in refused.json()["error"]
    assert (
        post(client, "/api/skills", revision=state(client)["revision"], task="t9").status_code
        == 422
    )


@pytest.mark.parametrize(
    ("answers", "said"),
    [
        ((FIND_AND_ORBIT, "no JSON"), "task t1: the Task Agent's answer is not valid"),
        (
            (
                FIND_AND_ORBIT,
                {
                    "skill_sequence": [
                        {**HOLD, "navigation_skill": {"name": "Teleport", "parameters": {}}}
                    ]
                },
            ),
            "not valid",
        ),
    ],
)
def test_an_answer_that_is_not_valid_leaves_the_task_as_it_is(
    serve_plan: Serve, plan: Path, known: Known, answers: Any, said: str
) -> None:
    known(*answers)
    before = plan.read_bytes()
    with serve_plan(plan) as client:
        page = Listener(client.app_state["session"].events)
        post(client, "/api/skills", revision=state(client)["revision"], task="t1")
        told = page.until(lambda told: saw("error")(told) and rested(client)(told))
        assert said in next(data for kind, data in told if kind == "error")["error"]
    assert plan.read_bytes() == before


def test_a_mission_answer_that_is_not_valid_is_shown_with_its_problems(
    serve_plan: Serve, known: Known
) -> None:
    known(mission(task("Teleport", "Go.")))
    with serve_plan(None) as client:
        page = Listener(client.app_state["session"].events)
        post(client, "/api/plan", command="Go.")
        page.until(lambda told: saw("progress")(told) and rested(client)(told))
        document = state(client)["document"]
        assert not document["valid"] and "Teleport" in document["problems"][0]


def test_a_mistake_of_the_operator_becomes_an_event_in_one_sentence(
    serve_plan: Serve, plan: Path, known: Known
) -> None:
    known("", ids=(), finish_reason="error", error="the prompt of 9000 tokens is too long")
    with serve_plan(plan) as client:
        page = Listener(client.app_state["session"].events)
        post(client, "/api/plan", command=COMMAND)
        told = page.until(lambda told: saw("error")(told) and rested(client)(told))
        assert (
            "shorten the command" in next(data for kind, data in told if kind == "error")["error"]
        )
        assert state(client)["path"] == "plan.json" and state(client)["plans"] == ["plan.json"]


def test_agents_that_fail_say_so_and_can_be_asked_again(
    serve_plan: Serve, known: Known, monkeypatch: pytest.MonkeyPatch
) -> None:
    engine = known()
    answer, failed = engine.answer, []

    def fail_once(query: Any, configuration: object) -> Any:
        if not failed:
            failed.append(query)
            raise RuntimeError("out of memory\nwith a long trace")
        return answer(query, configuration)

    monkeypatch.setattr(engine, "answer", fail_once)
    with serve_plan(None) as client:
        page = Listener(client.app_state["session"].events)
        post(client, "/api/plan", command=COMMAND)
        told = page.until(lambda told: saw("error")(told) and rested(client)(told))
        assert next(data for kind, data in told if kind == "error") == {
            "error": "the agents failed (RuntimeError: out of memory)"
        }
        assert post(client, "/api/plan", command=COMMAND).status_code == 202
        page.until(lambda told: saw("skills")(told) and rested(client)(told))


@pytest.mark.parametrize(
    ("error", "said"),
    [
        (PlannerError("the adapter is cut"), "the adapter is cut"),
        (OSError("bad file"), "OSError: bad file"),
    ],
)
def test_without_agents_the_plan_is_reviewed_all_the_same(
    serve_plan: Serve, plan: Path, monkeypatch: pytest.MonkeyPatch, error: Exception, said: str
) -> None:
    def fail(*_arguments: object, **_settings: object) -> Engine:
        raise error

    monkeypatch.setattr(Engine, "load", fail)
    with serve_plan(plan) as client:
        page = Listener(client.app_state["session"].events)
        page.until(lambda told: not client.app_state["session"].planning.as_json()["available"])
        planner = state(client)["planner"]
        assert (
            not planner["available"]
            and said in planner["why"]
            and planner["candidate"] == "embedded"
        )
        refused = post(client, "/api/plan", command=COMMAND)
        assert (
            refused.status_code == 422
            and said in refused.json()["error"]
            and state(client)["busy"] is None
        )
        assert (
            post(client, "/api/edit", revision=state(client)["revision"], edit=REMOVE).status_code
            == 200
        )


def test_a_candidate_that_is_not_there_is_named(serve_plan: Serve, plan: Path) -> None:
    with serve_plan(plan, candidate="nobody/knows-this") as client:
        page = Listener(client.app_state["session"].events)
        page.until(lambda told: client.app_state["session"].planning.why is not None)
        assert "nobody/knows-this" in state(client)["planner"]["why"]


def test_what_others_write_is_told_to_the_pages(serve_plan: Serve, plan: Path) -> None:
    session = serve_plan(plan).app_state["session"]
    page = Listener(session.events)
    session.look()
    plan.write_bytes(plan.read_bytes() + b"\n")
    session.look()
    session.look()
    page.until(saw("state"))
    assert page.kinds() == ["state"]


def test_a_page_that_does_not_listen_is_given_up() -> None:
    async def story() -> list[str]:
        events = Events()
        listening = events.listen()
        heard = [await anext(listening)]
        for number in range(MOST_WAITING + 10):
            events.tell("progress", {"done": number})
            await asyncio.sleep(0)
        return heard + [text async for text in listening]

    assert len(asyncio.run(story())) == MOST_WAITING + 1


def test_when_the_server_ends_every_connection_does() -> None:
    async def story() -> list[str]:
        events = Events()
        listening = events.listen()
        heard = [await anext(listening)]
        events.close()
        events.tell("progress", {})
        return heard + [text async for text in listening] + [text async for text in events.listen()]

    assert asyncio.run(story()) == [": connected\n\n"]


def test_skills_known_are_told_also_where_they_are_not_valid(
    serve_plan: Serve, known: Known
) -> None:
    known(FIND_AND_ORBIT, SKILLS, "no JSON")
    with serve_plan(None) as client:
        page = Listener(client.app_state["session"].events)
        post(client, "/api/plan", command=COMMAND)
        told = page.until(lambda told: saw("skills")(told) and rested(client)(told))
        assert [data["skill_sequence"] for kind, data in told if kind == "skills"] == [[HOLD], None]
        assert not state(client)["document"]["valid"]
