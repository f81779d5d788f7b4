"""Files that several terminals and browsers may have open: locks, and plans that nobody overwrites
unseen.
"""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from pathlib import Path

from filelock import FileLock

from planner_ft.document import PlanDocument, document_digest, write_document
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_json


class ChangedError(PlannerError):
    """The plan's file is not what it was when it was read."""

    @classmethod
    def of(cls, path: Path) -> ChangedError:
        return cls(
            f"{path}: was changed by somebody else since it was read, so nothing was done; read it"
            " again"
        )


@contextlib.contextmanager
def exclusive(path: Path) -> Iterator[None]:
    """Hold the lock of `path` (the hidden file .NAME.lock beside it, which stays); waits while
    another process or thread holds it. Not re-entrant.

    Raises PlannerError when the lock file cannot be made.
    """
    lock = FileLock(path.with_name(f".{path.name}.lock"))
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        lock.acquire(poll_interval=0.01)
    except OSError as error:
        raise PlannerError(
            f"{lock.lock_file}: cannot be made ({error.strerror}), so nothing is written to"
            f" {path.name}; make the folder writable"
        ) from None
    try:
        yield
    finally:
        lock.release()


@contextlib.contextmanager
def unchanged(path: Path, digest: str) -> Iterator[None]:
    """Hold the plan's lock while its file has the content of `digest` (`document_digest` of what
    was read; the key `digest` may be wrong). Raises ChangedError when it has another.
    """
    with exclusive(path):
        value = read_json(path)
        if not isinstance(value, dict) or document_digest(value) != digest:
            raise ChangedError.of(path)
        yield


def save(path: Path, document: PlanDocument, digest: str) -> PlanDocument:
    """Write `document` over the plan whose content had `digest` when it was read; returns what was
    written. Raises ChangedError.
    """
    with unchanged(path, digest):
        return write_document(path, document)
