"""A prompt template for one task of a vehicle: names checked, and how each slot is drawn."""

from __future__ import annotations

import functools
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace
from random import Random
from typing import Any

from planner_ft.data.numbers import Draw, Value, angle
from planner_ft.data.task.phrasebook import Phrasebook
from planner_ft.data.task.steps import SHAPES, XY, value_draw
from planner_ft.data.templates import grammar
from planner_ft.data.templates.grammar import Argument, Call, Step, TemplateError, all_slots, fail
from planner_ft.data.templates.records import Template
from planner_ft.vocabulary.definition import Role, Task, Vocabulary

WORDS = ("start", "turn", "axis")
"""Roles that a word of the plan fills: `turn=clockwise`."""
JOINT = {"Grid": ("width", "length", "spacing", "count"), "Line": ("spacing",)}
"""Roles of a shape that are drawn as a whole, so that they fill each other."""
SIDES = {"left": -1, "right": 1}
"""Options of a slot for a turn, with its sign."""


@dataclass
class Bound:
    """A template that can be drawn for one task. Every argument of its steps has a name."""

    template: Template
    nodes: grammar.Nodes = ()
    steps: list[Step] = field(default_factory=list)
    everywhere: Step | None = None
    front: bool = False
    """What runs everywhere is mentioned before what the steps have of their own."""
    draws: dict[str, Draw] = field(default_factory=dict)
    """How the value of a slot is drawn."""
    places: dict[str, str] = field(default_factory=dict)
    """What a slot fills ("StationKeep.time"): a task parameter that fills it, too, has its value."""
    params: set[str] = field(default_factory=set)
    located: set[str] = field(default_factory=set)
    """Task parameters whose position is calculated with, so that it must be known."""
    often: dict[str, float] = field(default_factory=dict)
    """Slots of optional parts, and how often they are given."""
    clause: bool = False
    """Whether this is in the words of the phrase file."""


def titles(template: Template, vocabulary: Vocabulary) -> Sequence[str]:
    """The tasks that the template names; every task for "*"."""
    return list(vocabulary.task) if "*" in template.tasks else template.tasks


@functools.cache
def binding(template: Template, title: str, book: Phrasebook) -> Bound | None:
    """The template for this task; None where it names no task ("*") and this one lacks what it
    needs. Raises PlannerError where a task that it names does not fit.
    """
    try:
        task = book.vocabulary.task.get(title) or fail(f"there is no task {title}")
        return bind(template, task, book)
    except TemplateError as error:
        if "*" in template.tasks:
            return None
        raise template.error(error) from None


def bind(template: Template, task: Task, book: Phrasebook) -> Bound:
    """The template for this task. Raises TemplateError that says what does not fit."""
    binder = _Binder(Bound(template, template.nodes), task, book)
    bound, slots = binder.bound, list(all_slots(template.nodes))
    for slot in slots:
        if slot.sign == "param":
            binder.parameter(slot.key)
    for step in template.steps:
        if step.call.name != "ALL":
            bound.steps.append(binder.step(step))
        elif bound.everywhere is None:
            bound.everywhere, bound.front = binder.beside(step), not bound.steps
    if unused := binder.keys - bound.draws.keys():
        fail(
            f"{{{min(unused)}}} stands in the text and in no step; for words that are no value of"
            " the plan write {_list}"
        )
    template.check_labels("steps")
    if not bound.steps:
        fail("there is no step")
    for key in (slot.key for slot in slots if slot.sign == "~"):
        if key not in bound.draws:
            fail(f"{{~{key}}} is another value of {{{key}}}, which is missing")
    return bound


