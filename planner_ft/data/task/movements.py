"""Movements of several steps, in the phrases of [pattern.NAME], with their exact geometry.

A builder draws one movement for a task; None means that it cannot be drawn for this task or
vehicle.
"""

from __future__ import annotations

from random import Random
from typing import Any

from planner_ft.data.numbers import (
    COMPASS,
    Value,
    bearing,
    count_text,
    digits,
    duration,
    length,
    pick,
    position,
    rotation,
)
from planner_ft.data.task.context import Builder, Context, Movement
from planner_ft.data.task.phrasebook import Slots
from planner_ft.data.task.steps import Step
from planner_ft.data.task.values import (
    Draw,
    draw_bearing,
    draw_duration,
    draw_number,
    draw_point,
    draw_position,
    draw_rotation,
)
from planner_ft.data.wordlists import joined
from planner_ft.facts import geometry as g

COUNTERCLOCKWISE = ("counter-clockwise", "anticlockwise")
SPACINGS = (2, 2.5, 3, 4, 5, 5, 6, 7, 7.5, 8, 10, 10, 12, 15, 20)


def _length(low: float, high: float) -> Draw:
    return lambda rng: length(draw_number(rng, low, high), rng)


def _clockwise(c: Context, slots: Slots) -> bool:
    """A direction of turning, in the slot "turn"."""
    clockwise = c.rng.random() < 0.5
    slots["turn"] = "clockwise" if clockwise else pick(COUNTERCLOCKWISE, c.rng)
    return clockwise


def _count(c: Context, slots: Slots, slot: str, *numbers: int) -> int:
    count = int(pick(numbers, c.rng))
    slots.put(slot, Value(count, count_text(count, c.rng)))
    return count


def _how(c: Context, slots: Slots, pattern: str, said: Slots) -> bool:
    """Put the pattern's words for what is `said` into the slot "how"; whether there are any."""
    found = c.phrases(pattern, said, "how") if said else []
    slots["how"] = pick(found, c.rng).render(said, c.rng) if found else ""
    return bool(found)


def waypoints(c: Context) -> Movement | None:
    """Two to six stated places, one after the other."""
    rng, slots = c.rng, c.slots()
    points = [draw_point(rng) for _ in range(2 + int(rng.random() ** 1.6 * 5))]
    places = [position(point, rng).short or "" for point in points]
    joint = pick((" and ", ", ", " and then ", ", and then "), rng)
    slots.put("points", Value(None, joined(places, joint)))
    return c.movement("waypoints", c.goto(points), slots)


def square(c: Context) -> Movement | None:
    """The survey square."""
    slots, said, start = c.slots(), c.slots(), pick(g.SQUARE_STARTS, c.rng)
    if c.rng.random() < 0.3:
        said["corner" if "-" in start else "side"] = start
    start = start if _how(c, slots, "square", said) else "east"
    center = c.take(slots, "center", "square.center", draw_position)
    half = c.take(slots, "radius", "square.radius", _length(3, 40))
    return c.movement("square", c.goto(g.survey_square(center, half, start)), slots)


def lawnmower(c: Context) -> Movement | None:
    """The lawnmower grid; its size replaces the task's, so that lanes fill it exactly."""
    rng, slots, said = c.rng, c.slots(), c.slots()
    spacing = pick(SPACINGS, rng)
    width = g.tidy(spacing * pick((1, 1, 2, 2, 2, 3, 3, 4, 5, 6, 7), rng))
    along = g.tidy(spacing * rng.randrange(1, 9))
    corner: g.Corner = pick(g.CORNERS, rng)
    axis: g.Axis = pick(("x", "y"), rng)
    if rng.random() < 0.25:
        said["corner"], said["_step"] = corner, "west" if "east" in corner else "east"
    if rng.random() < 0.25:
        said["axis"] = pick((axis, f"the {axis} axis"), rng)
    _how(c, slots, "lawnmower", said)
    corner = corner if slots["how"] and "corner" in said else "south-west"
    axis = axis if slots["how"] and "axis" in said else "y"
    center = c.take(slots, "center", "lawnmower.center", draw_position)
    for name, size in {"width": width, "length": along, "spacing": spacing}.items():
        place = f"lawnmower.{name}"
        parameter = c.entry.links.get(place)
        if parameter and (rng.random() < 0.85 or parameter in c.values):
            c.values[parameter] = length(size, rng)
        if c.linked(place):
            c.fill(slots, name, place)
        else:
            slots.put(name, length(size, rng))
    steps = c.goto(g.lawnmower(center, width, along, spacing, corner, axis))
    return c.movement("lawnmower", steps, slots)


def circle(c: Context) -> Movement | None:
    """A circle of waypoints, with number, start and direction stated."""
    slots, start = c.slots(), pick((0, 90, 180, 270), c.rng)
    slots["start"] = COMPASS[start]
    count, clockwise = _count(c, slots, "count", 4, 8, 6, 12, 4, 8), _clockwise(c, slots)
    center = c.take(slots, "center", "orbit.center", draw_position)
    radius = c.take(slots, "radius", "orbit.radius", _length(4, 60))
    points = g.circle(center, radius, count, start, clockwise=clockwise)
    return c.movement("orbit", c.goto(points), slots)


