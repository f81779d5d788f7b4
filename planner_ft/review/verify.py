"""Whether a plan is the one that was approved, and if not, the differences."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any, Literal

from planner_ft.document import PlanDocument, document_digest
from planner_ft.review.chain import Record
from planner_ft.review.changes import Change, changes
from planner_ft.review.log import read_log

Status = Literal["approved", "rejected", "altered", "unknown"]
DECISIONS = ("approved", "rejected")
"""Events of the log that decide; the others tell of runs."""


@dataclass(frozen=True)
class Approval:
    """The log's knowledge of a plan; who, when and why are None without a decision.

    `approved` and `rejected`: the last decision about exactly this plan. `altered`: another version
    was approved (`changes`: the differences), or the digest is wrong. `unknown`: no decision.
    """

    status: Status
    text: str
    digest: str
    sequence: int | None = None
    reviewer: str | None = None
    time: str | None = None
    reason: str | None = None
    changes: tuple[Change, ...] = ()

    def as_json(self) -> dict[str, Any]:
        return asdict(self)


def approval_of(document: PlanDocument, log: Path) -> Approval:
    """The log's knowledge of the plan as it is now. Raises PlannerError for a broken log."""
    records, digest = read_log(log), document_digest(document)
    intact = document.get("digest") == digest
    decided = [one for one in records if one["event"] in DECISIONS]
    last = next((record for record in reversed(decided) if record["digest"] == digest), None)
    if intact and last is not None:
        status: Status = "approved" if last["event"] == "approved" else "rejected"
        why = f": {last['reason']}" if last["reason"] else ""
        who = f"{last['reviewer']} at {last['time']} (record {last['sequence']})"
        return Approval(status, f"{status} by {who}{why}", digest, **_decision(last))
    other = _earlier_approval(document, records)
    if other is not None:
        found = tuple(changes(other["plan"], document))
        count = f"{len(found)} change{'s' if len(found) != 1 else ''}"
        when = f"at {other['time']} (record {other['sequence']})"
        text = f"altered since {other['reviewer']} approved it {when}: {count}"
        return Approval("altered", text, digest, **_decision(other), changes=found)
    if intact:
        return Approval("unknown", f"not approved: {log} holds no decision about this plan", digest)
    text = "altered by hand: the plan is not what its digest says"
    return Approval("altered", f"{text}, and {log} holds no approval of it", digest)


def _decision(record: Record) -> dict[str, Any]:
    return {key: record[key] for key in ("sequence", "reviewer", "time", "reason")}


def _earlier_approval(document: PlanDocument, records: Sequence[Record]) -> Record | None:
    """The last approval of the same digest, else proposal, else command in the same run."""
    approved = [record for record in reversed(records) if record["event"] == "approved"]
    for keys in (("digest",), ("proposed", "manifest"), ("command", "manifest")):
        for record in approved:
            if all(key in document and record["plan"].get(key) == document[key] for key in keys):
                return record
    return None
