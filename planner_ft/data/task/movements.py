"""Movements: what a prompt asks the vehicle to do, as steps with exact geometry and as words.

Each builder draws one movement of a task's pattern; `None` means that it cannot be drawn for this task or vehicle.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import Any

from planner_ft.data.task import geometry as g
from planner_ft.data.task.context import Context
from planner_ft.data.task.numbers import COMPASS, Value, bearing, count_text, digits, duration, length, position, rotation
from planner_ft.data.task.phrasebook import Call, Saying, Slots
from planner_ft.data.task.template import Template
from planner_ft.data.task.values import draw_bearing, draw_duration, draw_number, draw_point, draw_rotation

Step = tuple[str, dict[str, Any]]


@dataclass
class Movement:
    """Steps that are said together. `saying` is None where the prompt asks for no movement, so that the vehicle holds."""

    kind: str
    steps: list[Step]
    saying: Saying | None
    filters: list[Call] = field(default_factory=list)
    perceptions: list[Call] = field(default_factory=list)


Builder = Callable[[Context], Movement | None]


def simple(context: Context, name: str) -> Movement:
    """One navigation skill in one step."""
    call = context.call(name)
    return Movement(context.book.skills[name].skill.motion or name, [(name, call.parameters)], call.saying)


def implied_hold(context: Context) -> Movement | None:
    """The hold of a prompt that asks for no movement."""
    name = context.book.motions.get("hold")
    return Movement("implied", [(name, {})], None) if name else None


def _go(context: Context, points: list[g.Point]) -> list[Step] | None:
    name = context.book.motions.get("goto")
    return [(name, {"x": x, "y": y}) for x, y in points] if name else None


def _pattern(context: Context, pattern: str, points: list[g.Point], slots: Slots, kind: str | None = None) -> Movement | None:
    steps = _go(context, points)
    templates = [template for template in context.book.pattern(pattern, context.task.title) if template.fits(frozenset(slots.given))]
    return Movement(kind or pattern, steps, Saying(templates, slots)) if steps and templates else None


def _take(context: Context, slots: Slots, pattern: str, name: str, otherwise: Callable[[], Value]) -> Any:
    """The pattern's value from the task, if it is linked, else a value of its own that only the prompt states."""
    place = f"{pattern}.{name}"
    if context.linked(place):
        return context.fill(slots, name, place)
    value = otherwise()
    slots.put(name, value)
    return value.value


def _position(context: Context) -> Callable[[], Value]:
    return lambda: position(draw_point(context.rng), context.rng)


def _metres(context: Context, low: float, high: float) -> Callable[[], Value]:
    return lambda: length(draw_number(context.rng, low, high), context.rng)


def waypoints(context: Context) -> Movement | None:
    """Two to six stated places, one after the other."""
    rng, slots = context.rng, context.slots()
    points = [draw_point(rng) for _ in range(2 + int(rng.random() ** 1.6 * 5))]
    said = [position(point, rng).short for point in points]
    joint = rng.choice((" and ", ", ", " and then ", ", and then "))
    if rng.random() < 0.7 or len(points) > 3:
        slots.put("points", Value(None, ", ".join(said[:-1]) + joint + said[-1]))
    else:
        slots.put("first", Value(None, said[0]))
        slots.put("rest", Value(None, " and then to ".join(said[1:])))
    return _pattern(context, "waypoints", points, slots)


def square(context: Context) -> Movement | None:
    """The survey square."""
    rng, slots = context.rng, context.slots()
    start, clockwise, how = _square_how(context)
    planned = {"target_position", "radius"} <= set(context.values) and rng.random() < 0.25
    if planned and (templates := _planned(context)):
        center, half = _use(context, "square.center"), _use(context, "square.radius")
        slots.put_words("how", how)
        steps = _go(context, g.survey_square(center, half, start, clockwise=clockwise))
        return Movement("square", steps, Saying(templates, slots)) if steps else None
    center = _take(context, slots, "square", "center", _position(context))
    half = _take(context, slots, "square", "radius", _metres(context, 3, 40))
    slots.put_words("how", how)
    return _pattern(context, "square", g.survey_square(center, half, start, clockwise=clockwise), slots)


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
        how = _one(context, "square", "how", slots)
        start = start if how else "east"
    if rng.random() < 0.25:
        clockwise = rng.random() < 0.7
        way = "clockwise" if clockwise else rng.choice(("counter-clockwise", "anticlockwise"))
        how = f"{how}{rng.choice((' and going ', ', ', ' and then '))}{way}" if how else rng.choice((f", {way}", f" {way}", f", going {way}"))
    return start, clockwise, how


