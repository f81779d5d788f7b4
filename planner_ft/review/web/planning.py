"""The agents behind the page: a thread that loads them, then plans one command or task."""

from __future__ import annotations

import queue
import threading
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

from planner_ft.planning.settings import Agent, PlanSettings
from planner_ft.review.web.events import Events
from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary.plans import Level

if TYPE_CHECKING:
    from planner_ft.planning.planner import Planner

Work = Callable[["Planner"], None]


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
            from planner_ft.planning.planner import Planner

            planner = Planner(self.settings, self._progress)
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
