"""Who may talk to the server, and what of it: other sites, other names, other users, too much."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from starlette.testclient import TestClient

from planner_ft.review.web.guard import HEADERS, Door
from planner_ft.review.web.session import WebSettings
from tests.review.web.conftest import PORT, REMOVE, state


def door(client: TestClient) -> Door:
    found: Door = client.app_state["door"]
    return found


def edit(client: TestClient, headers: dict[str, str] | None = None) -> Any:
    return client.post(
        "/api/edit",
        json={"revision": state(client)["revision"], "edit": REMOVE},
        headers=headers or {},
    )


def without_origin(client: TestClient) -> TestClient:
    del client.headers["origin"]
    return client


def test_the_key_in_the_address_becomes_a_cookie_that_no_script_and_no_other_site_has(
    client: TestClient,
) -> None:
    key = door(client).key
    client.cookies.clear()
    answered = client.get(f"/?token={key}")
    assert (answered.status_code, answered.headers["location"]) == (303, "/")
    name, _equals, rest = answered.headers["set-cookie"].partition("=")
    assert name == f"plannerft_{PORT}" and rest.startswith(key)
    assert {part.strip().lower() for part in rest.split(";")[1:]} == {
        "httponly",
        "path=/",
        "samesite=strict",
    }
    assert client.get("/").status_code == 200 and client.get("/api/state").status_code == 200


def test_the_browser_that_the_program_opens_gets_a_key_that_works_once(client: TestClient) -> None:
    once = door(client).once
    client.cookies.clear()
    assert (
        client.get(f"/?token={once}")
        .headers["set-cookie"]
        .startswith(f"plannerft_{PORT}={door(client).key};")
    )
    client.cookies.clear()
    assert client.get(f"/?token={once}").status_code == 403


@pytest.mark.parametrize("key", ["", "wrong", "é\udcff", "A" * 43])
def test_without_the_key_there_is_neither_page_nor_plan(client: TestClient, key: str) -> None:
    client.cookies.clear()
    page = client.get("/", params={"token": key.encode("utf-8", "replace").decode()})
    assert (
        page.status_code == 403
        and page.text
        == "This page needs the address that the terminal shows, with its key: open that one.\n"
    )
    for path in ("/api/state", "/api/events"):
        refused = client.get(path, headers={"Authorization": "Bearer wrong"})
        assert (
            refused.status_code == 403
            and "address that the terminal shows" in refused.json()["error"]
        )
    client.cookies.set(door(client).cookie, "wrong")
    assert client.post("/api/undo", json={"revision": ""}).status_code == 403


def test_the_key_of_another_server_on_this_machine_is_none(client: TestClient) -> None:
    assert Door("127.0.0.1", PORT).cookie != Door("127.0.0.1", PORT + 1).cookie
    key = door(client).key
    client.cookies.clear()
    client.cookies.set(f"plannerft_{PORT + 1}", key)
    assert client.get("/api/state").status_code == 403


def test_a_program_may_use_the_key_as_a_bearer_and_needs_no_origin(client: TestClient) -> None:
    revision, key = state(client)["revision"], door(client).key
    client.cookies.clear()
    body = {"revision": revision, "edit": REMOVE}
    answered = without_origin(client).post(
        "/api/edit", json=body, headers={"Authorization": f"Bearer {key}"}
    )
    assert answered.status_code == 200 and len(answered.json()["document"]["tasks"]) == 3


@pytest.mark.parametrize(
    "host",
    [
        "evil.example",
        f"evil.example:{PORT}",
        "127.0.0.1",
        f"127.0.0.1:{PORT + 1}",
        f"127.0.0.1:{PORT}@evil",
        "",
    ],
)
def test_another_name_for_this_machine_is_refused(client: TestClient, host: str) -> None:
    for path in ("/", "/static/index.html", "/api/state"):
        assert client.get(path, headers={"Host": host}).status_code == 403
    assert edit_as(client, {"Host": host, "Origin": f"http://{host}"}) == 403


@pytest.mark.parametrize("host", [f"localhost:{PORT}", f"[::1]:{PORT}", f"127.0.0.1:{PORT}"])
def test_the_names_of_loopback_are_answered(client: TestClient, host: str) -> None:
    assert client.get("/api/state", headers={"Host": host}).status_code == 200
    assert edit_as(client, {"Host": host, "Origin": f"http://{host}"}) == 200


def edit_as(client: TestClient, headers: dict[str, str]) -> int:
    status: int = edit(client, headers).status_code
    return status


@pytest.mark.parametrize(
    "origin",
    [
        "http://evil.example",
        "null",
        "",
        f"https://127.0.0.1:{PORT}",
        f"http://127.0.0.1:{PORT + 1}",
        f"http://localhost:{PORT}",
    ],
)
def test_a_page_of_another_origin_changes_nothing(client: TestClient, origin: str) -> None:
    before = state(client)["revision"]
    assert edit_as(client, {"Origin": origin}) == 403
    bearer = {"Origin": origin, "Authorization": f"Bearer {door(client).key}"}
    assert edit_as(client, bearer) == 403
    assert state(client)["revision"] == before


def test_a_cookie_without_an_origin_changes_nothing(client: TestClient) -> None:
    assert edit_as(without_origin(client), {}) == 403


@pytest.mark.parametrize("site", ["cross-site", "same-site", "none"])
def test_what_the_browser_says_of_where_a_request_comes_from_counts(
    client: TestClient, site: str
) -> None:
    assert edit_as(client, {"Sec-Fetch-Site": site}) == 403
    assert client.get("/api/state", headers={"Sec-Fetch-Site": site}).status_code == (
        200 if site == "none" else 403
    )
    # A link to the page may be followed from anywhere.
    assert client.get("/", headers={"Sec-Fetch-Site": site}).status_code == 200
    assert edit_as(client, {"Sec-Fetch-Site": "same-origin"}) == 200


@pytest.mark.parametrize("method", ["PUT", "DELETE", "PATCH", "HEAD", "OPTIONS", "TRACE"])
def test_other_methods_are_not_used(client: TestClient, method: str) -> None:
    assert client.request(method, "/api/state").status_code == 405
    assert client.request(method, "/api/events").status_code == 405


def test_an_address_answers_only_its_own_method(client: TestClient) -> None:
    assert client.get("/api/edit").status_code == 405 and client.get("/api/edit").json() == {
        "error": "This address does not answer that method."
    }
    assert client.post("/api/state", json={}).status_code == 405
    assert (
        client.get("/api/nothing").status_code == 404
        and client.get("/elsewhere").status_code == 404
    )


@pytest.mark.parametrize(
    "path",
    [
        "/",
        "/?token=wrong",
        "/static/index.html",
        "/static/nothing.js",
        "/api/state",
        "/api/nothing",
        "/elsewhere",
    ],
)
def test_every_answer_says_what_a_browser_may_do_with_it(client: TestClient, path: str) -> None:
    for headers in ({}, {"Host": "evil.example"}):
        answered = client.get(path, headers=headers)
        for name, value in HEADERS.items():
            assert answered.headers[name] == value, (path, name)
    assert (
        "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; img-src"
        " 'self' data:" in HEADERS["Content-Security-Policy"]
    )


def test_only_json_is_read(client: TestClient) -> None:
    for kind in ("text/plain", "application/x-www-form-urlencoded", "multipart/form-data"):
        refused = client.post(
            "/api/undo", content=b'{"revision": "x"}', headers={"Content-Type": kind}
        )
        assert (
            refused.status_code == 415
            and "Content-Type: application/json" in refused.json()["error"]
        )
    assert client.post("/api/undo", content=b"{}").status_code == 415


@pytest.mark.parametrize(
    "content",
    [
        b"",
        b"{",
        b"[]",
        b'"x"',
        b"\xff",
        b'{"revision": NaN}',
        b'{"revision": "\\ud800"}',
        b"[" * 100_000,
    ],
)
def test_what_is_no_object_is_refused_in_a_sentence(client: TestClient, content: bytes) -> None:
    refused = client.post(
        "/api/undo", content=content, headers={"Content-Type": "application/json"}
    )
    assert refused.status_code == 422 and refused.json()["error"].startswith("the request is ")


def test_a_large_body_is_refused_before_it_is_read(client: TestClient) -> None:
    refused = client.post("/api/plan", json={"command": "x" * 300_000})
    assert refused.status_code == 413 and refused.json() == {
        "error": "The request is larger than 256 kB; send less."
    }

    def pieces() -> Iterator[bytes]:
        yield b'{"command": "'
        for _piece in range(300):
            yield b"x" * 1024
        yield b'"}'

    assert (
        client.post(
            "/api/plan", content=pieces(), headers={"Content-Type": "application/json"}
        ).status_code
        == 413
    )
    for length in ("-1", "many", "9" * 30):
        assert (
            client.post(
                "/api/plan",
                content=b"{}",
                headers={"Content-Type": "application/json", "Content-Length": length},
            ).status_code
            == 413
        )


@pytest.mark.parametrize(
    "name",
    [
        "../app.py",
        "..%2fapp.py",
        "%2e%2e/guard.py",
        "/etc/passwd",
        "..\\app.py",
        "vendor.js/../../app.py",
        "",
        "nothing\x00.js",
    ],
)
def test_nothing_beside_the_page_is_served(client: TestClient, name: str) -> None:
    for path in (f"/static/{name}", f"/static//{name}"):
        answered = client.get(path.replace("\x00", "%00"))
        assert answered.status_code == 404 and "import" not in answered.text


@pytest.mark.parametrize(
    "name",
    [
        "../plan.json",
        "/etc/passwd",
        "..",
        "",
        "other.json",
        "plan.json/",
        "./plan.json",
        "approvals.jsonl",
        "a" * 5000,
    ],
)
def test_only_the_plans_that_are_listed_can_be_opened(
    client: TestClient, plan: Path, name: str
) -> None:
    (plan.parent / "other.json").write_text(json.dumps({"not": "a plan"}))
    (plan.parent.parent / "plan.json").write_bytes(plan.read_bytes())
    refused = client.post("/api/open", json={"path": name})
    assert refused.status_code == 422 and "is no plan in" in refused.json()["error"]
    assert state(client)["plans"] == ["plan.json"] and state(client)["path"] == "plan.json"


def test_on_all_addresses_an_address_is_answered_but_no_name() -> None:
    everywhere = Door("0.0.0.0", PORT)
    assert (
        everywhere.knows(f"192.168.1.7:{PORT}")
        and everywhere.knows(f"[fe80::1]:{PORT}")
        and everywhere.knows(f"localhost:{PORT}")
    )
    assert not everywhere.knows(f"evil.example:{PORT}")
    one = Door("192.168.1.7", PORT)
    assert one.knows(f"192.168.1.7:{PORT}") and not one.knows(f"192.168.1.8:{PORT}")
    assert Door("vehicle.local", PORT).knows(f"vehicle.local:{PORT}")


def test_which_hosts_are_this_machine_alone() -> None:
    assert all(
        WebSettings(host=host).is_loopback
        for host in ("127.0.0.1", "localhost", "::1", "127.0.0.9")
    )
    assert not any(
        WebSettings(host=host).is_loopback
        for host in ("0.0.0.0", "::", "192.168.1.7", "vehicle.local", "")
    )
