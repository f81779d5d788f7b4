"""Movements of several steps with their exact geometry, and which of them a task's pattern stands
for.

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
from planner_ft.data.task.phrasebook import Saying, Slots
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

STOPS = 0.07
"""Share of waypoint movements with a hold at each point."""
PLANNED = 0.28
"""Share of shapes known from the task's parameters that are only named ("the planned grid")."""
COUNTERCLOCKWISE = ("counter-clockwise", "anticlockwise")
SPACINGS = (2, 2.5, 3, 4, 5, 5, 6, 7, 7.5, 8, 10, 10, 12, 15, 20)


def _length(low: float, high: float) -> Draw:
    return lambda rng: length(draw_number(rng, low, high), rng)


def _clockwise(c: Context, slots: Slots, share: float) -> bool:
    """A direction of turning, said in the slot "turn"."""
    clockwise = c.rng.random() < share
    slots.put_words("turn", "clockwise" if clockwise else pick(COUNTERCLOCKWISE, c.rng))
    return clockwise


def _count(c: Context, slots: Slots, slot: str, *numbers: int) -> int:
    count = int(pick(numbers, c.rng))
    slots.put(slot, Value(count, count_text(count, c.rng)))
    return count


def _planned(c: Context, shape: str, names: tuple[str, ...], slots: Slots) -> Saying | None:
    """Words for a shape whose values all stand in the task's parameters."""
    found = c.book.pattern("planned", c.task.title, frozenset(slots.given))
    if not found or not all(c.linked(f"{shape}.{name}") for name in names):
        return None
    return Saying(found, slots) if c.rng.random() < PLANNED else None


# ---------------------------------------------------------------- waypoints


def waypoints(c: Context) -> Movement | None:
    """Two to six stated places, one after the other."""
    rng, slots = c.rng, c.slots()
    points = [draw_point(rng) for _ in range(2 + int(rng.random() ** 1.6 * 5))]
    said = [position(point, rng).short or "" for point in points]
    if rng.random() < 0.7 or len(points) > 3:
        joint = pick((" and ", ", ", " and then ", ", and then "), rng)
        slots.put("points", Value(None, joined(said, joint)))
    else:
        slots.put("first", Value(None, said[0]))
        slots.put("rest", Value(None, " and then to ".join(said[1:])))
    return c.movement("waypoints", c.goto(points), slots)


def square(c: Context) -> Movement | None:
    """The survey square."""
    rng, how = c.rng, c.slots()
    start, clockwise = "east", False
    if rng.random() < 0.3:
        start = pick(g.SQUARE_STARTS, rng)
        how.put_words("corner" if "-" in start else "side", start)
    words = c.phrase("square", "how", how) if how.given else ""
    start = start if words else "east"
    if rng.random() < 0.25:
        clockwise = _clockwise(c, how, 0.7)
        joints = (" and going ", ", ", " and then ") if words else (", ", " ", ", going ")
        words += pick(joints, rng) + how["turn"]
    slots = c.slots()
    slots.put_words("how", words)
    if planned := _planned(c, "square", ("center", "radius"), slots):
        center, half = c.use("square.center"), c.use("square.radius")
    else:
        center = c.take(slots, "center", "square.center", draw_position)
        half = c.take(slots, "radius", "square.radius", _length(3, 40))
    steps = c.goto(g.survey_square(center, half, start, clockwise=clockwise))
    if planned and steps:
        return Movement("square", steps, planned)
    return c.movement("square", steps, slots)


