"""A command template for one vehicle: its tasks checked, and what each slot of the text fills."""

from __future__ import annotations

import itertools
from dataclasses import dataclass
from typing import Any

from planner_ft.data.templates.grammar import (
    Argument,
    Call,
    Nodes,
    Slot,
    Step,
    TemplateError,
    all_slots,
    always,
    base_of,
    parse_text,
)
from planner_ft.data.templates.records import Template
from planner_ft.data.wordlists import WordLists
from planner_ft.vocabulary import Parameter, Task, Vocabulary

OBJECTS = ("ID", "T", "P")
CLAUSE, IT = "C", "it"
"""Slots for a clause, and for the target that a clause takes up again."""
HOME = "Home"


@dataclass(frozen=True)
class Fill:
    """A parameter of a task and what fills it: a slot of the text or a literal value."""

    parameter: Parameter
    slot: str = ""
    value: Any = None


@dataclass(frozen=True)
class Line:
    """A task of a template; `task` is None for the return home."""

    task: Task | None
    label: str
    objects: tuple[str, ...] = ()
    fills: tuple[Fill, ...] = ()
    here: bool = False
    near: str = ""
    part: Nodes = ()
    clauses: tuple[str, ...] = ()
    demands: tuple[Call, ...] = ()

    def slots(self) -> set[str]:
        """The slots of the text that the task needs."""
        parts = {slot.key for slot in all_slots(self.part)}
        filled = (fill.slot for fill in self.fills)
        return {self.near, *self.objects, *filled, *parts, *self.clauses} - {""}


@dataclass(frozen=True)
class Bound:
    """A template for one vehicle: its tasks, the parameter whose values a slot has, the kinds of
    its targets, and the position slot of a target or id that has one (`PerformOrbit T1 P1`).
    """

    lines: tuple[Line, ...]
    owners: dict[str, tuple[Task, Parameter]]
    kinds: dict[str, str]
    places: dict[str, str]


def bind(template: Template, vocabulary: Vocabulary, lists: WordLists) -> Bound:
    """A command for this vehicle; with its word lists. Raises TemplateError."""
    every = list(all_slots(template.nodes))
    slots = {slot.key for slot in every if slot.sign != "?"}
    lines = tuple(_line(step, vocabulary, slots) for step in template.steps)
    for title in template.excluded:
        if title != HOME and title not in vocabulary.task:
            raise TemplateError(f"there is no task {title} to rule out")
    surely = always(template.nodes)
    for line in lines:
        for key in line.objects if not line.label else ():
            if base_of(key) == "T" and key not in surely:
                raise TemplateError(f"{{{key}}} is needed, and not every alternative says it")
    owners = {
        fill.slot: (line.task, fill.parameter)
        for line in reversed(lines)
        for fill in reversed(line.fills)
        if line.task
    }
    for slot in every:
        known = slot.base in (*OBJECTS, CLAUSE) or slot.key in owners or slot.base in lists
        if not known and slot.sign != "?":
            owners[slot.key] = _owner(slot, vocabulary)
    unused = {
        str(argument.value)
        for step in template.steps
        for argument in step.call.arguments
        if argument.kind == "unused"
    }
    places = {
        key: place
        for line in lines
        for place in line.objects
        if base_of(place) == "P"
        for key in line.objects
        if base_of(key) != "P"
    }
    used = unused.union(*(line.slots() for line in lines))
    return bound(template, lists, used, owners, lines, places)


