"""Steps that stand for a whole shape: what each needs, its draws, its waypoints or headings."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from random import Random
from typing import Any

from planner_ft.data.numbers import (
    COMPASS,
    Value,
    bearing,
    count_text,
    length,
    pick,
    position,
    rotation,
)
from planner_ft.data.task.values import (
    TABLE,
    Draw,
    draw_bearing,
    draw_number,
    draw_point,
    draw_rotation,
)
from planner_ft.data.templates.grammar import fail
from planner_ft.facts import geometry as g

BEARINGS = {name: degrees for degrees, name in COMPASS.items()}
Values = Mapping[str, Any]


class Shape:
    """`motion` of its steps; `roles`: what it needs, with the place that a task parameter fills
    (see `links` of the phrase file), written "point:center width", the role and its name in the
    place; `options`: what may be said; `expand`: its waypoints or headings.
    """

    def __init__(
        self,
        motion: str,
        pattern: str,
        roles: str,
        options: str,
        expand: Callable[[Values], Sequence[Any]],
    ) -> None:
        pairs = (item.partition(":") for item in roles.split())
        self.roles = {role: f"{pattern}.{name or role}" for role, _colon, name in pairs}
        self.motion, self.options, self.expand = motion, frozenset(options.split()), expand


def _clockwise(values: Values, default: bool = False) -> bool:
    return bool(values["turn"] == "clockwise") if "turn" in values else default


def _grid(values: Values) -> list[g.Point]:
    axis: g.Axis = "x" if values.get("axis") == "x" else "y"
    width, along, start = values["width"], values["length"], values.get("start", "south-west")
    spacing = values.get("spacing")
    if spacing is None:
        spacing = (width if axis == "y" else along) / (values["count"] - 1)
    return g.lawnmower(values["point"], width, along, spacing, start, axis)


def _line(values: Values) -> list[g.Point]:
    """Start and end, or a waypoint behind every spacing, or behind each of `count` legs."""
    far = values["length"]
    legs = int(values.get("count") or round(far / values.get("spacing", far)))
    ways = (far * number / legs for number in range(1, legs + 1))
    start = g.point(*values["point"])
    return [start, *(g.offset(start, values["heading"], way) for way in ways)]


def _pass(values: Values) -> list[g.Point]:
    """Along a side of a structure, from the south or the west."""
    bearing = BEARINGS.get(values.get("side", ""), 45)
    if bearing % 90:
        raise ValueError("a pass needs one of the four sides")
    middle = g.offset(values["point"], bearing, values["distance"])
    start = g.offset(middle, (bearing + 90) % 180 + 180, values["length"] / 2)
    return g.straight_line(start, (bearing + 90) % 180, values["length"])


SHAPES: Mapping[str, Shape] = {
    "Grid": Shape(
        "goto", "lawnmower", "point:center width length spacing", "start axis count", _grid
    ),
    "Square": Shape(
        *("goto", "square", "point:center radius", "start turn"),
        lambda v: g.survey_square(
            v["point"], v["radius"], v.get("start", "east"), clockwise=_clockwise(v)
        ),
    ),
    "Ring": Shape(
        *("goto", "orbit", "point:center radius count", "start turn"),
        lambda v: g.circle(
            *(v["point"], v["radius"], int(v["count"]), BEARINGS[v.get("start", "east")]),
            clockwise=_clockwise(v),
        ),
    ),
    "Line": Shape("goto", "line", "point:start heading length", "spacing count", _line),
    "Pass": Shape("goto", "pass", "point length distance", "side", _pass),
    "Offset": Shape(
        *("goto", "GoToXY", "point:xy heading length", ""),
        lambda v: [g.offset(v["point"], v["heading"], v["length"])],
    ),
    "Return": Shape("goto", "", "", "", lambda v: [v["home"]]),
    "Sectors": Shape(
        *("turn_to", "sectors", "count:sectors", "heading turn"),
        lambda v: g.sector_headings(
            int(v["count"]), v.get("heading", 0), clockwise=_clockwise(v, True)
        ),
    ),
    "Turns": Shape(
        "turn_by", "", "count delta_yaw", "", lambda v: [v["delta_yaw"]] * int(v["count"])
    ),
}


# ---------------------------------------------------------------- values


def one_of(options: Sequence[Any]) -> Draw:
    """A draw of one of some words or counts."""

    def draw(rng: Random) -> Value:
        option = pick(options, rng)
        text = option if isinstance(option, str) else count_text(option, rng)
        return Value(option, text, str(option))

    return draw


def direction(rng: Random) -> Value:
    """A compass direction in words, mostly one of the four: "north", "due south", "south-west"."""
    degrees = 90 * rng.randrange(4) if rng.random() < 0.8 else 45 + 90 * rng.randrange(4)
    name = COMPASS[degrees]
    due = degrees % 90 == 0 and rng.random() < 0.25
    return Value(degrees, f"due {name}" if due else name, name, way=name)


DRAWS: Mapping[tuple[str, str], Draw] = {
    ("Line", "heading"): lambda rng: bearing(draw_bearing(rng), rng),
    ("Sectors", "heading"): lambda rng: bearing(pick((0, 0, 45, 90, 180, 270), rng), rng),
    ("Grid", "compass"): lambda rng: pick(
        (Value("y", "north-south"), Value("x", "east-west")), rng
    ),
    ("any", "point"): lambda rng: position(draw_point(rng), rng),
    ("any", "radius"): lambda rng: length(draw_number(rng, 4, 60), rng),
    ("any", "length"): lambda rng: length(draw_number(rng, 5, 150), rng),
    ("any", "direction"): direction,
    ("any", "heading"): direction,
    ("any", "delta_yaw"): lambda rng: rotation(draw_rotation(rng, 90), rng),
    **{
        (shape, slot): one_of(options)
        for shape, slots in TABLE["draws"].items()
        for slot, options in slots.items()
    },
}
"""By shape, or "any", and slot or role."""


def value_draw(shape: str, role: str, base: str) -> Draw:
    """How the value of a slot in a shape is drawn. Raises TemplateError for one that is not."""
    by_role = ((shape, role), ("any", role)) if base != "direction" else (("any", base),)
    keys = (key for key in ((shape, base), *by_role) if key in DRAWS)
    return DRAWS[next(keys, None) or fail(f"{shape} cannot draw a {role}")]


def grid_size(rng: Random, *, free: bool) -> dict[str, float]:
    """A grid's sizes and lanes, which fit; `free`: its length is no multiple of the spacing."""
    spacing = pick(TABLE["grid"]["spacing"], rng)
    width = g.tidy(spacing * (pick(TABLE["grid"]["lanes"], rng) - 1))
    along = g.tidy(spacing * rng.randrange(1, 11))
    if free and rng.random() < 0.6:
        round_ = rng.random() < 0.7
        along = g.tidy(5 * rng.randrange(1, 31) if round_ else rng.randrange(5, 120))
    count = g.lane_count(width if free else along, spacing) or 0
    return {"width": width, "length": along, "spacing": spacing, "count": count}


def line_legs(count: int | None, rng: Random) -> dict[str, float]:
    """The length of a line and its legs, which fill it; `count`: of the legs, where it is set."""
    spacing = pick(TABLE["line"]["spacing"], rng)
    count = count or pick(TABLE["draws"]["Line"]["count"], rng)
    return {"spacing": spacing, "count": count, "length": g.tidy(spacing * count)}
