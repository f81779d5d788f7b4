"""Reading what a chat completions server sends: one JSON object, or a stream of events."""

from __future__ import annotations

import json
import time
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Any

LARGEST = 2**25
"""Bytes of a reply from which it is no answer to a question of ours."""


class BadReply(Exception):
    """What came back is no answer: cut off, too slow, no JSON, of another form. Worth asking
    again.
    """


@dataclass(frozen=True)
class Reply:
    """An answer. `seconds` is the time from the question to its end, `first_token_s` to the first
    text (streams alone).
    """

    text: str
    seconds: float
    finish_reason: str
    tokens: int | None = None
    prompt_tokens: int | None = None
    first_token_s: float | None = None
    attempts: int = 1


def within(chunks: Iterable[bytes], deadline: float) -> Iterator[bytes]:
    """The chunks of a reply. Raises BadReply when they go on after `deadline` (of
    `time.perf_counter`) or are too many.
    """
    size = 0
    for chunk in chunks:
        size += len(chunk)
        if time.perf_counter() > deadline:
            raise BadReply("did not finish its answer in time")
        if size > LARGEST:
            raise BadReply(f"sent more than {LARGEST >> 20} MiB for one answer")
        yield chunk


def read_whole(chunks: Iterable[bytes], started: float) -> Reply:
    """A reply that comes as one JSON object. Raises BadReply."""
    body = b"".join(chunks)
    value = _json_object(body)
    choice = _choice(value)
    message = choice.get("message")
    if not isinstance(message, dict):
        raise BadReply(f"answered without a message: {excerpt(body)}")
    tokens, prompt_tokens = _usage(value)
    return Reply(
        _text(message), time.perf_counter() - started, _reason(choice), tokens, prompt_tokens
    )


def read_events(chunks: Iterable[bytes], started: float) -> Reply:
    """A reply that comes as server-sent events. Raises BadReply when it ends without saying so."""
    text, reason, first = "", None, None
    tokens = prompt_tokens = None
    for event in _events(chunks):
        counted = _usage(event)
        tokens, prompt_tokens = counted if counted[0] is not None else (tokens, prompt_tokens)
        if not event.get("choices"):  # the last event of a stream holds the usage alone
            continue
        choice = _choice(event)
        piece = _text(choice.get("delta") or {})
        if piece and first is None:
            first = time.perf_counter() - started
        text, reason = text + piece, choice.get("finish_reason") or reason
    if reason is None:
        raise BadReply("ended a stream in the middle of an answer")
    return Reply(text, time.perf_counter() - started, str(reason), tokens, prompt_tokens, first)


def excerpt(body: bytes | str) -> str:
    """The beginning of what a server sent, on one line; of an error object its message."""
    text = body.decode("utf-8", "replace") if isinstance(body, bytes) else body
    try:
        value = json.loads(text)
    except ValueError:
        value = None
    if isinstance(value, dict):
        error = value.get("error", value.get("detail", value.get("message")))
        text = str(error.get("message") or error) if isinstance(error, dict) else str(error or text)
    line = " ".join(text.split())
    return line[:200] if line else "nothing"


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
        raise BadReply(f"answered with something that is not JSON: {excerpt(body)}") from None
    if not isinstance(value, dict) or value.get("error"):
        raise BadReply(
            f"answered with {'an error' if isinstance(value, dict) else 'no object'}:"
            f" {excerpt(body)}"
        )
    return value


def _choice(value: dict[str, Any]) -> dict[str, Any]:
    choices = value.get("choices")
    if not isinstance(choices, list) or not choices or not isinstance(choices[0], dict):
        raise BadReply(f"answered without choices: {excerpt(json.dumps(value))}")
    return choices[0]


def _text(message: dict[str, Any]) -> str:
    """The text of a message; models that refuse or think first have none for a while."""
    content = message.get("content")
    return content if isinstance(content, str) else ""


def _reason(choice: dict[str, Any]) -> str:
    return str(choice.get("finish_reason") or "stop")


def _usage(value: dict[str, Any]) -> tuple[int | None, int | None]:
    """Generated tokens and tokens of the prompt, where the server counts them."""
    usage = value.get("usage")
    counts = usage if isinstance(usage, dict) else {}
    tokens, prompt_tokens = counts.get("completion_tokens"), counts.get("prompt_tokens")
    return tokens if isinstance(tokens, int) else None, (
        prompt_tokens if isinstance(prompt_tokens, int) else None
    )