def _one(context: Context, pattern: str, key: str, slots: Slots) -> str:
    fitting = [template for template in context.book.pattern(pattern, context.task.title, key) if template.fits(frozenset(slots.given))]
    return fitting[int(context.rng.random() * len(fitting))].render(slots, context.rng) if fitting else ""


def _grid_size(context: Context) -> tuple[float, float, float]:
    """Width, length and a spacing that divides both, two to eight lanes across the width."""
    rng = context.rng
    spacing = rng.choice((2, 2.5, 3, 4, 5, 5, 6, 7, 7.5, 8, 10, 10, 12, 15, 20))
    width, along = (g.tidy(spacing * rng.randrange(1, 8)) for _ in range(2))
    if rng.random() < 0.15:
        along = g.tidy(along + rng.choice((1, 2, 3)))
    return width, along, spacing


def lawnmower(context: Context) -> Movement | None:
    """The lawnmower grid; its size replaces the task's, so that lanes fill it exactly."""
    rng, slots = context.rng, context.slots()
    width, along, spacing = _grid_size(context)
    corner, axis, how = _grid_how(context, along, spacing)
    sizes = {"width": width, "length": along, "spacing": spacing}
    for name, size in sizes.items():
        if (parameter := context.entry.links.get(f"lawnmower.{name}")) and (rng.random() < 0.85 or parameter in context.values):
            context.values[parameter] = length(size, rng)
    whole = all(context.linked(f"lawnmower.{name}") for name in ("center", *sizes))
    if whole and rng.random() < 0.25 and (templates := _planned(context)):
        center = _use(context, "lawnmower.center")
        for name in sizes:
            _use(context, f"lawnmower.{name}")
        slots.put_words("how", how)
        steps = _go(context, g.lawnmower(center, width, along, spacing, corner, axis))
        return Movement("lawnmower", steps, Saying(templates, slots)) if steps else None
    center = _take(context, slots, "lawnmower", "center", _position(context))
    for name, size in sizes.items():
        _take(context, slots, "lawnmower", name, lambda size=size: length(size, rng))  # type: ignore[misc]
    slots.put_words("how", how)
    return _pattern(context, "lawnmower", g.lawnmower(center, width, along, spacing, corner, axis), slots)


def _grid_how(context: Context, along: float, spacing: float) -> tuple[g.Corner, g.Axis, str]:
    rng, slots = context.rng, context.slots()
    corner: g.Corner = "south-west"
    axis: g.Axis = "y"
    if rng.random() < 0.25:
        corner = g.CORNERS[int(rng.random() * 4)]
        slots.put_words("corner", corner)
    if rng.random() < 0.25:
        axis = "x" if g.lane_count(along, spacing) and rng.random() < 0.8 else "y"
        slots.put_words("axis", rng.choice((axis, f"the {axis} axis")))
        slots.put_words("compass", "east-west" if axis == "x" else "north-south")
    wanted = {name for name in ("corner", "axis") if name in slots}
    templates = [
        template for template in context.book.pattern("lawnmower", context.task.title, "how")
        if template.needed <= slots.given and {"axis" if name == "compass" else name for name in template.needed} == wanted
    ]  # fmt: skip
    if not wanted or not templates:
        return "south-west", "y", ""
    return corner, axis, templates[int(rng.random() * len(templates))].render(slots, rng)


def circle(context: Context) -> Movement | None:
    """A circle of waypoints, with number, start and direction stated."""
    rng, slots = context.rng, context.slots()
    count = rng.choice((4, 8, 6, 12, 4, 8))
    start = rng.choice((0, 90, 180, 270))
    clockwise = rng.random() < 0.5
    center = _take(context, slots, "orbit", "center", _position(context))
    radius = _take(context, slots, "orbit", "radius", _metres(context, 4, 60))
    slots.put("count", Value(count, count_text(count, rng)))
    slots.put_words("start", COMPASS[start])
    slots.put_words("turn", "clockwise" if clockwise else rng.choice(("counter-clockwise", "anticlockwise")))
    return _pattern(context, "orbit", g.circle(center, radius, count, start, clockwise=clockwise), slots)


