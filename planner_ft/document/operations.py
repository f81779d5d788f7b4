"""What each kind of edit does to a plan (KINDS of planner_ft.document.edits).

An operation changes the `Draft` that it is given, whose document is a copy. `task` is the task of
the edit. What it returns is recorded with the edit. All raise PlannerError.
"""

import copy
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any

from planner_ft.document import entered
from planner_ft.document.build import PlanDocument, made_safe, places_of, tasks_at
from planner_ft.document.limits import without_filters
from planner_ft.planning.frame import frame_of
from planner_ft.planning.locations import IN_PROMPT, settle
from planner_ft.planning.result import renamed
from planner_ft.support.errors import PlannerError
from planner_ft.support.geodesy import parse_origin
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary import plans as rules
from planner_ft.vocabulary.limits import beyond_range
from planner_ft.vocabulary.plans import step_skills

Entry = dict[str, Any]  # a task of a plan document, a step or a skill
MOST_TASKS = 1000
NOTHING: Mapping[str, Any] = {}


@dataclass
class Draft:
    """A copy of a plan document, while it is changed."""

    document: PlanDocument
    vocabulary: Vocabulary

    @property
    def tasks(self) -> list[Entry]:
        tasks: list[Entry] = self.document["tasks"]
        return tasks

    def task(self, name: str) -> Entry:
        """The task of an id."""
        tasks = {task["id"]: task for task in self.tasks}
        if name not in tasks:
            known = ", ".join(tasks) or "none"
            raise PlannerError(f"task {entered.short(name)}: is not in the plan; there is {known}")
        return tasks[name]

    def put(self, task: Entry, at: int) -> None:
        """Put a task at a place, which may be behind the last one."""
        if not 0 <= at <= len(self.tasks):
            raise PlannerError(f"place {at + 1}: the plan has places 1 to {len(self.tasks) + 1}")
        self.tasks.insert(at, task)

    def check(self, task: Entry) -> None:
        """Whether a task is valid, such as with every parameter that it needs."""
        if found := rules.task_problems(task, self.vocabulary):
            raise PlannerError(f"{task['id']}: {found[0]}; give it, or remove the task")

    def check_skills(self, steps: Any, where: str) -> None:
        plan = {"skill_sequence": steps}
        if found := rules.plan_problems("task", plan, self.vocabulary, strict=True):
            raise PlannerError(f"{where}: {found[0]}")

    def changed(self, task: Entry | None = None) -> None:
        """Mark skills as planned for something else, and drop places that no task is at."""
        if task and task["skill_sequence"] is not None:
            task["stale"] = True
        used = {name for task in self.tasks for name in task.get("located", {}).values()}
        located = self.document["located"].items()
        self.document["located"] = {name: place for name, place in located if name in used}


def locate(draft: Draft, name: str, position: list[Any]) -> None:
    document, position = draft.document, entered.checked(position, entered.POSITION)
    if position == list(draft.vocabulary.unresolved):
        raise PlannerError(f"{name}: {position} stands for an unknown place; give where it is")
    found = tasks_at(name, draft.tasks, draft.vocabulary)
    if not found:
        waiting = [place.name for place in places_of(draft.tasks, draft.vocabulary)]
        known = ", ".join((*waiting, *document["located"])) or "none"
        raise PlannerError(f"{entered.short(name)}: no such place is open; there is {known}")
    for task, where in found:
        settle(task, name, position, draft.vocabulary)
        task["located"] = {**task.get("located", {}), where: name}
        draft.changed(task)
    document["located"][name] = position


def origin(draft: Draft, place: str) -> None:
    if "origin" in draft.document:
        raise PlannerError("origin: the plan has one, and its positions rest on it; plan anew")
    draft.document["origin"] = asdict(parse_origin(place))
    known = {swap.words: swap.position for swap in frame_of(draft.document).swaps}
    for waiting in places_of(draft.tasks, draft.vocabulary):
        if waiting.name in known:
            locate(draft, waiting.name, list(known[waiting.name]))


