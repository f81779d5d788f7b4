"""What tasks bring about and need beyond their places: NAME.logic.toml, no part of the digest."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

LOGIC = ".logic.toml"
LISTS = ("gives", "needs", "yields")


@dataclass(frozen=True)
class TaskLogic:
    """Facts that a task gives and needs, words for its yield, and the parameter of sent items."""

    gives: tuple[str, ...] = ()
    needs: tuple[str, ...] = ()
    yields: tuple[str, ...] = ()
    sends: str | None = None


@dataclass(frozen=True)
class Logic:
    """`lacking`: per fact the sentence for a plan without it; `tasks`: the logic by title."""

    lacking: dict[str, str] = field(default_factory=dict)
    tasks: dict[str, TaskLogic] = field(default_factory=dict)

    def of(self, title: str) -> TaskLogic:
        """The logic of a task; an empty one where nothing is declared."""
        return self.tasks.get(title, TaskLogic())


def build_logic(raw: Mapping[str, Any]) -> Logic:
    """The logic of a parsed file without problems (checks.logic_problems)."""
    tasks = {
        title: TaskLogic(
            **{key: tuple(entry.get(key, ())) for key in LISTS}, sends=entry.get("sends")
        )
        for title, entry in raw.get("task", {}).items()
    }
    return Logic({name: fact["lacking"] for name, fact in raw.get("fact", {}).items()}, tasks)
