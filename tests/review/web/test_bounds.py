"""The web review at its bounds: keys, hosts, sizes, lengths, and what is printed."""

from __future__ import annotations

import asyncio
import math
from pathlib import Path
from typing import Any

import pytest
from starlette.requests import Request

from planner_ft.planning.planner import check_command
from planner_ft.planning.settings import PlanSettings
from planner_ft.review.web import app, guard, planning, server, session
from planner_ft.review.web.guard import Door, refusal
from planner_ft.review.web.planning import Events, Planning, sentence
from planner_ft.review.web.server import _PromptProtocol
from planner_ft.review.web.session import Session, WebSettings
from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary.plans import is_position
from tests.review.web.conftest import PORT, REMOVE, Serve, post, state

DOOR = Door("127.0.0.1", PORT, "k" * 43, None)
HOST = f"127.0.0.1:{PORT}"
SENT = {
    "host": HOST,
    "authorization": f"Bearer {'k' * 43}",
    "content-type": "application/json",
    "content-length": "2",
}


def refused(method: str = "POST", path: str = "/api/edit", **headers: str | None) -> int | None:
    given = {**SENT, **{key.replace("_", "-"): value for key, value in headers.items()}}
    raw = [(key.encode(), value.encode()) for key, value in given.items() if value is not None]
    scope = {"type": "http", "method": method, "path": path, "headers": raw, "query_string": b""}
    found = refusal(Request({**scope, "server": ("127.0.0.1", PORT), "scheme": "http"}), DOOR)
    return found and found[0]


@pytest.mark.parametrize(
    ("changed", "status"),
    [
        ({}, None),
        ({"content_length": str(256 * 1024)}, None),
        ({"content_length": str(256 * 1024 + 1)}, 413),
        ({"content_length": None}, None),
        ({"content_length": "٣"}, 413),
        ({"content_type": "application/json; charset=utf-8"}, None),
        ({"content_type": " Application/JSON "}, None),
        ({"content_type": None}, 415),
        ({"origin": f"http://{HOST}"}, None),
        (
            {
                "origin": f"http://{HOST}",
                "authorization": None,
                "cookie": f"plannerft_{PORT}={'k' * 43}",
            },
            None,
        ),
        ({"authorization": None, "cookie": f"plannerft_{PORT}={'k' * 43}"}, 403),
        ({"authorization": f"bearer {'k' * 43}"}, None),
        ({"authorization": f"Basic {'k' * 43}"}, 403),
        ({"authorization": None}, 403),
        ({"sec_fetch_site": "none"}, 403),
        ({"sec_fetch_site": "none", "method": "GET"}, None),
        ({"sec_fetch_site": "same-site", "method": "GET"}, 403),
        (
            {"sec_fetch_site": "same-site", "method": "GET", "path": "/", "authorization": None},
            None,
        ),
        ({"method": "GET", "content_type": None, "content_length": None}, None),
        ({"method": "PUT"}, 405),
        ({"host": None}, 403),
    ],
)
def test_what_is_let_in(changed: dict[str, Any], status: int | None) -> None:
    assert refused(**changed) == status


def test_keys_are_long_different_and_one_of_them_opens_once() -> None:
    door, other = Door("127.0.0.1", PORT), Door("127.0.0.1", PORT)
    assert len({door.key, door.once, other.key, other.once}) == 4
    assert {len(key or "") for key in (door.key, door.once)} == {43}
    once = door.once or ""
    assert door.opens(door.key) and door.opens(once)
    assert not door.opens(once) and door.opens(door.key) and not door.is_session(once)


@pytest.mark.parametrize(
    ("of", "host", "known"),
    [
        ("127.0.0.1", f"localhost:{PORT}", True),
        ("127.0.0.1", "localhost", False),
        ("127.0.0.1", f"192.168.1.7:{PORT}", False),
        ("0.0.0.0", f"192.168.1.7:{PORT}", True),
        ("::", f"[fe80::1]:{PORT}", True),
        ("", f"192.168.1.7:{PORT}", True),
        ("", f"192.168.1.7:{PORT + 1}", False),
        ("0.0.0.0", f"vehicle.local:{PORT}", False),
        ("fe80::1", f"[fe80::1]:{PORT}", True),
        ("fe80::1", f"[fe80::2]:{PORT}", False),
    ],
)
def test_which_names_a_server_answers_to(of: str, host: str, *, known: bool) -> None:
    assert Door(of, PORT).knows(host) is known


