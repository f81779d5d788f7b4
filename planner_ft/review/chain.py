"""The hash chain of an approval log, and the problems that break it.

A line is the RFC 8785 form of its record. `hash` is the SHA-256 of that form without the member
`hash`, `previous` the hash of the line before. The head file beside the log holds sequence and hash
of the last record, so that lines missing at the end are noticed, too.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, NamedTuple

from planner_ft.document.build import sha256_canonical
from planner_ft.support.files import decode_json

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
        value, _line, problem = decode_json(line.decode())
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
        # One record without a head: its writer was killed before it could write the head.
        if count > 1:
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
