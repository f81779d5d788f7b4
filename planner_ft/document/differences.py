"""What an operator changed: the plan as it stands, against what the model proposed."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass
from typing import Any, Literal

from planner_ft.document.files import PlanDocument
from planner_ft.support.files import compact_json

Tasks = Sequence[dict[str, Any]]
MISSING = "nothing"


@dataclass(frozen=True)
class Difference:
    """One change: to which task (None: to the plan), of what, from which value to which; `text`
    says it in a sentence.
    """

    task: str | None
    kind: Literal["added", "removed", "moved", "parameter", "prompt", "skills", "located"]
    name: str
    before: Any
    after: Any
    text: str

    def as_json(self) -> dict[str, Any]:
        """The change as a JSON object."""
        return asdict(self)


def differences(document: PlanDocument) -> list[Difference]:
    """What differs between the proposal of a document and the plan as it stands."""
    return compare(document["proposed"], document)


def compare(before: dict[str, Any], after: dict[str, Any]) -> list[Difference]:
    """The differences between two plans of one command ({"tasks", "located"}), whose tasks are the
    same when their ids are.
    """
    old, new = (
        {task["id"]: task for task in before["tasks"]},
        {task["id"]: task for task in after["tasks"]},
    )
    found = list(_located(before["located"], after["located"]))
    for ident, task in old.items():
        if ident not in new:
            found.append(
                Difference(
                    ident,
                    "removed",
                    task["title"],
                    task["parameters"],
                    None,
                    f"{_called(task)}: removed",
                )
            )
    for number, task in enumerate(after["tasks"], start=1):
        if task["id"] not in old:
            found.append(
                Difference(
                    task["id"],
                    "added",
                    task["title"],
                    None,
                    task["parameters"],
                    f"task {number}, {task['title']}: added",
                )
            )
        else:
            found += _within(number, old[task["id"]], task)
    return found + list(_moved(before["tasks"], after["tasks"]))


def _within(number: int, old: dict[str, Any], new: dict[str, Any]) -> Iterator[Difference]:
    where = f"task {number}, {new['title']}"
    for name in dict.fromkeys((*old["parameters"], *new["parameters"])):
        before, after = old["parameters"].get(name), new["parameters"].get(name)
        if before != after:
            yield Difference(
                new["id"],
                "parameter",
                name,
                before,
                after,
                f"{where}: {name} {_shown(before)} -> {_shown(after)}",
            )
    if old["task_prompt"] != new["task_prompt"]:
        text = f'{where}: prompt "{old["task_prompt"]}" -> "{new["task_prompt"]}"'
        yield Difference(
            new["id"], "prompt", "task_prompt", old["task_prompt"], new["task_prompt"], text
        )
    if old["skill_sequence"] != new["skill_sequence"]:
        text = f"{where}: skills {_steps(old['skill_sequence'])} -> {_steps(new['skill_sequence'])}"
        yield Difference(
            new["id"],
            "skills",
            "skill_sequence",
            old["skill_sequence"],
            new["skill_sequence"],
            text,
        )


def _located(old: dict[str, Any], new: dict[str, Any]) -> Iterator[Difference]:
    for name in dict.fromkeys((*old, *new)):
        if old.get(name) != new.get(name):
            yield Difference(
                None,
                "located",
                name,
                old.get(name),
                new.get(name),
                f"{name}: {_shown(old.get(name))} -> {_shown(new.get(name))}",
            )


def _moved(old: Tasks, new: Tasks) -> Iterator[Difference]:
    """The tasks that stand elsewhere among those that both plans have: as few as explain the new
    order.
    """
    common = {task["id"] for task in old} & {task["id"] for task in new}
    places = {
        task["id"]: index for index, task in enumerate(task for task in old if task["id"] in common)
    }
    row = [task["id"] for task in new if task["id"] in common]
    kept = {row[index] for index in _longest_rising([places[ident] for ident in row])}
    at = {task["id"]: number for number, task in enumerate(new, start=1)}
    was = {task["id"]: number for number, task in enumerate(old, start=1)}
    titles = {task["id"]: task["title"] for task in new}
    for ident in row:
        if ident not in kept:
            yield Difference(
                ident,
                "moved",
                titles[ident],
                was[ident],
                at[ident],
                f"{titles[ident]}: moved from place {was[ident]} to {at[ident]}",
            )


def _longest_rising(values: Sequence[int]) -> list[int]:
    """The indices of a longest rising subsequence."""
    best: list[list[int]] = []
    for index, value in enumerate(values):
        longest = max((row for row in best if values[row[-1]] < value), key=len, default=[])
        best.append([*longest, index])
    return max(best, key=len, default=[])


def _called(task: dict[str, Any]) -> str:
    return f"{task['title']} ({task['id']})"


def _shown(value: Any) -> str:
    return MISSING if value is None else compact_json(value)


def _steps(skills: list[Any] | None) -> str:
    return MISSING if skills is None else f"{len(skills)} step{'s' if len(skills) != 1 else ''}"
