"""Movements: what a prompt asks the vehicle to do, as steps and as words; the parts that their
builders share.

A builder draws one movement for a task; `None` means that it cannot be drawn for this task or
vehicle.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from planner_ft.data.numbers import Value, length, position
from planner_ft.data.task import geometry as g
from planner_ft.data.task.context import Context
from planner_ft.data.task.phrasebook import Call, Saying, Slots
from planner_ft.data.task.values import draw_number, draw_point

Step = tuple[str, dict[str, Any]]


@dataclass
class Movement:
    """Steps that are said together. `saying` is None where the prompt asks for no movement, so that
    the vehicle holds.
    """

    kind: str
    steps: list[Step]
    saying: Saying | None
    filters: list[Call] = field(default_factory=list)
    perceptions: list[Call] = field(default_factory=list)


Builder = Callable[[Context], Movement | None]


def simple(context: Context, name: str) -> Movement:
    """One navigation skill in one step."""
    call = context.call(name)
    return Movement(
        context.book.skills[name].skill.motion or name, [(name, call.parameters)], call.saying
    )


def implied_hold(context: Context) -> Movement | None:
    """The hold of a prompt that asks for no movement."""
    name = context.book.motions.get("hold")
    return Movement("implied", [(name, {})], None) if name else None


def go_to(context: Context, points: list[g.Point]) -> list[Step] | None:
    name = context.book.motions.get("goto")
    return [(name, {"x": x, "y": y}) for x, y in points] if name else None


def in_pattern(
    context: Context, pattern: str, points: list[g.Point], slots: Slots, kind: str | None = None
) -> Movement | None:
    steps = go_to(context, points)
    templates = [
        template
        for template in context.book.pattern(pattern, context.task.title)
        if template.fits(frozenset(slots.given))
    ]
    return (
        Movement(kind or pattern, steps, Saying(templates, slots)) if steps and templates else None
    )


def take(
    context: Context, slots: Slots, pattern: str, name: str, otherwise: Callable[[], Value]
) -> Any:
    """The pattern's value from the task, if it is linked, else a value of its own that only the
    prompt states.
    """
    place = f"{pattern}.{name}"
    if context.linked(place):
        return context.fill(slots, name, place)
    value = otherwise()
    slots.put(name, value)
    return value.value


def any_position(context: Context) -> Callable[[], Value]:
    return lambda: position(draw_point(context.rng), context.rng)


def any_length(context: Context, low: float, high: float) -> Callable[[], Value]:
    return lambda: length(draw_number(context.rng, low, high), context.rng)


def one_phrase(context: Context, pattern: str, key: str, slots: Slots) -> str:
    fitting = [
        template
        for template in context.book.pattern(pattern, context.task.title, key)
        if template.fits(frozenset(slots.given))
    ]
    return (
        fitting[int(context.rng.random() * len(fitting))].render(slots, context.rng)
        if fitting
        else ""
    )


def in_turns(
    context: Context, steps: list[Step], pattern: str, slots: Slots, kind: str
) -> Movement | None:
    templates = [
        template
        for template in context.book.pattern(pattern, context.task.title)
        if template.fits(frozenset(slots.given))
    ]
    return Movement(kind, steps, Saying(templates, slots)) if templates else None
