"""Movements that turn: headings in turn, sectors, repeated and opposite rotations, a circle once
round.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from planner_ft.data.numbers import COMPASS, Value, bearing, count_text, digits, duration, rotation
from planner_ft.data.task import geometry as g
from planner_ft.data.task.context import Context
from planner_ft.data.task.movements import Movement, Step, in_turns, one_phrase, take
from planner_ft.data.task.phrasebook import Saying
from planner_ft.data.task.template import Template
from planner_ft.data.task.values import draw_bearing, draw_duration, draw_rotation


def headings(context: Context) -> Movement | None:
    """Two to six stated headings in turn."""
    rng, slots = context.rng, context.slots()
    name = context.book.motions.get("turn_to")
    if not name:
        return None
    key = context.book.skills[name].skill.parameters[0].name
    count = rng.choice((2, 3, 4, 4, 5, 6))
    degrees = [draw_bearing(rng) for _ in range(count)]
    if rng.random() < 0.5:
        degrees = g.sector_headings(count, rng.choice((0, 0, 45, 90)), clockwise=rng.random() < 0.8)
    words = all(value % 45 == 0 for value in degrees) and rng.random() < 0.6
    said = [
        (
            COMPASS[int(value)]
            if words
            else f"{int(value):03d}"
            if count % 2 and isinstance(value, int)
            else digits(value)
        )
        for value in degrees
    ]
    listed = (
        ", then ".join(said)
        if rng.random() < 0.25
        else ", ".join(said[:-1]) + rng.choice((" and ", " and then ")) + said[-1]
    )
    slots.put("headings", Value(None, listed))
    return in_turns(
        context, [(name, {key: value}) for value in degrees], "headings", slots, "headings"
    )


def sectors(context: Context) -> Movement | None:
    """Evenly spaced headings, with a hold at each where a pause is stated."""
    rng, slots = context.rng, context.slots()
    turn, hold = context.book.motions.get("turn_to"), context.book.motions.get("hold")
    if not turn or not hold:
        return None
    key = context.book.skills[turn].skill.parameters[0].name
    count = rng.choice((3, 4, 4, 5, 6, 8, 8, 9, 10, 12))
    if parameter := context.linked("sectors.sectors"):
        context.values[parameter] = Value(count, count_text(count, rng))
        context.fill(slots, "sectors", "sectors.sectors", refer=False)
    else:
        slots.put("sectors", Value(count, count_text(count, rng)))
    first = rng.choice((0, 0, 0, 90, 180, 270, 45))
    slots.put("first", bearing(first, rng))
    steps: list[Step] = []
    pause, words = _pause(context)
    for value in g.sector_headings(count, first):
        steps.append((turn, {key: value}))
        if pause is not None:
            steps.append((hold, {"time": pause}))
    movement = in_turns(context, steps, "sectors", slots, "sectors")
    if movement and movement.saying and words:
        movement.saying = Saying(
            [_followed(template, words) for template in movement.saying.templates],
            movement.saying.slots,
        )
    return movement


def _pause(context: Context) -> tuple[float | None, str]:
    hold = context.book.motions["hold"]
    if context.rng.random() < 0.55 or "time" not in context.book.skills[hold].skill.by_name:
        return None, ""
    slots = context.slots()
    if not context.book.pattern("sectors", context.task.title, "pause"):
        return None, ""
    pause = take(
        context,
        slots,
        "sectors",
        "wait",
        lambda: duration(draw_duration(context.rng, 2, 60), context.rng),
    )
    return pause, one_phrase(context, "sectors", "pause", slots)


def _followed(template: Template, words: str) -> Template:
    return replace(template, nodes=(*template.nodes, ("text", words)))


def turn_steps(context: Context) -> Movement | None:
    """The same small rotation several times."""
    rng, slots = context.rng, context.slots()
    name = context.book.motions.get("turn_by")
    if not name:
        return None
    key = context.book.skills[name].skill.parameters[0].name
    count = rng.choice((2, 3, 3, 4, 4, 5, 6, 8))
    value = draw_rotation(rng, 90)
    slots.put("count", Value(count, count_text(count, rng)))
    slots.put("delta", rotation(value, rng))
    return in_turns(context, [(name, {key: value})] * count, "steps", slots, "steps")


def swing(context: Context) -> Movement | None:
    """To one side and then to the other."""
    rng, slots = context.rng, context.slots()
    name = context.book.motions.get("turn_by")
    if not name:
        return None
    key = context.book.skills[name].skill.parameters[0].name
    first = draw_rotation(rng, 90)
    second = (
        -first
        if rng.random() < 0.4
        else -2 * first
        if rng.random() < 0.5
        else draw_rotation(rng, 90)
    )
    slots.put("first", rotation(first, rng))
    slots.put("second", rotation(second, rng))
    return in_turns(context, [(name, {key: first}), (name, {key: second})], "swing", slots, "swing")


def full_turn(context: Context) -> Movement | None:
    """A full turn in equal steps."""
    rng, slots = context.rng, context.slots()
    name = context.book.motions.get("turn_by")
    if not name:
        return None
    key = context.book.skills[name].skill.parameters[0].name
    count = rng.choice((3, 4, 4, 5, 6, 6, 8, 8, 9, 10, 12))
    sign = 1
    slots.put("count", Value(count, count_text(count, rng)))
    if rng.random() < 0.4:
        sign = rng.choice((1, -1))
        slots.put_words(
            "turn", "clockwise" if sign > 0 else rng.choice(("counter-clockwise", "anticlockwise"))
        )
    return in_turns(
        context, [(name, {key: sign * 360 // count})] * count, "full_turn", slots, "full_turn"
    )


def once_round(context: Context) -> Movement | None:
    """A whole circle, "once round"."""
    rng, slots = context.rng, context.slots()
    name = context.book.motions.get("arc")
    if not name or not {"radius", "delta_yaw"} <= set(context.book.skills[name].skill.by_name):
        return None
    if (parameter := context.linked(f"{name}.delta_yaw")) and context.values[
        parameter
    ].value != 360:
        return None
    sign = 1
    if rng.random() < 0.5:
        sign = rng.choice((1, -1))
        slots.put_words(
            "turn", "clockwise" if sign > 0 else rng.choice(("counter-clockwise", "anticlockwise"))
        )
    parameters: dict[str, Any] = {"delta_yaw": sign * 360}
    if context.linked(f"{name}.radius") or rng.random() < 0.7:
        place = f"{name}.radius"
        if context.linked(place):
            parameters["radius"] = context.fill(slots, "radius", place)
        else:
            value = context.book.skills[name].draws["radius"](rng)
            slots.put("radius", value)
            parameters["radius"] = value.value
    if parameter:
        context.used.add(parameter)
    return in_turns(context, [(name, parameters)], "once", slots, "arc")
