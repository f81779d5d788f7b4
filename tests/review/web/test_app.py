"""What a page reads and changes: state, edits, decisions, plans of the folder; and what two people
do to one plan at a time.
"""

from __future__ import annotations

import json
import os
import threading
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from starlette.testclient import TestClient

from planner_ft.document import altered, apply, document_digest, read_document, write_document
from planner_ft.document.edits import KINDS
from planner_ft.review import read_log
from planner_ft.review.web.planning import Planning
from planner_ft.vocabulary import load_vocabulary
from tests.review.web.conftest import COMMAND, MARKUP, REMOVE, Serve, make_document, post, state

LOCATE = {"kind": "locate", "name": "green buoy", "position": [120, -35]}
DOCUMENT = make_document()


def edit(client: TestClient, change: dict[str, Any], revision: str | None = None) -> Any:
    return post(client, "/api/edit", revision=revision or state(client)["revision"], edit=change)


def decide(
    client: TestClient, acknowledged: list[str] | None = None, name: str = "Ada Lind", **body: Any
) -> Any:
    now = state(client)
    ids = (
        [warning["id"] for warning in now["document"]["warnings"]]
        if acknowledged is None
        else acknowledged
    )
    return post(
        client,
        "/api/approve",
        **{"revision": now["revision"], "name": name, "acknowledged": ids, **body},
    )


def test_the_state_has_everything_that_a_page_shows(client: TestClient, plan: Path) -> None:
    shown = state(client)
    document = read_document(plan)
    assert (
        shown["document"] == document
        and shown["path"] == "plan.json"
        and shown["revision"] == document["digest"]
    )
    assert shown["differences"] == [] and shown["busy"] is None and shown["plans"] == ["plan.json"]
    assert shown["approval"]["status"] == "unknown"
    assert [target["name"] for target in shown["track"]["targets"]] == ["green buoy"] and shown[
        "track"
    ]["open"][0] == "t2"
    vocabulary = shown["vocabulary"]
    assert (vocabulary["name"], vocabulary["home"], vocabulary["unresolved"]) == (
        "usv",
        [0, 0],
        [-99, -99],
    )
    orbit = next(task for task in vocabulary["tasks"] if task["title"] == "PerformOrbit")
    radius = next(parameter for parameter in orbit["parameters"] if parameter["name"] == "radius")
    assert (
        set(radius) == {"name", "type", "unit", "required", "minimum", "maximum", "description"}
        and radius["unit"] == "m"
    )
    assert (
        vocabulary["skills"]["GoToXY"]["role"] == "navigation" and len(vocabulary["skills"]) == 37
    )


def test_before_the_first_plan_there_is_none(serve_plan: Serve) -> None:
    client = serve_plan(None)
    shown = state(client)
    assert (
        shown["document"],
        shown["path"],
        shown["revision"],
        shown["track"],
        shown["plans"],
    ) == (None, None, None, None, [])
    refused = post(client, "/api/undo", revision="")
    assert refused.status_code == 409 and "there is no plan yet" in refused.json()["error"]


def test_an_edit_is_on_the_disk_when_it_is_answered(client: TestClient, plan: Path) -> None:
    answered = edit(client, LOCATE)
    assert answered.status_code == 200
    shown, written = answered.json(), read_document(plan)
    assert (
        written == shown["document"]
        and not altered(written)
        and written["digest"] == shown["revision"]
    )
    assert written["located"] == {"green buoy": [120, -35]} and written["open_places"] == []
    assert "green buoy: nothing -> [120,-35]" in [
        difference["text"] for difference in shown["differences"]
    ]
    undone = post(client, "/api/undo", revision=shown["revision"])
    assert undone.json()["document"]["located"] == {} and undone.json()["differences"] == []


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"kind": "parameter", "task": "t3", "name": "radius", "value": -4}, "radius"),
        ({"kind": "parameter", "task": "t3", "name": "radius", "value": "wide"}, "radius"),
        ({"kind": "parameter", "task": "t9", "name": "radius", "value": 4}, "task t9"),
        ({"kind": "fly"}, "'fly'"),
        ({}, "is none that a page makes"),
        ({"kind": "replace", "tasks": []}, "is none that a page makes"),
        ({"kind": "skills", "task": "t1", "skill_sequence": []}, "is none that a page makes"),
        ({"kind": "locate", "name": "lighthouse", "position": [1, 2]}, "lighthouse"),
        ({"kind": "locate", "name": "green buoy", "position": [1e400, 2]}, "Infinity"),
    ],
)
def test_an_edit_that_cannot_be_made_is_refused_in_a_sentence_and_changes_nothing(
    client: TestClient, plan: Path, change: dict[str, Any], said: str
) -> None:
    before = plan.read_bytes()
    text = json.dumps({"revision": state(client)["revision"], "edit": change})
    refused = client.post("/api/edit", content=text, headers={"Content-Type": "application/json"})
    assert (
        refused.status_code == 422
        and said in refused.json()["error"]
        and "\n" not in refused.json()["error"]
    )
    assert plan.read_bytes() == before


