"""Who may talk to the server: this machine's own browser, with the key that the terminal showed.

A page of another site can send requests to a server on loopback, and a name that it controls can be
made to point there (DNS rebinding). Host, Origin and Sec-Fetch-Site tell such requests apart; the
key keeps out the other users of the machine.
"""

from __future__ import annotations

import asyncio
import contextlib
import ipaddress
import secrets
from dataclasses import dataclass, field
from pathlib import Path

from starlette.datastructures import MutableHeaders
from starlette.requests import Request
from starlette.responses import JSONResponse, PlainTextResponse, Response
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from planner_ft.support.files import read_json

LARGEST_BODY = 256 * 1024
"""Bytes of a request's body at most."""
TOO_LARGE = f"The request is larger than {LARGEST_BODY // 1024} kB; send less."
PATIENCE_S = 1.0
"""How long the body of a refused request is waited for."""
HEADERS: dict[str, str] = read_json(Path(__file__).with_name("headers.json"))
"""Headers of every answer."""
ASK_THE_TERMINAL = (
    "This page needs the address that the terminal shows, with its key: open that one."
)
OTHER_NAME = (
    "This server does not answer under that name; open the address that the terminal shows."
)


@dataclass
class Door:
    """Host and port of the server, the session's key, and one that opens it once (a browser's)."""

    host: str
    port: int
    key: str = field(default_factory=lambda: secrets.token_urlsafe(32))
    once: str | None = field(default_factory=lambda: secrets.token_urlsafe(32))

    def is_session(self, key: str) -> bool:
        """Whether this is the session's key."""
        return _same(key, self.key)

    def opens(self, key: str) -> bool:
        """Whether this key opens the session; the other key does so once."""
        if self.once is not None and _same(key, self.once):
            self.once = None
            return True
        return self.is_session(key)

    @property
    def cookie(self) -> str:
        """The cookie's name. Cookies are shared by the ports of a machine, so the port is in it."""
        return f"plannerft_{self.port}"

    def knows(self, host: str) -> bool:
        """Whether a Host header names this server; any IP address does on a wildcard."""
        name, _colon, port = host.rpartition(":")
        if port != str(self.port):
            return False
        if name in ("127.0.0.1", "localhost", "[::1]", bracketed(self.host)):
            return True
        with contextlib.suppress(ValueError):
            return is_wildcard(self.host) and bool(ipaddress.ip_address(name.strip("[]")))
        return False

    def admits(self, request: Request) -> bool:
        """Whether a request has the session's key, in its cookie or as a bearer."""
        cookie = request.cookies.get(self.cookie, "")
        return self.is_session(cookie) or self.is_bearer(request)

    def is_bearer(self, request: Request) -> bool:
        """Whether the Authorization header has the session's key, which no other site has."""
        scheme, _space, key = request.headers.get("authorization", "").partition(" ")
        return scheme.lower() == "bearer" and self.is_session(key)


def _same(key: str, other: str) -> bool:
    """Whether two keys are the same, compared in constant time."""
    return secrets.compare_digest(key.encode(errors="replace"), other.encode())


def bracketed(host: str) -> str:
    """A host as it stands in an address: IPv6 in brackets."""
    return f"[{host}]" if ":" in host else host


def is_wildcard(host: str) -> bool:
    """Whether a host stands for all addresses of the machine."""
    return host in ("0.0.0.0", "::", "")


class Guard:
    """ASGI middleware that passes on only admitted requests, and adds the headers."""

    def __init__(self, app: ASGIApp, door: Door) -> None:
        self.app, self.door = app, door

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] != "http":
            await self.app(scope, receive, send)
            return

        async def with_headers(message: Message) -> None:
            if message["type"] == "http.response.start":
                MutableHeaders(scope=message).update(HEADERS)
            await send(message)

        answer: ASGIApp = self.app
        if refused := refusal(request := Request(scope), self.door):
            answer = _refused(*refused, is_api=_is_api(request))
            if request.method == "POST" and refused != (413, TOO_LARGE):
                await _read_on(receive)
        await answer(scope, receive, with_headers)


async def _read_on(receive: Receive) -> None:
    """Read a refused request's body: a connection that ends before is reset, the answer lost."""
    with contextlib.suppress(TimeoutError):
        async with asyncio.timeout(PATIENCE_S):
            while (await receive()).get("more_body"):
                pass


def refusal(request: Request, door: Door) -> tuple[int, str] | None:
    """Status and sentence for a request that is not admitted; None for one that is."""
    headers, is_change = request.headers, request.method == "POST"
    if request.method not in ("GET", "POST"):
        return 405, f"{request.method} is not used here; only GET and POST are."
    hosts = headers.getlist("host")
    if len(hosts) != 1 or not door.knows(hosts[0]):
        return 403, OTHER_NAME
    # A person may follow a link from anywhere to the page itself, not to the interface.
    site = headers.get("sec-fetch-site", "same-origin")
    if _is_api(request) and site != "same-origin" and (is_change or site != "none"):
        return 403, "This request comes from a page of another site."
    if _is_api(request) and not door.admits(request):
        return 403, ASK_THE_TERMINAL
    if not is_change:
        return None
    origin = headers.get("origin")
    if origin != f"http://{hosts[0]}" and not (origin is None and door.is_bearer(request)):
        return 403, "This request comes from a page of another site, or does not say from which."
    kind = headers.get("content-type", "").partition(";")[0].strip().lower()
    if kind != "application/json":
        return 415, "Only JSON is read here; send Content-Type: application/json."
    length = headers.get("content-length", "0")
    if not (length.isascii() and length.isdecimal() and int(length) <= LARGEST_BODY):
        return 413, TOO_LARGE
    return None


def _is_api(request: Request) -> bool:
    return request.url.path.startswith("/api/")


def _refused(status: int, sentence: str, *, is_api: bool) -> Response:
    # A connection is kept for those alone who are admitted.
    closing = {"Connection": "close"}
    if is_api:
        return JSONResponse({"error": sentence}, status, closing)
    return PlainTextResponse(sentence + "\n", status, closing)
