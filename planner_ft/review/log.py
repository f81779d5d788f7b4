"""The approval log: append-only JSON Lines that keep every decision with the plan itself, and runs.

A record has "sequence", "time" (UTC), "event", "reviewer", "reason", "digest", "plan",
"acknowledged", "differences", "models", "previous" and "hash". Records of runs ("run", "aborted",
"ended") hold no plan, and say more in "reason".

A line is the RFC 8785 form of its record. `hash` is the SHA-256 of that form without the member
`hash`, `previous` the hash of the line before. The head file beside the log holds sequence and hash
of the last record, so that lines missing at the end are noticed, too. It is there before the first
record is, so that a log without it lost it.
"""

import contextlib
import hashlib
import os
from collections.abc import Iterator
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import Any, NamedTuple

from filelock import FileLock

from planner_ft.document.build import canonical, sha256_canonical
from planner_ft.support import files
from planner_ft.support.errors import PlannerError

Record = dict[str, Any]


class Problem(NamedTuple):
    """A break of the chain, and the line (from 1) where it shows; 0: at the head file alone."""

    line: int
    text: str


class Head(NamedTuple):
    """Sequence and hash of the last record."""

    sequence: int
    hash: str


START = Head(0, "0" * 64)
"""The end of an empty chain."""


@dataclass(frozen=True)
class Chain:
    """Records (none of a broken chain), problems, lines, and the bytes of an unfinished line."""

    records: tuple[Record, ...]
    problems: tuple[Problem, ...]
    lines: int
    torn: bytes = b""

    @property
    def end(self) -> Head:
        return Head(len(self.records), self.records[-1]["hash"]) if self.records else START


def sealed(values: Record, end: Head) -> Record:
    """The record of `values` that follows `end`."""
    record = {**values, "sequence": end.sequence + 1, "previous": end.hash}
    return {**record, "hash": sha256_canonical(record)}


def read_chain(data: bytes, head: Head | None) -> Chain:
    """The records in a log's bytes, checked against each other and against the head."""
    *lines, torn = data.split(b"\n")
    found = [_read_line(line) for line in lines]
    records = tuple(record for record in found if isinstance(record, dict))
    problems = sorted(_line_problems(found)) or list(_head_problems(records, head))
    return Chain(() if problems else records, tuple(problems), len(lines), torn)


def _read_line(line: bytes) -> Record | str:
    """The record of a line, or the fault of the line by itself."""
    try:
        value, _line, problem = files.decode_json(line.decode())
    except UnicodeDecodeError:
        return "is no UTF-8 text"
    if problem is not None:
        return f"is {problem}"
    made = value if isinstance(value, dict) else {}
    if not isinstance(made.get("hash"), str) or type(made.get("sequence")) is not int:
        return "is no record"
    # The line is canonical: without the member's bytes it is the canonical form without it.
    content = line.replace(f'"hash":"{made["hash"]}",'.encode(), b"", 1)
    if hashlib.sha256(content).hexdigest() != made["hash"]:
        return f"(record {made['sequence']}) is not what was recorded: its hash does not fit"
    return made


def _line_problems(found: list[Record | str]) -> Iterator[Problem]:
    """Changed lines, and records that do not follow the line before."""
    before: Record | str = START._asdict()
    for number, item in enumerate(found, start=1):
        if isinstance(item, str):
            yield Problem(number, f"line {number} {item}; it was changed")
        elif isinstance(before, dict):
            expected = before["sequence"] + 1
            if item["sequence"] != expected:
                holds = f"line {number} holds record {item['sequence']} where record {expected}"
                text = f"{holds} is due: lines were removed, changed places or were repeated"
                yield Problem(number, text)
            elif item.get("previous") != before["hash"]:
                here, last = f"line {number} (record {item['sequence']})", f"line {number - 1}"
                text = f"{here} was recorded after another line than {last}; {last} was replaced"
                yield Problem(number, text)
        before = item


def _head_problems(records: tuple[Record, ...], head: Head | None) -> Iterator[Problem]:
    count = len(records)
    if head is None:
        if count:
            text = "the head file is missing, so that lines removed at the end would not be seen"
            yield Problem(0, text)
        return
    last = head.sequence
    if last > count:
        many = f"records {count + 1} to {last} are"
        known = f"record {last} is" if last == count + 1 else many
        cut = f"line {count + 1} is missing: {known} known to the head file"
        yield Problem(count + 1, f"{cut}; lines were removed at the end")
    elif last < count - 1:
        ends = f"the head file ends at record {last}, the log at record {count}"
        how = "the head file was replaced by an older one, or lines were added"
        yield Problem(0, f"{ends}; {how}")
    elif head.hash != (records[last - 1]["hash"] if last else START.hash):
        text = f"line {last} (record {last}) is not the record that the head file knows"
        yield Problem(last, f"{text}; it was replaced")


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


@contextlib.contextmanager
def exclusive(path: Path) -> Iterator[None]:
    """Hold the lock file .NAME.lock beside `path`, of a link beside what it points to; waits for
    other holders. Not re-entrant.
    """
    path = Path(os.path.realpath(path))
    lock = FileLock(path.with_name(f".{path.name}.lock"))
    what = f"cannot be made, so nothing is written to {path.name}"
    with files.writing(lock.lock_file, "make the folder writable", what):
        path.parent.mkdir(parents=True, exist_ok=True)
        lock.acquire(poll_interval=0.01)
    try:
        yield
    finally:
        lock.release()


def append(log: Path, values: Record) -> Appended:
    """Add a record of `values`, sealed and timed; it is on the disk when this returns.

    A killed process leaves a record whole or not at all. Raises PlannerError for a broken chain.
    """
    with exclusive(log):
        chain = _sound(log)
        set_aside = _set_aside(log, chain)
        if (head := _read_head(log)) is None:
            _put_head(log, START)
        elif head != chain.end:
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
    with files.writing(log, "give another --log", "cannot be read"):
        with contextlib.suppress(FileNotFoundError):
            return log.read_bytes()
        return b""


def _read_head(log: Path) -> Head | None:
    path = head_file(log)
    if not path.exists():
        return None
    match files.read_json(path):
        case {"sequence": int(sequence), "hash": str(digest)} if sequence >= 0:
            return Head(sequence, digest)
    raise PlannerError(f"{path}: holds no sequence and hash; {way_out(log)}")


def _write_head(log: Path, head: Head) -> None:
    try:
        _put_head(log, head)
    except PlannerError as error:
        problem = f"record {head.sequence} stands in {log}, but its head file does not know it yet"
        raise PlannerError(f"{problem}: {error}") from None


def _put_head(log: Path, head: Head) -> None:
    files.write_text(head_file(log), files.compact_json(head._asdict()) + "\n")
    files.sync_folder(log.parent)


def _write_line(log: Path, line: bytes) -> None:
    way = "free some space or give another --log"
    with files.writing(log, way, "nothing was recorded"), open(log, "ab", buffering=0) as stream:
        while line:
            line = line[stream.write(line) :]
        os.fsync(stream.fileno())
    files.sync_folder(log.parent)


def _set_aside(log: Path, chain: Chain) -> Path | None:
    """Move the bytes of an unfinished, never confirmed line into a file of their own."""
    if not chain.torn:
        return None
    aside = log.with_name(f"{log.name}.unfinished-{files.sha256_text(chain.torn.hex())[:12]}")
    with files.atomic_writer(aside, "wb") as stream:
        stream.write(chain.torn)
    files.sync_folder(log.parent)
    with open(log, "r+b") as stream:
        stream.truncate(log.stat().st_size - len(chain.torn))
        os.fsync(stream.fileno())
    return aside
