"""The labelling rules that a program can check, for the skill sequence of a task."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from planner_ft.vocabulary import Vocabulary


def step_problems(record: dict[str, Any], vocabulary: Vocabulary) -> Iterator[str]:
    """What breaks a labelling rule in the expected skill sequence of a task record."""
    yield from ()
