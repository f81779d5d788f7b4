"""The server as a process of its own: what it prints, how it ends, and what is left when it is
killed.
"""

from __future__ import annotations

import contextlib
import json
import os
import random
import re
import select
import signal
import socket
import subprocess
import sys
import threading
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import httpx2
import pytest

from planner_ft.document import altered, read_document, write_document
from planner_ft.review import read_log
from planner_ft.review.web import WebSettings, serve
from planner_ft.support.errors import PlannerError
from tests.review.web.conftest import make_document

KILLS = int(os.environ.get("PLANNERFT_KILLS", "5"))
PATIENCE = 600.0
"""Seconds after which a process hangs."""
SERVE = """
import sys
from pathlib import Path
from planner_ft.review.web import WebSettings, planning, serve, server
{before}
plan = Path(sys.argv[1])
serve(plan if plan.is_file() else None, WebSettings(open_browser=False, folder=plan.parent))
"""
PROMPT = {"kind": "prompt", "task": "t1", "text": "Find it."}
NO_AGENTS = "planning.Planning._load = lambda self: None"
BUSY_AGENTS = """
import torch
class Endless:
    def plan(self, *_arguments):
        while True:
            torch.ones(300, 300) @ torch.ones(300, 300)
planning.Planning._load = lambda self: Endless()
"""


@dataclass
class Server:
    process: subprocess.Popen[str]
    base: str
    key: str

    @property
    def port(self) -> int:
        return int(self.base.rpartition(":")[2])

    def client(self) -> httpx2.Client:
        return httpx2.Client(
            base_url=self.base, headers={"Authorization": f"Bearer {self.key}"}, timeout=PATIENCE
        )

    def end(self, number: int) -> tuple[str, str]:
        self.process.send_signal(number)
        return self.process.communicate(timeout=PATIENCE)


@contextlib.contextmanager
def running(plan: Path, before: str = NO_AGENTS) -> Iterator[Server]:
    """A server of that plan; `before` is run before it starts."""
    command = [sys.executable, "-c", SERVE.format(before=before), str(plan)]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    try:
        assert process.stdout
        ready, _write, _error = select.select([process.stdout], [], [], PATIENCE)
        line = process.stdout.readline() if ready else ""
        found = re.match(r"Review at (http://127\.0\.0\.1:\d+)/\?token=([\w-]{43})$", line)
        assert found, line + (
            process.stderr.read() if process.stderr and process.poll() is not None else ""
        )
        yield Server(process, found[1], found[2])
    finally:
        process.kill()
        process.communicate()


@pytest.fixture(scope="module")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Server]:
    """One server for the tests that leave it as it is."""
    plan = tmp_path_factory.mktemp("server") / "plan.json"
    write_document(plan, make_document())
    with running(plan, f"{NO_AGENTS}\nserver.SLOWEST_REQUEST = 0.3") as found:
        yield found


def test_the_address_that_is_printed_opens_the_page(server: Server) -> None:
    with httpx2.Client(base_url=server.base, follow_redirects=True, timeout=PATIENCE) as browser:
        assert browser.get("/").status_code == 403
        page = browser.get(f"/?token={server.key}")
        assert page.status_code == 200 and "token" not in str(page.url) and "<script" in page.text
        assert browser.get("/api/state").json()["path"] == "plan.json"
        assert (
            browser.get("/api/state", headers={"Host": f"evil.example:{server.port}"}).status_code
            == 403
        )


def test_it_listens_on_loopback_alone(server: Server) -> None:
    """Another address of loopback stands for the other addresses of the machine."""
    with (
        pytest.raises(OSError),
        socket.create_connection(("127.0.0.2", server.port), timeout=PATIENCE),
    ):
        pass


