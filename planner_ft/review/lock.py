"""One process at a time: an exclusive lock that the system gives back when its holder dies."""

from __future__ import annotations

import contextlib
import os
import sys
from collections.abc import Iterator
from pathlib import Path

from planner_ft.support.errors import PlannerError


@contextlib.contextmanager
def exclusive(path: Path) -> Iterator[None]:
    """Hold the lock of `path` (the hidden file .NAME.lock beside it, which stays); waits while
    another process or thread holds it.

    Not re-entrant. Raises PlannerError when the lock file cannot be made.
    """
    file = path.with_name(f".{path.name}.lock")
    try:
        file.parent.mkdir(parents=True, exist_ok=True)
        descriptor = os.open(file, os.O_RDWR | os.O_CREAT, 0o666)
    except OSError as error:
        raise PlannerError(
            f"{file}: cannot be made ({error.strerror}), so nothing is written to {path.name}; make"
            " the folder writable"
        ) from None
    try:
        _lock(descriptor)
        yield
    finally:
        # Closing gives the lock back, as the end of the process does.
        os.close(descriptor)


if sys.platform == "win32":
    import msvcrt

    def _lock(descriptor: int) -> None:
        while True:
            # LK_LOCK gives up after ten tries of one second each.
            with contextlib.suppress(OSError):
                msvcrt.locking(descriptor, msvcrt.LK_LOCK, 1)
                return

else:
    import fcntl

    def _lock(descriptor: int) -> None:
        fcntl.flock(descriptor, fcntl.LOCK_EX)