def line(c: Context) -> Movement | None:
    """A straight run of stated start, heading and length."""
    slots = c.slots()
    start = c.take(slots, "start", "line.start", draw_position)
    heading = c.take(slots, "heading", "line.heading", lambda rng: bearing(draw_bearing(rng), rng))
    distance = c.take(slots, "length", "line.length", _length(10, 400))
    return c.movement("line", c.goto(g.straight_line(start, heading, distance)), slots)


def stated_pass(c: Context) -> Movement | None:
    """A straight run between two stated places, mostly along an axis."""
    rng, slots, first, last = c.rng, c.slots(), draw_point(c.rng), draw_point(c.rng)
    if rng.random() < 0.7:
        last = g.offset(first, pick((0, 90, 180, 270), rng), draw_number(rng, 10, 150))
    slots.put("first", position(first, rng))
    slots.put("last", position(last, rng))
    return c.movement("pass", c.goto([first, last]), slots)


def home(c: Context) -> Movement | None:
    """Back to where the vehicle started."""
    return c.movement("home", c.goto([c.book.vocabulary.home]), c.slots())


def _turns(c: Context, motion: str, values: list[Any]) -> list[Step]:
    """A step for each heading or angle; none for a vehicle that cannot turn so."""
    name = c.book.motions.get(motion, "")
    key = c.book.skills[name].skill.parameters[0].name if name else ""
    return [(name, {key: value}) for value in values if name]


def headings(c: Context) -> Movement | None:
    """Two to six stated headings in turn."""
    rng, slots = c.rng, c.slots()
    degrees = [draw_bearing(rng) for _ in range(pick((2, 3, 4, 4, 5, 6), rng))]
    stated = [digits(value) for value in degrees]
    if all(value in COMPASS for value in degrees):
        stated = [COMPASS[int(value)] for value in degrees]
    slots.put("headings", Value(None, joined(stated, pick((" and ", " and then "), rng))))
    return c.movement("headings", _turns(c, "turn_to", degrees), slots)


def _pause(rng: Random) -> Value:
    return duration(draw_duration(rng, 2, 60), rng)


def sectors(c: Context) -> Movement | None:
    """Evenly spaced headings, with a hold at each where a pause is stated."""
    rng, slots, pauses = c.rng, c.slots(), c.slots()
    count = _count(c, slots, "sectors", 3, 4, 4, 5, 6, 8, 8, 9, 10, 12)
    if parameter := c.linked("sectors.sectors"):
        c.values[parameter] = Value(count, count_text(count, rng))
        slots.put("sectors", c.values[parameter])
        c.used.add(parameter)
    first = slots.put("first", bearing(pick((0, 0, 0, 90, 180, 270, 45), rng), rng))
    steps = _turns(c, "turn_to", g.sector_headings(count, first))
    hold, words = c.book.motions.get("hold"), ""
    if hold and "time" in c.book.skills[hold].skill.by_name and rng.random() < 0.45:
        pause = c.take(pauses, "wait", "sectors.wait", _pause)
        if found := c.phrases("sectors", pauses, "pause"):
            words = pick(found, rng).render(pauses, rng)
            steps = [step for turn in steps for step in (turn, (hold, {"time": pause}))]
    movement = c.movement("sectors", steps, slots)
    if movement and movement.saying:
        movement.saying.suffix = words
    return movement


def turn_steps(c: Context) -> Movement | None:
    """The same small rotation several times."""
    slots = c.slots()
    count = _count(c, slots, "count", 2, 3, 3, 4, 4, 5, 6, 8)
    value = slots.put("delta", rotation(draw_rotation(c.rng, 90), c.rng))
    return c.movement("steps", _turns(c, "turn_by", [value] * count), slots)


PATTERNS: dict[str, tuple[tuple[float, Builder], ...]] = {
    "goto": ((0.15, waypoints), (0.05, home)),
    "square": ((0.85, square), (0.1, waypoints)),
    "lawnmower": ((0.85, lawnmower), (0.1, waypoints)),
    "orbit": ((0.35, circle), (0.1, waypoints)),
    "pass": ((0.5, stated_pass), (0.35, line)),
    "line": ((0.75, line), (0.1, stated_pass)),
    "sectors": ((0.45, sectors), (0.25, headings), (0.1, turn_steps)),
    "sweep": ((0.15, headings), (0.15, turn_steps)),
    "follow": ((0.05, waypoints),),
}
"""How often a task of the pattern is drawn as each movement; else a skill that fits the task."""
EXTRA: tuple[Builder, ...] = (
    *(waypoints, square, line, stated_pass, headings, turn_steps, circle, lawnmower),
)


def main_movement(c: Context) -> Movement:
    """The movement of the task's pattern, or a navigation skill that fits the task."""
    roll = c.rng.random()
    for share, builder in PATTERNS.get(c.task.pattern, ()):
        if roll < share and (movement := builder(c)):
            return movement
        roll -= share
    names = c.task.skills["navigation"]
    return c.simple(names[int(c.rng.random() ** 1.8 * len(names))])
