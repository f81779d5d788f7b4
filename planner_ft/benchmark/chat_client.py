"""Asking a chat completions server, again where that can help, and reading its replies: one JSON
object, or server-sent events.
"""

from __future__ import annotations

import contextlib
import email.utils
import json
import random
import threading
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from datetime import UTC, datetime
from queue import SimpleQueue
from typing import TYPE_CHECKING, Any, TypeVar

from planner_ft.benchmark.settings import CHAT, ROOT, EndpointSettings
from planner_ft.confidence.parts import Choice, Choices, known
from planner_ft.support.errors import PlannerError
from planner_ft.support.tables import printable

if TYPE_CHECKING:
    import httpx2

Item = TypeVar("Item")
Result = TypeVar("Result")

FIRST_PAUSE, LONGEST_PAUSE = 0.5, 30.0
"""Seconds before a second attempt, doubled up to the longest, less up to a random half."""
LONGEST_WAIT = 600.0
"""Seconds that a server may ask us to wait (Retry-After) before we call it closed."""
PASSING = frozenset({408, 409, 425, 429})  # statuses below 500 that may pass
KEPT = "what is answered so far is kept for --resume"


class Passing(Exception):
    """A failure that may pass (no connection, cut off, too slow, no JSON) after `wait` seconds."""

    def __init__(self, reason: str, wait: float | None = None) -> None:
        super().__init__(reason)
        self.wait = wait


@dataclass(frozen=True)
class Reply:
    """An answer. `seconds` is the time from the question to its end, `first_token_s` to the first
    text (streams alone); `problem` says why there is no text. `choices` are log-probabilities that
    can be believed.
    """

    text: str
    seconds: float
    finish_reason: str
    tokens: int | None = None
    prompt_tokens: int | None = None
    first_token_s: float | None = None
    attempts: int = 1
    problem: str | None = None
    choices: Choices | None = None


class Unanswerable(Exception):
    """The server cannot answer this one question, because it does not fit its context."""


class Rejected(PlannerError):
    """The server understood and will not serve the request, ever; `status` is HTTP's."""

    def __init__(self, message: str, status: int) -> None:
        super().__init__(message)
        self.status = status