@pytest.mark.parametrize(
    "begun",
    [
        b"",
        b"GET /api/state HTTP/1.1\r\nHost: 127.0.0.1\r\n",
        (
            b"POST /api/plan HTTP/1.1\r\nHost: HOST\r\nAuthorization: Bearer KEY\r\nContent-Type:"
            b" application/json\r\nContent-Length: 100\r\n\r\n{"
        ),
    ],
)
def test_a_request_that_does_not_come_in_is_given_up(server: Server, begun: bytes) -> None:
    begun = begun.replace(b"HOST", f"127.0.0.1:{server.port}".encode()).replace(
        b"KEY", server.key.encode()
    )
    with socket.create_connection(("127.0.0.1", server.port), timeout=PATIENCE) as slow:
        slow.sendall(begun)
        with contextlib.suppress(ConnectionResetError):
            assert slow.recv(1000) == b""


def test_connections_without_a_request_keep_nobody_out(tmp_path: Path) -> None:
    plan = tmp_path / "plan.json"
    write_document(plan, make_document())
    with running(plan) as server, contextlib.ExitStack() as held, server.client() as client:
        for _ in range(200):
            address = ("127.0.0.1", server.port)
            held.enter_context(socket.create_connection(address, timeout=PATIENCE)).send(b"G")
        assert [client.get("/api/state").status_code for _ in range(3)] == [200] * 3


def test_an_open_event_stream_is_not_taken_for_a_slow_request(server: Server) -> None:
    with server.client() as client, client.stream("GET", "/api/events") as events:
        lines = events.iter_lines()
        assert next(lines) == ": connected"
        for _ in range(3):
            assert client.get("/api/state").status_code == 200
            threading.Event().wait(0.2)
        assert events.headers["content-type"].startswith("text/event-stream")
        client.post(
            "/api/edit",
            json={"revision": client.get("/api/state").json()["revision"], "edit": PROMPT},
        )
        assert "event: state" in (line for line in lines)


def test_a_body_that_is_too_large_gets_its_sentence_over_the_wire(server: Server) -> None:
    with server.client() as client:
        for content in (b"x" * 300_000, iter([b"x" * 65_536] * 100)):
            answered = client.post(
                "/api/plan", content=content, headers={"Content-Type": "application/json"}
            )
            assert answered.status_code == 413 and "256 kB" in answered.json()["error"]
        assert client.get("/api/state").status_code == 200


def test_garbage_does_not_end_it(server: Server) -> None:
    for garbage in (
        b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03",
        b"GET / HTTP/9.9\r\n\r\n",
        b"A" * 100_000,
        b"GET / HTTP/1.1\r\nHost: a\r\nHost: b\r\n\r\n",
    ):
        with (
            socket.create_connection(("127.0.0.1", server.port), timeout=PATIENCE) as wire,
            contextlib.suppress(ConnectionError),
        ):
            wire.sendall(garbage)
            while wire.recv(4096):
                pass
    with server.client() as client:
        assert client.get("/api/state").status_code == 200


def test_ctrl_c_ends_it_and_says_where_the_plan_is(tmp_path: Path) -> None:
    plan = tmp_path / "plan.json"
    write_document(plan, make_document())
    with (
        running(plan) as server,
        server.client() as client,
        client.stream("GET", "/api/events") as events,
    ):
        assert next(events.iter_lines()) == ": connected"
        out, errors = server.end(signal.SIGINT)
        assert server.process.returncode == 0
        assert f"the plan is saved in {plan}, decisions in {tmp_path / 'approvals.jsonl'}" in out
        assert errors == "" and server.key not in out


def test_ctrl_c_ends_it_while_the_agents_compute(tmp_path: Path) -> None:
    plan = tmp_path / "plan.json"
    write_document(plan, make_document())
    with (
        running(plan, BUSY_AGENTS) as server,
        server.client() as client,
        client.stream("GET", "/api/events") as events,
    ):
        lines = events.iter_lines()
        assert client.post("/api/plan", json={"command": "Go home."}).status_code == 202
        assert "event: progress" in (line for line in lines)
        out, errors = server.end(signal.SIGINT)
        assert (
            server.process.returncode == 0 and "planning was not finished" in out and errors == ""
        )
    assert not altered(read_document(plan))