# ---------------------------------------------------------------- the interface


@pytest.mark.parametrize(
    ("value", "fits"),
    [
        ([1, 2.5], True),
        ([1], False),
        ([1, 2, 3], False),
        ([1, True], False),
        ([1, "2"], False),
        ([1, math.inf], False),
        ((1, 2), False),
        (None, False),
    ],
)
def test_a_position_has_two_finite_numbers(value: Any, *, fits: bool) -> None:
    assert is_position(value) is fits
    assert app.FIELDS["Locations"][0]({"a": [0, 0], "b": value}) is fits


@pytest.mark.parametrize(
    ("kind", "value", "fits"),
    [
        ("str", "x", True),
        ("str", 1, False),
        ("bool", False, True),
        ("bool", 0, False),
        ("float", 1, True),
        ("float", 1.5, True),
        ("float", True, False),
        ("list[str]", [], True),
        ("list[str]", ["a", 1], False),
        ("list[str]", "ab", False),
        ("Edit", {}, True),
        ("Edit", [], False),
    ],
)
def test_a_field_is_of_its_type(kind: str, value: Any, *, fits: bool) -> None:
    assert app.FIELDS[kind][0](value) is fits


def test_a_body_of_256_kib_is_read(serve_plan: Serve, plan: Path) -> None:
    client, revision = serve_plan(plan), "0" * 64
    for size, status in ((256 * 1024, 409), (256 * 1024 + 1, 413)):
        frame = f'{{"revision": "{revision}", "note": "'
        content = frame + "x" * (size - len(frame) - 2) + '"}'

        def parts(content: str = content) -> Any:
            yield content.encode()

        sent = client.post(
            "/api/undo", content=parts(), headers={"Content-Type": "application/json"}
        )
        assert sent.status_code == status


def test_a_command_of_20000_characters_is_planned(serve_plan: Serve) -> None:
    client = serve_plan(None)
    asked: list[str] = []
    client.app_state["session"].planning.ask = lambda busy, _work: asked.append(busy["command"])
    whole = "Go to [1, 2]. ".ljust(20_000, "a")
    check_command(whole)
    assert post(client, "/api/plan", command=whole, sure=True).status_code == 202
    refused = post(client, "/api/plan", command=whole + "a", sure=True)
    assert refused.status_code == 422 and "has 20001 characters" in refused.json()["error"]
    assert asked == [whole]


def test_an_unknown_kind_of_edit_is_quoted_to_40_characters(serve_plan: Serve, plan: Path) -> None:
    client = serve_plan(plan)
    revision = state(client)["revision"]
    for kind, shown in (("x" * 40, "x" * 40), ("x" * 41, "x" * 40), ("replace", "replace")):
        refused = post(client, "/api/edit", revision=revision, edit={"kind": kind})
        assert refused.json()["error"].startswith(f"edit '{shown}': is none that a page makes")
    assert (
        post(client, "/api/edit", revision=revision, edit=REMOVE, by="x" * 201).status_code == 422
    )
    assert post(client, "/api/edit", revision=revision, edit=REMOVE, by=" ").status_code == 200


@pytest.mark.parametrize(("port", "fits"), [(0, True), (65535, True), (-1, False), (65536, False)])
def test_ports_lie_between_0_and_65535(port: int, *, fits: bool) -> None:
    if fits:
        assert WebSettings(port=port).port == port
    else:
        with pytest.raises(PlannerError, match="must lie between 0"):
            WebSettings(port=port)


def test_a_review_asks_for_the_state_when_a_file_changes_and_not_else(
    serve_plan: Serve, plan: Path
) -> None:
    own: Session = serve_plan(plan).app_state["session"]
    told: list[Any] = []
    own.events.tell = lambda kind, data: told.append((kind, data))  # type: ignore[method-assign]
    own.look()
    assert told == []
    plan.write_bytes(plan.read_bytes() + b"\n")
    own.look()
    own.look()
    assert [kind for kind, _data in told] == ["state"] and len(told[0][1]["revision"]) == 64
    plan.write_text("{")
    own.look()
    assert told[1:] == [("state", {"revision": None})]


# ---------------------------------------------------------------- events


