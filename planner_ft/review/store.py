"""Files that several terminals and browsers have open: locks, and safe saving."""

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
    """Hold the lock file .NAME.lock beside `path`; waits for other holders. Not re-entrant."""
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
