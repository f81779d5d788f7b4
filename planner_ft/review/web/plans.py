"""The plans of a folder: their names, and files for new ones."""

from __future__ import annotations

from datetime import UTC, datetime
from itertools import count
from pathlib import Path

from planner_ft.document import PlanDocument, write_document
from planner_ft.review.store import exclusive
from planner_ft.vocabulary.document_schema import FORMAT

MOST_PLANS = 200
"""Plans of the folder that are offered, newest first."""


def plan_names(folder: Path) -> list[str]:
    """The names of the plans in the folder, newest first."""
    found = [
        (file.stat().st_mtime, file.name)
        for file in folder.glob("*.json")
        if file.is_file() and _looks_like_a_plan(file)
    ]
    return [name for _time, name in sorted(found, reverse=True)[:MOST_PLANS]]


def add_plan(folder: Path, document: PlanDocument) -> Path:
    """Write a new plan into a file named by the time (UTC). Raises PlannerError."""
    stem = f"plan-{datetime.now(UTC):%Y%m%d-%H%M%S}"
    for number in count(1):
        path = folder / f"{stem}{f'-{number}' if number > 1 else ''}.json"
        with exclusive(path):
            if not path.exists():
                write_document(path, document)
                return path
    raise AssertionError


def signature(path: Path | None) -> tuple[int, int, int] | None:
    """A value that changes when a file is written anew; None where there is no file."""
    try:
        stat = path.stat() if path else None
    except OSError:
        return None
    return (stat.st_mtime_ns, stat.st_size, stat.st_ino) if stat else None


def _looks_like_a_plan(path: Path) -> bool:
    """Whether a file begins as plans do: the folder may hold any other JSON."""
    try:
        with open(path, "rb") as stream:
            return f'"{FORMAT}"'.encode() in stream.read(200)
    except OSError:
        return False