def test_a_page_may_be_a_thousand_events_behind_and_no_more() -> None:
    assert planning.MOST_WAITING == 1000

    async def heard(behind: int) -> int:
        own, count = Events(), 0
        listening = own.listen()
        await anext(listening)
        for number in range(behind):
            own.tell("progress", number)
            await asyncio.sleep(0)
        own.close()
        async for _text in listening:
            count += 1
        return count

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(planning, "MOST_WAITING", 3)
        assert [asyncio.run(heard(number)) for number in (2, 3, 4)] == [2, 3, 3]


def test_a_quiet_connection_is_kept_alive_each_quarter_of_a_minute() -> None:
    assert planning.KEEP_ALIVE == 15

    async def story() -> list[str]:
        own = Events()
        listening = own.listen()
        heard = [await anext(listening), await anext(listening)]
        own.tell("state", {"a": 1})
        return [*heard, await anext(listening)]

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(planning, "KEEP_ALIVE", 0.01)
        found = asyncio.run(story())
    assert found[:2] == [": connected\n\n", ": still here\n\n"]
    assert found[2] in (": still here\n\n", 'event: state\ndata: {"a":1}\n\n')


def test_a_page_that_comes_later_hears_of_tasks_and_skills_until_they_are_forgotten() -> None:
    async def first(own: Events) -> list[str]:
        listening = own.listen()
        await anext(listening)
        own.close()
        return [text async for text in listening]

    own = Events()
    for kind in ("tasks", "progress", "skills", "state"):
        own.tell(kind, {})  # type: ignore[arg-type]
    assert [text.split("\n")[0] for text in asyncio.run(first(own))] == [
        "event: tasks",
        "event: skills",
    ]
    again = Events()
    again.tell("tasks", {})
    again.forget()
    assert asyncio.run(first(again)) == []


# ---------------------------------------------------------------- the agents


def test_the_agents_do_one_thing_at_a_time() -> None:
    changed: list[int] = []
    own = Planning(PlanSettings(configuration="base"), Events(), lambda: changed.append(1))
    assert own.as_json()["available"] is True and own.as_json()["configuration"] == "base"
    own.ask({"what": "planning", "label": "planning"}, lambda _planner: None)
    assert own.busy == {"done": 0, "total": 0, "what": "planning", "label": "planning"}
    with pytest.raises(PlannerError, match=r"at work already \(planning\)"):
        own.ask({"what": "skills", "label": "x"}, lambda _planner: None)
    assert own.ended(0.0) is True, "it has not begun"


@pytest.mark.parametrize(
    ("error", "said"),
    [
        (PlannerError("no"), "no"),
        (ValueError("a\nb"), "the agents failed (ValueError: a)"),
        (ValueError(""), "the agents failed (ValueError: no more is known)"),
        (ValueError("x" * 300), f"the agents failed (ValueError: {'x' * 300})"),
        (ValueError("x" * 301), f"the agents failed (ValueError: {'x' * 300})"),
    ],
)
def test_an_error_is_one_sentence_of_at_most_300_characters(error: Exception, said: str) -> None:
    assert sentence(error) == said


# ---------------------------------------------------------------- the server


def test_how_long_a_request_and_how_many_connections_wait() -> None:
    assert (server.SLOWEST_REQUEST, server.MOST_UNFINISHED, server.GRACE) == (10, 100, 1)


class Connection(_PromptProtocol):
    """A connection whose clock and transport are its own."""

    unfinished: Any = {}  # noqa: RUF012

    def __init__(self) -> None:
        self.aborted = False
        self.conn = self.loop = self.transport = self  # type: ignore[assignment]
        self.their_state: Any = server.h11.IDLE

    def abort(self) -> None:
        self.aborted = True

    def call_later(self, _seconds: float, _work: Any) -> Any:
        return self

    def cancel(self) -> None:
        pass


def test_the_oldest_of_a_hundred_unfinished_connections_makes_room() -> None:
    Connection.unfinished = {}
    found = [Connection() for _number in range(101)]
    for one in found[:100]:
        one._watch()
        one._watch()
    assert len(Connection.unfinished) == 100 and not any(one.aborted for one in found)
    found[1].their_state = server.h11.DONE
    found[1]._watch()
    assert len(Connection.unfinished) == 99
    found[1].their_state = server.h11.SEND_BODY
    found[1]._watch()
    found[100]._watch()
    assert [one.aborted for one in found] == [True, *[False] * 100]


