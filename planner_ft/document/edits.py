"""An operator's changes to a plan document: each is checked, made and recorded, or taken back; and
what they changed: the plan as it stands, against what the model proposed.
"""

import copy
import inspect
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from datetime import UTC, datetime
from typing import Any, Literal

from planner_ft.document import operations
from planner_ft.document.build import PlanDocument, altered, revise, without_derived
from planner_ft.document.entered import short
from planner_ft.document.operations import Draft
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import compact_json
from planner_ft.vocabulary import Vocabulary

Edit = dict[str, Any]  # {"kind": one of KINDS, ...}: what to change
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
Tasks = Sequence[dict[str, Any]]
MISSING = "nothing"
Kind = Literal[
    "added", "removed", "moved", "title", "parameter", "prompt", "skills", "located", "constraint"
]


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


@dataclass(frozen=True)
class Difference:
    """One change of a task (None: of the plan); `text` is a sentence, `by` who made it last."""

    task: str | None
    kind: Kind
    name: str
    before: Any
    after: Any
    text: str
    by: str | None = None


def differences(document: PlanDocument) -> list[Difference]:
    """The differences between the proposal of a document and the plan as it stands."""
    return [
        replace(one, by=by, text=f"{one.text}, changed by {by}")
        if (by := _author(one, document))
        else one
        for one in compare(document["proposed"], document)
    ]


OF_EDIT: dict[Kind, tuple[str, ...]] = {
    "added": ("insert",),
    "removed": ("remove",),
    "moved": ("move",),
    "title": ("title",),
    "parameter": ("parameter", "locate", "origin", "title"),
    "prompt": ("prompt", "parameter"),
    "skills": ("skills", "skill", "drop"),
    "located": ("locate", "origin"),
    "constraint": ("constraint",),
}
"""The kinds of edits that a kind of difference comes from; `replace` may bring any."""


def _author(one: Difference, document: PlanDocument) -> str | None:
    """Who made the last edit that a difference can come from."""
    for record in reversed(document["edits"]):
        edit, kind = record["edit"], record["edit"]["kind"]
        of_task = edit.get("task", edit.get("id", one.task)) == one.task
        named = edit.get("name", one.name) == one.name
        by_name = one.kind == "located" or (kind == "parameter" and one.kind != "prompt")
        mine = kind in OF_EDIT[one.kind] and of_task and (named or not by_name)
        if mine or kind == "replace":
            return str(record["by"]) if record["by"] else None
    return None


def compare(before: dict[str, Any], after: dict[str, Any]) -> list[Difference]:
    """The differences between two plans of one command; tasks of one id are the same."""
    old = {task["id"]: task for task in before["tasks"]}
    kept = {task["id"] for task in after["tasks"]}
    found = list(_changes(None, "located", "", before["located"], after["located"]))
    for text in dict.fromkeys((*before.get("constraints", ()), *after.get("constraints", ()))):
        was, now = (text in plan.get("constraints", ()) for plan in (before, after))
        if was != now:
            change = f'constraint "{text}": {"added" if now else "removed"}'
            old_text, new_text = text if was else None, text if now else None
            found.append(Difference(None, "constraint", "", old_text, new_text, change))
    for name, task in old.items():
        title, given = task["title"], task["parameters"]
        if name not in kept:
            text = f"{title} ({name}): removed"
            found.append(Difference(name, "removed", title, given, None, text))
    for number, task in enumerate(after["tasks"], start=1):
        name, title, given = task["id"], task["title"], task["parameters"]
        where = f"task {number}, {title}: "
        if name in old:
            found += _within(where, old[name], task)
        else:
            found.append(Difference(name, "added", title, None, given, f"{where}added"))
    return found + list(_moved(before["tasks"], after["tasks"]))


def _within(where: str, old: dict[str, Any], new: dict[str, Any]) -> Iterator[Difference]:
    name = new["id"]
    if old["title"] != new["title"]:
        before, after = old["title"], new["title"]
        text = f"{where}was {before}"
        yield Difference(name, "title", "title", before, after, text)
    yield from _changes(name, "parameter", where, old["parameters"], new["parameters"])
    before, after = old["task_prompt"], new["task_prompt"]
    if before != after:
        text = f'{where}prompt "{before}" -> "{after}"'
        yield Difference(name, "prompt", "task_prompt", before, after, text)
    before, after = old["skill_sequence"], new["skill_sequence"]
    if before != after:
        text = f"{where}skills {_steps(before)} -> {_steps(after)}"
        yield Difference(name, "skills", "skill_sequence", before, after, text)


def _changes(
    task: str | None, kind: Kind, where: str, old: dict[str, Any], new: dict[str, Any]
) -> Iterator[Difference]:
    """The differences between two objects, key by key."""
    for name in dict.fromkeys((*old, *new)):
        before, after = old.get(name), new.get(name)
        if before != after:
            sign = ":" if kind == "located" else ""
            text = f"{where}{name}{sign} {_shown(before)} -> {_shown(after)}"
            yield Difference(task, kind, name, before, after, text)


def _moved(old: Tasks, new: Tasks) -> Iterator[Difference]:
    """The fewest tasks whose moves explain the new order."""
    was = {task["id"]: number for number, task in enumerate(old, start=1)}
    common = [(at, task) for at, task in enumerate(new, start=1) if task["id"] in was]
    kept = _longest_rising([was[task["id"]] for _at, task in common])
    for at, task in common:
        name, title, place = task["id"], task["title"], was[task["id"]]
        if place not in kept:
            text = f"{title}: moved from place {place} to {at}"
            yield Difference(name, "moved", title, place, at, text)


def _longest_rising(values: Sequence[int]) -> list[int]:
    """A longest rising subsequence of different values."""
    best: list[list[int]] = []
    for value in values:
        longest = max((row for row in best if row[-1] < value), key=len, default=[])
        best.append([*longest, value])
    return max(best, key=len, default=[])


def _shown(value: Any) -> str:
    return MISSING if value is None else compact_json(value)


def _steps(skills: list[Any] | None) -> str:
    return MISSING if skills is None else f"{len(skills)} step{'s' if len(skills) != 1 else ''}"
