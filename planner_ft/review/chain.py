"""The chain of records in an approval log, and what breaks it.

A line is the RFC 8785 form of its record. `hash` is the SHA-256 of that form without the member
`hash`, `previous` the hash of the line before. The head file beside the log holds sequence and hash
of the last record, so that lines missing at the end are seen, too.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from planner_ft.document.digest import sha256_canonical
from planner_ft.support.files import decode_json

Record = dict[str, Any]
START = "0" * 64
"""`previous` of the first record."""


@dataclass(frozen=True)
class Problem:
    """What breaks the chain, and the line (from 1) where it shows; 0 where it shows at the head
    file alone.
    """

    line: int
    text: str


@dataclass(frozen=True)
class Head:
    """What the head file says was recorded last."""

    sequence: int
    hash: str


@dataclass(frozen=True)
class Chain:
    """A log as it was read: its records (none of a broken chain), what breaks the chain, how many
    lines there are, and what follows the last

    newline: a line that was never finished.
    """

    records: tuple[Record, ...]
    problems: tuple[Problem, ...]
    lines: int
    torn: bytes = b""

    @property
    def end(self) -> Head:
        """Where the chain ends."""
        return Head(len(self.records), self.records[-1]["hash"]) if self.records else Head(0, START)


def sealed(values: Record, end: Head) -> Record:
    """The record of `values` that follows `end`."""
    record = {**values, "sequence": end.sequence + 1, "previous": end.hash}
    return {**record, "hash": sha256_canonical(record)}


def read_chain(data: bytes, head: Head | None) -> Chain:
    """The records in a log's bytes, checked against each other and against the head."""
    *lines, torn = data.split(b"\n")
    found = [_read_line(line) for line in lines]
    problems = [*_line_problems(found), *_order_problems(found)]
    if not problems:
        problems += _head_problems([record for record in found if isinstance(record, dict)], head)
    records = () if problems else tuple(record for record in found if isinstance(record, dict))
    return Chain(
        records, tuple(sorted(problems, key=lambda problem: problem.line)), len(lines), torn
    )


def _read_line(line: bytes) -> Record | str:
    """The record of a line, or what is wrong with the line by itself."""
    try:
        value, _line, problem = decode_json(line.decode())
    except UnicodeDecodeError:
        return "is no UTF-8 text"
    if problem is not None:
        return f"is {problem}"
    if (
        not isinstance(value, dict)
        or not isinstance(value.get("hash"), str)
        or type(value.get("sequence")) is not int
    ):
        return "is no record"
    # The line is canonical, so that taking the member out of its bytes gives the canonical form
    # without it.
    content = line.replace(f'"hash":"{value["hash"]}",'.encode(), b"", 1)
    return (
        value
        if hashlib.sha256(content).hexdigest() == value["hash"]
        else f"(record {value['sequence']}) is not what was recorded: its hash does not fit"
    )


def _line_problems(found: list[Record | str]) -> Iterator[Problem]:
    for number, item in enumerate(found, start=1):
        if isinstance(item, str):
            yield Problem(number, f"line {number} {item}; it was changed")


def _order_problems(found: list[Record | str]) -> Iterator[Problem]:
    """Records that do not follow the line before; a line that was changed itself breaks nothing
    more.
    """
    places: dict[int, list[int]] = {}
    for number, item in enumerate(found, start=1):
        if isinstance(item, dict):
            places.setdefault(item["sequence"], []).append(number)
    before: Record | str | None = None
    for number, item in enumerate(found, start=1):
        if isinstance(item, dict) and not isinstance(before, str):
            sequence, previous = (before["sequence"], before["hash"]) if before else (0, START)
            if item["sequence"] != sequence + 1:
                yield Problem(number, _misplaced(number, item["sequence"], sequence + 1, places))
            elif item["previous"] != previous:
                yield Problem(
                    number,
                    f"line {number} (record {item['sequence']}) was recorded after another line"
                    f" than line {number - 1}; line {number - 1} was replaced",
                )
        before = item


def _misplaced(number: int, sequence: int, expected: int, places: dict[int, list[int]]) -> str:
    holds = f"line {number} holds record {sequence} where record {expected} belongs"
    if expected in places:
        return (
            f"{holds}, which stands in line {places[expected][0]}; lines changed places or were"
            " repeated"
        )
    if sequence < expected:
        return f"{holds}; lines changed places or were repeated"
    missing = (
        f"record {expected} is"
        if sequence == expected + 1
        else f"records {expected} to {sequence - 1} are"
    )
    return f"{holds}; {missing} missing: lines were removed"


def _head_problems(records: list[Record], head: Head | None) -> Iterator[Problem]:
    count = len(records)
    if head is None:
        # The first record without a head was written by a process that was killed before it could
        # write one.
        if count > 1:
            yield Problem(
                0, "the head file is missing, so that lines removed at the end would not be seen"
            )
    elif head.sequence > count:
        cut = (
            f"record {head.sequence} is"
            if head.sequence == count + 1
            else f"records {count + 1} to {head.sequence} are"
        )
        yield Problem(
            count + 1,
            f"line {count + 1} is missing: {cut} known to the head file; lines were removed at"
            " the end",
        )
    elif head.sequence < count - 1:
        yield Problem(
            0,
            f"the head file ends at record {head.sequence}, the log at record {count}; the head"
            " file was replaced by an older one, or lines were added",
        )
    elif head.hash != (records[head.sequence - 1]["hash"] if head.sequence else START):
        yield Problem(
            head.sequence,
            f"line {head.sequence} (record {head.sequence}) is not the record that the head file"
            " knows; it was replaced",
        )