def bound(
    template: Template,
    lists: WordLists,
    used: set[str],
    owners: dict[str, tuple[Task, Parameter]],
    lines: tuple[Line, ...] = (),
    places: dict[str, str] | None = None,
) -> Bound:
    """A command or a clause whose plan needs the `used` slots, as far as text and plan agree.
    Raises TemplateError.
    """
    every = list(all_slots(template.nodes))
    slots = [slot for slot in every if slot.sign != "?"]
    asked = {call.label for step in template.steps for call in step.calls() if call.label}
    for name in asked ^ {slot.key for slot in every if slot.sign == "?"}:
        raise TemplateError(f"the label ?{name} stands only in the text or only in the plan")
    used |= {slot.key for nodes in itertools.chain(*template.remarks) for slot in all_slots(nodes)}
    for key in sorted(used - {slot.key for slot in slots if not slot.sign}):
        raise TemplateError(f"{key} stands in the plan and not in the text")
    for key in sorted({slot.key for slot in slots} - used):
        raise TemplateError(
            f"{{{key}}} belongs to no task, limit or demand; a wrong value is {{~{key}}}"
        )
    kinds = {slot.key: slot.kind for slot in slots if slot.kind and slot.base == "T"}
    for kind in kinds.values():
        if kind not in lists:
            raise TemplateError(f"there is no word list {kind} for targets")
    for slot in slots:
        if not (slot.base in (*OBJECTS, CLAUSE, IT) or slot.key in owners or slot.base in lists):
            raise TemplateError(f"{{{slot.key}}} is no target, parameter, limit or word list")
    return Bound(lines, owners, kinds, places or {})


def _line(step: Step, vocabulary: Vocabulary, keys: set[str]) -> Line:
    call = step.call
    if step.filters or step.each:
        raise TemplateError(f"{call.name}: a task has no filters and nothing behind waypoints")
    for demand in step.perceptions:
        if demand.name not in vocabulary.skill:
            raise TemplateError(f"there is no skill {demand.name}")
    if call.name == HOME:
        clauses = [str(argument.value) for argument in call.arguments]
        return Line(None, call.label, clauses=tuple(clauses), demands=step.perceptions)
    task = vocabulary.task.get(call.name)
    if task is None:
        raise TemplateError(f"there is no task {call.name}")
    objects: list[str] = []
    clauses = []
    fills: list[Fill] = []
    here, near = False, ""
    part: Nodes = ()
    for argument in call.arguments:
        value = str(argument.value)
        if argument.kind == "unused":
            continue
        if argument.name == "near":
            near = value
        elif argument.name == "part":
            part = parse_text(value if argument.kind == "literal" else f"{{{value}}}")
        elif value == "here" and not argument.name:
            here = True
        elif not argument.name and base_of(value) in OBJECTS:
            objects.append(value)
        elif not argument.name and base_of(value) == CLAUSE:
            clauses.append(value)
        else:
            fills.append(_fill(task, argument, keys))
    if task.arrival != "none" and not objects and not here:
        raise TemplateError(f"{call.name} has no place: T1, P1, or here")
    if task.title == vocabulary.locate and not any(key[0] == "T" for key in objects):
        raise TemplateError(f"{call.name} needs a target, T1")
    return Line(
        task,
        call.label,
        tuple(objects),
        tuple(fills),
        here,
        near,
        part,
        tuple(clauses),
        step.perceptions,
    )


def _fill(task: Task, argument: Argument, keys: set[str]) -> Fill:
    name, value = argument.name or base_of(str(argument.value)), argument.value
    if name not in task.by_name:
        names = ", ".join(task.by_name) or "none"
        raise TemplateError(f"{task.title} has no parameter {name} (it has {names})")
    if argument.kind == "literal":
        whole = isinstance(value, float) and value.is_integer()
        return Fill(task.by_name[name], value=int(value) if whole else value)
    if str(value) not in keys:
        raise TemplateError(f"{value} stands in the plan and not in the text")
    return Fill(task.by_name[name], slot=str(value))


def _owner(slot: Slot, vocabulary: Vocabulary) -> tuple[Task, Parameter]:
    """What a value outside the plan is drawn for: the first parameter of that name."""
    for task in vocabulary.tasks:
        if slot.base in task.by_name:
            return task, task.by_name[slot.base]
    raise TemplateError(f"{{{slot.key}}} is no target, parameter or word list")
