"""An operator's changes to a plan document: each is checked, made and recorded, or taken back."""

from __future__ import annotations

import copy
import inspect
from collections.abc import Callable, Sequence
from datetime import UTC, datetime
from typing import Any

from planner_ft.document import operations
from planner_ft.document.build import PlanDocument, altered, revise, without_derived
from planner_ft.document.entered import short
from planner_ft.document.operations import Draft
from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary import Vocabulary

Edit = dict[str, Any]
"""{"kind": one of KINDS, ...}: what to change."""
KINDS: dict[str, Callable[..., Edit | None]] = {
    name: getattr(operations, name)
    for name in (
        *("locate", "origin", "constraint", "parameter", "title", "prompt", "remove", "move"),
        *("insert", "skills", "replace", "skill", "drop"),
    )
}
"""The operation of each kind. Its arguments are the keys of the edit; those with a default may be
left out.
"""
TEXT, WHOLE = (str, "a text"), (int, "a whole number")
FIELDS: dict[str, tuple[type, str]] = {
    **dict.fromkeys(("name", "title", "place", "role", "text"), TEXT),
    **dict.fromkeys(("at", "to", "step", "index"), WHOLE),
    "task": (str, "the id of a task"),
    "position": (list, "a position [x, y]"),
    "skill_sequence": (list, "a list of steps"),
    "tasks": (list, "a list of tasks"),
}
"""What a key must be that an edit needs."""


def apply(
    document: PlanDocument, edit: Edit, vocabulary: Vocabulary, by: str | None = None
) -> PlanDocument:
    """The document with one edit made and recorded. Raises PlannerError."""
    if altered(document):
        problem = "the plan was altered outside of the review and has not the content of its digest"
        raise PlannerError(f"{problem}; adopt it as it is, or take the file as it was")
    return revise(_applied(document, _record(edit, by), vocabulary), vocabulary)


def adopt(document: PlanDocument, vocabulary: Vocabulary, by: str | None = None) -> PlanDocument:
    """A document altered outside, with its tasks recorded as an edit. Raises PlannerError."""
    tasks = [without_derived(task) for task in document["tasks"]]
    record = _record({"kind": "replace", "tasks": tasks}, by)
    return revise(_applied(document, record, vocabulary), vocabulary)


def undo(document: PlanDocument, vocabulary: Vocabulary) -> PlanDocument:
    """The document without its last edit. Raises PlannerError when there is none."""
    if not document["edits"]:
        raise PlannerError("there is no edit to take back; the plan is as it was proposed")
    return replayed({**document, "edits": document["edits"][:-1]}, vocabulary, document["edits"])


def replayed(
    document: PlanDocument, vocabulary: Vocabulary, made: Sequence[Edit] | None = None
) -> PlanDocument:
    """The proposal of a document with its edits made anew: what was saved, whatever was changed in
    the file since. `made` are all edits that there were. Raises PlannerError.
    """
    edits = document["edits"]
    if any(record["edit"]["kind"] == "origin" for record in made or edits):
        document = {key: value for key, value in document.items() if key != "origin"}
    again = {**document, **copy.deepcopy(document["proposed"]), "edits": []}
    for record in edits:
        again = _applied(again, record, vocabulary)
    return revise(again, vocabulary)


def _record(edit: Edit, by: str | None) -> dict[str, Any]:
    return {"time": datetime.now(UTC).isoformat(timespec="seconds"), "by": by, "edit": edit}


def _applied(
    document: PlanDocument, record: dict[str, Any], vocabulary: Vocabulary
) -> PlanDocument:
    edit = copy.deepcopy(record["edit"])
    kind = edit.get("kind") if isinstance(edit, dict) else None
    if not isinstance(kind, str) or kind not in KINDS:
        raise PlannerError(f"edit {short(repr(kind))}: is not known; there is {', '.join(KINDS)}")
    given = {key: value for key, value in edit.items() if key != "kind"}
    _draft, *keys = inspect.signature(KINDS[kind]).parameters.values()
    if unknown := [key for key in given if key not in [one.name for one in keys]]:
        raise PlannerError(f"edit {kind}: has no {short(unknown[0])}; leave it out")
    for name in (one.name for one in keys if one.default is one.empty):
        types, expected = FIELDS[name]
        if not isinstance(given.get(name), types) or isinstance(given[name], bool):
            raise PlannerError(f"edit {kind}: {name} must be {expected}")
    tasks, located = copy.deepcopy(document["tasks"]), dict(document["located"])
    draft = Draft({**document, "tasks": tasks, "located": located}, vocabulary)
    if "task" in given:
        given["task"] = draft.task(given["task"])
    more = KINDS[kind](draft, **given) or {}
    made = [*document["edits"], {**record, "edit": {**edit, **more}}]
    return {**draft.document, "edits": made}
