"""An operator's changes to a plan document, each checked before it takes effect, and undo."""

from __future__ import annotations

import copy
import functools
import json
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict
from datetime import UTC, datetime
from typing import Any
from unicodedata import category

from planner_ft.document.build import (
    PlanDocument,
    altered,
    made_safe,
    places_of,
    revise,
    tasks_at,
    without_derived,
)
from planner_ft.document.limits import without_filters
from planner_ft.planning.doubts import renamed
from planner_ft.planning.frame import frame_of
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import compact_json
from planner_ft.support.geodesy import parse_origin
from planner_ft.vocabulary import Parameter, Skill, Task, Vocabulary
from planner_ft.vocabulary import plans as rules
from planner_ft.vocabulary.document_schema import task_schema
from planner_ft.vocabulary.plans import canonical_value, is_number, step_skills

Edit = dict[str, Any]
"""{"kind": one of KINDS, ...}: what to change."""
LONGEST_PROMPT = 4000
LONGEST_SHOWN = 120
"""Characters of a value that a sentence repeats."""
MOST_TASKS = 1000
POSITION = Parameter("position", "position", "m")


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
        raise PlannerError(f"edit {_short(repr(kind))}: is not known; there is {', '.join(KINDS)}")
    keys, optional, change = KINDS[kind]
    unknown = [key for key in edit if key not in ("kind", *keys, *optional)]
    if unknown:
        raise PlannerError(f"edit {kind}: has no {_short(unknown[0])}; leave it out")
    for key, (types, expected) in keys.items():
        if key not in edit or not isinstance(edit[key], types) or isinstance(edit[key], bool):
            raise PlannerError(f"edit {kind}: {key} must be {expected}")
    tasks, located = copy.deepcopy(document["tasks"]), dict(document["located"])
    edited = {**document, "tasks": tasks, "located": located}
    change(edited, edit, vocabulary)
    return {**edited, "edits": [*document["edits"], {**record, "edit": edit}]}


# ---------------------------------------------------------------- kinds of edits: each changes
# `document`, which is a copy


def _locate(document: PlanDocument, edit: Edit, vocabulary: Vocabulary) -> None:
    name, position = edit["name"], _value(edit["position"], POSITION)
    if position == list(vocabulary.unresolved):
        raise PlannerError(f"{name}: {position} stands for an unknown place; give where it is")
    found = tasks_at(name, document["tasks"], vocabulary)
    if not found:
        waiting = [place.name for place in places_of(document["tasks"], vocabulary)]
        known = ", ".join((*waiting, *document["located"])) or "none"
        raise PlannerError(f"{_short(name)}: no such place is open; there is {known}")
    for task, parameter in found:
        task["parameters"][parameter] = position
        task["located"] = {**task.get("located", {}), parameter: name}
        _outdate(task)
    document["located"][name] = position


def _origin(document: PlanDocument, edit: Edit, vocabulary: Vocabulary) -> None:
    if "origin" in document:
        raise PlannerError("origin: the plan has one, and its positions rest on it; plan anew")
    origin = parse_origin(edit["place"])
    document["origin"] = asdict(origin)
    known = {swap.words: swap.position for swap in frame_of(document).swaps}
    for place in places_of(document["tasks"], vocabulary):
        if place.name in known:
            located = {"name": place.name, "position": list(known[place.name])}
            _locate(document, located, vocabulary)


def _constraint(document: PlanDocument, edit: Edit, vocabulary: Vocabulary) -> None:
    constraints, at, text = list(document["constraints"]), edit["at"], edit.get("text")
    if not 0 <= at < len(constraints) + (text is not None):
        raise PlannerError(f"constraint {at + 1}: the plan has {len(constraints)}")
    if text is not None and not _prompt_text(text):
        raise PlannerError(f"constraint {at + 1}: the text is empty; leave it out to remove it")
    constraints[at : at + 1] = [] if text is None else [_prompt_text(text)]
    document["constraints"] = constraints
    document["tasks"] = without_filters(document["tasks"])
    document["tasks"] = made_safe(document, vocabulary)