def lawnmower(c: Context) -> Movement | None:
    """The lawnmower grid; its size replaces the task's, so that lanes fill it exactly."""
    rng, slots = c.rng, c.slots()
    spacing = pick(SPACINGS, rng)
    width = g.tidy(spacing * pick((1, 1, 2, 2, 2, 3, 3, 4, 5, 6, 7), rng))
    along = g.tidy(spacing * rng.randrange(1, 9))
    if rng.random() < 0.3:
        along = g.tidy(along + pick((1, 2, 3, 5, 10), rng))
    corner, axis, words = _grid_how(c, g.lane_count(along, spacing) is not None)
    slots.put_words("how", words)
    sizes = {"width": width, "length": along, "spacing": spacing}
    for name, size in sizes.items():
        parameter = c.entry.links.get(f"lawnmower.{name}")
        if parameter and (rng.random() < 0.85 or parameter in c.values):
            c.values[parameter] = length(size, rng)
    if planned := _planned(c, "lawnmower", ("center", *sizes), slots):
        center, *_sizes = (c.use(f"lawnmower.{name}") for name in ("center", *sizes))
    else:
        center = c.take(slots, "center", "lawnmower.center", draw_position)
        if not c.linked("lawnmower.spacing") and rng.random() < 0.5:
            lanes = g.lane_count(width if axis == "y" else along, spacing) or 0
            _count(c, slots, "lanes", lanes)
            del sizes["spacing"]
        for name, size in sizes.items():
            if c.linked(f"lawnmower.{name}"):
                c.fill(slots, name, f"lawnmower.{name}")
            else:
                slots.put(name, length(size, rng))
    steps = c.goto(g.lawnmower(center, width, along, spacing, corner, axis))
    if planned and steps:
        return Movement("lawnmower", steps, planned)
    return c.movement("lawnmower", steps, slots)


def _grid_how(c: Context, may_turn: bool) -> tuple[g.Corner, g.Axis, str]:
    """First corner and direction of the lanes, and the words for them; nothing said is south-west
    and y.
    """
    rng, slots = c.rng, c.slots()
    corner: g.Corner = "south-west"
    axis: g.Axis = "y"
    if rng.random() < 0.25:
        corner = pick(g.CORNERS, rng)
        slots.put_words("corner", corner)
        slots["_step"] = "west" if "east" in corner else "east"
    if rng.random() < 0.25:
        axis = "x" if may_turn and rng.random() < 0.8 else "y"
        if rng.random() < 0.5:
            slots.put_words("axis", pick((axis, f"the {axis} axis"), rng))
        else:
            slots.put_words("compass", "east-west" if axis == "x" else "north-south")
    words = c.phrase("lawnmower", "how", slots) if slots.given else ""
    return (corner, axis, words) if words else ("south-west", "y", "")


def circle(c: Context) -> Movement | None:
    """A circle of waypoints, with number, start and direction stated."""
    slots = c.slots()
    count = _count(c, slots, "count", 4, 8, 6, 12, 4, 8)
    start = pick((0, 90, 180, 270), c.rng)
    slots.put_words("start", COMPASS[start])
    clockwise = _clockwise(c, slots, 0.5)
    center = c.take(slots, "center", "orbit.center", draw_position)
    radius = c.take(slots, "radius", "orbit.radius", _length(4, 60))
    points = g.circle(center, radius, count, start, clockwise=clockwise)
    return c.movement("orbit", c.goto(points), slots)


def line(c: Context) -> Movement | None:
    """A straight run of stated start, heading and length."""
    slots = c.slots()
    if planned := _planned(c, "line", ("start", "heading", "length"), slots):
        run = [c.use(f"line.{name}") for name in ("start", "heading", "length")]
        steps = c.goto(g.straight_line(*run))
        return Movement("line", steps, planned) if steps else None
    start = c.take(slots, "start", "line.start", draw_position)
    heading = c.take(slots, "heading", "line.heading", lambda rng: bearing(draw_bearing(rng), rng))
    distance = c.take(slots, "length", "line.length", _length(10, 400))
    return c.movement("line", c.goto(g.straight_line(start, heading, distance)), slots)


def stated_pass(c: Context) -> Movement | None:
    """A straight run between two stated places, mostly along an axis."""
    rng, slots = c.rng, c.slots()
    first, last = draw_point(rng), draw_point(rng)
    if rng.random() < 0.7:
        last = g.offset(first, pick((0, 90, 180, 270), rng), draw_number(rng, 10, 150))
    slots.put("first", position(first, rng))
    slots.put("last", position(last, rng))
    return c.movement("pass", c.goto([first, last]), slots)