class _Binder:
    def __init__(self, bound: Bound, task: Task, book: Phrasebook) -> None:
        self.bound, self.book, self.task = bound, book, task
        slots = [slot for slot in all_slots(bound.template.nodes) if not slot.sign]
        self.keys = {slot.key for slot in slots}
        self.sides = {slot.key: side for slot in slots for side in SIDES.keys() & slot.options}

    def step(self, step: Step) -> Step:
        call = step.call
        bound = self._shape(call) if call.name in SHAPES else self._skill(call, "navigation")
        each = self.step(step.each) if step.each else None
        return replace(self.beside(step), call=bound, each=each)

    def beside(self, step: Step) -> Step:
        """The step with its filters and perception skills bound."""
        filters = tuple(self._skill(call, "filter") for call in step.filters)
        perceptions = tuple(self._skill(call, "perception") for call in step.perceptions)
        return replace(step, filters=filters, perceptions=perceptions)

    def parameter(self, name: str) -> bool:
        """Note that the text or the plan refers to a task parameter; whether it is a position."""
        if name not in self.task.by_name:
            fail(f"{self.task.title} has no parameter {name}{_among(self.task.by_name)}")
        self.bound.params.add(name)
        return self.task.by_name[name].type == "position"

    def _name(self, argument: Argument, place: str) -> str:
        """The parameter or role that an argument fills; `place` is the one for a position."""
        base = grammar.base_of(str(argument.value))
        known = argument.kind == "param" and self.parameter(str(argument.value))
        return argument.name or (place if place and (known or base == "P") else base)

    def _use(self, key: str, draw: Draw, place: str) -> None:
        if key not in self.keys:
            fail(f"{{{key}}} stands in a step and not in the text")
        if side := self.sides.get(key):
            draw, place = functools.partial(_turn, draw, SIDES[side]), ""
        self.bound.draws.setdefault(key, draw)
        self.bound.places.setdefault(key, place)

    def _skill(self, call: Call, role: Role) -> Call:
        skill = self.book.vocabulary.skill.get(call.name) or fail(f"there is no skill {call.name}")
        if skill.role != role:
            how = "as a step" if skill.role == "navigation" else "with + or &"
            fail(f"{call.name} is a {skill.role} skill: write it {how}")
        place = XY if skill.motion == "goto" else ""
        arguments: list[Argument] = []
        for argument in call.arguments:
            name = self._name(argument, place)
            if name not in skill.by_name and name != (place or None):
                fail(f"{call.name} has no parameter {name}{_among(skill.by_name)}")
            if argument.kind == "slot":
                own = name != XY
                draws = self.book.skills[call.name].draws
                draw = draws[name] if own else self.book.place
                several = own and skill.by_name[name].type == "texts"
                self._use(str(argument.value), draw, "" if several else f"{call.name}.{name}")
            arguments.append(replace(argument, name=name))
        given = {argument.name for argument in arguments}
        if place and XY not in given and not {"x", "y"} <= given:
            fail(f"{call.name} needs a position: P1 or param.NAME")
        return replace(call, arguments=tuple(arguments))

    def _shape(self, call: Call) -> Call:
        shape = SHAPES[call.name]
        if shape.motion not in self.book.motions:
            fail(f"the vehicle has no skill for {call.name}")
        arguments: list[Argument] = []
        for argument in call.arguments:
            role, value = self._name(argument, "point"), str(argument.value)
            if role not in shape.roles and role not in shape.options:
                fail(f"{call.name} has no use for {role}")
            if argument.kind == "slot" and role in WORDS and value not in self.keys:
                argument = replace(argument, kind="literal")
            elif argument.kind == "slot":
                joint = role in JOINT.get(call.name, ())
                draw: Draw = _no_draw if joint else self.book.place
                if not joint and role != "point":
                    draw = value_draw(call.name, role, grammar.base_of(value))
                self._use(value, draw, shape.roles.get(role, ""))
            arguments.append(replace(argument, name=role))
        given = {argument.name for argument in arguments}
        for role, place in shape.roles.items():
            if role not in given and not (role == "spacing" and "count" in given):
                arguments.append(Argument("param", self._own(call, role, place), role))
        points = (one for one in arguments if (one.name, one.kind) == ("point", "param"))
        self.bound.located |= {str(one.value) for one in points}
        return replace(call, arguments=tuple(arguments))

    def _own(self, call: Call, role: str, place: str) -> str:
        """The task parameter for what the plan does not give."""
        name = self.book.tasks[self.task.title].links.get(place)
        if name is None and role == "point":
            name = self.task.position_parameter
        if name is None and role in self.task.by_name:
            name = role
        title = self.task.title
        name = name or fail(f"{call.name} needs a {role}, and {title} has no parameter for it")
        self.parameter(name)
        return name


def _turn(draw: Draw, sign: int, rng: Random) -> Value:
    """An angle to one side, said without the side."""
    said = angle(abs(draw(rng).value), rng)
    return Value(sign * said.value, said.text, said.short)


def _no_draw(_rng: Any) -> Value:
    return fail("sizes that fill each other are drawn as a whole")


def _among(names: Iterable[str]) -> str:
    return f" (it has {', '.join(names) or 'none'})"
