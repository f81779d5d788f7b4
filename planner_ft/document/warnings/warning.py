"""One warning, and how serious each kind is."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

Warning = dict[str, Any]
"""{"id", "kind", "task", "parameter", "text"}; edits elsewhere leave the id as it is."""
SERIOUS = (
    *(
        "unknown-language",
        "invalid-answer",
        "structure-close",
        "limit-broken",
        "limit-lost",
        "contradiction",
    ),
    *("doubtful-origin", "repeat-lost"),
    *("unresolved-location", "value-asked", "used-before-found", "not-at-place"),
    *("position-missing", "outside-boundary", "outside-area", "out-of-reach", "over-endurance"),
    *("missing-return", "not-planned", "data-not-planned", "not-performed"),
    *(
        "data-ruled-out",
        "value-not-said",
        "skill-value-not-said",
        "value-lost",
        "stale-skills",
        "no-skills",
    ),
)
"""Kinds that a plan should not be approved with unread, the most serious first."""
NOTES = ("empty-plan", "unread-command", "data-not-collected", "endurance-open")
"""Kinds that also right plans have: what is unusual, or not known."""
LONGEST = 60
"""Characters of the command that are quoted."""
KINDS = (*SERIOUS, *NOTES)


def warning(
    kind: str,
    text: str,
    task: Mapping[str, Any] | None = None,
    parameter: str | None = None,
    about: str = "",
) -> Warning:
    """A warning about a task, a parameter or the plan; `about` tells several of a kind apart."""
    name = task["id"] if task else None
    return {
        "id": ":".join(part for part in (kind, name, parameter, about) if part),
        "kind": kind,
        "task": name,
        "parameter": parameter,
        "text": text[:1].upper() + text[1:],
    }


def quoted(words: str) -> str:
    """Words of the command on one line, not too many."""
    text = " ".join(words.split())
    return text if len(text) <= LONGEST else f"{text[:LONGEST].rsplit(' ', 1)[0]} ..."


def named(task: Mapping[str, Any]) -> str:
    """A task as sentences name it, by its `number` in the plan."""
    return f"task {task['number']}, {task['title']}"
