"""What an operator changed: the plan as it stands, against what the model proposed."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any, Literal

from planner_ft.document.build import PlanDocument
from planner_ft.support.files import compact_json

Tasks = Sequence[dict[str, Any]]
MISSING = "nothing"
Kind = Literal[
    "added", "removed", "moved", "title", "parameter", "prompt", "skills", "located", "constraint"
]


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