def _parameter(document: PlanDocument, edit: Edit, vocabulary: Vocabulary) -> None:
    task, name = _task(document, edit), edit["name"]
    parameter = _known(vocabulary.task[task["title"]], task["title"], name)
    before = task["parameters"].get(name)
    _set(task["parameters"], parameter, edit.get("value"))
    if name in task["parameters"]:
        task["task_prompt"] = reword(task["task_prompt"], before, task["parameters"][name])
    located = {key: place for key, place in task.pop("located", {}).items() if key != name}
    if located:
        task["located"] = located
    _check(task, vocabulary)
    _outdate(task)
    _forget_places(document)


def _title(document: PlanDocument, edit: Edit, vocabulary: Vocabulary) -> None:
    task, title = _task(document, edit), edit["title"]
    if title not in vocabulary.task:
        known = ", ".join(vocabulary.task)
        raise PlannerError(f"{_short(title)}: is no task of this vehicle; there is {known}")
    given = renamed(task, title, vocabulary)
    if given is None:
        problem = f"{title} needs more than the parameters of {task['title']}"
        raise PlannerError(f"{task['id']}: {problem}; insert it as a task of its own")
    place = vocabulary.task[title].position_parameter or ""
    name = next(iter(task.pop("located", {}).values()), None)
    task |= {"title": title, "parameters": given}
    if name is not None and place in given:
        task["located"] = {place: name}
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
    title, given = edit["title"], edit.get("parameters", {})
    if title not in vocabulary.task:
        known = ", ".join(vocabulary.task)
        raise PlannerError(f"{_short(title)}: is no task of this vehicle; there is {known}")
    if len(document["tasks"]) >= MOST_TASKS:
        problem = f"the plan has {MOST_TASKS} tasks, and no more fit; plan two missions"
        raise PlannerError(f"insert {title}: {problem}")
    if not isinstance(given, dict):
        raise PlannerError("edit insert: parameters must be an object")
    edit["id"], owner = _new_id(document), vocabulary.task[title]
    values = {name: _value(value, _known(owner, title, name)) for name, value in given.items()}
    task = {"id": edit["id"], "title": title, "parameters": values}
    task |= {"task_prompt": _prompt_text(edit.get("task_prompt", "")), "skill_sequence": None}
    _check(task, vocabulary)
    document["tasks"].insert(_index(edit["at"], len(document["tasks"])), task)


def _skills(document: PlanDocument, edit: Edit, vocabulary: Vocabulary) -> None:
    task, assumptions = _task(document, edit), edit.get("assumptions", [])
    _check_skills(edit["skill_sequence"], f"skills of {task['id']}", vocabulary)
    if not isinstance(assumptions, list) or not all(isinstance(text, str) for text in assumptions):
        raise PlannerError("edit skills: assumptions must be a list of texts")
    task["skill_sequence"] = copy.deepcopy(edit["skill_sequence"])
    for key in ("stale", "assumptions", "problems", "output", "added"):
        task.pop(key, None)
    if assumptions:
        task["assumptions"] = assumptions
    for name, value in edit.get("defaults", {}).items():
        task["parameters"].setdefault(name, value)
        task["defaults"] = {**task.get("defaults", {}), name: value}
    if edit.get("added"):
        task["added"] = edit["added"]
    before = {key: one for key, one in task.get("confidence", {}).items() if key != "skills"}
    if found := before | edit.get("confidence", {}):
        task["confidence"] = found
    else:
        task.pop("confidence", None)
    index = document["tasks"].index(task)
    document["tasks"][index] = made_safe(document, vocabulary)[index]


def _skill(document: PlanDocument, edit: Edit, vocabulary: Vocabulary) -> None:
    task, number, role = _task(document, edit), edit["step"], edit["role"]
    steps, where = task["skill_sequence"] or [], f"{task['id']} step {number + 1}"
    if not 0 <= number < len(steps):
        raise PlannerError(f"{where}: the task has {len(steps)} steps")
    skills = [skill for known, skill in step_skills(steps[number]) if known == role]
    if not 0 <= (index := edit["index"]) < len(skills):
        count = f"has {len(skills)} {role} skills"
        raise PlannerError(f"{where}: {count}, and none of number {index + 1}")
    skill = skills[index]
    parameter = _known(vocabulary.skill[skill["name"]], skill["name"], edit["name"])
    _set(skill["parameters"], parameter, edit.get("value"))
    _check_skills(steps, where, vocabulary)
    # What an operator changes is the operator's.
    added = task.get("added", [])
    task["added"] = [
        mark for mark in added if (mark["step"], mark["name"]) != (number, skill["name"])
    ]