class ChatClient:
    """A server's API. Raises PlannerError with one sentence when it stays out of reach."""

    def __init__(self, settings: EndpointSettings) -> None:
        import httpx2

        self.settings = settings
        self.key = settings.api_key()
        most = settings.concurrency
        self.http = httpx2.Client(
            headers={"Authorization": f"Bearer {self.key}"} if self.key else {},
            timeout=settings.timeout,
            limits=httpx2.Limits(max_connections=most, max_keepalive_connections=most),
        )
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
        attempt = 1
        while True:
            try:
                return replace(self._exchange(body), attempts=attempt)
            except Passing as problem:
                if attempt > retries or self._pause(attempt, problem.wait):
                    times = f" ({attempt} times in a row)" if attempt > 1 else ""
                    said = f"the server {self._without_key(str(problem))}{times}"
                    way = f"look after the server and go on: {KEPT}"
                    raise PlannerError(f"{self.settings.root}: {said}; {way}") from None
            attempt += 1

    def complete_all(
        self, function: Callable[[Item], Result], items: Sequence[Item]
    ) -> Iterator[tuple[int, Result]]:
        """Yield (index of the item, result) as results come, `concurrency` at a time. When a call
        raises, no further item is begun, those that were begun are waited for and yielded if they
        succeed, and then the first exception is raised. The threads are daemons, so that a program
        can end while a server hangs.
        """

        todo, lock = iter(enumerate(items)), threading.Lock()
        came = SimpleQueue[tuple[int, Result] | BaseException | None]()

        def work() -> None:
            while not self.stopped.is_set():
                with lock:
                    at, item = next(todo, (-1, None))
                if at < 0:
                    break
                try:
                    came.put((at, function(item)))  # type: ignore[arg-type]
                except BaseException as error:
                    self.stopped.set()
                    came.put(error)
            came.put(None)

        failures, working = list[BaseException](), min(self.settings.concurrency, len(items))
        try:
            for _thread in range(working):
                threading.Thread(target=work, daemon=True).start()
            while working:
                found = came.get()
                if isinstance(found, BaseException):
                    failures.append(found)
                elif found is not None:
                    yield found
                else:
                    working -= 1
        except BaseException:
            self.stopped.set()
            raise
        if failures:
            raise failures[0]

    def models(self) -> list[dict[str, Any]] | None:
        """The models that the server says it serves (GET /models), None where it does not say."""
        import httpx2

        deadline = time.perf_counter() + self.settings.timeout
        try:
            with self.http.stream("GET", f"{self.settings.root}/models") as response:
                value = json.loads(b"".join(within(response.iter_bytes(), deadline)))
        except (httpx2.HTTPError, httpx2.InvalidURL, Passing, ValueError):
            return None
        found = value.get("data") if isinstance(value, dict) else None
        return [one for one in found if isinstance(one, dict)] if isinstance(found, list) else None

    def close(self) -> None:
        """No further attempts: open requests of other threads end with what they get."""
        self.stopped.set()
        self.http.close()

    def _exchange(self, body: dict[str, Any]) -> Reply:
        import httpx2

        started = time.perf_counter()
        root, timeout = self.settings.root, self.settings.timeout
        try:
            with self.http.stream("POST", f"{root}{CHAT}", json=body) as response:
                chunks = within(response.iter_bytes(), started + timeout)
                if response.status_code != 200:
                    raise self._refusal(response, b"".join(chunks))
                events = response.headers.get("content-type", "").startswith("text/event-stream")
                return read_reply(chunks, started, streamed=events)
        except httpx2.InvalidURL as error:
            raise PlannerError(f"--endpoint {root}: no http URL ({error}); {ROOT}") from None
        except httpx2.TimeoutException:
            raise Passing(f"did not answer within {timeout:g} s") from None
        except httpx2.HTTPError as error:
            reached = not isinstance(error, httpx2.ConnectError)
            kind = "dropped the connection" if reached else "cannot be reached"
            raise Passing(f"{kind} ({excerpt(str(error))})") from None

    def _refusal(self, response: httpx2.Response, body: bytes) -> Exception:
        """The meaning of a status other than 200."""
        status, root, model = response.status_code, self.settings.root, self.settings.model
        message = self._without_key(excerpt(body))
        answer = f"HTTP {status}: {message}"
        if status in PASSING or status >= 500:
            return Passing(f"answers {answer}", _asked_wait(response.headers.get("retry-after")))
        if status in (400, 413, 422) and _is_about_length(message):
            return Unanswerable(answer)
        problem = f"the server does not take our request ({answer}); {KEPT}"
        if status in (401, 403):
            named = f"the key in {self.settings.api_key_env}"
            refused = named if self.key else "requests without a key"
            way = "name the variable of a valid key with --api-key-env"
            problem = f"the server refuses {refused} ({answer}); {way}"
        elif status == 404:
            names = ", ".join(printable(str(one.get("id"))) for one in (self.models() or [])[:5])
            hint = "check --endpoint (often it ends with /v1) and --model"
            hint = f"it serves {names}" if names else hint
            problem = f"no chat API or no model {model} there ({answer}); {hint}"
        return Rejected(f"{root}: {problem}", status)

    def _without_key(self, text: str) -> str:
        """Servers like to repeat a key that they refuse."""
        return text.replace(self.key, "***") if self.key else text

    def _pause(self, attempt: int, asked: float | None) -> bool:
        """Wait before the next attempt; True: there shall be none, another thread's has failed."""
        if asked is not None and asked > LONGEST_WAIT:
            wait = f"the server asks to wait for {asked:.0f} s"
            raise PlannerError(f"{self.settings.root}: {wait}; go on then: {KEPT}")
        backoff = min(LONGEST_PAUSE, FIRST_PAUSE * 2 ** (attempt - 1))
        return self.stopped.wait(asked if asked is not None else backoff * random.uniform(0.5, 1.0))


def _asked_wait(header: str | None) -> float | None:
    """Seconds that Retry-After asks for: a number, or a date (RFC 9110, 10.2.3)."""
    with contextlib.suppress(ValueError):
        return max(0.0, float(header or "none"))
    try:
        moment = email.utils.parsedate_to_datetime(header or "")
    except ValueError:
        return None
    return max(0.0, (moment.astimezone(UTC) - datetime.now(UTC)).total_seconds())


