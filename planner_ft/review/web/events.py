"""Events for every page that is open, as server-sent events."""

from __future__ import annotations

import asyncio
import threading
from collections.abc import AsyncIterator
from typing import Any, Literal

from planner_ft.support.files import compact_json

Kind = Literal["progress", "tasks", "skills", "state", "error", "run"]

KEEP_ALIVE = 15.0
"""Seconds without an event after which a comment shows that the connection still stands."""
MOST_WAITING = 1000
"""Events that a page may be behind before its connection is given up; it then connects again."""


class Events:
    """Sent from any thread, heard in the server's loop; a new page starts with the plan so far."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._pages: dict[asyncio.Queue[str | None], asyncio.AbstractEventLoop] = {}
        self._story: list[str] = []
        self._over = False

    def tell(self, kind: Kind, data: Any) -> None:
        """Send an event to every page."""
        text = f"event: {kind}\ndata: {compact_json(data)}\n\n"
        with self._lock:
            if kind in ("tasks", "skills"):
                self._story.append(text)
            self._offer(text)

    def forget(self) -> None:
        """The planning is over: pages that come from now on hear nothing of it."""
        with self._lock:
            self._story.clear()

    def close(self) -> None:
        """End every connection, and those to come."""
        with self._lock:
            self._offer(None)
            self._over = True

    async def listen(self) -> AsyncIterator[str]:
        """The events from now on, until the server ends or the page is too far behind."""
        queue: asyncio.Queue[str | None] = asyncio.Queue()
        with self._lock:
            if self._over:
                return
            for text in (": connected\n\n", *self._story):
                queue.put_nowait(text)
            self._pages[queue] = asyncio.get_running_loop()
        try:
            while (heard := await _next(queue)) is not None:
                yield heard
        finally:
            with self._lock:
                del self._pages[queue]

    def _offer(self, text: str | None) -> None:
        """Put a text into every queue; None ends a connection."""
        if not self._over:
            for queue, loop in self._pages.items():
                behind = queue.qsize() >= MOST_WAITING
                loop.call_soon_threadsafe(queue.put_nowait, None if behind else text)


async def _next(queue: asyncio.Queue[str | None]) -> str | None:
    try:
        async with asyncio.timeout(KEEP_ALIVE):
            return await queue.get()
    except TimeoutError:
        return ": still here\n\n"