def _drop(document: PlanDocument, edit: Edit, _vocabulary: Vocabulary) -> None:
    task, name, only = _task(document, edit), edit["name"], edit.get("step")
    steps = list(enumerate(task["skill_sequence"] or []))
    if only is not None and (not isinstance(only, int) or not 0 <= only < len(steps)):
        raise PlannerError(f"edit drop: step must be one of the task's {len(steps)}, from 0")
    chosen = [step for index, step in steps if only in (None, index)]
    lists = [step[key] for step in chosen for key in ("filter_skills", "perception_skills")]
    if not any(skill["name"] == name for skills in lists for skill in skills):
        where = task["id"] if only is None else f"{task['id']} step {only + 1}"
        problem = f"has no filter or perception skill {_short(name)}"
        raise PlannerError(f"{where}: {problem}; a navigation skill goes with its step alone")
    for skills in lists:
        skills[:] = [skill for skill in skills if skill["name"] != name]


def _replace(document: PlanDocument, edit: Edit, vocabulary: Vocabulary) -> None:
    from jsonschema.exceptions import best_match

    for task in edit["tasks"]:
        if isinstance(task, dict) and {"id", "title", "parameters", "task_prompt"} <= task.keys():
            _check(task, vocabulary)
        found = best_match(_task_validator(vocabulary).iter_errors(task))
        if found is not None:
            raise PlannerError(f"edit replace: {_short(found.message)}")
    if len({task["id"] for task in edit["tasks"]}) < len(edit["tasks"]):
        raise PlannerError("edit replace: two tasks have one id; give every task its own")
    document["tasks"] = copy.deepcopy(edit["tasks"])
    _forget_places(document)


Keys = Mapping[str, tuple[type, str]]
TEXT, WHOLE = (str, "a text"), (int, "a whole number")
TASK: Keys = {"task": (str, "the id of a task")}
STEPS, TASKS = (list, "a list of steps"), (list, "a list of tasks")
PLACE = (list, "a position [x, y]")
SKILLS = ("assumptions", "defaults", "added", "confidence")
SKILL: Keys = {**TASK, "step": WHOLE, "role": TEXT, "index": WHOLE, "name": TEXT}
KINDS: dict[str, tuple[Keys, tuple[str, ...], Callable[[PlanDocument, Edit, Vocabulary], None]]] = {
    "locate": ({"name": TEXT, "position": PLACE}, (), _locate),
    "origin": ({"place": TEXT}, (), _origin),
    "constraint": ({"at": WHOLE}, ("text",), _constraint),
    "parameter": ({**TASK, "name": TEXT}, ("value",), _parameter),
    "title": ({**TASK, "title": TEXT}, (), _title),
    "prompt": ({**TASK, "text": TEXT}, (), _prompt),
    "remove": (TASK, (), _remove),
    "move": ({**TASK, "to": WHOLE}, (), _move),
    "insert": ({"title": TEXT, "at": WHOLE}, ("parameters", "task_prompt", "id"), _insert),
    "skills": ({**TASK, "skill_sequence": STEPS}, SKILLS, _skills),
    "replace": ({"tasks": TASKS}, (), _replace),
    "skill": (SKILL, ("value",), _skill),
    "drop": ({**TASK, "name": TEXT}, ("step",), _drop),
}
"""Per kind of edit: keys that it needs, keys that it may have, and the function that makes it."""


# ---------------------------------------------------------------- parts


def reword(prompt: str, before: Any, after: Any) -> str:
    """The prompt with the one mention of the old value replaced, so that it fits the parameters.

    A value that stays behind becomes a warning.
    """
    if is_number(before):
        wanted = rf"(?<![\w.,-]){re.escape(compact_json(before))}(?![\w]|[.,]\d)"
    elif isinstance(before, str):
        wanted = rf"(?<!\w){re.escape(before)}(?!\w)"
    elif isinstance(before, list) and len(before) == 2 and all(map(is_number, before)):
        x, y = (re.escape(compact_json(part)) for part in before)
        wanted = rf"[\[(]\s*{x}\s*,\s*{y}\s*[\])]"
    else:
        return prompt
    found = list(re.finditer(wanted, prompt))
    if len(found) != 1:
        return prompt
    text = after if isinstance(after, str) else json.dumps(after)
    return prompt[: found[0].start()] + text + prompt[found[0].end() :]