def constraint(draft: Draft, at: int, text: Any = None) -> None:
    document, constraints = draft.document, list(draft.document["constraints"])
    if not 0 <= at < len(constraints) + (text is not None):
        raise PlannerError(f"constraint {at + 1}: the plan has {len(constraints)}")
    if text is not None and not entered.prompt_text(text):
        raise PlannerError(f"constraint {at + 1}: the text is empty; leave it out to remove it")
    if text is not None and (number := beyond_range(text)):
        problem = f"{entered.short(number)} is beyond all range"
        raise PlannerError(f"constraint {at + 1}: {problem}; give a smaller number")
    constraints[at : at + 1] = [] if text is None else [entered.prompt_text(text)]
    document["constraints"] = constraints
    document["tasks"] = without_filters(document["tasks"])
    document["tasks"] = made_safe(document, draft.vocabulary)


def insert(
    draft: Draft,
    title: str,
    at: int,
    parameters: Any = NOTHING,
    task_prompt: Any = "",
    id: Any = None,  # of a record that is made anew
) -> Entry:
    owner = entered.titled(title, draft.vocabulary)
    if len(draft.tasks) >= MOST_TASKS:
        problem = f"the plan has {MOST_TASKS} tasks, and no more fit; plan two missions"
        raise PlannerError(f"insert {title}: {problem}")
    if not isinstance(parameters, dict) and parameters is not NOTHING:
        raise PlannerError("edit insert: parameters must be an object")
    own = {"id": _new_id(draft.document)}
    values = {
        name: entered.checked(one, entered.known(owner, title, name))
        for name, one in parameters.items()
    }
    task: Entry = {**own, "title": title, "parameters": values}
    task |= {"task_prompt": entered.prompt_text(task_prompt), "skill_sequence": None}
    draft.check(task)
    draft.put(task, at)
    return own


def move(draft: Draft, task: Entry, to: int) -> None:
    draft.tasks.remove(task)
    draft.put(task, to)


def remove(draft: Draft, task: Entry) -> None:
    draft.tasks.remove(task)
    draft.changed()


def replace(draft: Draft, tasks: list[Any]) -> None:
    """The tasks of a plan that was changed outside of the review."""
    from jsonschema.exceptions import best_match

    for task in tasks:
        if isinstance(task, dict) and {"id", "title", "parameters", "task_prompt"} <= task.keys():
            draft.check(task)
        found = best_match(entered.task_validator(draft.vocabulary).iter_errors(task))
        if found is not None:
            raise PlannerError(f"edit replace: {entered.short(found.message)}")
    if len({task["id"] for task in tasks}) < len(tasks):
        raise PlannerError("edit replace: two tasks have one id; give every task its own")
    draft.document["tasks"] = copy.deepcopy(tasks)
    draft.changed()


def parameter(draft: Draft, task: Entry, name: str, value: Any = None) -> None:
    """A value; None takes it out."""
    before = task["parameters"].get(name)
    known = entered.known(draft.vocabulary.task[task["title"]], task["title"], name)
    entered.put(task["parameters"], known, value)
    if name in task["parameters"]:
        task["task_prompt"] = entered.reword(task["task_prompt"], before, task["parameters"][name])
    located = {key: place for key, place in task.pop("located", {}).items() if key != name}
    if located:
        task["located"] = located
    draft.check(task)
    draft.changed(task)


def title(draft: Draft, task: Entry, title: str) -> None:
    """Another task with what it takes of the parameters."""
    known = entered.titled(title, draft.vocabulary)
    given = renamed(task, title, draft.vocabulary)
    if given is None:
        problem = f"{title} needs more than the parameters of {task['title']}"
        raise PlannerError(f"{task['id']}: {problem}; insert it as a task of its own")
    place = known.position_parameter or ""
    name = next(iter(task.pop("located", {}).values()), None)
    task |= {"title": title, "parameters": given}
    if name is not None and place in given:
        task["located"] = {place: name}
    draft.changed(task)


