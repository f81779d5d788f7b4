"""A person's decision about a plan in the log, and its runs: it shows later changes, not who
decided.
"""

from __future__ import annotations

from collections.abc import Collection
from pathlib import Path
from typing import Any, Literal

from planner_ft.document import PlanDocument, altered, differences, document_digest
from planner_ft.review.log import Appended, append
from planner_ft.support.errors import PlannerError

Warnings = list[dict[str, str]]
LONGEST_NAME, LONGEST_REASON = 200, 2000
"""Characters."""
ALL = "all"
"""Acknowledges every warning."""
USED = ("candidate", "configuration", "adapter")


class UnacknowledgedError(PlannerError):
    """Warnings of the plan were not acknowledged; `missing` are their ids."""

    def __init__(self, message: str, missing: tuple[str, ...]) -> None:
        super().__init__(message)
        self.missing = missing


def approve(
    document: PlanDocument,
    log: Path,
    reviewer: str,
    acknowledged: Collection[str] = (),
    reason: str = "",
) -> Appended:
    """Record an approval of the plan and its warnings (ids, or "all"). Raises PlannerError."""
    _check_texts(reviewer, reason)
    if altered(document):
        problem = "the plan was altered by hand since it was written, so it cannot be approved"
        raise PlannerError(f"{problem}; look at it and take the changes over with --adopt")
    if not document["valid"]:
        problem = "an answer in the plan is not valid, so it cannot be approved"
        raise PlannerError(f"{problem}; edit the plan, or plan the command again")
    _check_acknowledged(document, acknowledged)
    warnings = [{"id": warning["id"], "text": warning["text"]} for warning in document["warnings"]]
    return append(log, _decision("approved", document, reviewer, reason, warnings))


def reject(document: PlanDocument, log: Path, reviewer: str, reason: str) -> Appended:
    """Record a rejection, which ends an approval. Raises PlannerError without name or reason."""
    if not reason.strip():
        raise PlannerError("a rejection needs its reason; give it with --reject REASON")
    _check_texts(reviewer, reason)
    return append(log, _decision("rejected", document, reviewer, reason, []))


def record_run(
    event: Literal["run", "aborted", "ended"],
    document: PlanDocument,
    log: Path,
    reviewer: str,
    words: str,
) -> Appended:
    """Record that an approved plan is carried out, aborted, or over. Raises PlannerError."""
    _check_texts(reviewer, "")
    record = {**_decision(event, document, reviewer, words, []), "plan": None}
    return append(log, record)


def _decision(
    event: str, document: PlanDocument, reviewer: str, reason: str, acknowledged: Warnings
) -> dict[str, Any]:
    digest = document_digest(document)
    agents = document.get("manifest", {}).get("agents", {})
    # Per agent: candidate, configuration, and the manifest's hashes of weights and adapter.
    models = {
        agent: {**{key: use[key] for key in USED if key in use}, **agents.get(agent, {})}
        for agent, use in document.get("usage", {}).items()
    }
    return {
        "event": event,
        "reviewer": reviewer.strip(),
        "reason": reason.strip(),
        "digest": digest,
        "plan": {**document, "digest": digest},
        "acknowledged": acknowledged,
        "differences": [difference.as_json() for difference in differences(document)],
        "models": models,
    }


def check_name(reviewer: str) -> None:
    """Raise PlannerError for a name that cannot be recorded."""
    if not reviewer.isprintable() or len(reviewer) > LONGEST_NAME:
        limit = f"must be at most {LONGEST_NAME} printable characters"
        raise PlannerError(f"--name {reviewer[:LONGEST_NAME]!r}: {limit}")


def _check_texts(reviewer: str, reason: str) -> None:
    if not reviewer.strip():
        raise PlannerError("a decision needs the name of who takes it; give --name NAME")
    check_name(reviewer)
    try:
        reason.encode()
    except UnicodeEncodeError:
        raise PlannerError("the reason is not UTF-8 text; write it anew") from None
    if len(reason) > LONGEST_REASON:
        limit = f"at most {LONGEST_REASON} are recorded, so shorten it"
        raise PlannerError(f"the reason has {len(reason)} characters; {limit}")


def _check_acknowledged(document: PlanDocument, acknowledged: Collection[str]) -> None:
    ids = [warning["id"] for warning in document["warnings"]]
    unknown = [name for name in acknowledged if name not in (*ids, ALL)]
    if unknown:
        problem = f"the plan has no such warning; it has {', '.join(ids) or 'none'}"
        raise PlannerError(f"--acknowledge {unknown[0]}: {problem}")
    missing = tuple(name for name in ids if name not in acknowledged and ALL not in acknowledged)
    if missing:
        problem = f"{len(missing)} of {len(ids)} warnings are not acknowledged"
        way_out = f"{', '.join(missing)}; read them, then give --acknowledge ID (or all)"
        raise UnacknowledgedError(f"{problem}: {way_out}", missing)