def _task(document: PlanDocument, edit: Edit) -> dict[str, Any]:
    tasks: dict[str, dict[str, Any]] = {task["id"]: task for task in document["tasks"]}
    if edit["task"] not in tasks:
        known = ", ".join(tasks) or "none"
        raise PlannerError(f"task {_short(edit['task'])}: is not in the plan; there is {known}")
    return tasks[edit["task"]]


def _new_id(document: PlanDocument) -> str:
    """An id that no task of the plan, of the proposal or of an edit has or had."""
    names = [task["id"] for task in (*document["tasks"], *document["proposed"]["tasks"])]
    names += [record["edit"]["id"] for record in document["edits"] if "id" in record["edit"]]
    taken = [int(name[1:]) for name in names if name[1:].isdecimal()]
    return f"t{max(taken, default=0) + 1}"


def _known(owner: Task | Skill, title: str, name: str) -> Parameter:
    if name not in owner.by_name:
        known = ", ".join(owner.by_name) or "none"
        raise PlannerError(f"{_short(name)}: is no parameter of {title}; there is {known}")
    return owner.by_name[name]


def _set(parameters: dict[str, Any], parameter: Parameter, value: Any) -> None:
    """Set a parameter; None removes it."""
    if value is None:
        parameters.pop(parameter.name, None)
    else:
        parameters[parameter.name] = _value(value, parameter)


def _value(value: Any, parameter: Parameter) -> Any:
    problem = rules.value_problem(value, parameter)
    if problem:
        unit = f" ({parameter.unit})" if parameter.unit else ""
        raise PlannerError(f"{parameter.name}: {_short(problem)}{unit}")
    for one in value if isinstance(value, list) else [value]:
        _visible(one if isinstance(one, str) else "")
    return canonical_value(value)


def _prompt_text(text: Any) -> str:
    if not isinstance(text, str) or len(text) > LONGEST_PROMPT:
        raise PlannerError(f"the task prompt must be a text of at most {LONGEST_PROMPT} characters")
    return _visible(text.strip())


def _visible(text: str) -> str:
    """The text. Raises PlannerError for control characters, which nobody can see and approve."""
    if hidden := [one for one in text if category(one) == "Cc" and one not in "\n\t"]:
        raise PlannerError(f"the text holds the control character {hidden[0]!r}; leave it out")
    return text


def _short(text: str) -> str:
    return text if len(text) <= LONGEST_SHOWN else f"{text[:LONGEST_SHOWN]} ..."


@functools.cache
def _task_validator(vocabulary: Vocabulary) -> Any:
    import jsonschema

    return jsonschema.Draft202012Validator(task_schema(vocabulary))


def _index(index: int, count: int) -> int:
    if not 0 <= index <= count:
        raise PlannerError(f"place {index + 1}: the plan has places 1 to {count + 1}")
    return index


def _check(task: dict[str, Any], vocabulary: Vocabulary) -> None:
    """Raises PlannerError when a task is not valid, such as without a parameter that it needs."""
    found = rules.task_problems(task, vocabulary)
    if found:
        raise PlannerError(f"{task['id']}: {found[0]}; give it, or remove the task")


def _check_skills(steps: Any, where: str, vocabulary: Vocabulary) -> None:
    found = rules.plan_problems("task", {"skill_sequence": steps}, vocabulary, strict=True)
    if found:
        raise PlannerError(f"{where}: {found[0]}")


def _outdate(task: dict[str, Any]) -> None:
    """Mark the skills as planned for something else."""
    if task["skill_sequence"] is not None:
        task["stale"] = True


def _forget_places(document: PlanDocument) -> None:
    """Drop located places that no task is at any more."""
    used = {name for task in document["tasks"] for name in task.get("located", {}).values()}
    located = document["located"].items()
    document["located"] = {name: place for name, place in located if name in used}