def line(context: Context) -> Movement | None:
    """A straight run of stated start, heading and length."""
    rng, slots = context.rng, context.slots()
    planned = all(context.linked(f"line.{name}") for name in ("start", "heading", "length"))
    if planned and rng.random() < 0.3 and (templates := _planned(context)):
        start, heading, distance = (_use(context, f"line.{name}") for name in ("start", "heading", "length"))
        steps = _go(context, g.straight_line(start, heading, distance))
        return Movement("line", steps, Saying(templates, slots)) if steps else None
    start = _take(context, slots, "line", "start", _position(context))
    heading = _take(context, slots, "line", "heading", lambda: bearing(draw_bearing(rng), rng))
    distance = _take(context, slots, "line", "length", _metres(context, 10, 400))
    return _pattern(context, "line", g.straight_line(start, heading, distance), slots)


def stated_pass(context: Context) -> Movement | None:
    """A straight run between two stated places, mostly along an axis."""
    rng, slots = context.rng, context.slots()
    first = draw_point(rng)
    run = draw_number(rng, 10, 150)
    last = g.offset(first, rng.choice((0, 90, 180, 270)), run) if rng.random() < 0.7 else draw_point(rng)
    slots.put("first", position(first, rng))
    slots.put("last", position(last, rng))
    return _pattern(context, "pass", [first, last], slots)


def _turns(context: Context, steps: list[Step], pattern: str, slots: Slots, kind: str) -> Movement | None:
    templates = [template for template in context.book.pattern(pattern, context.task.title) if template.fits(frozenset(slots.given))]
    return Movement(kind, steps, Saying(templates, slots)) if templates else None


def headings(context: Context) -> Movement | None:
    """Two to six stated headings in turn."""
    rng, slots = context.rng, context.slots()
    name = context.book.motions.get("turn_to")
    if not name:
        return None
    key = context.book.skills[name].skill.parameters[0].name
    count = rng.choice((2, 3, 4, 4, 5, 6))
    degrees = g.sector_headings(count, rng.choice((0, 0, 45, 90)), clockwise=rng.random() < 0.8) if rng.random() < 0.5 else [draw_bearing(rng) for _ in range(count)]
    words = all(value % 45 == 0 for value in degrees) and rng.random() < 0.6
    said = [COMPASS[int(value)] if words else f"{int(value):03d}" if count % 2 and isinstance(value, int) else digits(value) for value in degrees]
    slots.put("headings", Value(None, ", ".join(said[:-1]) + rng.choice((" and ", " and then ")) + said[-1]))
    return _turns(context, [(name, {key: value}) for value in degrees], "headings", slots, "headings")


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
    movement = _turns(context, steps, "sectors", slots, "sectors")
    if movement and movement.saying and words:
        movement.saying = Saying([_followed(template, words) for template in movement.saying.templates], movement.saying.slots)
    return movement


def _pause(context: Context) -> tuple[float | None, str]:
    hold = context.book.motions["hold"]
    if context.rng.random() < 0.55 or "time" not in context.book.skills[hold].skill.by_name:
        return None, ""
    slots = context.slots()
    if not context.book.pattern("sectors", context.task.title, "pause"):
        return None, ""
    pause = _take(context, slots, "sectors", "wait", lambda: duration(draw_duration(context.rng, 2, 60), context.rng))
    return pause, _one(context, "sectors", "pause", slots)


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
    return _turns(context, [(name, {key: value})] * count, "steps", slots, "steps")


