"""Who may talk to the server: this machine's own browser, with the key that the terminal showed.

A page of another site can send requests to a server on loopback, and a name that it controls can be
made to point there (DNS rebinding). Host, Origin and Sec-Fetch-Site tell such requests apart; the
key keeps out the other users of the machine.
"""

from __future__ import annotations

import ipaddress
import secrets
from collections.abc import Callable
from dataclasses import dataclass, field

from starlette.datastructures import MutableHeaders
from starlette.requests import Request
from starlette.responses import JSONResponse, PlainTextResponse, Response
from starlette.types import ASGIApp, Message, Receive, Scope, Send

LARGEST_BODY = 256 * 1024
"""Bytes of a request's body at most."""
HEADERS = {
    "Content-Security-Policy": (
        "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; img-src"
        " 'self' data:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
    ),
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "no-referrer",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Cache-Control": "no-store",
}
"""What every answer says to the browser."""
ASK_THE_TERMINAL = (
    "This page needs the address that the terminal shows, with its key: open that one."
)


@dataclass
class Keys:
    """The key of a session, and one that opens it once: the command line of a browser, which others
    on the machine can read, holds the latter.
    """

    session: str = field(default_factory=lambda: secrets.token_urlsafe(32))
    once: str | None = field(default_factory=lambda: secrets.token_urlsafe(32))

    def is_session(self, key: str) -> bool:
        """Whether this is the session's key, compared in constant time."""
        return secrets.compare_digest(key.encode(errors="replace"), self.session.encode())

    def opens(self, key: str) -> bool:
        """Whether this key opens the session: its own, or the one that does so once and is then
        used up.
        """
        if self.once is not None and secrets.compare_digest(
            key.encode(errors="replace"), self.once.encode()
        ):
            self.once = None
            return True
        return self.is_session(key)


@dataclass(frozen=True)
class Door:
    """Where the server listens, and the keys to it."""

    host: str
    port: int
    keys: Keys = field(default_factory=Keys)

    @property
    def cookie(self) -> str:
        """The cookie's name. Cookies are shared by the ports of a machine, so the port is in it."""
        return f"plannerft_{self.port}"

    def knows(self, host: str) -> bool:
        """Whether a Host header names this server.

        On a wildcard address any IP address does: a name could be anybody's, an address cannot be
        made to point elsewhere.
        """
        named = {"127.0.0.1", "localhost", "[::1]", bracketed(self.host)}
        name, _colon, port = host.rpartition(":")
        if port != str(self.port):
            return False
        return name in named or (is_wildcard(self.host) and _is_address(name.strip("[]")))

    def admits(self, request: Request) -> bool:
        """Whether a request has the session's key, in its cookie or as a bearer."""
        return self.keys.is_session(request.cookies.get(self.cookie, "")) or is_bearer(
            request, self
        )


def is_bearer(request: Request, door: Door) -> bool:
    """Whether a request has the session's key in its Authorization header: a program that was given
    it, no page of another site.
    """
    scheme, _space, key = request.headers.get("authorization", "").partition(" ")
    return scheme.lower() == "bearer" and door.keys.is_session(key)


def bracketed(host: str) -> str:
    """A host as it stands in an address: IPv6 in brackets."""
    return f"[{host}]" if ":" in host else host


def is_wildcard(host: str) -> bool:
    """Whether a host stands for all addresses of the machine."""
    return host in ("0.0.0.0", "::", "")


def _is_address(text: str) -> bool:
    try:
        return bool(ipaddress.ip_address(text))
    except ValueError:
        return False


class Guard:
    """Passes on only what may be, and adds the headers. Wraps the whole application."""

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

        refused = refusal(Request(scope), self.door)
        await (refused or self.app)(scope, receive, with_headers)


def refusal(request: Request, door: Door) -> Response | None:
    """The answer to a request that may not be; None when it may."""
    for check in CHECKS:
        found = check(request, door)
        if found is not None:
            status, sentence = found
            return (
                JSONResponse({"error": sentence}, status)
                if request.url.path.startswith("/api/")
                else PlainTextResponse(sentence + "\n", status)
            )
    return None


Check = Callable[[Request, Door], tuple[int, str] | None]


def _method(request: Request, _door: Door) -> tuple[int, str] | None:
    return (
        None
        if request.method in ("GET", "POST")
        else (405, f"{request.method} is not used here; only GET and POST are.")
    )


def _host(request: Request, door: Door) -> tuple[int, str] | None:
    hosts = request.headers.getlist("host")
    return (
        None
        if len(hosts) == 1 and door.knows(hosts[0])
        else (
            403,
            (
                "This server does not answer under that name; open the address that the terminal"
                " shows."
            ),
        )
    )


def _site(request: Request, _door: Door) -> tuple[int, str] | None:
    """What browsers say of the page that a request comes from; a person who follows a link to the
    page itself is fine.
    """
    said = request.headers.get("sec-fetch-site")
    allowed = ("same-origin",) if request.method == "POST" else ("same-origin", "none")
    fine = said is None or said in allowed or not request.url.path.startswith("/api/")
    return None if fine else (403, "This request comes from a page of another site.")


def _session(request: Request, door: Door) -> tuple[int, str] | None:
    return (
        None
        if not request.url.path.startswith("/api/") or door.admits(request)
        else (403, ASK_THE_TERMINAL)
    )


def _origin(request: Request, door: Door) -> tuple[int, str] | None:
    if request.method != "POST":
        return None
    origin = request.headers.get("origin")
    same = (
        is_bearer(request, door)
        if origin is None
        else origin == f"http://{request.headers['host']}"
    )
    return (
        None
        if same
        else (403, "This request comes from a page of another site, or does not say from which.")
    )


def _body(request: Request, _door: Door) -> tuple[int, str] | None:
    if request.method != "POST":
        return None
    if (
        request.headers.get("content-type", "").partition(";")[0].strip().lower()
        != "application/json"
    ):
        return 415, "Only JSON is read here; send Content-Type: application/json."
    length = request.headers.get("content-length", "0")
    if not length.isascii() or not length.isdecimal() or int(length) > LARGEST_BODY:
        return 413, too_large()
    return None


def too_large() -> str:
    """What is said of a body that is too large."""
    return f"The request is larger than {LARGEST_BODY // 1024} kB; send less."


CHECKS: tuple[Check, ...] = (_method, _host, _site, _session, _origin, _body)
