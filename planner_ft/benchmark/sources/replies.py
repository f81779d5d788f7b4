"""Reading a chat completions server's replies: one JSON object, or server-sent events."""

import contextlib
import json
import time
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Any

from planner_ft.confidence.parts import Choice, Choices, known
from planner_ft.support.tables import printable


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