def test_the_key_is_never_written_but_once_to_the_terminal(tmp_path: Path) -> None:
    plan = tmp_path / "plan.json"
    write_document(plan, make_document())
    with running(plan) as server:
        with server.client() as client:
            client.get(f"/?token={server.key}")
            client.get(f"/api/nothing?token={server.key}")
            client.post("/api/edit", content=b"{")
            client.post(
                "/api/edit",
                json={
                    "revision": client.get("/api/state").json()["revision"],
                    "edit": {"kind": "prompt", "task": "t1", "text": "Find it."},
                },
            )
        out, errors = server.end(signal.SIGINT)
    assert server.key not in out + errors
    assert all(server.key.encode() not in path.read_bytes() for path in tmp_path.iterdir())


@dataclass
class Confirmed:
    """What the server said was done before it was killed; `news` is set by every decision."""

    edits: int = 0
    decisions: int = 0
    news: threading.Event = field(default_factory=threading.Event)


def operate(server: Server, confirmed: Confirmed) -> None:
    """Edit and decide as fast as the server answers, until it does not any more."""
    with server.client() as client, contextlib.suppress(httpx2.HTTPError):
        now: dict[str, Any] = client.get("/api/state").json()
        while True:
            text = f"Find the green buoy, wish {len(now['document']['edits'])}."
            edited = client.post(
                "/api/edit",
                json={
                    "revision": now["revision"],
                    "edit": {"kind": "prompt", "task": "t1", "text": text},
                },
            )
            assert edited.status_code == 200, edited.text
            now, confirmed.edits = edited.json(), len(edited.json()["document"]["edits"])
            ids = [warning["id"] for warning in now["document"]["warnings"]]
            decided = client.post(
                "/api/approve",
                json={"revision": now["revision"], "name": "Ada", "acknowledged": ids},
            )
            assert decided.status_code == 200, decided.text
            now, confirmed.decisions = decided.json(), decided.json()["approval"]["sequence"]
            confirmed.news.set()


def test_kill_at_any_moment_loses_no_edit_and_no_decision_that_was_confirmed(
    tmp_path: Path,
) -> None:
    plan = tmp_path / "plan.json"
    write_document(plan, make_document())
    confirmed, moments = Confirmed(), random.Random(7)
    for _kill in range(KILLS):
        with running(plan) as server:
            operator = threading.Thread(target=operate, args=(server, confirmed))
            operator.start()
            assert confirmed.news.wait(PATIENCE)
            threading.Event().wait(moments.uniform(0, 0.3))
            server.end(signal.SIGKILL)
            operator.join()
        document = read_document(plan)
        assert not altered(document) and len(document["edits"]) >= confirmed.edits
        records = (
            read_log(tmp_path / "approvals.jsonl")
            if (tmp_path / "approvals.jsonl").exists()
            else ()
        )
        assert len(records) >= confirmed.decisions
    assert confirmed.edits > 0 and confirmed.decisions > 0


def test_a_port_that_is_taken_is_one_sentence(tmp_path: Path) -> None:
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        port = taken.getsockname()[1]
        with pytest.raises(
            PlannerError, match=f"^--port {port}: another program listens there; give another port"
        ):
            serve(None, WebSettings(port=port, open_browser=False, folder=tmp_path))


@pytest.mark.parametrize("host", ["203.0.113.7", "no such host", "nowhere.invalid"])
def test_a_host_that_is_not_this_machine_is_one_sentence(tmp_path: Path, host: str) -> None:
    with pytest.raises(PlannerError, match=f"^--host {host}: .* leave the flag out for 127.0.0.1$"):
        serve(None, WebSettings(host=host, open_browser=False, folder=tmp_path))


@pytest.mark.parametrize("port", [-1, 65536])
def test_a_port_that_there_is_not_is_one_sentence(port: int) -> None:
    with pytest.raises(PlannerError, match=f"--port {port}: must lie between"):
        WebSettings(port=port)


def test_a_plan_that_cannot_be_read_ends_it_before_it_listens(tmp_path: Path) -> None:
    (tmp_path / "plan.json").write_text(json.dumps({"format": "something else"}))
    with pytest.raises(PlannerError, match=r"plan\.json: is no plan document"):
        serve(tmp_path / "plan.json", WebSettings(open_browser=False))
