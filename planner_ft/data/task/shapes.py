"""Movements over waypoints: stated places, survey square, lawnmower, circle, line, pass, with their
exact geometry.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from planner_ft.data.numbers import COMPASS, Value, bearing, count_text, duration, length, position
from planner_ft.data.task import geometry as g
from planner_ft.data.task.context import Context
from planner_ft.data.task.movements import (
    Movement,
    any_length,
    any_position,
    go_to,
    in_pattern,
    one_phrase,
    take,
)
from planner_ft.data.task.phrasebook import Saying
from planner_ft.data.task.template import Template
from planner_ft.data.task.values import draw_bearing, draw_duration, draw_number, draw_point


def waypoints(context: Context) -> Movement | None:
    """Two to six stated places, one after the other."""
    rng, slots = context.rng, context.slots()
    points = [draw_point(rng) for _ in range(2 + int(rng.random() ** 1.6 * 5))]
    if rng.random() < 0.1 and len(points) < 4:
        slots.put(
            "points", Value(None, ", then ".join(position(point, rng).text for point in points))
        )
        return in_pattern(context, "waypoints", points, slots)
    said = [position(point, rng).short or "" for point in points]
    joint = rng.choice((" and ", ", ", " and then ", ", and then "))
    if rng.random() < 0.7 or len(points) > 3:
        slots.put("points", Value(None, ", ".join(said[:-1]) + joint + said[-1]))
    else:
        slots.put("first", Value(None, said[0]))
        slots.put("rest", Value(None, " and then to ".join(said[1:])))
    return in_pattern(context, "waypoints", points, slots)


def square(context: Context) -> Movement | None:
    """The survey square."""
    rng, slots = context.rng, context.slots()
    start, clockwise, how = _square_how(context)
    planned = {"target_position", "radius"} <= set(context.values) and rng.random() < 0.25
    if planned and (templates := _planned(context)):
        center, half = _use(context, "square.center"), _use(context, "square.radius")
        slots.put_words("how", how)
        steps = go_to(context, g.survey_square(center, half, start, clockwise=clockwise))
        return Movement("square", steps, Saying(templates, slots)) if steps else None
    center = take(context, slots, "square", "center", any_position(context))
    half = take(context, slots, "square", "radius", any_length(context, 3, 40))
    slots.put_words("how", how)
    return in_pattern(
        context, "square", g.survey_square(center, half, start, clockwise=clockwise), slots
    )


def _planned(context: Context) -> list[Template]:
    return context.book.pattern("planned", context.task.title)


def _use(context: Context, place: str) -> Any:
    name = context.entry.links[place]
    context.used.add(name)
    return context.values[name].value


def _square_how(context: Context) -> tuple[str, bool, str]:
    rng = context.rng
    start, clockwise, how = "east", False, ""
    slots = context.slots()
    if rng.random() < 0.3:
        start = g.SQUARE_STARTS[int(rng.random() * 8)]
        slots.put_words("corner" if "-" in start else "side", start)
        how = one_phrase(context, "square", "how", slots)
        start = start if how else "east"
    if rng.random() < 0.25:
        clockwise = rng.random() < 0.7
        way = "clockwise" if clockwise else rng.choice(("counter-clockwise", "anticlockwise"))
        how = (
            f"{how}{rng.choice((' and going ', ', ', ' and then '))}{way}"
            if how
            else rng.choice((f", {way}", f" {way}", f", going {way}"))
        )
    return start, clockwise, how


def _grid_size(context: Context) -> tuple[float, float, float]:
    """Width, length and a spacing that divides both, mostly few lanes across the width."""
    rng = context.rng
    spacing = rng.choice((2, 2.5, 3, 4, 5, 5, 6, 7, 7.5, 8, 10, 10, 12, 15, 20))
    width = g.tidy(spacing * rng.choice((1, 1, 2, 2, 2, 3, 3, 4, 5, 6, 7)))
    along = g.tidy(spacing * rng.randrange(1, 9))
    if rng.random() < 0.3:
        along = g.tidy(along + rng.choice((1, 2, 3, 5, 10)))
    return width, along, spacing


def lawnmower(context: Context) -> Movement | None:
    """The lawnmower grid; its size replaces the task's, so that lanes fill it exactly."""
    rng, slots = context.rng, context.slots()
    width, along, spacing = _grid_size(context)
    corner, axis, how = _grid_how(context, along, spacing)
    sizes = {"width": width, "length": along, "spacing": spacing}
    for name, size in sizes.items():
        if (parameter := context.entry.links.get(f"lawnmower.{name}")) and (
            rng.random() < 0.85 or parameter in context.values
        ):
            context.values[parameter] = length(size, rng)
    whole = all(context.linked(f"lawnmower.{name}") for name in ("center", *sizes))
    if whole and rng.random() < 0.25 and (templates := _planned(context)):
        center = _use(context, "lawnmower.center")
        for name in sizes:
            _use(context, f"lawnmower.{name}")
        slots.put_words("how", how)
        steps = go_to(context, g.lawnmower(center, width, along, spacing, corner, axis))
        return Movement("lawnmower", steps, Saying(templates, slots)) if steps else None
    center = take(context, slots, "lawnmower", "center", any_position(context))
    if (
        not context.linked("lawnmower.spacing")
        and rng.random() < 0.5
        and context.book.pattern("lawnmower", context.task.title)
    ):
        lanes = g.lane_count(width, spacing) if axis == "y" else g.lane_count(along, spacing)
        slots.put("lanes", Value(lanes, count_text(lanes or 0, rng)))
        sizes.pop("spacing")
    for name, size in sizes.items():
        take(context, slots, "lawnmower", name, lambda size=size: length(size, rng))  # type: ignore[misc]
    slots.put_words("how", how)
    return in_pattern(
        context, "lawnmower", g.lawnmower(center, width, along, spacing, corner, axis), slots
    )


