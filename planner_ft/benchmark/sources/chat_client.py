"""Asking a chat completions server, again where that can help: one question at a time per call, any
number of threads.
"""

from __future__ import annotations

import email.utils
import json
import random
import threading
import time
from dataclasses import replace
from datetime import UTC, datetime
from typing import TYPE_CHECKING, Any

from planner_ft.benchmark.sources.chat_reply import (
    BadReply,
    Reply,
    excerpt,
    read_events,
    read_whole,
    within,
)
from planner_ft.benchmark.sources.endpoint_settings import CHAT, EndpointSettings
from planner_ft.support.errors import PlannerError

if TYPE_CHECKING:
    import httpx2

FIRST_PAUSE, LONGEST_PAUSE = 0.5, 30.0
"""Seconds before the second attempt, doubled before each later one up to the longest; a random half
is taken off.
"""
LONGEST_WAIT = 600.0
"""Seconds that a server may ask us to wait (Retry-After) before we call it closed."""
PASSING = frozenset({408, 409, 425, 429})
"""Statuses below 500 that may pass."""
KEPT = "what is answered so far is kept for --resume"


class Unanswerable(Exception):
    """The server cannot answer this one question, because it does not fit its context."""


class Rejected(PlannerError):
    """The server understood the request and will not serve it; asking again changes nothing.
    `status` is HTTP's.
    """

    def __init__(self, message: str, status: int) -> None:
        super().__init__(message)
        self.status = status


class _Passing(Exception):
    """A failure that may pass; `wait` is the pause in seconds that the server asks for."""

    def __init__(self, reason: str, wait: float | None = None) -> None:
        super().__init__(reason)
        self.wait = wait


