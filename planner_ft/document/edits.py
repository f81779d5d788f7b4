"""An operator's changes to a plan document. Each is checked before it takes effect; the last one
can be taken back.
"""

from __future__ import annotations

import copy
from collections.abc import Callable, Mapping
from datetime import UTC, datetime
from functools import cache
from typing import Any

import jsonschema

from planner_ft.document.digest import altered
from planner_ft.document.files import PlanDocument
from planner_ft.document.places import places_of, tasks_at
from planner_ft.document.revise import revise
from planner_ft.document.reword import reword
from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary import Parameter, Skill, Task, Vocabulary
from planner_ft.vocabulary.document_schema import task_schema
from planner_ft.vocabulary.plans import canonical_value, plan_problems, step_skills, value_problem

Edit = dict[str, Any]
"""{"kind": one of KINDS, ...}: what to change."""
LONGEST_PROMPT = 4000
LONGEST_SHOWN = 120
"""Characters of a value that a sentence repeats."""
MOST_TASKS = 1000


def apply(
    document: PlanDocument, edit: Edit, vocabulary: Vocabulary, by: str | None = None
) -> PlanDocument:
    """The document with one edit made, recorded and all that derives recomputed.

    Raises PlannerError when it cannot be made, and for a document that was altered outside: its new
    digest would hide that (see `adopt`).
    """
    if altered(document):
        raise PlannerError(
            "the plan was altered outside of the review and has not the content of its digest;"
            " adopt it as it is, or take the file as it was"
        )
    return revise(_applied(document, _record(edit, by), vocabulary), vocabulary)


def adopt(document: PlanDocument, vocabulary: Vocabulary, by: str | None = None) -> PlanDocument:
    """A document that was altered outside, its tasks as they stand recorded as an edit. Raises
    PlannerError when they are not valid.
    """
    tasks = [
        {key: value for key, value in task.items() if key not in ("sources", "waits_for")}
        for task in document["tasks"]
    ]
    return revise(
        _applied(document, _record({"kind": "replace", "tasks": tasks}, by), vocabulary), vocabulary
    )


def undo(document: PlanDocument, vocabulary: Vocabulary) -> PlanDocument:
    """The document without its last edit: the proposal with the edits before it made again. Raises
    PlannerError when there is none.
    """
    if not document["edits"]:
        raise PlannerError("there is no edit to take back; the plan is as it was proposed")
    undone = {**document, **copy.deepcopy(document["proposed"]), "edits": []}
    for record in document["edits"][:-1]:
        undone = _applied(undone, record, vocabulary)
    return revise(undone, vocabulary)


def _record(edit: Edit, by: str | None) -> dict[str, Any]:
    return {"time": datetime.now(UTC).isoformat(timespec="seconds"), "by": by, "edit": edit}


def _applied(
    document: PlanDocument, record: dict[str, Any], vocabulary: Vocabulary
) -> PlanDocument:
    edit = copy.deepcopy(record["edit"])
    kind = edit.get("kind") if isinstance(edit, dict) else None
    if not isinstance(kind, str) or kind not in KINDS:
        raise PlannerError(f"edit {_short(repr(kind))}: is not known; there is {', '.join(KINDS)}")
    keys, change = KINDS[kind]
    unknown = [key for key in edit if key not in ("kind", *keys, *OPTIONAL.get(kind, ()))]
    if unknown:
        raise PlannerError(f"edit {kind}: has no {_short(unknown[0])}; leave it out")
    for key, (types, what) in keys.items():
        if key not in edit or not isinstance(edit[key], types) or isinstance(edit[key], bool):
            raise PlannerError(f"edit {kind}: {key} must be {what}")
    edited = {
        **document,
        "tasks": copy.deepcopy(document["tasks"]),
        "located": dict(document["located"]),
    }
    change(edited, edit, vocabulary)
    return {**edited, "edits": [*document["edits"], {**record, "edit": edit}]}


# ---------------------------------------------------------------- the kinds of edits: each changes
# `document`, which is a copy


def _locate(document: PlanDocument, edit: Edit, vocabulary: Vocabulary) -> None:
    name, position = (
        edit["name"],
        _value(edit["position"], Parameter("position", "position", "m"), "position"),
    )
    if position == list(vocabulary.unresolved):
        raise PlannerError(f"{name}: {position} stands for an unknown place; give where it is")
    found = tasks_at(name, document["tasks"], vocabulary)
    if not found:
        known = [
            *(place.name for place in places_of(document["tasks"], vocabulary)),
            *document["located"],
        ]
        raise PlannerError(
            f"{_short(name)}: no such place is open; there is {', '.join(known) or 'none'}"
        )
    for task, parameter in found:
        task["parameters"][parameter] = position
        task["located"] = {**task.get("located", {}), parameter: name}
        _outdate(task)
    document["located"][name] = position


