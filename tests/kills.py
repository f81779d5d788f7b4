"""Commands in a process of their own that dies at one of its changes of files."""

from __future__ import annotations

import os
import signal
import sys
from collections.abc import Callable
from pathlib import Path

CHANGES = ("open", "os.rename", "os.remove", "os.rmdir", "os.mkdir")


def changes(work: Callable[[], object], folder: Path, last: int | None = None) -> int | None:
    """Do the work in a process of its own; how often it changed something in `folder`.

    Killed before its change of number `last`, counted from 0: None. Raises AssertionError where the
    work fails.
    """
    reader, writer = os.pipe()
    if not (child := os.fork()):
        os.close(reader)
        _die_after(work, folder, last, writer)
    os.close(writer)
    with os.fdopen(reader) as said:
        text = said.read()
    status = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
    assert status in (0, -signal.SIGKILL), text
    return None if status else int(text)


def _die_after(work: Callable[[], object], folder: Path, last: int | None, writer: int) -> None:
    import torch

    torch.set_num_threads(1)
    nothing = os.open(os.devnull, os.O_RDWR)
    for stream in (1, 2):
        os.dup2(nothing, stream)
    count, status = 0, 0

    def change(event: str, values: tuple[object, ...]) -> None:
        nonlocal count
        if event not in CHANGES or not isinstance(values[0], str | os.PathLike):
            return
        if event == "open" and not set(str(values[1])) & set("wax+"):
            return
        if str(folder) in str(Path(values[0]).absolute()):
            if count == last:
                os.kill(os.getpid(), signal.SIGKILL)
            count += 1

    sys.addaudithook(change)
    try:
        work()
    except BaseException as error:  # SystemExit, too
        status = getattr(error, "code", 1) or 0
        if status:
            count = repr(error)  # type: ignore[assignment]
    os.write(writer, str(count).encode())
    os._exit(status if isinstance(status, int) else 1)
