"""Serving a review until Ctrl-C."""

from __future__ import annotations

import asyncio
import errno
import os
import socket
import sys
import threading
import webbrowser
from pathlib import Path
from typing import Any, ClassVar

import h11
import uvicorn
from uvicorn.protocols.http.h11_impl import H11Protocol

from planner_ft.review.web.app import web_app
from planner_ft.review.web.guard import Door, bracketed, is_wildcard
from planner_ft.review.web.session import LOOPBACK, Session, WebSettings
from planner_ft.support.errors import PlannerError
from planner_ft.support.terminal import show

SLOWEST_REQUEST = 10.0
"""Seconds within which a request must have come in whole."""
MOST_UNFINISHED = 100
"""Connections without a whole request; the oldest is closed for one more, whoever comes."""
GRACE = 1
"""Seconds that answers which are on their way are given when the server ends."""


def serve(plan: Path | None, settings: WebSettings) -> None:
    """Serve the review of a plan, or of plans to come (for that plan's vehicle), until Ctrl-C.

    Ends the process itself when the agents are still at work. Raises PlannerError.
    """
    session = Session(plan, settings)
    with _listening(settings) as listener:
        door = Door(settings.host, listener.getsockname()[1])
        try:
            _say_where(settings, door)
            _Server(session, door).run(sockets=[listener])
        except KeyboardInterrupt:
            show(_farewell(session))
        if not session.planning.ended(GRACE / 2):
            # The agents cannot be stopped at once, and tearing their thread down would crash.
            # All that counts is on the disk.
            sys.stderr.flush()
            os._exit(0)


class _Server(uvicorn.Server):
    """Ends the open event streams first: they would keep it waiting."""

    def __init__(self, session: Session, door: Door) -> None:
        self.session = session
        config = uvicorn.Config(
            web_app(session, door),
            http=_PromptProtocol,
            ws="none",
            lifespan="on",
            log_level="error",
            access_log=False,
            server_header=False,
            proxy_headers=False,
            timeout_graceful_shutdown=GRACE,
        )
        super().__init__(config)

    async def shutdown(self, sockets: list[socket.socket] | None = None) -> None:
        self.session.end()
        await super().shutdown(sockets)


class _PromptProtocol(H11Protocol):
    """Closes connections whose request is not in within SLOWEST_REQUEST; uvicorn waits for ever."""

    unfinished: ClassVar[dict[_PromptProtocol, asyncio.TimerHandle]] = {}

    def connection_made(self, transport: Any) -> None:
        super().connection_made(transport)
        self._watch()

    def data_received(self, data: bytes) -> None:
        super().data_received(data)
        self._watch()

    def connection_lost(self, exc: Exception | None) -> None:
        self._unwatch()
        super().connection_lost(exc)

    def _watch(self) -> None:
        """Set the time when the first byte is due or came; stop it when the request is there."""
        if self.conn.their_state not in (h11.IDLE, h11.SEND_BODY):
            self._unwatch()
        elif self not in self.unfinished:
            if len(self.unfinished) >= MOST_UNFINISHED:
                oldest = next(iter(self.unfinished))
                oldest._unwatch()
                oldest.transport.abort()
            self.unfinished[self] = self.loop.call_later(SLOWEST_REQUEST, self.transport.abort)

    def _unwatch(self) -> None:
        if limit := self.unfinished.pop(self, None):
            limit.cancel()


def _listening(settings: WebSettings) -> socket.socket:
    """A socket on the address of the settings. Raises PlannerError."""
    host, port = settings.host, settings.port
    try:
        family, _kind, _protocol, _name, address = socket.getaddrinfo(
            host or None, port, type=socket.SOCK_STREAM, flags=socket.AI_PASSIVE
        )[0]
        dual = family == socket.AF_INET6 and socket.has_dualstack_ipv6()
        return socket.create_server(address, family=family, dualstack_ipv6=dual)
    except OSError as error:
        taken = error.errno == errno.EADDRINUSE
        if port and (taken or isinstance(error, PermissionError)):
            why = "another program listens there" if taken else "this user may not listen there"
            way = "give another port, or leave the flag out for a free one"
            raise PlannerError(f"--port {port}: {why}; {way}") from None
        problem = f"--host {host}: cannot be listened on ({error.strerror})"
        raise PlannerError(f"{problem}; leave the flag out for {LOOPBACK}") from None


def _say_where(settings: WebSettings, door: Door) -> None:
    """Print the address, warn where others can reach it, and open it with the key for once."""
    if not settings.is_loopback:
        show(
            f"--host {settings.host}: others on the network can reach this page, and what it sends"
            " is not encrypted; who has the address below can approve plans",
            error=True,
        )
    host = LOOPBACK if is_wildcard(settings.host) else settings.host
    base = f"http://{bracketed(host)}:{door.port}/?token="
    show(f"Review at {base}{door.key}\nCtrl-C ends it.")
    # Without a screen a text browser would take the terminal.
    screen = os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")
    if settings.open_browser and (screen or sys.platform in ("darwin", "win32")):
        address = f"{base}{door.once}"
        threading.Thread(target=webbrowser.open, args=(address,), daemon=True).start()


def _farewell(session: Session) -> str:
    """Where plan and decisions are, and unfinished work."""
    path, busy = session.path, session.planning.busy
    saved = f"the plan is saved in {path}, decisions in {session.log}"
    unfinished = f"; {busy['what']} was not finished" if busy else ""
    return f"\nended: {saved if path else 'there was no plan to save'}{unfinished}"