def swing(context: Context) -> Movement | None:
    """To one side and then to the other."""
    rng, slots = context.rng, context.slots()
    name = context.book.motions.get("turn_by")
    if not name:
        return None
    key = context.book.skills[name].skill.parameters[0].name
    first = draw_rotation(rng, 90)
    second = -first if rng.random() < 0.4 else -2 * first if rng.random() < 0.5 else draw_rotation(rng, 90)
    slots.put("first", rotation(first, rng))
    slots.put("second", rotation(second, rng))
    return _turns(context, [(name, {key: first}), (name, {key: second})], "swing", slots, "swing")


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
        slots.put_words("turn", "clockwise" if sign > 0 else rng.choice(("counter-clockwise", "anticlockwise")))
    return _turns(context, [(name, {key: sign * 360 // count})] * count, "full_turn", slots, "full_turn")


def once_round(context: Context) -> Movement | None:
    """A whole circle, "once round"."""
    rng, slots = context.rng, context.slots()
    name = context.book.motions.get("arc")
    if not name or not {"radius", "delta_yaw"} <= set(context.book.skills[name].skill.by_name):
        return None
    if (parameter := context.linked(f"{name}.delta_yaw")) and context.values[parameter].value != 360:
        return None
    sign = 1
    if rng.random() < 0.5:
        sign = rng.choice((1, -1))
        slots.put_words("turn", "clockwise" if sign > 0 else rng.choice(("counter-clockwise", "anticlockwise")))
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
    return _turns(context, [(name, parameters)], "once", slots, "arc")


def beside(context: Context) -> Movement | None:
    """To a point some way north, east, south or west of a place."""
    rng, slots = context.rng, context.slots()
    heading = 90 * rng.randrange(4)
    goto = context.book.motions.get("goto")
    x, y = context.point(slots, f"{goto}.xy")
    away = length(draw_number(rng, 5, 100), rng)
    slots.put("away", away)
    slots.put_words("side", COMPASS[heading])
    return _pattern(context, "beside", [g.offset((x, y), heading, away.value)], slots, "goto")


def home(context: Context) -> Movement | None:
    """Back to where the vehicle started."""
    x, y = context.book.vocabulary.home
    return _pattern(context, "home", [(x, y)], context.slots(), "goto")


def go_back(context: Context) -> Movement | None:
    """Back to the task's place, when the prompt has been there."""
    place = context.task.position_parameter
    if place not in context.used or place is None or context.unresolved(context.values[place]):
        return None
    slots = context.slots()
    slots.put_words("place", context.refer(place))
    x, y = context.values[place].value
    return _pattern(context, "go_back", [(x, y)], slots, "goto")


def with_stops(context: Context, movement: Movement) -> Movement:
    """The movement with a hold of stated time at each of its points."""
    name = context.book.motions.get("hold")
    templates = context.book.pattern("stops", context.task.title)
    if not name or "time" not in context.book.skills[name].skill.by_name or not movement.saying or not templates:
        return movement
    slots = context.slots()
    value = duration(draw_duration(context.rng, 3, 120), context.rng)
    slots.put("pause", value)
    movement.saying.suffix = templates[int(context.rng.random() * len(templates))].render(slots, context.rng)
    steps = [step for point in movement.steps for step in (point, (name, {"time": value.value}))]
    return replace(movement, steps=steps, kind=f"{movement.kind}_stops")


STOPS = 0.07  # share of waypoint movements with a hold at each point

PATTERNS: dict[str, tuple[tuple[float, Builder], ...]] = {
    "goto": ((0.12, waypoints), (0.08, beside), (0.03, home)),
    "square": ((0.85, square), (0.08, waypoints)),
    "lawnmower": ((0.85, lawnmower), (0.08, waypoints)),
    "orbit": ((0.22, circle), (0.17, once_round), (0.05, waypoints), (0.03, square), (0.03, beside)),
    "pass": ((0.5, stated_pass), (0.35, line), (0.08, waypoints)),
    "line": ((0.75, line), (0.1, stated_pass)),
    "sectors": ((0.3, sectors), (0.22, headings), (0.08, turn_steps), (0.1, full_turn)),
    "sweep": ((0.15, headings), (0.12, swing), (0.1, turn_steps), (0.05, full_turn)),
    "follow": ((0.05, waypoints), (0.03, beside)),
    "arc": ((0.05, once_round), (0.05, beside)),
    "approach": ((0.07, beside),),
}
EXTRA: tuple[Builder, ...] = (waypoints, square, line, stated_pass, headings, turn_steps, swing, circle, lawnmower, full_turn, once_round, beside)


def main_movement(context: Context) -> Movement:
    """The movement of the task's pattern, or a navigation skill that fits the task."""
    rng = context.rng
    roll = rng.random()
    for share, builder in PATTERNS.get(context.task.pattern, ()):
        if roll < share:
            movement = builder(context)
            if movement:
                return with_stops(context, movement) if builder in (waypoints, square, circle) and rng.random() < STOPS else movement
            break
        roll -= share
    names = context.task.skills["navigation"]
    return simple(context, names[int(rng.random() ** 1.4 * len(names))])
