"""A command template for one vehicle: its tasks checked, and what each slot of the text fills."""

import functools
import itertools
from collections.abc import Mapping
from typing import Any, NamedTuple

from planner_ft.data.formulas import HOME, is_formula, operands
from planner_ft.data.templates import grammar
from planner_ft.data.templates.grammar import Call, Nodes, TemplateError, all_slots, base_of
from planner_ft.data.templates.records import Template
from planner_ft.data.values import WordLists
from planner_ft.vocabulary import Parameter, Task, Vocabulary
from planner_ft.vocabulary.limits import load_limits

OBJECTS = ("ID", "T", "P")
CLAUSE, IT = "C", "it"
"""Slots for a clause, and for the target that a clause takes up again."""
_MEASURED = {"distance": "m", "range": "m", "speed": "m/s", "duration": "s"}
_VALUES = tuple(Parameter(name, "number", unit) for name, unit in _MEASURED.items())
_AREA = Parameter("polygon", "polygon", "m")
LIMIT = Task("Limit", "", "", "none", "", parameters=(*_VALUES, _AREA))
"""What the values of limits are drawn for; [task.Limit] in NAME.missions.toml has their ranges."""
Owners = dict[str, tuple[Task, Parameter]]
"""The parameter whose values a slot has."""


class Fill(NamedTuple):
    """A parameter of a task and what fills it: a slot of the text or a literal value."""

    parameter: Parameter
    slot: str = ""
    value: Any = None


class Line(NamedTuple):
    """A task of a template; `task` is None for the return home."""

    task: Task | None
    label: str
    demands: tuple[Call, ...]
    clauses: list[str]
    objects: list[str]
    fills: list[Fill]
    here: bool = False
    near: str = ""
    part: Nodes = ()
    spot: str = ""

    def slots(self) -> set[str]:
        """The slots of the text that the task needs."""
        parts = (slot.key for slot in all_slots(self.part))
        filled = (fill.slot for fill in self.fills)
        named = {self.near, *self.objects, *filled, *parts, *self.clauses} - {""}
        return set[str]().union(*map(operands, named))


class Bound(NamedTuple):
    """A template for one vehicle: its tasks, the owners of its values, the kinds of its targets,
    the position slot of a target or id that has one (`PerformOrbit T1 P1`), and its own limits.
    """

    template: Template
    lines: list[Line]
    owners: Owners
    kinds: dict[str, str]
    places: Mapping[str, str]
    limits: tuple[Call, ...] = ()


@functools.cache
def bind(template: Template, vocabulary: Vocabulary, lists: WordLists) -> Bound:
    """A command for this vehicle; with its word lists. Raises TemplateError."""
    every = [slot for slot in all_slots(template.nodes) if slot.sign != "?"]
    slots, surely = {slot.key for slot in every}, grammar.always(template.nodes)
    kinds = load_limits(vocabulary)
    limits = tuple(step.call for step in template.steps if step.call.name in kinds)
    steps = [step for step in template.steps if step.call.name not in kinds]
    lines = [_line(step, vocabulary, slots) for step in steps]
    for title in template.excluded:
        if title != HOME and title not in vocabulary.task:
            raise TemplateError(f"there is no task {title} to rule out")
    for key in (key for line in lines if not line.label for key in line.objects):
        if base_of(key) == "T" and key not in surely:
            raise TemplateError(f"{{{key}}} is needed, and not every alternative says it")
    of = (str(one.value) for call in limits for one in call.arguments if one.name == "of")
    for title in itertools.chain(*map(str.split, of)):
        if title not in vocabulary.task:
            raise TemplateError(f"there is no task {title} to limit")
    owners: Owners = {}
    for task, fills in ((line.task, line.fills) for line in lines if line.task):
        owners = {fill.slot: (task, fill.parameter) for fill in reversed(fills)} | owners
    asked = {str(one.value) for call in limits for one in call.arguments if one.kind == "slot"}
    for key in asked - owners.keys():
        if base_of(key) in LIMIT.by_name:
            owners[key] = LIMIT, LIMIT.by_name[base_of(key)]
    for slot in every:
        if not (slot.base in (*OBJECTS, CLAUSE) or slot.key in owners or slot.base in lists):
            # Outside of the plan a value is one of the first parameter of that name.
            first = next((task for task in vocabulary.tasks if slot.base in task.by_name), None)
            if first is None:
                raise TemplateError(f"{{{slot.key}}} is no target, parameter or word list")
            owners[slot.key] = first, first.by_name[slot.base]
    arguments = itertools.chain(*(step.call.arguments for step in template.steps))
    unused = {str(argument.value) for argument in arguments if argument.kind == "unused"}
    used = unused.union(asked, *(line.slots() for line in lines))
    return bound(template, lists, used, owners, lines)._replace(limits=limits)