def _parameter(document: PlanDocument, edit: Edit, vocabulary: Vocabulary) -> None:
    task = _task(document, edit)
    name, value = edit["name"], edit.get("value")
    parameter = _known(vocabulary.task[task["title"]], task["title"], name)
    before = task["parameters"].get(name)
    if value is None:
        task["parameters"].pop(name, None)
    else:
        task["parameters"][name] = _value(value, parameter, name)
        task["task_prompt"] = reword(task["task_prompt"], before, task["parameters"][name])
    task["located"] = {key: place for key, place in task.get("located", {}).items() if key != name}
    if not task["located"]:
        del task["located"]
    _check(task, vocabulary)
    _outdate(task)
    _forget_places(document)


def _prompt(document: PlanDocument, edit: Edit, _vocabulary: Vocabulary) -> None:
    task = _task(document, edit)
    task["task_prompt"] = _prompt_text(edit["text"])
    _outdate(task)


def _remove(document: PlanDocument, edit: Edit, _vocabulary: Vocabulary) -> None:
    document["tasks"].remove(_task(document, edit))
    _forget_places(document)


def _move(document: PlanDocument, edit: Edit, _vocabulary: Vocabulary) -> None:
    task = _task(document, edit)
    document["tasks"].remove(task)
    document["tasks"].insert(_index(edit["to"], len(document["tasks"])), task)


def _insert(document: PlanDocument, edit: Edit, vocabulary: Vocabulary) -> None:
    title = edit["title"]
    if title not in vocabulary.task:
        raise PlannerError(
            f"{_short(title)}: is no task of this vehicle; there is {', '.join(vocabulary.task)}"
        )
    if len(document["tasks"]) >= MOST_TASKS:
        raise PlannerError(
            f"insert {title}: the plan has {MOST_TASKS} tasks, and no more fit; plan two missions"
        )
    given = edit.get("parameters", {})
    if not isinstance(given, dict):
        raise PlannerError("edit insert: parameters must be an object")
    parameters = {
        name: _value(value, _known(vocabulary.task[title], title, name), name)
        for name, value in given.items()
    }
    taken = [
        int(task["id"][1:])
        for task in (*document["tasks"], *document["proposed"]["tasks"])
        if task["id"][1:].isdecimal()
    ]
    inserted = [
        int(record["edit"]["id"][1:]) for record in document["edits"] if "id" in record["edit"]
    ]
    edit["id"] = f"t{max([*taken, *inserted], default=0) + 1}"
    task = {
        "id": edit["id"],
        "title": title,
        "parameters": parameters,
        "task_prompt": _prompt_text(edit.get("task_prompt", "")),
        "skill_sequence": None,
    }
    _check(task, vocabulary)
    document["tasks"].insert(_index(edit["at"], len(document["tasks"])), task)


def _skills(document: PlanDocument, edit: Edit, vocabulary: Vocabulary) -> None:
    task = _task(document, edit)
    found = plan_problems(
        "task", {"skill_sequence": edit["skill_sequence"]}, vocabulary, strict=True
    )
    if found:
        raise PlannerError(f"skills of {task['id']}: {found[0]}")
    task["skill_sequence"] = copy.deepcopy(edit["skill_sequence"])
    for key in ("stale", "assumptions", "problems", "output"):
        task.pop(key, None)
    assumptions = edit.get("assumptions", [])
    if not isinstance(assumptions, list) or not all(isinstance(text, str) for text in assumptions):
        raise PlannerError("edit skills: assumptions must be a list of texts")
    if assumptions:
        task["assumptions"] = assumptions


def _skill(document: PlanDocument, edit: Edit, vocabulary: Vocabulary) -> None:
    task = _task(document, edit)
    steps = task["skill_sequence"] or []
    where = f"{task['id']} step {edit['step'] + 1}"
    if not 0 <= edit["step"] < len(steps):
        raise PlannerError(f"{where}: the task has {len(steps)} steps")
    skills = [skill for role, skill in step_skills(steps[edit["step"]]) if role == edit["role"]]
    if not 0 <= edit["index"] < len(skills):
        raise PlannerError(
            f"{where}: has {len(skills)} {edit['role']} skills, and none of number"
            f" {edit['index'] + 1}"
        )
    skill = skills[edit["index"]]
    parameter = _known(vocabulary.skill[skill["name"]], skill["name"], edit["name"])
    if edit.get("value") is None:
        skill["parameters"].pop(edit["name"], None)
    else:
        skill["parameters"][edit["name"]] = _value(edit["value"], parameter, edit["name"])
    found = plan_problems("task", {"skill_sequence": steps}, vocabulary, strict=True)
    if found:
        raise PlannerError(f"{where}: {found[0]}")