@pytest.mark.parametrize(
    ("path", "body", "said"),
    [
        ("/api/edit", {"edit": REMOVE}, "revision must be a text"),
        ("/api/edit", {"revision": 7, "edit": REMOVE}, "revision must be a text"),
        ("/api/edit", {"revision": "x", "edit": [REMOVE]}, "edit must be an object"),
        (
            "/api/approve",
            {"revision": "x", "name": "Ada", "acknowledged": "all"},
            "acknowledged must be a list of texts",
        ),
        (
            "/api/approve",
            {"revision": "x", "name": "Ada", "acknowledged": [1]},
            "acknowledged must be a list of texts",
        ),
        ("/api/reject", {"revision": "x", "name": "Ada"}, "reason must be a text"),
        ("/api/plan", {"command": ["x"]}, "command must be a text"),
        ("/api/plan", {"command": "x", "locate": {"buoy": "1,2"}}, "locate must be an object"),
        ("/api/plan", {"command": "x", "locate": {"buoy": [True, 2]}}, "locate must be an object"),
        ("/api/plan", {"command": " \n"}, "the command is empty"),
        (
            "/api/plan",
            {"command": "go " * 7000},
            "the command has 21000 characters, and at most 20000 are planned",
        ),
        ("/api/plan", {"command": "x" * 100_000}, "the command has 100000 characters"),
        ("/api/open", {}, "path must be a text"),
        ("/api/skills", {"revision": "x"}, "task must be a text"),
    ],
)
def test_a_request_that_lacks_something_is_refused_in_a_sentence(
    client: TestClient, path: str, body: dict[str, Any], said: str
) -> None:
    refused = post(client, path, **body)
    assert refused.status_code == 422 and said in refused.json()["error"]


def test_of_two_browsers_that_change_one_plan_the_second_is_told(
    serve_plan: Serve, plan: Path
) -> None:
    ada, ben = serve_plan(plan), serve_plan(plan)
    revision = state(ben)["revision"]
    assert edit(ada, REMOVE, revision).status_code == 200
    late = edit(ben, LOCATE, revision)
    assert late.status_code == 409 and "somebody else" in late.json()["error"]
    assert (
        len(late.json()["state"]["document"]["tasks"]) == 3
        and late.json()["state"]["revision"] == state(ada)["revision"]
    )
    assert edit(ben, LOCATE).status_code == 200
    assert len(read_document(plan)["tasks"]) == 3 and read_document(plan)["located"]


@pytest.mark.parametrize("path", ["/api/undo", "/api/skills", "/api/approve", "/api/reject"])
def test_nothing_is_done_to_a_plan_that_is_another_by_now(
    client: TestClient, plan: Path, path: str
) -> None:
    body = {
        "revision": state(client)["revision"],
        "task": "t1",
        "name": "Ada",
        "acknowledged": [],
        "reason": "No.",
    }
    edit(client, REMOVE)
    before = plan.read_bytes()
    late = post(client, path, **body)
    assert late.status_code == 409 and late.json()["state"]["revision"] == state(client)["revision"]
    assert plan.read_bytes() == before and not (plan.parent / "approvals.jsonl").exists()