def prompt(draft: Draft, task: Entry, text: str) -> None:
    task["task_prompt"] = entered.prompt_text(text)
    if IN_PROMPT in task.get("located", {}):
        del task["located"]
    draft.changed(task)


def skills(
    draft: Draft,
    task: Entry,
    skill_sequence: list[Any],
    assumptions: Any = (),
    defaults: Mapping[str, Any] = NOTHING,
    added: Any = None,
    confidence: Mapping[str, Any] = NOTHING,
) -> None:
    """An answer of the Task Agent."""
    draft.check_skills(skill_sequence, f"skills of {task['id']}")
    texts = list(assumptions) if isinstance(assumptions, list | tuple) else [None]
    if not all(isinstance(text, str) for text in texts):
        raise PlannerError("edit skills: assumptions must be a list of texts")
    task["skill_sequence"] = copy.deepcopy(skill_sequence)
    for key in ("stale", "assumptions", "problems", "output", "added"):
        task.pop(key, None)
    if texts:
        task["assumptions"] = texts
    for name, value in defaults.items():
        task["parameters"].setdefault(name, value)
        task["defaults"] = {**task.get("defaults", {}), name: value}
    if added:
        task["added"] = added
    before = {key: one for key, one in task.pop("confidence", {}).items() if key != "skills"}
    if found := {**before, **confidence}:
        task["confidence"] = found
    index = draft.tasks.index(task)
    draft.tasks[index] = made_safe(draft.document, draft.vocabulary)[index]


def skill(
    draft: Draft, task: Entry, step: int, role: str, index: int, name: str, value: Any = None
) -> None:
    """A value of a skill, which is the operator's from then on; None takes it out."""
    steps, where = task["skill_sequence"] or [], f"{task['id']} step {step + 1}"
    if not 0 <= step < len(steps):
        raise PlannerError(f"{where}: the task has {len(steps)} steps")
    own = [one for known, one in step_skills(steps[step]) if known == role]
    if not 0 <= index < len(own):
        count = f"has {len(own)} {role} skills"
        raise PlannerError(f"{where}: {count}, and none of number {index + 1}")
    called = own[index]["name"]
    entered.put(
        own[index]["parameters"], entered.known(draft.vocabulary.skill[called], called, name), value
    )
    draft.check_skills(steps, where)
    marks = task.get("added", [])
    task["added"] = [mark for mark in marks if (mark["step"], mark["name"]) != (step, called)]


def drop(_draft: Draft, task: Entry, name: str, step: Any = None) -> None:
    """A filter or perception skill, of one step or of all."""
    steps = list(enumerate(task["skill_sequence"] or []))
    if step is not None and (not isinstance(step, int) or not 0 <= step < len(steps)):
        raise PlannerError(f"edit drop: step must be one of the task's {len(steps)}, from 0")
    chosen = [one for index, one in steps if step in (None, index)]
    lists = [one[key] for one in chosen for key in ("filter_skills", "perception_skills")]
    if not any(one["name"] == name for found in lists for one in found):
        where = task["id"] if step is None else f"{task['id']} step {step + 1}"
        problem = f"has no filter or perception skill {entered.short(name)}"
        raise PlannerError(f"{where}: {problem}; a navigation skill goes with its step alone")
    for found in lists:
        found[:] = [one for one in found if one["name"] != name]


def _new_id(document: PlanDocument) -> str:
    """An id that no task of the plan, of the proposal or of an edit has or had."""
    names = [task["id"] for task in (*document["tasks"], *document["proposed"]["tasks"])]
    names += [record["edit"]["id"] for record in document["edits"] if "id" in record["edit"]]
    taken = [int(name[1:]) for name in names if name[1:].isdecimal()]
    return f"t{max(taken, default=0) + 1}"
