"""A command or clause for one vehicle: its plan checked, and how each slot of the text is drawn."""

from __future__ import annotations

import functools
import itertools
from collections.abc import Iterable, Mapping
from dataclasses import replace
from random import Random
from typing import TYPE_CHECKING, NamedTuple

from planner_ft.data import targets
from planner_ft.data.numbers import Draw, Value, bearing, knots, pick
from planner_ft.data.targets import HOME, is_formula, operands
from planner_ft.data.templates import grammar
from planner_ft.data.templates.grammar import Argument, Call, Slot, Step, all_slots, base_of, fail
from planner_ft.data.templates.records import Template
from planner_ft.facts.geometry import tidy
from planner_ft.vocabulary import Parameter, Task, Vocabulary
from planner_ft.vocabulary.limits import load_limits

if TYPE_CHECKING:
    from planner_ft.data.missions import MissionSampler

OBJECTS = ("ID", "T", "P")
CLAUSE, IT = "C", "it"
"""Slots for a clause, and for the target that a clause takes up again."""
BESIDES = ("near", "part", "spot")
"""Arguments that are no parameters, unless a task has one of that name."""
SCOPES = ("mission", "task", "way", "home")
SPOKEN_IN_KNOTS, BOXED = 0.5, 0.3
"""Shares of the limits of speed in knots, and of the boxes that two of their corners name."""
_MEASURED = {"distance": "m", "range": "m", "speed": "m/s", "duration": "s"}
_VALUES = tuple(Parameter(name, "number", unit) for name, unit in _MEASURED.items())
_AREA = Parameter("polygon", "polygon", "m")
LIMIT = Task("Limit", "", "", "none", "", parameters=(*_VALUES, _AREA))
"""What the values of limits are drawn for; [task.Limit] in NAME.missions.toml has their ranges."""
Owner = tuple[Task, Parameter]
"""The parameter whose values a slot has."""


class Bound(NamedTuple):
    """A template for one vehicle. An argument of its `tasks` that is no parameter has as its kind
    what it is: "object", "clause", "here", "near", "part" or "spot".

    `limits` are its own ones, `draws` make the values of its slots, `kinds` are the word lists of
    its targets, `places` the position slot of a target or id that has one (`PerformOrbit T1 P1`),
    `corners` give with a position the opposite one that is said before, and the ways from there.
    """

    template: Template
    tasks: list[Step]
    limits: list[Call]
    draws: Mapping[str, Draw]
    kinds: Mapping[str, str]
    places: Mapping[str, str]
    corners: Mapping[str, tuple[str, tuple[tuple[int, int], ...]]]


def slots_of(call: Call) -> set[str]:
    """The slots of the text that a task needs."""
    silent = ("literal", "unused", "here", "spot")
    keys = {str(one.value) for one in call.arguments if one.kind not in silent}
    keys -= set(parts := call.of("part"))
    keys |= {slot.key for part in parts for slot in all_slots(grammar.parse_text(part))}
    return set[str]().union(*map(operands, keys))


@functools.cache
def bind(template: Template, sampler: MissionSampler) -> Bound:
    """A command or a clause for this vehicle. Raises TemplateError."""
    vocabulary, kinds = sampler.vocabulary, {*load_limits(sampler.vocabulary)}
    if template.form:
        kinds |= sampler.config.get("demand", {}).keys() & vocabulary.skill.keys()
    limits = [step.call for step in template.steps if step.call.name in kinds]
    others = (step for step in template.steps if step.call.name not in kinds)
    tasks = [_task(step, template, vocabulary) for step in others]
    asked = _asked(template, limits, vocabulary)
    template.check_labels("plan")
    slots = [slot for slot in all_slots(template.nodes) if slot.sign != "?"]
    draws, winds = dict[str, Draw](), targets.directions(template.plan)
    for slot in (slot for slot in slots if slot.base not in (*OBJECTS, CLAUSE, IT)):
        owner = _owner(slot, tasks, template, asked, sampler)
        draws[slot.key] = _draw(slot.base, owner, sampler, slot.key in winds)
    arguments = itertools.chain(*(step.call.arguments for step in template.steps))
    remarks = itertools.chain(*map(all_slots, itertools.chain(*template.remarks)))
    used = asked.union(*(slots_of(step.call) for step in tasks), (slot.key for slot in remarks))
    used |= {str(one.value) for one in arguments if one.kind == "unused"}
    for key in sorted(used - {slot.key for slot in slots if not slot.sign}):
        fail(f"{key} stands in the plan and not in the text")
    for key in sorted({slot.key for slot in slots} - used):
        fail(f"{{{key}}} belongs to no task, limit or demand; a wrong value is {{~{key}}}")
    surely = grammar.always(template.nodes)
    for key in (key for step in tasks if not step.call.label for key in step.call.of("object")):
        if base_of(key) == "T" and key not in surely:
            fail(f"{{{key}}} is needed, and not every alternative says it")
    lists = {slot.key: slot.kind for slot in slots if slot.kind and slot.base == "T"}
    for name in lists.values():
        if name not in sampler.words:
            fail(f"there is no word list {name} for targets")
    pairs = (itertools.product(step.call.of("object"), repeat=2) for step in tasks)
    places = {key: at for key, at in itertools.chain(*pairs) if base_of(at) == "P" != base_of(key)}
    corners = {two: (one, ways) for one, two, ways in targets.opposite(template.plan)}
    return Bound(template, tasks, limits, draws, lists, places, corners)