def beside(c: Context) -> Movement | None:
    """To a point some way north, east, south or west of a place."""
    slots = c.slots()
    place = c.take(slots, "xy", f"{c.book.motions.get('goto')}.xy", draw_position)
    away = slots.put("away", _length(5, 100)(c.rng))
    heading = pick((0, 90, 180, 270), c.rng)
    slots.put_words("side", COMPASS[heading])
    return c.movement("beside", c.goto([g.offset(place, heading, away)]), slots, "goto")


def home(c: Context) -> Movement | None:
    """Back to where the vehicle started."""
    return c.movement("home", c.goto([c.book.vocabulary.home]), c.slots(), "goto")


def go_back(c: Context) -> Movement | None:
    """Back to the task's place, when the prompt has been there."""
    place = c.task.position_parameter
    if place is None or place not in c.used or c.unresolved(c.values[place]):
        return None
    slots = c.slots()
    slots.put_words("place", c.refer(place))
    return c.movement("go_back", c.goto([c.values[place].value]), slots, "goto")


def with_stops(c: Context, movement: Movement) -> Movement:
    """The movement with a hold of stated time at each of its points."""
    name, slots = c.book.motions.get("hold"), c.slots()
    pause = slots.put("pause", duration(draw_duration(c.rng, 3, 120), c.rng))
    templates = c.book.pattern("stops", c.task.title, frozenset(slots.given))
    if not name or "time" not in c.book.skills[name].skill.by_name or not templates:
        return movement
    assert movement.saying is not None
    movement.saying.suffix = pick(templates, c.rng).render(slots, c.rng)
    steps = [step for point in movement.steps for step in (point, (name, {"time": pause}))]
    return Movement(f"{movement.kind}_stops", steps, movement.saying)


# ---------------------------------------------------------------- turns


def _turns(c: Context, motion: str, values: list[Any]) -> list[Step]:
    """A step for each heading or angle; none for a vehicle that cannot turn so."""
    name = c.book.motions.get(motion)
    if not name:
        return []
    key = c.book.skills[name].skill.parameters[0].name
    return [(name, {key: value}) for value in values]


def headings(c: Context) -> Movement | None:
    """Two to six stated headings in turn."""
    rng, slots = c.rng, c.slots()
    count = pick((2, 3, 4, 4, 5, 6), rng)
    degrees = [draw_bearing(rng) for _ in range(count)]
    if rng.random() < 0.5:
        start = pick((0, 0, 45, 90), rng)
        degrees = g.sector_headings(count, start, clockwise=rng.random() < 0.8)
    said = [digits(value) for value in degrees]
    if all(value % 45 == 0 for value in degrees) and rng.random() < 0.6:
        said = [COMPASS[int(value)] for value in degrees]
    elif count % 2:
        said = [f"{value:03d}" if isinstance(value, int) else digits(value) for value in degrees]
    joint = pick((" and ", " and then "), rng)
    listed = ", then ".join(said) if rng.random() < 0.25 else joined(said, joint)
    slots.put("headings", Value(None, listed))
    return c.movement("headings", _turns(c, "turn_to", degrees), slots)


def _pause(rng: Random) -> Value:
    return duration(draw_duration(rng, 2, 60), rng)


def sectors(c: Context) -> Movement | None:
    """Evenly spaced headings, with a hold at each where a pause is stated."""
    rng, slots = c.rng, c.slots()
    count = _count(c, slots, "sectors", 3, 4, 4, 5, 6, 8, 8, 9, 10, 12)
    if parameter := c.linked("sectors.sectors"):
        c.values[parameter] = Value(count, count_text(count, rng))
        slots.put("sectors", c.values[parameter])
        c.used.add(parameter)
    first = slots.put("first", bearing(pick((0, 0, 0, 90, 180, 270, 45), rng), rng))
    steps = _turns(c, "turn_to", g.sector_headings(count, first))
    hold, words, pauses = c.book.motions.get("hold"), "", c.slots()
    stops = hold and "time" in c.book.skills[hold].skill.by_name and rng.random() < 0.45
    if stops and c.book.pattern("sectors", c.task.title, frozenset({"wait"}), "pause"):
        pause = c.take(pauses, "wait", "sectors.wait", _pause)
        words = c.phrase("sectors", "pause", pauses)
        steps = [step for turn in steps for step in (turn, (str(hold), {"time": pause}))]
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


