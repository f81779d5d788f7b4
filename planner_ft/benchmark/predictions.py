"""predictions.jsonl and latency.jsonl: append-only, flushed line by line, so that a run can end at
any point and go on.

Every line carries the key of what it depends on (`plan.Job.key`); a resumed run uses the lines with
its own key.
"""

from __future__ import annotations

import os
from pathlib import Path
from typing import IO, Any

from planner_ft.benchmark.folder import LATENCY, PREDICTIONS
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import compact_json, iterate_jsonl

Line = dict[str, Any]


class RecordLog:
    """An append-only JSONL file of records with `key` and `id`, held by one process at a time.

    Opening drops a last line that a killed run left without its end, reads what is there and locks
    the file. Raises PlannerError when another run holds it, a line is damaged, or it cannot be
    written.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        try:
            # Unbuffered: after a failed write nothing is left to be written again when the file is
            # closed.
            self.stream: IO[bytes] = open(path, "a+b", buffering=0)  # noqa: SIM115
        except OSError as error:
            raise PlannerError(
                f"{path}: cannot be written ({error.strerror}); give another --out"
            ) from None
        self._lock()
        self._drop_unfinished_line()
        self.records: dict[tuple[str, str], Line] = {}
        for number, record, problem in iterate_jsonl(path):
            if (
                problem
                or not isinstance(record, dict)
                or not isinstance(record.get("key"), str)
                or not isinstance(record.get("id"), str)
            ):
                self.close()
                raise PlannerError(
                    f"{path}:{number}: {problem or 'no record of a run (key and id are expected)'};"
                    " remove the line, or start with --overwrite"
                )
            self.records[record["key"], record["id"]] = record

    def of_key(self, key: str) -> dict[str, Line]:
        """The records of a key by sample id."""
        return {sample: record for (known, sample), record in self.records.items() if known == key}

    def append(self, record: Line) -> None:
        """Write a record as one line and hand it to the operating system."""
        self.records[record["key"], record["id"]] = record
        try:
            line = f"{compact_json(record)}\n".encode()
            while line:
                line = line[self.stream.write(line) :]
        except OSError as error:
            raise PlannerError(
                f"{self.path}: cannot be written ({error.strerror}); free some space and run the"
                " command again with --resume"
            ) from error

    def close(self) -> None:
        self.stream.close()

    def __enter__(self) -> RecordLog:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def _lock(self) -> None:
        try:
            import fcntl
        except ImportError:  # not on Windows
            return
        try:
            fcntl.flock(self.stream, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            self.close()
            raise PlannerError(
                f"{self.path}: another run is writing here; wait for it or give another --out"
            ) from None

    def _drop_unfinished_line(self) -> None:
        self.stream.seek(0)
        content = self.stream.read()
        if content and not content.endswith(b"\n"):
            self.stream.truncate(content.rfind(b"\n") + 1)
        self.stream.seek(0, os.SEEK_END)


def prediction_log(folder: Path) -> RecordLog:
    """The log of answers: one line per sample, candidate and configuration."""
    return RecordLog(folder / PREDICTIONS)


def latency_log(folder: Path) -> RecordLog:
    """The log of timed queries: one line per timed sample, candidate and configuration."""
    return RecordLog(folder / LATENCY)
