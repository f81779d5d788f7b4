"""What happens, told to every page that is open, as server-sent events."""

from __future__ import annotations

import asyncio
import threading
from collections.abc import AsyncIterator
from typing import Any, Literal

from planner_ft.support.files import compact_json

Kind = Literal["progress", "tasks", "skills", "state", "error"]

KEEP_ALIVE = 15.0
"""Seconds without an event after which a comment shows that the connection still stands."""
MOST_WAITING = 1000
"""Events that a page may be behind before its connection is given up; it then connects again."""


class Events:
    """Told from any thread, heard in the server's loop. Whoever comes while a command is planned
    hears first what was told of it.
    """

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._listeners: set[_Listener] = set()
        self._story: list[str] = []
        self._over = False

    def tell(self, kind: Kind, data: Any) -> None:
        """Send an event to every page."""
        text = f"event: {kind}\ndata: {compact_json(data)}\n\n"
        with self._lock:
            if self._over:
                return
            if kind in ("tasks", "skills"):
                self._story.append(text)
            for listener in self._listeners:
                listener.offer(text)

    def forget(self) -> None:
        """What was told of the planning that is over is no news to anybody who comes from now
        on.
        """
        with self._lock:
            self._story.clear()

    def close(self) -> None:
        """End every connection, and those to come."""
        with self._lock:
            self._over = True
            for listener in self._listeners:
                listener.offer(None)

    async def listen(self) -> AsyncIterator[str]:
        """The events from now on, until the server ends or the page is too far behind."""
        listener = _Listener(asyncio.get_running_loop())
        with self._lock:
            if self._over:
                return
            for told in (": connected\n\n", *self._story):
                listener.queue.put_nowait(told)
            self._listeners.add(listener)
        try:
            while (text := await listener.next()) is not None:
                yield text
        finally:
            with self._lock:
                self._listeners.discard(listener)


class _Listener:
    """One open page. `None` in the queue ends its connection."""

    def __init__(self, loop: asyncio.AbstractEventLoop) -> None:
        self.loop = loop
        self.queue: asyncio.Queue[str | None] = asyncio.Queue()

    def offer(self, text: str | None) -> None:
        self.loop.call_soon_threadsafe(
            self.queue.put_nowait, text if self.queue.qsize() < MOST_WAITING else None
        )

    async def next(self) -> str | None:
        try:
            async with asyncio.timeout(KEEP_ALIVE):
                return await self.queue.get()
        except TimeoutError:
            return ": still here\n\n"
