"""A parsed line for one task of a vehicle: names checked, each argument assigned to a parameter or
to a part of a shape.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from planner_ft.data.task.phrasebook import Phrasebook
from planner_ft.data.task.prompts.shapes import (
    COMPASS_WORDS,
    JOINT,
    SHAPES,
    TURNS,
    role_of,
    value_draw,
    word_role,
)
from planner_ft.data.task.values import Draw
from planner_ft.data.templates.grammar import Argument, TemplateError, all_slots, base_of
from planner_ft.data.templates.grammar import Call as CallText
from planner_ft.data.templates.grammar import Step as StepText
from planner_ft.data.templates.records import Template
from planner_ft.vocabulary.definition import Parameter, Role, Skill, Task

XY = "xy"


@dataclass(frozen=True)
class Fill:
    """One parameter of a skill, or part of a shape, and where its value comes from: a slot, a task
    parameter, or the line itself.
    """

    target: str
    kind: str
    value: Any
    negative: bool = False


@dataclass(frozen=True)
class Call:
    """A skill or shape with what fills it."""

    name: str
    fills: tuple[Fill, ...]
    flag: str = ""
    at: str = ""
    shape: bool = False


@dataclass(frozen=True)
class Step:
    """A step or shape with what runs in it."""

    movement: Call
    filters: tuple[Call, ...]
    perceptions: tuple[Call, ...]
    each: Step | None = None


@dataclass(frozen=True)
class Source:
    """How a slot's value is drawn, and the places that a task parameter fills."""

    draw: Draw
    place: str
    type: str
    position: bool = False


@dataclass
class Bound:
    """A line that can be drawn for one task."""

    line: Template
    task: Task
    steps: tuple[Step, ...] = ()
    everywhere: Step | None = None
    front: bool = False
    """What runs everywhere is mentioned before what the steps have of their own."""
    sources: dict[str, Source] = field(default_factory=dict)
    signs: dict[str, int] = field(default_factory=dict)
    params: set[str] = field(default_factory=set)
    located: set[str] = field(default_factory=set)
    """Task parameters whose position is calculated with, so that it must be known."""


def bind(line: Template, task: Task, book: Phrasebook) -> Bound:
    """The line for this task. Raises TemplateError that says what does not fit."""
    bound = Bound(line, task)
    _Binder(bound, book).run()
    return bound


