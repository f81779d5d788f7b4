"""The approval log: append-only JSON Lines that keep every decision with the plan itself, and runs.

A record has "sequence", "time" (UTC), "event", "reviewer", "reason", "digest", "plan",
"acknowledged", "differences", "models", "previous" and "hash" (see `chain`). Records of runs
("run", "aborted", "ended") hold no plan, and say more in "reason".
"""

from __future__ import annotations

import contextlib
import os
from datetime import UTC, datetime
from pathlib import Path
from typing import NamedTuple

from planner_ft.document.build import canonical
from planner_ft.review.chain import Chain, Head, Record, read_chain, sealed
from planner_ft.review.store import exclusive
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import (
    atomic_writer,
    compact_json,
    read_json,
    sha256_text,
    sync_folder,
    writing,
)

LOG_NAME = "approvals.jsonl"


class Appended(NamedTuple):
    """A record as it stands in the log, and the file that an unfinished last line was moved to."""

    record: Record
    set_aside: Path | None


def log_beside(plan: Path) -> Path:
    """The log of the plans in the folder of `plan`."""
    return plan.with_name(LOG_NAME)


def head_file(log: Path) -> Path:
    """The file that holds sequence and hash of the last record."""
    return log.with_name(f"{log.name}.head")


def existing_log(log: Path) -> Path:
    """The log itself. Raises PlannerError where there is none."""
    if not log.exists() and not head_file(log).exists():
        way_out = "plannerft review writes approvals.jsonl beside the plan"
        raise PlannerError(f"--log {log}: no such file; {way_out}")
    return log


def append(log: Path, values: Record) -> Appended:
    """Add a record of `values`, sealed and timed; it is on the disk when this returns.

    A killed process leaves a record whole or not at all. Raises PlannerError for a broken chain.
    """
    with exclusive(log):
        chain = _sound(log)
        set_aside = _set_aside(log, chain)
        if chain.records and _read_head(log) != chain.end:
            # Its writer was killed between the record and the head.
            _write_head(log, chain.end)
        time = datetime.now(UTC).isoformat(timespec="seconds")
        record = sealed({**values, "time": time}, chain.end)
        _write_line(log, canonical(record) + b"\n")
        _write_head(log, Head(record["sequence"], record["hash"]))
    return Appended(record, set_aside)


def read_log(log: Path) -> tuple[Record, ...]:
    """The records in order; none without a log. Raises PlannerError when the chain is broken."""
    return _sound(log).records


def check_log(log: Path) -> Chain:
    """The log as it is, with its `problems`. Raises PlannerError when it cannot be read."""
    while True:
        head, data = _read_head(log), _read_bytes(log)
        # Another process may have added a record in between.
        if _read_head(log) == head:
            return read_chain(data, head)


def way_out(log: Path) -> str:
    """How to go on with a broken log."""
    copied = f"put the log and {head_file(log).name} back from a copy"
    return f"{copied}, or move both aside to begin a new log, in which plans are approved anew"


def _sound(log: Path) -> Chain:
    chain = check_log(log)
    if chain.problems:
        more = len(chain.problems) - 1
        rest = f" (and {more} more; plannerft verify --log {log} shows all)" if more else ""
        raise PlannerError(f"{log}: {chain.problems[0].text}{rest}; {way_out(log)}")
    return chain


def _read_bytes(log: Path) -> bytes:
    with writing(log, "give another --log", "cannot be read"):
        with contextlib.suppress(FileNotFoundError):
            return log.read_bytes()
        return b""


def _read_head(log: Path) -> Head | None:
    path = head_file(log)
    if not path.exists():
        return None
    match read_json(path):
        case {"sequence": int(sequence), "hash": str(digest)} if sequence >= 0:
            return Head(sequence, digest)
    raise PlannerError(f"{path}: holds no sequence and hash; {way_out(log)}")


def _write_head(log: Path, head: Head) -> None:
    try:
        with atomic_writer(head_file(log)) as stream:
            stream.write(compact_json(head._asdict()) + "\n")
    except PlannerError as error:
        problem = f"record {head.sequence} stands in {log}, but its head file does not know it yet"
        raise PlannerError(f"{problem}: {error}") from None
    sync_folder(log.parent)


def _write_line(log: Path, line: bytes) -> None:
    way = "free some space or give another --log"
    with writing(log, way, "nothing was recorded"), open(log, "ab", buffering=0) as stream:
        while line:
            line = line[stream.write(line) :]
        os.fsync(stream.fileno())
    sync_folder(log.parent)


def _set_aside(log: Path, chain: Chain) -> Path | None:
    """Move the bytes of an unfinished, never confirmed line into a file of their own."""
    if not chain.torn:
        return None
    aside = log.with_name(f"{log.name}.unfinished-{sha256_text(chain.torn.hex())[:12]}")
    with atomic_writer(aside, "wb") as stream:
        stream.write(chain.torn)
    sync_folder(log.parent)
    with open(log, "r+b") as stream:
        stream.truncate(log.stat().st_size - len(chain.torn))
        os.fsync(stream.fileno())
    return aside