def _replace(document: PlanDocument, edit: Edit, vocabulary: Vocabulary) -> None:
    for task in edit["tasks"]:
        if isinstance(task, dict) and {"id", "title", "parameters", "task_prompt"} <= task.keys():
            _check(task, vocabulary)
        found = jsonschema.exceptions.best_match(_task_validator(vocabulary).iter_errors(task))
        if found is not None:
            raise PlannerError(f"edit replace: {_short(found.message)}")
    if len({task["id"] for task in edit["tasks"]}) < len(edit["tasks"]):
        raise PlannerError("edit replace: two tasks have one id; give every task its own")
    document["tasks"] = copy.deepcopy(edit["tasks"])
    _forget_places(document)


TEXT: tuple[type, str] = (str, "a text")
WHOLE: tuple[type, str] = (int, "a whole number")
TASK: Mapping[str, tuple[type, str]] = {"task": (str, "the id of a task")}
KINDS: dict[
    str, tuple[Mapping[str, tuple[type, str]], Callable[[PlanDocument, Edit, Vocabulary], None]]
] = {
    "locate": ({"name": TEXT, "position": (list, "a position [x, y]")}, _locate),
    "parameter": ({**TASK, "name": TEXT}, _parameter),
    "prompt": ({**TASK, "text": TEXT}, _prompt),
    "remove": (TASK, _remove),
    "move": ({**TASK, "to": WHOLE}, _move),
    "insert": ({"title": TEXT, "at": WHOLE}, _insert),
    "skills": ({**TASK, "skill_sequence": (list, "a list of steps")}, _skills),
    "replace": ({"tasks": (list, "a list of tasks")}, _replace),
    "skill": ({**TASK, "step": WHOLE, "role": TEXT, "index": WHOLE, "name": TEXT}, _skill),
}
"""Per kind of edit the keys that it needs, and what makes it."""
OPTIONAL = {
    "parameter": ("value",),
    "insert": ("parameters", "task_prompt", "id"),
    "skills": ("assumptions",),
    "skill": ("value",),
}
"""Keys that an edit may have besides; the id of an inserted task is always given anew."""


# ---------------------------------------------------------------- parts


def _task(document: PlanDocument, edit: Edit) -> dict[str, Any]:
    for task in document["tasks"]:
        if task["id"] == edit["task"]:
            found: dict[str, Any] = task
            return found
    raise PlannerError(
        f"task {_short(edit['task'])}: is not in the plan; there is"
        f" {', '.join(task['id'] for task in document['tasks']) or 'none'}"
    )


def _known(owner: Task | Skill, title: str, name: str) -> Parameter:
    if name not in owner.by_name:
        raise PlannerError(
            f"{_short(name)}: is no parameter of {title}; there is"
            f" {', '.join(owner.by_name) or 'none'}"
        )
    return owner.by_name[name]


def _value(value: Any, parameter: Parameter, name: str) -> Any:
    problem = value_problem(value, parameter)
    if problem:
        raise PlannerError(
            f"{name}: {_short(problem)}{f' ({parameter.unit})' if parameter.unit else ''}"
        )
    return canonical_value(value)


def _prompt_text(text: Any) -> str:
    if not isinstance(text, str) or len(text) > LONGEST_PROMPT:
        raise PlannerError(f"the task prompt must be a text of at most {LONGEST_PROMPT} characters")
    return text.strip()


def _short(text: str) -> str:
    return text if len(text) <= LONGEST_SHOWN else f"{text[:LONGEST_SHOWN]} ..."


@cache
def _task_validator(vocabulary: Vocabulary) -> Any:
    return jsonschema.Draft202012Validator(task_schema(vocabulary))


def _index(index: int, count: int) -> int:
    if not 0 <= index <= count:
        raise PlannerError(f"place {index + 1}: the plan has places 1 to {count + 1}")
    return index


def _check(task: dict[str, Any], vocabulary: Vocabulary) -> None:
    """Raises PlannerError when a task lacks a parameter that it needs."""
    entry = {
        "title": task["title"],
        "parameters": task["parameters"],
        "task_prompt": task["task_prompt"],
    }
    found = plan_problems(
        "mission", {"tasks": [entry], "assumptions": [], "constraints": []}, vocabulary, strict=True
    )
    if found:
        raise PlannerError(
            f"{task['id']}: {found[0].removeprefix('tasks[0]: ')}; give it, or remove the task"
        )


def _outdate(task: dict[str, Any]) -> None:
    """Mark the skills as planned for something else."""
    if task["skill_sequence"] is not None:
        task["stale"] = True


def _forget_places(document: PlanDocument) -> None:
    """Drop located places that no task is at any more."""
    used = {name for task in document["tasks"] for name in task.get("located", {}).values()}
    document["located"] = {
        name: place for name, place in document["located"].items() if name in used
    }