class _Binder:
    def __init__(self, bound: Bound, book: Phrasebook) -> None:
        self.bound, self.book, self.task = bound, book, bound.task
        self.slots = [slot for slot in all_slots(bound.line.nodes) if slot.sign in ("", "param")]
        self.keys = {slot.key for slot in self.slots if not slot.sign}
        self.links = book.tasks[self.task.title].links

    def run(self) -> None:
        line, bound = self.bound.line, self.bound
        for slot in self.slots:
            if slot.sign:
                self._param(slot.key)
            elif slot.options & {"left", "right"}:
                bound.signs[slot.key] = -1 if "left" in slot.options else 1
        everywhere = [step for step in line.steps if step.call.name == "ALL"]
        bound.steps = tuple(self._step(step) for step in line.steps if step not in everywhere)
        bound.front = bool(everywhere) and line.steps[0] in everywhere
        for step in everywhere[:1]:
            bound.everywhere = Step(Call("ALL", ()), *self._beside(step))
        unused = self.keys - set(bound.sources)
        if unused:
            raise TemplateError(
                f"{{{min(unused)}}} stands in the text and in no step; for words that are no value"
                " of the plan write {_list}"
            )
        asked = {call.label for step in line.steps for call in step.calls() if call.label}
        labels = {slot.key for slot in all_slots(line.nodes) if slot.sign == "?"}
        for name in asked ^ labels:
            raise TemplateError(f"the label ?{name} stands only in the text or only in the steps")
        if not bound.steps:
            raise TemplateError("there is no step")

    def _step(self, step: StepText) -> Step:
        name = step.call.name
        movement = (
            self._shape(step.call) if name in SHAPES else self._skill(step.call, "navigation")
        )
        return Step(movement, *self._beside(step), self._step(step.each) if step.each else None)

    def _beside(self, step: StepText) -> tuple[tuple[Call, ...], tuple[Call, ...]]:
        return tuple(self._skill(call, "filter") for call in step.filters), tuple(
            self._skill(call, "perception") for call in step.perceptions
        )

    def _param(self, name: str) -> Parameter:
        if name not in self.task.by_name:
            raise TemplateError(
                f"{self.task.title} has no parameter {name}{_among(self.task.by_name)}"
            )
        self.bound.params.add(name)
        return self.task.by_name[name]

    # ------------------------------------------------------------ skills

    def _skill(self, call: CallText, role: Role) -> Call:
        skill = self.book.vocabulary.skill.get(call.name)
        if skill is None:
            raise TemplateError(f"there is no skill {call.name}")
        if skill.role != role:
            raise TemplateError(
                f"{call.name} is a {skill.role} skill: write it"
                f" {'as a step' if skill.role == 'navigation' else 'with + or &'} "
            )
        fills: list[Fill] = []
        for argument in call.arguments:
            target = self._target(skill, argument, {fill.target for fill in fills})
            if target:
                fills.append(
                    self._fill(argument, target, self._skill_source(skill, target, argument))
                )
        if (
            skill.motion == "goto"
            and XY not in {fill.target for fill in fills}
            and not {"x", "y"} <= {fill.target for fill in fills}
        ):
            raise TemplateError(f"{call.name} needs a position: P1 or param.NAME")
        return Call(call.name, tuple(fills), call.label, call.at)

    def _target(self, skill: Skill, argument: Argument, taken: set[str]) -> str | None:
        if argument.name:
            return self._known(skill, argument.name)
        if argument.kind == "slot" and not _is_word(argument):
            base = base_of(str(argument.value))
            return XY if skill.motion == "goto" and base == "P" else self._known(skill, base)
        if argument.kind == "param":
            return self._param_target(skill, self._param(str(argument.value)))
        free = [parameter.name for parameter in skill.parameters if parameter.name not in taken]
        if argument.value in COMPASS_WORDS:
            return next((name for name in free if name in ("heading", "yaw", "bearing")), None)
        if _is_word(argument):
            return None
        if not free:
            raise TemplateError(f"{skill.name}: {argument.value} is one value too many")
        return free[0]

    def _known(self, skill: Skill, name: str) -> str:
        if name not in skill.by_name and not (name == XY and skill.motion == "goto"):
            raise TemplateError(f"{skill.name} has no parameter {name}{_among(skill.by_name)}")
        return name

    def _param_target(self, skill: Skill, parameter: Parameter) -> str:
        if parameter.type == "position" and skill.motion == "goto":
            return XY
        linked = [
            other.name
            for other in skill.parameters
            if self.links.get(f"{skill.name}.{other.name}") == parameter.name
        ]
        same = [other.name for other in skill.parameters if other.name == parameter.name]
        unit = [
            other.name
            for other in skill.parameters
            if other.unit == parameter.unit and parameter.unit and other.type == parameter.type
        ]
        texts = [
            other.name
            for other in skill.parameters
            if other.type in ("id", "text", "texts") and parameter.type in ("id", "text", "texts")
        ]
        for names in (same, linked, unit, texts):
            if names:
                return names[0]
        raise TemplateError(
            f"{skill.name} has no parameter that {parameter.name} of {self.task.title} could fill;"
            f" write NAME=param.{parameter.name}"
        )

    def _skill_source(self, skill: Skill, target: str, argument: Argument) -> Source:
        if target == XY:
            return Source(
                value_draw("Offset", "point", "P"), f"{skill.name}.xy", "position", position=True
            )
        del argument
        return Source(
            self.book.skills[skill.name].draws[target],
            f"{skill.name}.{target}",
            skill.by_name[target].type,
        )

    def _fill(self, argument: Argument, target: str, source: Source) -> Fill:
        value: Any = argument.value
        if argument.kind == "slot" and not _is_word(argument):
            self._use(value, source)
        elif argument.kind == "param":
            self._param(value)
        elif _is_word(argument):
            value = COMPASS_WORDS.get(value, TURNS.get(value, value))
        return Fill(
            target, "literal" if _is_word(argument) else argument.kind, value, argument.negative
        )

    def _use(self, key: str, source: Source) -> None:
        if key not in self.keys:
            raise TemplateError(f"{{{key}}} stands in a step and not in the text")
        self.bound.sources.setdefault(key, source)

    # ------------------------------------------------------------ shapes

    def _shape(self, call: CallText) -> Call:
        shape = SHAPES[call.name]
        if shape.motion not in self.book.motions:
            raise TemplateError(f"the vehicle has no skill for {call.name}")
        fills: dict[str, Fill] = {}
        for argument in call.arguments:
            role = self._role(call.name, argument)
            if role:
                fills[role] = self._shape_fill(call.name, role, argument)
        for role, place in shape.roles.items():
            if role in fills or (role == "spacing" and "count" in fills):
                continue
            name = self.links.get(place) or (
                self.task.position_parameter
                if role == "point"
                else role
                if role in self.task.by_name
                else None
            )
            if not name:
                raise TemplateError(
                    f"{call.name} needs a {role}, and {self.task.title} has no parameter for it"
                )
            self._param(name)
            fills[role] = Fill(role, "param", name)
        self.bound.located |= {
            str(fill.value)
            for fill in fills.values()
            if fill.kind == "param" and fill.target == "point"
        }
        return Call(call.name, tuple(fills.values()), call.label, call.at, shape=True)

    def _role(self, shape: str, argument: Argument) -> str | None:
        if argument.name:
            role = role_of(shape, argument.name)
        elif argument.kind == "literal":
            role = "count"
        elif _is_word(argument):
            role = word_role(shape, str(argument.value))
            if role is None:
                return None
        else:
            base = base_of(str(argument.value))
            role = role_of(shape, base)
            if role is None and argument.kind == "param" and self._param(base).type == "position":
                role = "point"
        if role is None:
            raise TemplateError(f"{shape} has no use for {argument.name or argument.value}")
        return role

    def _shape_fill(self, shape: str, role: str, argument: Argument) -> Fill:
        value: Any = argument.value
        if argument.kind == "slot" and argument.name and value not in self.keys:
            return Fill(role, "literal", value)
        if _is_word(argument):
            value = (
                TURNS[value]
                if value in TURNS
                else COMPASS_WORDS[value]
                if role == "heading"
                else value
            )
            return Fill(role, "literal", value)
        place = SHAPES[shape].roles.get(role, "")
        kind = "position" if role == "point" else "number"
        return self._fill(
            argument,
            role,
            Source(
                (
                    _no_draw
                    if (shape, role) in JOINT
                    else value_draw(shape, role, base_of(str(value)))
                ),
                place,
                kind,
                position=role == "point",
            ),
        )


def _no_draw(_rng: Any) -> Any:
    raise TemplateError("the size of a Grid is drawn as a whole")


def _is_word(argument: Argument) -> bool:
    """Whether the argument is a direction of its own: "north", "clockwise"."""
    return argument.kind == "slot" and (argument.value in COMPASS_WORDS or argument.value in TURNS)


def _among(names: Any) -> str:
    return f" ({', '.join(names)})" if names else " (it has none)"