def swing(c: Context) -> Movement | None:
    """To one side and then to the other."""
    rng, slots = c.rng, c.slots()
    first = draw_rotation(rng, 90)
    second = pick((-first, -first, -2 * first, draw_rotation(rng, 90)), rng)
    slots.put("first", rotation(first, rng))
    slots.put("second", rotation(second, rng))
    return c.movement("swing", _turns(c, "turn_by", [first, second]), slots)


def full_turn(c: Context) -> Movement | None:
    """A full turn in equal steps."""
    slots = c.slots()
    count = _count(c, slots, "count", 3, 4, 4, 5, 6, 6, 8, 8, 9, 10, 12)
    sign = 1
    if c.rng.random() < 0.4:
        sign = 1 if _clockwise(c, slots, 0.5) else -1
    return c.movement("full_turn", _turns(c, "turn_by", [sign * 360 // count] * count), slots)


def once_round(c: Context) -> Movement | None:
    """A whole circle, "once round"."""
    slots, name = c.slots(), c.book.motions.get("arc")
    if not name or not {"radius", "delta_yaw"} <= set(c.book.skills[name].skill.by_name):
        return None
    if parameter := c.linked(f"{name}.delta_yaw"):
        if c.values[parameter].value != 360:
            return None
        c.used.add(parameter)
    sign = 1
    if c.rng.random() < 0.5:
        sign = 1 if _clockwise(c, slots, 0.5) else -1
    given: dict[str, Any] = {"delta_yaw": sign * 360}
    if c.linked(f"{name}.radius") or c.rng.random() < 0.7:
        draw = c.book.skills[name].draws["radius"]
        given["radius"] = c.take(slots, "radius", f"{name}.radius", draw)
    return c.movement("once", [(name, given)], slots, "arc")


# ---------------------------------------------------------------- by pattern

PATTERNS: dict[str, tuple[tuple[float, Builder], ...]] = {
    "goto": ((0.12, waypoints), (0.08, beside), (0.03, home)),
    "square": ((0.85, square), (0.08, waypoints)),
    "lawnmower": ((0.85, lawnmower), (0.08, waypoints)),
    "orbit": (
        (0.22, circle),
        (0.17, once_round),
        (0.05, waypoints),
        (0.03, square),
        (0.03, beside),
    ),
    "pass": ((0.5, stated_pass), (0.35, line), (0.08, waypoints)),
    "line": ((0.75, line), (0.1, stated_pass)),
    "sectors": ((0.3, sectors), (0.22, headings), (0.08, turn_steps), (0.1, full_turn)),
    "sweep": ((0.15, headings), (0.12, swing), (0.1, turn_steps), (0.05, full_turn)),
    "follow": ((0.05, waypoints), (0.03, beside)),
    "arc": ((0.05, once_round), (0.05, beside)),
    "approach": ((0.07, beside),),
}
"""How often a task of the pattern is drawn as each movement; else a skill that fits the task."""
EXTRA: tuple[Builder, ...] = (
    *(waypoints, square, line, stated_pass, headings, turn_steps, swing, circle, lawnmower),
    *(full_turn, once_round, beside),
)


def main_movement(c: Context) -> Movement:
    """The movement of the task's pattern, or a navigation skill that fits the task."""
    roll = c.rng.random()
    for share, builder in PATTERNS.get(c.task.pattern, ()):
        if roll < share:
            movement = builder(c)
            if movement is None:
                break
            stops = builder in (waypoints, square, circle) and c.rng.random() < STOPS
            return with_stops(c, movement) if stops else movement
        roll -= share
    names = c.task.skills["navigation"]
    return c.simple(names[int(c.rng.random() ** 1.8 * len(names))])
