"""A small chat completions server in this process, which misbehaves as a test tells it to."""

from __future__ import annotations

import contextlib
import json
import threading
from collections.abc import Callable, Iterator
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any

from planner_ft.benchmark.sources import GREETING

Body = dict[str, Any]
Act = Callable[["Handler", Body], bool]
"""Answers a request in its own way, or returns False for the usual answer."""

PLAN = {
    "tasks": [
        {"title": "Transit", "parameters": {"target_position": [1, 1]}, "task_prompt": "Go."}
    ],
    "assumptions": [],
    "constraints": [],
}


def completion(text: str, finish: str = "stop") -> Body:
    choice = {
        "index": 0,
        "message": {"role": "assistant", "content": text},
        "finish_reason": finish,
    }
    return {"choices": [choice], "usage": {"prompt_tokens": 11, "completion_tokens": 7}}


class Handler(BaseHTTPRequestHandler):
    """Records what it is asked; `server.act` may answer in another way."""

    server: ChatServer
    protocol_version = "HTTP/1.1"

    def log_message(self, *_: object) -> None:
        """Tests are quiet."""

    def do_GET(self) -> None:
        if self.path == "/v1/models":
            self.send(200, {"object": "list", "data": [{"id": "tiny", "object": "model"}]})
        else:
            self.send(404, {"error": {"message": "no such path"}})

    def do_POST(self) -> None:
        server = self.server
        body = json.loads(self.rfile.read(int(self.headers["Content-Length"])))
        with server.lock:
            if asked(body) != GREETING or "response_format" in body:
                server.requests.append(
                    {"path": self.path, "key": self.headers.get("Authorization"), **body}
                )
            server.open += 1
            server.most_open = max(server.most_open, server.open)
        try:
            if not (
                server.act(self, body)
                if asked(body) != GREETING or "response_format" in body
                else server.greet(self, body)
            ):
                self.answer(body)
        finally:
            with server.lock:
                server.open -= 1

    def answer(self, body: Body) -> None:
        """The usual answer, as a stream where it is asked for."""
        text = json.dumps(PLAN)
        if not body.get("stream"):
            self.send(200, completion(text))
            return
        pieces: list[Body] = [
            {"choices": [{"index": 0, "delta": {"content": part}, "finish_reason": None}]}
            for part in (text[:9], text[9:])
        ]
        pieces.append({"choices": [{"index": 0, "delta": {}, "finish_reason": "stop"}]})
        pieces.append({"choices": [], "usage": {"prompt_tokens": 11, "completion_tokens": 7}})
        self.events(pieces)

    def events(self, pieces: list[Body], ended: bool = True) -> None:
        lines = [f"data: {json.dumps(piece)}\n\n" for piece in pieces] + (
            ["data: [DONE]\n\n"] if ended else []
        )
        self.send_bytes(200, "".join(lines).encode(), "text/event-stream")

    def send(self, status: int, value: Any, **headers: str) -> None:
        self.send_bytes(status, json.dumps(value).encode(), "application/json", **headers)

    def send_bytes(self, status: int, content: bytes, kind: str, **headers: str) -> None:
        self.send_response(status)
        self.send_header("Content-Type", kind)
        self.send_header("Content-Length", str(len(content)))
        for name, value in headers.items():
            self.send_header(name.replace("_", "-"), value)
        self.end_headers()
        self.wfile.write(content)

    def drop(self) -> None:
        """Close the connection in the middle of an answer."""
        self.send_response(200)
        self.send_header("Content-Type", "application/json")
        self.send_header("Content-Length", "1000")
        self.end_headers()
        self.wfile.write(b'{"choices": [')
        self.wfile.flush()
        self.close_connection = True

    def hang(self) -> bool:
        """Answer nothing for as long as the server runs."""
        return self.server.over.wait()

    def drip(self) -> bool:
        """Send a byte now and then, for as long as somebody reads them."""
        self.send_response(200)
        self.send_header("Content-Type", "application/json")
        self.send_header("Content-Length", "100000")
        self.end_headers()
        with contextlib.suppress(OSError):
            while not self.server.over.wait(0.02):
                self.wfile.write(b" ")
                self.wfile.flush()
        self.close_connection = True
        return True


class ChatServer(ThreadingHTTPServer):
    """`requests` are the bodies of all requests but the first greeting, `most_open` the largest
    number that was open at a time.

    `act` may answer these requests in another way, `greet` the greeting.
    """

    daemon_threads = True

    def __init__(self) -> None:
        super().__init__(("127.0.0.1", 0), Handler)
        self.act: Act = lambda _handler, _body: False
        self.greet: Act = lambda _handler, _body: False
        self.lock = threading.Lock()
        self.over = threading.Event()
        self.requests: list[Body] = []
        self.open = self.most_open = 0

    @property
    def url(self) -> str:
        return f"http://127.0.0.1:{self.server_port}/v1"


@contextlib.contextmanager
def chat_server() -> Iterator[ChatServer]:
    server = ChatServer()
    thread = threading.Thread(
        target=server.serve_forever, kwargs={"poll_interval": 0.01}, daemon=True
    )
    thread.start()
    try:
        yield server
    finally:
        server.over.set()
        server.shutdown()
        server.server_close()


def asked(body: Body) -> str:
    """The operator's command in a request."""
    return str(body["messages"][-1]["content"])