def test_of_many_changes_at_the_same_time_one_is_made(serve_plan: Serve, plan: Path) -> None:
    clients = [serve_plan(plan) for _ in range(3)]
    revision = state(clients[0])["revision"]
    statuses: list[int] = []

    def change(number: int) -> None:
        body = {"kind": "prompt", "task": "t1", "text": f"Find the buoy, try {number}."}
        statuses.append(edit(clients[number % 3], body, revision).status_code)

    threads = [threading.Thread(target=change, args=(number,)) for number in range(12)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert sorted(statuses) == [200] + [409] * 11 and len(read_document(plan)["edits"]) == 1


def test_what_somebody_else_wrote_is_shown_and_not_overwritten(
    client: TestClient, plan: Path
) -> None:
    before = state(client)["revision"]
    write_document(plan, apply(read_document(plan), REMOVE, load_vocabulary(), by="the terminal"))
    late = edit(client, LOCATE, before)
    assert late.status_code == 409 and len(late.json()["state"]["document"]["tasks"]) == 3
    assert state(client)["document"]["edits"][0]["by"] == "the terminal"


def test_what_was_changed_by_hand_is_shown_as_that_and_not_built_upon(
    client: TestClient, plan: Path
) -> None:
    document = json.loads(plan.read_text())
    document["tasks"][2]["parameters"]["radius"] = 50
    plan.write_text(json.dumps(document))
    shown = state(client)
    assert (
        shown["revision"] == document_digest(document) != document["digest"]
        and shown["approval"]["status"] == "altered"
    )
    before = plan.read_bytes()
    for refused in (edit(client, LOCATE), decide(client)):
        assert refused.status_code == 422 and "by hand" in refused.json()["error"]
    assert plan.read_bytes() == before and not (plan.parent / "approvals.jsonl").exists()


def test_a_file_that_is_cut_in_half_is_a_sentence_until_it_is_whole_again(
    client: TestClient, plan: Path
) -> None:
    whole = plan.read_bytes()
    plan.write_bytes(whole[: len(whole) // 2])
    broken = client.get("/api/state")
    assert (
        broken.status_code == 422
        and "plan.json:" in broken.json()["error"]
        and "not JSON" in broken.json()["error"]
    )
    assert post(client, "/api/edit", revision="x", edit=REMOVE).status_code == 422
    plan.write_bytes(whole)
    assert state(client)["document"]["command"] == COMMAND
    plan.unlink()
    assert "no such file" in client.get("/api/state").json()["error"]


def test_an_approval_needs_a_name_and_every_warning(client: TestClient, plan: Path) -> None:
    ids = [warning["id"] for warning in state(client)["document"]["warnings"]]
    assert "unresolved-location:green buoy" in ids
    refused = decide(client, acknowledged=ids[1:])
    assert (
        refused.status_code == 422
        and refused.json()["missing"] == ids[:1]
        and "not acknowledged" in refused.json()["error"]
    )
    assert (
        decide(client, name=" ").status_code == 422
        and decide(client, acknowledged=["made-up"]).status_code == 422
    )
    assert read_log(plan.parent / "approvals.jsonl") == ()
    approved = decide(client)
    assert (
        approved.status_code == 200
        and approved.json()["approval"]["status"] == "approved"
        and approved.json()["approval"]["reviewer"] == "Ada Lind"
    )
    (record,) = read_log(plan.parent / "approvals.jsonl")
    assert (
        record["plan"] == read_document(plan)
        and [warning["id"] for warning in record["acknowledged"]] == ids
    )


def test_an_edit_ends_an_approval_and_a_rejection_withdraws_it(client: TestClient) -> None:
    decide(client)
    rejected = post(
        client,
        "/api/reject",
        revision=state(client)["revision"],
        name="Ben",
        reason="Too close to the ferry.",
    )
    assert (
        rejected.json()["approval"]["status"] == "rejected"
        and "Too close to the ferry." in rejected.json()["approval"]["text"]
    )
    assert decide(client).json()["approval"]["status"] == "approved"
    assert edit(client, REMOVE).json()["approval"]["status"] == "altered"
    assert (
        post(
            client, "/api/reject", revision=state(client)["revision"], name="Ben", reason=" "
        ).status_code
        == 422
    )


def test_a_decision_of_the_terminal_is_seen(client: TestClient, plan: Path) -> None:
    from planner_ft.review import approve, log_beside

    assert state(client)["approval"]["status"] == "unknown"
    approve(read_document(plan), log_beside(plan), "Ben", ["all"])
    assert state(client)["approval"]["reviewer"] == "Ben"


def test_a_log_that_was_tampered_with_is_said(client: TestClient, plan: Path) -> None:
    decide(client)
    log = plan.parent / "approvals.jsonl"
    log.write_text(log.read_text().replace("Ada Lind", "Eve Lind"))
    shown = state(client)
    assert (
        shown["approval"]["status"] == "unknown"
        and "approvals.jsonl" in shown["approval"]["text"]
        and "changed" in shown["approval"]["text"]
    )
    refused = decide(client)
    assert refused.status_code == 422 and "approvals.jsonl" in refused.json()["error"]


def test_another_plan_of_the_folder_is_shown_when_asked_for(client: TestClient, plan: Path) -> None:
    write_document(plan.parent / "other.json", make_document("Go home."))
    os.utime(plan.parent / "other.json", (1, 1))
    assert state(client)["plans"] == ["plan.json", "other.json"]
    opened = post(client, "/api/open", path="other.json")
    assert (
        opened.status_code == 200
        and opened.json()["document"]["command"] == "Go home."
        and opened.json()["path"] == "other.json"
    )
    (plan.parent / "half.json").write_bytes(plan.read_bytes()[:300])
    assert (
        post(client, "/api/open", path="half.json").status_code == 422
        and state(client)["path"] == "other.json"
    )


def test_what_a_command_says_travels_as_it_is(serve_plan: Serve, tmp_path: Path) -> None:
    write_document(tmp_path / "plan.json", make_document(MARKUP))
    answered = serve_plan(tmp_path / "plan.json").get("/api/state")
    assert answered.json()["document"]["command"] == MARKUP
    assert (
        answered.headers["content-type"] == "application/json"
        and answered.headers["x-content-type-options"] == "nosniff"
    )


def test_the_page_and_its_files_are_served_with_their_types(client: TestClient) -> None:
    assert client.get("/").headers["content-type"].startswith("text/html")
    client.cookies.clear()
    script = client.get("/static/main.js")
    assert script.status_code == 200 and script.headers["content-type"].startswith(
        "text/javascript"
    )


WORDS = ["", "t1", "t3", "green buoy", "radius", "center", "navigation", MARKUP]
VALUES = st.recursive(
    st.none() | st.booleans() | st.integers(-3, 10**19) | st.floats() | st.sampled_from(WORDS),
    lambda inner: (
        st.lists(inner, max_size=3)
        | st.dictionaries(st.sampled_from(["name", "title", "id", "x"]), inner, max_size=3)
    ),
    max_leaves=4,
)
KEYS = (
    "task",
    "name",
    "value",
    "position",
    "text",
    "to",
    "at",
    "title",
    "parameters",
    "task_prompt",
    "skill_sequence",
    "step",
    "role",
    "index",
    "tasks",
    "id",
)
EDITS = st.fixed_dictionaries(
    {"kind": st.sampled_from([*KINDS, None, [], {}])}, optional=dict.fromkeys(KEYS, VALUES)
)


@settings(max_examples=30, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(change=EDITS)
def test_any_edit_is_made_or_refused_in_a_sentence(
    serve_plan: Serve, plan: Path, change: dict[str, Any]
) -> None:
    client = serve_plan(plan)
    write_document(plan, DOCUMENT)
    text = json.dumps({"revision": state(client)["revision"], "edit": change})
    answered = client.post("/api/edit", content=text, headers={"Content-Type": "application/json"})
    assert answered.status_code in (200, 422) and (
        answered.status_code == 200 or len(answered.json()["error"]) > 10
    )
    assert read_document(plan) == state(client)["document"] and not altered(read_document(plan))


def test_a_command_that_is_not_english_is_a_question_until_it_is_overruled(
    client: TestClient, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(Planning, "ask", lambda *_work: None)
    german = "Fahre zur Boje, umkreise sie und komm wieder nach Hause."
    asked = post(client, "/api/plan", command=german)
    assert asked.status_code == 422
    assert "it is not English" in asked.json()["question"]
    assert post(client, "/api/plan", command=german, sure=True).status_code == 202
    assert post(client, "/api/plan", command="Come home.").status_code == 202


def test_an_edit_is_made_in_the_name_that_is_given(client: TestClient, plan: Path) -> None:
    revision = state(client)["revision"]
    refused = post(client, "/api/edit", revision=revision, edit=REMOVE, by="A\x1bda")
    assert refused.status_code == 422
    after = post(client, "/api/edit", revision=revision, edit=REMOVE, by="Ada").json()
    assert after["document"]["edits"][-1]["by"] == "Ada"
    assert after["differences"][-1]["by"] == "Ada"


def test_only_an_approved_plan_is_exported(client: TestClient) -> None:
    refused = post(client, "/api/export", revision=state(client)["revision"], formats=["bt"])
    assert refused.status_code == 422
    assert "approve it" in refused.json()["error"]
