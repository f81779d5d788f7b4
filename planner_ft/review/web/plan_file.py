"""The plan that is shown in the browser, on the disk: written whole before a change is answered.

A change names the revision (the digest) that it was made for, which is compared with the file as
the review in the terminal does: of two people who change one plan at a time the second is refused.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from datetime import UTC, datetime
from itertools import count
from pathlib import Path
from typing import NamedTuple

from planner_ft.document import (
    PlanDocument,
    altered,
    document_digest,
    read_document,
    write_document,
)
from planner_ft.review.store import ChangedError, exclusive, unchanged
from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.document_schema import FORMAT

MOST_PLANS = 200
"""Plans of the folder that are offered, newest first."""

Signature = tuple[int, int, int]


class Current(NamedTuple):
    """A plan as it is on the disk; `revision` is the digest of its content, whatever the key
    `digest` says.
    """

    path: Path
    document: PlanDocument
    revision: str


class PlanFile:
    """Which plan is shown (`path`; None before the first), and its content. Safe to use from
    several threads.
    """

    def __init__(self, path: Path | None, folder: Path, vocabulary: Vocabulary) -> None:
        self.path, self.folder, self.vocabulary = path, folder, vocabulary
        self._lock = threading.RLock()

    def signature(self) -> tuple[Path | None, Signature | None]:
        """A value that changes with the plan on the disk."""
        path = self.path
        return path, signature(path)

    def current(self) -> Current | None:
        """The plan as it is on the disk now; None before the first. Raises PlannerError when the
        file cannot be read.
        """
        path = self.path
        if path is None:
            return None
        document = read_document(path, self.vocabulary)
        return Current(path, document, document_digest(document))

    def plans(self) -> list[str]:
        """The names of the plans in the folder, newest first."""
        found = [
            (file.stat().st_mtime, file.name)
            for file in self.folder.glob("*.json")
            if file.is_file() and _looks_like_a_plan(file)
        ]
        return [name for _time, name in sorted(found, reverse=True)[:MOST_PLANS]]

    def open(self, name: str) -> None:
        """Show another plan of the folder. Raises PlannerError when there is none of that name, or
        it cannot be read.
        """
        if name not in self.plans():
            raise PlannerError(f"{name}: is no plan in {self.folder}; choose one that is listed")
        read_document(self.folder / name, self.vocabulary)
        with self._lock:
            self.path = self.folder / name

    def add(self, document: PlanDocument) -> Path:
        """Write a new plan into a file of its own, named by the time (UTC), and show it. Raises
        PlannerError when it cannot be written.
        """
        stem = f"plan-{datetime.now(UTC):%Y%m%d-%H%M%S}"
        for number in count(1):
            path = self.folder / f"{stem}{f'-{number}' if number > 1 else ''}.json"
            with self._lock, exclusive(path):
                if not path.exists():
                    write_document(path, document)
                    self.path = path
                    return path
        raise AssertionError

    def change(self, revision: str, made: Callable[[PlanDocument], PlanDocument]) -> None:
        """Replace the plan by the result of `made`; on the disk when this returns.

        Raises ChangedError when the plan is not of that revision, PlannerError when the change
        cannot be made or written.
        """
        with self.held(revision) as now:
            if altered(now.document):
                raise PlannerError(
                    f"{now.path.name} was changed by hand; take the changes over with `plannerft"
                    f" review {now.path.name} --adopt` before you edit it"
                )
            write_document(now.path, made(now.document))

    @contextmanager
    def held(self, revision: str) -> Iterator[Current]:
        """The plan of that revision, which nobody else changes meanwhile. Raises ChangedError when
        it is another.
        """
        with self._lock:
            if self.path is None:
                raise ChangedError("there is no plan yet; plan a command first")
            with unchanged(self.path, revision):
                now = self.current()
                assert now is not None
                yield now


def signature(path: Path | None) -> Signature | None:
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
