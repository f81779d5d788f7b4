"""The kinds of warnings (kinds.toml): how grave each is, its name, and its sentences."""

from __future__ import annotations

import tomllib
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any, Literal

from planner_ft.support.files import read_text

Severity = Literal["danger", "caution", "note"]
SEVERITIES: tuple[Severity, ...] = ("danger", "caution", "note")
"""The gravest first."""
Warning = dict[str, Any]
"""{"id", "kind", "task", "parameter", "text"}; edits elsewhere leave the id as it is."""
TABLE: dict[str, dict[str, Any]] = tomllib.loads(read_text(Path(__file__).with_name("kinds.toml")))
KINDS = tuple(TABLE)
"""In the order in which a plan has them."""
NOTES = tuple(kind for kind, entry in TABLE.items() if entry["severity"] == "note")
SERIOUS = tuple(kind for kind in KINDS if kind not in NOTES)
"""Kinds that a plan should not be approved with unread."""
LONGEST = 120
"""Characters of the command that are quoted."""


def meaning(kind: str) -> tuple[Severity, str]:
    """Severity and name of a kind; one that is not known, as of another version, is a caution."""
    entry = TABLE.get(kind)
    named = kind.replace("-", " ").capitalize()
    return (entry["severity"], entry["name"]) if entry else ("caution", named)


def gravest_first(warnings: Iterable[Mapping[str, Any]]) -> list[Mapping[str, Any]]:
    """Dangers, then cautions, then notes, each in the order that they have."""
    return sorted(warnings, key=lambda one: SEVERITIES.index(meaning(one["kind"])[0]))


def warning(
    kind: str,
    sentence: str = "",
    task: Mapping[str, Any] | None = None,
    parameter: str | None = None,
    about: str = "",
    **values: Any,
) -> Warning:
    """A warning about a task, a parameter or the plan, in a sentence of its kind that is filled
    with `values`; `about` tells several of a kind apart.
    """
    entry, name = TABLE[kind], task["id"] if task else None
    written = entry["texts"][sentence] if sentence else entry["text"]
    text = written.format(task=named(task) if task else "", **values)
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


def lost(words: str) -> Warning:
    """A value of the command that the plan has not."""
    return warning("value-lost", "value", about=words.casefold(), words=words)