@pytest.mark.parametrize(
    ("host", "shown", "warned"),
    [
        ("127.0.0.1", f"http://127.0.0.1:{PORT}/", False),
        ("::1", f"http://[::1]:{PORT}/", False),
        ("0.0.0.0", f"http://127.0.0.1:{PORT}/", True),
        ("192.168.1.7", f"http://192.168.1.7:{PORT}/", True),
    ],
)
def test_the_address_that_is_printed_and_the_warning(
    capsys: pytest.CaptureFixture[str], host: str, shown: str, *, warned: bool
) -> None:
    server._say_where(WebSettings(host=host, open_browser=False), Door(host, PORT, DOOR.key))
    printed = capsys.readouterr()
    assert printed.out == f"Review at {shown}?token={'k' * 43}\nCtrl-C ends it.\n"
    assert ("others on the network" in printed.err) is warned


@pytest.mark.parametrize(
    ("wanted", "screen", "opened"),
    [(True, "DISPLAY", 1), (True, "WAYLAND_DISPLAY", 1), (True, None, 0), (False, "DISPLAY", 0)],
)
def test_a_browser_is_opened_where_there_is_a_screen(
    monkeypatch: pytest.MonkeyPatch, wanted: bool, screen: str | None, opened: int
) -> None:
    found: list[str] = []

    class Thread:
        def __init__(self, target: Any, args: tuple[str], daemon: bool) -> None:
            assert daemon and target is server.webbrowser.open
            found.extend(args)

        def start(self) -> None:
            pass

    monkeypatch.setattr(server.threading, "Thread", Thread)
    for name in ("DISPLAY", "WAYLAND_DISPLAY"):
        monkeypatch.delenv(name, raising=False)
    if screen:
        monkeypatch.setenv(screen, ":0")
    door = Door("127.0.0.1", PORT, "k" * 43, "once")
    server._say_where(WebSettings(open_browser=wanted), door)
    assert found == [f"http://127.0.0.1:{PORT}/?token=once"] * opened


def test_the_last_words_say_where_all_is_and_what_was_not_finished(
    serve_plan: Serve, plan: Path
) -> None:
    own: Session = serve_plan(plan).app_state["session"]
    assert server._farewell(own) == f"\nended: the plan is saved in {plan}, decisions in {own.log}"
    own.planning.busy = {"what": "planning"}
    assert server._farewell(own).endswith("; planning was not finished")
    none: Session = serve_plan(None).app_state["session"]
    assert server._farewell(none) == "\nended: there was no plan to save"


def test_a_look_at_the_disk_is_a_second_after_the_last(
    serve_plan: Serve, plan: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    waited: list[float] = []

    async def sleep(seconds: float) -> None:
        waited.append(seconds)
        if len(waited) > 2:
            raise asyncio.CancelledError

    monkeypatch.setattr(app.asyncio, "sleep", sleep)
    own, looks = serve_plan(plan).app_state["session"], list[int]()
    own.look = lambda: looks.append(1)
    with pytest.raises(asyncio.CancelledError):
        asyncio.run(app._look(own))
    assert waited == [1, 1, 1] and looks == [1, 1]
    assert (guard.LARGEST_BODY, session.LONGEST_COMMAND) == (262144, 20000)


@pytest.mark.parametrize(("length", "read"), [("2", 3), (str(guard.LARGEST_BODY + 1), 0)])
def test_a_refused_request_is_read_to_its_end_before_the_answer(length: str, read: int) -> None:
    """Else the connection ends with a reset, and the answer is lost; what is too large is left."""
    told: list[str] = []

    async def receive() -> dict[str, Any]:
        told.append("read")
        return {"type": "http.request", "body": b"{", "more_body": told.count("read") < 3}

    async def send(message: Any) -> None:
        told.append(message["type"])

    given = SENT | {"content-length": length, **({"content-type": "text/plain"} if read else {})}
    scope = {
        "type": "http",
        "method": "POST",
        "path": "/api/edit",
        "headers": [(key.encode(), value.encode()) for key, value in given.items()],
        "query_string": b"",
        "server": ("127.0.0.1", PORT),
        "scheme": "http",
    }
    asyncio.run(guard.Guard(None, DOOR)(scope, receive, send))
    assert told == ["read"] * read + ["http.response.start", "http.response.body"]