def _asked(template: Template, limits: Iterable[Call], vocabulary: Vocabulary) -> set[str]:
    """The slots that limits and demands need; what else the plan names is checked."""
    arguments = list(itertools.chain(*(call.arguments for call in limits)))
    of = (title for one in arguments if one.name == "of" for title in str(one.value).split())
    ruled_out = (title for title in template.excluded if title != HOME)
    for titles, why in ((template.tasks, ""), (ruled_out, " to rule out"), (of, " to limit")):
        for title in titles:
            if title not in vocabulary.task:
                fail(f"there is no task {title}{why}")
    for one in arguments if template.form else ():
        if one.name == "scope" and one.value not in SCOPES:
            fail(f"scope={one.value}: must be {', '.join(SCOPES)}")
    slots = (one for one in arguments if one.kind == "slot" and one.name != "scope")
    return {str(one.value) for one in slots}


def _owner(
    slot: Slot, tasks: Iterable[Step], template: Template, asked: set[str], sampler: MissionSampler
) -> Owner | None:
    """The parameter that a slot fills; outside of the plan it is the first one of that name. None
    for an entry of a word list.
    """
    base, task = slot.base, sampler.vocabulary.task
    for call in (step.call for step in tasks):
        for one in call.arguments:
            if one.value == slot.key and one.kind == "slot":
                return task[call.name], task[call.name].by_name[one.name]
    if base in LIMIT.by_name and (template.form or slot.key in asked):
        return LIMIT, LIMIT.by_name[base]
    if base in sampler.words:
        return None
    every = () if template.form else task.values()
    first = next((one for one in every if base in one.by_name), None)
    limit = ", limit" if template.form else ""
    first = first or fail(f"{{{slot.key}}} is no target, parameter{limit} or word list")
    return first, first.by_name[base]


def _draw(base: str, owner: Owner | None, sampler: MissionSampler, is_wind: bool) -> Draw:
    """How the values of a slot are drawn."""
    if owner is None or owner[1].type in ("text", "texts", "id"):
        return functools.partial(sampler.words.noun, base)
    draw = sampler.draw(*owner)
    if is_wind:
        return lambda rng: bearing(pick(targets.WINDS, rng), rng)
    return functools.partial(_limit, draw, owner[1].name) if owner[0] is LIMIT else draw


def _limit(draw: Draw, name: str, rng: Random) -> Value:
    """A value of a limit, in the ways in which these are said."""
    value = draw(rng)
    if name == "polygon" and value.noun and rng.random() < BOXED:
        return Value(value.value, value.noun)
    return knots(rng) if name == "speed" and rng.random() < SPOKEN_IN_KNOTS else value


def _task(step: Step, template: Template, vocabulary: Vocabulary) -> Step:
    """A task of a command with its arguments told apart."""
    call, task = step.call, vocabulary.task.get(step.call.name)
    if template.form:
        fail(f"{call.name} is no kind of limit and no skill with a [demand]")
    if step.filters or step.each:
        fail(f"{call.name}: a task has no filters and nothing behind waypoints")
    for demand in step.perceptions:
        if demand.name not in vocabulary.skill:
            fail(f"there is no skill {demand.name}")
    if task is None and call.name != HOME:
        fail(f"there is no task {call.name}")
    call = replace(call, arguments=tuple(_argument(one, task) for one in call.arguments))
    if task and task.arrival != "none" and not any(map(call.of, ("object", "here", "spot"))):
        fail(f"{call.name} has no place: T1, P1, or here")
    if call.name == vocabulary.locate and not any(key[0] == "T" for key in call.of("object")):
        fail(f"{call.name} needs a target, T1")
    return replace(step, call=call)


def _argument(argument: Argument, task: Task | None) -> Argument:
    """The argument of a task, or of the return home, with its kind or the parameter's name."""
    name, value = argument.name, str(argument.value)
    base = base_of(value)
    if argument.kind == "unused":
        return argument
    if task is None or (not name and base == CLAUSE):
        return replace(argument, kind="clause")
    if name in BESIDES and name not in task.by_name:
        part = name == "part" and argument.kind != "literal"
        return replace(argument, kind=name, value=f"{{{value}}}" if part else value)
    if not name and (is_formula(value) or base in OBJECTS):
        return replace(argument, kind="object")
    if not name and value == "here":
        return replace(argument, kind="here")
    if (name or base) not in task.by_name:
        names = ", ".join(task.by_name) or "none"
        fail(f"{task.title} has no parameter {name or base} (it has {names})")
    number = argument.value
    number = tidy(number) if isinstance(number, float) else number
    return replace(argument, name=name or base, value=number)