class ChatClient:
    """A server's API. Raises PlannerError with one sentence when it stays out of reach."""

    def __init__(self, settings: EndpointSettings) -> None:
        import httpx2

        self.settings = settings
        self.key = settings.api_key()
        headers = {"Authorization": f"Bearer {self.key}"} if self.key else {}
        limits = httpx2.Limits(
            max_connections=settings.concurrency, max_keepalive_connections=settings.concurrency
        )
        self.http = httpx2.Client(headers=headers, timeout=settings.timeout, limits=limits)
        self.stopped = threading.Event()

    def complete(
        self, body: dict[str, Any], *, stream: bool = False, retries: int | None = None
    ) -> Reply:
        """The answer to a chat completions request; `stream` has it sent piece by piece, to know
        when the first piece came.

        Dropped connections, timeouts, rubbish, 429 and 5xx are tried again after growing pauses.
        Raises Unanswerable when the question is too long, Rejected when the server refuses,
        PlannerError when every attempt has failed; there are as many as the settings say, or one
        more than `retries`.
        """
        retries = self.settings.retries if retries is None else retries
        if stream:
            body = {**body, "stream": True, "stream_options": {"include_usage": True}}
        for attempt in range(1, retries + 2):
            try:
                return replace(self._exchange(body), attempts=attempt)
            except _Passing as problem:
                if attempt > retries or self._pause(attempt, problem.wait):
                    times = f" ({attempt} times in a row)" if attempt > 1 else ""
                    raise PlannerError(
                        f"{self.settings.root}: the server {problem}{times}; look after the server"
                        f" and go on: {KEPT}"
                    ) from None
        raise AssertionError("unreachable: the last attempt returns or raises")

    def models(self) -> list[dict[str, Any]] | None:
        """What the server says it serves (GET /models), None where it does not say."""
        import httpx2

        deadline = time.perf_counter() + self.settings.timeout
        try:
            with self.http.stream("GET", f"{self.settings.root}/models") as response:
                value = json.loads(b"".join(within(response.iter_bytes(), deadline)))
        except (httpx2.HTTPError, httpx2.InvalidURL, BadReply, ValueError):
            return None
        found = value.get("data") if isinstance(value, dict) else None
        return (
            [entry for entry in found if isinstance(entry, dict)]
            if isinstance(found, list)
            else None
        )

    def stop(self) -> None:
        """No further attempts: open requests of other threads end with what they get."""
        self.stopped.set()

    def close(self) -> None:
        self.stop()
        self.http.close()

    def _exchange(self, body: dict[str, Any]) -> Reply:
        """One attempt."""
        import httpx2

        started = time.perf_counter()
        deadline = started + self.settings.timeout
        try:
            with self.http.stream("POST", f"{self.settings.root}{CHAT}", json=body) as response:
                chunks = within(response.iter_bytes(), deadline)
                if response.status_code != 200:
                    raise self._refusal(response, b"".join(chunks))
                events = response.headers.get("content-type", "").startswith("text/event-stream")
                return read_events(chunks, started) if events else read_whole(chunks, started)
        except BadReply as problem:
            raise _Passing(self._without_key(str(problem))) from None
        except httpx2.InvalidURL as error:
            raise PlannerError(
                f"--endpoint {self.settings.root}: no http URL ({error}); give the API's root, such"
                " as http://127.0.0.1:8000/v1"
            ) from None
        except httpx2.TimeoutException:
            raise _Passing(f"did not answer within {self.settings.timeout:g} s") from None
        except httpx2.HTTPError as error:
            kind = (
                "cannot be reached"
                if isinstance(error, httpx2.ConnectError)
                else "dropped the connection"
            )
            raise _Passing(f"{kind} ({self._without_key(excerpt(str(error)))})") from None

    def _refusal(self, response: httpx2.Response, body: bytes) -> Exception:
        """What a status other than 200 means."""
        status, said = response.status_code, self._without_key(excerpt(body))
        answer = f"HTTP {status}: {said}"
        if status in PASSING or status >= 500:
            return _Passing(f"answers {answer}", _asked_wait(response.headers.get("retry-after")))
        if status in (401, 403):
            given = (
                f"the key in {self.settings.api_key_env}" if self.key else "requests without a key"
            )
            return Rejected(
                f"{self.settings.root}: the server refuses {given} ({answer}); name the variable of"
                " a valid key with --api-key-env",
                status,
            )
        if status == 404:
            return Rejected(
                f"{self.settings.root}: no chat API or no model {self.settings.model} there"
                f" ({answer}){self._served()}",
                status,
            )
        if status in (400, 413, 422) and _speaks_of_length(said):
            return Unanswerable(answer)
        return Rejected(
            f"{self.settings.root}: the server does not take our request ({answer}); {KEPT}", status
        )

    def _served(self) -> str:
        names = [str(entry.get("id")) for entry in self.models() or []]
        return (
            f"; it serves {', '.join(names[:5])}"
            if names
            else "; check --endpoint (often it ends with /v1) and --model"
        )

    def _without_key(self, text: str) -> str:
        """Servers like to repeat a key that they refuse."""
        return text.replace(self.key, "***") if self.key else text

    def _pause(self, attempt: int, asked: float | None) -> bool:
        """Wait before the next attempt; return whether there shall be none, because another
        thread's question has failed for good.
        """
        if asked is not None and asked > LONGEST_WAIT:
            raise PlannerError(
                f"{self.settings.root}: the server asks to wait for {asked:.0f} s; go on then:"
                f" {KEPT}"
            )
        backoff = min(LONGEST_PAUSE, FIRST_PAUSE * 2 ** (attempt - 1))
        return self.stopped.wait(asked if asked is not None else backoff * random.uniform(0.5, 1.0))


def _asked_wait(header: str | None) -> float | None:
    """Seconds that Retry-After asks for: a number, or a date (RFC 9110, 10.2.3)."""
    if not header:
        return None
    try:
        return max(0.0, float(header))
    except ValueError:
        pass
    try:
        moment = email.utils.parsedate_to_datetime(header)
    except ValueError:
        return None
    return max(0.0, (moment.astimezone(UTC) - datetime.now(UTC)).total_seconds())


def _speaks_of_length(message: str) -> bool:
    """Whether a refusal is about this question's length: vLLM, llama.cpp and OpenAI all name the
    context.
    """
    lowered = message.lower()
    return "context" in lowered and any(
        word in lowered for word in ("length", "window", "exceed", "size", "long")
    )
