"""Files that several terminals and browsers have open: locks, and safe saving."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from datetime import UTC, datetime
from itertools import count
from pathlib import Path

from filelock import FileLock

from planner_ft.document import PlanDocument, document_digest, write_document
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_json, writing
from planner_ft.vocabulary.schema import FORMAT

MOST_PLANS = 200
"""Plans of the folder that are offered, newest first."""


class ChangedError(PlannerError):
    """The plan's file is not what it was when it was read."""

    @classmethod
    def of(cls, path: Path) -> ChangedError:
        problem = "was changed by somebody else since it was read, so nothing was done"
        return cls(f"{path}: {problem}; read it again")


@contextlib.contextmanager
def exclusive(path: Path) -> Iterator[None]:
    """Hold the lock file .NAME.lock beside `path`; waits for other holders. Not re-entrant."""
    lock = FileLock(path.with_name(f".{path.name}.lock"))
    what = f"cannot be made, so nothing is written to {path.name}"
    with writing(lock.lock_file, "make the folder writable", what):
        path.parent.mkdir(parents=True, exist_ok=True)
        lock.acquire(poll_interval=0.01)
    try:
        yield
    finally:
        lock.release()


@contextlib.contextmanager
def unchanged(path: Path, digest: str) -> Iterator[None]:
    """Hold the plan's lock while its content has this `document_digest`. Raises ChangedError."""
    with exclusive(path):
        value = read_json(path)
        if not isinstance(value, dict) or document_digest(value) != digest:
            raise ChangedError.of(path)
        yield


def save(path: Path, document: PlanDocument, digest: str) -> PlanDocument:
    """Write `document` over a plan whose content had `digest`. Raises ChangedError."""
    with unchanged(path, digest):
        return write_document(path, document)


# ---------------------------------------------------------------- the plans of a folder


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