def bound(
    template: Template, lists: WordLists, used: set[str], owners: Owners, lines: list[Line]
) -> Bound:
    """A command or clause whose plan needs the `used` slots. Raises TemplateError."""
    template.check_labels("plan")
    slots = [slot for slot in all_slots(template.nodes) if slot.sign != "?"]
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
    pairs = itertools.chain(*(itertools.product(line.objects, repeat=2) for line in lines))
    places = {key: at for at, key in pairs if base_of(at) == "P" != base_of(key)}
    return Bound(template, lines, owners, kinds, places)


def _line(step: grammar.Step, vocabulary: Vocabulary, keys: set[str]) -> Line:
    call, task = step.call, vocabulary.task.get(step.call.name)
    if step.filters or step.each:
        raise TemplateError(f"{call.name}: a task has no filters and nothing behind waypoints")
    for demand in step.perceptions:
        if demand.name not in vocabulary.skill:
            raise TemplateError(f"there is no skill {demand.name}")
    line = Line(task, call.label, step.perceptions, [], [], [])
    if call.name == HOME:
        return line._replace(clauses=[str(argument.value) for argument in call.arguments])
    if task is None:
        raise TemplateError(f"there is no task {call.name}")
    for argument in call.arguments:
        name, value, base = argument.name, str(argument.value), base_of(str(argument.value))
        if argument.kind == "unused":
            continue
        own = name in task.by_name
        if name == "near" and not own:
            line = line._replace(near=value)
        elif name == "part" and not own:
            text = value if argument.kind == "literal" else f"{{{value}}}"
            line = line._replace(part=grammar.parse_text(text))
        elif name == "spot" and not own:
            line = line._replace(spot=value)
        elif not name and is_formula(value):
            line.objects.append(value)
        elif not name and value == "here":
            line = line._replace(here=True)
        elif not name and base in (*OBJECTS, CLAUSE):
            (line.clauses if base == CLAUSE else line.objects).append(value)
        else:
            line.fills.append(_fill(task, argument, keys))
    if task.arrival != "none" and not (line.objects or line.here or line.spot):
        raise TemplateError(f"{call.name} has no place: T1, P1, or here")
    if task.title == vocabulary.locate and not any(key[0] == "T" for key in line.objects):
        raise TemplateError(f"{call.name} needs a target, T1")
    return line


def _fill(task: Task, argument: grammar.Argument, keys: set[str]) -> Fill:
    value = argument.value
    name = argument.name or base_of(str(value))
    if name not in task.by_name:
        names = ", ".join(task.by_name) or "none"
        raise TemplateError(f"{task.title} has no parameter {name} (it has {names})")
    if argument.kind == "literal":
        whole = isinstance(value, float) and value.is_integer()
        return Fill(task.by_name[name], value=int(value) if whole else value)
    if not operands(str(value)) <= keys:
        raise TemplateError(f"{value} stands in the plan and not in the text")
    return Fill(task.by_name[name], str(value))
