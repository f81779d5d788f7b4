"""A person's decision about a plan in the log, its runs, whether a plan is the one that was
approved, and what differs: the log shows later changes, not who decided.
"""

from collections.abc import Collection, Iterator, Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any, Literal

from planner_ft.document import PlanDocument, altered, differences, document_digest
from planner_ft.document.edits import replayed
from planner_ft.document.entered import short
from planner_ft.review.log import Appended, Record, append, read_log
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import compact_json
from planner_ft.vocabulary import Vocabulary

DERIVED = frozenset(
    ["edits", "ontology", "sources", "open_places", "warnings", "estimate", "valid", "complete"]
)
"""Keys that follow from the rest, or repeat it; their changes come last."""
Warnings = list[dict[str, str]]
LONGEST_NAME, LONGEST_REASON = 200, 2000
"""Characters."""
ALL = "all"
"""Acknowledges every warning."""
USED = ("candidate", "configuration", "adapter")
Status = Literal["approved", "rejected", "altered", "unknown"]
DECISIONS = ("approved", "rejected")
"""Events of the log that decide; the others tell of runs."""
Words = tuple[str, ...]
MORE = "more than the tasks: the command, the vehicle, the proposal, or the record of changes"


@dataclass(frozen=True)
class Change:
    """One value that is different. `text` is for people: "task 2, radius: approved 12, now 20"."""

    path: str
    approved: Any
    now: Any
    text: str


def tampered(document: PlanDocument, vocabulary: Vocabulary) -> list[Change] | None:
    """What was changed in a plan outside of the review since it was saved; None: nothing was. Saved
    was the proposal with the edits; where that has not the digest either, more than the tasks was.
    """
    if not altered(document):
        return None
    try:
        saved = replayed(document, vocabulary)
    except (PlannerError, KeyError, TypeError):
        return [Change("", None, None, MORE)]
    found = changes(saved, {**document, "digest": saved["digest"]})
    named = [replace(one, text=one.text.replace(": approved ", ": saved ", 1)) for one in found]
    return (
        named if saved["digest"] == document.get("digest") else [*named, Change("", "", "", MORE)]
    )


def changes(approved: PlanDocument, now: PlanDocument) -> list[Change]:
    """Every difference between two documents; derived values (warnings, estimates) come last."""
    found = list(_walk("", (), approved, now))
    found.sort(key=lambda change: not DERIVED.isdisjoint(change.path.split(".")))
    # The digest is another whenever anything is: it counts only where it alone was changed.
    return [change for change in found if change.path != "digest"] or found


def _walk(path: str, words: Words, before: Any, after: Any) -> Iterator[Change]:
    keyed = _keyed(before, after)
    if keyed is None:
        if before != after or isinstance(before, bool) != isinstance(after, bool):
            yield _change(path, words, before, after)
        return
    old, new = keyed
    for key in {**old, **new}:
        named = _named(words, path, key, keyed)
        below = f"{path}.{key}" if path else str(key)
        if key in old and key in new:
            yield from _walk(below, named, old[key], new[key])
        else:
            yield _change(below, named, old.get(key), new.get(key))
    if isinstance(before, list):
        kept = [str(key) for key in old if key in new], [str(key) for key in new if key in old]
        if kept[0] != kept[1]:
            approved, now = (", ".join(names) for names in kept)
            text = f"order of {', '.join(words)}: approved {approved}, now {now}"
            yield Change(path, *kept, text)


def _keyed(before: Any, after: Any) -> tuple[dict[Any, Any], dict[Any, Any]] | None:
    """Both values as dictionaries (lists by id, else by place); None: compared as a whole."""
    if isinstance(before, dict) and isinstance(after, dict):
        return before, after
    if not (isinstance(before, list) and isinstance(after, list)):
        return None
    ids = [
        [one.get("id") if isinstance(one, dict) else None for one in of] for of in (before, after)
    ]
    if all(len({name for name in of if isinstance(name, str)}) == len(of) for of in ids):
        return dict(zip(ids[0], before, strict=True)), dict(zip(ids[1], after, strict=True))
    if any(isinstance(item, dict) for item in [*before, *after]):
        return dict(enumerate(before)), dict(enumerate(after))
    return None


def _named(words: Words, path: str, key: Any, keyed: tuple[dict[Any, Any], ...]) -> Words:
    """The name of a key below a path, for people."""
    value = next(entries[key] for entries in keyed if key in entries)
    holder, name = path.rpartition(".")[2], value.get("name") if isinstance(value, dict) else None
    if key in ("parameters", "skill_sequence"):
        return words
    if isinstance(value, dict) and value.get("id") == key:
        place = [*(keyed[1] if key in keyed[1] else keyed[0])].index(key)
        return (*words[:-1], f"task {place + 1}" if holder == "tasks" else str(key))
    if isinstance(key, int):
        if holder == "skill_sequence":
            return (*words, f"step {key + 1}")
        return (*words, str(name or f"item {key + 1}"))
    return (*words, str(name) if name and key == "navigation_skill" else str(key))


def _change(path: str, words: Words, before: Any, after: Any) -> Change:
    named = ", ".join(words) or "the plan"
    return Change(path, before, after, f"{named}: approved {_shown(before)}, now {_shown(after)}")


def _shown(value: Any) -> str:
    return short("nothing" if value is None else compact_json(value))


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
        "differences": [asdict(difference) for difference in differences(document)],
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
        return Approval(status, f"{status} by {who}{why}", digest, **_decided(last))
    other = _earlier_approval(document, records)
    if other is not None:
        found = tuple(changes(other["plan"], document))
        count = f"{len(found)} change{'s' if len(found) != 1 else ''}"
        when = f"at {other['time']} (record {other['sequence']})"
        text = f"altered since {other['reviewer']} approved it {when}: {count}"
        return Approval("altered", text, digest, **_decided(other), changes=found)
    if intact:
        return Approval("unknown", f"not approved: {log} holds no decision about this plan", digest)
    text = "altered by hand: the plan is not what its digest says"
    return Approval("altered", f"{text}, and {log} holds no approval of it", digest)


def _earlier_approval(document: PlanDocument, records: Sequence[Record]) -> Record | None:
    """The last approval of the same digest, else proposal, else command in the same run."""
    approved = [record for record in reversed(records) if record["event"] == "approved"]
    for keys in (("digest",), ("proposed", "manifest"), ("command", "manifest")):
        for record in approved:
            if all(key in document and record["plan"].get(key) == document[key] for key in keys):
                return record
    return None


def _decided(record: Record) -> dict[str, Any]:
    return {key: record[key] for key in ("sequence", "reviewer", "time", "reason")}
