"""The agents behind the page, a thread that plans, and server-sent events for every open page."""

from __future__ import annotations

import asyncio
import queue
import threading
from collections.abc import AsyncIterator, Callable, Mapping
from typing import Any, Literal

from planner_ft.document.losses import lost
from planner_ft.planning.planner import Planner
from planner_ft.planning.settings import Agent, PlanSettings
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import compact_json
from planner_ft.vocabulary.plans import Level

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


Work = Callable[[Planner], None]


class BusyError(PlannerError):
    """The agents are at work already."""


class StoppedError(Exception):
    """The server ends, and so does the agents' work."""


class Planning:
    """`busy` is the agents' work now (None: nothing), `why` says why they cannot be asked."""

    def __init__(self, settings: PlanSettings, events: Events, changed: Callable[[], None]) -> None:
        """`changed` is called when the agents are loaded, or not, and when their work is done."""
        self.settings, self.events, self.changed = settings, events, changed
        self.busy: dict[str, Any] | None = None
        self.why: str | None = None
        self._agents: Mapping[Level, Agent] = {}
        self._lock = threading.Lock()
        self._work: queue.SimpleQueue[Work | None] = queue.SimpleQueue()
        self._stopping = threading.Event()
        # A daemon: the agents' work keeps nobody from ending the program.
        self._thread = threading.Thread(target=self._run, name="agents", daemon=True)

    def start(self) -> None:
        """Begin to load the agents; requests to them wait meanwhile."""
        self._thread.start()

    def stop(self) -> None:
        """End the agents' work at its next sign of progress."""
        self._stopping.set()
        self._work.put(None)

    def ended(self, seconds: float) -> bool:
        """Whether the thread has ended, or does so within this time."""
        if self._thread.ident is not None:
            self._thread.join(seconds)
        return not self._thread.is_alive()

    def go_on(self) -> None:
        """Raises StoppedError when the server ends."""
        if self._stopping.is_set():
            raise StoppedError

    def as_json(self) -> dict[str, Any]:
        """The agents as the page shows them."""
        agents, settings = list(self._agents.values()), self.settings
        candidates = [agent.candidate.name for agent in agents] or [settings.candidate]
        used = [agent.configuration.name for agent in agents] or [settings.configuration or ""]
        return {
            "available": self.why is None,
            "why": self.why,
            "candidate": " + ".join(dict.fromkeys(candidates)),
            "configuration": " + ".join(dict.fromkeys(used)),
        }

    def ask(self, busy: dict[str, Any], work: Work) -> None:
        """Have the agents do `work`. Raises BusyError, and PlannerError without agents."""
        with self._lock:
            if self.why is not None:
                raise PlannerError(self.why)
            if self.busy is not None:
                work_now = f"the agents are at work already ({self.busy['label']})"
                raise BusyError(f"{work_now}; wait until they are done")
            self.busy = {"done": 0, "total": 0, **busy}
        self.events.tell("progress", self.busy)
        self._work.put(work)

    def _run(self) -> None:
        planner = self._load()
        self.changed()
        while planner is not None and (work := self._work.get()) is not None:
            self._do(work, planner)

    def _load(self) -> Planner | None:
        """The planner with its base in memory; None, and `why`, when that cannot be."""
        try:
            planner = Planner(self.settings, self._progress, lost)
            self._agents = planner.agents.agents
            planner.agents.load("mission")
            return planner
        except StoppedError:
            return None
        except Exception as error:
            with self._lock:
                self.why, waited = sentence(error), self.busy is not None
                self.busy = None
            if waited:
                self.events.tell("error", {"error": self.why})
            return None

    def _do(self, work: Work, planner: Planner) -> None:
        failed = None
        try:
            work(planner)
        except StoppedError:
            return
        except Exception as error:
            failed = sentence(error)
        self.events.forget()
        self.busy = None
        if failed is not None:
            self.events.tell("error", {"error": failed})
        self.changed()

    def _progress(self, label: str, done: int, total: int) -> None:
        self.go_on()
        if self.busy is not None:
            self.busy = {**self.busy, "label": label, "done": done, "total": total}
            self.events.tell("progress", self.busy)


def sentence(error: Exception) -> str:
    """An error in one sentence for people."""
    if isinstance(error, PlannerError):
        return str(error)
    first = (str(error).strip().splitlines() or ["no more is known"])[0]
    return f"the agents failed ({type(error).__name__}: {first[:300]})"