def _grid_how(context: Context, along: float, spacing: float) -> tuple[g.Corner, g.Axis, str]:
    rng, slots = context.rng, context.slots()
    corner: g.Corner = "south-west"
    axis: g.Axis = "y"
    if rng.random() < 0.25:
        corner = g.CORNERS[int(rng.random() * 4)]
        slots.put_words("corner", corner)
        slots["_step"] = "west" if "east" in corner else "east"
    if rng.random() < 0.25:
        axis = "x" if g.lane_count(along, spacing) and rng.random() < 0.8 else "y"
        slots.put_words("axis", rng.choice((axis, f"the {axis} axis")))
        slots.put_words("compass", "east-west" if axis == "x" else "north-south")
    wanted = {name for name in ("corner", "axis") if name in slots}
    templates = [
        template
        for template in context.book.pattern("lawnmower", context.task.title, "how")
        if template.needed <= slots.given
        and {"axis" if name == "compass" else name for name in template.needed} == wanted
    ]
    if not wanted or not templates:
        return "south-west", "y", ""
    return corner, axis, templates[int(rng.random() * len(templates))].render(slots, rng)


def circle(context: Context) -> Movement | None:
    """A circle of waypoints, with number, start and direction stated."""
    rng, slots = context.rng, context.slots()
    count = rng.choice((4, 8, 6, 12, 4, 8))
    start = rng.choice((0, 90, 180, 270))
    clockwise = rng.random() < 0.5
    center = take(context, slots, "orbit", "center", any_position(context))
    radius = take(context, slots, "orbit", "radius", any_length(context, 4, 60))
    slots.put("count", Value(count, count_text(count, rng)))
    slots.put_words("start", COMPASS[start])
    slots.put_words(
        "turn", "clockwise" if clockwise else rng.choice(("counter-clockwise", "anticlockwise"))
    )
    return in_pattern(
        context, "orbit", g.circle(center, radius, count, start, clockwise=clockwise), slots
    )


def line(context: Context) -> Movement | None:
    """A straight run of stated start, heading and length."""
    rng, slots = context.rng, context.slots()
    planned = all(context.linked(f"line.{name}") for name in ("start", "heading", "length"))
    if planned and rng.random() < 0.3 and (templates := _planned(context)):
        start, heading, distance = (
            _use(context, f"line.{name}") for name in ("start", "heading", "length")
        )
        steps = go_to(context, g.straight_line(start, heading, distance))
        return Movement("line", steps, Saying(templates, slots)) if steps else None
    start = take(context, slots, "line", "start", any_position(context))
    heading = take(context, slots, "line", "heading", lambda: bearing(draw_bearing(rng), rng))
    distance = take(context, slots, "line", "length", any_length(context, 10, 400))
    return in_pattern(context, "line", g.straight_line(start, heading, distance), slots)


def stated_pass(context: Context) -> Movement | None:
    """A straight run between two stated places, mostly along an axis."""
    rng, slots = context.rng, context.slots()
    first = draw_point(rng)
    run = draw_number(rng, 10, 150)
    last = (
        g.offset(first, rng.choice((0, 90, 180, 270)), run)
        if rng.random() < 0.7
        else draw_point(rng)
    )
    slots.put("first", position(first, rng))
    slots.put("last", position(last, rng))
    return in_pattern(context, "pass", [first, last], slots)


def beside(context: Context) -> Movement | None:
    """To a point some way north, east, south or west of a place."""
    rng, slots = context.rng, context.slots()
    heading = 90 * rng.randrange(4)
    goto = context.book.motions.get("goto")
    x, y = context.point(slots, f"{goto}.xy")
    away = length(draw_number(rng, 5, 100), rng)
    slots.put("away", away)
    slots.put_words("side", COMPASS[heading])
    return in_pattern(context, "beside", [g.offset((x, y), heading, away.value)], slots, "goto")


def home(context: Context) -> Movement | None:
    """Back to where the vehicle started."""
    x, y = context.book.vocabulary.home
    return in_pattern(context, "home", [(x, y)], context.slots(), "goto")


def go_back(context: Context) -> Movement | None:
    """Back to the task's place, when the prompt has been there."""
    place = context.task.position_parameter
    if place not in context.used or place is None or context.unresolved(context.values[place]):
        return None
    slots = context.slots()
    slots.put_words("place", context.refer(place))
    x, y = context.values[place].value
    return in_pattern(context, "go_back", [(x, y)], slots, "goto")


def with_stops(context: Context, movement: Movement) -> Movement:
    """The movement with a hold of stated time at each of its points."""
    name = context.book.motions.get("hold")
    templates = context.book.pattern("stops", context.task.title)
    if (
        not name
        or "time" not in context.book.skills[name].skill.by_name
        or not movement.saying
        or not templates
    ):
        return movement
    slots = context.slots()
    value = duration(draw_duration(context.rng, 3, 120), context.rng)
    slots.put("pause", value)
    movement.saying.suffix = templates[int(context.rng.random() * len(templates))].render(
        slots, context.rng
    )
    steps = [step for point in movement.steps for step in (point, (name, {"time": value.value}))]
    return replace(movement, steps=steps, kind=f"{movement.kind}_stops")
