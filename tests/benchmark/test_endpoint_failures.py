"""Servers that hang, drop connections, answer rubbish or refuse: asked again, then one sentence,
and what came is kept.
"""

from __future__ import annotations

import itertools
import json
import re
import signal
import subprocess
import sys
import threading
from collections.abc import Iterator
from dataclasses import replace
from datetime import UTC, datetime, timedelta
from pathlib import Path
from typing import Any

import pytest

from planner_ft.benchmark import chat_client
from planner_ft.benchmark.chat_client import ChatClient
from planner_ft.benchmark.settings import EndpointSettings
from planner_ft.cli import main
from planner_ft.support.errors import PlannerError

from .chat_server import PLAN, Act, Body, ChatServer, Handler, asked, chat_server, completion

COUNT = 6
KEY = "sk-very-secret"


@pytest.fixture
def server() -> Iterator[ChatServer]:
    with chat_server() as running:
        yield running


@pytest.fixture(autouse=True)
def _impatient(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(chat_client, "FIRST_PAUSE", 0.001)


@pytest.fixture
def run(server: ChatServer, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Any) -> Any:
    """Runs the command line against the server; returns (exit status, what it said, ids that are
    kept).
    """
    data = tmp_path / "data.jsonl"
    records = [
        {
            "id": f"m{index}",
            "prompt": f"go to {index} {index}",
            "expected": {"tasks": [{"title": "Transit"}]},
        }
        for index in range(COUNT)
    ]
    data.write_text("".join(json.dumps(record) + "\n" for record in records))
    monkeypatch.setenv("THE_KEY", KEY)

    def call(*flags: str) -> tuple[int, str, set[str]]:
        fixed = [
            "--level",
            "mission",
            "--model",
            "tiny",
            "--data",
            str(data),
            "--out",
            str(tmp_path / "out"),
            "--latency-samples",
            "0",
            "--no-report",  # drawing is tested elsewhere
        ]
        given = [
            "--endpoint",
            server.url,
            "--api-key-env",
            "THE_KEY",
            "--timeout",
            "600",
            "--retries",
            "2",
            "--concurrency",
            "2",
            *flags,
        ]
        monkeypatch.setattr(sys, "argv", ["plannerft", "bench", *fixed, *given])
        status = 0
        try:
            main()
        except SystemExit as ended:
            status = int(ended.code or 0)
        predictions = tmp_path / "out" / "predictions.jsonl"
        kept = (
            {json.loads(line)["id"] for line in predictions.read_text().splitlines()}
            if predictions.is_file()
            else set()
        )
        return status, capsys.readouterr().err, kept

    return call


def _status(status: int, message: str = "no", **headers: str) -> Act:
    return lambda handler, _body: (
        handler.send(status, {"error": {"message": message}}, **headers) or True
    )


def _drop(handler: Handler, _body: Body) -> bool:
    handler.drop()
    return True


def _raw(content: bytes) -> Act:
    return lambda handler, _body: handler.send_bytes(200, content, "application/json") or True


RETRIED: list[tuple[str, Act, str]] = [
    ("drops", _drop, "dropped the connection"),
    ("rubbish", _raw(b"<html>busy</html>"), "something that is not JSON: <html>busy</html>"),
    ("no choices", _raw(b'{"choices": []}'), "answered without choices"),
    ("no message", _raw(b'{"choices": [{"text": "x"}]}'), "answered without a message"),
    (
        "error in 200",
        _raw(b'{"error": {"message": "out of memory"}}'),
        "answered with an error: out of memory",
    ),
    ("429", _status(429, "slow down"), "answers HTTP 429: slow down"),
    ("503", _status(503, "loading"), "answers HTTP 503: loading"),
]
FINAL: list[tuple[str, Act, str]] = [
    (
        "401",
        _status(401, f"bad key {KEY}"),
        (
            r"refuses the key in THE_KEY \(HTTP 401: bad key \*\*\*\); name the variable of a"
            r" valid key"
        ),
    ),
    ("404", _status(404, "no model"), "no model tiny there .*; it serves tiny"),
    ("400", _status(400, "bad field"), "does not take our request .HTTP 400: bad field"),
    ("long wait", _status(429, "quota", Retry_After="86400"), "asks to wait for 86400 s"),
]


@pytest.mark.parametrize(
    ("act", "message"), [case[1:] for case in RETRIED], ids=[case[0] for case in RETRIED]
)
def test_a_server_that_fails_for_a_while_is_asked_again(
    server: ChatServer, run: Any, act: Act, message: str
) -> None:
    failed: dict[str, int] = {}

    def for_a_while(handler: Handler, body: Body) -> bool:
        failed[asked(body)] = failed.get(asked(body), 0) + 1
        return failed[asked(body)] <= 2 and asked(body) != "go to 0 0" and act(handler, body)

    server.act = for_a_while
    status, said, kept = run()
    assert (status, len(kept)) == (0, COUNT), said


@pytest.mark.parametrize(
    ("act", "message"),
    [case[1:] for case in RETRIED + FINAL],
    ids=[case[0] for case in RETRIED + FINAL],
)
def test_a_server_that_fails_for_good_is_one_sentence_and_what_came_is_kept(
    server: ChatServer, run: Any, act: Act, message: str
) -> None:
    server.act = lambda handler, body: asked(body) == "go to 3 3" and act(handler, body)
    status, said, kept = run()
    last = said.strip().splitlines()[-1]
    assert (
        status == 2
        and last.startswith(f"plannerft: {server.url}: ")
        and re.search(message, last)
        and "Traceback" not in said
    )
    assert KEY not in said and {"m0", "m1", "m2"} <= kept and "m3" not in kept
    attempts = sum(asked(body) == "go to 3 3" for body in server.requests)
    assert attempts == (3 if message in [case[2] for case in RETRIED] else 1)

    server.act = lambda _handler, _body: False
    before = len(server.requests)
    status, said, everything = run("--resume")
    assert (status, len(everything)) == (0, COUNT), said
    assert len(server.requests) - before == COUNT - len(kept)


BODY: Body = {"model": "tiny", "messages": [{"role": "user", "content": "go"}]}


def test_a_server_that_hangs_is_one_sentence(server: ChatServer) -> None:
    server.act = lambda handler, _body: handler.hang()
    client = ChatClient(EndpointSettings(server.url, "tiny", timeout=0.1, retries=2))
    with pytest.raises(PlannerError, match=r"did not answer within 0.1 s \(3 times in a row\)"):
        client.complete(BODY)
    client.close()


def test_a_server_that_hangs_for_a_while_is_asked_again(
    server: ChatServer, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The client has all the time of the world as soon as a request has hung."""
    monkeypatch.setattr(chat_client, "LONGEST_PAUSE", 0.001)
    client = ChatClient(EndpointSettings(server.url, "tiny", timeout=0.1))

    def hang_once(handler: Handler, _body: Body) -> bool:
        if client.settings.timeout == 600:
            return False
        client.settings, client.http.timeout = replace(client.settings, timeout=600), 600
        return handler.hang()

    server.act = hang_once
    reply = client.complete(BODY, retries=10_000)
    client.close()
    assert json.loads(reply.text) == PLAN and reply.attempts > 1


def test_a_server_that_never_ends_its_answer_is_one_sentence(
    server: ChatServer, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A thousand seconds pass whenever the client looks at its clock."""
    monkeypatch.setattr(chat_client.time, "perf_counter", itertools.count(step=1000).__next__)
    server.act = lambda handler, _body: handler.drip()
    client = ChatClient(EndpointSettings(server.url, "tiny", timeout=600, retries=2))
    with pytest.raises(PlannerError, match=r"did not finish its answer in time \(3 times"):
        client.complete(BODY)
    client.close()


def test_a_server_cannot_write_on_the_terminal(server: ChatServer, run: Any) -> None:
    server.act = lambda handler, body: _status(400, "no\x1b[2J\x00\nway")(handler, body)
    status, said, _kept = run()
    assert status == 2 and "HTTP 400: no [2J way" in said
    assert "\x1b[2J" not in said and "\x00" not in said


def test_an_answer_without_content_is_said_to_be_one(
    server: ChatServer, run: Any, tmp_path: Path
) -> None:
    def silent(handler: Handler, body: Body) -> bool:
        if asked(body) != "go to 3 3":
            return False
        value = completion("")
        value["choices"][0]["message"]["content"] = None
        handler.send(200, value)
        return True

    server.act = silent
    status, said, kept = run()
    assert (status, len(kept)) == (0, COUNT), said
    text = (tmp_path / "out" / "predictions.jsonl").read_text()
    (line,) = [one for one in map(json.loads, text.splitlines()) if one["id"] == "m3"]
    assert (line["finish_reason"], line["error"]) == ("error", "the server sent no content")
    assert "1 of 6 samples failed" in (tmp_path / "out" / "table.md").read_text()


def test_a_server_that_is_not_there(run: Any) -> None:
    with chat_server() as gone:
        url = gone.url
    status, said, kept = run("--endpoint", url)
    assert status == 2 and f"{url}: the server cannot be reached" in said and not kept


@pytest.mark.parametrize("form", ["seconds", "date"])
def test_the_pause_is_the_one_that_the_server_asks_for(
    server: ChatServer, run: Any, form: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    waited: list[float] = []
    real = chat_client.ChatClient._pause

    def pause(self: Any, attempt: int, asked_for: float | None) -> bool:
        waited.append(asked_for if asked_for is not None else -1.0)
        return real(self, attempt, 0.0)

    monkeypatch.setattr(chat_client.ChatClient, "_pause", pause)
    then = (datetime.now(UTC) + timedelta(seconds=90)).strftime("%a, %d %b %Y %H:%M:%S GMT")
    act = _status(429, "slow down", Retry_After="7" if form == "seconds" else then)
    server.act = lambda handler, body: len(server.requests) == 1 and act(handler, body)
    assert run("--concurrency", "1")[0] == 0
    (wait,) = waited
    assert wait == 7.0 if form == "seconds" else 60 < wait <= 90


def test_pauses_grow(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(chat_client, "FIRST_PAUSE", 0.5)
    client = ChatClient(EndpointSettings("http://127.0.0.1:9/v1", "tiny"))
    waited: list[float] = []
    monkeypatch.setattr(client.stopped, "wait", lambda timeout: waited.append(timeout))
    for attempt in range(1, 10):
        client._pause(attempt, None)
    client.close()
    bounds = [min(30.0, 0.5 * 2**attempt) for attempt in range(9)]
    assert all(bound / 2 <= wait <= bound for wait, bound in zip(waited, bounds, strict=True)), (
        waited
    )


def test_a_stream_that_breaks_off_is_asked_for_again(server: ChatServer, run: Any) -> None:
    def broken_once(handler: Handler, body: Body) -> bool:
        if body.get("stream") and sum(bool(seen.get("stream")) for seen in server.requests) == 2:
            handler.events(
                [
                    {
                        "choices": [
                            {"index": 0, "delta": {"content": '{"tasks"'}, "finish_reason": None}
                        ]
                    }
                ],
                ended=False,
            )
            return True
        return False

    server.act = broken_once
    status, said, _kept = run("--latency-samples", "2")
    assert status == 0, said
    assert (
        sum(bool(body.get("stream")) for body in server.requests) == 4
    )  # warm-up, broken, again, second sample


def test_a_model_that_never_ends_is_cut_and_counted(
    server: ChatServer, run: Any, tmp_path: Path
) -> None:
    server.act = lambda handler, body: (
        handler.send(200, completion("and so on " * body["max_tokens"], "length")) or True
    )
    status, said, kept = run("--max-new-tokens", "5")
    assert (status, len(kept)) == (0, COUNT), said
    row = json.loads((tmp_path / "out" / "results.json").read_text())["rows"][0]
    assert row["finish_reasons"] == {"length": COUNT} and row["metrics"]["f1"]["value"] == 0.0


def test_a_server_that_counts_no_tokens_is_scored_all_the_same(
    server: ChatServer, run: Any, tmp_path: Path
) -> None:
    def uncounted(handler: Handler, _body: Body) -> bool:
        handler.send(200, {"choices": completion(json.dumps(PLAN))["choices"]})
        return True

    server.act = uncounted
    status, said, kept = run("--latency-samples", "1")
    assert (status, len(kept)) == (0, COUNT), said
    metrics = json.loads((tmp_path / "out" / "results.json").read_text())["rows"][0]["metrics"]
    assert metrics["f1"]["value"] == 1.0 and metrics["tokens"]["value"] is None


@pytest.mark.usefixtures("forked")
def test_ctrl_c_does_not_wait_for_a_server_that_hangs(server: ChatServer, tmp_path: Path) -> None:
    data = tmp_path / "data.jsonl"
    data.write_text(
        json.dumps({"id": "m0", "prompt": "go", "expected": {"tasks": [{"title": "Transit"}]}})
        + "\n"
    )
    hanging = threading.Event()

    def hang(handler: Handler, _body: Body) -> bool:
        hanging.set()
        return handler.hang()

    server.act = hang
    flags = [
        "--endpoint",
        server.url,
        "--model",
        "tiny",
        "--level",
        "mission",
        "--data",
        str(data),
        "--out",
        str(tmp_path / "out"),
        "--timeout",
        "600",
    ]
    process = subprocess.Popen(
        [sys.executable, "-m", "planner_ft", "bench", *flags], stderr=subprocess.PIPE, text=True
    )
    assert hanging.wait(600)
    process.send_signal(signal.SIGINT)
    _out, said = process.communicate(timeout=600)
    assert process.returncode == 130 and "go on with" in said and "Traceback" not in said