def _is_about_length(message: str) -> bool:
    """Whether a refusal is about a question's length: all servers name the context."""
    lowered = message.lower()
    words = ("length", "window", "exceed", "size", "long")
    return "context" in lowered and any(word in lowered for word in words)


def within(chunks: Iterable[bytes], deadline: float) -> Iterator[bytes]:
    """A reply's chunks. Raises Passing after `deadline` (time.perf_counter)."""
    for chunk in chunks:
        if time.perf_counter() > deadline:
            raise Passing("did not finish its answer in time")
        yield chunk


def read_reply(chunks: Iterable[bytes], started: float, *, streamed: bool) -> Reply:
    """A reply, one JSON object or server-sent events that say when they end. Raises Passing."""
    text, reason, first, problem, choices = "", None, None, None, None
    usage: tuple[int | None, int | None] = (None, None)
    for value in _events(chunks) if streamed else [_json_object(b"".join(chunks))]:
        counted = _usage(value)
        usage = usage if counted[0] is None else counted
        if streamed and not value.get("choices"):  # the last event holds the usage alone
            continue
        given = value.get("choices")
        if not isinstance(given, list) or not given or not isinstance(given[0], dict):
            raise Passing(f"answered without choices: {excerpt(json.dumps(value))}")
        choice = given[0]
        message = choice.get("delta") or {} if streamed else choice.get("message")
        if not isinstance(message, dict):
            raise Passing(f"answered without a message: {excerpt(json.dumps(value))}")
        piece = message.get("content")  # models that refuse or think first have none for a while
        reason = choice.get("finish_reason") or reason
        if isinstance(piece, str):
            first = first or (time.perf_counter() - started if streamed and piece else None)
            text += piece
        if not streamed and isinstance(piece, str):
            reason, choices = reason or "stop", known(_choices(choice.get("logprobs")), text)
        elif not streamed:
            problem = "the server sent no content"
            reason = reason if reason == "length" else "error"
    if reason is None:
        raise Passing("ended a stream in the middle of an answer")
    seconds = time.perf_counter() - started
    return Reply(
        text, seconds, str(reason), *usage, first_token_s=first, problem=problem, choices=choices
    )


def _events(chunks: Iterable[bytes]) -> Iterator[dict[str, Any]]:
    rest = b""
    for chunk in chunks:
        *lines, rest = (rest + chunk).split(b"\n")
        for line in lines:
            if line.startswith(b"data:") and (data := line[5:].strip()) != b"[DONE]":
                yield _json_object(data)


def _json_object(body: bytes) -> dict[str, Any]:
    try:
        value = json.loads(body)
    except (ValueError, RecursionError):
        raise Passing(f"answered with something that is not JSON: {excerpt(body)}") from None
    if not isinstance(value, dict) or value.get("error"):
        kind = "an error" if isinstance(value, dict) else "no object"
        raise Passing(f"answered with {kind}: {excerpt(body)}")
    return value


def _choices(value: Any) -> list[Choice] | None:
    """The tokens of a reply; here none is among its own alternatives."""
    found = []
    try:
        for token in value["content"]:
            every = [(one["token"], one["logprob"]) for one in token.get("top_logprobs") or ()]
            others = tuple(one for one in every if one[0] != token["token"])
            found.append(Choice(len(token["token"]), token["logprob"], others))
    except (AttributeError, KeyError, TypeError):
        return None
    return found


def _usage(value: dict[str, Any]) -> tuple[int | None, int | None]:
    """Generated tokens and tokens of the prompt, where the server counts them."""
    usage = value.get("usage")
    counts = usage if isinstance(usage, dict) else {}
    given, asked = counts.get("completion_tokens"), counts.get("prompt_tokens")
    return given if isinstance(given, int) else None, asked if isinstance(asked, int) else None


def excerpt(body: bytes | str) -> str:
    """The beginning of a server's message, on one line; of an error object its message."""
    text = body.decode("utf-8", "replace") if isinstance(body, bytes) else body
    value = None
    with contextlib.suppress(ValueError):
        value = json.loads(text)
    if isinstance(value, dict):
        error = value.get("error", value.get("detail", value.get("message")))
        text = str(error.get("message") or error) if isinstance(error, dict) else str(error or text)
    return printable(text)[:200] or "nothing"
